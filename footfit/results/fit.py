"""What a fit profile asks of each zone, and how a foot fits a last."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from footfit.results.heel import HeelChange
from footfit.results.values import Json, Measured, Part, SideName, Verdict, exact, fields, part
from footfit.results.worn import BAREFOOT, Worn

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats, Ints
ZONE_ENDS = {
    **dict.fromkeys(("length", "ball_girth", "ball_width", "ball_width_orthogonal"), "_mm"),
    **dict.fromkeys(("waist_girth", "instep_girth", "short_heel_girth"), "_mm"),
    **dict.fromkeys(("long_heel_girth", "heel_width", "toe_height", "instep_height"), "_mm"),
    "toes": "_mm",
    "ball_line": "_percent",
    "flare": "_deg",
    "plan": "",
}
"""Every zone that a profile can name, and what the name of a column ends in by its unit."""


ZONE_LABELS = {
    "length": "toe room",
    "ball_line": "ball line",
    "ball_girth": "ball girth",
    "ball_width": "ball width",
    "ball_width_orthogonal": "ball width orthogonal",
    "waist_girth": "waist girth",
    "instep_girth": "instep girth",
    "short_heel_girth": "short heel girth",
    "long_heel_girth": "long heel girth",
    "heel_width": "heel width",
    "toe_height": "toe height",
    "toes": "toes",
    "instep_height": "instep height",
    "flare": "flare",
    "plan": "outline shape",
}
"""The name of each zone as people read it, in every command."""

Grade = Literal["A", "M", "B", "C"]
GRADES: dict[Grade, str] = {
    "A": "measured with wearers who judged comfort",
    "M": "measured on feet or lasts",
    "B": "trade rule",
    "C": "opinion",
}
"""How well a range is founded, in words."""


@dataclass(frozen=True, slots=True)
class ZoneRule:
    """What a fit profile asks of one zone, in the unit of the zone.

    The range ``good`` contains ``target``, ``acceptable`` contains ``good``, ``poor`` contains
    ``acceptable``. Outside of ``poor`` the last is rejected; if ``poor`` is None it never is.
    ``weight`` counts in the distance; a zone of weight 0 is shown and judges nothing. Without a
    ``required`` zone no last is good. ``cavity`` is the space that lining, insole and counter take;
    it is subtracted first. ``grade`` says how well the ranges are founded, and ``source`` by what.
    """

    zone: str
    target: float
    good: tuple[float, float]
    acceptable: tuple[float, float]
    poor: tuple[float, float] | None
    weight: float
    required: bool
    cavity: float
    grade: Grade = "C"
    source: str = ""

    def to_dict(self) -> Json:
        """The rule without its zone's name, which is its key."""
        return exact(fields(self, "zone"))


@dataclass(frozen=True, slots=True)
class FitProfile:
    """The kind of shoe that is fitted: a rule for each zone, in the order of judging.

    ``sha256`` is of the values, not of the file, so a comment does not change it. Two distances
    that differ by at most ``tie_sds`` standard deviations of their difference are a tie.
    ``usual_length_mm`` are the lengths of the feet that it is for; None stands for adults. ``worn``
    is what is worn with such shoes, if nothing else is said.
    """

    name: str
    version: int
    summary: str
    tie_sds: float
    zones: tuple[ZoneRule, ...]
    sha256: str
    usual_length_mm: tuple[float, float] | None = None
    worn: Worn = BAREFOOT

    def to_dict(self) -> Json:
        """The whole profile, its rules by zone."""
        rules = {rule.zone: rule.to_dict() for rule in self.zones}
        keys = exact(fields(self, "zones", "usual_length_mm", "worn"))
        return keys | {"worn": self.worn.to_dict(), "zones": rules}


@dataclass(frozen=True, slots=True)
class ZoneFit(Part):
    """One foot in one zone of a last.

    ``clearance`` is in ``unit``, and ``target`` is what the profile asks. ``score`` is 0 at the
    target and 1 at the edge of good; - is tight and + is loose. ``verdict`` and ``score`` are None
    if the clearance is not measured. ``counts`` is False if the other foot of the pair governs this
    zone, or if its weight is 0; ``not_counted`` then says which. ``label`` names the zone in words.
    ``digits`` are the decimals that the clearance is shown with: more where they decide a verdict.
    ``place`` is where in the zone that is: "big toe, inner wall". ``grade`` says how well
    founded the zone's ranges are (``GRADES``).
    """

    zone: str
    unit: str
    clearance: Measured
    target: float
    score: float | None
    verdict: Verdict | None
    counts: bool
    place: str | None = None
    label: str = ""
    not_counted: str | None = None
    digits: int = 1
    grade: Grade = "C"

    not_written = ("zone", "digits")


@dataclass(frozen=True, slots=True)
class ToeFit(Part):
    """One toe against the wall of a last at toe height, in plan.

    ``clearance`` is in mm to the nearest wall, + is space and - is how far the toe stands through
    it. ``wall`` is "inner", "outer" or "front".
    """

    toe: str
    wall: str
    clearance: Measured

    not_written = ("toe",)

    @property
    def place(self) -> str:
        """The toe and the wall in words."""
        return f"{self.toe}, {self.wall} wall"


@dataclass(frozen=True, slots=True)
class ToeBox(Part):
    """The toes of one foot in one last, the big toe first, and their outlines in plan.

    ``outline_mm`` (m, 2) are points of the foot's outline, along the last's bottom and to the
    medial side, as a right shape, and ``toe`` (m,) is the place in ``toes`` of each. ``wall_mm``
    (k, 3) are the way along the last's bottom and its lateral and medial edge there.
    """

    toes: tuple[ToeFit, ...]
    outline_mm: Floats
    toe: Ints
    wall_mm: Floats

    def _keys(self) -> Json:
        return {each.toe.replace(" ", "_"): each for each in self.toes}

    @property
    def tightest(self) -> ToeFit:
        """The toe with the least clearance."""
        return min(self.toes, key=lambda each: each.clearance.value or 0.0)


@dataclass(frozen=True, slots=True)
class FootFit(Part):
    """One foot of the customer in one last; ``verdict`` is the worst of the zones that count.

    ``heel`` is what the last's heel changes of the foot; None for a foot that is taken as scanned.
    ``toe_box`` is None if the toes were not judged; the zone "toes" then says why.
    """

    side: SideName | None
    verdict: Verdict
    zones: tuple[ZoneFit, ...]
    heel: HeelChange | None = None
    toe_box: ToeBox | None = None

    def _keys(self) -> Json:
        return fields(self) | {"zones": part({zone.zone: zone for zone in self.zones})}
