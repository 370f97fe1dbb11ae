"""What the library does with scans, one or many: read, align, flare, measure, compare ..."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, Unpack

from footfit.api.inputs import (
    CompareKeywords,
    ReadingKeywords,
    ScaleKeywords,
    heel_options,
    known_keywords,
    reading_options,
    source_of,
    stance_keywords,
)
from footfit.errors import BadOption
from footfit.pipeline.batch import runs
from footfit.pipeline.batch.sources import NONE_NAMED, ReadingOptions, Source, mesh_sources
from footfit.pipeline.customers.customer import pairs_by_name, pairs_in_csv
from footfit.results import AlignedScan, Profiled

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from footfit.api.inputs import Mesh, Meshes, Shape
    from footfit.pipeline.customers.customer import Customer
    from footfit.results import Comparison, MeasuredScan, Method, Reference, Scan, SurfaceCurvature

T = TypeVar("T")


@known_keywords(ScaleKeywords)
def read(mesh: Mesh, **scale: Unpack[ScaleKeywords]) -> Scan:
    """The surface of a mesh in mm, welded and cleaned, in the axes of its file.

    Raises
    ------
    InputError
        UnreadableFile, UnknownFormat, DamagedMesh, EmptyMesh, TooLarge or UnknownUnits.
    """
    from footfit.pipeline.scan import reading

    return reading.read(source_of(mesh, scale), reading_options(scale))


@known_keywords(ReadingKeywords)
def align(
    mesh: Mesh,
    *,
    method: Method = "footfit",
    reference: Reference | None = None,
    **reading: Unpack[ReadingKeywords],
) -> AlignedScan:
    """A foot or a last in the canonical frame: heel to toe along X, sole down, mm.

    Parameters
    ----------
    mesh : path, bytes, (vertices, faces) or Scan
    method : {"footfit", "paper", "paper-literal"}
        The paper's methods need a ``reference``; see `Catalogue.reference`.
    reference : Reference, optional
    **reading
        See `ReadingKeywords`.

    Raises
    ------
    InputError
        The mesh cannot be read.
    GeometryRefused
        It is not one whole foot or last.
    """
    from footfit.pipeline.scan.reading import aligned_source

    return aligned_source(source_of(mesh, reading), reading_options(reading), method, reference)


@known_keywords(ReadingKeywords)
def flare(shape: Shape, **reading: Unpack[ReadingKeywords]) -> Profiled:
    """The flare of a foot or a last: its profile, and the angle with its uncertainty.

    Raises
    ------
    InputError, GeometryRefused
        As `align`; also SideUndecided if the shape does not show left or right.
    """
    return profiled_shape(shape, reading)


@known_keywords(ReadingKeywords)
def measure(
    shape: Shape,
    *,
    usual_length_mm: tuple[float, float] | None = None,
    **reading: Unpack[ReadingKeywords],
) -> MeasuredScan:
    """Lengths, widths, girths and heights of a foot or a last, each with its uncertainty.

    ``usual_length_mm`` are the lengths of feet that are no surprise, as a fit profile has them;
    None stands for adults.

    Raises
    ------
    InputError, GeometryRefused
        As `flare`.
    """
    from footfit.pipeline.scan.measure import for_feet_of, measured_scan, measured_shape

    aligned = aligned_shape(shape, reading)
    if isinstance(aligned, Profiled):
        scan = measured_shape(aligned.aligned.alignment, aligned.measures)
    else:
        scan = measured_scan(aligned)
    return scan if usual_length_mm is None else for_feet_of(scan, usual_length_mm)


@known_keywords(ScaleKeywords)
def curvature(
    mesh: Mesh, *, radius_mm: float | None = None, **scale: Unpack[ScaleKeywords]
) -> SurfaceCurvature:
    """The concentrated curvature of any surface at every vertex, in 1/mm.

    ``radius_mm`` is the scale; 0 is the paper's one ring, None 6 % of the longest extent.

    Raises
    ------
    InputError
        As `read`.
    """
    from footfit.pipeline.scan.curvature import surface_curvature

    return surface_curvature(read(mesh, **scale), radius_mm)


@known_keywords(CompareKeywords)
def compare(foot: Shape, last: Mesh, **reading: Unpack[CompareKeywords]) -> Comparison:
    """A foot in a last that has a file of its own; for a stored last see `Catalogue.compare`.

    Raises
    ------
    InputError, GeometryRefused
        As `flare`, for either; or the foot cannot be placed in the last.
    """
    from footfit.pipeline.fit.compare import compared, scanned_last

    stands = stance_keywords(reading)
    around = scanned_last(source_of(last, {}), ReadingOptions(**stands))
    of_foot = {name: value for name, value in reading.items() if name not in stands}
    return compared(profiled_shape(foot, of_foot), around, heel_options(reading))


def sources(
    meshes: Meshes,
    *,
    split: bool = False,
    named: Mapping[str, Source] = NONE_NAMED,
    **reading: Any,
) -> list[Source]:
    """The meshes in files, folders and globs; with ``split`` each foot of a file by itself.

    ``named`` has the meshes that are lasts of a catalogue; see `Catalogue.sources`.

    Raises
    ------
    UnreadableFile
        The only argument is a folder or a glob, and it holds no mesh.
    """
    given: list[Any] = list(meshes) if isinstance(meshes, list) else [meshes]
    names = [mesh for mesh in given if isinstance(mesh, str | os.PathLike)]
    if len(names) == len(given):
        single = mesh_sources([os.fspath(name) for name in names], named)
    else:
        single = [source_of(mesh, reading) for mesh in given]
    if not split:
        return single
    from footfit.pipeline.scan.reading import split_sources

    return split_sources(single, reading_options(reading))


def customers(
    meshes: Meshes | None = None, *, pairs: str | os.PathLike[str] = "auto", split: bool = False
) -> list[Customer]:
    """The customers of whom meshes are the feet, for `Catalogue.match_each`.

    ``pairs`` "auto" pairs the files whose names say left and right; else it is a CSV file with the
    columns customer, left and right, which names the meshes.

    Raises
    ------
    BadOption
        The names do not say clearly whose feet the files are, or there is no mesh.
    BadManifest
        The CSV file is not understood.
    """
    if os.fspath(pairs) != "auto":
        if meshes is not None:
            raise BadOption("the CSV file of --pairs names the meshes: leave them out")
        return pairs_in_csv(Path(pairs))
    if meshes is None:
        raise BadOption("no mesh was given; name files or a folder, or --pairs FILE.csv")
    return pairs_by_name(sources(meshes, split=split))


def outcomes(
    verb: Callable[..., T], meshes: Meshes, *, jobs: runs.Jobs = runs.HERE, **options: Any
) -> Iterator[runs.Outcome[Source, T]]:
    """Call ``verb`` with each of many meshes: ``outcomes(measure, "feet/", jobs=2)``.

    A mesh that fails does not stop the others. Each outcome has a ``value``, or the ``error`` that
    says why there is none; its ``item`` names the file. They come in the order of the meshes.

    Parameters
    ----------
    verb : callable
        A function that takes a mesh, such as `measure`; with ``jobs`` it must be in a module.
    meshes : mesh or list of meshes
        Files, folders and globs too; see `sources`.
    jobs : int or concurrent.futures.Executor
        How many processes work; 0 works in this process. Or who works, such as a `cluster`.
    **options
        For ``verb``.
    """
    return runs.outcomes(partial(verb, **options), sources(meshes), jobs)


def cluster(scheduler: str) -> Executor:
    """The workers of a Dask scheduler, for a ``with`` block and as ``jobs`` of `outcomes`.

    ``scheduler`` is its address, tcp://HOST:PORT or tls://HOST:PORT. The scans travel there.

    Raises
    ------
    BadOption
        The address is not valid, or footfit is installed without its extra ``cluster``.
    ClusterUnusable
        The scheduler does not answer, it has no worker, or a worker has another footfit.
    """
    from footfit.pipeline.batch.cluster import Cluster

    return Cluster(scheduler)


def profiled_shape(shape: Shape, reading: Mapping[str, Any]) -> Profiled:
    """A shape as a match takes it; ``reading`` may hold other keys too."""
    from footfit.pipeline.scan.flare import profiled_scan

    aligned = aligned_shape(shape, reading)
    return aligned if isinstance(aligned, Profiled) else profiled_scan(aligned)


def aligned_shape(shape: Shape, reading: Mapping[str, Any]) -> AlignedScan | Profiled:
    """A shape, aligned; what is aligned or profiled already stays as it is."""
    if isinstance(shape, AlignedScan | Profiled):
        return shape
    from footfit.pipeline.scan.reading import aligned_source, profiled_source

    if isinstance(shape, Source) and shape.stored is not None:
        return profiled_source(shape, reading_options(reading))
    return aligned_source(source_of(shape, reading), reading_options(reading))
