"""Ingest: read, align and profile scans of lasts, and store each in its own transaction."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Literal

from footfit.catalogue.rows.last_names import caseless, composed, differs_in_case
from footfit.catalogue.rows.requirements import same_scan
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, ExitCode, FootfitError, NameTaken, NoCatalogue
from footfit.locations import Location
from footfit.number_words import first_names
from footfit.pipeline.batch.runs import HERE, Jobs, Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.manifest import LABEL_HEIGHTS, ManifestRow
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.reading import content_hash, profiled_source
from footfit.results import (
    IngestOutcome,
    LastLabels,
    LastRecord,
    MeshCopy,
    Notice,
    ShapeSections,
    SideName,
)
from footfit.whole_files import require_folder

KeepMesh = Literal["compact", "full"]
SAME_LENGTH_MM = 0.01
"""Two known lengths that differ by less are the same: a measuring stick shows whole mm."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One file to ingest, with its labels and how to read it."""

    source: Source
    labels: LastLabels
    reading: ReadingOptions

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""
        return self.source.path


@dataclass(frozen=True, slots=True)
class NewLast:
    """A last that can be stored; if its content is known, it has only the hash."""

    sha256: str
    record: LastRecord | None = None
    copy: MeshCopy | None = None
    sections: ShapeSections | None = None


HoldSignals = Callable[[], AbstractContextManager[object]]
"""Makes a block that no signal interrupts: what is stored in it is also reported in it."""


def entries(
    sources: Sequence[Source],
    manifest: Sequence[ManifestRow],
    given: LastLabels,
    reading: ReadingOptions,
) -> list[Entry]:
    """Join files with their labels, sorted by path; without files, the manifest names them.

    A label in the manifest overrides one of the command line (``given``). A name that was typed
    (``given.name``, "" for none) overrides all. Rows of files that are not among the sources have
    no effect: see `unused_rows`.

    Raises
    ------
    BadOption
        There is nothing to ingest, ``--name`` is given for several files, or standard input has
        no name.
    """
    rows = {_resolved(row.path): row for row in manifest}
    if manifest and not sources:
        sources = [Source(row.path) for row in manifest]
    if not sources:
        raise BadOption("nothing to ingest; name files, a folder or a --manifest")
    if given.name and len(sources) > 1:
        raise BadOption("--name names one last, and there are several files; use --manifest")
    ordered = sorted(sources, key=lambda source: source.path or "")
    return [_entry(item, rows.get(_resolved(item.path or "")), given, reading) for item in ordered]


def unused_rows(batch: Sequence[Entry], manifest: Sequence[ManifestRow]) -> tuple[Notice, ...]:
    """A notice if the manifest has rows of files that were not given: a path may be mistyped."""
    given = {_resolved(entry.path) for entry in batch if entry.path}
    named = {_resolved(row.path) for row in manifest}
    unused = [row.path for row in manifest if _resolved(row.path) not in given]
    if not unused:
        return ()
    words = f"the manifest also names {first_names(unused, 1)}, not among the files given"
    if not given & named:
        words += "; it names none of those, so they get no labels: its paths start at its folder"
    return (Notice("manifest_rows_unused", words),)


def _resolved(path: str) -> str:
    return str(Path(path).resolve())


def _entry(
    source: Source, row: ManifestRow | None, given: LastLabels, reading: ReadingOptions
) -> Entry:
    labels = row.labels if row else LastLabels(name=Path(source.path).stem if source.path else "")
    name = given.name or labels.name
    if not name:
        raise BadOption("a last from standard input needs --name")
    own = {key: value for key, value in dataclasses.asdict(labels).items() if value is not None}
    labels = dataclasses.replace(given, **(own | {"name": name}))
    if row is not None:
        units = row.reading.units if row.reading.units != "auto" else reading.units
        side = row.reading.side if row.reading.side != "auto" else reading.side
        reading = dataclasses.replace(reading, units=units, side=side)
    said = {name: getattr(labels, name) for name in LABEL_HEIGHTS}
    reading = dataclasses.replace(reading, **said)
    return Entry(source, labels, reading)


