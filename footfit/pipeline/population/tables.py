"""Feet and lasts as tables of columns: what the coverage of a population is computed from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from footfit.geometry.fit.toe_walls import ToesPlan, Walls
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.locations import Location
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS
from footfit.pipeline.fit.judging.cells import last_shape
from footfit.pipeline.fit.judging.toe_box import walls_of
from footfit.pipeline.fit.zones import TOE_BOX, TOE_HEIGHT, ZONES
from footfit.pipeline.population.shape_columns import ROOM, ShapeColumns, shape_columns
from footfit.pipeline.shelf.shelf import of_own_side, record_lasts
from footfit.results import FitProfile, LastRecord, SideName
from footfit.results.columns.last_columns import SIDES, LastColumns

Sides = tuple[SideName | None, ...]
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class FootTable:
    """n feet. ``ids`` are as given. ``columns`` are texts by the name of a column, "" for none.

    ``toes`` are the outlines of the toes in plan, of feet that were scanned.
    """

    ids: tuple[str, ...]
    sides: Sides
    shapes: ShapeColumns
    columns: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    toes: tuple[ToesPlan | None, ...] | None = None

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def length_mm(self) -> Floats:
        """The length that sizes are read from, (n,)."""
        return self.shapes.value_of("length")

    def part(self, start: int, stop: int) -> FootTable:
        """The feet from one place to another."""
        return self.chosen(np.arange(start, min(stop, len(self))))

    def chosen(self, rows: Ints) -> FootTable:
        """Some of the feet."""

        def of(values: Sequence[T]) -> tuple[T, ...]:
            return tuple(values[row] for row in rows)

        return FootTable(
            of(self.ids),
            of(self.sides),
            self.shapes.part(rows),
            {name: of(column) for name, column in self.columns.items()},
            None if self.toes is None else of(self.toes),
        )


@dataclass(frozen=True, slots=True)
class LastWalls:
    """The toe boxes of n lasts. ``row`` (n,) is the place in ``walls``, -1 if there is none.

    ``behind_mm`` (n,) is the height of the kept section at the toes.
    """

    walls: Walls | None
    row: Ints
    behind_mm: Floats


@dataclass(frozen=True, slots=True)
class LastTable:
    """n lasts in the order of their names. ``drop_mm`` (n,) is NaN where it is not known.

    ``own_side`` (n,) says by a foot's side which lasts it is compared with: not with one of the
    other side whose twin of its own side is there. ``records`` is empty for lasts to make.
    """

    names: tuple[str, ...]
    shapes: ShapeColumns
    drop_mm: Floats
    own_side: Mapping[SideName | None, Bools]
    records: tuple[LastRecord, ...] = ()
    toe_boxes: LastWalls | None = None

    def __len__(self) -> int:
        return len(self.names)


def zone_measures(profile: FitProfile) -> tuple[str, ...]:
    """The measures of feet and lasts that the zones of a profile read."""
    asked = [rule.zone for rule in profile.zones if rule.zone in ZONES]
    special = {"length": ("length", ROOM), "ball_line": ("ball_length",)}
    names = [name for zone in asked for name in special.get(zone, (zone,))]
    never = {"flare", "plan", "toes"}
    return tuple(dict.fromkeys(name for name in (*names, "length", "ball_girth", "ball_width")
                               if name not in never))  # fmt: skip


def last_table(
    records: Iterable[LastRecord], profile: FitProfile, file: Location | None = None
) -> LastTable:
    """The lasts of a catalogue as columns; ``file`` is where their kept sections are read from."""
    lasts = sorted(records, key=lambda record: record.labels.name)
    names = (*zone_measures(profile), *LENGTHS)
    drops = [last.drop_mm for last in lasts]
    shelf_lasts = record_lasts(lasts, file)
    every = np.ones(len(lasts), dtype=bool)
    return LastTable(
        names=tuple(last.labels.name for last in lasts),
        shapes=shape_columns([last_shape(last) for last in lasts], names),
        drop_mm=np.array([np.nan if drop is None else drop for drop in drops]),
        own_side={side: of_own_side(shelf_lasts, every, at) for at, side in enumerate(SIDES)},
        records=tuple(lasts),
        toe_boxes=None if file is None else _toe_boxes(shelf_lasts.base, profile),
    )


def _toe_boxes(lasts: LastColumns, profile: FitProfile) -> LastWalls | None:
    """The kept sections of the toes, if the profile judges them."""
    if not any(rule.zone in TOE_BOX for rule in profile.zones):
        return None
    assert lasts.toes is not None
    whole = lasts.toes.whole
    row = np.where(whole, np.cumsum(whole) - 1, -1)
    walls = walls_of(lasts.toes, np.flatnonzero(whole)) if whole.any() else None
    return LastWalls(walls, row, lasts.toes.behind_mm)


def lacking_zones(feet: FootTable, profile: FitProfile) -> dict[str, Bools]:
    """By required zone, the feet (n,) that lack what it reads."""
    lacking = {}
    for rule in profile.zones:
        if rule.required and rule.weight > 0:
            lacking[rule.zone] = ~_known(feet, rule.zone)
    lacking.setdefault("length", ~_known(feet, "length"))
    return lacking


def _known(feet: FootTable, zone: str) -> Bools:
    """Which feet (n,) have what a zone reads of a foot."""
    shapes = feet.shapes
    if zone == "flare":
        return np.isfinite(shapes.flare_deg)
    if zone == "plan":
        whole = np.asarray(np.isfinite(shapes.plan).all(axis=1))
        return whole if shapes.plan.shape[1] else ~whole
    if zone == "toes":
        toes = feet.toes or (None,) * len(feet)
        return np.array([plan is not None for plan in toes], dtype=bool)
    if zone == "length":
        return np.isfinite(shapes.value_of("length"))
    name = "ball_length" if zone == "ball_line" else zone
    return np.isfinite(shapes.value_of(TOE_HEIGHT if zone == TOE_HEIGHT else name))
