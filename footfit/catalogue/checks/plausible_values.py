"""Stored values that no scan and no version of footfit can produce are rejected.

Each column has a rule in the table of columns; here are the rules about several columns. A column
that is not there (an older schema) is not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from footfit.catalogue.rows.array_blobs import array_of, definition_of
from footfit.catalogue.rows.columns import FLARE, FRAME, LAST, MEASURE, NOTICE, Table
from footfit.catalogue.rows.digests import Row
from footfit.catalogue.rows.rules import LIMITS, Rule, is_rotation
from footfit.catalogue.rows.verified_rows import LastRows


def implausible(stored: LastRows) -> Iterator[str]:
    """The values of a last's rows that cannot be, in words; nothing for a plausible last."""
    frame, flare = stored.frame or {}, stored.flare or {}
    yield from implausible_values(LAST, stored.last)
    yield from implausible_values(FRAME, frame)
    yield from implausible_values(FLARE, flare)
    for row in stored.measures:
        yield from implausible_values(MEASURE, row)
    for row in stored.notices:
        yield from implausible_values(NOTICE, row)
    for rule in RULES:
        if not rule.holds(stored):
            yield rule.words


def implausible_values(table: Table, row: Row) -> Iterator[str]:
    """The columns of one row that break their rule, in words."""
    for column in table.columns:
        if column.name in row:
            value = row[column.name]
            expected = column.implausible(value)
            if expected:
                shown = f"{len(value)} bytes" if isinstance(value, bytes) else repr(value)
                yield f"{table.name}.{column.name} is {shown}; it must be {expected}"


def _is_similarity(stored: LastRows) -> bool:
    matrix = array_of((stored.frame or {})["canonical_transform"], 4, 4)
    return (
        bool(np.isfinite(matrix).all())
        and bool((matrix[3] == (0, 0, 0, 1)).all())
        and is_rotation(matrix[:3, :3] / stored.last["unit_scale"])
    )


def _curves_fit(stored: LastRows) -> bool:
    """Every curve has a value per station, and no heading turns more than half a circle."""
    flare = stored.flare or {}
    count = len(array_of(flare["stations"]))
    heading = array_of(flare["heading_deg"], count)
    array_of(flare["centre_line"], count, 2)
    for column, data in flare.items():
        if column.startswith("curvature_") and data is not None:
            array_of(data, count)
    known = heading[np.isfinite(heading)]
    return bool((np.abs(known) <= LIMITS.heading_deg).all())


def _has_its_version(stored: LastRows) -> bool:
    version = (stored.flare or {})["definition_version"]
    return bool(definition_of(stored.definition).version == version)


RULES = (
    Rule("frame.canonical_transform is not a rigid motion with the unit's scale", _is_similarity),
    Rule("the curves of flare do not fit its stations", _curves_fit),
    Rule("flare.definition is not of the version in definition_version", _has_its_version),
)
"""The rules about several columns; the words say what is wrong."""
