"""The canonical frame: laws it must obey, and the planted pose of a shape with a flat sole."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.samples import quadrature
from footfit.geometry.numeric.quantiles import area_quantile
from footfit.geometry.numeric.rotations import angle_deg, rotations_about
from footfit.geometry.pose.frame import about_z, canonical_frame, levelling, plan_axis
from tests import distortions, shapes
from tests.bounds import ROUNDING
from tools.last_specs import HEEL_BANDS_MM, wide
from tools.lasts import LastSpec, last_mesh, standing
from tools.resting import at_rest, pitched

SLANT = 0.3  # 17 degrees


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(rings=60, segments=40))


def frame_of(vertices, faces, length=270.0):
    return canonical_frame(quadrature(vertices, faces, 0.03 * length), length)


def test_a_box_stands_on_its_side_with_its_long_axis_along_x():
    vertices, faces = shapes.cube(1.0, 8)
    box = (vertices + np.array([0.5, 0.0, 0.5])) * [260.0, 90.0, 60.0]
    tilt = rotations_about(np.array([[0.06, -0.05, 0.08]]))[0]
    frame = frame_of(box @ tilt.T + [3.0, -4.0, 2.0], faces, 260.0)
    assert frame.sole
    assert angle_deg(frame.rotation @ tilt, np.eye(3)) < 0.0011  # measured 0.0007
    placed = (box @ tilt.T + [3.0, -4.0, 2.0]) @ frame.rotation.T + frame.shift
    assert placed[:, 2].min() == pytest.approx(0.0, abs=ROUNDING)
    assert placed[:, 0].min() == pytest.approx(
        0.0, abs=6.9e-5
    )  # .3 % of the area lies behind x = 0
    assert placed[:, 1].mean() == pytest.approx(0.0, abs=0.0022)  # measured 0.0014
    assert frame.length == pytest.approx(260.0, abs=0.0016)  # of the triangles' middles
    # the bottom, in full: 260 x 90 over the length squared
    assert frame.support == pytest.approx(260 * 90 / frame.length**2, rel=ROUNDING)


@pytest.mark.parametrize(("height", "counts"), [(0.05, True), (0.12, True), (0.2, False)])
def test_the_plan_axis_is_that_of_the_low_part_whatever_stands_on_it(height, counts):
    """A leg that leans to one side does not turn the axis; a part of the foot does."""
    rng = np.random.default_rng(2)
    low = rng.uniform([0.0, -40.0, 0.0], [260.0, 40.0, 10.0], (4000, 3))
    leg = rng.uniform([150.0, 60.0, 260.0 * height], [250.0, 90.0, 260.0 * height + 5.0], (1500, 3))
    points = np.concatenate([low, leg])
    turn = np.degrees(np.arctan2(*plan_axis(points, np.ones(len(points)), 0.0, 260.0)[::-1]))
    assert (turn > 8.0) if counts else abs(turn) < 0.37  # measured: 13 and 0.19 deg


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_frame_forgets_the_pose_it_was_started_from(last, seed):
    vertices, faces = last
    home = frame_of(vertices, faces)
    turn = rotations_about(np.random.default_rng(seed).uniform(-0.1, 0.1, (1, 3)))[0]
    frame = frame_of(vertices @ turn.T, faces)
    assert angle_deg(frame.rotation @ turn, home.rotation) < ROUNDING
    placed = vertices @ turn.T @ frame.rotation.T + frame.shift
    assert np.abs(placed - (vertices @ home.rotation.T + home.shift)).max() < ROUNDING


@pytest.mark.parametrize("style", ["pump", "boot", "sandal"])
@pytest.mark.parametrize("heel_mm", [(40.0, 60.0), (60.0, 90.0), (90.0, 120.0)])
def test_a_heeled_last_finds_its_resting_line_from_a_start_that_is_pitched_by_20_deg(
    style, heel_mm
):
    """A rough pose of such a last was 17 deg off: it was then taken for one without a sole."""
    spec = wide(np.random.default_rng(5), style, heel_mm, rings=60, segments=40, side="right")
    vertices, faces = last_mesh(spec)
    length = float(np.ptp(vertices[:, 0]))
    base = canonical_frame(quadrature(vertices, faces, 0.03 * length), length, last=True)
    for pitch_deg in (-20.0, -17.0, 17.0, 20.0):
        turn = rotations_about(np.radians([[0.0, pitch_deg, 0.0]]))[0]
        turned = vertices @ turn.T
        turned[:, 2] -= turned[:, 2].min()
        sample = quadrature(turned, faces, 0.03 * length)
        frame = canonical_frame(sample, length, last=True)
        assert frame.sole
        assert angle_deg(frame.rotation @ turn, base.rotation) < 0.3  # measured .16


@pytest.mark.parametrize("style", ["shoe", "pump"])
@pytest.mark.parametrize("heel_mm", HEEL_BANDS_MM)
def test_a_last_is_level_across_its_tread_at_every_heel(style, heel_mm):
    """The sole plane and the break of the shank rolled such lasts by 1 to 3 degrees."""
    seed = HEEL_BANDS_MM.index(heel_mm)
    spec = wide(np.random.default_rng(seed), style, heel_mm, rings=80, segments=60, side="right")
    vertices, faces = last_mesh(spec)
    frame = canonical_frame(quadrature(vertices, faces, 0.03 * 270.0), spec.length_mm, last=True)
    roll_deg = np.degrees(np.arctan2(frame.rotation[2, 1], frame.rotation[2, 2]))
    assert abs(roll_deg) < 0.7  # measured 0.36: the plan axis of the resting last is turned


@pytest.mark.parametrize("heel_mm", HEEL_BANDS_MM)
def test_a_break_that_runs_aslant_does_not_roll_a_last(heel_mm):
    """The inner ball joint lies in front of the outer one: real shanks bend along that line."""
    spec = wide(np.random.default_rng(3), "shoe", heel_mm, rings=80, segments=60, side="right")
    pose = standing(spec)
    vertices = pitched(last_mesh(spec)[0], np.radians(pose.pitch_deg))
    x, z = pose.middle_mm.T
    along = vertices[:, 0] - vertices[:, 0].min() + x[0]
    ahead = SLANT * vertices[:, 1] * np.clip((along / spec.length_mm - 0.3) / 0.2, 0.0, 1.0)
    vertices[:, 2] += np.interp(along - ahead, x, z) - np.interp(along, x, z)
    resting, _ = at_rest(vertices)
    sample = quadrature(resting, last_mesh(spec)[1], 0.03 * spec.length_mm)
    frame = canonical_frame(sample, spec.length_mm, last=True)
    roll_deg = np.degrees(np.arctan2(frame.rotation[2, 1], frame.rotation[2, 2]))
    assert abs(roll_deg) < 2.5  # measured 1.75; it rolled by 8 to 10 before


def test_a_mirrored_shape_has_the_mirrored_frame(last):
    home = frame_of(*last)
    twin = frame_of(*distortions.mirrored(*last))
    flip = np.diag([1.0, -1.0, 1.0])
    np.testing.assert_allclose(twin.rotation, flip @ home.rotation @ flip, atol=ROUNDING)
    np.testing.assert_allclose(twin.shift, flip @ home.shift, atol=ROUNDING)


@settings(max_examples=10, deadline=None)
@given(scale=st.floats(0.001, 10.0))
def test_the_frame_scales_with_the_shape(last, scale):
    vertices, faces = last
    home = frame_of(vertices, faces)
    frame = canonical_frame(quadrature(vertices * scale, faces, 8.1 * scale), 270.0 * scale)
    assert angle_deg(frame.rotation, home.rotation) < ROUNDING
    np.testing.assert_allclose(frame.shift / scale, home.shift, atol=ROUNDING)


def test_half_subdivision_hardly_moves_the_frame(last):
    home, finer = frame_of(*last), frame_of(*distortions.half_subdivided(*last))
    assert angle_deg(home.rotation, finer.rotation) < 0.0094  # measured 0.0062
    assert np.abs(home.shift - finer.shift).max() < 0.0098  # measured 0.0065


def test_a_shape_without_a_sole_rests_on_its_rim(last):
    vertices, faces = last
    bottom = np.array([0.0, 0.0, -1.0])
    cut = distortions.plane_cut(vertices, faces, np.array([0.0, 0.0, 15.0]), bottom)
    frame = frame_of(*cut)
    assert not frame.sole
    placed = cut[0] @ frame.rotation.T + frame.shift
    rim = cut[0][:, 2] < 15.0 + 1e-9
    assert np.ptp(placed[rim, 2]) < 2.0


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_levelling_is_the_smallest_turn_to_z(seed):
    normal = np.random.default_rng(seed).normal(size=3)
    normal /= np.linalg.norm(normal)
    turn = levelling(normal) if normal[2] > -0.99 else None
    if turn is None:
        return
    np.testing.assert_allclose(turn @ normal, [0, 0, 1], atol=ROUNDING)
    tilt = np.degrees(np.arctan2(np.hypot(*normal[:2]), normal[2]))
    assert angle_deg(turn, np.eye(3)) == pytest.approx(tilt, abs=ROUNDING)


def test_about_z_takes_a_direction_to_x():
    assert np.allclose(about_z(np.array([3.0, 4.0])) @ [3.0, 4.0, 1.0], [5.0, 0.0, 1.0])


def test_a_quantile_by_area_does_not_count_points():
    values = np.repeat([1.0, 2.0, 3.0], [1, 100, 1])
    areas = np.repeat([10.0, 0.01, 10.0], [1, 100, 1])
    assert area_quantile(values, areas, 0.1) == pytest.approx(1.0)
    with pytest.raises(ValueError, match="at least one value"):
        area_quantile(values[:0], areas[:0], 0.5)
