"""Every last against one customer: distances, zones, verdicts, order and ties."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.flare.profile_distance import profile_distances
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.heels import Heels, full_change, heel_change, heels_of
from footfit.pipeline.fit.scoring import (
    NOT_JUDGED,
    REJECT,
    VERDICTS,
    Column,
    Scores,
    Spread,
    distance_spread,
    fit_distance,
    rescan_spread,
    scores,
    shown_digits,
    tiers,
    worst_levels,
)
from footfit.pipeline.fit.toe_box import KeptSections, last_toes, with_toe_boxes
from footfit.pipeline.fit.worn_shifts import Shift, shifted_rule, shifts_of, with_total
from footfit.pipeline.fit.zones import (
    LENGTH_SD_MM,
    TOE_BOX,
    TOES,
    ZONES,
    Clearances,
    clearances,
    is_length,
)
from footfit.results import (
    FitProfile,
    FlareDifference,
    FootFit,
    HeelQuestion,
    LastRecord,
    Profiled,
    SearchBy,
    ToeBox,
    ZoneFit,
)
from footfit.results.heel import AS_SCANNED, FLARE
from footfit.results.worn import BAREFOOT, Worn

TWIN_LENGTH_MM = 2.0
"""Two lasts with the same labels and opposite sides are one pair if their lengths differ less."""
INDEPENDENT = 6.0
"""How many independent measures a shape's measures are worth in a search by shape."""
GOVERNED = frozenset({"length", "ball_line"})
"""Zones that the longer foot of a pair decides alone."""


@dataclass(frozen=True, slots=True)
class JudgedLasts:
    """n lasts, judged for one customer in z columns: the zones of each foot.

    ``level`` (n,) indexes VERDICTS; ``distance`` (n,) is what the search goes by, and ``spread``
    how sure it is: by flare or shape that of a rescan. ``heels`` are those of the lasts.
    ``toe_boxes`` hold each foot's toes by row, of the lasts that no other zone rejects.
    """

    feet: tuple[Profiled, ...]
    lasts: tuple[LastRecord, ...]
    by: SearchBy
    columns: tuple[Column, ...]
    heels: Heels
    clearances: Clearances
    scores: Scores
    level: Ints
    flare: tuple[FlareDifference, ...]
    distance: Floats
    spread: Spread
    toe_boxes: tuple[Mapping[int, ToeBox], ...]
    shifts: tuple[Mapping[str, Shift], ...] = ()

    @property
    def longer(self) -> int:
        """The place of the foot that governs the length."""
        return governing(self.feet)

    @property
    def known(self) -> Bools:
        """Which columns each last could be judged in, (n, z)."""
        return np.isfinite(self.scores.score)

    @property
    def sound(self) -> Bools:
        """Which lasts were judged in every required zone, (n,)."""
        required = [i for i, c in enumerate(self.columns) if c.counts and c.rule.required]
        every: Bools = np.all(self.known[:, required], axis=1)
        return every

    @property
    def length_column(self) -> int:
        """The column of the governing foot's length."""
        return next(i for i, c in enumerate(self.columns) if c.rule.zone == "length" and c.counts)

    @property
    def toe_room_level(self) -> Ints:
        """The verdict of each last on the toe room of the foot that governs the length, (n,)."""
        level: Ints = self.scores.level[:, self.length_column]
        return level

    def mirrored(self, row: int) -> bool:
        """Is the last of the other side than the foot that governs the length?"""
        return self.lasts[row].side.side != self.feet[self.longer].aligned.alignment.side.side


@dataclass(frozen=True, slots=True)
class Ranking:
    """The rows of the lasts that are kept, best first, and the tier of each."""

    rows: tuple[int, ...]
    tier: tuple[int, ...]

    def tied(self, place: int) -> tuple[int, ...]:
        """The other rows of the tier of the last at ``place``."""
        own = self.tier[place]
        pairs = enumerate(zip(self.rows, self.tier, strict=True))
        return tuple(row for at, (row, tier) in pairs if tier == own and at != place)


