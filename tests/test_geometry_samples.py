"""Areas that integrals rest on: whole, whatever the triangles, and calm under noise."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np
import pytest

from footfit.geometry.mesh.samples import (
    SurfaceSample,
    farthest_points,
    gathered_sample,
    quadrature,
)
from tests import distortions, shapes
from tests.solids import surface_area


def test_quadrature_splits_large_triangles_and_keeps_the_area():
    vertices, faces = shapes.cube(100.0, 2)
    sample = quadrature(vertices, faces, 10.0)
    assert len(sample.points) > 4 * len(faces)
    assert sample.areas.sum() == pytest.approx(6e4)
    # the second moment of a square's middles tends to that of the square, a quarter per halving
    top = sample.points[:, 2] > 49.999
    moment = (sample.areas[top] @ sample.points[top, 0] ** 2) / sample.areas[top].sum()
    assert moment == pytest.approx(100.0**2 / 12, rel=0.004)  # measured 0.0026


def test_quadrature_stops_after_its_rounds():
    vertices, faces = shapes.tetrahedron(1e6)
    assert len(quadrature(vertices, faces, 1.0, rounds=3).points) == 4 * 4**3


def test_gathered_points_keep_area_and_moments_in_any_order():
    whole = quadrature(*shapes.ellipsoid((130.0, 50.0, 40.0), 5), 10.0)
    shuffled = np.random.default_rng(1).permutation(len(whole.areas))
    fewer = gathered_sample(whole, 5.0)
    again = gathered_sample(SurfaceSample(*(part[shuffled] for part in astuple(whole))), 5.0)
    assert len(fewer.areas) < len(whole.areas) / 5
    assert fewer.areas.sum() == pytest.approx(whole.areas.sum())
    assert fewer.areas @ fewer.points == pytest.approx(
        whole.areas @ whole.points, abs=5.6e-10
    )  # measured 3.7e-10
    moments = [(s.areas[:, None] * s.points).T @ s.points for s in (whole, fewer)]
    assert np.diag(moments[1]) == pytest.approx(np.diag(moments[0]), rel=2e-3)
    assert again.points == pytest.approx(fewer.points)
    assert np.linalg.norm(fewer.normals, axis=1) == pytest.approx(1.0)


def test_points_of_two_sides_of_a_thin_sheet_are_not_gathered_into_one():
    points, normals = np.zeros((2, 3)), np.array([[0.0, 0, 1], [0, 0, -1]])
    sheet = SurfaceSample(points, normals, np.ones(2))
    assert gathered_sample(sheet, 1.0).normals.tolist() == [[0, 0, -1], [0, 0, 1]]


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
