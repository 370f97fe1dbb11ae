"""Custom lasts: targets are met on the written file, what a last maker keeps stays."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import footfit
from footfit.errors import OutOfReach
from footfit.geometry.deform.chart import chart_of
from footfit.geometry.deform.field import Field
from footfit.geometry.deform.solver import Solution
from footfit.geometry.measures.landmarks import Shape
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.last_making.custom import custom_making
from footfit.pipeline.last_making.custom.custom_aims import (
    CustomAim,
    CustomQuestion,
    good_range,
)
from footfit.pipeline.last_making.custom.custom_field import CustomShape, refuse_missed
from footfit.pipeline.last_making.custom.good_zones import with_reasons, zone_notices
from footfit.report.page.custom_page import custom_page
from footfit.report.terminal.custom_tables import custom_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import BetterInStock, JudgedZone
from footfit.results.last_making.custom_last import ROOM_WHY
from footfit.results.worn import BAREFOOT
from tests import shapes
from tests.conftest import ROOT, SAMPLES, Footfit
from tests.custom_judge import (
    girth_misses,
    kept_moves,
    least_misses,
    mesh_changes,
    zones_not_good,
)
from tests.customs import custom_last
from tests.distortions import random_pose
from tests.self_intersection import self_intersections
from tools.lasts import LastSpec, last_mesh

FOOT = ROOT / "sample_data" / "feet" / "mh007_R.stl"
WALKING = ROOT / "footfit" / "pipeline" / "fit" / "profiles" / "walking.toml"
CLOSE_MM = 0.5
"""The bar for girths and widths on the written file, by a judge of its own."""


@cache
def base(heel_mm: float = 20.0, **given: float):
    """A last that fits the foot nearly: vertices and faces."""
    spec = LastSpec(
        length_mm=266.0,
        ball_width_mm=92.0,
        heel_width_mm=62.0,
        heel_height_mm=heel_mm,
        level_tread=True,
        rings=110,
        segments=80,
        **given,
    )
    return last_mesh(spec)


@cache
def foot():
    return footfit.flare(str(FOOT))


@cache
def custom(**asked):
    (made,) = footfit.customise(foot(), base(), **asked)
    return made


def values(made) -> np.ndarray:
    return np.array([(zone.base, zone.target, zone.reached) for zone in made.zones])


def test_the_written_file_meets_its_targets() -> None:
    made = custom()
    data = footfit.mesh_file(made, "stl")
    document = json.loads(json.dumps(made.to_dict()))
    names = [zone["name"] for zone in document["zones"]]
    spreads = [zone[f"{of}_sd"] for zone in document["zones"] for of in ("base", "reached")]
    assert all(0.0 < sd < 2.0 for sd in spreads)  # of a second scan, in mm
    assert document["judged"][0]["custom_sd"] > 0.0
    assert names[0] == "length"
    assert {"ball_girth_least", "waist_girth_least", "instep_girth_least", "ball_width"} <= {*names}
    misses = girth_misses(data, document)
    assert len(misses) == 4
    assert max(map(abs, misses.values())) < CLOSE_MM
    assert max(map(abs, least_misses(data, document).values())) < CLOSE_MM
    profile = tomllib.loads(WALKING.read_text(encoding="utf-8"))
    assert zones_not_good(data, document, profile) == []
    tight = [zone | {"foot": zone["foot"] and zone["foot"] + 12.0} for zone in document["zones"]]
    assert len(zones_not_good(data, document | {"zones": tight}, profile)) == 5
    again = footfit.measure(data, units="mm", side="right")
    measured = {row.name: row.measured.value for row in again.measures}
    for zone in document["zones"]:
        assert measured[zone["name"]] == pytest.approx(zone["reached"], abs=0.3), zone["name"]
    moved = np.abs(values(made)[:, 2] - values(made)[:, 0])
    assert moved.max() > 3.0  # the base was not right before


def test_the_mesh_stays_sound_and_what_is_kept_stays() -> None:
    made = custom()
    changes = mesh_changes(made.base_vertices_mm, made.vertices_mm, made.faces)
    assert changes["flipped"] == changes["intersections"] == 0.0
    assert changes["aspect"] < 2.0
    assert changes["dihedral_deg"] < 2.0
    kept = {part.name: part.moved_mm for part in made.kept}
    assert set(kept) >= {"bottom heights", "heel height", "toe spring", "toe shape", "top plane"}
    assert max(kept.values()) < 0.1
    assert made.least_determinant > 0.3


def test_the_judge_of_intersections_sees_one() -> None:
    vertices, faces = shapes.sphere(50.0, 2)
    assert self_intersections(vertices, faces) == 0
    both = np.concatenate([vertices, vertices + np.array([30.0, 1.0, 2.0])])
    assert self_intersections(both, np.concatenate([faces, faces + len(vertices)])) > 10


def test_a_custom_last_needs_no_other_one() -> None:
    """Targets that are nearly the base's own move nearly nothing."""
    made = custom()
    data = footfit.mesh_file(made, "stl")
    (again,) = footfit.customise(foot(), data)
    assert again.largest_move_mm < 1.0  # the instep gives way anew: its target moves by 0.3 mm
    by_mm = np.abs(values(again)[:, 2] - values(made)[:, 2])
    of_instep = np.array(["instep" in zone.name for zone in made.zones])
    assert by_mm[~of_instep].max() < 0.3
    assert by_mm[of_instep].max() < 0.7


