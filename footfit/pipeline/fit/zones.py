"""The zones of a fit: where a foot and a last are compared.

Most zones compare the measure of their own name. A new zone is a row of ``ZONES`` and, if it
compares no measure, a function in `clearances.SPECIAL`. Fit profiles may then name it.
"""

from __future__ import annotations

from dataclasses import dataclass

from footfit.results.fit import ZONE_LABELS
from footfit.results.heel import FLARE

TOE_HEIGHT, TOES = "toe_height", "toes"
TOE_BOX = frozenset({TOE_HEIGHT, TOES})
"""Zones that are read from kept sections, once no other zone rejects the last."""
NOT_READ = "not looked at: another zone rejects the last"

HEEL_RULES = {"ball_line": "ball_length", "flare": FLARE}
"""Zones whose rule of the heel model has another name than the zone."""


@dataclass(frozen=True, slots=True)
class Zone:
    """One place of comparison; ``less`` and ``more`` are the words for what is off the target."""

    name: str
    unit: str
    less: str
    more: str

    @property
    def label(self) -> str:
        """The name as people read it."""
        return ZONE_LABELS[self.name]


NO_RULE = (0.0, (0.0, 0.0), (0.0, 0.0), None, 0.0, False, 0.0)
"""A rule that asks for nothing: no fit is judged."""
UNIT_KEYS = {"mm": "_mm", "deg": "_deg", "percent": "_percent", "ratio": ""}
"""What a profile's key ends in, by the zone's unit."""

ZONES: dict[str, Zone] = {
    zone.name: zone
    for zone in (
        Zone("length", "mm", "short", "long"),
        Zone("ball_line", "percent", "too far back", "too far forward"),
        Zone("ball_girth", "mm", "tighter", "looser"),
        Zone("ball_width", "mm", "narrower", "wider"),
        Zone("ball_width_orthogonal", "mm", "narrower", "wider"),
        Zone("waist_girth", "mm", "tighter", "looser"),
        Zone("instep_girth", "mm", "tighter", "looser"),
        Zone("short_heel_girth", "mm", "tighter", "looser"),
        Zone("long_heel_girth", "mm", "tighter", "looser"),
        Zone("heel_width", "mm", "narrower", "wider"),
        Zone(TOE_HEIGHT, "mm", "lower", "higher"),
        Zone(TOES, "mm", "tighter", "looser"),
        Zone("instep_height", "mm", "lower", "higher"),
        Zone("flare", "deg", "less inward", "more inward"),
        Zone("plan", "ratio", "nearer", "further"),
    )
}
