"""Feet from a CSV of measures, as a spreadsheet or a survey writes it, read row by row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from footfit.errors import BadManifest, BadOption
from footfit.geometry.measures.measure_table import MeasureDefinition, of_kind
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.batch.csv_rows import MORE_VALUES, csv_stream, plain_name
from footfit.pipeline.batch.side_words import side_in_name
from footfit.pipeline.population.shape_columns import (
    MeasureColumn,
    ShapeColumns,
    definition_code,
)
from footfit.pipeline.population.tables import FootTable
from footfit.pipeline.scan.flare import FOOT_SD_DEG, PLAUSIBLE_FLARE_DEG
from footfit.results import Notice, SideName

FLARE = "flare"
IDS = ("id", "foot", "foot_id", "subject", "subjectid", "path")
"""Columns that can name a foot; the first one that is there does."""
ALIASES = {
    "width": "ball_width",
    "girth": "ball_girth",
    "instep": "instep_girth",
    "heel": "heel_width",
    "waist": "waist_girth",
    "flare_angle": FLARE,
    "gender": "sex",
    "footlength": "length",
    "balloffootlength": "ball_length",
    "balloffootcircumference": "ball_girth",
    "footbreadthhorizontal": "ball_width",
    "heelbreadth": "heel_width",
    "heelanklecircumference": "short_heel_girth",
}
"""Short names, and those of the survey ANSUR II."""
GREATEST_HEEL = "heelbreadth"
GREATEST_HEEL_SHARE = 0.92
"""A survey's heel breadth is the greatest one; ours, at a sixth of the length, is so much of it."""
NOTHING = frozenset({"", "-", "na", "n/a", "nan", "null", "none", "."})
RANGES = {
    FLARE: (-90.0, 90.0),
    "length": (110.0, 370.0),
    "functional_length": (110.0, 370.0),
    "ball_length": (60.0, 300.0),
    "girth": (100.0, 600.0),
    "width": (20.0, 200.0),
    "height": (0.0, 200.0),
    "spring": (-30.0, 100.0),
}
"""What a measure of a foot can be, by its name or a word of it; any other number is in another
unit, or wrong."""
UNUSUAL_SHARE = 0.05
"""If more of the feet have a value that people hardly have, the column may hold something else."""
ROWS_AT_ONCE = 20_000


class Role(NamedTuple):
    """What a column holds: a measure, "flare", "side", "id", or a text of its own name."""

    name: str
    kind: str
    scale: float = 1.0


@dataclass(slots=True)
class _Cells:
    """The cells of one column that are read, in chunks."""

    role: Role
    place: int
    texts: list[str] = field(default_factory=list)
    values: list[Floats] = field(default_factory=list)


def feet_of_csv(path: Path, kept: Sequence[str] = ()) -> tuple[FootTable, tuple[Notice, ...]]:
    """The feet of a CSV file, and what should be known of its columns.

    ``kept`` are the names of columns whose texts are wanted. Measures are in mm, angles in degrees.

    Raises
    ------
    BadManifest
        The file is not understood; there is no length; a value is no number, or in another unit.
    BadOption
        A column of ``kept`` is not there.
    """
    with csv_stream(path, ("length",)) as table:
        roles = _roles(table.head, kept, str(path))
        columns = [_Cells(role, place) for place, role in roles.items()]
        places: list[str] = []
        waiting = 0
        for where, cells in table.rows:
            if not any(map(str.strip, cells)):
                continue
            if any(map(str.strip, cells[len(table.head) :])):
                raise BadManifest(MORE_VALUES, where)
            places.append(where.rpartition(" ")[2])
            for column in columns:
                column.texts.append(
                    cells[column.place].strip() if column.place < len(cells) else ""
                )
            waiting += 1
            if waiting == ROWS_AT_ONCE:
                _read_numbers(columns, places, str(path))
                waiting = 0
        _read_numbers(columns, places, str(path))
    if not places:
        raise BadManifest("has no foot below its head: give a row for each foot", str(path))
    feet = _table(columns, places, str(path))
    return feet, _notices(feet, roles.values(), str(path))


