"""From files to a comparison: poses, sides, files against the catalogue, and the command."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from footfit.errors import NoSole
from footfit.geometry.fit.clearance import ZONES, zone_of
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.surface import vertex_areas, vertex_normals
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.drawables import best_comparisons
from footfit.pipeline.fit.compare import (
    best_comparison,
    compared,
    repeatability_mm,
    stored_last,
    with_surface_clearance,
)
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.scan.reading import profiled_source
from footfit.pipeline.shelf.candidates import choice
from footfit.results.heel import AS_SCANNED
from tests import answers
from tests.answers import turned
from tests.bounds import EXACT, ROUNDING
from tests.comparisons import comparison, last
from tests.scans import aligned_of
from tools.lasts import LastSpec, last_mesh

LAST = "loafer-40"


@pytest.fixture(scope="module")
def scan(foot):
    return profiled_source(Source(str(foot)), ReadingOptions())


def test_a_turned_scan_has_the_same_room(scan, stocked, tmp_path):
    aligned = scan.aligned
    vertices = aligned.vertices_mm @ turned(2.1).T + [300.0, -40.0, 90.0]
    path = tmp_path / "turned.stl"
    path.write_bytes(encoded_mesh(vertices, aligned.faces, "stl"))
    again = profiled_source(Source(str(path)), ReadingOptions())
    one, other = (compared(foot, stored_last(stocked, LAST)) for foot in (scan, again))
    for here, there in zip(one.zones, other.zones, strict=True):
        assert here.mean_mm == pytest.approx(there.mean_mm, abs=1.5e-6)  # measured 9.5e-07
        assert here.area_cm2 == pytest.approx(there.area_cm2, abs=6.6e-6)  # measured 4.3e-06
    for here, there in zip(one.sections, other.sections, strict=True):
        for a, b in zip(here.sizes, there.sizes, strict=True):
            assert (a.difference.value is None) == (b.difference.value is None)
            if a.difference.value is not None:
                # measured 7.6e-06
                assert a.difference.value == pytest.approx(b.difference.value, abs=1.2e-5)
    # measured 8.9e-07
    assert one.placement.swing_mm == pytest.approx(other.placement.swing_mm, abs=1.4e-6)


def test_the_room_in_a_wider_copy_is_what_was_added_along_the_normals():
    """To first order a wall that moves by d across gives d times the Y part of its normal."""
    spec = LastSpec(length_mm=272.0, flare_deg=8.0, rings=60, segments=48)
    vertices, faces = last_mesh(spec)
    foot = comparison().foot
    inside = replace(foot, aligned=aligned_of(foot.aligned.alignment, vertices, faces))
    wider = Shape(vertices * [1.0, 1.06, 1.0], last().shape.faces, "last")
    found = compared(inside, replace(last(), shape=wider))
    normals, areas = vertex_normals(vertices, faces), vertex_areas(vertices, faces)
    added = 0.06 * vertices[:, 1] * normals[:, 1]
    zone = zone_of(Shape(vertices, faces))
    known = np.isfinite(found.clearance_mm)
    for side in found.zones:
        here = known & (zone == ZONES.index(side.zone))
        expected = added[here] @ areas[here] / areas[here].sum()
        assert side.mean_mm == pytest.approx(expected, abs=0.25), side.zone
    for section in found.sections:
        width = section.sizes[0]
        # measured 0.044
        assert width.difference.value == pytest.approx(0.06 * width.foot.value, abs=0.066)


def test_edges_add_up_to_the_width():
    for section in comparison().sections:
        sizes = {size.name: size.difference.value for size in section.sizes}
        assert sizes["medial"] + sizes["lateral"] == pytest.approx(sizes["width"], abs=ROUNDING)
    assert repeatability_mm("height") >= repeatability_mm("width") > 0.0


def test_a_foot_in_a_last_far_too_short_is_said(stocked):
    foot = comparison().foot
    short = replace(last(), record=answers.record(length_mm=200.0))
    codes = {notice.code for notice in compared(foot, short).warnings}
    assert "far_size" in codes


def test_a_last_without_a_bottom_is_refused():
    vertices, faces = last().shape.vertices_mm, last().shape.faces
    front = faces[(vertices[faces][:, :, 0] < 60.0).all(axis=1)]
    foot = comparison().foot
    with pytest.raises(NoSole) as refused:
        compared(foot, replace(last(), shape=Shape(vertices, front, "last")))
    assert refused.value.path == foot.aligned.alignment.info.path is not None


def test_a_match_is_shown_in_its_best_last(scan, stocked):
    match = matched([scan], choice(stocked, None, None))
    best = best_comparison(stocked, match)
    shown = match.candidates or match.nearest
    assert best.last.labels.name == shown[0].last
    assert len(best_comparisons(stocked, match)) == 1
    assert best_comparison(stocked, replace(match, candidates=(), nearest=())) is None
    gone = replace(shown[0], last="no such last")
    assert best_comparison(stocked, replace(match, candidates=(gone,))) is None


# ---------------------------------------------------------------- the foot in the heel


def test_a_comparison_says_what_a_match_says(scan, stocked):
    """One number for one thing: toe room, flare, what the heel changes, and the surfaces."""
    lasts = choice(stocked, None, None)
    for heel in (heel_question(), heel_question(scanned_at_drop_mm=60.0), AS_SCANNED):
        match = matched([scan], lasts, Question(top=0, by="flare", heel=heel))
        chosen = {c.last: c for c in match.candidates if c.last in (LAST, "derby-40")}
        shown = replace(match, candidates=tuple(chosen.values()))
        for candidate in with_surface_clearance(shown, stocked).candidates:
            found = compared(scan, stored_last(stocked, candidate.last), heel)
            assert found.toe_room == dict(candidate.clearance_mm)["length"]
            assert found.flare_delta_deg == pytest.approx(candidate.flare.delta_deg, abs=EXACT)
            assert found.heel == candidate.fits[0].heel
            assert found.zones == candidate.surfaces[0].zones


def test_the_page_of_a_match_shows_the_foot_that_was_ranked(scan, stocked):
    for heel in (heel_question(), AS_SCANNED):
        match = matched([scan], choice(stocked, None, None), Question(heel=heel))
        (best,) = best_comparisons(stocked, match)
        first = (match.candidates or match.nearest)[0]
        assert best.heel == first.fits[0].heel
        assert best.toe_room == dict(first.clearance_mm)["length"]


def test_a_heel_makes_the_foot_of_a_comparison_narrower_and_its_sizes_less_sure(scan, stocked):
    last_shape = stored_last(stocked, LAST)
    labels = replace(last_shape.record.labels, heel_height_mm=80.0)
    high = replace(last_shape, record=replace(last_shape.record, labels=labels))
    raised, flat = (compared(scan, high, heel) for heel in (heel_question(), AS_SCANNED))
    for there, here in zip(raised.sections, flat.sections, strict=True):
        width, as_scanned = there.sizes[0].foot, here.sizes[0].foot
        if there.station not in ("heel", "toes"):  # the planes move along the foot a little
            shares = (1.0 - 0.016, 1.0 - 0.008)
            assert shares[0] < width.value / as_scanned.value < shares[1], there.station
        assert width.sd == pytest.approx(np.hypot(as_scanned.sd, 0.015 * width.value), abs=EXACT)
    assert raised.heel.unproven
    assert flat.heel is None
    rows = {(row["part"], row["place"], row["quantity"]): row for row in raised.rows()}
    assert rows["heel", "last", "drop"]["difference"] == 80.0
    assert rows["heel", "length", "change"]["difference"] == pytest.approx(
        -0.015 * scan.length_mm, abs=0.001
    )
    assert not [row for row in flat.rows() if row["part"] == "heel"]


# ---------------------------------------------------------------- the command


def test_the_command_writes_every_file_and_says_what_they_say(footfit, foot, stocked, tmp_path):
    names = ("heat.ply", "sections.svg", "page.html", "table.csv")
    heat, sections, page, table = (tmp_path / name for name in names)
    files = ("-o", heat, "--plot", sections, "--html", page, "--csv", table)
    run = footfit("compare", foot, LAST, "--json", "--catalogue", stocked, *files)
    assert run.code == 0, run.err
    document = run.document
    assert document["schema"] == "footfit.compare/3"
    assert document["last"] == LAST
    assert heat.read_bytes().startswith(b"ply\n")
    assert sections.read_bytes().startswith(b"<?xml")
    assert f"{document['zones']['toe']['mean_mm']:+.1f}" in page.read_text(encoding="utf-8")
    assert str(document["sections"][0]["sizes"]["width"]["difference"]["value"]) in (
        table.read_text(encoding="utf-8")
    )
    again = footfit("compare", foot, LAST, "--catalogue", stocked, "-o", heat)
    assert again.code == 2
    assert "--force" in again.err


def test_a_last_can_be_a_file(footfit, foot, stocked):
    from tests.conftest import SAMPLES

    path = SAMPLES / "lasts" / f"{LAST}.stl"
    scanned = ("--json", "--as-scanned")  # a file has no labelled heel
    by_file = footfit("compare", foot, path, *scanned).document
    by_name = footfit("compare", foot, LAST, *scanned, "--catalogue", stocked).document
    assert by_file["last"] == LAST
    for zone, figures in by_name["zones"].items():
        # the copy's corners are rounded, and the toes are bent by them; measured: 0.002
        assert by_file["zones"][zone]["mean_mm"] == pytest.approx(figures["mean_mm"], abs=0.004)


def test_labels_say_how_a_last_of_a_file_stands_and_a_stored_one_has_its_own(footfit, foot):
    from tests.conftest import SAMPLES

    path = SAMPLES / "lasts" / f"{LAST}.stl"
    labels = ("--heel-height", "40", "--platform", "5")
    found = footfit("compare", foot, path, "--json", *labels).document
    assert found["heel"]["drop_mm"] == 35.0
    assert not [each for each in found["warnings"] if each["code"] == "stance_label_unused"]
    stored = footfit("compare", foot, LAST, *labels)
    assert stored.code == 2
    assert f"footfit edit-last {LAST} --heel-height MM" in stored.err


def test_a_last_in_the_foots_place_has_its_own_heel_and_that_is_said(footfit, foot):
    from tests.conftest import SAMPLES

    path = SAMPLES / "lasts" / f"{LAST}.stl"
    drop = ("--scanned-at-drop", "20", "--json")
    for first, expected in ((path, True), (foot, False)):
        found = footfit("compare", first, path, *drop).document
        codes = {each["code"] for each in found["warnings"]}
        assert ("scanned_at_drop_unused" in codes) is expected


def test_an_unknown_last_and_a_wrong_suffix_are_refused(footfit, foot, stocked, tmp_path):
    unknown = footfit("compare", foot, "no-such-last", "--catalogue", stocked)
    assert unknown.code == 4
    wrong = footfit(
        "compare", foot, LAST, "--catalogue", stocked, "-o", tmp_path / "heat.stl", "--json"
    )
    assert wrong.code == 2
    assert json.loads(wrong.last_error)["code"] == "bad_option"
    assert not (tmp_path / "heat.stl").exists()
    assert wrong.out == ""


def test_over_the_largest_drop_no_measure_is_judged_and_the_words_say_why(footfit, foot):
    from tests.conftest import SAMPLES

    path = SAMPLES / "lasts" / f"{LAST}.stl"
    words = footfit("compare", foot, path, "--heel-height", "110").out
    assert "in mm: none is judged at so high a drop" in words
    assert "none that both have" not in words
