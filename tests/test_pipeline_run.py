"""Runs that somebody graded: where their increments break, and which rules there are."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfit
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, BadProfile, FootfitError
from footfit.geometry.fit.sizes import SYSTEMS
from footfit.meshes.write import encoded_mesh
from footfit.number_words import signed
from footfit.pipeline.graded_runs import grading_rules
from footfit.pipeline.graded_runs.grading_rules import grading_rule, rule_of, shipped_rules
from footfit.pipeline.graded_runs.run_increments import CHECKED, HEIGHTS_BY_SHAPE, run_check
from footfit.pipeline.graded_runs.run_sizes import size_in_name, width_numbers
from footfit.pipeline.last_making.tolerances import TOLERANCE_MM, tolerances
from footfit.report.terminal.last_making_tables import check_run_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.report.wording.run_words import break_words
from footfit.results import Measure, Measured, RunLast
from footfit.results.last_making.run_check import RunStep
from tests import records
from tests.conftest import SAMPLES, Footfit
from tools.lasts import LastSpec, last_mesh

GIRTH = "ball_girth_least"


def last(size: float, girth_mm: float, width: str | None = None) -> RunLast:
    values = {"bottom_length": 270.0 + 6.667 * (size - 42.0), GIRTH: girth_mm}
    name = f"derby-{size:g}{width or ''}"
    return RunLast(name, f"{size:g}", size, width, "right", "catalogue", values)


def run(*girths_mm: float, width: str | None = None) -> list[RunLast]:
    return [last(38.0 + at, girth, width) for at, girth in enumerate(girths_mm)]


def test_an_even_run_has_no_break() -> None:
    checked = run_check(run(230.0, 235.0, 240.0, 245.0), TOLERANCE_MM)
    assert checked.broken == ()
    laws = {law.measure: law.per_step for law in checked.laws}
    assert laws == {"bottom_length": pytest.approx(6.667), GIRTH: pytest.approx(5.0)}


def test_a_wrong_last_breaks_two_increments_and_is_named() -> None:
    checked = run_check(run(230.0, 235.0, 243.0, 245.0, 250.0), TOLERANCE_MM)
    assert {(s.start, s.end, round(s.off_mm, 6)) for s in checked.broken} == {
        ("39", "40", 3.0),
        ("40", "41", -3.0),
    }
    (wrong,) = checked.off_lasts
    assert (wrong.last, wrong.off_mm) == ("derby-40", pytest.approx(3.0))


def test_a_wrong_step_breaks_one_increment_and_no_last_is_wrong() -> None:
    checked = run_check(run(230.0, 235.0, 244.0, 249.0, 254.0), TOLERANCE_MM)
    assert [(s.start, s.end) for s in checked.broken] == [("39", "40")]
    assert checked.off_lasts == ()
    assert checked.broken[0].words.endswith("9.0 mm, 5.0 mm expected, 4.0 mm too much")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("girth=1,girth=2", "names girth twice"),
        ("", "takes a text such as girth=2"),
        (" , ", "takes a text such as"),
        ("girth=100", "takes mm from 0 to 50"),
        ({"girth": 1}, "takes a text such as girth=2"),
    ],
)
def test_a_tolerance_is_refused_in_words(text: object, words: str) -> None:
    with pytest.raises(BadOption, match=words):
        tolerances(text)  # type: ignore[arg-type]


def test_a_tolerance_decides_what_breaks() -> None:
    uneven = run(230.0, 235.0, 241.0, 246.0, 251.0)
    assert run_check(uneven, TOLERANCE_MM).broken == ()
    assert len(run_check(uneven, tolerances("girth=0.5")).broken) == 1


def test_widths_are_compared_at_each_size() -> None:
    lasts = [*run(230.0, 235.0, 240.0, width="F"), *run(235.0, 240.0, 248.0, width="G")]
    checked = run_check(lasts, TOLERANCE_MM)
    widths = [s for s in checked.steps if (s.kind, s.measure) == ("width", GIRTH)]
    assert [(s.at, s.start, s.end, s.increment_mm) for s in widths] == [
        ("38", "F", "G", 5.0),
        ("39", "F", "G", 5.0),
        ("40", "F", "G", 8.0),
    ]
    assert [s.broken for s in widths] == [False, False, True]


def test_a_run_is_compared_with_a_rule() -> None:
    rule = grading_rule("uk", SYSTEMS["uk"])
    checked = run_check(run(230.0, 235.0, 240.0), tolerances("girth=1,length=1"), rule)
    girth = [s for s in checked.steps if s.measure == GIRTH]
    assert [s.expected_mm for s in girth] == [6.35, 6.35]
    assert {s.measure for s in checked.broken} == {GIRTH, "bottom_length"}
    assert {law.by for law in checked.laws} == {"uk"}


@pytest.mark.parametrize(
    ("lasts", "words"),
    [
        (run(230.0, 235.0), "3 sizes or more"),
        ([*run(230.0, 235.0, 240.0), last(38.0, 231.0)], "both 'derby-38' and 'derby-38'"),
        ([last(38.0 + at, 230.0, width) for at, width in enumerate("EFG")], "size alone"),
    ],
)
def test_what_is_no_run_is_refused(lasts: list[RunLast], words: str) -> None:
    with pytest.raises(BadOption, match=words):
        run_check(lasts, TOLERANCE_MM)


@pytest.mark.parametrize("name", shipped_rules())
def test_every_shipped_rule_has_sources_and_an_order_of_widths(name: str) -> None:
    rule = grading_rule(name)
    assert rule.name == name
    assert set(rule.size) <= set(CHECKED)
    for increment in (*rule.size.values(), *rule.width.values()):
        assert increment.by > 0.0
        assert len(increment.source) > 10
    assert rule.size["bottom_length"].by > rule.size[GIRTH].by or rule.law == "geometric"
    assert set(rule.width) < set(rule.size)


RULE = """
schema = "footfit.grading-rule/1"
name = "house"
systems = ["eu"]
[size.bottom_length]
mm = 6.667
grade = "B"
source = "the Paris point"
"""


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("[size.ball_girth]\nmm = 5", "a rule plans bottom_length, ball_girth_least"),
        ("[size.ball_girth_least]\ngrade = 'B'", "lacks mm"),
        ("[size.ball_girth_least]\nmm = 500\ngrade = 'B'\nsource = 'x'", "between -30 and 30"),
        ("[size.ball_girth_least]\nmm = 5\ngrade = 'Z'\nsource = 'x'", "grade must be one of"),
        ("[size.ball_girth_least]\nmm = 5\ngrade = 'B'", "source must be a short text"),
        ("[width.bottom_length]\nmm = 5\ngrade = 'B'\nsource = 'x'", "a width step changes no"),
        ("[colour]\n", "unknown key 'colour'"),
    ],
)
def test_a_wrong_rule_is_refused_in_words(more: str, words: str, tmp_path: Path) -> None:
    assert rule_of(RULE).size["bottom_length"].by == 6.667
    with pytest.raises(BadProfile, match=words):
        rule_of(RULE + more)
    path = tmp_path / "house.toml"
    path.write_text(RULE.replace('"eu"', '"moon"'))
    with pytest.raises(BadProfile, match="size systems are"):
        grading_rule(str(path))
    with pytest.raises(BadProfile, match="names a width twice"):
        rule_of(RULE.replace('["eu"]', '["eu"]\nwidths = ["E", "F", "e"]'))


def test_a_rule_counts_the_sizes_of_its_systems() -> None:
    with pytest.raises(BadOption, match="counts sizes of uk"):
        grading_rule("uk", SYSTEMS["eu"])
    assert {grading_rule(None, SYSTEMS[name]).name for name in SYSTEMS} <= set(shipped_rules())
    with pytest.raises(BadOption, match="there are china"):
        grading_rule("moon")
    assert set(grading_rules.BY_SYSTEM) == set(SYSTEMS)


def test_names_say_sizes() -> None:
    for stem, size, width in (
        ("derby-42", "42", None),
        ("derby_EU42_G_right_h25_ts8_v1_mm", "42", "G"),
        ("style7-39.5", "39.5", None),
        ("boot 42G", "42", "G"),
    ):
        label = size_in_name(stem)
        assert label is not None
        assert (label.size, label.width) == (size, width)
    assert size_in_name("derby-left") is None
    with pytest.raises(BadOption, match="no order"):
        width_numbers(["narrow", "wide"])


def test_a_last_that_is_compared_with_no_other_is_said() -> None:
    left = replace(last(41.0, 245.0), side="left")
    checked = run_check([*run(230.0, 235.0, 240.0), left], TOLERANCE_MM)
    assert checked.broken == ()
    (note,) = checked.warnings
    assert (note.code, "'derby-41' (left, size 41)" in note.message) == ("last_not_compared", True)


def test_files_and_families_are_checked(footfit: Footfit, tmp_path: Path) -> None:
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=60, segments=48))
    folder, catalogue = tmp_path / "run", tmp_path / "lasts.footfit"
    folder.mkdir()
    scales = {"40": 0.976, "41": 1.0, "42": 1.024, "43": 1.060}
    for size, scale in scales.items():
        mesh = encoded_mesh(vertices * scale, faces, "stl")
        (folder / f"derby-{size}.stl").write_bytes(mesh)
    files = sorted(folder.glob("*.stl"))
    assert footfit("check-run", *files[:3]).code == 0
    bad = footfit("check-run", folder, "--json")
    assert bad.code == 7
    assert bad.document["broken"][0]["to"] == "43"
    assert json.loads(bad.last_error)["code"] == "check_failed"
    table = footfit("check-run", folder, "--csv", "-")
    assert table.out.splitlines()[0].startswith("measure,kind,at,from,to")
    footfit("ingest-last", folder, "--family", "derby", "--catalogue", catalogue)
    unnamed = footfit("check-run", "derby", "--catalogue", catalogue)
    assert unnamed.code == 2
    assert "edit-last" in unnamed.err
    for size in scales:
        footfit("edit-last", f"derby-{size}", "--size", size, "--catalogue", catalogue)
    stored = footfit("check-run", "derby", "--catalogue", catalogue, "--json").document
    assert stored["family"] == "derby"
    assert [s["increment_mm"] for s in stored["steps"]] == [
        s["increment_mm"] for s in bad.document["steps"]
    ]
    unknown = footfit("check-run", "nothing", "--catalogue", catalogue)
    assert unknown.code == 4
    assert "no last and no family is named 'nothing'" in unknown.err
    missing = footfit("check-run", folder / "derby-99.stl", "--catalogue", catalogue)
    assert missing.code == 3
    assert "there is no such file" in missing.err


def test_a_manifest_beside_the_files_says_their_sizes_and_how_they_stand(
    footfit: Footfit, tmp_path: Path
) -> None:
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=60, segments=48))
    lines = ["path,size,heel_height_mm"]
    for name, scale in (("a", 0.976), ("b", 1.0), ("c", 1.024)):
        (tmp_path / f"{name}.stl").write_bytes(encoded_mesh(vertices * scale, faces, "stl"))
        lines.append(f"{name}.stl,{40 + 'abc'.index(name)},31.5")
    (tmp_path / "run.csv").write_text("\n".join(lines))
    lasts = footfit("check-run", tmp_path, "--json").document["lasts"]
    assert [(last["size"], last["size_from"]) for last in lasts] == [
        (size, "manifest") for size in ("40", "41", "42")
    ]
    for last in lasts:  # which they do not have by their shapes
        assert last["measures_mm"]["heel_height"] == pytest.approx(31.5, abs=0.1)
    other = tmp_path / "other.csv"
    other.write_text("\n".join(lines).replace(",4", ",3"))
    named = footfit("check-run", *sorted(tmp_path.glob("*.stl")), "--manifest", other)
    assert "3 lasts, sizes 30 to 32 by manifest" in named.out
    (tmp_path / "run.csv").write_text("date,runner\n")
    wrong = footfit("check-run", tmp_path)
    assert (wrong.code, "run.csv" in wrong.err) == (3, True), wrong.err


def test_a_label_does_not_hide_a_wrong_heel(footfit: Footfit, tmp_path: Path) -> None:
    """The heel is raised under a last whose label says the old height, which holds the measure."""
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=60, segments=48))
    lines = ["path,size,family,size_system,heel_height_mm,toe_spring_mm"]
    for size, scale in enumerate((0.976, 1.0, 1.024, 1.048), start=40):
        points = vertices * scale
        if size == 42:
            x = (points[:, 0] - points[:, 0].min()) / np.ptp(points[:, 0])
            points[:, 2] += 4.0 * np.clip((0.62 - x) / 0.62, 0.0, 1.0)
        (tmp_path / f"derby-{size}.stl").write_bytes(encoded_mesh(points, faces, "stl"))
        lines.append(f"derby-{size}.stl,{size},derby,eu,25,10")
    manifest, catalogue = tmp_path / "run.csv", tmp_path / "lasts.footfit"
    manifest.write_text("\n".join(lines))
    checked = footfit("check-run", tmp_path, "--json")
    assert checked.code == 7
    assert "heel height by shape 4" in checked.err
    (wrong,) = checked.document["off_lasts"]
    assert (wrong["last"], wrong["measure"]) == ("derby-42.stl", "heel_height_by_shape")
    assert wrong["off_mm"] == pytest.approx(4.0, abs=0.8)  # measured: 4.4
    assert {last["stands_by"] for last in checked.document["lasts"]} == {"label"}
    footfit("ingest-last", "--manifest", manifest, "--catalogue", catalogue)
    stored = footfit("check-run", "derby", "--catalogue", catalogue, "--json")
    assert (stored.code, stored.document["off_lasts"][0]["last"]) == (7, "derby-42")
    compared = footfit("compare-lasts", "derby-41", "derby-42", "--catalogue", catalogue)
    assert "by their shapes alone the heel height" in compared.err


def by_shape(*heels_mm: float) -> list[RunLast]:
    """Lasts that stand by their labels, whose shapes alone have these heels."""
    heights = [{"heel_height": 22.4, HEIGHTS_BY_SHAPE[0]: mm} for mm in heels_mm]
    return [
        replace(each, stands_by="label", measures_mm=each.measures_mm | more)
        for each, more in zip(run(*np.arange(len(heights)) * 5.0 + 230), heights, strict=True)
    ]


def test_shapes_may_wander_but_not_jump_beside_their_labels() -> None:
    held_bottom_mm = (24.1, 23.3, 22.4, 21.2, 19.6, 17.5, 14.9)  # a run of grade-last
    assert run_check(by_shape(*held_bottom_mm), TOLERANCE_MM).broken == ()
    (wrong,) = run_check(by_shape(22.4, 22.3, 26.6, 22.1), TOLERANCE_MM).off_lasts
    assert (wrong.measure, wrong.off_mm) == (HEIGHTS_BY_SHAPE[0], pytest.approx(4.4))


def test_a_last_without_a_label_stands_by_its_shape_beside_those_with_one() -> None:
    lasts = by_shape(22.4, 22.3, 22.2, 22.1)
    heel = {**lasts[2].measures_mm, "heel_height": 26.6}
    heel.pop(HEIGHTS_BY_SHAPE[0])
    lasts[2] = replace(lasts[2], stands_by="shape", measures_mm=heel)
    checked = run_check(lasts, TOLERANCE_MM)
    assert {off.measure for off in checked.off_lasts} == {HEIGHTS_BY_SHAPE[0]}
    assert [notice.code for notice in checked.warnings] == ["stance_by_shape"]
    alike = replace(lasts[2], measures_mm={**heel, "heel_height": 22.2})
    assert run_check([*lasts[:2], alike, lasts[3]], TOLERANCE_MM).broken == ()


def test_the_table_shows_every_increment_and_marks_what_breaks() -> None:
    lasts = [*run(230.0, 235.0, 243.0, 245.0, width="F"), *run(235.0, 240.0, 245.0, width="G")]
    checked = run_check(lasts, TOLERANCE_MM)
    text = terminal_text(check_run_table(checked), 120)
    for step in checked.steps:
        mark = "!" if step.broken else ""
        assert f"{signed(step.increment_mm)}{mark}" in text
    assert "arithmetic, compared with the run itself" in text
    assert "'derby-40F' (size 40) is wrong by itself, beside its neighbours: ball girth" in text


def test_a_last_that_is_wrong_in_many_measures_has_one_line() -> None:
    """One wrong last of a run in two widths breaks the steps before, behind and beside it."""
    narrow, wide = run(230.0, 235.0, 240.0, 245.0), run(235.0, 240.0, 245.0, 250.0)
    lasts = [replace(each, last=f"{each.last}F", width="F") for each in narrow]
    lasts += [replace(each, last=f"{each.last}G", width="G") for each in wide]
    lasts = [
        replace(each, measures_mm={**each.measures_mm, "ball_width": each.measures_mm[GIRTH] / 2})
        for each in lasts
    ]
    more_mm = {GIRTH: 8.0, "ball_width": 6.0}
    wrong = {name: lasts[5].measures_mm[name] + mm for name, mm in more_mm.items()}
    lasts[5] = replace(lasts[5], measures_mm={**lasts[5].measures_mm, **wrong})
    checked = run_check(lasts, TOLERANCE_MM)
    assert len(checked.broken) == 6
    assert checked.jumps == ()
    words = "'derby-39G' (size 39) is wrong by itself, beside its neighbours"
    assert list(break_words(checked)) == [f"{words}: ball girth least +8.0 mm, ball width +6.0 mm"]
    assert checked.worst_words.startswith("'derby-39G' (39) is wrong by itself")


def test_a_step_that_is_wrong_in_many_measures_has_one_line() -> None:
    lasts = run(230.0, 235.0, 244.0, 249.0, 254.0)
    lasts = [
        replace(each, measures_mm={**each.measures_mm, "ball_width": each.measures_mm[GIRTH] / 2})
        for each in lasts
    ]
    words = "from size 39 to 40, beside what is expected"
    assert list(break_words(run_check(lasts, TOLERANCE_MM))) == [
        f"{words}: ball girth least +4.0 mm, ball width +2.0 mm"
    ]


def test_a_last_without_a_measure_is_left_out_of_its_check(tmp_path: Path) -> None:
    path = tmp_path / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        for seed, size in enumerate((40, 41, 42, 43)):
            labels = {"size": str(size), "family": "derby", "size_system": "eu"}
            record = records.last(f"derby-{size}", seed, **labels)
            rows = [Measure("bottom_length", Measured(260.0 + 6.667 * seed), "bottom_length/2")]
            if seed != 1:
                rows.append(Measure(GIRTH, Measured(230.0 + 5.0 * seed), f"{GIRTH}/1"))
            sides = replace(record.side, side="right")
            catalogue.add(replace(record, measures=tuple(rows), side=sides))
    checked = footfit.check_run("derby", catalogue=path)
    steps = [(s.start, s.end) for s in checked.steps if s.measure == GIRTH]
    assert steps == [("40", "42"), ("42", "43")]
    assert [notice.code for notice in checked.warnings] == ["measure_missing"]
    with pytest.raises(FootfitError):
        footfit.check_run("derby")


def test_a_bad_file_does_not_stop_a_run(footfit: Footfit, tmp_path: Path) -> None:
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=60, segments=48))
    for size, scale in enumerate((0.976, 1.0, 1.024), start=40):
        (tmp_path / f"derby-{size}.stl").write_bytes(encoded_mesh(vertices * scale, faces, "stl"))
    (tmp_path / "derby-43.stl").write_bytes(b"")
    foot = min((SAMPLES / "feet").iterdir())
    (tmp_path / "derby-44.stl").write_bytes(foot.read_bytes())
    (tmp_path / "run.csv").write_text("path,style\nderby-40.stl,derby\nderby-39.stl,derby\n")
    checked = footfit("check-run", tmp_path, "--json")
    assert checked.code == 3  # the codes differ
    assert [each["code"] for each in checked.document["failed"]] == ["empty_mesh", "other_kind"]
    assert [last["size"] for last in checked.document["lasts"]] == ["40", "41", "42"]
    assert "the manifest names derby-39.stl, and there is no such file" in checked.err
    assert "the manifest says no size" in checked.err
    few = footfit("check-run", tmp_path / "derby-41.stl", tmp_path / "derby-43.stl")
    assert (few.code, "the file is empty" in few.err) == (3, True), few.err


def test_a_file_that_is_not_there_is_said_before_its_size(footfit, tmp_path):
    missing = footfit("check-run", tmp_path / "nosuch", tmp_path / "other")
    assert missing.code == 3
    assert "there is no such file, folder or family" in missing.err


def test_a_step_that_is_near_to_its_tolerance_is_not_sure() -> None:
    step = RunStep("ball_girth_least", "size", "", "41", "42", "a", "b", 6.8, 5.0, 2.0, 0.4)
    assert (step.broken, step.sure) == (False, False)
    assert replace(step, sd_mm=0.1).sure
    assert step.to_dict()["sd_mm"] == 0.4
    values = {41.0: 200.0, 42.0: 205.0, 43.0: 211.8, 44.0: 216.8}
    lasts = [
        RunLast(f"{n:g}", f"{n:g}", n, None, "right", "catalogue", {GIRTH: mm}, None, {GIRTH: 0.3})
        for n, mm in values.items()
    ]
    checked = run_check(lasts, TOLERANCE_MM)
    assert len(checked.unsure) == 1
    table = terminal_text(check_run_table(checked), 200)
    assert "+6.8?" in table
    assert "1 is so near to the tolerance that it is not sure (?)" in table
