"""Records of lasts as columns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from footfit.catalogue.rows.array_blobs import definition_text
from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.named_sections import NAMED_SECTIONS
from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.flare.definition import CHANNELS
from footfit.geometry.numeric.arrays import Floats
from footfit.results import LastRecord, ShapeSections
from footfit.results.columns.last_columns import (
    KEPT,
    KINDS,
    NOT_KEPT,
    SIDES,
    SPOILT,
    LastColumns,
    MeasureColumns,
    ProfileColumns,
    ToesColumns,
)
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary
from footfit.results.values import Measure

LABELS = ("style", "size", "size_system", "width_label")
"""The labels that filters, stock lists and twins go by, in the vocabulary's order."""
TOES_SECTION = next(station for station in STATIONS if station.name == "toes")
Kept = ShapeSections | int
"""The kept sections of a last, or NOT_KEPT or SPOILT."""


def columns_of(
    records: Sequence[LastRecord],
    kept: Sequence[Kept],
    words: Vocabulary,
    *,
    keys: Sequence[int] | None = None,
    profiles: Sequence[str] | None = None,
) -> LastColumns:
    """Lasts by column, with all columns.

    ``profiles`` are the texts of the definitions of their flare profiles, as they are stored:
    those of the records may lack what another footfit wrote.
    """
    texts = profiles or [definition_text(record.flare.definition) for record in records]
    labels = [tuple(getattr(record.labels, name) for name in LABELS) for record in records]
    methods = [tuple(sorted({m.definition for m in record.measures})) for record in records]
    return LastColumns(
        words=words,
        keys=np.array(range(len(records)) if keys is None else keys, dtype=np.int64),
        names=tuple(record.labels.name for record in records),
        label=_numbers(map(words.labels.number, labels)),
        profile=_numbers(map(words.profiles.number, texts)),
        method=_numbers(map(words.methods.number, methods)),
        side=_numbers(SIDES.index(record.side.side) for record in records),
        kind=_numbers(KINDS.index(record.pose.kind) for record in records),
        stations=_numbers(len(record.flare.stations) for record in records),
        extent_mm=_floats(record.extent_mm for record in records),
        angle_deg=_floats(record.flare.angle_deg for record in records),
        angle_sd_deg=_floats(record.flare.angle_sd_deg for record in records),
        heel_label_mm=_floats(record.labels.heel_height_mm for record in records),
        platform_mm=_floats(record.labels.platform_mm for record in records),
        measures=measure_columns([record.measures for record in records], words),
        flare=_profiles(records),
        toes=_toes(records, kept),
    )


def measure_columns(tables: Sequence[Sequence[Measure]], words: Vocabulary) -> MeasureColumns:
    """Tables of measures by column, in the order of their names."""
    names = tuple(sorted({row.name for table in tables for row in table}))
    place = {name: at for at, name in enumerate(names)}
    value = np.full((len(names), len(tables)), np.nan)
    sd, word = np.zeros_like(value), np.full(value.shape, NO_WORD, dtype=np.int64)
    number = words.measures.number
    for last, table in enumerate(tables):
        for row in table:
            at, measured = place[row.name], row.measured
            word[at, last] = number((row.definition, measured.reason))
            if measured.value is not None:
                value[at, last] = measured.value
                sd[at, last] = measured.sd or 0.0
    lacking = np.isnan(value) | np.isnan(sd)  # the database has null for NaN
    return MeasureColumns(names, value + 0.0, np.where(lacking, 0.0, sd), word)


def _numbers(values: object) -> np.ndarray:
    return np.array(list(values), dtype=np.int64)  # type: ignore[call-overload]


def _floats(values: object) -> Floats:
    """None is NaN, and -0.0 is 0.0, as SQLite has it."""
    numbers = [np.nan if value is None else value for value in values]  # type: ignore[attr-defined]
    return np.array(numbers, dtype=np.float64) + 0.0


def _profiles(records: Sequence[LastRecord]) -> ProfileColumns:
    longest = max((len(record.flare.stations) for record in records), default=0)
    curves = np.full((len(records), len(CHANNELS), longest), np.nan)
    known = np.zeros(curves.shape[:2], dtype=bool)
    for last, record in enumerate(records):
        for channel, name in enumerate(CHANNELS):
            curve = record.flare.curvature.get(name)
            if curve is not None:
                known[last, channel] = True
                curves[last, channel, : len(curve)] = curve
    return ProfileColumns(known, np.ascontiguousarray(curves[:, 0]), curves[:, 1:].copy())


def _toes(records: Sequence[LastRecord], kept: Sequence[Kept]) -> ToesColumns:
    count, stations = len(records), toe_walls.TOE_BOX.stations
    state = np.full(count, KEPT)
    behind_mm = np.full(count, np.nan)
    ends_mm, seat_mm = np.full((2, count, 2), np.nan)
    edges_mm = np.full((count, 2, stations), np.nan)
    whole: list[int] = []
    outlines_mm: list[Floats] = []
    middles_mm: list[Floats] = []
    for last, (record, sections) in enumerate(zip(records, kept, strict=True)):
        if not isinstance(sections, ShapeSections):
            state[last] = sections
            continue
        section = sections.sections.get(TOES_SECTION.name)
        if section is not None:
            aside_mm = section.points_mm[:, 1]
            behind_mm[last] = aside_mm.max() - aside_mm.min()
        outline_mm = sections.toes_outline_mm
        if outline_mm is not None and is_whole(outline_mm):
            whole.append(last)
            outlines_mm.append(outline_mm)
            middles_mm.append(record.flare.centre_line * record.extent_mm)
    if whole:
        walls = toe_walls.last_walls(np.stack(outlines_mm), middles_mm)
        ends_mm[whole], seat_mm[whole] = walls.edges_mm[:, [0, -1], 0], walls.seat_mm
        edges_mm[whole] = np.moveaxis(walls.edges_mm[:, :, 1:], 2, 1)
    return ToesColumns(state, behind_mm, ends_mm, seat_mm, edges_mm)


def is_whole(outline_mm: Floats | None) -> bool:
    """Whether an outline of toes has all its stations, up to the tip."""
    return outline_mm is not None and len(outline_mm) == NAMED_SECTIONS.toe_stations


NO_SECTIONS = (NOT_KEPT, SPOILT)
