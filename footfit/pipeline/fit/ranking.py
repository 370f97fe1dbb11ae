"""Every last against one customer: distances, zones, verdicts, order and ties."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.flare_profile import profile_distances
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.scoring import (
    NOT_JUDGED,
    REJECT,
    VERDICTS,
    Column,
    Judged,
    Spread,
    distance_spread,
    fit_distance,
    fixed_tiers,
    judged,
    tiers,
    worst_levels,
)
from footfit.pipeline.fit.zones import LENGTH_SD_MM, ZONES, Clearances, clearances
from footfit.results import (
    FitProfile,
    FlareDifference,
    FootFit,
    LastRecord,
    Profiled,
    SearchBy,
    ZoneFit,
)

TIE_DISTANCE = 2.0**0.5
"""Two distances by flare or shape closer than this are a tie: each carries a rescan's spread."""
TWIN_LENGTH_MM = 2.0
"""Two lasts with the same labels and opposite sides are one pair if their lengths differ less."""
INDEPENDENT = 6.0
"""How many independent measures a shape's measures are worth in a search by shape."""
GOVERNED = frozenset({"length", "ball_line"})
"""Zones that the longer foot of a pair decides alone."""


@dataclass(frozen=True, slots=True)
class Field:
    """n lasts against one customer.

    ``level`` (n,) indexes VERDICTS; ``distance`` (n,) is what the search goes by; ``spread``
    belongs to the fit distance.
    """

    lasts: tuple[LastRecord, ...]
    mirrored: tuple[bool, ...]
    flare: tuple[FlareDifference, ...]
    columns: tuple[Column, ...]
    clearances: tuple[Clearances, ...]
    judged: Judged
    level: Ints
    distance: Floats
    spread: Spread


@dataclass(frozen=True, slots=True)
class Placing:
    """The order of the lasts that are kept: rows of the field, best first, with their tiers."""

    order: tuple[int, ...]
    tier: tuple[int, ...]

    def tied(self, place: int) -> tuple[int, ...]:
        """The other rows of the tier of the one at ``place``."""
        return tuple(
            i
            for at, (i, tier) in enumerate(zip(self.order, self.tier, strict=True))
            if tier == self.tier[place] and at != place
        )


def field(
    feet: Sequence[Profiled], lasts: Sequence[LastRecord], profile: FitProfile, by: SearchBy
) -> Field:
    """Judge every last for one customer; of two feet the longer governs the length."""
    longer = governing(feet)
    side = feet[longer].aligned.alignment.side.side
    chosen = own_side(lasts, side)
    columns = tuple(
        Column(index, rule, rule.weight > 0 and (index == longer or rule.zone not in GOVERNED))
        for index in range(len(feet))
        for rule in profile.zones
    )
    found = tuple(clearances(foot, chosen, profile.zones) for foot in feet)
    scored = judged(
        np.concatenate([c.values for c in found], axis=1),
        np.concatenate([c.foot_sd for c in found], axis=1),
        np.concatenate([c.last_sd for c in found], axis=1),
        columns,
    )
    flare = flare_differences(feet, chosen)
    return Field(
        lasts=tuple(chosen),
        mirrored=tuple(last.side.side != side for last in chosen),
        flare=tuple(flare),
        columns=columns,
        clearances=found,
        judged=scored,
        level=worst_levels(scored, columns),
        distance=_distance(by, scored, flare, feet[longer], chosen),
        spread=distance_spread(scored),
    )


def governing(feet: Sequence[Profiled]) -> int:
    """Which foot decides the length: the longest, the first of equals."""
    return max(range(len(feet)), key=lambda i: (feet[i].length_or_extent_mm, -i))


def flare_differences(
    feet: Sequence[Profiled], lasts: Sequence[LastRecord]
) -> list[FlareDifference]:
    """The profile distance of each last; two feet count by their root mean square."""
    found = [profile_distances(one.flare, [last.flare for last in lasts]) for one in feet]
    total = np.sqrt(np.mean([np.square(d.total) for d in found], axis=0))
    angle = sum(one.flare.angle_deg for one in feet) / len(feet)
    return [
        FlareDifference(
            float(total[i]),
            last.flare.angle_deg - angle,
            tuple((name, float(values[i])) for name, values in found[0].parts.items()),
        )
        for i, last in enumerate(lasts)
    ]


def _distance(
    by: SearchBy,
    scored: Judged,
    flare: Sequence[FlareDifference],
    foot: Profiled,
    lasts: Sequence[LastRecord],
) -> Floats:
    """What the search goes by (n,)."""
    if by == "fit":
        return fit_distance(scored)
    profile = np.array([one.distance for one in flare])
    if by == "flare":
        return profile
    nearness: Floats = np.sqrt(np.square(profile) + size_squares(foot, lasts))
    return nearness


def size_squares(mesh: Profiled, lasts: Sequence[LastRecord]) -> Floats:
    """How far each last's measures are from the mesh's (n,): the length's square and the mean
    square of the other measures that both have, all in standard deviations of the difference.
    Measures of one shape move together: they count as INDEPENDENT ones, however many there are.
    """
    ours = {m.name: m for m in mesh.measures}
    extent_mm = mesh.aligned.alignment.extent_mm
    squares = []
    for last in lasts:
        own = (last.extent_mm - extent_mm) ** 2 / (2.0 * LENGTH_SD_MM**2)
        shared = []
        for measure in last.measures:
            other = ours.get(measure.name)
            if other is None or other.definition != measure.definition or measure.name == "length":
                continue
            a, b = other.measured, measure.measured
            if a.value is not None and b.value is not None and a.sd and b.sd:
                shared.append((b.value - a.value) ** 2 / (a.sd**2 + b.sd**2))
        squares.append(own + (INDEPENDENT * sum(shared) / len(shared) if shared else 0.0))
    return np.array(squares)