def judged_lasts(
    feet: Sequence[Profiled],
    lasts: Sequence[LastRecord],
    profile: FitProfile,
    by: SearchBy,
    heel: HeelQuestion = AS_SCANNED,
    file: KeptSections = None,
    worn: Worn = BAREFOOT,
) -> JudgedLasts:
    """Every last, judged for one customer; of two feet the longer governs the length.

    ``file`` is where the lasts' sections are kept. What is ``worn`` shifts what
    is asked of each foot.
    """
    longer = governing(feet)
    chosen = own_side(lasts, feet[longer].aligned.alignment.side.side)
    shifts = tuple(shifts_of(foot, profile, worn) for foot in feet)
    columns = tuple(
        Column(
            index,
            shifted_rule(rule, shifts[index][rule.zone]),
            rule.weight > 0 and (index == longer or rule.zone not in GOVERNED),
        )
        for index in range(len(feet))
        for rule in profile.zones
    )
    lifted = replace(heel, heel_lift_mm=worn.heel_lift_mm or 0.0)
    heels = heels_of(AS_SCANNED if by == "shape" else lifted, chosen)
    room = clearances(feet, chosen, columns, heels)
    boxes: tuple[Mapping[int, ToeBox], ...] = tuple({} for _ in feet)
    if by != "shape" and any(rule.zone in TOE_BOX for rule in profile.zones):
        rows = _passing(room, columns)
        toes = dict(zip(rows, last_toes(file, [chosen[row] for row in rows]), strict=True))
        room, boxes = with_toe_boxes(room, columns, feet, toes, heels)
    judged = scores(room.value, room.foot_sd, room.last_sd, columns, room.heel_sd)
    flare = flare_differences(feet, chosen, heels)
    return JudgedLasts(
        feet=tuple(feet),
        lasts=tuple(chosen),
        by=by,
        columns=columns,
        heels=heels,
        clearances=room,
        scores=judged,
        level=worst_levels(judged.level, columns),
        flare=tuple(flare),
        distance=_distance(by, judged, flare, feet[longer], chosen),
        spread=distance_spread(judged) if by == "fit" else rescan_spread(len(chosen)),
        toe_boxes=boxes,
        shifts=shifts,
    )


def _passing(room: Clearances, columns: Sequence[Column]) -> list[int]:
    """The rows of the lasts that have a toe room and that no zone rejects."""
    level = scores(room.value, room.foot_sd, room.last_sd, columns, room.heel_sd).level
    lengths = [place for place, column in enumerate(columns) if is_length(column)]
    known = (level[:, lengths] != NOT_JUDGED).all(axis=1)
    rows: list[int] = np.flatnonzero(known & (worst_levels(level, columns) < REJECT)).tolist()
    return rows


def governing(feet: Sequence[Profiled]) -> int:
    """Which foot decides the length: the longest, the first of equals."""
    return max(range(len(feet)), key=lambda i: (feet[i].length_or_extent_mm, -i))


def flare_differences(
    feet: Sequence[Profiled], lasts: Sequence[LastRecord], heels: Heels
) -> list[FlareDifference]:
    """The profile distance of each last, and the difference of the flare angles; two feet count by
    their root mean square, and by their mean.

    The heel changes the foot's angle. The profiles are compared as they were scanned: the heel
    model has no profile.
    """
    each = [profile_distances(foot.flare, [last.flare for last in lasts]) for foot in feet]
    total = np.sqrt(np.mean([np.square(distances.total) for distances in each], axis=0))
    angle = sum(foot.flare.angle_deg for foot in feet) / len(feet)
    turn_deg = heels.share * full_change(heels.question.model, feet[0], FLARE)[0]
    return [
        FlareDifference(
            float(total[i]),
            last.flare.angle_deg - angle - float(turn_deg[i]),
            tuple((name, float(values[i])) for name, values in each[0].parts.items()),
        )
        for i, last in enumerate(lasts)
    ]


def _distance(
    by: SearchBy,
    judged: Scores,
    flare: Sequence[FlareDifference],
    foot: Profiled,
    lasts: Sequence[LastRecord],
) -> Floats:
    """What the search goes by (n,)."""
    if by == "fit":
        return fit_distance(judged)
    profile = np.array([difference.distance for difference in flare])
    if by == "flare":
        return profile
    nearness: Floats = np.sqrt(np.square(profile) + size_squares(foot, lasts))
    return nearness


def size_squares(mesh: Profiled, lasts: Sequence[LastRecord]) -> Floats:
    """How far each last's measures are from the mesh's, (n,), in squared standard deviations.

    It is the square of the extents' difference plus the mean square of the other measures'
    differences, times INDEPENDENT: the measures of one shape are not independent of each other, so
    their number does not matter.
    """
    ours = {m.name: m for m in mesh.measures if m.name != "length"}
    squares = []
    for last in lasts:
        longer_mm = last.extent_mm - mesh.aligned.alignment.extent_mm
        shared = []
        for theirs in last.measures:
            own = ours.get(theirs.name)
            if own is None or own.definition != theirs.definition:
                continue
            a, b = own.measured, theirs.measured
            if a.value is not None and b.value is not None and a.sd and b.sd:
                shared.append((b.value - a.value) ** 2 / (a.sd**2 + b.sd**2))
        mean = sum(shared) / len(shared) if shared else 0.0
        squares.append(longer_mm**2 / (2.0 * LENGTH_SD_MM**2) + INDEPENDENT * mean)
    return np.array(squares)


def own_side(lasts: Sequence[LastRecord], side: str | None) -> list[LastRecord]:
    """The lasts, without those of the other side whose twin of the foot's own side is stored."""
    own: dict[tuple[str | None, ...], list[LastRecord]] = {}
    for last in lasts:
        if last.side.side == side:
            own.setdefault(_labels(last), []).append(last)
    return [
        last
        for last in lasts
        if last.side.side == side
        or not any(_twins(last, other) for other in own.get(_labels(last), ()))
    ]


def _labels(last: LastRecord) -> tuple[str | None, ...]:
    labels = last.labels
    return labels.style, labels.size, labels.size_system, labels.width_label


