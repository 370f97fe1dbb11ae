"""``tools.answer_differences`` notices what changed, and passes over what may change."""

from __future__ import annotations

import copy
import csv
import io
import json
from argparse import Namespace
from pathlib import Path
from typing import Any

import pytest

from tools.answer_differences import answer_differences, compare, differences, report
from tools.answer_runs import cube, subject, table, two_feet

ANSWER: dict[str, Any] = {
    "schema": "footfit.match/2",
    "verdict": "good",
    "length_mm": 251.5,
    "mirrored": True,
    "candidates": [{"last": "derby-40", "distance": 1.25, "why": "2.5 mm toe room"}],
    "sd": None,
    "reason": "this part was not scanned",
    "warnings": [
        {"code": "open_mesh", "message": "the surface is open"},
        {"code": "non_manifold", "message": "13 times"},
    ],
}


def changed(**values: Any) -> dict[str, Any]:
    return {**copy.deepcopy(ANSWER), **values}


def kinds(after: Any, tolerance: float = 0.0) -> list[tuple[str, str]]:
    return [(item.kind, item.key) for item in differences(ANSWER, after, "match", tolerance)]


def test_equal_answers_do_not_differ() -> None:
    assert kinds(changed()) == []
    assert kinds(changed(warnings=ANSWER["warnings"][::-1])) == []  # warnings have no order


@pytest.mark.parametrize(
    ("values", "kind", "key"),
    [
        ({"length_mm": 251.501}, "number", "match.length_mm"),
        ({"length_mm": None}, "value", "match.length_mm"),
        ({"sd": 0.0}, "value", "match.sd"),
        ({"mirrored": 1}, "value", "match.mirrored"),
        ({"verdict": "poor"}, "verdict", "match.verdict"),
        ({"schema": "footfit.match/3"}, "value", "match.schema"),
        ({"schema": "footfit.error/1", "code": "no_sole"}, "outcome", "match.schema"),
        ({"candidates": []}, "list length", "match.candidates"),
        ({"warnings": ANSWER["warnings"][:1]}, "code", "match.warnings.non_manifold"),
        ({"warnings": ANSWER["warnings"] * 2}, "code", "match.warnings.non_manifold#2"),
        ({"reason": None}, "value", "match.reason"),
        ({"reason": "this part is missing"}, "words", "match.reason"),
        ({"reason": "this part was not scanned in 2 places"}, "figures in words", "match.reason"),
        ({"extent_mm": 250.0}, "added", "match.extent_mm"),
    ],
)
def test_each_change_has_its_kind(values: dict[str, Any], kind: str, key: str) -> None:
    assert (kind, key) in kinds(changed(**values))


def test_lists_are_compared_place_by_place() -> None:
    later = changed(candidates=[{**ANSWER["candidates"][0], "distance": 1.5}])
    assert kinds(later) == [("number", "match.candidates.0.distance")]


def test_a_key_that_vanished_is_a_difference() -> None:
    later = changed()
    del later["sd"]
    assert kinds(later) == [("vanished", "match.sd")]


def test_numbers_agree_to_the_printed_digit_or_within_the_tolerance() -> None:
    assert kinds(changed(length_mm=251.52), tolerance=0.03) == []
    assert kinds(changed(length_mm=251.54), tolerance=0.03) == [("number", "match.length_mm")]
    assert [d.kind for d in differences({"a": 2}, {"a": 2.0}, "x")] == ["number"]
    assert [d.kind for d in differences({"a": "2.50"}, {"a": "2.5"}, "x")] == ["number"]
    assert list(differences({"a": "2.50"}, {"a": "2.51"}, "x", 0.02)) == []


def told(after: Any, expected: list[str], **options: bool) -> tuple[list[str], int]:
    items = list(answer_differences({("match", "a.stl"): ANSWER}, {("match", "a.stl"): after}))
    return report(items, expected, **{"words": False, "every": False, **options})


def test_words_and_added_keys_are_no_failures() -> None:
    later = changed(reason="not scanned", extent_mm=250.0)
    lines, failures = told(later, [])
    assert failures == 0
    assert lines == ["added: match.extent_mm (1 times): a.stl: null -> 250.0"]
    assert any("not scanned" in line for line in told(later, [], words=True)[0])


def test_expected_differences_are_no_failures_and_unmet_ones_are_named() -> None:
    later = changed(length_mm=250.0, verdict="poor")
    assert told(later, [])[1] == 2
    lines, failures = told(later, ["*.length_mm", "*.width_mm"])
    assert failures == 1
    assert "expected but not met: *.width_mm" in lines
    assert told(later, ["a.stl: *"])[1] == 0
    assert told(later, ["b.stl: *"])[1] == 2


def test_one_line_for_a_key_shows_the_largest_change() -> None:
    before = {("measure", name): {"values": [1.0, 2.0]} for name in ("a", "b")}
    after = {("measure", "a"): {"values": [1.1, 2.1]}, ("measure", "b"): {"values": [1.0, 5.0]}}
    items = list(answer_differences(before, after))
    lines, failures = report(items, [], words=False, every=False)
    assert failures == 3
    assert lines == ["number: measure.values.* (3 times): b: 2.0 -> 5.0"]
    assert len(report(items, [], words=False, every=True)[0]) == 3


def written(path: Path, *lines: dict[str, Any]) -> Path:
    path.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
    return path


def test_compare_ends_with_1_where_something_differs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = {"run": "match", "about": "a.stl", "answer": ANSWER}
    other = {"run": "flare", "about": "a.stl", "answer": {"exit": 0}}
    before = written(tmp_path / "before", line, other)
    options = Namespace(before=before, tolerance=0.0, expect=[], words=False, all=False, only="*")
    options.after = written(tmp_path / "same", other, line)
    assert compare(options) == 0
    options.after = written(tmp_path / "less", line)
    assert compare(options) == 1
    assert "answer vanished: flare" in capsys.readouterr().out
    options.only = "match*"
    assert compare(options) == 0
    options.before = written(tmp_path / "empty")
    with pytest.raises(SystemExit, match="no such answers"):
        compare(options)


def test_a_document_is_named_by_its_input() -> None:
    feet = [{"mesh": {"path": "l.stl"}}, {"mesh": {"path": "r.stl"}}]
    assert subject({"feet": feet}, "x") == "l.stl r.stl"
    assert subject({"mesh": {"path": "l.stl"}, "last": "derby-40"}, "x") == "l.stl derby-40"
    assert subject({"path": None, "code": "bug"}, "x") == "x"


def test_a_csv_is_read_by_its_first_column(tmp_path: Path) -> None:
    with (tmp_path / "t.csv").open("w", newline="") as file:
        csv.writer(file).writerows([("path", "n"), ("a", 1), ("a", 2), ("b", 3)])
    rows = dict(table((tmp_path / "t.csv").read_text()))
    assert rows["header"] == ["path", "n"]
    assert [row["n"] for row in rows["a"]] == ["1", "2"]
    assert [row["n"] for row in rows["b"]] == ["3"]


def test_the_bad_inputs_are_what_they_are_meant_to_be() -> None:
    import trimesh

    whole = trimesh.load_mesh(io.BytesIO(cube().encode()), file_type="obj")
    assert whole.is_watertight
    assert whole.volume == 200.0**3
    box = trimesh.creation.box(extents=(90.0, 90.0, 90.0)).export(file_type="stl")
    both = trimesh.load_mesh(io.BytesIO(two_feet(box, box)), file_type="stl")
    assert both.body_count == 2
    assert both.extents.tolist() == [90.0, 240.0, 90.0]
