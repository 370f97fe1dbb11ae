"""The clearance between the surfaces of a foot and a last as parts of JSON documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.json.numbers import millimetres, rounded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from footfit.geometry.fit.clearance import ZoneClearance
    from footfit.report.json.lines import Json
    from footfit.results import SurfaceRoom

AREA_DIGITS = 1


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