def _twins(last: LastRecord, other: LastRecord) -> bool:
    """Are two lasts with the same labels the two sides of one model and size?"""
    named = last.labels.style is not None and last.labels.size is not None
    return named and abs(last.extent_mm - other.extent_mm) < TWIN_LENGTH_MM


def ranking(judged: JudgedLasts, tie_sds: float) -> Ranking:
    """The order of the lasts.

    By fit the rejects and the lasts without a toe room are left out. The verdict comes first, then
    whether every required zone was judged, then the verdict on the toe room, then the distance.
    """
    if judged.by != "fit":
        rows = _by_distance(judged, range(len(judged.lasts)))
        one = np.zeros(len(judged.lasts), dtype=np.int64)
        return Ranking(tuple(rows), tuple(tiers(rows, judged.distance, one, judged.spread, 1.0)))
    group = 2 * judged.level + ~judged.sound
    group = len(VERDICTS) * group + judged.toe_room_level
    kept = [i for i in with_toe_room(judged) if judged.level[i] < REJECT]
    rows = sorted(_by_distance(judged, kept), key=lambda i: group[i])
    tier = tiers(rows, judged.distance, group, judged.spread, tie_sds)
    return Ranking(tuple(rows), tuple(tier))


def _by_distance(judged: JudgedLasts, rows: Iterable[int]) -> list[int]:
    """The rows by distance, then by name."""
    return sorted(
        rows, key=lambda i: (round(float(judged.distance[i]), 6), judged.lasts[i].labels.name)
    )


def with_toe_room(judged: JudgedLasts) -> list[int]:
    """The rows whose toe room is known: the length is the gate, so no other last is judged."""
    level: list[int] = judged.toe_room_level.tolist()
    return [row for row, known in enumerate(level) if known != NOT_JUDGED]


def nearest(judged: JudgedLasts, count: int) -> list[int]:
    """The rows of the lasts that come nearest to fitting."""
    return _by_distance(judged, with_toe_room(judged))[:count]


def refusals(judged: JudgedLasts) -> Counter[str]:
    """How many lasts are left out, by reason: the first zone that rejects a last, or
    "length_unknown" if its toe room is not known.
    """
    known = with_toe_room(judged)
    counts = Counter(refusal(judged, i) for i in known if judged.level[i] == REJECT)
    return counts + Counter({"length_unknown": len(judged.lasts) - len(known)})


def refusal(judged: JudgedLasts, row: int) -> str:
    """Why a reject is one: "too_short", "too_long", or the zone and the direction."""
    for place, column in enumerate(judged.columns):
        if column.counts and judged.scores.level[row, place] == REJECT:
            zone, loose = ZONES[column.rule.zone], judged.scores.score[row, place] > 0
            word = zone.more if loose else zone.less
            start = "too" if zone.name == "length" else zone.name
            return f"{start}_{word}".replace(" ", "_")
    raise ValueError("the last is no reject")


def foot_fits(judged: JudgedLasts, row: int) -> tuple[FootFit, ...]:
    """Each foot of the customer in one last, zone by zone."""
    fits = []
    for index, foot in enumerate(judged.feet):
        places = [i for i, column in enumerate(judged.columns) if column.foot == index]
        level = judged.scores.level[row : row + 1, places]
        verdict = VERDICTS[worst_levels(level, [judged.columns[i] for i in places])[0]]
        zones = tuple(_zone_fit(judged, row, place) for place in places)
        side, heel = foot.aligned.alignment.side.side, heel_change(judged.heels, row, foot)
        toes = judged.toe_boxes[index].get(row)
        fits.append(FootFit(side, verdict, zones, heel, toes))
    return tuple(fits)


def _zone_fit(judged: JudgedLasts, row: int, place: int) -> ZoneFit:
    column, level = judged.columns[place], judged.scores.level[row, place]
    toes = judged.toe_boxes[column.foot].get(row) if column.rule.zone == TOES else None
    zone, clearance = ZONES[column.rule.zone], judged.clearances.measured(row, place)
    shift = judged.shifts[column.foot][zone.name]
    foot, last = judged.feet[column.foot], judged.lasts[row]
    clearance = with_total(clearance, zone.name, (foot.measures, last.measures), shift.sd)
    known = clearance.value is not None
    return ZoneFit(
        zone=zone.name,
        unit=zone.unit,
        clearance=clearance,
        target=column.rule.target,
        score=float(judged.scores.score[row, place]) if level != NOT_JUDGED else None,
        verdict=VERDICTS[level] if level != NOT_JUDGED else None,
        counts=column.counts,
        place=None if toes is None else toes.tightest.place,
        label=zone.label,
        not_counted=None if column.counts else _not_counted(judged, column),
        grade=column.rule.grade,
        digits=shown_digits(clearance.value or 0.0, column.rule, zone.unit) if known else 1,
    )


def _not_counted(judged: JudgedLasts, column: Column) -> str:
    """Why a zone of a foot judges nothing."""
    if column.rule.weight <= 0:
        return "the fit profile only shows this zone"
    side = judged.feet[judged.longer].aligned.alignment.side.side
    return f"the {f'{side} foot' if side else 'longer foot'} decides this"