def test_a_mirrored_foot_gives_the_mirrored_last() -> None:
    mirror = np.array([-1.0, 1.0, 1.0])
    scan = footfit.read(str(FOOT))
    left = footfit.flare((scan.vertices_mm * mirror, scan.faces[:, ::-1]), units="mm")
    (made,) = footfit.customise(left, base())
    assert made.side == "left"
    np.testing.assert_allclose(made.vertices_mm, custom().vertices_mm * [1.0, -1.0, 1.0], atol=0.05)
    own, other = footfit.customise(foot(), base(), both=True)
    assert (own.side, other.side, other.mirrored) == ("right", "left", True)
    np.testing.assert_allclose(other.vertices_mm, own.vertices_mm * [1.0, -1.0, 1.0], atol=1e-9)
    assert max(
        map(abs, girth_misses(footfit.mesh_file(other, "stl"), other.to_dict()).values())
    ) < (CLOSE_MM)


def test_the_pose_of_the_base_does_not_matter() -> None:
    vertices, faces = base()
    turn = random_pose(np.random.default_rng(5))
    moved = vertices @ turn[:3, :3].T + turn[:3, 3]
    (made,) = footfit.customise(foot(), (moved, faces))
    np.testing.assert_allclose(values(made), values(custom()), atol=0.1)


def test_room_keep_bottom_and_flare() -> None:
    made = custom(keep_bottom=True, flare_follow=0.5)
    before, after = made.base_vertices_mm, made.vertices_mm
    assert 0.0 < abs(made.flare_turn_deg) <= 6.0
    assert mesh_changes(before, after, made.faces)["dihedral_deg"] < 4.0
    assert not any(zone.name.endswith("width") for zone in made.zones)
    (roomy,) = footfit.customise(foot(), base(), room_mm={"ball-medial": 4.0})
    by_name = {zone.name: zone for zone in roomy.zones}
    assert by_name["ball_girth_least"].room > 1.0
    assert abs(by_name["instep_girth_least"].room) < 0.1
    gap = roomy.vertices_mm - custom().vertices_mm
    assert gap[:, 1].max() == pytest.approx(4.0, abs=0.3)
    off = [abs(zone.reached - zone.target) for zone in made.zones if not zone.follows]
    assert max(off) < 0.3


