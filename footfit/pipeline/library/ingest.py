"""Ingest: scans of lasts, read, aligned, profiled and stored, each in its own transaction."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from footfit.catalogue.store import open_catalogue
from footfit.errors import (
    BadOption,
    ExitCode,
    FootfitError,
    NameTaken,
    NoCatalogue,
)
from footfit.pipeline.batch.runs import HERE, Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.manifest import ManifestRow
from footfit.pipeline.scan.measure import suspects
from footfit.pipeline.scan.reading import content_hash, profiled_source
from footfit.pipeline.scan.settled_unit import unit_notes
from footfit.results import IngestOutcome, LastLabels, LastRecord, MeshCopy, Notice, Profiled

SAME_LENGTH_MM = 0.01
"""A known length is the stored one where they differ by less: a stick shows whole mm."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One file to ingest, with what people say of it."""

    source: Source
    labels: LastLabels
    reading: ReadingOptions

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""
        return self.source.path


@dataclass(frozen=True, slots=True)
class Prepared:
    """A last ready to be stored; ``record`` is None where its content is in the catalogue."""

    sha256: str
    record: LastRecord | None
    copy: MeshCopy | None


Steady = Callable[[], AbstractContextManager[object]]
"""A block that no signal may part: what is stored in it is also said in it."""


class Shelf(Protocol):
    """What ingest needs of a catalogue."""

    def add(self, record: LastRecord, copy: MeshCopy) -> None:
        """Store a last in one transaction."""

    def replace(self, record: LastRecord, copy: MeshCopy) -> None:
        """Store a last over the one of its name, in one transaction."""

    def records(self) -> Sequence[LastRecord]:
        """Every last."""


def entries(
    sources: Sequence[Source],
    manifest: Sequence[ManifestRow],
    given: LastLabels,
    reading: ReadingOptions,
) -> list[Entry]:
    """Join files with their labels, in sorted path order; a manifest alone names its files.

    A label in the manifest wins over one on the command line (``given``); a typed name
    (``given.name``, "" where none was) wins over all. Rows of files that are not among the
    sources are left alone: see `unused_rows`.

    Raises
    ------
    BadOption
        Nothing to ingest, one ``--name`` for several files, or standard input without a name.
    """
    rows = {_resolved(row.path): row for row in manifest}
    if manifest and not sources:
        sources = [Source(row.path) for row in manifest]
    if not sources:
        raise BadOption("nothing to ingest; name files, a folder or a --manifest")
    if given.name and len(sources) > 1:
        raise BadOption("--name names one last, and there are several files; use --manifest")
    ordered = sorted(sources, key=lambda source: source.path or "")
    return [_entry(one, rows.get(_resolved(one.path or "")), given, reading) for one in ordered]


def unused_rows(batch: Sequence[Entry], manifest: Sequence[ManifestRow]) -> tuple[Notice, ...]:
    """Rows of the manifest whose file was not given: said, since a path may be mistyped."""
    given = {_resolved(entry.path) for entry in batch if entry.path}
    unused = [row.path for row in manifest if _resolved(row.path) not in given]
    if not unused:
        return ()
    more = f" and {len(unused) - 1} more" if len(unused) > 1 else ""
    words = f"the manifest also names {unused[0]}{more}, not among the files given"
    return (Notice("manifest_rows_unused", words),)


def _resolved(path: str) -> str:
    return str(Path(path).resolve())


def _entry(
    source: Source, row: ManifestRow | None, given: LastLabels, reading: ReadingOptions
) -> Entry:
    stem = Path(source.path).stem if source.path else ""
    said = row.labels if row else LastLabels(name=stem)
    name = given.name or said.name
    if not name:
        raise BadOption("a last from standard input needs --name")
    labels = LastLabels(
        name=name,
        style=said.style or given.style,
        size=said.size or given.size,
        size_system=said.size_system or given.size_system,
        width_label=said.width_label or given.width_label,
        heel_height_mm=given.heel_height_mm if said.heel_height_mm is None else said.heel_height_mm,
        family=given.family,
        parent=given.parent,
    )
    if row is None:
        return Entry(source, labels, reading)
    units = row.reading.units if row.reading.units != "auto" else reading.units
    side = row.reading.side if row.reading.side != "auto" else reading.side
    return Entry(source, labels, ReadingOptions(units, reading.known_length_mm, side))


