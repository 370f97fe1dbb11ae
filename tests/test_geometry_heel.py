"""The heel has its length and its width, however the shank leans over it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import footfit
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.widths import heel_width
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.mesh.topology import boundary_loops
from tests.conftest import SAMPLES, SCANS
from tests.distortions import leg_cut, subdivided, white_noise
from tools.lasts import LastSpec, last_mesh

FEET = {name: SAMPLES / "feet" / f"{name}_R.stl" for name in ("mh007", "mh008")}
MORE = {"mh009": SCANS / "makehuman" / "mh009_R.stl", "dupontgu": SCANS / "dupontgu_R.stl"}
FEET |= MORE if SCANS.exists() else {}
SD_MM = 0.25  # of the length


@cache
def foot(name):
    aligned = footfit.align(FEET[name], side="right")
    return aligned.vertices_mm, aligned.faces, aligned.alignment.length_mm


def leaning(name, start, slope):
    """The foot with all that is over ``start`` times its length sheared backward, smoothly."""
    vertices, faces, length_mm = foot(name)
    over = np.maximum(vertices[:, 2] / length_mm - start, 0.0)
    back = np.where(over < 0.04, np.square(over) / 0.08, over - 0.02)
    return vertices - np.outer(slope * length_mm * back, [1.0, 0.0, 0.0]), faces


@pytest.mark.parametrize("name", FEET)
@pytest.mark.parametrize("start", [0.17, 0.20, 0.24])
@pytest.mark.parametrize("slope", [0.3, 0.6, 1.0])
def test_a_leaning_shank_does_not_move_the_length_by_more_than_its_sd(name, start, slope):
    """As it was, the length grew by up to 31 mm."""
    length_mm = Shape(*leaning(name, start, slope)).length_mm
    assert length_mm == pytest.approx(Shape(*foot(name)[:2]).length_mm, abs=SD_MM)


@pytest.mark.parametrize("change", ["noise", "finer", "cut low", "cut high"])
def test_a_leaning_shank_that_is_scanned_otherwise_has_the_length_too(change):
    vertices, faces = leaning("mh008", 0.20, 0.8)
    changed = {
        "noise": lambda: (white_noise(vertices, np.random.default_rng(2), 0.3), faces),
        "finer": lambda: subdivided(vertices, faces),
        "cut low": lambda: leg_cut(vertices, faces, 0.26 * 271.6),
        "cut high": lambda: leg_cut(vertices, faces, 0.34 * 271.6),
    }[change]()
    most_mm = 2 * SD_MM if change == "noise" else SD_MM
    assert Shape(*changed).length_mm == pytest.approx(foot("mh008")[2], abs=most_mm)


@pytest.mark.parametrize("name", FEET)
def test_a_foot_whose_shank_does_not_lean_is_measured_as_before(name):
    vertices, faces, _ = foot(name)
    shape = Shape(vertices, faces)
    back = np.array([-1.0, 0.0, 0.0])
    before = tip(vertices, shape.low, back, shape._rough_length_mm, shape.tips)
    assert shape.ends[0].reach == pytest.approx(before.reach, abs=0.1)


@pytest.mark.parametrize("heel_mm", [0.0, 60.0])
def test_a_lasts_rear_may_be_anywhere_on_its_back(heel_mm):
    vertices, faces = last_mesh(LastSpec(heel_height_mm=heel_mm))
    shape = Shape(vertices, faces, "last")
    back = np.array([-1.0, 0.0, 0.0])
    before = tip(vertices, shape.low, back, shape._rough_length_mm, shape.tips)
    assert shape.ends[0].reach == before.reach


def test_the_whole_way_from_a_scan_gives_the_heels_length():
    true_mm = foot("mh007")[2]
    scan = footfit.read(leaning("mh007", 0.20, 0.8), units="mm")
    answer = footfit.measure(scan, side="right")
    assert answer.alignment.length_mm == pytest.approx(true_mm, abs=SD_MM)
    assert answer.alignment.extent_mm > true_mm + 5.0


@pytest.mark.parametrize("name", FEET)
def test_a_leaning_shank_does_not_turn_the_flare(name):
    """As it was, the centre line began in the calf: the angle lost up to 5 degrees."""
    angles_deg = [
        footfit.flare(footfit.read(mesh, units="mm"), side="right").flare.angle_deg
        for mesh in (foot(name)[:2], leaning(name, 0.20, 1.0))
    ]
    assert angles_deg[1] == pytest.approx(angles_deg[0], abs=0.05)  # measured 0.01


@pytest.mark.parametrize("back_mm", [0.0, 25.0, 50.0])
def test_the_heel_has_its_width_under_a_shank_of_long_facets(back_mm):
    """The facets over the heel were taken for a filled hole, and the width was missing."""
    vertices, faces, length_mm = foot("mh008")
    low, kept = leg_cut(vertices, faces, 0.28 * length_mm)
    rim = max(boundary_loops(kept), key=len)
    top = low[rim] + [-back_mm, 0.0, 90.0]
    upper = len(low) + np.arange(len(rim))
    walls = np.column_stack([np.roll(rim, -1), rim, upper])
    others = np.column_stack([np.roll(rim, -1), upper, np.roll(upper, -1)])
    shank = Shape(np.concatenate([low, top]), np.concatenate([kept, walls, others]))
    value = heel_width(shank)
    assert value.value == pytest.approx(heel_width(Shape(vertices, faces)).value, abs=0.2)
