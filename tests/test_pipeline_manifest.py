"""The manifest CSV: every mistake is refused with its line."""

from __future__ import annotations

import os
import pickle
import unicodedata
from pathlib import Path

import pytest

from footfit.errors import BadManifest
from footfit.pipeline.batch.manifest import COLUMNS, manifest_rows, read_manifest

FOLDER = Path("shop")


def rows(text: str) -> list:
    return manifest_rows(text, FOLDER, "lasts.csv")


def test_every_column_is_taken() -> None:
    text = ",".join(COLUMNS) + "\na.stl,derby-42,derby,42,eu,G,derby-G,left,m,25.5\n"
    (row,) = rows(text)
    assert row.path == str(FOLDER / "a.stl")
    labels = row.labels
    assert (labels.name, labels.style, labels.size) == ("derby-42", "derby", "42")
    assert (labels.size_system, labels.width_label, labels.heel_height_mm) == ("eu", "G", 25.5)
    assert labels.family == "derby-G"
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
        ("path,name,\na.stl,x,y\n", "column 3, which has no name"),
        ("path,size,Size\na.stl,42,43\n", "column 'size' twice"),
        ("path,stile\na.stl,derby\n", "did you mean 'style'"),
        ("path;stile\na.stl;derby\n", "unknown column 'stile'"),
        ("name;size\nx;42\n", "no column 'path'"),
        ('path,name\na.stl,"x\n', "not a CSV file"),
    ],
)
def test_a_mistake_is_named(text: str, word: str) -> None:
    with pytest.raises(BadManifest, match=word):
        rows(text)


def test_all_mistakes_are_named_at_once_in_the_order_of_the_lines() -> None:
    text = (
        "path,side,heel_height_mm,colour\n"
        "a.stl,port,tall,red\n"
        ",left,,\n"
        "a.stl,left,25,,7\n"
        "a.stl,left,25,\n"
    )
    with pytest.raises(BadManifest) as raised:
        rows(text)
    errors = [raised.value, *raised.value.others]
    assert [(error.path, error.message.split(";")[0]) for error in errors] == [
        ("lasts.csv", "unknown column 'colour'"),
        ("lasts.csv line 2", "heel_height_mm is 'tall'"),
        ("lasts.csv line 2", "side is 'port'"),
        ("lasts.csv line 3", "has no path"),
        ("lasts.csv line 4", "has more values than columns"),
        ("lasts.csv line 5", "names shop/a.stl twice"),
    ]
    again = pickle.loads(pickle.dumps(raised.value))  # as a worker sends it
    assert [error.message for error in again.others] == [error.message for error in errors[1:]]


def test_of_very_many_mistakes_the_first_are_named_and_the_others_counted() -> None:
    with pytest.raises(BadManifest) as raised:
        rows("path,side\n" + "".join(f"{number}.stl,port\n" for number in range(33)))
    assert len(raised.value.others) == 20
    assert raised.value.others[-1].message.startswith("and 13 more errors")


def test_what_spreadsheets_add_changes_nothing() -> None:
    plain = rows("path,name,size,heel_height_mm\na.stl,derby,42,25.5\nb.stl,loafer,43,\n")
    for text in (
        "path,name,size,heel_height_mm,,\na.stl,derby,42,25.5,,\n,,,,,\n\nb.stl,loafer,43,,,\n,,\n",
        "path;name;size;heel_height_mm\na.stl;derby;42;25,5\nb.stl;loafer;43;\n",
        "path\tname\tsize\theel_height_mm\na.stl\tderby\t42\t25.5\nb.stl\tloafer\t43\t\n",
        "sep=;\r\npath;name;size;heel_height_mm\r\na.stl;derby;42;25.5\r\nb.stl;loafer;43;\r\n",
        ' Path, "Name",SIZE,Heel height mm\na.stl, derby,42,"25,5"\nb.stl,loafer,43,\n',
        "\n\npath,,name,size,heel_height_mm\na.stl,,derby,42,25.5\nb.stl,,loafer,43\n",
        'path,name,size,heel_height_mm\na.stl,"der\nby",42,25.5\nb.stl,loafer,43,\n',
    ):
        given = rows(text.replace('"der\nby"', "derby"))
        assert given == plain, text
    (row, _) = rows('path,name\na.stl,"derby\n  42"\nb.stl,x\n')
    assert row.labels.name == "derby 42"


def test_a_mistake_after_a_quoted_line_break_has_its_own_line() -> None:
    with pytest.raises(BadManifest) as raised:
        rows('sep=,\npath,name,side\na.stl,"derby\n42",left\nb.stl,x,port\n')
    assert raised.value.path == "lasts.csv line 5"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_a_manifest_in_any_unicode_encoding_is_read(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "lasts.csv"
    path.write_text("path,style\na.stl,größe\n", encoding=encoding)
    assert read_manifest(path)[0].labels.style == "größe"


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16-le", "utf-16-be"])
def test_another_encoding_is_named(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "lasts.csv"
    path.write_text("path,style\na.stl,größe\n", encoding=encoding)
    with pytest.raises(BadManifest, match="save it as CSV UTF-8"):
        read_manifest(path)
    with pytest.raises(BadManifest, match="no such file"):
        read_manifest(tmp_path / "none.csv")
    with pytest.raises(BadManifest, match="not a file"):
        read_manifest(tmp_path)


def test_a_path_is_found_in_another_spelling(tmp_path: Path) -> None:
    """As Windows writes it, and as macOS does (NFD)."""
    folder = tmp_path / unicodedata.normalize("NFD", "größe")
    folder.mkdir()
    (folder / unicodedata.normalize("NFD", "é.stl")).touch()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "a.stl").touch()
    (tmp_path / "odd\\b.stl").touch()
    text = "path\n" + unicodedata.normalize("NFC", "größe\\é.stl") + "\nsub\\a.stl\nodd\\b.stl\n"
    given = [row.path for row in manifest_rows(text, tmp_path, "lasts.csv")]
    assert all(Path(path).is_file() for path in given), given
    assert given[2].endswith("odd\\b.stl" if os.sep == "/" else "b.stl")
