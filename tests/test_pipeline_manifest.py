"""The manifest CSV: every mistake is refused with its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from footfit.errors import BadManifest
from footfit.pipeline.library.manifest import COLUMNS, manifest_rows, read_manifest

FOLDER = Path("shop")


def rows(text: str) -> list:
    return manifest_rows(text, FOLDER, "lasts.csv")


def test_every_column_is_taken() -> None:
    text = ",".join(COLUMNS) + "\na.stl,derby-42,derby,42,eu,G,left,m,25.5\n"
    (row,) = rows(text)
    assert row.path == str(FOLDER / "a.stl")
    labels = row.labels
    assert (labels.name, labels.style, labels.size) == ("derby-42", "derby", "42")
    assert (labels.size_system, labels.width_label, labels.heel_height_mm) == ("eu", "G", 25.5)
    assert (row.reading.side, row.reading.units) == ("left", "m")


def test_what_is_not_said_stays_open() -> None:
    (row,) = rows("path\nsub/a.stl\n")
    assert row.labels.name == "a"
    assert row.labels.style is None
    assert (row.reading.side, row.reading.units) == ("auto", "auto")


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("name\nx\n", "no column 'path'"),
        ("", "no column 'path'"),
        ("path,sizes\na.stl,42\n", "unknown column 'sizes'"),
        ("path\na.stl\na.stl\n", "twice"),
        ("path,side\na.stl,port\n", "side is 'port'"),
        ("path,units\na.stl,ft\n", "units is 'ft'"),
        ("path,heel_height_mm\na.stl,tall\n", "heel_height_mm is 'tall'"),
        ("path,heel_height_mm\na.stl,nan\n", "heel_height_mm is 'nan'"),
        ("path,name\n,x\n", "has no path"),
        ("path,name\na.stl,x,y\n", "more values than columns"),
    ],
)
def test_a_mistake_is_named(text: str, word: str) -> None:
    with pytest.raises(BadManifest, match=word):
        rows(text)


def test_a_byte_order_mark_is_no_part_of_the_first_column(tmp_path: Path) -> None:
    path = tmp_path / "lasts.csv"
    path.write_bytes(b"\xef\xbb\xbfpath,style\na.stl,derby\n")
    assert read_manifest(path)[0].labels.style == "derby"


def test_what_is_no_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "lasts.csv"
    path.write_bytes(b"path\n\xff\xfe.stl\n")
    with pytest.raises(BadManifest, match="UTF-8"):
        read_manifest(path)
    with pytest.raises(BadManifest, match="not a file"):
        read_manifest(tmp_path / "none.csv")
