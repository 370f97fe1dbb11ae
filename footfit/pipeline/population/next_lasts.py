"""Which lasts to make next: one for each size and width of the feet that no last serves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.fit.sizes import SYSTEMS
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.zones import TOE_BOX
from footfit.pipeline.population.cover import Cover, greedy_cover
from footfit.pipeline.population.groups import letter_places, letter_system, nearest_sizes
from footfit.pipeline.population.judging import Asking, asked_of, judged_feet
from footfit.pipeline.population.shape_columns import (
    ROOM,
    MeasureColumn,
    ShapeColumns,
    definition_code,
)
from footfit.pipeline.population.tables import FootTable, LastTable, zone_measures

NOT_PLANNED = frozenset({"plan", *TOE_BOX})
"""Zones that a last to make has no number for."""


@dataclass(frozen=True, slots=True)
class PlannedLasts:
    """Lasts to make. ``size`` and ``letter`` (n,) are those of the feet that each is made for.

    ``foot_mm`` (n,) is how long these feet are. ``letter`` is NaN if the ball girth is not known.
    """

    table: LastTable
    size: Floats
    letter: Floats
    foot_mm: Floats


def planned_lasts(feet: FootTable, asking: Asking, system: str) -> PlannedLasts:
    """A last for each size and width of some feet, on target for the mean foot of the two."""
    order = _order(feet)
    letters = letter_system(system)
    size = nearest_sizes(feet.length_mm, SYSTEMS[system])
    letter = letter_places(feet.shapes.value_of("ball_girth"), feet.length_mm, letters)
    cells, of_foot = np.unique(
        np.column_stack([size, np.nan_to_num(letter, nan=-99.0)]), axis=0, return_inverse=True
    )
    cell = of_foot.reshape(-1)[order]
    target = asked_of(feet, asking).target[:, 0]

    def mean(values: Floats) -> Floats:
        return _means(values[order], cell, len(cells))

    asked = {rule.zone: mean(target[:, place]) + rule.cavity
             for place, rule in enumerate(asking.profile.zones)}  # fmt: skip
    measures = {}
    for name in zone_measures(asking.profile):
        zone = "length" if name in ("length", ROOM) else name
        more = 0.0 if name == "ball_length" else asked.get(zone, 0.0)
        measures[name] = _column(name, mean(feet.shapes.value_of(name)) + more)
    nothing = np.full(len(cells), np.nan)
    angle = mean(feet.shapes.flare_deg) + asked.get("flare", 0.0)
    shapes = ShapeColumns(
        extent_mm=measures["length"].value,
        measures=measures,
        flare_deg=angle,
        flare_sd_deg=np.zeros(len(cells)),
        plan=np.empty((len(cells), 0)),
        heel_mm=nothing,
        gain_mm=np.zeros(len(cells)),
        gain_sd_mm=np.zeros(len(cells)),
    )
    every: Bools = np.ones(len(cells), dtype=bool)
    names = tuple(f"new {place}" for place in range(len(cells)))
    table = LastTable(names, shapes, nothing, {"left": every, "right": every, None: every})
    known = np.where(cells[:, 1] < -90.0, np.nan, cells[:, 1])
    return PlannedLasts(table, cells[:, 0], known, mean(feet.length_mm))


def next_cover(
    feet: FootTable, asking: Asking, system: str, most: int
) -> tuple[PlannedLasts, Cover]:
    """The planned lasts for feet that no last serves, and which of them to make first."""
    planned = planned_lasts(feet, asking, system)
    rules = tuple(r for r in asking.profile.zones if r.zone not in NOT_PLANNED)
    plain = replace(asking, profile=replace(asking.profile, zones=rules))
    served = judged_feet(feet, planned.table, plain).served[1]
    wanted = np.packbits(np.ones(len(feet), dtype=bool))
    return planned, greedy_cover(served, wanted, most)


def _order(feet: FootTable) -> Ints:
    """An order of feet that does not depend on the order in which they were given."""
    columns = [column.value for column in feet.shapes.measures.values()]
    return np.lexsort([feet.shapes.flare_deg, *columns, feet.length_mm])


def _means(values: Floats, cell: Ints, cells: int) -> Floats:
    """The mean of the known values in each cell; NaN where there is none."""
    known = np.isfinite(values)
    count = np.bincount(cell[known], minlength=cells)
    total = np.bincount(cell[known], values[known], minlength=cells)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def _column(name: str, value: Floats) -> MeasureColumn:
    entry = measure_named(name)
    code = np.where(np.isnan(value), -1, definition_code(entry.definition_id))
    return MeasureColumn(value, np.where(np.isnan(value), 0.0, entry.sd), code)
