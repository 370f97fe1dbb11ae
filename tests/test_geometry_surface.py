"""Areas, normals and volumes against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from footfit.geometry.mesh import surface
from tests import shapes
from tests.bounds import EXACT, ROUNDING
from tests.distortions import inside_out, subdivided
from tests.solids import signed_volume, surface_area
from tests.strategies import rotations, scales, shifts_mm, surfaces


def test_cube_area_volume_and_normals():
    vertices, faces = shapes.cube(10.0, 4)
    assert surface_area(vertices, faces) == pytest.approx(600.0, rel=EXACT)
    assert signed_volume(vertices, faces) == pytest.approx(1000.0, rel=EXACT)
    outward = np.einsum("ij,ij->i", surface.face_normals(vertices, faces), vertices[faces][:, 0])
    np.testing.assert_allclose(outward, 5.0, rtol=1e-12)


def test_cylinder_volume_and_area_are_the_prisms():
    vertices, faces = shapes.cylinder(40.0, 250.0, 32, 5)
    n, r, h = 32, 40.0, 250.0
    end, side = n * r * r * np.sin(2 * np.pi / n) / 2, 2 * r * np.sin(np.pi / n)
    assert signed_volume(vertices, faces) == pytest.approx(end * h, rel=EXACT)
    assert surface_area(vertices, faces) == pytest.approx(2 * end + n * side * h, rel=EXACT)


@given(surfaces(), rotations(), shifts_mm(), scales())
@settings(max_examples=25, deadline=None)
def test_laws_of_motion_and_scale(mesh, rotation, shift, scale):
    vertices, faces = mesh
    moved = scale * (vertices @ rotation.T + shift)
    np.testing.assert_allclose(
        surface.face_areas(moved, faces), scale**2 * surface.face_areas(vertices, faces), rtol=1e-6
    )
    np.testing.assert_allclose(
        surface.vertex_normals(moved, faces),
        surface.vertex_normals(vertices, faces) @ rotation.T,
        atol=ROUNDING,
    )
    volume = signed_volume(vertices, faces)
    assert signed_volume(moved, faces) == pytest.approx(scale**3 * volume, rel=ROUNDING)
    assert signed_volume(*inside_out(vertices, faces)) == pytest.approx(-volume)


@given(surfaces())
@settings(max_examples=25, deadline=None)
def test_subdivision_moves_no_total_and_vertex_areas_add_up(mesh):
    vertices, faces = mesh
    finer = subdivided(vertices, faces)
    area = surface_area(vertices, faces)
    assert surface_area(*finer) == pytest.approx(area, rel=EXACT)
    assert surface.vertex_areas(vertices, faces).sum() == pytest.approx(area, rel=EXACT)
    angles = surface.corner_angles(vertices, faces)
    np.testing.assert_allclose(angles.sum(axis=1), np.pi, atol=ROUNDING)


@pytest.mark.parametrize("subdivisions", [2, 3, 4])
def test_normals_on_a_sphere_point_along_the_radius(subdivisions):
    vertices, faces = shapes.sphere(1.0, subdivisions)
    edge = np.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 1]], axis=1).mean()
    along = np.einsum("ij,ij->i", surface.vertex_normals(vertices, faces), vertices)
    assert np.arccos(np.minimum(along, 1.0)).max() < 0.1 * edge  # of the first order in the edge


def test_a_face_without_area_has_no_normal_and_spoils_none():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]])
    faces = np.array([[0, 1, 2], [0, 1, 3]])
    assert surface.face_normals(vertices, faces)[1].tolist() == [0.0, 0.0, 0.0]
    assert surface.vertex_normals(vertices, faces)[0].tolist() == [0.0, 0.0, 1.0]
    assert surface.vertex_normals(vertices, faces)[3].tolist() == [0.0, 0.0, 0.0]
    assert signed_volume(vertices, faces[:0]) == 0.0
