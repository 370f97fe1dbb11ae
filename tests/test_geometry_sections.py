"""Exact sections: against formulas, closed where the mesh is closed, blind to the tessellation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.flare.band_edges import band_edges
from footfit.geometry.mesh.sections import (
    Planes,
    depth_at,
    extremes_below,
    highest,
    lowest,
    plane_sections,
    planes_across,
    sections_across,
)
from tests import distortions, shapes, strategies
from tests.bounds import ROUNDING


def perimeters(segments):
    steps = np.linalg.norm(segments.points[:, 1] - segments.points[:, 0], axis=1)
    return np.bincount(segments.plane, steps, segments.planes)


def test_a_cubes_sections_are_squares():
    vertices, faces = shapes.cube(100.0)
    x = vertices[:, 0].min() + np.array([13.0, 50.0, 87.0])
    segments = sections_across(vertices, faces, x)
    assert perimeters(segments) == pytest.approx([400.0] * 3)
    assert segments.points[:, :, 0] == pytest.approx(np.repeat(x[segments.plane], 2).reshape(-1, 2))


def test_a_spheres_sections_are_circles():
    vertices, faces = shapes.sphere(50.0, 5)
    x = np.array([-30.0, 0.0, 40.0])
    found = perimeters(sections_across(vertices, faces, x))
    assert found == pytest.approx(
        2 * np.pi * np.sqrt(50.0**2 - x**2), rel=6.1e-4
    )  # measured 0.0004


def test_a_plane_through_vertices_still_gives_a_closed_section():
    vertices, faces = shapes.cube(100.0, 4)
    middle = 0.5 * (vertices[:, 0].min() + vertices[:, 0].max())  # a row of vertices lies here
    segments = sections_across(vertices, faces, np.array([middle]))
    assert perimeters(segments) == pytest.approx([400.0])


@settings(max_examples=30, deadline=None)
@given(mesh=strategies.surfaces(open_too=False), share=st.floats(0.02, 0.98))
def test_a_closed_mesh_has_closed_sections(mesh, share):
    vertices, faces = mesh
    x = vertices[:, 0].min() + share * np.ptp(vertices[:, 0])
    segments = sections_across(vertices, faces, np.array([x]))
    _, count = np.unique(segments.points.reshape(-1, 3), axis=0, return_counts=True)
    assert (count % 2 == 0).all()  # each end belongs to two segments, to the last bit


@settings(max_examples=15, deadline=None)
@given(turn=strategies.rotations(), level=st.floats(-30.0, 30.0))
def test_oblique_planes_cut_circles_of_a_sphere(turn, level):
    vertices, faces = shapes.sphere(50.0, 4)
    normal = turn[0]
    planes = Planes(np.array([level]), level * normal[None], normal[None])
    segments = plane_sections(vertices, faces, vertices @ normal, planes)
    assert segments.points.reshape(-1, 3) @ normal == pytest.approx(level, abs=ROUNDING)
    assert perimeters(segments) == pytest.approx(2 * np.pi * np.sqrt(2500 - level**2), rel=1.9e-3)


@settings(max_examples=20, deadline=None)
@given(seed=strategies.seeds)
def test_sections_do_not_see_subdivision(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.convex_cloud(120, rng, (60.0, 45.0, 35.0))
    finer = distortions.subdivided(vertices, faces, rng.random(len(faces)) < 0.4)
    x = np.linspace(vertices[:, 0].min(), vertices[:, 0].max(), 9)[1:-1]
    first, second = sections_across(vertices, faces, x), sections_across(*finer, x)
    assert perimeters(second) == pytest.approx(perimeters(first), rel=ROUNDING)
    for one, other in zip(measured(first), measured(second), strict=True):
        assert other == pytest.approx(one, abs=ROUNDING)


def measured(segments):
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    floor = lowest(height, segments)
    limit = floor + 20.0
    middle = np.zeros(segments.planes)
    return (
        floor,
        highest(height, segments),
        *extremes_below(across, height, limit, segments),
        *band_edges(across, height, limit, segments, 2.0),
        depth_at(middle, across, height, segments),
    )


def test_sections_across_are_the_general_ones_to_the_bit():
    vertices, faces = shapes.sphere(50.0, 3)
    x = np.linspace(-49.0, 49.0, 23)
    quick = sections_across(vertices, faces, x)
    general = plane_sections(vertices, faces, vertices[:, 0], planes_across(x))
    assert np.array_equal(quick.face, general.face)
    assert np.array_equal(quick.points, general.points)


def test_extremes_stop_at_the_limit_inside_a_segment():
    vertices, faces = shapes.sphere(50.0, 5)
    segments = sections_across(vertices, faces, np.array([0.0]))
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    least, most = extremes_below(across, height, np.array([-30.0]), segments)
    assert (least[0], most[0]) == pytest.approx((-40.0, 40.0), abs=0.021)  # 30-40-50


def test_a_soft_edge_of_a_vertical_wall_is_the_wall():
    vertices, faces = shapes.cube(100.0, 1)
    segments = sections_across(vertices, faces, vertices[:, 0].min() + np.array([50.0]))
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    limit = np.array([height.min() + 40.0])
    extremes = extremes_below(across, height, limit, segments)
    for edge, extreme in zip(
        band_edges(across, height, limit, segments, 1.0), extremes, strict=True
    ):
        # wall 40 at weight 1; the bottom's outer 1 mm weighs 1/2 and lies 1/3 mm inside
        assert abs(edge[0] - extreme[0]) == pytest.approx(0.5 / 3.0 / 40.5, abs=ROUNDING)


def test_a_soft_edge_is_less_noisy_than_the_extreme():
    vertices, faces = shapes.cylinder(30.0, 80.0)
    rng = np.random.default_rng(4)
    found = []
    for _ in range(40):
        noisy = distortions.white_noise(vertices, rng, 0.3)
        segments = sections_across(noisy, faces, np.linspace(-10, 10, 5))
        across, height = segments.points[:, :, 1], segments.points[:, :, 2]
        limit = np.full(5, np.inf)
        soft = band_edges(across, height, limit, segments, 2.0)
        hard = extremes_below(across, height, limit, segments)
        found.append([np.mean(soft[0] + soft[1]), np.mean(hard[0] + hard[1])])
    soft_sd, hard_sd = np.std(found, axis=0)
    assert soft_sd < 0.8 * hard_sd


def test_nothing_is_found_where_nothing_is():
    vertices, faces = shapes.sphere(50.0, 2)
    segments = sections_across(vertices, faces, np.array([-70.0, 0.0, 70.0]))
    height = segments.points[:, :, 2]
    assert np.isnan(lowest(height, segments)).tolist() == [True, False, True]
    assert np.isnan(highest(height, segments)).tolist() == [True, False, True]
    depth = depth_at(np.full(3, 80.0), segments.points[:, :, 1], height, segments)
    assert np.isnan(depth).all()
    empty = plane_sections(vertices, faces[:0], vertices[:, 0], planes_across(np.array([0.0])))
    assert np.isnan(lowest(empty.points[:, :, 2], empty)).all()
