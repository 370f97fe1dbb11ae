"""Lasts judged for one customer: what is asked, the verdicts and the scores, who is left out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from footfit.catalogue.blocks.block_bytes import MEASURES, PLAN
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.heels import Heels, heels_at
from footfit.pipeline.fit.judging.clearances import Clearances, clearances, is_length
from footfit.pipeline.fit.judging.toe_box import (
    NOT_STORED,
    FootToes,
    foot_toes,
    judges_toes,
    put_toe_boxes,
)
from footfit.pipeline.fit.scoring import (
    NOT_JUDGED,
    REJECT,
    Column,
    Scores,
    Spread,
    distance_spread,
    fit_distance,
    rescan_spread,
    room_levels,
    scores,
    worst_levels,
)
from footfit.pipeline.fit.worn_shifts import Shift, shifted_rule, shifts_of
from footfit.pipeline.fit.zones import NOT_READ, TOE_BOX, ZONES
from footfit.results import FitProfile, HeelQuestion, Profiled, SearchBy
from footfit.results.columns.last_columns import SIDES, LastColumns
from footfit.results.columns.vocabulary import Words
from footfit.results.heel import AS_SCANNED
from footfit.results.worn import BAREFOOT, Worn

GOVERNED = frozenset({"length", "ball_line"})
"""Zones that the longer foot of a pair decides alone."""


@dataclass(frozen=True, slots=True)
class Asked:
    """One customer's feet, and what is asked of each zone of each foot."""

    feet: tuple[Profiled, ...]
    by: SearchBy
    columns: tuple[Column, ...]
    shifts: tuple[dict[str, Shift], ...]
    heel: HeelQuestion
    toes: tuple[FootToes, ...]
    tie_sds: float

    @property
    def longer(self) -> int:
        """The place of the foot that governs the length."""
        return governing(self.feet)

    @property
    def length_column(self) -> int:
        """The column of the governing foot's length."""
        return next(i for i, c in enumerate(self.columns) if is_length(c) and c.counts)

    @property
    def parts(self) -> tuple[str, ...]:
        """What zones read of lasts, but for the toes."""
        plan = any(column.rule.zone == "plan" for column in self.columns)
        return (MEASURES, PLAN) if plan else (MEASURES,)


@dataclass(frozen=True, slots=True)
class JudgedLasts:
    """m lasts judged for one customer in z columns: the zones of each foot.

    ``rows`` (m,) are their rows on the shelf. ``level`` (m,) indexes VERDICTS; ``distance`` (m,) is
    what the search goes by, and ``spread`` how sure it is: by flare or shape that of a rescan.
    """

    asked: Asked
    rows: Ints
    lasts: LastColumns
    heels: Heels
    clearances: Clearances
    scores: Scores
    level: Ints
    distance: Floats
    spread: Spread

    def taken(self, rows: Ints) -> JudgedLasts:
        """Some of them."""
        names = ("lasts", "heels", "clearances", "scores", "spread")
        parts = {name: getattr(self, name) for name in names}
        arrays = {name: getattr(self, name)[rows] for name in ("rows", "level", "distance")}
        return replace(self, **{name: part.taken(rows) for name, part in parts.items()}, **arrays)

    @property
    def known(self) -> Bools:
        """Which columns each last could be judged in, (m, z)."""
        return np.isfinite(self.scores.score)

    @property
    def sound(self) -> Bools:
        """Which lasts were judged in every required zone, (m,)."""
        columns = self.asked.columns
        required = [i for i, c in enumerate(columns) if c.counts and c.rule.required]
        every: Bools = np.all(self.known[:, required], axis=1)
        return every

    @property
    def toe_room_level(self) -> Ints:
        """The verdict of each last on the toe room of the foot that governs the length, (m,)."""
        level: Ints = self.scores.level[:, self.asked.length_column]
        return level

    def mirrored(self, row: int) -> bool:
        """Is the last of the other side than the foot that governs the length?"""
        foot = self.asked.feet[self.asked.longer]
        return SIDES[int(self.lasts.side[row])] != foot.aligned.alignment.side.side