def test_targets_are_met_with_a_turned_flare_and_room_comes_on_top() -> None:
    """A turned flare moves the joints and the frame, so it is turned in steps."""
    for follow in (1.0, 0.6):
        made = custom(flare_follow=follow)
        off = [abs(zone.reached - zone.target) for zone in made.zones if not zone.follows]
        assert max(off) < 0.3
    (roomy,) = footfit.customise(foot(), base(), flare_follow=0.6, room_mm={"ball-medial": 4.0})
    gap = np.linalg.norm(roomy.vertices_mm - made.vertices_mm, axis=1)
    assert gap.max() == pytest.approx(4.0, abs=0.1)
    width = next(zone for zone in roomy.zones if zone.name == "ball_width")
    assert 2.4 < width.room < 4.5  # the joints lie askew, and the forepart is turned by 4 degrees


@pytest.mark.parametrize(
    ("place", "size_mm", "girth"),
    [
        ("instep-top", 6.0, "instep_girth_least"),
        ("waist-medial", 3.0, "waist_girth_least"),
        ("waist-lateral", 1.5, "waist_girth_least"),
        ("heel-lateral", 6.0, "heel_width"),
    ],
)
def test_room_swells_as_far_as_is_asked_at_the_place_of_its_name(place, size_mm, girth) -> None:
    (roomy,) = footfit.customise(foot(), base(), room_mm={place: size_mm})
    swelling = np.linalg.norm(roomy.vertices_mm - custom().vertices_mm, axis=1)
    assert swelling.max() == pytest.approx(size_mm, abs=0.1)  # what issue 13 asks for
    (room,) = roomy.rooms
    assert (room.name, room.asked_mm) == (place, size_mm)
    assert room.reached_mm == pytest.approx(swelling.max(), abs=0.001)
    grown = {zone.name: zone.room for zone in roomy.zones}
    assert max(grown, key=lambda name: grown[name]) == girth
    assert grown[girth] > 0.5 * size_mm
    assert {part.name: part.moved_mm for part in roomy.kept}["top plane"] == 0.0
    assert f"{size_mm:.1f} mm asked" in terminal_text(custom_table(roomy), 100)
    assert f"{size_mm:.1f} mm asked" in custom_page(roomy)


def test_a_zone_that_is_not_good_is_named_with_its_reason() -> None:
    zones = [
        JudgedZone("length", "toe room", "mm", 14.0, 14.0, "good", 14.0, "good"),
        JudgedZone("toes", "toes", "mm", -1.0, -3.0, "good", -5.0, "acceptable"),
        JudgedZone("flare", "flare", "deg", 0.0, -12.0, "acceptable", -12.0, "acceptable"),
        JudgedZone("heel_width", "heel width", "mm", -2.0, 3.0, "poor", 3.0, "poor"),
    ]
    asked = CustomQuestion(fit_profile("walking"), heel_question(), BAREFOOT)
    (notice,) = zone_notices(with_reasons(zones, asked), ())
    assert notice.message.startswith("not good in toes (the toe keeps its shape, and another ")
    assert "--flare-follow" in notice.message
    (kept,) = zone_notices(with_reasons(zones[3:], replace(asked, bottom_kept=True)), ())
    assert "--keep bottom" in kept.message
    assert with_reasons(zones, asked)[1].to_dict()["why"].startswith("the toe keeps its shape")
    assert zone_notices(with_reasons(zones[:1], asked), ()) == ()


def test_a_moved_target_is_named() -> None:
    aim = CustomAim("instep_girth_least", "instep_girth", 250.0, 252.0, 250.0, 2.0)
    moved = aim.moved_to(248.4)
    assert (moved.target, moved.allowance, moved.moved_mm) == pytest.approx((248.4, -1.6, -3.6))
    assert moved.moved_to(252.0).moved_mm == pytest.approx(0.0)
    (notice,) = zone_notices((), [moved])
    assert notice.code == "target_moved"
    assert "-3.6 mm" in notice.message
    width = CustomAim("ball_width", "ball_width", 90.0, 91.0, 90.0, 1.0)
    assert width.moved_to(95.0) == width


