"""check-lasts finds what was put wrong among graded lasts, and nothing among sound ones."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.catalogue.store import open_catalogue
from footfit.geometry.measures.measure_table import measure_named
from footfit.pipeline.last_checks.lasts_check import check_lasts
from footfit.pipeline.last_checks.twin_lasts import near_pairs
from footfit.results import LastRecord, Measure, Measured, Notice
from tests import answers
from tests.conftest import Footfit

BASE_MM = {
    "length": 273.3, "bottom_length": 266.0, "ball_girth": 240.0, "ball_girth_least": 238.0,
    "waist_girth_least": 230.0, "instep_girth_least": 240.0, "ball_width": 92.0,
    "heel_width": 60.0, "toe_height": 30.0, "heel_height": 25.0,
}  # fmt: skip
SIZE_MM = {"length": 6.667, "girth": 5.0, "width": 5.0 / 3.0, "height": 0.0}
WIDTH_MM = {"length": 0.0, "girth": 5.0, "width": 5.0 / 3.0, "height": 0.0}
SIZES, WIDTHS = range(38, 44), "FGH"


def graded(size: int, width: str, *, family: str = "derby", **more_mm: float) -> LastRecord:
    """A last of a run; ``more_mm`` is added to its measures."""
    steps = size - 41, WIDTHS.index(width) - 1
    values = {}
    for name, mm in BASE_MM.items():
        kind = next((k for k in ("girth", "length", "width") if k in name), "height")
        values[name] = mm + steps[0] * SIZE_MM[kind] + steps[1] * WIDTH_MM[kind]
        values[name] += more_mm.get(name, 0.0)
    name = f"{family}-{size}-{width}"
    record = answers.record(
        name, length_mm=values["length"], family=family, style=family, size=str(size),
        size_system="eu", width_label=width, heel_height_mm=25.0,
    )  # fmt: skip
    rows = tuple(
        Measure(each, Measured(mm, measure_named(each).sd), measure_named(each).definition_id)
        for each, mm in values.items()
    )
    return replace(
        record, measures=rows, info=replace(record.info, sha256=name.encode().hex()[:64])
    )


def run() -> dict[str, LastRecord]:
    """A sound run of six sizes in three widths."""
    lasts = [graded(size, width) for size in SIZES for width in WIDTHS]
    return {last.labels.name: last for last in lasts}


def named(record: LastRecord, name: str, **labels: object) -> LastRecord:
    """The same shape under another name, from another file."""
    own = replace(record.labels, name=name, **labels)
    return replace(record, labels=own, info=replace(record.info, sha256=name.encode().hex()[:64]))


def stored(path: Path, lasts: Iterable[LastRecord]) -> Path:
    with open_catalogue(path, write=True) as catalogue:
        for last in lasts:
            sha256 = (last.info.sha256 * 64)[:64]
            catalogue.add(replace(last, info=replace(last.info, sha256=sha256)))
    return path


def found(path: Path, lasts: Iterable[LastRecord]) -> set[tuple[str, str]]:
    return {(each.last, each.code) for each in check_lasts(stored(path, lasts)).findings}


def test_nothing_is_found_in_a_sound_run(tmp_path: Path) -> None:
    check = check_lasts(stored(tmp_path / "a.footfit", run().values()))
    assert check.findings == ()
    assert (check.lasts, check.families, check.not_compared) == (18, 1, 0)


def test_twins_and_near_twins_are_found_and_pairs_are_not(tmp_path: Path) -> None:
    lasts = run()
    base = lasts["derby-41-G"]
    again = graded(41, "G", ball_girth=0.3, length=0.1)
    revised = graded(41, "G", ball_girth=1.9, ball_girth_least=1.9)
    other_side = replace(base, side=replace(base.side, side="left", score=-3.0))
    unlike = dict.fromkeys(("family", "style", "width_label"))
    more = [
        named(again, "x-again", **unlike),
        named(revised, "x-revised", **unlike),
        named(other_side, "x-left", **unlike),
    ]
    check = check_lasts(stored(tmp_path / "a.footfit", [*lasts.values(), *more]))
    twins = {(each.last, each.code, each.other) for each in check.findings}
    assert ("x-again", "twin", "derby-41-G") in twins
    assert ("x-revised", "near_twin", "derby-41-G") in twins
    assert len(twins) == 2
    assert [each.code for each in check.faults] == ["twin"]
    (reason,) = (each.message for each in check.faults)
    assert "its style is not labelled, that of 'derby-41-G' is derby" in reason


@pytest.mark.parametrize(
    ("wrong", "expected"),
    [
        (
            named(graded(41, "G"), "derby-41-G", size="38", family=None, style="x"),
            ("derby-41-G", "size_contradicted"),
        ),
        (named(graded(41, "F", length=0.3), "derby-41-H", width_label="H"),
         ("derby-41-H", "width_contradicted")),
        (graded(41, "G", ball_girth_least=6.0), ("derby-41-G", "off_in_family")),
        (graded(43, "G", instep_girth_least=-7.0), ("derby-43-G", "off_in_family")),
        (graded(40, "G", heel_height=9.0), ("derby-40-G", "off_in_family")),
    ],
)  # fmt: skip
def test_a_label_or_a_last_that_is_wrong_is_found(
    wrong: LastRecord, expected: tuple[str, str], tmp_path: Path
) -> None:
    lasts = run() | {wrong.labels.name: wrong}
    assert expected in found(tmp_path / "a.footfit", lasts.values())


def test_a_run_that_jumps_between_two_sizes_is_found(tmp_path: Path) -> None:
    lasts = [
        graded(size, width, instep_girth_least=4.0 if size >= 42 else 0.0)
        for size in SIZES
        for width in WIDTHS
    ]
    jumps = {(f"derby-42-{width}", "jump_in_family") for width in WIDTHS}
    assert found(tmp_path / "a.footfit", lasts) == jumps


@pytest.mark.parametrize(
    ("stored_code", "code"),
    [
        ("side_name_differs", "side_contradicted"),
        ("stance_label_contradicted", "heel_contradicted"),
        ("low_side_confidence", "side_doubtful"),
    ],
)
def test_what_the_ingest_saw_is_a_finding(stored_code: str, code: str, tmp_path: Path) -> None:
    lasts = run()
    last = lasts["derby-40-F"]
    lasts["derby-40-F"] = replace(last, warnings=(Notice(stored_code, "it says so"),))
    assert found(tmp_path / "a.footfit", lasts.values()) == {("derby-40-F", code)}


def test_a_side_that_the_shape_does_not_show_is_found(tmp_path: Path) -> None:
    lasts = run()
    base = lasts.pop("derby-41-G")
    right = replace(base.side, side="right", score=3.0, confidence="sure")
    lasts["a"] = named(replace(base, side=right), "derby-41-left")
    given = replace(right, side="left", source="given", confidence="low")
    lasts["b"] = named(replace(lasts.pop("derby-40-G"), side=given), "derby-40-L")
    expected = {("derby-41-left", "side_contradicted"), ("derby-40-L", "side_doubtful")}
    assert expected == found(tmp_path / "a.footfit", lasts.values())


def test_the_command_lists_them_and_exits_with_7(tmp_path: Path, footfit: Footfit) -> None:
    lasts = run()
    lasts["derby-41-G"] = graded(41, "G", ball_girth_least=6.0)
    path, csv = stored(tmp_path / "a.footfit", lasts.values()), tmp_path / "findings.csv"
    done = footfit("check-lasts", "--catalogue", path, "--csv", csv, "--json")
    assert done.code == 7
    document = json.loads(done.out)
    assert document["schema"] == "footfit.check-lasts/1"
    rows = csv.read_text().splitlines()
    assert len(rows) == 1 + len(document["findings"]) > 1
    assert "derby-41-G" in done.err.splitlines()[-1]
    loose = footfit("check-lasts", "--catalogue", path, "--tolerance", "girth=8")
    assert loose.code == 0
    assert "derby-41-G" not in loose.out
    assert footfit("check-lasts", "--catalogue", path, "--tolerance", "girth=x").code == 2


@given(st.integers(0, 2**20), st.integers(2, 25))
@settings(deadline=None, max_examples=30)
def test_near_pairs_are_those_of_brute_force(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).uniform(0.0, 6.0, (count, 3))
    rows = np.flatnonzero(points[:, 0] < 5.5)
    pairs = near_pairs(points, rows)
    near = {
        (i, j) for i in rows for j in rows if i < j and (np.abs(points[i] - points[j]) <= 1.0).all()
    }
    assert set(pairs) <= near
    crowded = max((sum(i in pair for pair in near) for i in rows), default=0)
    if crowded <= 4:
        assert set(pairs) == near
    assert {i for pair in pairs for i in pair} == {i for pair in near for i in pair}
