"""The toe box of the lasts that no other zone rejects: its height, and its wall beside each toe.

It is read from the sections that the catalogue keeps. No mesh of a last is read.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.catalogue.blocks.record_columns import TOES_SECTION, is_whole
from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.named_sections import toes_outline_mm
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.measures.measure_value import OPEN
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.heels import Heels, full_change
from footfit.pipeline.fit.judging.cells import (
    MEASURE_AGAIN,
    Cells,
    foot_shape,
    measure_difference,
    missing,
)
from footfit.pipeline.fit.judging.clearances import Clearances, length_only_words
from footfit.pipeline.fit.scoring import Column
from footfit.pipeline.fit.zones import TOE_BOX, TOE_HEIGHT, TOES
from footfit.results import Measured, Profiled, ToeBox, ToeFit
from footfit.results.columns.last_columns import NOT_KEPT, SPOILT, LastColumns, ToesColumns
from footfit.results.columns.vocabulary import NO_WORD, Words

TOES_SD_MM = 0.4
"""Repeatability of a toe's clearance between two scans of one foot, or of one last: measured 0.1 to
0.6 mm by toe, with 0.3 mm of noise, in any pose, with half and a quarter of the faces."""
HEIGHT_SHARES = (0.80, 0.96)
"""A last's height is drawn on from its two known places as far as this, over its length."""
NOT_STORED = f"no sections are stored; {MEASURE_AGAIN}"
OPEN_TOES = f"the last: {OPEN.format(place='toes')}"
TOGETHER = 16
"""So many lasts are laid around a foot's toes at once: more would need more memory than a core has
near it.
"""
OF_TOES = ("length", TOE_HEIGHT)
"""The measures of lasts that a toe box reads."""


@dataclass(frozen=True, slots=True)
class FootToes:
    """A foot's toes in plan, or the sentence why they are not known."""

    foot: Profiled
    plan: toe_walls.ToesPlan | str


def foot_toes(foot: Profiled) -> FootToes:
    """A foot's toes in plan."""
    return FootToes(foot, plan_of_foot(foot))


def plan_of_foot(foot: Profiled) -> toe_walls.ToesPlan | str:
    """A foot's toes in plan, or why they are not known: the toe height says what was scanned."""
    height = foot_shape(foot).measures.get(TOE_HEIGHT)
    if height is None or height.measured.value is None:
        reason = None if height is None else height.measured.reason
        return f"the foot: {reason or 'not measured'}"
    shape = foot.aligned.prepared.shape
    outline_mm = toes_outline_mm(shape)
    if not is_whole(outline_mm):
        return f"the foot: {OPEN.format(place='toes')}"
    assert outline_mm is not None
    middle_mm = foot.flare.centre_line * foot.aligned.alignment.extent_mm
    return toe_walls.foot_plan(outline_mm, middle_mm - np.array([shape.x_mm(0.0), 0.0]))


def put_toe_boxes(
    room: Clearances,
    columns: Sequence[Column],
    feet: Sequence[FootToes],
    lasts: LastColumns,
    rows: Ints,
    heels: Heels,
    *,
    walls: bool,
) -> None:
    """Write the toe boxes of some lasts into their rows of the clearances.

    ``lasts`` (n) have measures and toes, ``rows`` (n,) are theirs, and ``heels`` those of all rows.
    Without ``walls`` toes whose clearance can be known are taken to be on target: no last can be
    better than that, and laying a foot into a last takes most of the time of a match.
    """
    only = heels.length_only[rows]
    share = heels.share[rows]
    model = heels.question.model
    for index, toes in enumerate(feet):
        places = {c.rule.zone: i for i, c in enumerate(columns) if c.foot == index}
        rules = {zone: columns[place].rule for zone, place in places.items()}
        rooms_mm = room.value[rows, places["length"]] + rules["length"].cavity
        cells: dict[str, Cells] = {}
        if TOES in places:
            reason = toe_reasons(toes, lasts, room.sentences)
            value = np.full(len(rows), rules[TOES].target + rules[TOES].cavity)
            if walls:
                value = tightest_mm(toes, lasts, reason == NO_WORD, heels, share, rooms_mm)
            cells[TOES] = _toe_cells(value, reason)
        if TOE_HEIGHT in places:
            cells[TOE_HEIGHT] = toe_height(toes.foot, lasts, rooms_mm, room.sentences)
        for zone, cell in cells.items():
            heel_sd = np.zeros(len(rows))
            if zone == TOES:
                known = cell.reason == NO_WORD
                heel_sd = np.where(known, np.abs(share) * _width_sd_mm(toes.foot, heels), 0.0)
            cell = replace(cell, value=cell.value - rules[zone].cavity)
            if model is not None and only.any():
                words = room.sentences.number(length_only_words(model))
                cell = cell.where(only, missing(len(rows), words))
                heel_sd = np.where(only, 0.0, heel_sd)
            room.put(rows, places[zone], cell, heel_sd)