def test_a_good_range_is_that_of_the_zone() -> None:
    """Walking: an instep is good from -2 to 6 mm, and .95 of that is -1.8 to 5.8 mm."""
    (rule,) = (rule for rule in fit_profile("walking").zones if rule.zone == "instep_girth")
    assert good_range(252.0, rule) == pytest.approx((248.2, 255.8))


def test_the_upright_girth_of_the_instep_is_good_too() -> None:
    """By the least tape alone it is 7.2 mm too large on this last, and good up to 6.

    A match judges the upright girth, so the least tape gives way within the good range.
    """
    made = custom()
    instep = next(zone for zone in made.judged if zone.name == "instep_girth")
    assert (instep.base_verdict, instep.custom_verdict) == ("poor", "good")
    moved = next(zone for zone in made.zones if zone.name == "instep_girth_least")
    assert -1.8 <= moved.allowance < 2.0
    assert abs(moved.reached - moved.target) < CLOSE_MM
    assert any(notice.code == "target_moved" for notice in made.warnings)


def test_the_toe_room_leaves_its_target_if_the_toe_box_needs_it(monkeypatch) -> None:
    """With a toe room of 14 mm a toe stands 8 mm through an almond toe's wall, which is poor."""
    (made,) = footfit.customise(foot(), base(toe_shape="almond"))
    room, toes = (zone_of(made, name) for name in ("length", "toes"))
    assert (room.custom_verdict, toes.custom_verdict) == ("good", "acceptable")
    (notice,) = (notice for notice in made.warnings if notice.code == "toe_room_moved")
    said_mm = float(notice.message.split("aims at ")[1].split(" mm")[0])
    assert room.custom is not None
    assert said_mm > 3.0
    assert room.custom == pytest.approx(room.target + said_mm, abs=0.1)  # a half of it is rounding
    monkeypatch.setattr(custom_making, "toe_box_plans", lambda *_: iter(()))
    (kept,) = footfit.customise(foot(), base(toe_shape="almond"))
    assert zone_of(kept, "length").custom == pytest.approx(14.0, abs=0.2)
    assert zone_of(kept, "toes").custom_verdict == "poor"


def zone_of(made, name: str) -> JudgedZone:
    return next(zone for zone in made.judged if zone.name == name)


def test_the_short_heel_girth_becomes_good_within_reach() -> None:
    """It may lie up to 8 mm outside of its good range, which ends at 3 mm."""
    (made,) = footfit.customise(foot(), base(cone_length=0.315))
    heel = zone_of(made, "short_heel_girth")
    assert heel.base_verdict == "acceptable"
    assert heel.custom_verdict == "good"
    assert {part.name: part.moved_mm for part in made.kept}["back curve"] < 0.1  # bar .6


def test_the_ball_line_of_a_customer_stays_good() -> None:
    """It was 2.2 % too far forward when the forepart was not pressed."""
    last = ROOT / "sample_data" / "lasts" / "derby-43.stl"
    (made,) = footfit.customise(str(FOOT.with_name("mh008_R.stl")), str(last))
    assert made.verdict == "good"
    assert not made.warnings


def test_a_miss_is_refused_and_names_the_measure() -> None:
    made = custom()
    aims = [CustomAim("length", "length", 260.0, 262.0), CustomAim("waist_girth", "", 230.0, 226.0)]
    shape = changed_shape(made)
    refuse_missed(aims, np.array([0.29, -0.49]), shape, 0.0)
    with pytest.raises(OutOfReach, match=r"length .* nearest is 262\.3 mm, not 262\.0 mm"):
        refuse_missed(aims, np.array([0.31, 0.49]), shape, 0.0)
    with pytest.raises(OutOfReach, match=r"waist girth .* with the flare turned by 3\.0 deg"):
        refuse_missed(aims, np.array([0.0, 0.51]), shape, 3.0)


