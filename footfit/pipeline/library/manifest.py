"""The manifest of a batch: a CSV file that gives each mesh file its labels."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from footfit.errors import BadManifest, BadOption
from footfit.meshes.units import UNIT_SCALES
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.pipeline.scan.standing import LABELLED_MM
from footfit.results import LastLabels

LABEL_TEXTS = ("name", "style", "size", "size_system", "width_label")
LABEL_HEIGHTS = ("heel_height_mm", "toe_spring_mm", "platform_mm")
COLUMNS = ("path", *LABEL_TEXTS, "side", "units", *LABEL_HEIGHTS)
CHOICES = {"side": ("auto", "left", "right"), "units": ("auto", *UNIT_SCALES)}
LARGEST_BYTES = 16_000_000


@dataclass(frozen=True, slots=True)
class ManifestRow:
    """One line of a manifest; ``labels.name`` is the file's stem if the line has no name."""

    path: str
    labels: LastLabels
    reading: ReadingOptions


def read_manifest(path: Path) -> list[ManifestRow]:
    """Read a manifest file.

    Raises
    ------
    BadManifest
        It is not a file, not UTF-8 text or too large, or its content is not understood.
    """
    try:
        if not path.is_file():
            raise BadManifest("is not a file; name a CSV file", str(path))
        if path.stat().st_size > LARGEST_BYTES:
            limit = f"{LARGEST_BYTES / 1e6:.0f} MB"
            raise BadManifest(f"is larger than {limit}; give it fewer lines", str(path))
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise BadManifest(f"cannot be read as UTF-8 text ({error})", str(path)) from error
    return manifest_rows(text, path.parent, str(path))


def manifest_rows(text: str, folder: Path, origin: str) -> list[ManifestRow]:
    r"""Read the text of a manifest; paths are relative to ``folder``, errors name ``origin``.

    Raises
    ------
    BadManifest
        There is no ``path`` column, an unknown column, a value outside its range, or a file that
        is named twice.

    Examples
    --------
    >>> row, = manifest_rows("path,size\nderby.stl,42\n", Path("lasts"), "lasts.csv")
    >>> row.path, row.labels.name, row.labels.size
    ('lasts/derby.stl', 'derby', '42')
    """
    reader = csv.DictReader(io.StringIO(text), skipinitialspace=True)
    fields = [name.strip() for name in reader.fieldnames or []]
    reader.fieldnames = fields
    unknown = [name for name in fields if name not in COLUMNS]
    if "path" not in fields or unknown:
        problem = f"unknown column {unknown[0]!r}" if unknown else "no column 'path'"
        raise BadManifest(f"{problem}; the columns are {', '.join(COLUMNS)}", origin)
    try:
        rows = [_row(values, folder, f"{origin} line {reader.line_num}") for values in reader]
    except csv.Error as error:
        raise BadManifest(f"is not a CSV file ({error}); save it as CSV", origin) from error
    seen: set[str] = set()
    for row in rows:
        if row.path in seen:
            raise BadManifest(f"names {row.path} twice; keep one line for it", origin)
        seen.add(row.path)
    return rows


def _row(values: dict[str, str | None], folder: Path, where: str) -> ManifestRow:
    if None in values:
        raise BadManifest("has more values than columns; quote values with commas", where)
    given = {name: text for name, value in values.items() if (text := (value or "").strip())}
    if "path" not in given:
        raise BadManifest("has no path; fill it in or remove the line", where)
    said: dict[str, Any] = {name: given[name] for name in LABEL_TEXTS if name in given}
    said |= {name: _height(given.get(name), name, where) for name in LABEL_HEIGHTS}
    labels = LastLabels(**{"name": Path(given["path"]).stem} | said)
    units, side = (_choice(given.get(name, "auto"), name, where) for name in ("units", "side"))
    reading = ReadingOptions(units=units, side=side)
    return ManifestRow(str(folder / given["path"]), labels, reading)


def _choice(value: str, column: str, where: str) -> str:
    words = CHOICES[column]
    if value.lower() not in words:
        raise BadManifest(f"{column} is {value!r}; it must be one of {', '.join(words)}", where)
    return value.lower()


def _height(value: str | None, column: str, where: str) -> float | None:
    try:
        return None if value is None else label_mm(float(value), column)
    except (ValueError, BadOption) as error:
        low, high = LABELLED_MM[column]
        words = f"{column} is {value!r}; it must be a number of mm from {low} to {high}"
        raise BadManifest(words, where) from error


def label_mm(value: float | None, name: str) -> float | None:
    """A height that a label gives, in mm, or None.

    Raises
    ------
    BadOption
        No last has that height.

    Examples
    --------
    >>> label_mm(25.0, "heel_height_mm"), label_mm(None, "platform_mm")
    (25.0, None)
    """
    low, high = LABELLED_MM[name]
    if value is not None and not low <= value <= high:
        noun = name.removesuffix("_mm").replace("_", " ")
        raise BadOption(f"a {noun} is from {low} to {high} mm, not {value}")
    return value
