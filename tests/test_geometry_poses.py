"""The pose of lasts and feet in any pose, and what is refused; the fit's algebra."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.samples import even_sample
from footfit.geometry.numeric.rotations import rotations_about
from footfit.geometry.search.icp import (
    Poses,
    _plane_part,
    _point_part,
    icp_steps,
    levelled_poses,
    posed_points,
)
from footfit.geometry.search.pose_search import (
    POSE_SEARCH,
    is_accepted,
    rough_pose,
)
from footfit.geometry.search.turned_poses import mirror_image, straight_turns, turned_about
from footfit.pipeline.scan.shipped_templates import shipped_templates
from tests import distortions, shapes
from tests.bounds import ROUNDING
from tools.lasts import LastSpec, last_mesh

WINDOW = ((100.0, 400.0),)
SEEDS = st.integers(0, 2**32 - 1)


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(rings=60, segments=40))


def test_the_turns_that_are_tried_are_every_other_one_that_keeps_the_line_of_x():
    """With the identity they are a group of eight: four rolls, with either end in front."""
    turns = np.rint(np.concatenate([np.eye(3)[None], straight_turns()])).astype(int)
    known = {turn.tobytes() for turn in turns}
    assert len(known) == len(turns) == 8
    assert {(one @ other).tobytes() for one in turns for other in turns} == known
    assert np.array_equal(np.abs(turns[:, 0]), [[1, 0, 0]] * 8)
    assert np.linalg.det(turns) == pytest.approx([1.0] * 8)


def test_the_normal_equations_are_those_of_the_rows_written_out():
    rng = np.random.default_rng(0)
    q, away, plane = (rng.normal(size=(2, 30, 3)).astype(np.float32) for _ in range(3))
    weight = rng.random((2, 30)).astype(np.float32)
    by_point, by_plane = np.zeros((2, 8, 8)), np.zeros((2, 8, 8))
    for k in range(2):
        for point, gap, normal, w in zip(q[k], away[k], plane[k], weight[k], strict=True):
            for direction, total in ((None, by_plane), *((e, by_point) for e in np.eye(3))):
                d = normal if direction is None else direction
                row = np.r_[np.cross(point, d), d, point @ d, gap @ d]
                total[k] += w * np.outer(row, row)
    used = (slice(None), slice(7), slice(None))  # the last row is never read
    np.testing.assert_allclose(
        _point_part(q, away, weight)[used], by_point[used], atol=3.8e-6
    )  # measured 2.5e-06
    np.testing.assert_allclose(
        _plane_part(q, away, plane, weight), by_plane, atol=4.4e-6
    )  # measured 2.9e-06


def test_icp_finds_back_a_small_known_motion():
    """A reference's own points, moved a little and scaled, are put back."""
    shape = shipped_templates()[0]
    body = shape.points[:, 2] < 0.4
    points, normals = shape.points[body][::8], shape.normals[body][::8]
    turn = rotations_about(np.array([[0.10, -0.08, 0.12]]))[0]
    moved = (points @ turn.T + [0.02, -0.01, 0.015]).astype(np.float32)
    start = Poses(
        np.eye(3, dtype=np.float32)[None], np.zeros((1, 3), np.float32), np.ones(1, np.float32)
    )
    found = icp_steps(start, moved, (normals @ turn.T).astype(np.float32), shape, 25)
    back = moved @ found.rotation[0].T * found.scale[0] + found.shift[0]
    assert np.linalg.norm(back - points, axis=1).max() < 7.2e-4  # measured 0.00048


def test_levelling_takes_length_and_shift_from_the_low_part():
    vertices, _ = shapes.cube(1.0, 4)
    box = (vertices + np.array([0.5, 0.0, 0.5])) * [200.0, 80.0, 60.0] + [30.0, 7.0, -5.0]
    poses = levelled_poses(np.eye(3, dtype=np.float32)[None], box.astype(np.float32), 0.1)
    assert 1 / poses.scale[0] == pytest.approx(200.0, rel=ROUNDING)
    corner = box.min(axis=0) * poses.scale[0] + poses.shift[0]
    assert corner == pytest.approx([0.0, 0.1 - 0.2, 0.0], abs=8.4e-9)  # measured 5.6e-09