def _roles(head: Sequence[str], kept: Sequence[str], origin: str) -> dict[int, Role]:
    """What the columns hold, by their places; those that nobody asks for are left out."""
    names = [plain_name(cell) for cell in head]
    feet = {entry.name for entry in of_kind("foot")}
    known: dict[int, Role] = {}
    for place, name in enumerate(names):
        bare = name.removesuffix("_mm").removesuffix("_deg")
        asked = ALIASES.get(bare, bare)
        if asked in feet:
            scale = GREATEST_HEEL_SHARE if bare == GREATEST_HEEL else 1.0
            known[place] = Role(asked, "measure", scale)
        elif asked in (FLARE, "side"):
            known[place] = Role(asked, asked)
    taken = [role.name for role in known.values()]
    for name in taken:
        if taken.count(name) > 1:
            raise BadManifest(f"has two columns for {name}; keep one of them", origin)
    if "length" not in taken:
        words = "no column 'length'; give at least id, length and ball_girth, in mm"
        raise BadManifest(words, origin)
    naming = next((names.index(each) for each in IDS if each in names), None)
    if naming is not None:
        known[naming] = Role("id", "id")
    wanted = {plain_name(name): name for name in kept}
    for name in wanted:
        aliased = [i for i, each in enumerate(names) if name in (each, ALIASES.get(each))]
        if not aliased:
            there = ", ".join(cell.strip() for cell in head if cell.strip())
            raise BadOption(f"there is no column {wanted[name]!r}; there are {there}", origin)
        if aliased[0] not in known:
            known[aliased[0]] = Role(wanted[name], "text")
    return known


def _read_numbers(columns: Iterable[_Cells], places: Sequence[str], origin: str) -> None:
    """Turn the texts that wait into numbers."""
    for column in columns:
        if column.role.kind in ("measure", FLARE):
            start = sum(map(len, column.values))
            numbers = _numbers(column.texts, column.role, places[start:], origin)
            column.values.append(numbers)
            column.texts.clear()


def _numbers(texts: Sequence[str], role: Role, places: Sequence[str], origin: str) -> Floats:
    """The numbers of cells, with a point or a comma; NaN for an empty one."""
    try:
        values = np.array([text or "nan" for text in texts], dtype=np.float64)
    except ValueError:
        values = np.array(
            [_number(*each, role, origin) for each in zip(texts, places, strict=True)]
        )
    low, high = _range_of(role.name)
    wrong = np.flatnonzero(np.isinf(values) | (values < low) | (values > high))
    if len(wrong):
        value, unit = values[wrong[0]], "deg" if role.name == FLARE else "mm"
        words = f"{role.name} is {value:g}; it must be from {low:g} to {high:g} {unit}"
        for factor in (10.0, 1000.0, 25.4):
            if unit == "mm" and low <= value * factor <= high:
                words += f" (is it {value * factor:.0f} mm?): give all measures in mm"
                break
        raise BadManifest(words, f"{origin} line {places[wrong[0]]}")
    return values * role.scale


def _range_of(name: str) -> tuple[float, float]:
    """What a measure of a foot can be.

    Examples
    --------
    >>> _range_of("length"), _range_of("instep_girth_least")
    ((110.0, 370.0), (100.0, 600.0))
    """
    words = (word for word in name.split("_") if word in RANGES)
    return RANGES[name if name in RANGES else next(words)]


def _number(text: str, place: str, role: Role, origin: str) -> float:
    """One number that is not written plainly."""
    if text.casefold() in NOTHING:
        return float("nan")
    try:
        return float(text.replace(",", "."))
    except ValueError as error:
        words = f"{role.name} is {text!r}; it must be a number, or empty if it was not measured"
        raise BadManifest(words, f"{origin} line {place}") from error


