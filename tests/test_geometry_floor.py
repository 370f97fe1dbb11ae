"""Planes under shapes, and plates that are no part of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.samples import quadrature
from footfit.geometry.mesh.welding import welded_vertices
from footfit.geometry.numeric.planes import LEVEL, Plane, PlanePoints
from footfit.geometry.pose.floor_plate import is_flat, without_plate
from footfit.geometry.pose.sole_plane import sole_plane, support
from tests import distortions, shapes
from tests.bounds import ROUNDING
from tools.lasts import LastSpec, last_mesh


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_plane_through_points_of_a_plane_is_that_plane(seed):
    rng = np.random.default_rng(seed)
    normal = np.array([*rng.uniform(-0.5, 0.5, 2), 1.0])
    normal /= np.linalg.norm(normal)
    across = np.linalg.svd(normal[None])[2][1:]
    points = rng.normal(size=(40, 2)) @ across + 3.5 * normal
    known = PlanePoints(points)
    plane = known.plane(rng.uniform(0.1, 1.0, 40), LEVEL.normal)
    assert plane.normal == pytest.approx(normal, abs=ROUNDING)
    assert plane.offset == pytest.approx(3.5, abs=ROUNDING)
    for each in (plane, LEVEL):
        assert known.heights(each) == pytest.approx(each.heights(points), abs=ROUNDING)


def test_the_sole_plane_of_a_box_is_its_bottom():
    vertices, faces = shapes.cube(1.0, 8)
    sample = quadrature(vertices * [260.0, 90.0, 60.0], faces, 8.0)
    plane = sole_plane(sample, 260.0, Plane(LEVEL.normal, -28.0))
    assert plane.normal == pytest.approx([0, 0, 1], abs=ROUNDING)
    assert plane.offset == pytest.approx(-30.0, abs=ROUNDING)
    assert support(sample, plane, 260.0) == pytest.approx(90 / 260, rel=ROUNDING)


def test_nothing_that_faces_down_leaves_the_start():
    vertices, faces = shapes.flat_sheet()
    sample = quadrature(vertices, faces, 8.0)
    assert sole_plane(sample, 260.0) is LEVEL


def test_a_plate_grown_to_a_last_is_cut_away():
    vertices, faces = last_mesh(LastSpec(rings=40, segments=32))
    cut = distortions.plane_cut(vertices, faces, np.array([0, 0, 6.0]), np.array([0, 0, -1.0]))
    ground = distortions.floor_plate(*cut)
    pose = distortions.random_pose(np.random.default_rng(4))
    plated = welded_vertices(distortions.moved(ground[0], pose), ground[1])[:2]
    left = without_plate(*plated)
    assert not left[len(cut[1]) :].any()
    assert left[: len(cut[1])].mean() > 0.85


def test_a_cut_leg_or_a_hole_is_no_plate():
    vertices, faces = last_mesh(LastSpec(rings=40, segments=32))
    for mesh in (
        (vertices, faces),
        distortions.leg_cut(vertices, faces, 60.0),
        distortions.with_holes(vertices, faces, np.random.default_rng(0), 3, 8.0),
        _with_holed_sole(vertices, faces),
    ):
        assert without_plate(*mesh).all()


def _with_holed_sole(vertices, faces):
    """All boundary on one plane, as a plate's is, but inside the outline of what stands on it."""
    middles = vertices[faces].mean(axis=1)
    holes = [np.hypot(middles[:, 0] - x, middles[:, 1]) < 12.0 for x in (30.0, 170.0, 190.0)]
    return vertices, faces[~(np.any(holes, axis=0) & (middles[:, 2] < 10.0))]


def test_a_flat_piece_is_flat_in_any_pose():
    pose = distortions.random_pose(np.random.default_rng(1))
    assert is_flat(distortions.moved(shapes.flat_sheet()[0], pose))
    assert not is_flat(distortions.moved(shapes.cube(100.0, 4)[0], pose))