def toe_height(foot: Profiled, lasts: LastColumns, rooms_mm: Floats, sentences: Words) -> Cells:
    """The lasts' height where the foot's toe height is measured, minus the foot's toe height.

    Along a last two heights are known: of the kept section at the toes, and the measure. Between
    and beside them its height is on their straight line.
    """
    assert lasts.toes is not None
    cell = measure_difference(foot_shape(foot), lasts, TOE_HEIGHT, sentences)
    foot_mm, last_mm = foot.length_mm, lasts.measure("length").value
    front_mm = lasts.measure(TOE_HEIGHT).value
    reason = _not_kept(lasts, sentences)
    cut = np.isfinite(lasts.toes.behind_mm) & np.isfinite(last_mm) & (foot_mm is not None)
    reason[(reason == NO_WORD) & ~cut] = sentences.number(OPEN_TOES)
    share = behind_share(foot_mm or np.nan, last_mm, rooms_mm)
    level = replace(cell, value=cell.value + share * (lasts.toes.behind_mm - front_mm))
    unknown = replace(missing(len(lasts), NO_WORD), reason=reason)
    known = cell.reason == NO_WORD
    return cell.where(known, level).where(known & (reason != NO_WORD), unknown)


def behind_share(foot_mm: float, last_mm: Floats, rooms_mm: Floats) -> Floats:
    """How much the height of the section at the toes counts, (n,), where a foot has its toe height;
    the toe height of the last counts the rest. Beyond the two places it is above 1 or below 0.
    """
    place = 1.0 - ((1.0 - HEIGHTS.toe) * foot_mm + rooms_mm) / last_mm
    place = np.clip(place, *HEIGHT_SHARES)
    return np.asarray((HEIGHTS.toe - place) / (HEIGHTS.toe - TOES_SECTION.share))


def _not_kept(lasts: LastColumns, sentences: Words) -> Ints:
    """Why the sections of lasts are not known, (n,)."""
    assert lasts.toes is not None
    reason = np.full(len(lasts), NO_WORD)
    for row in np.flatnonzero(lasts.toes.state == SPOILT).tolist():
        reason[row] = sentences.number(spoilt_words(lasts.names[row]))
    lacking = lasts.toes.state == NOT_KEPT
    if lacking.any():
        reason[lacking] = sentences.number(NOT_STORED)
    return reason


def spoilt_words(name: str) -> str:
    """Why the sections of a last are not used."""
    return f"the sections of {name!r} are damaged; ingest the last again with --replace"


def toe_reasons(foot: FootToes, lasts: LastColumns, sentences: Words) -> Ints:
    """Why a foot's toes in lasts are not known, (n,); NO_WORD where they are."""
    assert lasts.toes is not None
    if isinstance(foot.plan, str):
        return np.full(len(lasts), sentences.number(foot.plan))
    reason = _not_kept(lasts, sentences)
    open_toes = (reason == NO_WORD) & ~lasts.toes.whole
    if open_toes.any():
        reason[open_toes] = sentences.number(OPEN_TOES)
    return reason