def prepared(entry: Entry, known: frozenset[str] = frozenset()) -> Prepared:
    """The heavy part of one ingest, without the catalogue: runs in a worker.

    ``known`` holds the content hashes that the catalogue has: they need no second alignment.
    """
    from footfit.meshes.copies.compact_copy import compact_copy

    sha256 = content_hash(entry.source)
    if sha256 in known:
        return Prepared(sha256, None, None)
    shape = profiled_source(entry.source, entry.reading)
    copy = compact_copy(shape.aligned.vertices_mm, shape.aligned.faces)
    return Prepared(sha256, last_record(shape, entry.labels), copy)


def last_record(shape: Profiled, labels: LastLabels) -> LastRecord:
    """A profiled shape as a last of the catalogue; the file's folder is not kept."""
    alignment = shape.aligned.alignment
    kind = alignment.pose.kind
    notices = (*alignment.warnings, *shape.suspects)
    if kind == "last":
        notices = (*notices, *suspects(shape.measures, kind))
    if kind == "foot":
        looks = Notice("looks_like_a_foot", "its shape is nearer to a foot's than to a last's")
        notices = (*notices, looks)
    return LastRecord(
        labels=labels,
        info=alignment.info,
        side=alignment.side,
        pose=alignment.pose,
        eigenframe=alignment.eigenframe,
        printed_frame=alignment.printed_frame,
        canonical_transform=alignment.canonical_transform,
        paper_transform=None,
        extent_mm=alignment.extent_mm,
        flare=shape.flare,
        measures=shape.measures,
        warnings=notices,
    )


@dataclass(slots=True)
class _Index:
    """What the catalogue holds, kept true while a batch goes on (also in a dry run)."""

    by_name: dict[str, LastRecord]
    by_content: dict[str, str]

    @classmethod
    def of(cls, records: Iterable[LastRecord]) -> _Index:
        index = cls({}, {})
        for record in records:
            index.put(record)
        return index

    def put(self, record: LastRecord) -> None:
        old = self.by_name.get(record.labels.name)
        if old is not None:
            self.by_content.pop(old.info.sha256, None)
        self.by_name[record.labels.name] = record
        self.by_content[record.info.sha256] = record.labels.name


def ingest(
    batch: Sequence[Entry],
    path: Path,
    *,
    jobs: int = HERE,
    replace: bool = False,
    dry_run: bool = False,
    steady: Steady = nullcontext,
) -> Iterator[IngestOutcome]:
    """Ingest a batch into the catalogue at ``path``, which is made where there is none.

    ``steady`` holds signals off from before a commit until the next outcome is asked for.

    Raises
    ------
    CatalogueUnusable
        The catalogue cannot be opened or written.
    """
    if dry_run:
        try:
            with open_catalogue(path) as catalogue:
                stored = list(catalogue.records())
        except NoCatalogue:
            stored = []
        for outcome in ingested(batch, None, stored, jobs=jobs, replace=replace):
            yield dataclasses.replace(outcome, dry_run=True)
        return
    with open_catalogue(path, write=True) as catalogue:
        stored = list(catalogue.records())
        yield from ingested(batch, catalogue, stored, jobs=jobs, replace=replace, steady=steady)


