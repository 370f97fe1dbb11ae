"""The lasts of a catalogue, as commands list them and as a match is asked of them."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from footfit.catalogue.catalogue_reader import open_reader
from footfit.errors import BadOption
from footfit.geometry.measures.measure_table import of_kind
from footfit.geometry.pose.paper_frame import paper_frame_angle_deg
from footfit.results import Notice, StoredLast
from footfit.results.values import notices_about

if TYPE_CHECKING:
    from footfit.catalogue.catalogue_reader import CatalogueReader
    from footfit.locations import Location
    from footfit.results import LastRecord, Library


def list_lasts(path: Location, sort: str = "name", **labels: str | None) -> Library:
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
    from footfit.results import Library
    from footfit.results.library import SORTS

    if sort not in SORTS:
        raise BadOption(f"lasts are sorted by {', '.join(SORTS)}, not by {sort!r}")
    with open_reader(path) as catalogue:
        stored, reference = catalogue.lasts(**labels), reference_name(catalogue)
        total = len(catalogue.names())
    return Library(
        lasts=stored.records,
        total=total,
        reference=reference,
        sort=sort,
        filters=tuple((name, value) for name, value in labels.items() if value is not None),
        warnings=notices_about(str(path), map(damaged_last, stored.damaged)),
    )


def last(path: Location, name: str) -> StoredLast:
    """One last, and the reference's name.

    Raises
    ------
    UnknownLast
        There is no last of that name.
    """
    with open_reader(path) as catalogue:
        record, reference = catalogue.record(name), reference_name(catalogue)
        parentage = catalogue.parentage(name)
    if record.paper_transform is None:
        return StoredLast(record, reference, parentage=parentage)
    angle_deg = paper_frame_angle_deg(
        record.paper_transform,
        record.canonical_transform,
        mirrored=record.side.side == "left",
    )
    return StoredLast(record, reference, angle_deg, parentage)


def reference_name(catalogue: CatalogueReader) -> str | None:
    """The name of the reference; None in an empty catalogue."""
    reference = catalogue.reference()
    return None if reference is None else reference.last


def damaged_last(name: str) -> Notice:
    """The warning that names a last which is left out."""
    words = f"{name} was left out: it is damaged; ingest it again with --replace"
    return Notice("damaged_last", words)


def has_other_measures(record: LastRecord) -> bool:
    """Whether a measure follows another definition than this version's, or is missing."""
    return {measure.definition for measure in record.measures} != measure_definitions(
        record.pose.kind
    )


@lru_cache(maxsize=2)
def measure_definitions(kind: str) -> frozenset[str]:
    """The definitions of all measures of a kind of shape, of this version."""
    return frozenset(entry.definition_id for entry in of_kind(kind))
