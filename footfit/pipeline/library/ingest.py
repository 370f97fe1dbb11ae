"""Ingest: read, align and profile scans of lasts, and store them, those that are ready together."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Literal

from footfit.catalogue.group_commit import GROUP, KnownLasts, NewLast
from footfit.catalogue.rows.last_names import composed
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import ExitCode, FootfitError, NameTaken, NoCatalogue
from footfit.locations import Location
from footfit.pipeline.batch.runs import HERE, Jobs, Outcome, outcome_groups
from footfit.pipeline.batch.sources import content_hash
from footfit.pipeline.library.entries import Entry
from footfit.pipeline.library.holdings import Held, Holdings, held_last
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import IngestOutcome, LastRecord, Notice
from footfit.whole_files import require_folder

KeepMesh = Literal["compact", "full"]
COMPACT = Notice(
    "compact_copy", "its stored copy is compact; add --replace to store the whole mesh"
)


@dataclass(frozen=True, slots=True)
class ReadyLast:
    """What the work on a file made; if its content is known, it has only the hash."""

    sha256: str
    last: NewLast | None = None


HoldSignals = Callable[[], AbstractContextManager[object]]
"""Makes a block that no signal interrupts: what is stored in it is also reported in it."""


def ready_last(entry: Entry) -> ReadyLast:
    """The slow part of an ingest. It does not use the catalogue, and runs in a worker."""
    from footfit.meshes.copies.compact_copy import COPY_FACES, compact_copy

    shape = profiled_source(entry.source, entry.reading)
    faces = shape.aligned.faces
    target = len(faces) if entry.whole_mesh else COPY_FACES
    copy = compact_copy(shape.aligned.vertices_mm, faces, target)
    sections = kept_sections(shape.aligned.prepared.shape)
    record = last_record(shape, entry.labels)
    return ReadyLast(record.info.sha256, NewLast(record, copy, sections))


def ingest(
    batch: Sequence[Entry],
    path: Location,
    *,
    jobs: Jobs = HERE,
    replace: bool = False,
    dry_run: bool = False,
    keep_mesh: KeepMesh | None = None,
    hold_signals: HoldSignals = nullcontext,
) -> Iterator[IngestOutcome]:
    """Ingest a batch into the catalogue at ``path``; yield each file's outcome after its commit.

    Lasts that are ready at the same time share a commit; one that is ready alone does not wait.
    ``keep_mesh`` "full" keeps every face of a mesh; with ``replace`` also of a last that is stored
    with a lighter copy. None keeps a compact copy, but the whole mesh of a last that replaces one
    with its whole mesh. A missing catalogue is made when there is a last to store; its folder is
    not. Signals are held off by ``hold_signals`` from before a commit until all of its outcomes
    were asked for, and the next one is.

    Raises
    ------
    CatalogueUnusable, BadOption
        The catalogue cannot be opened or written; its folder is missing.
    """
    with ExitStack() as stack:
        catalogue = None if dry_run else _existing(path, stack)
        how = _How(replace, dry_run, keep_mesh)
        holdings = _stored_lasts(path, how) if catalogue is None else how.holdings(catalogue)
        known = frozenset() if replace else frozenset(holdings.by_content)
        batch = [_with_copy(entry, how, holdings) for entry in batch]
        storing = _Storing(path, stack, how, catalogue, holdings)
        ready_groups = outcome_groups(
            ready_last,
            batch,
            jobs,
            known=partial(_known_last, known),
            most=GROUP.most_lasts,
            longest_s=GROUP.longest_s,
        )
        for ready in ready_groups:
            with hold_signals():
                answers = storing.together(ready)
                yield from answers
            for work in ready[len(answers) :]:
                with hold_signals():
                    yield storing.alone(work)


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


def _known_last(known: frozenset[str], entry: Entry) -> ReadyLast | None:
    """The last of a file whose content hash the catalogue has: it is not aligned again."""
    sha256 = content_hash(entry.source)
    return ReadyLast(sha256) if sha256 in known else None


def _stored_lasts(path: Location, how: _How) -> Holdings:
    """The lasts of a catalogue; none if there is no catalogue."""
    try:
        with open_catalogue(path) as catalogue:
            return how.holdings(catalogue)
    except NoCatalogue:
        return Holdings(())


@dataclass(frozen=True, slots=True)
class _How:
    """The options of an ingest that say what is stored."""

    replace: bool
    dry_run: bool
    keep_mesh: KeepMesh | None

    def holdings(self, catalogue: Catalogue) -> Holdings:
        """What the catalogue holds; which copies are whole only if that can matter."""
        matters = self.replace or self.keep_mesh == "full"
        whole = catalogue.whole_mesh_names() if matters else frozenset[str]()
        return Holdings(catalogue.each_last(), whole)


def _with_copy(entry: Entry, how: _How, holdings: Holdings) -> Entry:
    """The entry, with which copy is kept of its mesh: a last does not lose its whole mesh."""
    held = holdings.by_name.get(composed(entry.labels.name)) if how.keep_mesh is None else None
    whole = how.keep_mesh == "full" or (held is not None and held.whole_mesh)
    return dataclasses.replace(entry, whole_mesh=whole)


@dataclass(slots=True)
class _Storing:
    """The catalogue of an ingest, which is opened when there is a last to store, and what it has.

    ``made`` names a catalogue that was made, until an outcome says so.
    """

    path: Location
    stack: ExitStack
    how: _How
    catalogue: Catalogue | None
    holdings: Holdings
    known: KnownLasts = dataclasses.field(default_factory=KnownLasts)
    made: str | None = None

    def together(self, ready: Sequence[Outcome[Entry, ReadyLast]]) -> list[IngestOutcome]:
        """Store what the work on some files made in one commit, and say what became of each.

        If one of them cannot be stored, none is, and the list is empty.
        """
        planned = [self._planned(work) for work in ready]
        lasts = [last for _, last in planned if last is not None]
        if lasts and self.catalogue is not None:
            replace = self.how.replace
            if not self.catalogue.add_together(lasts, self.known, replace=replace):
                self.holdings = self.how.holdings(self.catalogue)
                return []
        pairs = zip(ready, planned, strict=True)
        return [self._answer(work, outcome) for work, (outcome, _) in pairs]

    def alone(self, work: Outcome[Entry, ReadyLast]) -> IngestOutcome:
        """Store what the work on one file made, and say what became of the file."""
        outcome, last = self._planned(work)
        if last is not None and self.catalogue is not None:
            try:
                self.catalogue.add(*last, replace=self.how.replace)
            except FootfitError as error:
                if error.exit == ExitCode.CATALOGUE_UNUSABLE:
                    raise
                self.holdings = self.how.holdings(self.catalogue)
                outcome = self._not_added(work, last.record, error)
        return self._answer(work, outcome)

    def _not_added(
        self, work: Outcome[Entry, ReadyLast], record: LastRecord, error: FootfitError
    ) -> IngestOutcome:
        """What became of a last that the catalogue refused: another process may have stored it."""
        entry = work.item
        try:
            if not isinstance(error, NameTaken):
                raise error
            self.holdings.status(record.info.sha256, entry, replace=self.how.replace)
            held = self.holdings.named(entry.labels.name)
            if held is None:  # the last of that name is damaged
                raise error
            return _unchanged(entry.path, held)
        except FootfitError as refusal:
            return IngestOutcome(entry.path, "refused", failure=refusal.at(entry.path))

    def _planned(self, work: Outcome[Entry, ReadyLast]) -> tuple[IngestOutcome, NewLast | None]:
        """What becomes of a file, and the last to store for it; the holdings have it already."""
        entry, ready, how = work.item, work.value, self.how
        again = how.replace and how.keep_mesh == "full"  # its copy may be a lighter one
        if ready is None:
            return IngestOutcome(entry.path, "refused", failure=work.error), None
        self._open()
        try:
            status = self.holdings.status(ready.sha256, entry, replace=how.replace)
            held = self.holdings.named(entry.labels.name)
            if held is not None and status == "unchanged" and not again:
                compact = how.keep_mesh == "full" and not held.whole_mesh
                unchanged = _unchanged(entry.path, held)
                return dataclasses.replace(unchanged, warnings=(COMPACT,) * compact), None
            # a last that was known when the batch began may not be there any more
            last = ready.last or ready_last(entry).last
        except FootfitError as error:
            return IngestOutcome(entry.path, "refused", failure=error.at(entry.path)), None
        assert last is not None
        outcome = dataclasses.replace(
            _unchanged(entry.path, held_last(last.record)),
            status="replaced" if status == "unchanged" else status,
            warnings=last.record.notices,
            reference=not self.holdings.by_name,
            info=last.record.info,
        )
        whole = last.copy is not None and last.copy.faces >= last.record.info.faces
        self.holdings.put(last.record, whole_mesh=whole)
        return outcome, last

    def _open(self) -> None:
        """Open the catalogue if it is not open, unless nothing is to be stored."""
        if self.catalogue is not None or self.how.dry_run:
            return
        self.catalogue = self.stack.enter_context(open_catalogue(self.path, write=True))
        self.holdings = self.how.holdings(self.catalogue)
        self.made = str(self.path) if self.catalogue.revisions.made else None

    def _answer(self, work: Outcome[Entry, ReadyLast], outcome: IngestOutcome) -> IngestOutcome:
        """The outcome, with what is said of the whole batch."""
        made = None
        if work.value is not None:
            made, self.made = self.made, None
        return dataclasses.replace(outcome, dry_run=self.how.dry_run, new_catalogue=made)


def _unchanged(path: str | None, held: Held) -> IngestOutcome:
    return IngestOutcome(
        path=path,
        status="unchanged",
        last=held.labels.name,
        side=held.side,
        flare_angle_deg=held.flare_angle_deg,
    )
