"""Section outlines: closed where the surface is, smooth, of the surface and not of the mesh."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outlines import closed_loops, outline, smooth_loop, steady_loop
from tests import shapes
from tests.bounds import ROUNDING
from tests.distortions import joined, shuffled, subdivided, white_noise
from tests.strategies import seeds, surfaces

LENGTH_MM = 250.0
UPRIGHT = np.eye(3)[1:]


def perimeter(points):
    return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


@pytest.mark.parametrize("x_mm", [0.0, 13.0, -31.0])
def test_a_sphere_is_cut_in_a_circle(x_mm: float) -> None:
    section = outline(*shapes.sphere(40.0, 5), np.array([x_mm, 0.0, 0.0]), UPRIGHT, LENGTH_MM)
    (loop,) = section.loops
    radius = np.sqrt(40.0**2 - x_mm**2)
    np.testing.assert_allclose(np.linalg.norm(loop, axis=1), radius, atol=0.022)  # measured 0.015
    assert section.gap_mm() == 0.0
    assert section.length_mm.sum() == pytest.approx(
        2 * np.pi * radius, rel=5.7e-4
    )  # measured 0.00038


def test_smoothing_halves_the_noise_and_does_not_shrink() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    circle = 35.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    assert np.linalg.norm(smooth_loop(circle, LENGTH_MM), axis=1).mean() == pytest.approx(
        35,
        abs=0.0047,  # measured 0.0031
    )
    noisy = circle + np.random.default_rng(5).normal(0.0, 0.3, circle.shape)
    radius = np.linalg.norm(smooth_loop(noisy, LENGTH_MM), axis=1)
    assert np.std(radius) < 0.15
    assert radius.mean() == pytest.approx(35.0, abs=0.033)  # measured 0.022


def test_two_bodies_give_two_loops_and_a_speck_none() -> None:
    large, small = shapes.sphere(40.0, 4), shapes.sphere(1.0, 3)
    apart = large[0] + [0.0, 100.0, 0.0]
    vertices, faces = joined(large, (apart, large[1]), (small[0] - [0.0, 60.0, 0.0], small[1]))
    section = outline(vertices, faces, np.zeros(3), UPRIGHT, LENGTH_MM)
    assert len(section.loops) == 2


def test_an_open_surface_says_how_wide_it_is_open() -> None:
    vertices, faces = shapes.open_cap(50.0, 90.0)
    section = outline(vertices, faces, np.zeros(3), UPRIGHT, LENGTH_MM)
    assert section.gap_mm() == pytest.approx(100.0, rel=ROUNDING)
    assert len(section.loops) == 1


@settings(max_examples=15, deadline=None)
@given(surfaces(open_too=False), seeds)
def test_every_segment_is_in_one_loop_whatever_the_order(mesh, seed: int) -> None:
    vertices, faces = shuffled(*mesh, np.random.default_rng(seed))
    section = outline(vertices, faces, vertices.mean(axis=0), UPRIGHT, LENGTH_MM)
    assert section.gap_mm() == 0.0
    again = outline(*mesh, vertices.mean(axis=0), UPRIGHT, LENGTH_MM)
    assert sorted(perimeter(p) for p in again.loops) == pytest.approx(
        sorted(perimeter(p) for p in section.loops), rel=ROUNDING
    )


def test_a_subdivided_mesh_has_the_same_outline() -> None:
    vertices, faces = shapes.ellipsoid((120.0, 45.0, 35.0), 4)
    rng = np.random.default_rng(2)
    vertices = white_noise(vertices, rng, 0.3)
    one = outline(vertices, faces, np.zeros(3), UPRIGHT, LENGTH_MM)
    finer = subdivided(vertices, faces, rng.random(len(faces)) < 0.4)
    other = outline(*finer, np.zeros(3), UPRIGHT, LENGTH_MM)
    assert perimeter(other.points) == pytest.approx(perimeter(one.points), abs=ROUNDING)


def test_where_four_segments_meet_each_is_walked_once() -> None:
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [-1, 0, 0], [-1, -1, 0]])
    ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    loops, gaps = closed_loops(ends)
    assert len(gaps) == 0
    assert sum(len(loop) for loop in loops) == 6


def square(side_mm: float = 60.0, per_side: int = 30):
    """A square's outline, (4 per_side, 2), counter-clockwise."""
    along = np.arange(per_side) / per_side
    corners = side_mm * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    ahead = np.roll(corners, -1, axis=0) - corners
    return (corners[:, None] + along[None, :, None] * ahead[:, None]).reshape(-1, 2)


def test_a_clean_corner_is_kept_and_smoothing_alone_rounds_it_off() -> None:
    assert perimeter(steady_loop(square(), LENGTH_MM)) == pytest.approx(240.0, abs=ROUNDING)
    assert perimeter(smooth_loop(square(), LENGTH_MM)) < 238.0


def test_noise_lets_a_corner_be_rounded_off_half_as_much_as_by_smoothing_alone() -> None:
    rng = np.random.default_rng(3)
    noisy = [square() + rng.normal(scale=0.3, size=(120, 2)) for _ in range(20)]
    smooth_mm, steady_mm = (
        np.mean([240.0 - hull_girth(steadied(loop, LENGTH_MM)) for loop in noisy])
        for steadied in (smooth_loop, steady_loop)
    )
    assert 0.0 < steady_mm < 0.6 * smooth_mm  # measured 1.74 and 3.45