def changed_shape(made) -> CustomShape:
    """A shape within all limits."""
    chart = chart_of(Shape(*base(), "last"))
    solved = Solution(Field.still(chart), (), made.vertices_mm, np.zeros(2), np.zeros(2), 0)
    return CustomShape((), solved, made.vertices_mm, 1.0, (1.0, 1.0))


def test_the_judge_of_what_is_kept_sees_what_moved() -> None:
    """A last that is raised at its toe, and swollen behind, by 1 mm."""
    vertices, faces = base()
    up = np.array([0.0, 0.0, 1.0])
    still = kept_moves(vertices, vertices, faces, up)
    assert max(still.values()) < 1e-9
    share = (vertices[:, 0] - vertices[:, 0].min()) / np.ptp(vertices[:, 0])
    raised = vertices + (share > 0.95)[:, None] * up
    assert kept_moves(vertices, raised, faces, up)["toe spring"] == pytest.approx(1.0, abs=0.01)
    swollen = vertices - (share < 0.1)[:, None] * np.array([1.0, 0.0, 0.0])
    assert kept_moves(vertices, swollen, faces, up)["back curve"] == pytest.approx(1.0, abs=0.1)
    lifted = vertices + 1.0 * (vertices[:, 2] > 0.6 * vertices[:, 2].max())[:, None] * up
    assert kept_moves(vertices, lifted, faces, up)["top plane"] == pytest.approx(1.0, abs=0.01)


def test_the_file_is_written_though_nobody_reads_the_answer(tmp_path) -> None:
    file, output = tmp_path / "derby.stl", tmp_path / "anna.stl"
    file.write_bytes(encoded_mesh(*base(), "stl"))
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "footfit", "customise", FOOT, "--base", file, "-o", output]
    catalogue = ["--catalogue", tmp_path / "none.footfit"]
    run = subprocess.run([*command, *catalogue], stdout=writer, stderr=subprocess.PIPE, check=False)
    os.close(writer)
    assert run.returncode == 0
    assert output.stat().st_size > 0


def test_no_output_takes_the_place_of_a_foot_or_the_base(footfit: Footfit, tmp_path) -> None:
    feet = [tmp_path / f"ann-{side}.stl" for side in ("left", "right")]
    data = FOOT.read_bytes()
    for path in feet:
        path.write_bytes(data)
    last = tmp_path / "base.stl"
    last.write_bytes(data)
    for written in ("ann.stl", "ann-left.stl", "base.stl"):
        given = feet if written == "ann.stl" else feet[:1]
        run = footfit(
            "customise", *given, "--base", last, "-o", tmp_path / written, "--force"
        )  # refused before a mesh is read
        assert (run.code, "name another file" in run.err) == (2, True), run.err
    assert all(path.read_bytes() == data for path in (*feet, last))


def test_a_base_that_is_too_far_is_refused(footfit: Footfit, tmp_path) -> None:
    small = tmp_path / "small.stl"
    small.write_bytes(encoded_mesh(*last_mesh(LastSpec(length_mm=225.0, rings=80)), "stl"))
    output = tmp_path / "custom.stl"
    run = footfit("customise", FOOT, "--base", small, "-o", output)
    assert run.code == 5
    assert "the length is out of reach" in run.err
    assert not output.exists()


def test_a_base_is_refused_by_its_file_and_the_same_foot_is_not_taken_twice(
    footfit: Footfit, tmp_path
) -> None:
    output = tmp_path / "custom.stl"
    twice = footfit("customise", FOOT, FOOT, "-o", output)
    assert (twice.code, "is given twice" in twice.err) == (2, True), twice.err
    for name in ("bad/name", "two\nlines"):
        odd = footfit("customise", FOOT, "--store", name, "-o", output)
        assert (odd.code, "cannot be the name of a last: give one without" in odd.err) == (
            2,
            True,
        ), odd.err
    missing = footfit("customise", FOOT, "--base", "nothing.stl", "-o", output)
    assert (missing.code, "no such file" in missing.err) == (3, True), missing.err
    small = tmp_path / "small.stl"
    small.write_bytes(encoded_mesh(*last_mesh(LastSpec(length_mm=225.0, rings=80)), "stl"))
    refused = footfit("customise", FOOT, "--base", small, "-o", output, "--json")
    error = json.loads(refused.last_error)
    assert error["path"] == str(small)
    assert re.search(r"must go from \S+ to \S+ mm, by \S+ mm, and at most", error["message"])
    assert list(tmp_path.iterdir()) == [small]


