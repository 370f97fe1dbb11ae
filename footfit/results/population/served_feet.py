"""The feet of a population, each with its best last, and the lasts with the feet they serve."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from footfit.results.values import LABELS, Json, Part, part, rows

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.population.shares import Share
    from footfit.results.values import SideName

FootStatus = Literal["good", "acceptable", "poor", "no_last_fits", "not_judged", "failed"]
GOOD, POOR = 0, 2
"""Places in VERDICTS: good, acceptable, poor, reject."""
UNITS = {"ball_line": "percent", "flare": "deg", "plan": "ratio"}
"""The unit of a zone, if it is not mm."""


@dataclass(frozen=True, slots=True)
class FootColumns:
    """n feet and what was found of each.

    ``values`` has the measures by name, (n,) each, ``texts`` the columns that were asked for.
    ``status`` is the verdict of the first last, or why there is none. ``last`` (n,) is the place of
    that last in ``lasts``, -1 for none; if no last fits it is the nearest. ``margin`` (n,) is how
    far inside its acceptable range the zone ``margin_zone`` (n,) is, in the unit of the zone.
    ``zone_level`` (n, z) and ``clearances`` (n, z) are in that last, by ``zones``: an index of
    VERDICTS, or -1, and NaN where nothing was judged. ``servers`` (n, 2) are how many lasts are
    good, or acceptable.
    """

    ids: tuple[str, ...]
    sides: tuple[SideName | None, ...]
    sizes: tuple[str, ...]
    widths: tuple[str, ...]
    values: Mapping[str, Floats]
    flare_deg: Floats
    texts: Mapping[str, tuple[str, ...]]
    status: tuple[FootStatus, ...]
    reasons: tuple[str | None, ...]
    lasts: tuple[str, ...]
    last: Ints
    margin: Floats
    margin_zone: Ints
    zones: tuple[str, ...]
    zone_level: Ints
    counts: tuple[bool, ...]
    clearances: Floats
    servers: Ints

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the columns of a row."""
        return (
            *("id", "side", *self.texts, "size", "width"),
            *(f"{name}_mm" for name in self.values),
            *("flare_deg", "status", "best_last", "nearest_last", "margin", "margin_unit"),
            *("margin_zone", "failing", "not_good", "not_judged", "lasts_good", "lasts_acceptable"),
            "reason",
        )

    def rows(self) -> list[Json]:
        """A row for each foot."""
        return rows(self.columns, map(self._row, range(len(self.ids))))

    def to_dict(self) -> Json:
        """The feet as JSON has them: a list under one key."""
        return {"feet": self.rows()}

    def _row(self, at: int) -> tuple[object, ...]:
        fits = self.status[at] in ("good", "acceptable", "poor") or (
            self.status[at] == "not_judged" and self.last[at] >= 0
        )
        last = self.lasts[self.last[at]] if self.last[at] >= 0 else None
        zone = self.zones[self.margin_zone[at]] if self.margin_zone[at] >= 0 else None
        levels = zip(self.zones, self.zone_level[at].tolist(), self.counts, strict=True)
        judged = [(zone, level) for zone, level, counts in levels if counts]
        failing = [zone for zone, level in judged if level >= POOR]
        not_good = [zone for zone, level in judged if level > GOOD]
        unknown = [zone for zone, level in judged if level < GOOD]
        margin = self.margin[at]
        return (
            self.ids[at],
            self.sides[at],
            *(texts[at] or None for texts in self.texts.values()),
            self.sizes[at] or None,
            self.widths[at] or None,
            *(round(float(values[at]), 3) for values in self.values.values()),
            round(float(self.flare_deg[at]), 3),
            self.status[at],
            last if fits else None,
            None if fits else last,
            None if zone is None else round(float(margin), 3),
            None if zone is None else UNITS.get(zone, "mm"),
            zone,
            " ".join(failing) or None,
            " ".join(not_good) or None,
            " ".join(unknown) or None,
            *map(int, self.servers[at]),
            self.reasons[at],
        )


@dataclass(frozen=True, slots=True)
class LastServes(Part):
    """The feet that one last serves: for how many it is good, or acceptable, and best.

    ``only_feet`` are those that no other last serves; ``length_mm`` and ``ball_girth_mm`` are the
    5 and the 95 % of all that it serves. ``could_go`` lasts may all go together: no foot that is
    served loses its last acceptable one.
    """

    last: str
    style: str | None
    size: str | None
    size_system: str | None
    width_label: str | None
    good: int
    acceptable: int
    best_for: int
    only: int
    only_feet: tuple[str, ...]
    length_mm: tuple[float, float] | None
    ball_girth_mm: tuple[float, float] | None
    could_go: bool

    columns = (
        *("last", *LABELS, "good", "acceptable", "best_for", "only", "could_go"),
        *("length_from_mm", "length_to_mm", "ball_girth_from_mm", "ball_girth_to_mm", "only_feet"),
    )

    def rows(self) -> list[Json]:
        """The last as one row of a table."""
        ends = [
            end for pair in (self.length_mm, self.ball_girth_mm) for end in pair or (None, None)
        ]
        start = [getattr(self, name) for name in self.columns[: -len(ends) - 1]]
        return rows(self.columns, [(*start, *ends, " ".join(self.only_feet) or None)])


@dataclass(frozen=True, slots=True)
class NextLast(Part):
    """A last to make: for which feet, on which measures, and how many feet it would serve.

    ``gain`` counts feet that no last before it serves. ``covered`` is the share of all judged feet
    that then have an acceptable last, and ``covered_at_most`` what no choice of as many of the
    planned lasts could pass.
    """

    rank: int
    size: str
    width: str | None
    foot_length_mm: float
    measures: tuple[tuple[str, float], ...]
    flare_deg: float | None
    gain: int
    covered: Share
    covered_at_most: float

    def _keys(self) -> Json:
        known = {f"{name}_mm": value for name, value in self.measures}
        plain = ("rank", "size", "width", "foot_length_mm", "flare_deg", "gain", "covered")
        keys = {name: getattr(self, name) for name in plain}
        return keys | {"measures": part(known), "covered_at_most": self.covered_at_most}