def _table(columns: Sequence[_Cells], places: Sequence[str], origin: str) -> FootTable:
    """The feet of all columns."""
    count = len(places)
    by_kind = {kind: [c for c in columns if c.role.kind == kind] for kind in ("id", "side", "text")}
    values = {c.role.name: np.concatenate(c.values) for c in columns if c.values}
    entries = {entry.name: entry for entry in of_kind("foot")}
    measures = {
        name: _measure(value, entries[name]) for name, value in values.items() if name in entries
    }
    nothing = np.full(count, np.nan)
    ids = by_kind["id"][0].texts if by_kind["id"] else [""] * count
    shapes = ShapeColumns(
        extent_mm=values["length"],
        measures=measures,
        flare_deg=values.get(FLARE, nothing),
        flare_sd_deg=np.full(count, FOOT_SD_DEG),
        plan=np.empty((count, 0)),
        heel_mm=nothing,
        gain_mm=np.zeros(count),
        gain_sd_mm=np.zeros(count),
    )
    sides = by_kind["side"][0].texts if by_kind["side"] else [""] * count
    first = dict(zip(reversed(sides), reversed(places), strict=True)) if by_kind["side"] else {}
    known = {text: _side(text, f"{origin} line {place}") for text, place in first.items()}
    return FootTable(
        tuple(name or f"line {place}" for name, place in zip(ids, places, strict=True)),
        tuple(known.get(text) for text in sides),
        shapes,
        {column.role.name: tuple(column.texts) for column in by_kind["text"]},
    )


def _measure(value: Floats, entry: MeasureDefinition) -> MeasureColumn:
    """A measure by this version's definition, as sure as a second scan of the same foot."""
    code = definition_code(entry.definition_id)
    definition = np.where(np.isnan(value), -1, code)
    return MeasureColumn(value, np.where(np.isnan(value), 0.0, entry.sd), definition)


def _side(text: str, where: str) -> SideName | None:
    if text.casefold() in NOTHING:
        return None
    side = side_in_name(text).side
    if side is None:
        raise BadManifest(f"side is {text!r}; it must be left or right, or empty", where)
    return side


def _notices(feet: FootTable, roles: Iterable[Role], origin: str) -> tuple[Notice, ...]:
    """What should be known of the columns."""
    notices = []
    if any(role.scale != 1.0 for role in roles):
        words = f"{GREATEST_HEEL} is the greatest breadth of a heel; heel width is taken as"
        notices.append(Notice("heel_breadth", f"{words} {GREATEST_HEEL_SHARE} of it", origin))
    notices += [
        Notice("suspect_column", words, origin) for words in unusual_columns(feet.shapes).values()
    ]
    return tuple(notices)


def unusual_columns(shapes: ShapeColumns) -> Mapping[str, str]:
    """By measure, a sentence if many feet have a value that people hardly have."""
    said: dict[str, str] = {}
    length_mm = shapes.value_of("length")
    for entry in of_kind("foot"):
        value, unit = shapes.value_of(entry.name), "mm"
        if entry.usual_mm is None and entry.usual_share is None:
            continue
        low, high = entry.usual_mm or entry.usual_share or (0.0, 0.0)
        if entry.usual_mm is None:
            value, unit = value / length_mm, "of the length"
        said |= _unusual(entry.name, value, (low, high), unit)
    return said | _unusual(FLARE, shapes.flare_deg, PLAUSIBLE_FLARE_DEG["foot"], "deg")


def _unusual(name: str, value: Floats, usual: tuple[float, float], unit: str) -> dict[str, str]:
    known = np.isfinite(value)
    off = int(np.sum(known & ((value < usual[0]) | (value > usual[1]))))
    if not off or off <= UNUSUAL_SHARE * known.sum():
        return {}
    words = f"{name.replace('_', ' ')} of {off:,} of {int(known.sum()):,} feet is unusual"
    return {name: f"{words} (people have {usual[0]:g} to {usual[1]:g} {unit}): check the column"}