def test_a_last_in_place_of_a_foot_is_refused(footfit: Footfit, tmp_path) -> None:
    last, output = SAMPLES / "lasts" / "derby-40.stl", tmp_path / "custom.stl"
    run = footfit("customise", last, "--base", last, "-o", output, "--json")
    assert run.code == 5
    assert json.loads(run.last_error)["code"] == "other_kind"
    assert not output.exists()


def test_the_command_writes_stores_and_draws(footfit: Footfit, tmp_path) -> None:
    file = tmp_path / "derby.stl"
    file.write_bytes(encoded_mesh(*base(), "stl"))
    catalogue = tmp_path / "lasts.footfit"
    at = ("--catalogue", catalogue)
    full = ("--keep-mesh", "full", "--family", "derby")
    assert footfit("ingest-last", file, *at, *full).code == 0
    output, page = tmp_path / "anna.stl", tmp_path / "anna.html"
    asked = ("customise", FOOT, "-o", output, "--store", "anna", *at)
    run = footfit(*asked, "--html", page, "--json")
    assert run.code == 0
    document = run.document
    assert (document["base"], document["stored_as"]) == ("derby", "anna")
    stored = replace(custom_last(), stored_as="anna")
    assert terminal_text(custom_table(stored), 100).rstrip().endswith("stored as anna")
    assert "stored as" not in terminal_text(custom_table(custom_last()), 100)
    assert document["output"] == str(output)
    assert document["base_mesh"]["kind"] == "full copy"
    assert max(map(abs, girth_misses(output.read_bytes(), document).values())) < CLOSE_MM
    assert "anna" in page.read_text(encoding="utf-8")
    shown = footfit("show-last", "anna", *at, "--json").document
    assert shown["parent"] == shown["parentage"]["base"] == "derby"
    assert shown["family"] is None  # it has no size, and would stop check-run derby
    first = footfit("match", FOOT, *at, "--json").document["candidates"][0]
    assert first["last"] == "anna" or "anna" in first["tied_with"]
    assert footfit(*asked).code == 2  # the file is there
    again = footfit("customise", FOOT, "-o", tmp_path / "bob.stl", *at, "--json").document
    assert again["base"] == "derby"  # not anna, which was made for a customer
    for wrong in (["--room", "nose=3"], ["--room", "nose"], ["--flare-follow", "2"]):
        assert footfit(*asked, "--force", *wrong).code == 2


def test_the_table_and_the_page_say_what_was_made() -> None:
    made = custom_last()
    table = terminal_text(custom_table(made), 100)
    assert "derby-42" in table
    assert "follows" in table
    assert "is acceptable for this foot, because of toes" in table
    page = custom_page(made)
    for words in (table, page):
        assert "least ball girth" in words
        assert "allow" in words
        assert "224.5" in words  # the foot's own girth
        assert "least: the shortest tape around the place" in " ".join(words.split())
    assert page == custom_page(made)


