"""Lasts made from lasts: whether a graded run keeps its increments, how two lasts differ."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Unpack

from footfit import results
from footfit.api.inputs import FilePath, ReadingKeywords, Shape
from footfit.api.scans import profiled_shape
from footfit.errors import BadOption, SideUndecided
from footfit.locations import LocationName, location_of
from footfit.pipeline.batch.runs import HERE
from footfit.pipeline.batch.sources import is_no_path, mesh_sources


def check_run(
    run: FilePath | list[FilePath],
    *,
    catalogue: LocationName | None = None,
    manifest: FilePath | None = None,
    rule: str | None = None,
    tolerance: str | None = None,
    jobs: int = HERE,
) -> results.RunCheck:
    """The increments of a graded run, size by size and width by width, and where they break.

    Parameters
    ----------
    run : path or list of paths
        Files, folders and globs, or names of lasts; or the name of a family of the catalogue.
    catalogue : path, optional
        Where families and names are looked for.
    manifest : path, optional
        A CSV file with the sizes of the files; else their names say them.
    rule : str, optional
        A grading rule by its name or its file: the run is compared with it, else with itself.
    tolerance : str, optional
        In mm by kind of measure, such as "girth=2,length=1.5,width=1,height=1.5".

    Raises
    ------
    BadOption
        A size is not known, or the lasts are no run.
    NotInCatalogue, InputError, GeometryRefused
        There is no such last; a file cannot be read or measured.
    """
    from footfit.pipeline.last_making import run_lasts
    from footfit.pipeline.last_making.grading_rules import grading_rule
    from footfit.pipeline.last_making.run_increments import run_check
    from footfit.pipeline.last_making.tolerances import tolerances
    from footfit.pipeline.library.manifest import read_manifest

    given: list[Any] = run if isinstance(run, list) else [run]
    names = [os.fspath(each) for each in given]
    tolerance_mm = tolerances(tolerance)
    stated = None if rule is None else grading_rule(rule)
    rows = [] if manifest is None else read_manifest(Path(manifest))
    stored = [name for name in names if is_no_path(name)]
    if stored and catalogue is None:
        raise BadOption("is no file: name the catalogue that has it", stored[0])
    lasts: tuple[results.RunLast, ...] = ()
    family = None
    if catalogue is not None and len(names) == len(stored) == 1:
        lasts = run_lasts.family_lasts(location_of(catalogue), names[0])
        family = names[0] if lasts else None
    if not lasts:
        files = mesh_sources([name for name in names if name not in stored])
        by_name = () if catalogue is None else run_lasts.named_lasts(location_of(catalogue), stored)
        lasts = (*by_name, *run_lasts.file_lasts(files, rows, jobs))
    return run_check(lasts, tolerance_mm, stated, family)


def compare_lasts(
    first: Shape,
    second: Shape,
    *,
    tolerance: str | None = None,
    **reading: Unpack[ReadingKeywords],
) -> results.LastDifference:
    """How a second last differs from a first one, laid on its bottom; see docs/compare-lasts.md.

    Parameters
    ----------
    first, second : path, bytes, (vertices, faces), or what `align` or `flare` gave
        `Catalogue.shape` gives a stored last. A last of the other side is mirrored. A side that is
        not sure is the one with which the bottoms lie closer.
    tolerance : str, optional
        In mm by kind of measure; without it "girth=2,length=1.5,width=1,height=1.5".
    **reading
        See `ReadingKeywords`; they count for both.

    Raises
    ------
    BadOption
        The tolerance is not understood.
    InputError, GeometryRefused
        As `flare`, for either; NoSole if their bottoms do not lie together.
    """
    from footfit.pipeline.last_making.pair_of_lasts import closest_sides
    from footfit.pipeline.last_making.tolerances import tolerances
    from footfit.pipeline.last_making.two_lasts import last_difference

    tolerance_mm = tolerances(tolerance)
    pair = closest_sides(_either_side(first, reading), _either_side(second, reading))
    return last_difference(pair.first, pair.second, tolerance_mm, pair.notices)


def _either_side(shape: Shape, reading: ReadingKeywords) -> list[results.Profiled]:
    """A last by its detected side, and by the other one if that is not sure.

    If the shape shows no side, the last by both; neither is then detected.
    """
    settled = isinstance(shape, results.AlignedScan | results.Profiled)
    if settled or reading.get("side", "auto") != "auto":
        return [profiled_shape(shape, reading)]
    sides: list[results.SideName] = ["right", "left"]
    try:
        shown = [profiled_shape(shape, reading)]
    except SideUndecided:
        shown = []
    if shown:
        side = shown[0].aligned.alignment.side
        sure = side.confidence == "sure" or shown[0].aligned.alignment.info.is_stored_last
        sides = [] if sure else [name for name in sides if name != side.side]
    return shown + [profiled_shape(shape, {**reading, "side": name}) for name in sides]
