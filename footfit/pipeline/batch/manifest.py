"""The manifest of a batch: a CSV file that gives each mesh file its labels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from footfit.errors import BadManifest, BadOption
from footfit.meshes.units import UNIT_SCALES
from footfit.pipeline.batch.csv_rows import CsvRow, Faults, csv_rows, rows_of_text
from footfit.pipeline.batch.sources import LABELLED_MM, ManifestRow, ReadingOptions, stored_path
from footfit.results import LastLabels

LABEL_TEXTS = ("name", "style", "size", "size_system", "width_label", "family")
LABEL_HEIGHTS = ("heel_height_mm", "toe_spring_mm", "platform_mm")
SHA256 = "sha256"
"""The column with the hash of the file's content."""
COLUMNS = ("path", *LABEL_TEXTS, "side", "units", *LABEL_HEIGHTS, SHA256)
CHOICES = {"side": ("auto", "left", "right"), "units": ("auto", *UNIT_SCALES)}


def read_manifest(path: Path) -> list[ManifestRow]:
    """Read a manifest file.

    Raises
    ------
    BadManifest
        It is not a file, not UTF-8 text or too large, or its content is not understood. The error
        has all other errors of the file in ``others``.
    """
    faults = Faults()
    rows = csv_rows(path, COLUMNS, ("path",), faults)
    return _labelled_rows(rows, path.parent, str(path), faults)


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
    faults = Faults()
    rows = rows_of_text(text, COLUMNS, ("path",), origin, faults)
    return _labelled_rows(rows, folder, origin, faults)


def _labelled_rows(
    rows: Sequence[CsvRow], folder: Path, origin: str, faults: Faults
) -> list[ManifestRow]:
    """The rows with their labels.

    Raises
    ------
    BadManifest
        Something is wrong in a row, or in what was read before.
    """
    labelled: dict[str, ManifestRow] = {}
    for row in rows:
        said = _labelled_row(row, folder, faults)
        with faults.collecting():
            if "path" not in row.values:
                raise BadManifest("has no path; fill it in or remove the line", row.where)
            if said.path in labelled:
                raise BadManifest(f"names {said.path} twice; keep one line for it", row.where)
        labelled.setdefault(said.path, said)
    faults.refuse(origin)
    return list(labelled.values())


def _labelled_row(row: CsvRow, folder: Path, faults: Faults) -> ManifestRow:
    """A row with its labels; what is wrong in its cells is collected."""
    given, where = row.values, row.where
    said: dict[str, Any] = {
        name: " ".join(given[name].split()) for name in LABEL_TEXTS if name in given
    }
    reading: dict[str, Any] = {}
    for name in LABEL_HEIGHTS:
        with faults.collecting():
            said[name] = _height(given.get(name), name, where)
    for name in CHOICES:
        with faults.collecting():
            reading[name] = _choice(given.get(name, "auto"), name, where)
    sha256 = None
    with faults.collecting():
        sha256 = _hash(given.get(SHA256), where)
    path = stored_path(str(folder / given.get("path", "")))
    labels = LastLabels(**{"name": Path(path).stem} | said)
    return ManifestRow(path, labels, ReadingOptions(**reading), sha256)


def _hash(value: str | None, where: str) -> str | None:
    if value is not None and not re.fullmatch("[0-9a-fA-F]{64}", value):
        words = f"{SHA256} is {value!r}; it must have 64 digits of 0-9 and a-f, or be empty"
        raise BadManifest(words, where)
    return None if value is None else value.lower()


def _choice(value: str, column: str, where: str) -> str:
    words = CHOICES[column]
    if value.lower() not in words:
        raise BadManifest(f"{column} is {value!r}; it must be one of {', '.join(words)}", where)
    return value.lower()


def _height(value: str | None, column: str, where: str) -> float | None:
    try:
        return None if value is None else label_mm(float(value.replace(",", ".")), column)
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
