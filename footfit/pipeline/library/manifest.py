"""The manifest of a batch: a CSV that labels each file."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

from footfit.errors import BadManifest, BadOption
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.results import LastLabels

COLUMNS = (
    "path",
    "name",
    "style",
    "size",
    "size_system",
    "width_label",
    "side",
    "units",
    "heel_height_mm",
)
LARGEST_BYTES = 16_000_000
HEEL_HEIGHTS_MM = (0, 200)
SIDES = ("auto", "left", "right")
UNITS = ("auto", "mm", "cm", "m", "in")


@dataclass(frozen=True, slots=True)
class ManifestRow:
    """One line of a manifest; ``labels.name`` is the file's stem where the line names none."""

    path: str
    labels: LastLabels
    reading: ReadingOptions


def read_manifest(path: Path) -> list[ManifestRow]:
    """Read a manifest file.

    Raises
    ------
    BadManifest
        It is no file, no UTF-8 text, too large, or its content is not understood.
    """
    try:
        if not path.is_file():
            raise BadManifest("is no file; name the manifest's CSV", str(path))
        if path.stat().st_size > LARGEST_BYTES:
            raise BadManifest("is larger than 16 MB; a manifest is a small CSV", str(path))
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise BadManifest(f"cannot be read as UTF-8 text ({error})", str(path)) from error
    return manifest_rows(text, path.parent, str(path))


def manifest_rows(text: str, folder: Path, origin: str) -> list[ManifestRow]:
    r"""Parse a manifest; paths are relative to ``folder``, ``origin`` names it in errors.

    Raises
    ------
    BadManifest
        No ``path`` column, an unknown column, a value outside its range, a file named twice.

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
        raise BadManifest(f"is no CSV ({error}); save it as comma-separated", origin) from error
    seen: set[str] = set()
    for row in rows:
        if row.path in seen:
            raise BadManifest(f"names {row.path} twice; keep one line for it", origin)
        seen.add(row.path)
    return rows


def _row(values: dict[str, str | None], folder: Path, where: str) -> ManifestRow:
    if None in values:
        raise BadManifest("has more values than columns; quote values with commas", where)
    given = {name: (value or "").strip() for name, value in values.items()}
    if not given["path"]:
        raise BadManifest("has no path; fill it in or remove the line", where)
    labels = LastLabels(
        name=given.get("name") or Path(given["path"]).stem,
        style=given.get("style") or None,
        size=given.get("size") or None,
        size_system=given.get("size_system") or None,
        width_label=given.get("width_label") or None,
        heel_height_mm=_height(given.get("heel_height_mm", ""), where),
    )
    reading = ReadingOptions(
        units=_chosen(given.get("units", ""), UNITS, "units", where),
        side=_chosen(given.get("side", ""), SIDES, "side", where),
    )
    return ManifestRow(str(folder / given["path"]), labels, reading)


def _chosen(value: str, known: tuple[str, ...], column: str, where: str) -> str:
    word = value.lower() or "auto"
    if word not in known:
        raise BadManifest(f"{column} is {value!r}; it is one of {', '.join(known)}", where)
    return word


def _height(value: str, where: str) -> float | None:
    if not value:
        return None
    try:
        return heel_height_mm(float(value))
    except (ValueError, BadOption) as error:
        low, high = HEEL_HEIGHTS_MM
        words = f"heel_height_mm is {value!r}; it is a number of mm from {low} to {high}"
        raise BadManifest(words, where) from error


def heel_height_mm(value: float | None) -> float | None:
    """A heel height as labelled, or None.

    Raises
    ------
    BadOption
        It is no height that a heel has.
    """
    low, high = HEEL_HEIGHTS_MM
    if value is not None and not low <= value <= high:
        raise BadOption(f"a heel height is from {low} to {high} mm, not {value}")
    return value
