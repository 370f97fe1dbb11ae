"""The room between a foot and a last, surface to surface: JSON, and in words where it is tight."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.json.numbers import millimetres, rounded
from footfit.report.wording.text import plain, signed, visible

if TYPE_CHECKING:
    from collections.abc import Sequence

    from footfit.geometry.fit.clearance import ZoneClearance
    from footfit.report.json.lines import Json
    from footfit.results import SurfaceRoom

AREA_DIGITS = 1
WORTH_SAYING = 0.10
"""The share of a zone that must be tight, or loose, to be worth a word."""
MOST_ZONES = 2


def zone_clearance_part(zone: ZoneClearance) -> Json:
    """One zone's room; null where nothing of it is compared."""
    return {
        "mean_mm": millimetres(zone.mean_mm),
        "p05_mm": millimetres(zone.p05_mm),
        "p95_mm": millimetres(zone.p95_mm),
        "area_cm2": rounded(zone.area_cm2, AREA_DIGITS),
        "tight_cm2": rounded(zone.tight_cm2, AREA_DIGITS),
        "loose_cm2": rounded(zone.loose_cm2, AREA_DIGITS),
    }


def surfaces_part(rooms: Sequence[SurfaceRoom]) -> list[Json] | None:
    """The room of each foot in one last; null where nobody asked for it."""
    return [_surface_part(room) for room in rooms] or None


def _surface_part(room: SurfaceRoom) -> Json:
    return {
        "side": room.side,
        "swing_mm": millimetres(room.swing_mm),
        "zones": {zone.zone: zone_clearance_part(zone) for zone in room.zones},
        "reason": room.reason,
    }


def surfaces_words(rooms: Sequence[SurfaceRoom]) -> list[str]:
    """Where each foot is tight and where it is loose in one last, a line a foot."""
    named = len(rooms) > 1
    return [
        f"{room.side or 'the'} foot: {surface_words(room)}" if named else surface_words(room)
        for room in rooms
    ]


def surface_words(room: SurfaceRoom) -> str:
    """Where a foot is tight in a last and where it is loose: the worst zone first, with the 5 or
    95 % quantile of its room and the area.

    Examples
    --------
    >>> from footfit.geometry.fit.clearance import ZoneClearance
    >>> from footfit.results import SurfaceRoom
    >>> tight = ZoneClearance("medial", 0.6, -6.15, 9.2, 91.0, 26.4, 5.2)
    >>> loose = ZoneClearance("toe", 5.6, -1.1, 12.31, 47.0, 1.5, 17.6)
    >>> surface_words(SurfaceRoom("right", 2.9, (tight, loose)))
    'tight: medial -6.2 mm (26 cm2); loose: toe +12.3 mm (18 cm2)'
    >>> surface_words(SurfaceRoom("right", None, (), "the sole is open"))
    'no room between the surfaces: the sole is open'
    """
    if room.reason is not None:
        return f"no room between the surfaces: {visible(room.reason)}"
    tight = [
        (zone.tight_cm2, f"{zone.zone} {signed(zone.p05_mm)} mm ({plain(zone.tight_cm2, 0)} cm2)")
        for zone in room.zones
        if zone.p05_mm is not None and zone.tight_cm2 > WORTH_SAYING * zone.area_cm2
    ]
    loose = [
        (zone.loose_cm2, f"{zone.zone} {signed(zone.p95_mm)} mm ({plain(zone.loose_cm2, 0)} cm2)")
        for zone in room.zones
        if zone.p95_mm is not None and zone.loose_cm2 > WORTH_SAYING * zone.area_cm2
    ]
    said = [
        f"{word}: {', '.join(words for _, words in _worst(zones))}"
        for word, zones in (("tight", tight), ("loose", loose))
        if zones
    ]
    return "; ".join(said) or "nowhere tight by 2 mm, nowhere loose by 8 mm"


def _worst(zones: list[tuple[float, str]]) -> list[tuple[float, str]]:
    return sorted(zones, key=lambda zone: -zone[0])[:MOST_ZONES]
