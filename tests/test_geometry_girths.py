"""Girths: hulls against a peer, and tapes around shapes of known girth."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.spatial import ConvexHull
from scipy.special import ellipe

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.tape import convex_hull, hull_girth
from tests import shapes
from tests.bounds import EXACT
from tests.strategies import seeds


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