def new_last(entry: Entry, keep_mesh: KeepMesh = "compact") -> NewLast:
    """The slow part of an ingest. It does not use the catalogue, and runs in a worker.

    ``keep_mesh`` "full" keeps every face of the mesh.
    """
    from footfit.meshes.copies.compact_copy import COPY_FACES, compact_copy

    shape = profiled_source(entry.source, entry.reading)
    faces = shape.aligned.faces
    target = len(faces) if keep_mesh == "full" else COPY_FACES
    copy = compact_copy(shape.aligned.vertices_mm, faces, target)
    sections = kept_sections(shape.aligned.prepared.shape)
    record = last_record(shape, entry.labels)
    return NewLast(record.info.sha256, record, copy, sections)


@dataclass(frozen=True, slots=True)
class Held:
    """What an ingest must know of a stored last: few bytes, however many lasts there are."""

    labels: LastLabels
    sha256: str
    units: str
    lengths_mm: tuple[float | None, float]
    side: SideName | None
    flare_angle_deg: float


def held_last(record: LastRecord) -> Held:
    """What is known of a last; older versions scaled its extent and not its length."""
    info, side, lengths_mm = record.info, record.side.side, (record.length_mm, record.extent_mm)
    angle_deg = record.flare.angle_deg
    return Held(record.labels, info.sha256, info.units, lengths_mm, side, angle_deg)


class Holdings:
    """The lasts of the catalogue, kept up to date during a batch (also in a dry run).

    A name is the same however its accents are written. One that differs in case is not, and is
    refused.
    """

    def __init__(self, records: Iterable[LastRecord]) -> None:
        self.by_name: dict[str, Held] = {}
        self.by_content: dict[str, str] = {}
        self.spellings: dict[str, str] = {}
        for record in records:
            self.put(record)

    def put(self, record: LastRecord) -> None:
        """Add a last, or replace the one of its name."""
        name = composed(record.labels.name)
        old = self.by_name.get(name)
        if old is not None:
            self.by_content.pop(old.sha256, None)
        self.by_name[name] = held_last(record)
        self.by_content[record.info.sha256] = record.labels.name
        self.spellings[caseless(name)] = record.labels.name

    def named(self, name: str) -> Held | None:
        """The last of that name.

        Raises
        ------
        NameTaken
            There is none, but one whose name differs only in case.
        """
        record, spelling = self.by_name.get(composed(name)), self.spellings.get(caseless(name))
        if record is None and spelling is not None:
            raise differs_in_case(spelling)
        return record

    def status(self, sha256: str, entry: Entry, *, replace: bool) -> str:
        """What becomes of a file with that content: "added", "unchanged" or "replaced".

        Raises
        ------
        NameTaken
            Another last has the name, or the content is stored under another name.
        """
        holder, name = self.by_content.get(sha256), entry.labels.name
        if holder is not None and composed(holder) != composed(name):
            raise same_scan(holder)
        old = self.named(name)
        if old is None:
            return "added"
        labels = dataclasses.replace(entry.labels, name=old.labels.name, parent=old.labels.parent)
        same = holder is not None
        if same and old.labels == labels and _reads_alike(old, entry.reading):
            return "unchanged"
        if replace:
            return "replaced"
        scan = "another scan"
        if same:
            difference = "read otherwise" if old.labels == labels else "with other labels"
            scan = f"the same scan {difference}"
        raise NameTaken(f"{name!r} is in the catalogue with {scan}; add --replace or --name")


def _reads_alike(old: Held, reading: ReadingOptions) -> bool:
    """Whether these options would read the stored scan as it was read."""
    known = reading.known_length_mm
    length = known is None or any(abs(known - mm) < SAME_LENGTH_MM for mm in old.lengths_mm if mm)
    units = reading.units in ("auto", old.units)
    return length and units and reading.side in ("auto", old.side)


