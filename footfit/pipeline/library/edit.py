"""Edit: other labels for a stored last, and what they change of how it stands."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from footfit.catalogue.rows.requirements import require_name
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, UnknownLast
from footfit.locations import Location
from footfit.pipeline.batch.manifest import LABEL_HEIGHTS, LABEL_TEXTS, label_mm
from footfit.pipeline.batch.run_manifest import OF_RUNS
from footfit.pipeline.library.measured_copy import MeasuredCopy, measured_copy, with_measured
from footfit.pipeline.scan.measure import END_MEASURES
from footfit.results import EditOutcome, LastRecord, Measure, Measured, MeshCopy, ShapeSections

Label = str | float | None
"""The value of a label: a text, a height in mm, or None for no label."""
EDITABLE = (*LABEL_TEXTS[1:], "parent", *LABEL_HEIGHTS)
"""The labels that may change; the name has a command of its own."""
OF_STANCE = (*OF_RUNS, "stance_label_contradicted", "stance_label_unused", "stance_unsure")
"""The codes of the warnings that the labels of the stance give."""


def edit_last(path: Location, name: str, labels: Mapping[str, Label]) -> EditOutcome:
    """Change labels of a last in one transaction; None or a blank text removes one.

    Heel height, toe spring and platform decide how a last stands. If one of them changes, the last
    is measured again from its mesh copy, and what its stance changes is replaced.

    Parameters
    ----------
    path : Path
        The catalogue.
    name : str
        The last's.
    labels : mapping
        Some of `EDITABLE`, with their new values.

    Raises
    ------
    BadOption
        No label is given, one has a value that no last has, or the parent descends from the last;
        nothing is changed then.
    UnknownLast
        There is no such last or parent, or the last has no mesh copy to be measured again.
    CatalogueUnusable, NoCatalogue
        The last, its copy or the catalogue cannot be used.
    """
    given = {label: _label(label, value) for label, value in labels.items()}
    if not given:
        raise BadOption("nothing to change: give a label, for example --size 42")
    with open_catalogue(path, write=True, create=False) as catalogue:
        before, after = catalogue.edit(name, partial(_edited, labels=given))
    return _outcome(before, after, given)


def _label(label: str, value: Label) -> Label:
    if label not in EDITABLE:
        raise BadOption(f"{label!r} is no label that can change; they are {', '.join(EDITABLE)}")
    if isinstance(value, str):
        value = value.strip() or None
    if label in LABEL_HEIGHTS:
        if isinstance(value, str):
            raise BadOption(f"{label} is a number of mm, not {value!r}")
        return label_mm(value, label)
    if label == "family" and value is not None:
        require_name(str(value), "family")
    return value if value is None else str(value)


def _edited(
    record: LastRecord, read_copy: Callable[[], MeshCopy], labels: Mapping[str, Label]
) -> tuple[LastRecord, ShapeSections | None]:
    """A record with other labels, and its sections if they changed."""
    after = replace(record, labels=replace(record.labels, **labels))  # type: ignore[arg-type]
    if all(getattr(after.labels, each) == getattr(record.labels, each) for each in LABEL_HEIGHTS):
        return after, None
    try:
        copy = read_copy()
    except UnknownLast as error:
        words = (
            f"{record.labels.name!r} was stored without its mesh, so how it stands cannot be"
            " measured again: ingest its file again with these labels and --replace"
        )
        raise UnknownLast(words) from error
    old, new = measured_copy(record, copy), measured_copy(after, copy)
    kept = [notice for notice in record.warnings if notice.code not in OF_STANCE]
    restood = with_measured(after, _where_changed(record, old, new))
    return replace(restood, warnings=(*kept, *new.notices)), new.sections


def _where_changed(record: LastRecord, old: MeasuredCopy, new: MeasuredCopy) -> MeasuredCopy:
    """What a new stance changes: all else stays as it was measured from the scan itself."""
    stored = {row.name: row for row in record.measures}
    before = {row.name: row for row in old.measures}
    measures = tuple(
        _row(record, stored.get(row.name), before[row.name], row) for row in new.measures
    )
    same = (
        old.flare is not None
        and new.flare is not None
        and old.flare.angle_deg == new.flare.angle_deg
        and record.flare.definition == new.flare.definition
    )
    return replace(new, measures=measures, flare=None if same else new.flare)


def _row(record: LastRecord, stored: Measure | None, before: Measure, after: Measure) -> Measure:
    """The stored measure, or the one taken again if its stance or its definition changed it."""
    if stored is None or stored.definition != after.definition:
        return after
    open_end = record.length_mm is None and after.name in END_MEASURES
    if open_end or before.measured == after.measured:
        return stored
    return replace(after, measured=_as_scanned(stored.measured, before.measured, after.measured))


def _as_scanned(stored: Measured, before: Measured, after: Measured) -> Measured:
    """A value taken again, with the part of the total sd that only the scan's file could tell.

    The scanner and the file's step are not kept. Their part is what the stored total sd has more
    than the one of the mesh copy with the same labels.
    """
    if stored.total_sd is None or before.total_sd is None or after.total_sd is None:
        return after
    more = max(0.0, stored.total_sd**2 - before.total_sd**2)
    return replace(after, total_sd=math.sqrt(after.total_sd**2 + more))


def _outcome(before: LastRecord, after: LastRecord, labels: Mapping[str, Label]) -> EditOutcome:
    changes = tuple(
        (label, getattr(before.labels, label), getattr(after.labels, label))
        for label in labels
        if getattr(before.labels, label) != getattr(after.labels, label)
    )
    stored = {row.name: row for row in before.measures}
    stood = {label for label, *_ in changes} & set(LABEL_HEIGHTS)
    said = [notice for notice in after.warnings if stood and notice.code in OF_STANCE]
    return EditOutcome(
        last=after.labels.name,
        changes=changes,
        measured_again=tuple(row.name for row in after.measures if row != stored.get(row.name)),
        flare_angle_deg=after.flare.angle_deg,
        warnings=(*after.label_notices, *said),
    )
