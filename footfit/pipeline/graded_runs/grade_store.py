"""A graded run in the catalogue, and the manifest that lies beside its files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, replace
from typing import Any, ClassVar

from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.rows.last_names import caseless
from footfit.catalogue.rows.requirements import require_name
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, NameTaken
from footfit.locations import Location
from footfit.meshes.copies.compact_copy import COPY_FACES, compact_copy
from footfit.pipeline.batch.manifest import COLUMNS, SHA256
from footfit.pipeline.batch.sources import Source
from footfit.pipeline.graded_runs.grade_run import Grader, reading_of
from footfit.pipeline.library.named_lasts import stored_names
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.reading import profiled_source
from footfit.pipeline.scan.standing import stance_labels
from footfit.results import Parentage, Target
from footfit.results.last_making.graded_run import GradedLast, GradedRun
from footfit.whole_files import safe_file_name


def require_storable_run(path: Location, grader: Grader, *, replace_stored: bool) -> None:
    """Refuse a run that could not be stored, before any work.

    Raises
    ------
    BadOption
        The base is not in the catalogue, or no last can have such a name.
    NameTaken
        A last of the catalogue has the name of one of the run.
    """
    for name in grader.names():
        require_name(name)
    names = stored_names(path)
    if caseless(grader.base.name) not in names:
        words = "--store needs a base of the catalogue: footfit ingest-last FILE --keep-mesh full"
        raise BadOption(words, grader.base.name)
    with open_catalogue(path) as catalogue:
        sha256 = catalogue.record(grader.base.name).info.sha256
    if sha256 != grader.base.record.info.sha256:
        words = f"--store needs a base of the catalogue, and {grader.base.name!r} has another"
        hint = "content there: footfit ingest-last FILE --keep-mesh full, by a name of its own"
        raise BadOption(f"{words} {hint}", grader.base.record.info.path)
    taken = [names[key] for name in grader.names() if (key := caseless(name)) in names]
    taken = [name for name in taken if name != grader.base.name]
    if taken and not replace_stored:
        raise NameTaken(f"{taken[0]!r} is in the catalogue: add --force, or another --family")


def store_run(path: Location, grader: Grader, run: GradedRun, *, replace_stored: bool) -> GradedRun:
    """Store the lasts of a run, all or none; return the run as it is stored.

    The base gets the family's label if it has none. The last that is the base itself is not stored.

    Raises
    ------
    NameTaken, UnknownLast, CatalogueUnusable
        A last cannot be stored.
    """
    new: list[NewLast] = []
    with open_catalogue(path, write=True, create=False) as catalogue:
        name = catalogue.name(run.base)
        for last in run.lasts:
            if is_base(last):
                continue
            reading = reading_of(grader.base, stance_labels(last.labels))
            shape = profiled_source(Source(f"{last.last}.stl", last.data, "stl"), reading)
            aligned = shape.aligned
            copy = compact_copy(aligned.vertices_mm, aligned.faces, COPY_FACES)
            sections = kept_sections(aligned.prepared.shape)
            record = last_record(shape, replace(last.labels, parent=name))
            new.append(NewLast(record, copy, sections, parentage_of_run(run, last, name)))
        catalogue.add_all(new, replace=replace_stored)
        if grader.base.record.labels.family is None:
            family = run.family
            catalogue.edit(
                name,
                lambda record, _: (
                    replace(record, labels=replace(record.labels, family=family)),
                    None,
                ),
            )
    why = f"it is the base itself, which the catalogue has as {name}"
    lasts = (
        replace(last, not_stored=why) if is_base(last) else replace(last, stored=True)
        for last in run.lasts
    )
    return replace(run, lasts=tuple(lasts))


def is_base(last: GradedLast) -> bool:
    """Whether a last of a run is the base itself."""
    return last.sizes == last.widths == 0.0


def storable_lasts(path: Location, lasts: Iterable[GradedLast]) -> Iterator[GradedLast]:
    """The lasts of a run as they are made; the first whose mesh is stored already is refused.

    Raises
    ------
    NameTaken
        The catalogue has the same mesh under another name.
    """
    with open_catalogue(path) as catalogue:
        holders = {each.info.sha256: each.labels.name for each in catalogue.lasts().records}
    for last in lasts:
        holder = holders.get(hashlib.sha256(last.data).hexdigest())
        if holder is not None and caseless(holder) != caseless(last.last) and not is_base(last):
            words = (
                f"{last.last!r} has the same mesh as {holder!r}, which is in the catalogue: take"
            )
            raise NameTaken(f"{words} that run, or give --family the name that it has")
        yield last


def parentage_of_run(run: GradedRun, last: GradedLast, base: str) -> Parentage:
    """How a last of a run was made."""
    rule = run.rule
    increments = {
        kind: {name: step.by for name, step in table.items()}
        for kind, table in (("size", rule.size), ("width", rule.width))
    }
    figures: dict[str, object] = {
        "sizes": last.sizes,
        "widths": last.widths,
        "size_system": run.size_system,
        "held": list(run.held),
        "law": rule.law,
        "rule_version": rule.version,
        "rule_sha256": rule.sha256,
        **increments,
    }
    targets = tuple(
        Target(each.name, each.unit, each.base, each.planned, each.reached)
        for each in last.shown
        if each.planned is not None
    )
    return Parentage(base, run.base_sha256, "grade", targets, figures, rule=rule.name)


class RunManifest:
    """The manifest of a run's files, as a table that `ingest-last --manifest` takes."""

    columns: ClassVar[tuple[str, ...]] = COLUMNS

    def __init__(self, lasts: Iterable[GradedLast], side: str | None) -> None:
        self._lasts, self._side = tuple(lasts), side

    def rows(self) -> list[dict[str, Any]]:
        """A row for each last."""
        return [self._row(last) for last in self._lasts]

    def _row(self, last: GradedLast) -> dict[str, Any]:
        labels: Mapping[str, object] = {
            each.name: getattr(last.labels, each.name) for each in fields(last.labels)
        }
        own = {"path": safe_file_name(last.last, ".stl"), "side": self._side, "units": "mm"}
        own[SHA256] = hashlib.sha256(last.data).hexdigest()
        values = {**labels, **own}
        return {
            name: round(value, 3) if isinstance(value := values[name], float) else value
            for name in self.columns
        }