def test_a_mirror_image_of_a_pose_keeps_the_place_mirrored():
    rng = np.random.default_rng(2)
    pose = Poses(
        distortions.random_rotation(rng)[None].astype(np.float32),
        rng.normal(size=(1, 3)).astype(np.float32),
        np.ones(1, np.float32),
    )
    points = rng.normal(size=(20, 3)).astype(np.float32)
    flip = np.array([1, -1, 1], np.float32)
    image = mirror_image(pose, 0.25)
    here = points @ pose.rotation[0].T + pose.shift[0]
    there = (points * flip) @ image.rotation[0].T + image.shift[0]
    np.testing.assert_allclose(there, here * flip + [0, 0.5, 0], atol=8.9e-8)  # measured 5.9e-08


def test_a_pose_is_turned_about_the_middle_of_the_shape():
    rng = np.random.default_rng(3)
    pose = Poses(
        distortions.random_rotation(rng)[None].astype(np.float32),
        rng.normal(size=(1, 3)).astype(np.float32),
        np.array([0.004], np.float32),
    )
    centre = np.array([0.5, 0.1, 0.2])
    half = np.diag([-1.0, -1.0, 1.0]).astype(np.float32)
    turned = turned_about(pose, half[None], 0.1, (0.5, 0.2))
    points = 100 * rng.normal(size=(20, 3)).astype(np.float32)
    before, after = posed_points(pose, points)[0], posed_points(turned, points)[0]
    np.testing.assert_allclose(
        after - centre, (before - centre) @ half.T, atol=1.8e-7
    )  # measured 1.2e-07


def test_a_search_that_kept_only_wrong_poses_is_still_put_right(last):
    """Twelve rotations miss the right valley in half of all poses: the turned rivals find it."""
    blind = replace(POSE_SEARCH, rotations=12, more_rotations=12, kept_coarse=2)
    lame = replace(blind, rivals_finished=0)
    references, rng = shipped_templates(), np.random.default_rng(5)
    right, without = 0, 0
    for _ in range(10):
        turn = distortions.random_rotation(rng)
        vertices, faces = last[0] @ turn.T, last[1]
        found = rough_pose(vertices, faces, references, WINDOW, blind)
        right += bool(found.accepted and _upright(found.rotation @ turn))
        less = rough_pose(vertices, faces, references, WINDOW, lame)
        without += bool(less.accepted and _upright(less.rotation @ turn))
    assert right == 10
    assert without < 6  # else this test would test nothing


def _upright(turn):
    return min(turn[0, 0], turn[2, 2]) > np.cos(np.radians(20))


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS, left=st.booleans())
def test_a_last_in_any_pose_is_set_upright(last, seed, left):
    vertices, faces = distortions.mirrored(*last) if left else last
    pose = distortions.random_pose(np.random.default_rng(seed))
    found = rough_pose(distortions.moved(vertices, pose), faces, shipped_templates(), WINDOW)
    turn = found.rotation @ pose[:3, :3]
    assert found.accepted
    assert found.kind == "last"
    assert _upright(turn)


@pytest.mark.parametrize("known_size", [True, False])
@pytest.mark.parametrize(
    "make",
    [
        shapes.cylinder,
        shapes.ellipsoid,
        shapes.sphere,
        shapes.hand,
        shapes.shin,
        shapes.flat_sheet,
        lambda: (shapes.cube(1.0, 8)[0] * [260.0, 95.0, 80.0], shapes.cube(1.0, 8)[1]),
    ],
    ids=["cylinder", "ellipsoid", "sphere", "hand", "shin", "sheet", "box"],
)
def test_what_is_no_foot_is_not_accepted(make, known_size):
    vertices, faces = make()
    for seed in range(2):
        pose = distortions.random_pose(np.random.default_rng(seed))
        windows = WINDOW if known_size else ()
        moved = distortions.moved(vertices, pose)
        assert not rough_pose(moved, faces, shipped_templates(), windows).accepted


def test_a_doubtful_fit_needs_a_clearer_margin():
    assert is_accepted(0.30, 0.05)
    assert not is_accepted(0.60, 0.05)
    assert is_accepted(0.50, 0.20)
    assert not is_accepted(0.60, 0.20)
    assert not is_accepted(0.70, 0.50)


def test_the_sample_is_spread_by_area():
    vertices, faces = shapes.cube(100.0, 4)
    sample = even_sample(vertices, faces, 1200)
    on_top = (np.abs(sample.points[:, 2] - 50.0) < 1e-9).mean()
    assert on_top == pytest.approx(1 / 6, abs=ROUNDING)
    assert sample.areas.sum() == pytest.approx(6e4)
