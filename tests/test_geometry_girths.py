"""Girths: hulls against a peer, and tapes around shapes of known girth."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.spatial import ConvexHull
from scipy.special import ellipe

from footfit.geometry.measures.girths import instep_girth, instep_girth_least, short_heel_girth
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.numeric.hulls import convex_hull
from tests import shapes
from tests.bounds import EXACT
from tests.measure_peer import Drafted, true_heel_girths
from tests.strategies import seeds
from tools.last_specs import LastSpec
from tools.lasts import last_mesh


@settings(max_examples=50, deadline=None)
@given(seeds)
def test_the_hull_is_scipys(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(int(rng.integers(4, 200)), 2)) * [30.0, 8.0]
    peer = ConvexHull(points)
    assert hull_girth(points) == pytest.approx(peer.area, rel=EXACT)
    assert len(convex_hull(points)) == len(peer.vertices)


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_a_hull_has_no_more_points_than_it_needs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    square = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]])
    on_sides = rng.uniform(size=(30, 1)) * (np.roll(square, -1, axis=0) - square)[:1] + square[:1]
    points = rng.permutation(np.concatenate([square, square, on_sides]))
    assert len(convex_hull(points)) == 4
    assert hull_girth(points) == pytest.approx(12.0)


def test_a_point_has_no_girth() -> None:
    assert hull_girth(np.array([[1.0, 2.0]])) == 0.0


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_the_girth_of_an_ellipsoids_section_is_the_ellipses(share: float) -> None:
    a, b, c = 125.0, 48.0, 40.0
    vertices, faces = shapes.ellipsoid((a, b, c), 5)
    shape = Shape(vertices - vertices.min(axis=0) * [1.0, 0.0, 1.0], faces)
    scale = np.sqrt(1.0 - (2.0 * share - 1.0) ** 2)
    girth = 4.0 * b * scale * ellipe(1.0 - (c / b) ** 2)
    assert hull_girth(shape.across(share).points) == pytest.approx(
        girth, abs=0.099
    )  # measured 0.066


def test_a_least_tape_lies_over_a_sharp_edge_which_other_girths_round_off() -> None:
    # a box of 80 by 50 mm with a ridge of 20 mm
    tube, faces = shapes.cylinder(40.0, 260.0, 240, 60)
    angle = np.arctan2(tube[:, 1], tube[:, 0])
    across, up = np.cos(angle), np.sin(angle)
    box = 1.0 / np.maximum(np.abs(across) / 40.0, np.abs(up) / 25.0)
    y, z = box * across, box * up
    z = z + np.where(z > 0.0, 20.0 * (1.0 - np.abs(y) / 40.0) * z / 25.0, 0.0) + 25.0
    vertices = np.column_stack([tube[:, 2], y, z])
    vertices[-2:, 1:] = 0.0, 25.0  # the middles of the two ends
    girth = ConvexHull(vertices[:-2, 1:]).area
    shape = Shape(vertices - vertices.min(axis=0) * [1, 0, 1], faces, "last")
    assert instep_girth_least(shape).value == pytest.approx(girth, abs=0.02)
    assert 1.3 < girth - instep_girth(shape).value < 5.2  # measured 2.6


@pytest.mark.parametrize("cone", [0.27, 0.30, 0.36])
def test_the_short_heel_girth_goes_over_the_edge_of_low_and_high_cones(cone: float) -> None:
    spec = LastSpec(heel_height_mm=10.0, cone_height_mm=cone * 270.0, rings=120, segments=90)
    vertices, faces = last_mesh(spec)
    true_mm = true_heel_girths(Drafted(vertices, faces, "last", 0.0, {}))["short_heel_girth"]
    # measured .46: smoothing takes that of the feather edge; the edge itself is read alike
    assert short_heel_girth(Shape(vertices, faces, "last")).value == pytest.approx(true_mm, abs=0.9)
