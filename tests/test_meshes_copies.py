"""Compact copies: small, as near as they say, and never trusted when damaged."""

from __future__ import annotations

import dataclasses
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import CatalogueDamaged
from footfit.geometry.mesh.nearest import nearest_on_triangles
from footfit.geometry.mesh.topology import is_closed
from footfit.meshes.copies.compact_copy import COPY_SETTINGS, compact_copy, expanded_mesh
from footfit.meshes.copies.deviation import largest_deviation_mm
from tests import distortions, shapes
from tests.bounds import EXACT, ROUNDING
from tests.solids import signed_volume

FOOT = shapes.ellipsoid((125.0, 50.0, 40.0), subdivisions=4)  # 5,120 faces


def nearest(points, vertices, faces):
    """From each point to the mesh, by trying every triangle: (p,)."""
    best = np.full(len(points), np.inf)
    for corners in vertices[faces]:
        repeated = np.broadcast_to(corners, (len(points), 3, 3))
        best = np.minimum(best, nearest_on_triangles(points, repeated)[2])
    return np.sqrt(best)


def test_a_copy_without_decimation_differs_by_the_step_alone():
    vertices, faces = shapes.torus(around=48, across=24)
    copy = compact_copy(vertices, faces)
    found, triangles = expanded_mesh(copy.data)
    assert (len(found), len(triangles), copy.faces) == (len(vertices), len(faces), len(faces))
    gaps = np.linalg.norm(found[:, None] - vertices[None], axis=2).min(axis=1)
    assert gaps.max() <= np.sqrt(3.0) * COPY_SETTINGS.step_mm / 2.0 + 1e-12
    assert copy.error_mm <= gaps.max() + 1e-12
    assert is_closed(triangles)
    volume = signed_volume(vertices, faces)
    assert signed_volume(found, triangles) == pytest.approx(volume, rel=2.9e-5)  # measured 1.9e-05


def test_a_decimated_copy_is_small_and_as_near_as_it_says():
    pose = distortions.random_pose(np.random.default_rng(2))
    vertices, faces = distortions.moved(FOOT[0], pose), FOOT[1]
    copy = compact_copy(vertices, faces, target_faces=1_500)
    found, triangles = expanded_mesh(copy.data)
    assert copy.faces == len(triangles) <= 1_500
    assert len(copy.data) < 6 * len(triangles)
    assert copy.error_mm <= COPY_SETTINGS.error_mm
    shares = np.random.default_rng(0).dirichlet([1.0, 1.0, 1.0], len(triangles))
    inside = np.einsum("fc,fcx->fx", shares, found[triangles])
    sampled = max(
        nearest(vertices[::5], found, triangles).max(),
        nearest(inside[::4], vertices, faces).max(),
    )
    assert sampled <= copy.error_mm * 1.15  # between samples it may be a little more
    assert copy.error_mm <= 2.0 * sampled  # measured 1.04


def test_a_target_that_deviates_too_far_is_raised(monkeypatch):
    tight = dataclasses.replace(COPY_SETTINGS, error_mm=0.05)
    monkeypatch.setattr("footfit.meshes.copies.compact_copy.COPY_SETTINGS", tight)
    copy = compact_copy(*FOOT, target_faces=500)
    assert copy.faces > 3000  # measured 5100
    assert copy.error_mm <= 0.0051  # measured 0.0034


def test_the_same_mesh_in_another_order_gives_the_same_bytes():
    vertices, faces = shapes.ellipsoid(subdivisions=3)
    other = distortions.shuffled(vertices, faces, np.random.default_rng(1))
    soup = distortions.soup(vertices, faces)
    assert compact_copy(vertices, faces).data == compact_copy(*other).data
    assert compact_copy(vertices, faces).data == compact_copy(*soup).data


def test_the_deviation_is_the_planted_one():
    vertices, faces = shapes.sphere(50.0, 4)
    assert largest_deviation_mm(vertices, faces, vertices, faces) < EXACT
    grown = vertices * (50.7 / 50.0)
    found = largest_deviation_mm(vertices, faces, grown, faces)
    assert found == pytest.approx(0.7, abs=ROUNDING)
    dented = vertices.copy()
    dented[100] *= 0.9
    # measured 0.00094
    assert largest_deviation_mm(vertices, faces, dented, faces) == pytest.approx(5.0, rel=0.0015)


def test_big_facets_are_looked_at_in_many_places():
    vertices, faces = shapes.cube(200.0, 1)
    cut = np.append(vertices, [[0.0, 0.0, 0.0]], axis=0)
    cut[-1] = vertices[faces[0]].mean(axis=0) * 0.95  # a dent in the middle of one facet
    a, b, c, new = *faces[0], len(vertices)
    dented = np.vstack([faces[1:], [[a, b, new], [b, c, new], [c, a, new]]])
    depth = nearest(cut[-1:], vertices, faces)[0]
    assert depth > 3.0  # measured 5
    assert largest_deviation_mm(vertices, faces, cut, dented) == pytest.approx(depth, rel=ROUNDING)


@given(
    point=st.lists(st.floats(-50, 50), min_size=3, max_size=3),
    corners=st.lists(st.floats(-50, 50), min_size=9, max_size=9),
)
@settings(max_examples=150, deadline=None)
def test_point_to_triangle_is_the_nearest_of_many_points(point, corners):
    point, corners = np.array(point), np.array(corners).reshape(3, 3)
    steps = np.linspace(0.0, 1.0, 41)
    grid = np.array([(u, v, 1.0 - u - v) for u in steps for v in steps if u + v <= 1.0 + 1e-9])
    dense = np.linalg.norm(grid @ corners - point, axis=1).min()
    found = np.sqrt(nearest_on_triangles(point[None], corners[None])[2][0])
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).max()
    assert found <= dense + ROUNDING
    # no point of a triangle is farther from all corners than its longest side over sqrt(3)
    assert found >= dense - longest / 40.0 / np.sqrt(3.0) - ROUNDING


COPY = compact_copy(*shapes.ellipsoid(subdivisions=2)).data


@given(data=st.data())
@settings(max_examples=200, deadline=None)
def test_damaged_bytes_are_found_or_harmless(data):
    damaged = bytearray(COPY)
    for _ in range(data.draw(st.integers(1, 3))):
        damaged[data.draw(st.integers(0, len(COPY) - 1))] ^= data.draw(st.integers(1, 255))
    cut = bytes(damaged[: data.draw(st.integers(0, len(COPY)) | st.just(len(COPY)))])
    try:
        vertices, faces = expanded_mesh(cut)
    except CatalogueDamaged:
        return
    assert np.isfinite(vertices).all()
    assert faces.min() >= 0
    assert faces.max() < len(vertices)


def test_every_cut_is_found():
    for length in range(0, len(COPY), 37):
        with pytest.raises(CatalogueDamaged):
            expanded_mesh(COPY[:length])
    with pytest.raises(CatalogueDamaged):
        expanded_mesh(COPY + b"more")


def test_a_copy_that_promises_too_much_is_refused_before_it_is_expanded():
    header = struct.pack("<4sBxxxIId3d", b"ffmc", 1, 10**7, 10**7, 0.005, 0.0, 0.0, 0.0)
    with pytest.raises(CatalogueDamaged, match="counts"):
        expanded_mesh(header + zlib.compress(bytes(100)))
    bomb = struct.pack("<4sBxxxIId3d", b"ffmc", 1, 3, 1, 0.005, 0.0, 0.0, 0.0)
    with pytest.raises(CatalogueDamaged, match="length"):
        expanded_mesh(bomb + zlib.compress(bytes(10**7)))
