"""The values that a stored last can have: what no scan and no version of footfit writes.

A hash tells that a row is what was stored, not that what was stored makes sense. Each rule here
is one line of a table; a column that is not there (an older schema) is not looked at.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from footfit.catalogue.rows.array_blobs import array_of, definition_of
from footfit.catalogue.rows.verified_rows import Fields, StoredLast
from footfit.geometry.numeric.arrays import Floats

Rule = Callable[[object], bool]


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds with room to spare: what is outside is wrong, what is inside may be anything."""

    length_mm: tuple[float, float] = (50.0, 1000.0)
    flare_deg: float = 90.0
    heading_deg: float = 180.0
    orthonormal: float = 1e-6


LIMITS = Limits()


def _number(low: float = -math.inf, high: float = math.inf) -> Rule:
    def holds(value: object) -> bool:
        return isinstance(value, int | float) and math.isfinite(value) and low <= value <= high

    return holds


def _word(*words: str) -> Rule:
    return lambda value: value in words


def _null_or(rule: Rule) -> Rule:
    return lambda value: value is None or rule(value)


def _above_zero(value: object) -> bool:
    return _number(0.0)(value) and value != 0


def _sha256(value: object) -> bool:
    return isinstance(value, str) and len(value) == 64 and set(value) <= set("0123456789abcdef")


LAST: dict[str, Rule] = {
    "name": lambda value: isinstance(value, str) and bool(value.strip()),
    "heel_height_mm": _null_or(_number()),
    "content_sha256": _sha256,
    "units": _word("mm", "cm", "m", "in", "scaled"),
    "units_source": _word("declared", "detected", "known-length"),
    "unit_scale": _above_zero,
    "vertices": _above_zero,
    "faces": _above_zero,
    "watertight": _word(0, 1),  # type: ignore[arg-type]
    "side": _null_or(_word("left", "right")),
    "side_confidence": _word("sure", "low", "undecided"),
    "side_score": _number(),
    "side_source": _word("given", "detected"),
}
FRAME: dict[str, Rule] = {
    "pose_cost": _number(0.0),
    "pose_margin": _number(),
    "pose_support": _number(),
    "pose_sole": _word(0, 1),  # type: ignore[arg-type]
    "pose_kind": _word("foot", "last"),
    "length_mm": _number(*LIMITS.length_mm),
}
FLARE: dict[str, Rule] = {
    "angle_deg": _null_or(_number(-LIMITS.flare_deg, LIMITS.flare_deg)),
    "angle_sd_deg": _null_or(_number(0.0)),
    "flare_class": _word("outflare", "straight", "inflare"),
}
MEASURE: dict[str, Rule] = {
    "name": lambda value: isinstance(value, str) and bool(value),
    "position": _number(0),
    "value": _null_or(_number()),
    "sd": _null_or(_number(0.0)),
}


def implausible(stored: StoredLast) -> Iterator[str]:
    """What of a last's rows cannot be, in words; nothing for a plausible one."""
    frame, flare = stored.frame or {}, stored.flare or {}
    yield from _broken("last", stored.last, LAST)
    yield from _broken("frame", frame, FRAME)
    yield from _broken("flare", flare, FLARE)
    for row in stored.measures:
        yield from _broken("measure", row, MEASURE)
    for words, sound in (
        ("frame.eigenvectors is no rotation", lambda: _rotation(frame, "")),
        ("frame.eigenvalues_mm2 are no moments", lambda: _moments(frame, "")),
        ("frame.centroid_mm is no point", lambda: _point(frame, "")),
        ("frame.printed_eigenvectors is no rotation", lambda: _rotation(frame, "printed_")),
        ("frame.printed_eigenvalues_mm2 are no moments", lambda: _moments(frame, "printed_")),
        ("frame.printed_centroid_mm is no point", lambda: _point(frame, "printed_")),
        (
            "frame.canonical_transform is no rigid motion with the unit's scale",
            lambda: _similarity(frame, stored.last),
        ),
        ("flare.stations does not run from heel to toe", lambda: _stations(flare)),
        ("flare's curves do not fit its stations", lambda: _curves(flare)),
        ("flare.definition is not of its version", lambda: _definition(flare)),
    ):
        if not _holds(sound):
            yield words


def _broken(table: str, row: Fields, rules: dict[str, Rule]) -> Iterator[str]:
    for column, holds in rules.items():
        if column in row and not holds(row[column]):
            yield f"{table}.{column} is {row[column]!r}"


def _holds(sound: Callable[[], bool]) -> bool:
    try:
        return sound()
    except (KeyError, TypeError, ValueError, AttributeError):
        return False


def _finite(array: Floats) -> bool:
    return bool(np.isfinite(array).all())


def _is_rotation(matrix: Floats) -> bool:
    off = np.abs(matrix @ matrix.T - np.eye(3)).max()
    return bool(off <= LIMITS.orthonormal and np.linalg.det(matrix) > 0)


def _rotation(frame: Fields, which: str) -> bool:
    return _is_rotation(array_of(frame[f"{which}eigenvectors"], 3, 3))


def _moments(frame: Fields, which: str) -> bool:
    values = array_of(frame[f"{which}eigenvalues_mm2"], 3)
    return _finite(values) and bool((values >= 0).all())


def _point(frame: Fields, which: str) -> bool:
    return _finite(array_of(frame[f"{which}centroid_mm"], 3))


def _similarity(frame: Fields, last: Fields) -> bool:
    matrix = array_of(frame["canonical_transform"], 4, 4)
    return (
        _finite(matrix)
        and bool((matrix[3] == (0, 0, 0, 1)).all())
        and _is_rotation(matrix[:3, :3] / last["unit_scale"])
    )


def _stations(flare: Fields) -> bool:
    stations = array_of(flare["stations"])
    inside = stations.min() >= 0 and stations.max() <= 1
    return bool(inside and (np.diff(stations) > 0).all())


def _curves(flare: Fields) -> bool:
    count = len(array_of(flare["stations"]))
    heading = array_of(flare["heading_deg"], count)
    curves = [
        array_of(data, count)
        for column, data in flare.items()
        if column.startswith("curvature_") and data is not None
    ]
    known = heading[np.isfinite(heading)]
    turned = known.size == 0 or np.abs(known).max() <= LIMITS.heading_deg
    line = array_of(flare["centre_line"], count, 2)
    return bool(turned) and not any(np.isinf(curve).any() for curve in (*curves, line))


def _definition(flare: Fields) -> bool:
    return bool(definition_of(flare["definition"]).version == flare["definition_version"])