def ingest(
    batch: Sequence[Entry],
    path: Location,
    *,
    jobs: Jobs = HERE,
    replace: bool = False,
    dry_run: bool = False,
    keep_mesh: KeepMesh = "compact",
    hold_signals: HoldSignals = nullcontext,
) -> Iterator[IngestOutcome]:
    """Ingest a batch into the catalogue at ``path``; yield each file's outcome after its commit.

    ``keep_mesh`` "full" keeps every face of a mesh; with ``replace`` also of a last that is stored
    with a lighter copy. A missing catalogue is made when there is a last to store; its folder is
    not. Signals are held off by ``hold_signals`` from before a commit until the next outcome is
    asked for.

    Raises
    ------
    CatalogueUnusable, BadOption
        The catalogue cannot be opened or written; its folder is missing.
    """
    with ExitStack() as stack:
        catalogue = None if dry_run else _existing(path, stack)
        holdings = _stored_lasts(path) if catalogue is None else Holdings(catalogue.each_last())
        known = frozenset() if replace else frozenset(holdings.by_content)
        work_on = partial(new_last, keep_mesh=keep_mesh)
        made = None
        for work in outcomes(work_on, batch, jobs, known=partial(_known_last, known)):
            with hold_signals():
                if catalogue is None and not dry_run and work.value is not None:
                    catalogue = stack.enter_context(open_catalogue(path, write=True))
                    holdings = Holdings(catalogue.each_last())
                    made = str(path) if catalogue.revisions.made else None
                outcome = _store(work, holdings, catalogue, replace=replace, keep_mesh=keep_mesh)
                yield dataclasses.replace(outcome, dry_run=dry_run, new_catalogue=made)
                made = None


def _existing(path: Location, stack: ExitStack) -> Catalogue | None:
    """The catalogue, open for writing; None if there is none: it is made for a last to store."""
    is_file = isinstance(path, Path)
    if isinstance(path, Path) and not path.exists():
        require_folder(path)
        return None
    try:
        return stack.enter_context(open_catalogue(path, write=True, create=is_file))
    except NoCatalogue:
        return None


def _known_last(known: frozenset[str], entry: Entry) -> NewLast | None:
    """The last of a file whose content hash the catalogue has: it is not aligned again."""
    sha256 = content_hash(entry.source)
    return NewLast(sha256) if sha256 in known else None


def _stored_lasts(path: Location) -> Holdings:
    """The lasts of a catalogue; none if there is no catalogue."""
    try:
        with open_catalogue(path) as catalogue:
            return Holdings(catalogue.each_last())
    except NoCatalogue:
        return Holdings(())


def _store(
    work: Outcome[Entry, NewLast],
    holdings: Holdings,
    catalogue: Catalogue | None,
    *,
    replace: bool,
    keep_mesh: KeepMesh,
) -> IngestOutcome:
    """Store what the work on one file made, and say what became of the file; None is a dry run."""
    entry, new = work.item, work.value
    again = replace and keep_mesh == "full"  # its copy may be a lighter one
    name, path = entry.labels.name, entry.path
    if new is None:
        return IngestOutcome(path, "refused", failure=work.error)
    try:
        status = holdings.status(new.sha256, entry, replace=replace)
        held = holdings.named(name)
        if held is not None and status == "unchanged" and not again:
            return _unchanged(path, held)
        if new.record is None:  # it was known when the batch began, and is not any more
            new = new_last(entry, keep_mesh)
        assert new.record is not None
        first = not holdings.by_name
        if catalogue is not None:
            try:
                catalogue.add(new.record, new.copy, new.sections, replace=replace)
            except NameTaken:  # another process stored it meanwhile: look again, and say so
                holdings = Holdings(catalogue.each_last())
                status = holdings.status(new.sha256, entry, replace=replace)
                held = holdings.named(name)
                if held is None:  # the last of that name is damaged
                    raise
                return _unchanged(path, held)
        holdings.put(new.record)
        status = "replaced" if status == "unchanged" else status
    except FootfitError as error:
        if error.exit == ExitCode.CATALOGUE_UNUSABLE:
            raise
        return IngestOutcome(path, "refused", failure=error.at(path))
    done = _unchanged(path, held_last(new.record))
    warnings, info = new.record.notices, new.record.info
    return dataclasses.replace(done, status=status, warnings=warnings, reference=first, info=info)


def _unchanged(path: str | None, held: Held) -> IngestOutcome:
    return IngestOutcome(
        path=path,
        status="unchanged",
        last=held.labels.name,
        side=held.side,
        flare_angle_deg=held.flare_angle_deg,
    )
