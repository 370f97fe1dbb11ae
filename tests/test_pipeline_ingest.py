"""Ingest without meshes: which labels a file gets, and what becomes of names and contents."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from footfit.errors import BadOption, NameTaken
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.entries import Entry, entries, unused_rows
from footfit.pipeline.library.holdings import Holdings
from footfit.pipeline.library.manifest import manifest_rows
from footfit.results import LastLabels
from tests.records import last

NOTHING = LastLabels("")
PLAIN = ReadingOptions()


def entry(name: str = "oxford-42", **labels: object) -> Entry:
    record = last(name)
    given = replace(record.labels, **labels)  # type: ignore[arg-type]
    return Entry(Source(f"{name}.stl"), given, PLAIN)


STORED = last("oxford-42", seed=1)
HOLDINGS = Holdings([STORED])


def status(sha256: str, name: str, replace_it: bool = False, **labels: object) -> str:
    wanted = replace(STORED.labels, name=name, **labels)  # type: ignore[arg-type]
    return HOLDINGS.status(sha256, Entry(Source("x.stl"), wanted, PLAIN), replace=replace_it)


def test_what_becomes_of_a_file() -> None:
    same, other = STORED.info.sha256, "0" * 64
    assert status(other, "new") == "added"
    assert status(same, "oxford-42") == "unchanged"
    assert status(same, "oxford-42", True) == "unchanged"
    assert status(other, "oxford-42", True) == "replaced"
    assert status(same, "oxford-42", True, style="boot") == "replaced"
    for wrong in ((other, "oxford-42", {}), (same, "oxford-42", {"style": "boot"})):
        with pytest.raises(NameTaken, match="--replace"):
            status(wrong[0], wrong[1], **wrong[2])
    for replace_it in (False, True):
        with pytest.raises(NameTaken, match="oxford-42"):
            status(same, "new", replace_it)


def test_a_side_or_unit_that_contradicts_the_stored_one_is_another_reading() -> None:
    one = Entry(Source("x.stl"), STORED.labels, ReadingOptions(side="left"))
    with pytest.raises(NameTaken, match="read otherwise"):
        HOLDINGS.status(STORED.info.sha256, one, replace=False)


def test_labels_come_from_the_manifest_then_the_command_line_then_the_stem() -> None:
    rows = manifest_rows("path,name,style,side\na.stl,one,,left\n", Path(), "m.csv")
    given = LastLabels("", style="derby", size="42")
    first, second = entries([Source("b.stl"), Source("a.stl")], rows, given, PLAIN)
    assert (first.labels.name, first.labels.style, first.reading.side) == ("one", "derby", "left")
    assert (second.labels.name, second.labels.size, second.reading.side) == ("b", "42", "auto")


def test_a_manifest_alone_names_its_files_in_sorted_order() -> None:
    rows = manifest_rows("path\nb.stl\na.stl\n", Path("shop"), "m.csv")
    batch = entries([], rows, NOTHING, PLAIN)
    assert [one.source.path for one in batch] == [str(Path("shop") / n) for n in ("a.stl", "b.stl")]


def test_rows_of_other_files_are_said_and_stop_nothing() -> None:
    rows = manifest_rows("path,style\na.stl,derby\nc.stl,\n", Path(), "m.csv")
    batch = entries([Source("a.stl")], rows, NOTHING, PLAIN)
    assert [one.labels.style for one in batch] == ["derby"]
    (notice,) = unused_rows(batch, rows)
    assert "c.stl" in notice.message
    assert "no labels" not in notice.message
    assert unused_rows(batch, rows[:1]) == ()


def test_a_manifest_whose_paths_miss_every_file_is_said() -> None:
    rows = manifest_rows("path,style\nlasts/a.stl,derby\n", Path("lasts"), "m.csv")
    (notice,) = unused_rows(entries([Source("lasts/a.stl")], rows, NOTHING, PLAIN), rows)
    assert "no labels" in notice.message


def test_a_known_length_is_another_reading_unless_it_is_the_stored_one() -> None:
    sha, labels = STORED.info.sha256, STORED.labels
    known_mm = {STORED.length_mm: "unchanged", STORED.length_mm + 1: "replaced"}
    scaled_by_its_extent = {STORED.extent_mm: "unchanged"}  # as older versions did
    for known, expected in (known_mm | scaled_by_its_extent).items():
        one = Entry(Source("x.stl"), labels, ReadingOptions(known_length_mm=known))
        assert HOLDINGS.status(sha, one, replace=True) == expected


def test_what_cannot_be_meant_is_refused() -> None:
    two = [Source("a.stl"), Source("b.stl")]
    with pytest.raises(BadOption, match="--name"):
        entries(two, [], LastLabels("one"), PLAIN)
    with pytest.raises(BadOption, match="--name"):
        entries([Source(None, b"x", "stl")], [], NOTHING, PLAIN)
    with pytest.raises(BadOption, match="nothing to ingest"):
        entries([], [], NOTHING, PLAIN)
