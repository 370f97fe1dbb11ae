"""Splitting flat facets: no point of the surface moves, and curvature can see them."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.geometry.curvature.pooled_curvature import pooled_curvature
from footfit.geometry.mesh import topology
from footfit.geometry.mesh.refinement import with_flat_facets_split
from tests import shapes
from tests.bounds import EXACT
from tests.distortions import subdivided
from tests.solids import is_consistently_wound, signed_volume, surface_area


def test_a_cylinders_ends_are_split_and_its_wall_is_not():
    vertices, faces = shapes.cylinder(40.0, 250.0, 48, 60)  # wall sides up to 6.7
    finer, split = with_flat_facets_split(vertices, faces, 8.0)
    assert len(finer) > len(vertices) + 100
    np.testing.assert_array_equal(finer[: len(vertices)], vertices)
    added = finer[len(vertices) :]
    assert set(np.unique(added[:, 2])) <= {0.0, 250.0}
    for measure in (surface_area, signed_volume):
        assert measure(finer, split) == pytest.approx(measure(vertices, faces), rel=EXACT)
    assert topology.is_closed(split)
    assert is_consistently_wound(split)
    flat = np.ptp(finer[split][:, :, 2], axis=1) == 0.0
    corners = finer[split[flat]]
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() <= 8.0


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.sphere(50.0, 2),
        shapes.convex_cloud(800, np.random.default_rng(0)),
        shapes.open_cap(50.0, 70.0, 7, 20),
        shapes.tetrahedron(),
    ],
)
def test_what_has_no_big_facets_is_left_alone(mesh):
    vertices, faces = with_flat_facets_split(*mesh, 1.0)
    assert len(vertices) == len(mesh[0])
    assert len(faces) == len(mesh[1])


def test_a_tiny_side_is_not_followed_for_ever():
    vertices, faces = with_flat_facets_split(*shapes.cylinder(40.0, 250.0, 48, 10), 1e-3)
    assert len(vertices) < 33_000  # measured 22,000
    assert topology.is_closed(faces)


def test_facets_without_vertices_of_their_own_read_as_if_they_had_them():
    vertices, faces = shapes.cylinder(40.0, 60.0, 96, 24)
    fine = subdivided(vertices, faces)
    for _ in range(2):
        flat = np.ptp(fine[0][fine[1]][:, :, 2], axis=1) == 0.0
        fine = subdivided(*fine, flat)
    rim = (np.abs(vertices[:, 2] - 30.0) == 30.0) & (np.hypot(*vertices[:, :2].T) > 1.0)
    coarse_k2 = pooled_curvature(vertices, faces, 15.0).k2[rim]
    fine_k2 = pooled_curvature(*fine, 15.0).k2[: len(vertices)][rim]
    np.testing.assert_allclose(coarse_k2, fine_k2, rtol=0.03)  # measured 0.020
