"""Stored values that no scan and no version of footfit can produce are rejected.

Each column has a rule in the table of columns; here are the rules about several columns. A column
that is not there (an older schema) is not looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from footfit.catalogue.rows.array_blobs import array_of, definition_of
from footfit.catalogue.rows.columns import FLARE, FRAME, LAST, MEASURE, NOTICE, Table
from footfit.catalogue.rows.digests import Row
from footfit.catalogue.rows.rules import LIMITS, is_rotation
from footfit.catalogue.rows.verified_rows import StoredLast


def implausible(stored: StoredLast) -> Iterator[str]:
    """The values of a last's rows that cannot be, in words; nothing for a plausible last."""
    frame, flare = stored.frame or {}, stored.flare or {}
    yield from implausible_values(LAST, stored.last)
    yield from implausible_values(FRAME, frame)
    yield from implausible_values(FLARE, flare)
    for row in stored.measures:
        yield from implausible_values(MEASURE, row)
    for row in stored.notices:
        yield from implausible_values(NOTICE, row)
    if not _holds(lambda: _is_similarity(frame, stored.last)):
        yield "frame.canonical_transform is not a rigid motion with the unit's scale"
    if not _holds(lambda: _curves_fit(flare)):
        yield "the curves of flare do not fit its stations"
    if not _holds(lambda: _has_its_version(flare)):
        yield "flare.definition does not have the version of flare.definition_version"


def implausible_values(table: Table, row: Row) -> Iterator[str]:
    """The columns of one row that break their rule, in words."""
    for column in table.columns:
        if column.name in row:
            value = row[column.name]
            expected = column.implausible(value)
            if expected:
                shown = f"{len(value)} bytes" if isinstance(value, bytes) else repr(value)
                yield f"{table.name}.{column.name} is {shown}; it must be {expected}"


def _holds(test: Callable[[], bool]) -> bool:
    try:
        return test()
    except (KeyError, TypeError, ValueError, AttributeError):
        return False


def _is_similarity(frame: Row, last: Row) -> bool:
    matrix = array_of(frame["canonical_transform"], 4, 4)
    return (
        bool(np.isfinite(matrix).all())
        and bool((matrix[3] == (0, 0, 0, 1)).all())
        and is_rotation(matrix[:3, :3] / last["unit_scale"])
    )


def _curves_fit(flare: Row) -> bool:
    """Every curve has a value per station, and no heading turns more than half a circle."""
    count = len(array_of(flare["stations"]))
    heading = array_of(flare["heading_deg"], count)
    curves = (data for column, data in flare.items() if column.startswith("curvature_"))
    for data in curves:
        if data is not None:
            array_of(data, count)
    array_of(flare["centre_line"], count, 2)
    known = heading[np.isfinite(heading)]
    return bool((np.abs(known) <= LIMITS.heading_deg).all())


def _has_its_version(flare: Row) -> bool:
    return bool(definition_of(flare["definition"]).version == flare["definition_version"])
