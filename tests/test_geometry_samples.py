"""Areas that integrals rest on: whole, whatever the triangles, and calm under noise."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.geometry.samples import farthest_points, quadrature
from footfit.geometry.surface import surface_area
from tests import distortions, shapes


def test_quadrature_splits_large_triangles_and_keeps_the_area():
    vertices, faces = shapes.cube(100.0, 2)
    sample = quadrature(vertices, faces, 10.0)
    assert len(sample.points) > 4 * len(faces)
    assert sample.areas.sum() == pytest.approx(6e4)
    # the second moment of a square's middles tends to that of the square, a quarter per halving
    top = sample.points[:, 2] > 49.999
    moment = (sample.areas[top] @ sample.points[top, 0] ** 2) / sample.areas[top].sum()
    assert moment == pytest.approx(100.0**2 / 12, rel=0.02)


def test_quadrature_stops_after_its_rounds():
    vertices, faces = shapes.tetrahedron(1e6)
    assert len(quadrature(vertices, faces, 1.0, rounds=3).points) == 4 * 4**3


def test_noise_does_not_enlarge_the_areas():
    vertices, faces = shapes.sphere(50.0, 5)
    noisy = distortions.white_noise(vertices, np.random.default_rng(0), 0.3)
    clean = surface_area(vertices, faces)
    raised = surface_area(noisy, faces) / clean - 1
    assert raised > 0.03
    assert abs(quadrature(noisy, faces, 10.0).areas.sum() / clean - 1) < raised / 2


def test_farthest_points_of_a_line_are_its_ends_then_its_middle():
    line = np.column_stack([np.arange(9.0), np.zeros(9), np.zeros(9)])
    chosen = farthest_points(line, 3).tolist()
    assert sorted(chosen[:2]) == [0, 8]
    assert chosen[2] == 4
    assert len(farthest_points(line, 50)) == 9
