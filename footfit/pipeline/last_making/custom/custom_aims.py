"""What a custom last should measure: each aim is the foot in the base's heel, plus its allowance.

The four girths are those of the least tape, as a last maker takes them. The fit profile's zones
have girths in upright planes, in which a match judges; those two are pulled along.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.measures.measure_table import measure_named
from footfit.pipeline.fit.heels import Heels, full_change
from footfit.pipeline.fit.judging.judged_lasts import JudgedLasts, asked_of
from footfit.pipeline.fit.ranking import foot_fits, judged_last
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.results import FitProfile, FootFit, HeelQuestion, LastRecord, Profiled, Worn, ZoneRule
from footfit.results.last_making.custom_last import target_words

LEAST_TAPES = {
    "ball_girth_least": ("ball_girth",),
    "waist_girth_least": ("ball_girth", "instep_girth"),
    "instep_girth_least": ("instep_girth",),
    "heel_girth_instep": ("short_heel_girth",),
}
"""Each girth, and the zones of a fit profile whose mean allowance it has."""
WIDTHS = ("ball_width", "heel_width")
HEEL_GIRTH = "short_heel_girth"
PULLED = ("ball_girth", "instep_girth", HEEL_GIRTH)
FOLLOWING = ("heel_girth_instep",)
"""The girth without a target: the bottom, the back and the top, which are kept, nearly set it; and
a foot that was scanned flat has another one in a heel."""
INNER_GOOD, MOST_BALL_MM = 0.7, 12.0
"""A zone that is only pulled comes so far into its good range, as a share of that; the ball moves
at most so far."""
HEEL_PULL_MM, HEEL_REACH_MM = 3.0, 8.0
"""The short heel girth, which the kept parts nearly set, is pulled by at most so much; it is kept
in its good range if it lies so near to that."""
RANGE = 0.95
"""What should be in its zone's good range stays within so much of it."""
GIVES_WAY = {
    "ball_girth_least": "ball_girth",
    "waist_girth_least": "instep_girth",
    "instep_girth_least": "instep_girth",
}
"""The least tapes whose targets move if the upright girth of a zone would not be good. The waist
lies behind the ball and in front of the instep; no zone judges it."""
ANYWHERE = (-np.inf, np.inf)
LENGTH, BALL_LENGTH = "length", "ball_length"


@dataclass(frozen=True, slots=True)
class CustomQuestion:
    """How a foot is fitted: as `match` is asked, and by how much the last's flare follows the
    foot's (0 to 1). With ``bottom_kept`` the widths are no aims: the bottom nearly sets them.
    """

    profile: FitProfile
    heel: HeelQuestion
    worn: Worn
    flare_follow: float = 0.0
    bottom_kept: bool = False


@dataclass(frozen=True, slots=True)
class CustomAim:
    """A measure of the base and its target, in mm.

    ``zone`` is the zone whose allowance counts. An aim that is not ``firm`` is only pulled towards
    its target. ``good_mm`` is where the measure should stay, so that its zone is good. A least
    tape's target may be ``moved_mm`` from the profile's, because its zone would not be good.
    ``foot`` is None where no measure of the foot is compared alone.
    """

    measure: str
    zone: str
    base: float
    target: float
    foot: float | None = None
    allowance: float | None = None
    firm: bool = True
    good_mm: tuple[float, float] = ANYWHERE
    moved_mm: float = 0.0

    @property
    def words(self) -> str:
        """The measure in words."""
        return target_words(self.measure)

    def moved_to(self, target: float) -> CustomAim:
        """The same aim with another target of the least tape, or of the toe room."""
        if self.measure not in (*GIVES_WAY, LENGTH):
            return self
        more = target - self.target
        allowance = None if self.allowance is None else self.allowance + more
        return replace(self, target=target, allowance=allowance, moved_mm=self.moved_mm + more)

    def shifted(self, more_mm: float) -> CustomAim:
        """The same aim on a copy of the base that reads so much more."""
        low, high = self.good_mm
        good_mm = low + more_mm, high + more_mm
        base, target = self.base + more_mm, self.target + more_mm
        return replace(self, base=base, target=target, good_mm=good_mm)


def fit_in(foot: Profiled, last: LastRecord, base: BaseLast, question: CustomQuestion) -> FootFit:
    """A foot in a last that has the sections of ``base``, zone by zone, as `match` judges it."""
    return foot_fits(judged_in(foot, last, base, question), 0, last)[0]


def judged_in(
    foot: Profiled, last: LastRecord, base: BaseLast, question: CustomQuestion
) -> JudgedLasts:
    """One last, judged for one foot."""
    kept = {last.labels.name: base.sections}
    asked = asked_of([foot], question.profile, "fit", question.heel, question.worn)
    return judged_last(asked, last, kept)


