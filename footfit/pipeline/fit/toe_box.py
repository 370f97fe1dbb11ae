"""The toe box of the lasts that no other zone rejects: its height, and its wall beside each toe.

It is read from the sections that the catalogue keeps. No mesh of a last is read.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, UnknownLast
from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.named_sections import NAMED_SECTIONS, toes_outline_mm
from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.measures.measure_value import OPEN
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.fit.heels import Heels, full_change, surface_change
from footfit.pipeline.fit.scoring import Column
from footfit.pipeline.fit.zones import (
    TOE_BOX,
    TOE_HEIGHT,
    TOES,
    Clearance,
    Clearances,
    foot_shape,
    last_shape,
    length_only_words,
    measure_difference,
    missing,
)
from footfit.results import LastRecord, Measured, Profiled, ShapeSections, ToeBox, ToeFit

TOES_SD_MM = 0.4
"""Repeatability of a toe's clearance between two scans of one foot, or of one last: measured 0.1 to
0.6 mm by toe, with 0.3 mm of noise, in any pose, with half and a quarter of the faces."""
TOES_SECTION = next(station for station in STATIONS if station.name == "toes")
HEIGHT_SHARES = (0.80, 0.96)
"""A last's height is drawn on from its two known places as far as this, over its length."""
NOT_STORED = "no sections are stored; type: footfit upgrade-catalogue"


@dataclass(frozen=True, slots=True)
class LastToes:
    """What is read of a last: its record and kept sections, or the reason why there are none."""

    record: LastRecord
    kept: ShapeSections | str


KeptSections = Path | Mapping[str, ShapeSections] | None
"""Where sections of lasts are kept: a catalogue, or by the lasts' names."""


def last_toes(file: KeptSections, records: Sequence[LastRecord]) -> list[LastToes]:
    """The kept sections of lasts."""
    if isinstance(file, Mapping):
        return [LastToes(record, file[record.labels.name]) for record in records]
    if file is None or not records:
        return [LastToes(record, NOT_STORED) for record in records]
    toes = []
    with open_catalogue(file) as catalogue:
        for record in records:
            try:
                kept = catalogue.sections(record.labels.name) or NOT_STORED
            except (CatalogueDamaged, UnknownLast) as error:
                kept = error.message
            toes.append(LastToes(record, kept))
    return toes


def with_toe_boxes(
    clearances: Clearances,
    columns: Sequence[Column],
    feet: Sequence[Profiled],
    lasts: Mapping[int, LastToes],
    heels: Heels,
) -> tuple[Clearances, tuple[dict[int, ToeBox], ...]]:
    """The clearances with the toe box of the lasts in some rows, and each foot's toes there."""
    cells: dict[tuple[int, int], Clearance] = {}
    boxes: list[dict[int, ToeBox]] = []
    judged = {row: last for row, last in lasts.items() if not heels.length_only[row]}
    model = heels.question.model
    too_high = missing("" if model is None else length_only_words(model))
    for index, foot in enumerate(feet):
        places = {c.rule.zone: i for i, c in enumerate(columns) if c.foot == index}
        rules = {zone: columns[place].rule for zone, place in places.items()}
        rooms_mm = clearances.value[:, places["length"]] + rules["length"].cavity
        toes: dict[int, ToeBox | str] = {}
        if TOES in places:
            toes = toe_boxes(foot, judged, heels, rooms_mm, rules[TOES].cavity)
            cells |= {(row, places[TOES]): _tightest(box) for row, box in toes.items()}
        if TOE_HEIGHT in places:
            for row, last in judged.items():
                cell = toe_height(foot, last, float(rooms_mm[row]))
                cell = replace(cell, value=cell.value - rules[TOE_HEIGHT].cavity)
                cells[row, places[TOE_HEIGHT]] = cell
        toe_places = [place for zone, place in places.items() if zone in TOE_BOX]
        cells |= {
            (row, place): too_high for row in set(lasts) - set(judged) for place in toe_places
        }
        boxes.append({row: box for row, box in toes.items() if isinstance(box, ToeBox)})
    return clearances.with_cells(cells), tuple(boxes)


