"""The lasts of a catalogue, as commands list them and as a match is asked of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from footfit.catalogue.file.opening import FIRST_STEPS
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, EmptyCatalogue
from footfit.geometry.measures.measure_table import of_kind
from footfit.geometry.pose.paper_frame import paper_frame_angle_deg
from footfit.results import LastRecord, Library, Notice, StoredLast
from footfit.results.library import SORTS
from footfit.results.values import notices_about


def list_lasts(path: Path, sort: str = "name", **labels: str | None) -> Library:
    """Every intact last, whatever its definition; a warning names each damaged one.

    ``labels`` filter: ``style``, ``size``, ``width_label`` and ``family``. ``sort`` is one of
    `SORTS`.

    Raises
    ------
    BadOption
        There is no such order.
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    """
    if sort not in SORTS:
        raise BadOption(f"lasts are sorted by {', '.join(SORTS)}, not by {sort!r}")
    with open_catalogue(path) as catalogue:
        stored, reference = catalogue.lasts(**labels), _reference(catalogue)
        total = len(catalogue.names())
    return Library(
        lasts=stored.records,
        total=total,
        reference=reference,
        sort=sort,
        filters=tuple((name, value) for name, value in labels.items() if value is not None),
        warnings=notices_about(str(path), map(_damaged, stored.damaged)),
    )


def last(path: Path, name: str) -> StoredLast:
    """One last, and the reference's name.

    Raises
    ------
    UnknownLast
        There is no last of that name.
    """
    with open_catalogue(path) as catalogue:
        record, reference = catalogue.record(name), _reference(catalogue)
        parentage = catalogue.parentage(name)
    if record.paper_transform is None:
        return StoredLast(record, reference, parentage=parentage)
    angle_deg = paper_frame_angle_deg(
        record.paper_transform,
        record.canonical_transform,
        mirrored=record.side.side == "left",
    )
    return StoredLast(record, reference, angle_deg, parentage)


def _reference(catalogue: Catalogue) -> str | None:
    reference = catalogue.reference()
    return None if reference is None else reference.last


def library(path: Path, style: str | None = None, size_system: str | None = None) -> Library:
    """The lasts to match against; a warning names each that is left out because it is damaged
    or has an older profile.

    Raises
    ------
    NoCatalogue, EmptyCatalogue
        There is nothing to match against; the message says what to type.
    """
    with open_catalogue(path) as catalogue:
        total = len(catalogue.names())
        if not total:
            raise EmptyCatalogue(f"the catalogue holds no last; {FIRST_STEPS}", str(path))
        stored, reference = (
            catalogue.lasts(style=style, size_system=size_system),
            _reference(catalogue),
        )
        rated = catalogue.fit_log.counts()
    current = tuple(r for r in stored.records if r.labels.name not in stored.outdated)
    return Library(
        lasts=current,
        total=total,
        reference=reference,
        rejected=stored.rejected,
        warnings=notices_about(
            str(path),
            (
                *map(_damaged, stored.damaged),
                *map(_outdated, stored.outdated),
                *_other_measures(current),
            ),
        ),
        file=path,
        rated=rated,
    )


def _damaged(name: str) -> Notice:
    words = f"{name} was left out: it is damaged; ingest it again with --replace"
    return Notice("damaged_last", words)


def _outdated(name: str) -> Notice:
    words = f"{name} was left out: its profile is older; type: footfit upgrade-catalogue"
    return Notice("outdated_last", words)


def has_other_measures(record: LastRecord) -> bool:
    """Whether a measure follows another definition than this version's, or is missing."""
    return {measure.definition for measure in record.measures} != _definitions(record.pose.kind)


@lru_cache(maxsize=2)
def _definitions(kind: str) -> frozenset[str]:
    return frozenset(entry.definition_id for entry in of_kind(kind))


def _other_measures(records: Sequence[LastRecord]) -> list[Notice]:
    """A warning if lasts were measured by other definitions; it says what to do."""
    other = [record.labels.name for record in records if has_other_measures(record)]
    if not other:
        return []
    lasts = f"{other[0]} was" if len(other) == 1 else f"{len(other)} of {len(records)} lasts were"
    words = f"{lasts} measured by other definitions: zones whose definition changed are not"
    return [Notice("other_measures", f"{words} judged; type: footfit upgrade-catalogue")]