def ingested(
    batch: Sequence[Entry],
    shelf: Shelf | None,
    stored: Sequence[LastRecord],
    *,
    jobs: int = HERE,
    replace: bool = False,
    steady: Steady = nullcontext,
) -> Iterator[IngestOutcome]:
    """Ingest a batch; yield each file's outcome after its commit.

    ``shelf`` None is a dry run; ``stored`` are the records that are there already.
    """
    index = _Index.of(stored)
    work = partial(prepared, known=frozenset() if replace else frozenset(index.by_content))
    for outcome in outcomes(work, batch, jobs):
        with steady():
            yield _stored(outcome, index, shelf, replace)


def _stored(
    outcome: Outcome[Entry, Prepared], index: _Index, shelf: Shelf | None, replace: bool
) -> IngestOutcome:
    entry, path = outcome.item, outcome.item.path
    if outcome.value is None:
        assert outcome.error is not None
        return IngestOutcome(path, "refused", failure=outcome.error)
    try:
        status = _decided(outcome.value, entry, index, replace)
        if status == "unchanged":
            return _accepted(path, status, index.by_name[entry.labels.name], first=False)
        record, copy = _whole(outcome.value, entry)
        first = not index.by_name
        if shelf is not None:
            try:
                (shelf.replace if replace else shelf.add)(record, copy)
            except NameTaken:  # another process stored it meanwhile: look again, and say so
                index = _Index.of(shelf.records())
                status = _decided(outcome.value, entry, index, replace)
                return _accepted(path, status, index.by_name[entry.labels.name], first=False)
        index.put(record)
    except FootfitError as error:
        if error.exit == ExitCode.CATALOGUE_UNUSABLE:
            raise
        return IngestOutcome(path, "refused", failure=error.at(path))
    return _accepted(path, status, record, first=first)


def _decided(one: Prepared, entry: Entry, index: _Index, replace: bool) -> str:
    return decision(one.sha256, entry, index.by_name, index.by_content, replace)


def _whole(one: Prepared, entry: Entry) -> tuple[LastRecord, MeshCopy]:
    """The record and the mesh; made now where the content was known when the batch began, and
    its last has been replaced since.
    """
    if one.record is None or one.copy is None:
        one = prepared(entry)
    assert one.record is not None
    assert one.copy is not None
    return one.record, one.copy


def decision(
    sha256: str,
    entry: Entry,
    by_name: Mapping[str, LastRecord],
    by_content: Mapping[str, str],
    replace: bool,
) -> str:
    """What to do with a prepared last: "added", "unchanged" or "replaced".

    Raises
    ------
    NameTaken
        The name is another last's, or the content is stored under another name.
    """
    labels = entry.labels
    holder = by_content.get(sha256)
    if holder is not None and holder != labels.name:
        raise NameTaken(f"the same scan is in the catalogue as {holder!r}; nothing was stored")
    old = by_name.get(labels.name)
    if old is None:
        return "added"
    same = holder == labels.name
    if same and old.labels == labels and _reads_alike(old, entry.reading):
        return "unchanged"
    if replace:
        return "replaced"
    what = "another scan"
    if same:
        what = f"the same scan {'read otherwise' if old.labels == labels else 'with other labels'}"
    raise NameTaken(f"{labels.name!r} is in the catalogue with {what}; add --replace or --name")


def _reads_alike(old: LastRecord, reading: ReadingOptions) -> bool:
    """Would the options given read the stored scan as it was read?"""
    known = reading.known_length_mm
    scaled_mm = (old.length_mm, old.extent_mm)  # older versions scaled the extent
    length = known is None or any(abs(known - mm) < SAME_LENGTH_MM for mm in scaled_mm if mm)
    units = reading.units in ("auto", old.info.units)
    return length and units and reading.side in ("auto", old.side.side)


def _accepted(path: str | None, status: str, record: LastRecord, *, first: bool) -> IngestOutcome:
    return IngestOutcome(
        path=path,
        status=status,
        last=record.labels.name,
        side=record.side.side,
        flare_angle_deg=record.flare.angle_deg,
        warnings=record.warnings if status != "unchanged" else (),
        reference=first,
        notes=unit_notes(record.info, record.length_mm) if status != "unchanged" else (),
    )
