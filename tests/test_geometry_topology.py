"""Topology against trimesh, against counting, and against planted damage."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh import topology, welding
from footfit.geometry.mesh.welding import welded_vertices
from tests import shapes
from tests.distortions import joined, plane_cut, shuffled, soup
from tests.solids import euler_characteristic, is_consistently_wound, signed_volume
from tests.strategies import seeds, surfaces


@given(surfaces(), seeds)
@settings(max_examples=25, deadline=None)
def test_welding_a_soup_gives_the_mesh_back(mesh, seed):
    vertices, faces = shuffled(*mesh, np.random.default_rng(seed))
    loose, corners = soup(vertices, faces)
    found, welded_faces, source = welded_vertices(loose, corners)
    assert len(found) == len(np.unique(vertices, axis=0))
    np.testing.assert_array_equal(found[source], loose)
    np.testing.assert_array_equal(found[welded_faces], vertices[faces])
    assert len(np.unique(found, axis=0)) == len(found)


def test_welding_keeps_first_occurrences_in_order_and_minus_zero_is_zero():
    points = np.array([[3.0, 0, 0], [0.0, 1, 0], [3.0, -0.0, 0], [0.0, 1, 5e-324], [-0.0, 1, 0]])
    found, _, source = welded_vertices(points, np.array([[0, 1, 3]]))
    assert source.tolist() == [0, 1, 0, 2, 1]
    np.testing.assert_array_equal(found, points[[0, 1, 3]])


def test_welding_survives_equal_hashes(monkeypatch):
    monkeypatch.setattr(welding, "_MIX", np.zeros(3, dtype=np.uint64))
    vertices, faces = soup(*shapes.sphere(50.0, 1))
    found, _, source = welded_vertices(vertices, faces)
    assert len(found) == 42
    np.testing.assert_array_equal(found[source], vertices)


def test_nothing_at_all_is_no_accident():
    none, points = np.empty((0, 3), dtype=np.int64), np.empty((0, 3))
    assert len(welded_vertices(points, none)[0]) == 0
    assert len(topology.edges(none)) == len(topology.boundary_edges(none)) == 0
    assert topology.boundary_loops(none) == []
    assert len(topology.face_components(none, 0)) == 0
    assert not topology.is_closed(none)
    assert not topology.closed_fan_vertices(none, 4).any()
    assert len(topology.consistent_faces(none)) == 0


@pytest.mark.parametrize(
    ("mesh", "euler", "loops", "closed"),
    [
        (shapes.sphere(50.0, 2), 2, 0, True),
        (shapes.torus(60.0, 20.0, 24, 12), 0, 0, True),
        (shapes.cube(10.0, 4), 2, 0, True),
        (shapes.open_cap(50.0, 60.0, 6, 18), 1, 1, False),
        (shapes.flat_sheet(100.0, 40.0, 6), 1, 1, False),
        (joined(shapes.sphere(50.0, 1), shapes.torus(60.0, 20.0, 12, 8)), 2, 0, True),
    ],
)
def test_euler_boundary_and_closedness_of_known_shapes(mesh, euler, loops, closed):
    vertices, faces = mesh
    assert euler_characteristic(faces) == euler
    assert len(topology.boundary_loops(faces)) == loops
    assert topology.is_closed(faces) is closed
    assert is_consistently_wound(faces)
    peer = trimesh.Trimesh(vertices, faces, process=False)
    assert peer.is_watertight is closed
    assert len(topology.edges(faces)) == len(peer.edges_unique)


def test_a_cut_tube_has_two_loops_that_use_every_boundary_edge_once():
    vertices, faces = shapes.cylinder(40.0, 250.0, 24, 10)
    for height, direction in ((50.0, -1.0), (200.0, 1.0)):
        vertices, faces = plane_cut(
            vertices, faces, np.array([0.0, 0.0, height]), np.array([0.0, 0.0, direction])
        )
    loops = topology.boundary_loops(faces)
    assert len(loops) == 2
    around = [np.stack([loop, np.roll(loop, -1)], axis=1) for loop in loops]
    found = {tuple(pair) for pair in np.concatenate(around).tolist()}
    assert found == {tuple(pair) for pair in topology.boundary_edges(faces).tolist()}
    assert all(len(np.unique(loop)) == len(loop) for loop in loops)


def test_loops_that_touch_in_a_vertex_are_split_there():
    _, faces = shapes.flat_sheet(100.0, 40.0, 6)
    middle = np.unique(faces)[len(np.unique(faces)) // 2]
    around = np.flatnonzero((faces == middle).any(axis=1))
    # Two opposite faces around one vertex taken out: the hole's two loops meet there.
    near = faces[around[0]]
    far = next(f for f in around[1:] if len(np.intersect1d(faces[f], near)) == 1)
    holed = np.delete(faces, [around[0], far], axis=0)
    loops = topology.boundary_loops(holed)
    assert sorted(len(loop) for loop in loops)[:2] == [3, 3]
    assert len(loops) == 3


@given(st.lists(st.sampled_from([1, 2]), min_size=1, max_size=4), seeds)
@settings(max_examples=20, deadline=None)
def test_components_are_the_pieces_that_were_joined(sizes, seed):
    pieces = [shapes.sphere(10.0 * (k + 1), size) for k, size in enumerate(sizes)]
    vertices, faces = shuffled(*joined(*pieces), np.random.default_rng(seed))
    labels = topology.face_components(faces, len(vertices))
    radius = np.linalg.norm(vertices[faces[:, 0]], axis=1).round(6)
    assert len(np.unique(labels)) == len(sizes)
    assert len(np.unique(np.stack([labels, radius]), axis=1).T) == len(sizes)
    peer = trimesh.graph.connected_components(trimesh.Trimesh(vertices, faces, process=False).edges)
    assert len(peer) == len(sizes)


def test_a_long_strip_is_one_component():
    n = 3000
    order = np.random.default_rng(0).permutation(n + 2)
    strip = order[np.arange(n)[:, None] + np.arange(3)]
    assert topology.face_components(strip, n + 2).max() == 0


@given(surfaces(), seeds, st.floats(0.0, 0.45))
@settings(max_examples=25, deadline=None)
def test_turned_faces_are_turned_back_and_no_others(mesh, seed, share):
    vertices, faces = mesh
    rng = np.random.default_rng(seed)
    turned = rng.permutation(len(faces)) < share * len(faces)
    damaged = faces.copy()
    damaged[turned] = damaged[turned][:, ::-1]
    mended = topology.consistent_faces(damaged)
    assert is_consistently_wound(mended)
    assert signed_volume(vertices, mended) == pytest.approx(signed_volume(vertices, faces))


def test_each_piece_is_wound_by_its_own_majority():
    first, second = shapes.sphere(50.0, 1), shapes.sphere(20.0, 1)
    _, faces = joined(first, (second[0], second[1][:, ::-1]))
    damaged = faces.copy()
    damaged[[3, 100]] = damaged[[3, 100]][:, ::-1]
    mended = topology.consistent_faces(damaged)
    cyclic = [np.sort(np.stack([np.roll(f, -k, axis=1) for k in range(3)]), axis=0)[0]
              for f in (mended, faces)]  # fmt: skip
    np.testing.assert_array_equal(*cyclic)
    assert is_consistently_wound(mended)


def test_a_moebius_band_is_left_as_it_is():
    n = 12
    top, low = np.arange(n), np.arange(n) + n
    after_top, after_low = np.append(top[1:], low[0]), np.append(low[1:], top[0])
    band = np.concatenate(
        [np.stack([top, low, after_top], 1), np.stack([after_top, low, after_low], 1)]
    )
    np.testing.assert_array_equal(topology.consistent_faces(band), band)
    assert not is_consistently_wound(band)


def test_closed_fans_are_told_from_boundaries_bow_ties_and_third_faces():
    _, cap = shapes.open_cap(50.0, 60.0, 6, 18)
    n = int(cap.max()) + 1
    np.testing.assert_array_equal(
        topology.closed_fan_vertices(cap, n), ~topology.boundary_vertices(cap, n)
    )
    _, ball = shapes.sphere(50.0, 1)
    other = np.where(ball == 0, 0, ball + 100)  # two spheres that touch in vertex 0
    fans = topology.closed_fan_vertices(np.concatenate([ball, other]), 142)
    assert not fans[0]
    assert fans[1:42].all()
    fin = np.concatenate([ball, [[ball[0, 0], ball[0, 1], 50]]])
    assert not topology.closed_fan_vertices(fin, 51)[ball[0, :2]].any()
    wrong = ball.copy()
    wrong[0] = wrong[0][::-1]
    assert not topology.closed_fan_vertices(wrong, 42)[wrong[0]].any()