def tightest_mm(
    foot: FootToes,
    lasts: LastColumns,
    known: Bools,
    heels: Heels,
    share: Floats,
    rooms_mm: Floats,
) -> Floats:
    """The clearance of the tightest toe of a foot in each of n lasts, without a cavity; NaN where
    the toes are not ``known``.
    """
    assert lasts.toes is not None
    value = np.full(len(lasts), np.nan)
    rows = np.flatnonzero(known)
    for start in range(0, len(rows), TOGETHER):
        some = rows[start : start + TOGETHER]
        inside = toes_of_foot(foot, lasts.toes, some, heels, share, rooms_mm)
        value[some] = inside.value_mm.min(axis=1)
    return value


def _toe_cells(value: Floats, reason: Ints) -> Cells:
    known = reason == NO_WORD
    sd_mm = np.where(known, TOES_SD_MM, 0.0)
    return Cells(np.where(known, value, np.nan), sd_mm, sd_mm, reason)


def toes_of_foot(
    foot: FootToes, toes: ToesColumns, rows: Ints, heels: Heels, share: Floats, rooms_mm: Floats
) -> toe_walls.ToesInLasts:
    """The toes of a foot in some rows of n lasts; the arrays (n,) are of all of them."""
    assert isinstance(foot.plan, toe_walls.ToesPlan)
    walls = walls_of(toes, rows)
    model = heels.question.model
    rules = [None if model is None else model.rule_of(name) for name in ("length", "ball_width")]
    changes = np.array([0.0 if rule is None else rule.change for rule in rules])
    scale = 1.0 + share[rows][:, None] * changes
    return toe_walls.toes_in_lasts(foot.plan, walls, rooms_mm[rows], scale)


def walls_of(toes: ToesColumns, rows: Ints) -> toe_walls.Walls:
    """The outlines of some lasts whose toes are whole."""
    starts_mm, fronts_mm = toes.ends_mm[rows].T
    along_mm = np.linspace(starts_mm, fronts_mm, toes.edges_mm.shape[-1], axis=1)
    edges_mm = np.concatenate([along_mm[:, None], toes.edges_mm[rows]], axis=1)
    return toe_walls.Walls(np.ascontiguousarray(np.moveaxis(edges_mm, 1, 2)), toes.seat_mm[rows])


def _width_sd_mm(foot: Profiled, heels: Heels) -> float:
    """How unsure the heel model leaves where a foot's edge lies, at its full drop."""
    return 0.5 * full_change(heels.question.model, foot, "ball_width")[1]


def toe_box(
    foot: FootToes, lasts: LastColumns, row: int, heels: Heels, room_mm: float, cavity_mm: float
) -> ToeBox | None:
    """A foot's toes in the last of a row; None if they are not known there."""
    assert lasts.toes is not None
    if isinstance(foot.plan, str) or toe_reasons(foot, lasts, Words())[row] != NO_WORD:
        return None
    rows, rooms_mm = np.array([row]), np.full(len(lasts), room_mm)
    inside = toes_of_foot(foot, lasts.toes, rows, heels, heels.share, rooms_mm)
    heel_sd_mm = float(heels.share[row]) * _width_sd_mm(foot.foot, heels)
    sd_mm = math.hypot(TOES_SD_MM, TOES_SD_MM, heel_sd_mm)
    values = zip(toe_walls.TOES, inside.wall[0], inside.value_mm[0], strict=True)
    toes = tuple(
        ToeFit(toe, toe_walls.WALLS[wall], Measured(float(value) - cavity_mm, sd_mm))
        for toe, wall, value in values
    )
    walls = walls_of(lasts.toes, rows)
    return ToeBox(toes, inside.outline_mm[0], inside.toe, walls.edges_mm[0])


def judges_toes(columns: Sequence[Column]) -> bool:
    """Whether any column is of the toe box."""
    return any(column.rule.zone in TOE_BOX for column in columns)


def toes_can_reject(columns: Sequence[Column]) -> bool:
    """Whether the toes' clearance may reject a last: no shipped profile lets it."""
    return any(c.counts and c.rule.zone == TOES and c.rule.poor is not None for c in columns)
