"""What matching reads: the record and the profile of every last, but no mesh."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.last_names import caseless
from footfit.catalogue.rows.records import record_of
from footfit.catalogue.rows.verified_rows import last_names, stored_lasts
from footfit.geometry.fit.sizes import label_number
from footfit.results import LastRecord


@dataclass(frozen=True, slots=True)
class StoredLasts:
    """The intact lasts that pass the filters, by name, and what is to be said of the others.

    ``rejected`` counts the lasts that do not pass, by filter. ``damaged`` names the lasts whose
    rows are not what was stored. ``outdated`` names those of ``records`` whose profile follows
    another flare definition than this footfit's, or has other stations than its definition: they
    cannot be ranked (``upgrade-catalogue`` makes a new profile).
    """

    records: tuple[LastRecord, ...]
    rejected: tuple[tuple[str, int], ...]
    damaged: tuple[str, ...]
    outdated: tuple[str, ...]


def verified_records(connection: Driver, **filters: str | None) -> StoredLasts:
    """The lasts that pass the filters (see :func:`rejection`)."""
    names = last_names(connection)
    records, rejected, damaged, outdated = [], [], [], []
    for stored in sorted(stored_lasts(connection), key=lambda stored: stored.name):
        if not stored.intact:
            damaged.append(stored.name)
            continue
        record = record_of(stored, names)
        reason = rejection(asdict(record.labels), filters)
        if reason is not None:
            rejected.append(reason)
            continue
        records.append(record)
        if not stored.is_current:
            outdated.append(stored.name)
    counts = sorted(Counter(rejected).items())
    return StoredLasts(tuple(records), tuple(counts), tuple(damaged), tuple(outdated))


def rejection(labels: Mapping[str, Any], filters: Mapping[str, str | None]) -> str | None:
    """The first filter that a last with these labels does not pass, or None.

    A filter names a label and what it must be, whatever the case; None lets every last pass.
    """
    for name, wanted in filters.items():
        label = labels[name]
        if wanted is not None and (label is None or not _same(name, label, wanted)):
            return name
    return None


def _same(name: str, label: str, wanted: str) -> bool:
    """Whether two labels say the same; "42.5" and "42,5" are one size."""
    if name == "size" and label_number(label) is not None:
        return label_number(label) == label_number(wanted)
    return caseless(label.strip()) == caseless(wanted.strip())
