"""The printed moments follow the paper; the exact ones do not depend on the triangles."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.moments import (
    moments_along,
    principal_axes,
    printed_covariance,
    surface_moments,
    surface_second_moment,
    vertex_mean,
)
from tests import distortions, shapes
from tests.bounds import EXACT, ROUNDING

BOX = np.array([260.0, 95.0, 70.0])


def box():
    vertices, faces = shapes.cube(100.0, 4)
    return vertices * BOX / 100.0, faces


def box_moment():
    """The second moment of a box's surface about its middle, over its area: a formula."""
    a, b, c = BOX
    pairs = [a * b, b * c, c * a]
    area = 2 * sum(pairs)
    # A side normal to an axis lies at half the extent; the four others spread over it evenly.
    diagonal = [
        (2 * b * c * a**2 / 4 + (area - 2 * b * c) * a**2 / 12) / area,
        (2 * a * c * b**2 / 4 + (area - 2 * a * c) * b**2 / 12) / area,
        (2 * a * b * c**2 / 4 + (area - 2 * a * b) * c**2 / 12) / area,
    ]
    return np.diag(diagonal)


def test_the_second_moment_of_a_box_is_the_formula():
    np.testing.assert_allclose(surface_second_moment(*box()), box_moment(), atol=ROUNDING)


def test_printed_equations_on_two_triangles_by_hand():
    vertices = np.array([[0.0, 0, 0], [6, 0, 0], [0, 3, 0], [0, 0, 3]])
    faces = np.array([[0, 1, 2], [0, 3, 1]])
    assert vertex_mean(vertices).tolist() == [1.5, 0.75, 0.75]
    # T_c1 = (2, 1, 0), T_c2 = (2, 0, 1), both of area 9, so T_c = (2, .5, .5)
    expected = [[0, 0, 0], [0, 0.25, -0.25], [0, -0.25, 0.25]]
    np.testing.assert_allclose(printed_covariance(vertices, faces), expected, atol=EXACT)


def test_half_subdivision_moves_the_printed_barycentre_and_not_the_centroid():
    vertices, faces = box()
    finer = distortions.half_subdivided(*distortions.half_subdivided(vertices, faces))
    assert np.linalg.norm(vertex_mean(finer[0]) - vertex_mean(vertices)) > 44.0  # measured 74
    assert (
        np.linalg.norm(surface_moments(*finer)[0] - surface_moments(vertices, faces)[0]) < ROUNDING
    )
    np.testing.assert_allclose(surface_second_moment(*finer), box_moment(), atol=ROUNDING)
    assert (
        np.abs(printed_covariance(*finer) - printed_covariance(vertices, faces)).max() > 3300.0
    )  # measured 5500


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), scale=st.floats(0.01, 100.0))
def test_the_exact_moment_turns_and_scales_with_the_shape(seed, scale):
    vertices, faces = box()
    pose = distortions.random_pose(np.random.default_rng(seed))
    R = pose[:3, :3]
    moved = distortions.moved(vertices * scale, pose)
    expected = R @ box_moment() @ R.T * scale**2
    np.testing.assert_allclose(
        surface_second_moment(moved, faces), expected, atol=ROUNDING * (scale**2 + 1.0)
    )


def test_principal_axes_are_rows_in_descending_order():
    values, rows = principal_axes(box_moment())
    assert values.tolist() == sorted(values.tolist(), reverse=True)
    np.testing.assert_allclose(np.abs(rows), np.eye(3), atol=EXACT)
    np.testing.assert_allclose(rows @ box_moment() @ rows.T, np.diag(values), atol=ROUNDING)


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_moments_stay_with_their_rows_in_any_order_and_with_any_signs(seed):
    rng = np.random.default_rng(seed)
    R = distortions.random_rotation(rng)
    order, signs = rng.permutation(3), rng.choice([-1.0, 1.0], 3)
    rows = (np.eye(3)[order] * signs[:, None]) @ R.T
    expected = box_moment().diagonal()[order]
    np.testing.assert_allclose(moments_along(R @ box_moment() @ R.T, rows), expected, atol=ROUNDING)


@pytest.mark.parametrize("vertices", [np.zeros((1, 3)), np.ones((4, 3))])
def test_the_mean_of_equal_vertices_is_the_vertex(vertices):
    assert vertex_mean(vertices).tolist() == vertices[0].tolist()