def toe_height(foot: Profiled, last: LastToes, room_mm: float) -> Clearance:
    """The last's height where the foot's toe height is measured, minus the foot's toe height.

    Along a last two heights are known: of the kept section at the toes, and the measure. Between
    and beside them its height is on their straight line.
    """
    ours, theirs = foot_shape(foot), last_shape(last.record)
    cell = measure_difference(ours, theirs, TOE_HEIGHT)
    foot_mm, last_mm, front_mm = (
        foot.length_mm,
        last.record.length_mm,
        theirs.measured_mm(TOE_HEIGHT),
    )
    if cell.reason is not None or front_mm is None:
        return cell
    if isinstance(last.kept, str):
        return missing(last.kept)
    section = last.kept.sections.get(TOES_SECTION.name)
    if section is None or foot_mm is None or last_mm is None:
        return missing(f"the last: {OPEN.format(place='toes')}")
    behind_mm = float(np.ptp(section.points_mm[:, 1]))
    place = 1.0 - ((1.0 - HEIGHTS.toe) * foot_mm + room_mm) / last_mm
    place = float(np.clip(place, *HEIGHT_SHARES))
    share = (HEIGHTS.toe - place) / (HEIGHTS.toe - TOES_SECTION.share)
    return replace(cell, value=cell.value + share * (behind_mm - front_mm))


def toe_boxes(
    foot: Profiled,
    lasts: Mapping[int, LastToes],
    heels: Heels,
    rooms_mm: Floats,
    cavity_mm: float,
) -> dict[int, ToeBox | str]:
    """A foot's toes in lasts by their row, or the reason why they are not known."""
    ours = plan_of_foot(foot)
    reasons = {
        row: ours if isinstance(ours, str) else lacking_words(last) for row, last in lasts.items()
    }
    rows = [row for row, reason in reasons.items() if reason is None]
    known: dict[int, ToeBox | str] = {row: r for row, r in reasons.items() if r is not None}
    if isinstance(ours, str) or not rows:
        return known
    walls = toe_walls.walls([plan_of_last(lasts[row]) for row in rows])
    changes = [surface_change(heels, row) for row in rows]
    scale = 1.0 + np.array([(change.length, change.ball_width) for change in changes])
    inside = toe_walls.toes_in_lasts(ours, walls, rooms_mm[rows], scale)
    width_sd_mm = 0.5 * full_change(heels.question.model, foot, "ball_width")[1]
    for at, row in enumerate(rows):
        sd_mm = math.hypot(TOES_SD_MM, TOES_SD_MM, heels.share[row] * width_sd_mm)
        values = zip(toe_walls.TOES, inside.wall[at], inside.value_mm[at], strict=True)
        toes = tuple(
            ToeFit(toe, toe_walls.WALLS[wall], Measured(float(value) - cavity_mm, sd_mm))
            for toe, wall, value in values
        )
        known[row] = ToeBox(toes, inside.outline_mm[at], inside.toe, walls.edges_mm[at])
    return known


def plan_of_foot(foot: Profiled) -> toe_walls.ToesPlan | str:
    """A foot's toes in plan, or why they are not known: the toe height says what was scanned."""
    height = foot_shape(foot).measures.get(TOE_HEIGHT)
    if height is None or height.measured.value is None:
        reason = None if height is None else height.measured.reason
        return f"the foot: {reason or 'not measured'}"
    shape = foot.aligned.prepared.shape
    outline_mm = toes_outline_mm(shape)
    if not _is_whole(outline_mm):
        return f"the foot: {OPEN.format(place='toes')}"
    assert outline_mm is not None
    middle_mm = foot.flare.centre_line * foot.aligned.alignment.extent_mm
    return toe_walls.foot_plan(outline_mm, middle_mm - np.array([shape.x_mm(0.0), 0.0]))


def lacking_words(last: LastToes) -> str | None:
    """Why the toes of a last are not known; None if they are."""
    if isinstance(last.kept, str):
        return last.kept
    return (
        None if _is_whole(last.kept.toes_outline_mm) else f"the last: {OPEN.format(place='toes')}"
    )


def _is_whole(outline_mm: Floats | None) -> bool:
    """Whether an outline of toes has all its stations, up to the tip."""
    return outline_mm is not None and len(outline_mm) == NAMED_SECTIONS.toe_stations


def plan_of_last(last: LastToes) -> toe_walls.ToesPlan:
    """The toes of a last in plan, of one whose toes are known."""
    assert not isinstance(last.kept, str)
    assert last.kept.toes_outline_mm is not None
    middle_mm = last.record.flare.centre_line * last.record.extent_mm
    return toe_walls.last_plan(last.kept.toes_outline_mm, middle_mm)


def _tightest(box: ToeBox | str) -> Clearance:
    """The clearance of the tightest toe, with its spreads."""
    if isinstance(box, str):
        return missing(box)
    clearance = box.tightest.clearance
    assert clearance.value is not None
    assert clearance.sd is not None
    heel_sd = math.sqrt(max(clearance.sd**2 - 2.0 * TOES_SD_MM**2, 0.0))
    return Clearance(clearance.value, TOES_SD_MM, TOES_SD_MM, heel_sd=heel_sd)
