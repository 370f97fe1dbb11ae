"""Measures: formulas on boxes, planted widths of lasts, laws."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.measures import MEASURES, ball_width, heel_width, length
from footfit.meshes.read import read_scan
from footfit.pipeline.align import aligned
from footfit.pipeline.flare import profiled
from tests import distortions, shapes
from tools.lasts import LastSpec, half_width_mm, last_mesh

SCANS = Path(__file__).resolve().parents[2] / "shared" / "scans" / "makehuman"


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(flare_deg=0.0, rings=90, segments=64))


def box():
    vertices, faces = shapes.cube(1.0, 4)
    vertices = vertices - vertices.min(axis=0)
    return vertices * [260.0, 90.0, 60.0], faces


def test_a_box_measures_its_sides():
    assert length(*box()).value == pytest.approx(260.0)
    assert ball_width(*box()).value == pytest.approx(90.0)
    assert heel_width(*box()).value == pytest.approx(90.0)


def test_a_leg_does_not_lengthen(last):
    vertices, faces = last
    leg, leg_faces = shapes.cylinder(45.0, 300.0)
    leg = leg - leg.min(axis=0) + [-30.0, -45.0, 90.0]
    both = distortions.joined((vertices, faces), (leg, leg_faces))
    assert length(*both).value == pytest.approx(length(vertices, faces).value)


def test_a_lasts_widths_are_the_planted_ones(last):
    spec = LastSpec(flare_deg=0.0, rings=90, segments=64)
    widths = 2.0 * half_width_mm(spec, np.linspace(0.5, 0.9, 81))
    # the ball's two sides are not widest at one station: the tangents stand a little further apart
    assert widths.max() - 0.1 < ball_width(*last).value < widths.max() + 2.5
    at_heel = 2.0 * half_width_mm(spec, np.array([1.0 / 6.0]))[0]
    assert heel_width(*last).value == pytest.approx(at_heel, abs=0.3)


@settings(max_examples=10, deadline=None)
@given(power=st.floats(-0.5, 0.5))
def test_measures_scale_with_the_shape(last, power):
    vertices, faces = last
    scale = 10.0**power
    for entry in MEASURES:
        before = entry.reading(vertices, faces).value
        assert entry.reading(vertices * scale, faces).value == pytest.approx(before * scale)


def test_measures_do_not_see_subdivision(last):
    vertices, faces = last
    finer = distortions.half_subdivided(vertices, faces)
    for entry in MEASURES:
        assert entry.reading(*finer).value == pytest.approx(entry.reading(vertices, faces).value)


def test_a_gap_gives_a_reason_and_no_number(last):
    vertices, faces = last
    x = vertices[faces, 0].mean(axis=1)
    for measure, low, high in ((ball_width, 160, 200), (heel_width, 35, 60)):
        reading = measure(vertices, faces[(x < low) | (x > high)])
        assert reading.value is None
        assert "gap" in reading.reason


def test_the_table_is_in_order():
    names = [entry.name for entry in MEASURES]
    assert len(set(names)) == len(names)
    assert names[0] == "length"
    for entry in MEASURES:
        assert entry.unit == "mm"
        assert entry.sd > 0.0
        assert entry.definition


@pytest.mark.skipif(not SCANS.exists(), reason="the scans beside the project are not here")
def test_generated_feet_measure_as_their_truth_in_random_poses():
    rng = np.random.default_rng(5)
    with (SCANS / "truth.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[::4]
    errors = []
    for row in rows:
        scan = read_scan(SCANS / row["file"])
        posed = distortions.moved(scan.vertices_mm, distortions.random_pose(rng))
        moved = type(scan)(**{**fields(scan), "vertices_mm": posed})
        found = {m.name: m.measured.value for m in profiled(aligned(moved)).measures}
        errors.append([found[n] - float(row[n]) for n in ("length", "ball_width")])
    assert np.abs(errors).mean(axis=0)[0] < 1.0
    assert np.abs(errors).mean(axis=0)[1] < 1.5


def fields(scan):
    return {name: getattr(scan, name) for name in scan.__dataclass_fields__}
