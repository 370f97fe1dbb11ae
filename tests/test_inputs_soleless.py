"""Feet without soles: they are measured as feet, and an end that was cut off has no length."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import footfit
from footfit.geometry.pose.facing import facing
from footfit.pipeline.scan import one_shape
from tests.conftest import SAMPLES, SCANS
from tests.distortions import leg_cut, moved, plane_cut, random_pose
from tools.lasts import LastSpec, last_mesh

FEET = {"mh007": SAMPLES / "feet" / "mh007_R.stl", "mh008": SAMPLES / "feet" / "mh008_R.stl"}
REAL = {"dupontgu": SCANS / "dupontgu_R.stl"} if SCANS.exists() else {}


@cache
def foot(name):
    """A canonical foot and its true length."""
    aligned = footfit.align({**FEET, **REAL}[name], side="right")
    return aligned.vertices_mm, aligned.faces, aligned.alignment.length_mm


def without_sole(vertices, faces, height_mm, slope=0.0):
    """A shape without what lies lower than a plane over its lowest point; it may rise forward."""
    origin = np.array([100.0, 0.0, vertices[:, 2].min() + height_mm])
    return plane_cut(vertices, faces, origin, np.array([slope, 0.0, -1.0]))


def taken(vertices, faces, seed=1):
    pose = random_pose(np.random.default_rng(seed))
    scan = footfit.read((moved(vertices, pose), faces), units="mm")
    answer = footfit.measure(scan, side="right")
    codes = {notice.code for notice in answer.alignment.warnings}
    return answer, codes, {row.name: row.measured.value for row in answer.measures}


CUTS = [(3.0, 0.0, 300.0), (8.0, 0.02, 85.0), (12.0, -0.03, 95.0), (15.0, 0.0, 300.0)]


@pytest.mark.parametrize("name", [*FEET, *REAL])
@pytest.mark.parametrize(("height_mm", "slope", "leg_mm"), CUTS)
def test_a_foot_without_its_sole_is_measured_as_a_foot_or_not_at_all(
    name, height_mm, slope, leg_mm
):
    vertices, faces, true_mm = foot(name)
    cut = leg_cut(*without_sole(vertices, faces, height_mm, slope), leg_mm - height_mm)
    answer, codes, values = taken(*cut)
    assert answer.alignment.pose.kind == "foot"
    assert values["heel_height"] is None
    assert values["instep_girth"] is None or height_mm < 5.0  # a low cut leaves some of the sole
    if values["length"] is None:
        assert "open_end" in codes
        return
    # The frame is the rim's: the length moved by at most 0.7 mm.
    assert values["length"] == pytest.approx(true_mm, abs=1.2)
    assert 0.69 <= values["ball_length"] / values["length"] <= 0.80


@pytest.mark.parametrize("name", [*FEET, *REAL])
@pytest.mark.parametrize(("height_mm", "slope"), [(22.0, 0.0), (10.0, 0.07), (12.0, -0.3)])
def test_an_end_that_went_with_the_sole_has_no_length(name, height_mm, slope):
    """The toes lie up to 20 mm high, the heel's rearmost point up to 35 mm."""
    vertices, faces, _ = foot(name)
    cut = without_sole(vertices, faces, height_mm, slope)
    answer, codes, values = taken(*cut)
    assert answer.alignment.pose.kind == "foot"
    assert "open_end" in codes
    assert values["length"] is None
    assert values["ball_length"] is None


@pytest.mark.parametrize("heel_mm", [10.0, 40.0])
def test_a_last_without_its_bottom_stays_a_last(heel_mm):
    vertices, faces = last_mesh(LastSpec(heel_height_mm=heel_mm))
    answer, _, _ = taken(*without_sole(vertices, faces, 12.0))
    assert answer.alignment.pose.kind == "last"


def test_a_sole_is_not_looked_for_only_where_the_faces_look_up_on_the_whole():
    """Without its top a last is as open, but its faces look down; whole, they look nowhere."""
    vertices, faces = last_mesh(LastSpec())
    lengths_mm = ((200.0, 310.0),)

    def pose(shape):
        return one_shape._pose_without_sole(*shape, lengths_mm, facing(*shape))

    assert pose(without_sole(vertices, faces, 8.0)).kind == "last"
    low = np.array([0.0, 0.0, vertices[:, 2].min() + 30.0])
    assert pose(plane_cut(vertices, faces, low, np.array([0.0, 0.0, 1.0]))) is None
    assert pose((vertices, faces)) is None
