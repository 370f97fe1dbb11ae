"""The last that another one is made from: its record, its shape, and how true its mesh is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import FootfitError, NoCatalogue, OtherKind
from footfit.geometry.measures.landmarks import Shape
from footfit.locations import Location
from footfit.pipeline.batch.run_manifest import OF_CONTENT
from footfit.pipeline.batch.sources import ReadingOptions, Source, content_hash
from footfit.pipeline.fit.compare import scanned_last
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.preparation import stored_shape
from footfit.pipeline.scan.reading import profiled_source
from footfit.pipeline.scan.standing import stance_labels
from footfit.results import LastRecord, Notice, ShapeSections
from footfit.results.last_making.custom_last import BaseMesh


@dataclass(frozen=True, slots=True)
class BaseLast:
    """A last that another one is made from.

    ``shape`` is its right shape in the canonical frame, in mm, with its small holes closed.
    ``mesh`` says which mesh that is.
    """

    record: LastRecord
    shape: Shape
    sections: ShapeSections
    mesh: BaseMesh

    @property
    def name(self) -> str:
        """The last's name; of a file, its name without the suffix."""
        return self.record.labels.name

    @property
    def path(self) -> str:
        """What an error names: the file of a base in a file, else its name in the catalogue."""
        return (self.mesh.kind == "file" and self.record.info.path) or self.name


def stored_base(
    path: Location, name: str, folders: Iterable[Path] = (), file: Source | None = None
) -> BaseLast:
    """A last of the catalogue at ``path``, with the best mesh that there is of it.

    That is the full copy, else the original file if it lies in one of the ``folders`` and has the
    hash that was stored, or is the ``file``; else the light copy.

    Raises
    ------
    NoCatalogue, UnknownLast, CatalogueUnusable
        There is no such last, or it was stored without its mesh; it cannot be read.
    """
    with open_catalogue(path) as opened:
        record = opened.record(name)
        copy = opened.mesh_copy(record.labels.name)
    labels = stance_labels(record.labels)
    mesh = BaseMesh("full copy", copy.error_mm)
    right = stored_shape(copy.data, record.side.side)
    if copy.faces < record.info.faces:
        original = _original(record, folders, file)
        mesh = BaseMesh("original file" if original else "light copy", copy.error_mm)
        if original is not None:
            mesh = replace(mesh, error_mm=0.0)
            right = original.vertices_mm, original.faces
    shape = Shape(*right, "last", labels)
    return BaseLast(record, shape, kept_sections(shape), mesh)


def base_of_content(path: Location, file: Source) -> BaseLast | None:
    """The last of the catalogue at ``path`` that has the content of a file; None if none has.

    It is the same base as if its name were given: a last has one heel, by its name and by its file.
    A warning of its record says so.

    Raises
    ------
    UnreadableFile, CatalogueUnusable
        The file, or the catalogue, cannot be read.
    """
    own, name = content_hash(file), Path(file.path or "-").name
    try:
        with open_catalogue(path) as opened:
            records = opened.lasts().records
    except NoCatalogue:
        return None
    holders = [record.labels.name for record in records if record.info.sha256 == own]
    if not holders:
        return None
    base = stored_base(path, holders[0], file=file)
    words = f"{name} has the content of {base.name!r} in the catalogue, so its labels there count"
    notices = (*base.record.warnings, Notice(OF_CONTENT, words))
    return replace(base, record=replace(base.record, warnings=notices))


def _original(
    record: LastRecord, folders: Iterable[Path], file: Source | None = None
) -> Shape | None:
    """The right shape of the file that a last was read from; None if it is not there."""
    name = Path(record.info.path or "").name
    sources = [Source(str(folder / name)) for folder in folders if name]
    for source in [*([file] if file else []), *sources]:
        if not Path(source.path or "-").is_file() or content_hash(source) != record.info.sha256:
            continue
        side = record.side.side or "auto"
        reading = ReadingOptions(
            units=_unit(record), side=side, known_length_mm=_scaled(record), kind="last"
        )
        try:
            return profiled_source(source, reading).aligned.prepared.shape
        except FootfitError:
            continue
    return None


def _unit(record: LastRecord) -> str:
    """The unit that a stored last was read in."""
    return "auto" if record.info.units == "scaled" else record.info.units


def _scaled(record: LastRecord) -> float | None:
    """The length that a stored last was scaled to; None if its file has a unit."""
    return record.length_mm if record.info.units == "scaled" else None


def scanned_base(source: Source, reading: ReadingOptions) -> BaseLast:
    """A last in a file of its own; ``reading`` says how it stands.

    Raises
    ------
    OtherKind
        By its shape it is a foot.
    InputError, GeometryRefused
        As in reading, aligning and profiling any last.
    """
    last = scanned_last(source, reading, "base")
    if last.record.pose.kind == "foot":
        words = "its shape is a foot's, not a last's: give the last that another one is made from"
        raise OtherKind(words, source.path)
    return BaseLast(last.record, last.shape, kept_sections(last.shape), BaseMesh("file", 0.0))