def test_the_targets_add_up_with_the_room_that_was_asked_for() -> None:
    made = custom_last()
    length, girth, heel = made.zones
    plain_page = custom_page(made)
    assert "<th>room mm</th>" not in plain_page
    roomy = replace(made, zones=(length, replace(girth, room=4.0, target=228.5), heel))
    page = custom_page(roomy)
    assert "<th>allowance mm</th><th>room mm</th><th>base mm</th>" in page
    row = next(line for line in page.splitlines() if "<td>least ball girth</td>" in line)
    cells = re.findall(r"<td>([^<]*)</td>", row)
    foot_mm, allowance_mm, room_mm, _, target_mm = map(float, cells[1:6])
    assert (room_mm, target_mm) == (4.0, 228.5)
    assert foot_mm + allowance_mm + room_mm == pytest.approx(target_mm)
    heads, rows = page.count("<th>room mm</th>"), page.split("<tbody>")[1].split("</tbody>")[0]
    assert (heads, rows.count("<td>")) == (1, 8 * len(made.zones))
    assert "allow + what --room adds" in " ".join(terminal_text(custom_table(roomy), 100).split())


def test_the_rows_have_each_measure_with_the_numbers_of_the_document() -> None:
    made = replace(custom_last(), output="own.stl")
    table, zones = made.rows(), made.to_dict()["zones"]
    assert [row["measure"] for row in table] == [zone["name"] for zone in zones]
    for row, zone in zip(table, zones, strict=True):
        assert tuple(row) == made.columns
        assert (row["last"], row["side"], row["output"]) == (
            *(made.record.labels.name, "right", "own.stl"),
        )
        assert {name: row[name] for name in zone.keys() & row.keys()} == {
            name: zone[name] for name in zone if name not in ("name", "plane")
        }


@pytest.mark.parametrize("verdict", ["poor", "reject"])
def test_a_last_that_does_not_fit_says_what_that_means_and_what_to_do(verdict) -> None:
    made = custom_last()
    upright = replace(made.judged[0], name="ball_girth", label="ball girth")
    bad = replace(made.judged[1], label="ball line", custom_verdict=verdict, why="it is kept")
    last = replace(made, judged=(upright, bad))
    table, page = " ".join(terminal_text(custom_table(last), 100).split()), custom_page(last)
    meaning = {"poor": "let the customer try one on first", "reject": "Do not make a shoe on it"}
    for words in (table, page):
        assert f"({verdict}), because of ball line" in words
        assert meaning[verdict] in words
        assert "footfit match lists lasts, and --base names one" in words
        assert "upright ball" in words
    stock = replace(last, better_in_stock=BetterInStock("derby-43", "good", verdict))
    assert "Use derby-43 of the catalogue, or choose" in custom_page(stock)
    roomy = replace(last, judged=(replace(bad, why=ROOM_WHY),))
    mixed = replace(roomy, judged=(*roomy.judged, bad))
    for words in (terminal_text(custom_table(roomy), 400), custom_page(roomy)):
        assert "ball line: this is the room that was asked for, and not a fault" in words
        assert meaning[verdict] not in words
    assert meaning[verdict] in custom_page(mixed)  # another zone is bad without the room too
    fine = replace(last, judged=(replace(bad, custom_verdict="acceptable"),))
    assert "Make it from another" not in custom_page(fine)


def test_the_worked_example_says_what_comes_out() -> None:
    """docs/custom-lasts.md tells the measures of a custom last of the samples."""
    page = (ROOT / "docs/custom-lasts.md").read_text(encoding="utf-8")
    words = page.split("The foot is narrower", 1)[1].split("Every zone", 1)[0]
    told = [float(number) for number in re.findall(r"\d+\.\d", words)]
    (made,) = footfit.customise(
        str(SAMPLES / "feet/mh008_R.stl"), str(SAMPLES / "lasts/derby-43.stl")
    )
    zones = {zone.name: zone for zone in made.zones}
    names = ("ball_girth_least", "waist_girth_least", "ball_width", "heel_width")
    girths = [zones[name] for name in (*names, "instep_girth_least")]
    room = next(zone for zone in made.judged if zone.name == "length")
    own = [value for zone in girths for value in (zone.base, zone.reached)]
    own += [zones["length"].base - zones["length"].reached, room.base, room.custom]
    np.testing.assert_allclose(told, own, atol=0.1)
    assert {zone.custom_verdict for zone in made.judged} == {"good"}