@dataclass(frozen=True, slots=True)
class Gated:
    """What was seen of all lasts that were asked: how many, and how many have a known toe room.

    ``refused`` counts those that are left out, by reason. ``known`` (z,) says which columns any
    last was judged in, and ``looked_at`` whether any toe box was.
    """

    asked: int = 0
    rooms: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    known: Bools = field(default_factory=lambda: np.zeros(0, dtype=bool))
    looked_at: bool = False
    without_sections: int = 0

    @property
    def refusals(self) -> Counter[str]:
        """How many lasts are left out, by reason; "length_unknown" without a toe room."""
        return self.refused + Counter({"length_unknown": self.asked - self.rooms})

    def and_seen(self, asked: int, rooms: Bools, refused: Counter[str], room: Clearances) -> Gated:
        """The same with more lasts: their number, which have a toe room, who is left out."""
        return replace(
            self,
            asked=self.asked + asked,
            rooms=self.rooms + int(np.count_nonzero(rooms)),
            refused=self.refused + refused,
            known=self.known | np.isfinite(room.value).any(axis=0),
        )

    def and_toes(self, asked: Asked, judged: JudgedLasts) -> Gated:
        """The same with what the toe boxes of the judged lasts say."""
        if not asked.toes:
            return self
        room, zones = judged.clearances, [column.rule.zone in TOE_BOX for column in asked.columns]
        toes = np.flatnonzero(zones)
        unread = room.reason[:, toes] == room.sentences.number(NOT_READ)
        by_toes = (judged.level == REJECT) & ~unread.any(axis=1)
        lacks = (room.reason == room.sentences.number(NOT_STORED)).any(axis=1)
        return replace(
            self,
            refused=self.refused + refusals_of(asked, room, judged.scores.level, by_toes),
            known=self.known | np.isfinite(room.value).any(axis=0),
            looked_at=bool((~unread).any()),
            without_sections=int(np.count_nonzero(lacks)),
        )


def asked_of(
    feet: Sequence[Profiled],
    profile: FitProfile,
    by: SearchBy,
    heel: HeelQuestion = AS_SCANNED,
    worn: Worn = BAREFOOT,
) -> Asked:
    """What is asked for one customer; what is ``worn`` shifts what is asked of each foot."""
    longer = governing(feet)
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
    toes = judges_toes(columns) and by != "shape"
    return Asked(
        feet=tuple(feet),
        by=by,
        columns=columns,
        shifts=shifts,
        heel=AS_SCANNED if by == "shape" else lifted,
        toes=tuple(map(foot_toes, feet)) if toes else (),
        tie_sds=profile.tie_sds,
    )


def rooms_of(asked: Asked, lasts: LastColumns, sentences: Words) -> tuple[Heels, Clearances]:
    """The heels of lasts, and the clearances in all zones but the toe box."""
    heels = heels_at(asked.heel, lasts.drop_mm)
    return heels, clearances(asked.feet, lasts, asked.columns, heels, sentences)


def levels_of(asked: Asked, room: Clearances) -> Ints:
    """The verdicts (n, z) of clearances."""
    return room_levels(room.value, room.foot_sd, room.last_sd, room.heel_sd, asked.columns)


def judged_lasts(
    asked: Asked,
    lasts: LastColumns,
    rows: Ints,
    heels: Heels,
    room: Clearances,
    known: Bools | None = None,
    *,
    walls: bool = True,
) -> JudgedLasts:
    """Lasts with their scores, after the toe boxes of those that no other zone rejects.

    ``known`` (z,) says which columns any last of the answer was judged in before that. Without
    ``walls`` toes are taken to be on target, so no verdict and no distance can be better.
    """
    room = room.copied()
    if asked.toes and len(rows):
        looked = np.flatnonzero(_looked_at(asked, room))
        boxes = lasts.taken(looked)
        put_toe_boxes(room, asked.columns, asked.toes, boxes, looked, heels, walls=walls)
    any_known = np.asarray(np.isfinite(room.value).any(axis=0))
    judged = scores(
        room.value,
        room.foot_sd,
        room.last_sd,
        asked.columns,
        room.heel_sd,
        any_known if known is None else any_known | known,
    )
    by_fit = asked.by == "fit"
    return JudgedLasts(
        asked=asked,
        rows=rows,
        lasts=lasts,
        heels=heels,
        clearances=room,
        scores=judged,
        level=worst_levels(judged.level, asked.columns),
        distance=fit_distance(judged),
        spread=distance_spread(judged) if by_fit else rescan_spread(len(rows)),
    )


def _looked_at(asked: Asked, room: Clearances) -> Bools:
    """Which lasts have a toe room, and no zone but the toe box that rejects them."""
    level = levels_of(asked, room)
    lengths = [place for place, column in enumerate(asked.columns) if is_length(column)]
    known = (level[:, lengths] != NOT_JUDGED).all(axis=1)
    return np.asarray(known & (worst_levels(level, asked.columns) < REJECT))


def refusals_of(asked: Asked, room: Clearances, level: Ints, rejected: Bools) -> Counter[str]:
    """How many lasts are rejected, by the first zone that rejects each, and its direction:
    "too_short", "too_long", or the zone and the word.
    """
    counts: Counter[str] = Counter()
    left = rejected.copy()
    for place, column in enumerate(asked.columns):
        if not column.counts:
            continue
        zone = ZONES[column.rule.zone]
        here = left & (level[:, place] == REJECT)
        loose = here & (room.value[:, place] > column.rule.target)
        start = "too" if zone.name == "length" else zone.name
        for rows, word in ((here & ~loose, zone.less), (loose, zone.more)):
            if rows.any():
                counts[f"{start}_{word}".replace(" ", "_")] += int(np.count_nonzero(rows))
        left &= ~here
    return counts


def governing(feet: Sequence[Profiled]) -> int:
    """Which foot decides the length: the longest, the first of equals."""
    return max(range(len(feet)), key=lambda i: (feet[i].length_or_extent_mm, -i))
