"""Every last against one customer: distances, zones, verdicts, order and ties.

A fit is gated first: clearances and verdicts are taken of all lasts, some thousand at a time, and
the distance only of those that nothing rejects. A search by flare or shape ranks by its distance
first, and judges only the lasts that are shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.catalogue.blocks.block_bytes import BOTTOM, MEASURES, PLAN, TOES
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.heels import Heels, full_change, heel_change, joined_heels
from footfit.pipeline.fit.judging.clearances import joined_clearances
from footfit.pipeline.fit.judging.judged_lasts import (
    Asked,
    Gated,
    JudgedLasts,
    judged_lasts,
    levels_of,
    refusals_of,
    rooms_of,
)
from footfit.pipeline.fit.judging.toe_box import OF_TOES, toe_box, toes_can_reject
from footfit.pipeline.fit.scoring import (
    NOT_JUDGED,
    REJECT,
    Column,
    rescan_spread,
    shown_digits,
    tiers,
    worst_levels,
)
from footfit.pipeline.fit.worn_shifts import with_total
from footfit.pipeline.fit.zones import TOES as TOES_ZONE
from footfit.pipeline.fit.zones import ZONES
from footfit.pipeline.shelf.nearness import feet_distance, flare_distances, shape_distance
from footfit.pipeline.shelf.shelf import KeptSections, Lasts, of_own_side, record_lasts
from footfit.results import FlareDifference, FootFit, LastRecord, Profiled, ToeBox, ZoneFit
from footfit.results.columns.last_columns import SIDES, LastColumns, joined
from footfit.results.columns.vocabulary import NO_WORD, Words
from footfit.results.heel import FLARE
from footfit.results.values import VERDICTS

DISTANCE_DIGITS = 6
"""Lasts whose distances are equal to so many decimals are ordered by name."""
FIRST_LAID, LAY_MORE = 32, 4
"""Toes are laid into so many of the most promising lasts first, then into so many times more."""
TIE_SDS = 1.0
TIED_WITHIN = TIE_SDS * 2**0.5
"""Two distances by flare or shape are tied if they differ by no more than two scans of one shape
differ, in units of what each scan is wrong by.
"""
FIRST_LOOK, LOOK_FURTHER = 8, 8
"""A search by flare or shape sorts so many of the best lasts first, then so many times more."""


@dataclass(frozen=True, slots=True)
class Ranking:
    """The best lasts of a customer. ``judged`` are those that are shown, in their order.

    ``names`` are those of all lasts in their order, to the end of the last tier that is shown, and
    ``tier`` is that of each. ``nearest`` says that no last fits: the order is that of all lasts
    with a toe room.
    """

    judged: JudgedLasts
    gated: Gated
    names: tuple[str, ...]
    tier: tuple[int, ...]
    nearest: bool = False

    def tied(self, place: int) -> tuple[str, ...]:
        """The other lasts of the tier of the last at ``place``."""
        own = self.tier[place]
        pairs = enumerate(zip(self.names, self.tier, strict=True))
        return tuple(name for at, (name, tier) in pairs if tier == own and at != place)


def ranking(asked: Asked, lasts: Lasts, among: Bools, top: int, nearest: int) -> Ranking:
    """The order of the lasts ``among`` (n,) the given ones; of two feet the longer governs the
    length. So many as ``top`` says are shown, and all if it is 0.

    By fit the rejects and the lasts without a toe room are left out. The verdict comes first, then
    whether every required zone was judged, then the verdict on the toe room, then the distance. If
    no last fits, those that come ``nearest`` are shown: so many.
    """
    side = SIDES.index(asked.feet[asked.longer].aligned.alignment.side.side)
    chosen = of_own_side(lasts, among, side)
    if asked.by != "fit":
        return _ranked_by_distance(asked, lasts, chosen, top)
    judged, gated = _gate(asked, lasts, chosen, rejects=False)
    if not (judged.level < REJECT).any():
        judged, gated = _gate(asked, lasts, chosen, rejects=True)
        one = np.zeros(len(judged.rows), dtype=np.int64)
        order = _by_distance(judged.distance, one, judged.lasts.names)[:nearest]
        return Ranking(judged.taken(order), gated, (), (), nearest=True)
    return _ranked_by_fit(asked, judged, gated, top)


def _ranked_by_fit(asked: Asked, best: JudgedLasts, gated: Gated, top: int) -> Ranking:
    """The order by fit. ``best`` is what each last can be at best: toes are laid only into those
    that can come into what is shown, the most promising first.
    """
    bounds = _keys(best)
    promising = np.lexsort(bounds)
    exact = not asked.toes or toes_can_reject(asked.columns)
    wanted = len(promising) if exact or not top else FIRST_LAID
    while True:
        some = promising[:wanted]
        judged = best.taken(some)
        if not exact:
            judged = judged_lasts(
                asked, judged.lasts, judged.rows, judged.heels, judged.clearances, gated.known
            )
        digits, group = _keys(judged)
        kept = np.flatnonzero(judged.level < REJECT)
        if wanted < len(promising):  # only those that no other last can come before
            least, of_group = (key[promising[wanted]] for key in bounds)
            ahead = (group < of_group) | ((group == of_group) & (digits < least))
            kept = kept[ahead[kept]]
        names = [judged.lasts.names[row] for row in kept.tolist()]
        order = kept[_by_distance(judged.distance[kept], group[kept], names)]
        tier = tiers(order, judged.distance, group, judged.spread, asked.tie_sds, top)
        if wanted >= len(promising) or (len(order) >= top and len(tier) < len(order)):
            ordered = tuple(judged.lasts.names[row] for row in order[: len(tier)].tolist())
            return Ranking(judged.taken(order[: top or None]), gated, ordered, tuple(tier))
        wanted *= LAY_MORE


def _keys(judged: JudgedLasts) -> tuple[Floats, Ints]:
    """What lasts are ordered by, the last first: the distance, and the group."""
    group = 2 * judged.level + ~judged.sound
    group = len(VERDICTS) * group + judged.toe_room_level
    return np.round(judged.distance, DISTANCE_DIGITS), group


def standing(judged: JudgedLasts) -> tuple[int, float]:
    """How the first of some lasts stands: of two the smaller standing comes first."""
    digits, group = _keys(judged)
    return (int(group[0]) if judged.asked.by == "fit" else 0), float(digits[0])


def _by_distance(distance: Floats, group: Ints, names: Sequence[str]) -> Ints:
    """The order by group, then by distance, then by name."""
    digits = np.round(distance, DISTANCE_DIGITS)
    order = np.lexsort((digits, group))
    same = (np.diff(digits[order]) == 0.0) & (np.diff(group[order]) == 0)
    ends = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(np.int8)))
    for start, end in ends.reshape(-1, 2).tolist():  # runs of equals
        run = order[start : end + 1].tolist()
        order[start : end + 1] = sorted(run, key=lambda row: names[row])
    return order


# ---------------------------------------------------------------- by flare and by shape


def _ranked_by_distance(asked: Asked, lasts: Lasts, chosen: Bools, top: int) -> Ranking:
    """The order by flare or shape. Only the lasts that are shown are judged."""
    rows, least = np.flatnonzero(chosen), None
    if asked.by == "flare" and lasts.search is not None and 0 < top < len(rows):
        from footfit.pipeline.shelf.near_lasts import nearest_by_flare

        least = nearest_by_flare(asked.feet, lasts.search, chosen, top, TIED_WITHIN)
    near, distance = least or (rows, _all_distances(asked, lasts, chosen))
    best, tier, wanted = near, [0], FIRST_LOOK
    while len(tier) == len(best) < len(near) or wanted == FIRST_LOOK:
        wanted = len(near) if least or not top else wanted * LOOK_FURTHER
        best = _best(distance, near, wanted)
        one = np.zeros(len(best), dtype=np.int64)
        order = _by_distance(distance[best], one, lasts.base.taken(best).names)
        tier = tiers(order, distance[best], one, rescan_spread(len(best)), TIE_SDS, top)
    shown = best[order[: top or None]]
    columns = lasts.taken(shown, (*asked.parts, TOES) if asked.toes else asked.parts)
    judged = judged_lasts(asked, columns, shown, *rooms_of(asked, columns, Words()))
    judged = replace(judged, distance=distance[shown], spread=rescan_spread(len(shown)))
    ordered = tuple(lasts.base.taken(best[order[: len(tier)]]).names)
    return Ranking(judged, Gated(len(rows), len(rows)), ordered, tuple(tier))


def _all_distances(asked: Asked, lasts: Lasts, chosen: Bools) -> Floats:
    """The distance (n,) by flare or shape of each last that is ``chosen`` (n,)."""
    by_shape = asked.by == "shape"
    distance = np.full(len(chosen), np.nan)
    for start, chunk in lasts.chunks((MEASURES, PLAN, BOTTOM) if by_shape else (PLAN, BOTTOM)):
        some = np.arange(len(chunk))
        if (chunk.stations != len(asked.feet[0].flare.stations)).any():  # of outdated profiles
            some = np.flatnonzero(chosen[start : start + len(chunk)])
            chunk = chunk.taken(some)
        distance[start + some] = (
            shape_distance(asked.feet, asked.longer, chunk)
            if by_shape
            else feet_distance(asked.feet, chunk)
        )
    return distance


def _best(distance: Floats, rows: Ints, wanted: int) -> Ints:
    """At least so many of the rows with the least distances; all that are equal to the last."""
    if wanted >= len(rows):
        return rows
    digits = np.round(distance[rows], DISTANCE_DIGITS)
    least = np.partition(digits, wanted)[wanted]
    return rows if np.isnan(least) else rows[digits <= least]


# ---------------------------------------------------------------- by fit


def _gate(asked: Asked, lasts: Lasts, chosen: Bools, *, rejects: bool) -> tuple[JudgedLasts, Gated]:
    """The lasts that no zone rejects, judged, and what was seen of all; with ``rejects`` every last
    that has a toe room.
    """
    sentences, gated, parts = Words(), Gated(known=np.zeros(len(asked.columns), dtype=bool)), []
    for start, chunk in lasts.chunks(asked.parts):
        some = np.flatnonzero(chosen[start : start + len(chunk)])
        part = chunk if len(some) == len(chunk) else chunk.taken(some)
        heels, room = rooms_of(asked, part, sentences)
        level = levels_of(asked, room)
        worst = worst_levels(level, asked.columns)
        known = level[:, asked.length_column] != NOT_JUDGED
        gated = gated.and_seen(
            len(some), known, refusals_of(asked, room, level, known & (worst == REJECT)), room
        )
        kept = np.flatnonzero(known if rejects else known & (worst < REJECT))
        assert part.measures is not None
        slim = replace(part, flare=None, measures=part.measures.only(OF_TOES)).taken(kept)
        parts.append((start + some[kept], slim, heels.taken(kept), room.taken(kept)))
    rows = np.concatenate([rows for rows, *_ in parts])
    part = joined([part for _, part, *_ in parts])
    heels = joined_heels([heels for *_, heels, _ in parts])
    room = joined_clearances([room for *_, room in parts])
    if asked.toes and len(rows):
        part = replace(part, toes=lasts.taken(rows, (TOES,)).toes)
    walls = rejects or toes_can_reject(asked.columns)
    judged = judged_lasts(asked, part, rows, heels, room, gated.known, walls=walls)
    return judged, gated.and_toes(asked, judged)


def flare_differences(
    feet: Sequence[Profiled], lasts: LastColumns, heels: Heels
) -> list[FlareDifference]:
    """The profile distance of each last, and the difference of the flare angles; two feet count by
    their root mean square, and by their mean.

    The heel changes the foot's angle. The profiles are compared as they were scanned: the heel
    model has no profile.
    """
    if not len(lasts):
        return []
    total, parts = feet_distance(feet, lasts), flare_distances(feet[0].flare, lasts).parts
    angle = sum(foot.flare.angle_deg for foot in feet) / len(feet)
    turn_deg = heels.share * full_change(heels.question.model, feet[0], FLARE)[0]
    delta_deg = lasts.angle_deg - angle - turn_deg
    return [
        FlareDifference(
            float(total[i]),
            float(delta_deg[i]),
            tuple((name, float(values[i])) for name, values in parts.items()),
        )
        for i in range(len(lasts))
    ]


def judged_last(asked: Asked, last: LastRecord, sections: KeptSections) -> JudgedLasts:
    """One last, judged for one customer."""
    columns = record_lasts([last], sections).base
    heels, room = rooms_of(asked, columns, Words())
    return judged_lasts(asked, columns, np.zeros(1, np.int64), heels, room)


def foot_fits(judged: JudgedLasts, row: int, last: LastRecord) -> tuple[FootFit, ...]:
    """Each foot of the customer in one last, zone by zone; ``last`` is its record."""
    fits = []
    asked = judged.asked
    for index, foot in enumerate(asked.feet):
        places = [i for i, column in enumerate(asked.columns) if column.foot == index]
        level = judged.scores.level[row : row + 1, places]
        verdict = VERDICTS[worst_levels(level, [asked.columns[i] for i in places])[0]]
        toes = _toe_box(judged, index, row)
        zones = tuple(_zone_fit(judged, row, place, last, toes) for place in places)
        side, heel = foot.aligned.alignment.side.side, heel_change(judged.heels, row, foot)
        fits.append(FootFit(side, verdict, zones, heel, toes))
    return tuple(fits)


def _toe_box(judged: JudgedLasts, index: int, row: int) -> ToeBox | None:
    """The toes of one foot in one last, if they were judged."""
    asked = judged.asked
    places = {c.rule.zone: i for i, c in enumerate(asked.columns) if c.foot == index}
    if not asked.toes or TOES_ZONE not in places:
        return None
    if judged.clearances.reason[row, places[TOES_ZONE]] != NO_WORD:
        return None
    length = places["length"]
    room_mm = judged.clearances.value[row, length] + asked.columns[length].rule.cavity
    cavity_mm = asked.columns[places[TOES_ZONE]].rule.cavity
    return toe_box(asked.toes[index], judged.lasts, row, judged.heels, room_mm, cavity_mm)


def _zone_fit(
    judged: JudgedLasts, row: int, place: int, last: LastRecord, toes: ToeBox | None
) -> ZoneFit:
    column, level = judged.asked.columns[place], judged.scores.level[row, place]
    zone, clearance = ZONES[column.rule.zone], judged.clearances.measured(row, place)
    toes = toes if zone.name == TOES_ZONE else None
    shift, foot = judged.asked.shifts[column.foot][zone.name], judged.asked.feet[column.foot]
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
    side = judged.asked.feet[judged.asked.longer].aligned.alignment.side.side
    return f"the {f'{side} foot' if side else 'longer foot'} decides this"