def own_side(lasts: Sequence[LastRecord], side: str | None) -> list[LastRecord]:
    """Where both sides of one last are stored, the one of the foot's own side."""
    own: dict[tuple[str | None, ...], list[LastRecord]] = {}
    for last in lasts:
        if last.side.side == side:
            own.setdefault(_labels(last), []).append(last)
    return [
        last
        for last in lasts
        if last.side.side == side
        or not any(_twins(last, one) for one in own.get(_labels(last), ()))
    ]


def _labels(last: LastRecord) -> tuple[str | None, ...]:
    labels = last.labels
    return labels.style, labels.size, labels.size_system, labels.width_label


def _twins(one: LastRecord, other: LastRecord) -> bool:
    """Is one the other side's last of the same model and size? Their labels are alike."""
    named = one.labels.style is not None and one.labels.size is not None
    return named and abs(one.extent_mm - other.extent_mm) < TWIN_LENGTH_MM


def placed(found: Field, profile: FitProfile, by: SearchBy) -> Placing:
    """The order of the lasts: by fit those that are no reject and whose toe room is known, length
    first: by the verdict on the length, by the whole verdict, then by distance.
    """
    names = [last.labels.name for last in found.lasts]
    if by != "fit":
        order = sorted(
            range(len(names)), key=lambda i: (round(float(found.distance[i]), 6), names[i])
        )
        tier = fixed_tiers([float(found.distance[i]) for i in order], TIE_DISTANCE)
        return Placing(tuple(order), tuple(tier))
    group = found.judged.level[:, _length_column(found)] * len(VERDICTS) + found.level
    kept = [i for i in with_toe_room(found) if found.level[i] < REJECT]
    kept.sort(key=lambda i: (group[i], round(float(found.distance[i]), 6), names[i]))
    tier_of = tiers(kept, found.distance, group, found.spread, profile.tie_sds)
    return Placing(tuple(kept), tuple(tier_of))


def with_toe_room(found: Field) -> list[int]:
    """The rows whose toe room is known: the length is the gate, so no other last is judged."""
    return np.flatnonzero(found.judged.level[:, _length_column(found)] != NOT_JUDGED).tolist()


def _length_column(found: Field) -> int:
    """The column of the governing foot's length."""
    return next(
        i
        for i, column in enumerate(found.columns)
        if column.rule.zone == "length" and column.counts
    )


def nearest(found: Field, count: int) -> list[int]:
    """The rows that come nearest to fitting, by distance then name."""
    names = [last.labels.name for last in found.lasts]
    rows = with_toe_room(found)
    rows.sort(key=lambda i: (round(float(found.distance[i]), 6), names[i]))
    return rows[:count]


def refusals(found: Field) -> Counter[str]:
    """How many lasts are left out: by the first zone that rejects each, and those without a known
    toe room.
    """
    known = with_toe_room(found)
    counts = Counter(refusal(found, i) for i in known if found.level[i] == REJECT)
    return counts + Counter({"length_unknown": len(found.lasts) - len(known)})


def refusal(found: Field, row: int) -> str:
    """Why a reject is one: "too_short", "too_long", or the zone and the direction."""
    for column, level, score in zip(
        found.columns, found.judged.level[row], found.judged.score[row], strict=True
    ):
        if column.counts and level == REJECT:
            kind = ZONES[column.rule.zone]
            if kind.name == "length":
                return "too_short" if score < 0 else "too_long"
            return f"{kind.name}_{kind.more if score > 0 else kind.less}".replace(" ", "_")
    raise ValueError("the last is no reject")


def foot_fits(found: Field, row: int, feet: Sequence[Profiled]) -> tuple[FootFit, ...]:
    """Each foot of the customer in one last, zone by zone."""
    return tuple(
        _foot_fit(found, row, index, foot.aligned.alignment.side.side)
        for index, foot in enumerate(feet)
    )


def _foot_fit(found: Field, row: int, foot: int, side: str | None) -> FootFit:
    places = [i for i, column in enumerate(found.columns) if column.foot == foot]
    zones = tuple(_zone_fit(found, row, place, at) for at, place in enumerate(places))
    only = Judged(
        found.judged.score[row : row + 1, places],
        found.judged.level[row : row + 1, places],
        found.judged.foot_sd[row : row + 1, places],
        found.judged.last_sd[row : row + 1, places],
        found.judged.weight[places],
    )
    worst = worst_levels(only, [found.columns[i] for i in places])[0]
    return FootFit(side, VERDICTS[worst], zones)  # type: ignore[arg-type]


def _zone_fit(found: Field, row: int, place: int, zone: int) -> ZoneFit:
    column = found.columns[place]
    level, score = found.judged.level[row, place], float(found.judged.score[row, place])
    return ZoneFit(
        zone=column.rule.zone,
        unit=ZONES[column.rule.zone].unit,
        clearance=found.clearances[column.foot].measured(row, zone),
        target=column.rule.target,
        score=score if level >= 0 else None,
        verdict=VERDICTS[level] if level >= 0 else None,
        counts=column.counts,
    )
