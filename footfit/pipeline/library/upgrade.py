"""Upgrade: bring an older catalogue to this version's schema, flare definition and measures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.geometry.flare.definition import FlareDefinition
from footfit.locations import Location
from footfit.pipeline.batch.runs import HERE, outcomes
from footfit.pipeline.library.lasts import has_other_measures
from footfit.pipeline.library.measured_copy import MeasuredCopy, measured_copy, with_measured
from footfit.results import LastRecord, MeshCopy, Notice, UpgradeOutcome
from footfit.results.values import count_notice

AT_A_TIME = 256
"""Mesh copies that are held in memory; each is 60 kB, or a few MB if the whole mesh is kept."""


@dataclass(frozen=True, slots=True)
class StoredMesh:
    """A mesh copy to measure again; ``path`` names the last in errors."""

    path: str
    copy: MeshCopy
    record: LastRecord
    reprofile: bool


Count = Callable[[int, int], None]
"""It gets how many lasts are done, and how many there are to do."""


def upgrade(
    path: Location, jobs: int = HERE, count: Count = lambda _done, _total: None
) -> UpgradeOutcome:
    """Bring the schema up to date, and every last that was measured by other definitions.

    A copy of the file is kept beside it if its schema changes. Everything is measured from the
    catalogue's own mesh copies, and each last is stored by itself: an upgrade that is interrupted
    goes on with the lasts that are left. A profile says which definition it replaces.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be written; it is then as it was.
    """
    with open_catalogue(path, write=True, create=False, upgrade=True) as catalogue:
        older = _older(catalogue)
        names = [record.labels.name for record, _ in older]
        with_copy = frozenset(catalogue.mesh_copy_names())
        work = [(record, again) for record, again in older if record.labels.name in with_copy]
        failures = {
            name: f"{name!r} was stored without its mesh: ingest its file again with --replace"
            for name in names
            if name not in with_copy
        }
        count(0, len(work))
        for start in range(0, len(work), AT_A_TIME):
            chunk = work[start : start + AT_A_TIME]
            for done, failure in enumerate(_renew(catalogue, chunk, jobs), start + 1):
                count(done, len(work))
                failures |= failure
        blocks, revisions = catalogue.renew_blocks(), catalogue.revisions
    noun = "block was" if blocks == 1 else "blocks were"
    return UpgradeOutcome(
        path=str(path),
        revision_before=revisions.before,
        revision_after=revisions.after,
        definition=FlareDefinition().version,
        recomputed=tuple(name for name in names if name not in failures),
        backup=None if revisions.backup is None else str(revisions.backup),
        left=tuple(name for name in names if name in failures),
        warnings=(
            *(Notice("not_upgraded", words) for words in failures.values()),
            *count_notice(
                "blocks_renewed", blocks, f"search {noun} made anew from the lasts' rows"
            ),
        ),
    )


def _older(catalogue: Catalogue) -> list[tuple[LastRecord, bool]]:
    """The lasts that were measured by other definitions, and whether each needs a new profile."""
    stored, cut = catalogue.lasts(), frozenset(catalogue.section_names())
    outdated = frozenset(stored.outdated)
    return [
        (record, record.labels.name in outdated)
        for record in stored.records
        if record.labels.name in outdated
        or has_other_measures(record)
        or record.labels.name not in cut
    ]


def _renew(
    catalogue: Catalogue, work: Sequence[tuple[LastRecord, bool]], jobs: int
) -> Iterator[dict[str, str]]:
    """Measure lasts again and store each; yield for each why it fails, by its name, or nothing."""
    meshes = [
        StoredMesh(name, catalogue.mesh_copy(name), record, again)
        for record, again in work
        for name in (record.labels.name,)
    ]
    for outcome in outcomes(_measured_again, meshes, jobs):
        record, new = outcome.item.record, outcome.value
        if new is None:
            yield {record.labels.name: f"{record.labels.name!r} stays as it is: {outcome.error}"}
            continue
        catalogue.update_measured(with_measured(record, new), new.sections)
        yield {}


def _measured_again(mesh: StoredMesh) -> MeasuredCopy:
    """The slow part of an upgrade. It does not use the catalogue, and runs in a worker."""
    return measured_copy(mesh.record, mesh.copy, reprofile=mesh.reprofile)