def custom_aims(foot: Profiled, base: BaseLast, question: CustomQuestion) -> tuple[CustomAim, ...]:
    """The aims of a custom last, the length first; without those that cannot be measured."""
    judged = judged_in(foot, base.record, base, question)
    off = {
        zone.zone: zone.target - zone.clearance.value
        for zone in foot_fits(judged, 0, base.record)[0].zones
        if zone.clearance.value is not None
    }
    rules = {column.rule.zone: column.rule for column in judged.asked.columns}
    aims = [] if LENGTH not in off else [_toe_room(base, off[LENGTH])]
    if bool(judged.heels.length_only[0]):
        return tuple(aims)
    if "ball_line" in off:
        aims += _ball_line(foot, base, rules, judged.heels)
    aims += _girths(foot, base, rules, judged.heels)
    for name in PULLED if question.bottom_kept else (*WIDTHS, *PULLED):
        own, stored = measure_named(name).taken_of(base.shape).value, base.record.value_of(name)
        if own is not None and stored is not None and name in off:
            rule = rules[name]
            allowance, target = rule.target + rule.cavity, stored + off[name]
            aim = CustomAim(name, name, own, target, target - allowance, allowance)
            aims.append(_pulled(aim, rule, stored, aims) if name in PULLED else aim)
    return tuple(aims)


def _pulled(
    aim: CustomAim, rule: ZoneRule, stored_mm: float, aims: Sequence[CustomAim]
) -> CustomAim:
    """The aim of a girth that is pulled: where its least tape brings it, if that is good.

    The girth of the heel is pulled only as far as the kept parts leave.
    """
    grown_mm = sum(a.target - a.base for a in aims if a.measure == f"{aim.measure}_least")
    more_mm = grown_mm - inner_good(rule, stored_mm + grown_mm - aim.target)
    good_mm = good_range(aim.base + aim.target - stored_mm, rule)
    if aim.measure == HEEL_GIRTH:
        more_mm = min(max(more_mm, -HEEL_PULL_MM), HEEL_PULL_MM)
        if not good_mm[0] - HEEL_REACH_MM <= aim.base <= good_mm[1] + HEEL_REACH_MM:
            good_mm = ANYWHERE
    return replace(aim, target=aim.base + more_mm, firm=False, good_mm=good_mm)


def good_range(target_mm: float, rule: ZoneRule, share: float = RANGE) -> tuple[float, float]:
    """Where a measure should stay whose zone asks for ``target_mm``: a share of its good range."""
    low, high = (target_mm + share * (end - rule.target) for end in rule.good)
    return low, high


def inner_good(rule: ZoneRule, off: float) -> float:
    """How far a clearance is outside of the inner good range, if it is ``off`` from its target; in
    the unit of the zone.
    """
    low, high = (INNER_GOOD * (end - rule.target) for end in rule.good)
    return off - min(max(off, low), high)


def _toe_room(base: BaseLast, more_mm: float) -> CustomAim:
    """The aim of the length: by how much the toe room of the base must grow."""
    length_mm = base.record.value_of(LENGTH) or base.shape.length_mm
    return CustomAim(LENGTH, LENGTH, length_mm, length_mm + more_mm)


def _ball_line(
    foot: Profiled, base: BaseLast, rules: Mapping[str, ZoneRule], heels: Heels
) -> list[CustomAim]:
    """The pull on the ball's place along the last: it stays, or comes well into its good range."""
    own = measure_named(BALL_LENGTH).taken_of(base.shape).value
    scanned = next((row.measured.value for row in foot.measures if row.name == BALL_LENGTH), None)
    if own is None or scanned is None or "ball_line" not in rules:
        return []
    share, model = float(heels.share[0]), heels.question.model
    foot_mm = scanned + share * full_change(model, foot, BALL_LENGTH)[0]
    percent_mm = 0.01 * foot.aligned.alignment.extent_mm
    rule = rules["ball_line"]
    off = (own - foot_mm) / percent_mm
    ends = (off - inner_good(rule, off), *(RANGE * end for end in rule.good))
    target, low, high = (
        own + min(max(foot_mm + end * percent_mm - own, -MOST_BALL_MM), MOST_BALL_MM)
        for end in ends
    )
    aim = CustomAim(BALL_LENGTH, "ball_line", own, target, foot_mm, 0.0, firm=False)
    return [replace(aim, good_mm=(low, high))]


def _girths(
    foot: Profiled,
    base: BaseLast,
    rules: Mapping[str, ZoneRule],
    heels: Heels,
) -> list[CustomAim]:
    """The aims of the least tapes: those that the profile asks for, and that both shapes have."""
    share, model = float(heels.share[0]), heels.question.model
    of_foot = {row.name: row.measured.value for row in foot.measures}
    aims = []
    for name, zones in LEAST_TAPES.items():
        scanned_mm, base_mm = of_foot.get(name), measure_named(name).taken_of(base.shape).value
        if scanned_mm is None or base_mm is None or not all(zone in rules for zone in zones):
            continue
        foot_mm = scanned_mm + share * full_change(model, foot, name)[0]
        allowance = _mean([rules[zone].target + rules[zone].cavity for zone in zones])
        aim = CustomAim(name, zones[-1], base_mm, foot_mm + allowance, foot_mm, allowance)
        if name in GIVES_WAY:
            aim = replace(aim, good_mm=good_range(aim.target, rules[GIVES_WAY[name]]))
        aims.append(replace(aim, firm=name not in FOLLOWING))
    return aims


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
