"""The test shapes and distortions keep the truths that their docstrings state."""

from __future__ import annotations

import numpy as np
import pytest

from tests import distortions, shapes
from tests.bounds import EXACT


def edge_counts(faces):
    sides = np.sort(np.stack([faces, np.roll(faces, -1, 1)], 2).reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0, return_counts=True)


def euler(faces):
    return len(np.unique(faces)) - len(edge_counts(faces)[0]) + len(faces)


def is_closed_and_wound(faces):
    """Every directed edge once, and its reverse once."""
    directed = np.stack([faces, np.roll(faces, -1, 1)], 2).reshape(-1, 2)
    unique = np.unique(directed, axis=0)
    reverse = np.unique(directed[:, ::-1], axis=0)
    return len(unique) == len(directed) and np.array_equal(unique, reverse)


def cross(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def area(vertices, faces):
    return np.linalg.norm(cross(vertices, faces), axis=1).sum() / 2


def volume(vertices, faces):
    return np.einsum("ij,ij->", cross(vertices, faces), vertices[faces].mean(axis=1)) / 6


CLOSED = {
    "tetrahedron": (shapes.tetrahedron(), 2),
    "cube": (shapes.cube(), 2),
    "odd cube": (shapes.cube(cells=5), 2),
    "sphere": (shapes.sphere(), 2),
    "ellipsoid": (shapes.ellipsoid(), 2),
    "torus": (shapes.torus(), 0),
    "cylinder": (shapes.cylinder(), 2),
    "hand": (shapes.hand(), 2),
    "convex_cloud": (shapes.convex_cloud(500, np.random.default_rng(1)), 2),
}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes_are_closed_outward_and_of_their_genus(name):
    (vertices, faces), expected = CLOSED[name]
    assert is_closed_and_wound(faces)
    assert euler(faces) == expected
    assert volume(vertices, faces) > 0
    assert np.linalg.norm(cross(vertices, faces), axis=1).min() > 0


@pytest.mark.parametrize(
    ("mesh", "boundary_edges", "expected"),
    [
        (shapes.flat_sheet(cells=40), 160, 1),
        (shapes.open_cap(around=72), 72, 1),
        (shapes.shin(around=80), 160, 0),
    ],
)
def test_open_shapes_have_the_boundary_they_state(mesh, boundary_edges, expected):
    _, counts = edge_counts(mesh[1])
    assert counts.max() == 2
    assert (counts == 1).sum() == boundary_edges
    assert euler(mesh[1]) == expected


def test_open_shapes_face_outward():
    assert (cross(*shapes.flat_sheet())[:, 2] > 0).all()
    for vertices, faces, out in [(*shapes.open_cap(), [1, 1, 1]), (*shapes.shin(), [1, 1, 0])]:
        middles = vertices[faces].mean(axis=1) * out
        assert (np.einsum("ij,ij->i", cross(vertices, faces), middles) > 0).all()


def test_exact_areas_and_volumes():
    e = 70.0
    assert area(*shapes.tetrahedron(e)) == pytest.approx(np.sqrt(3) * e**2)
    assert volume(*shapes.tetrahedron(e)) == pytest.approx(e**3 / (6 * np.sqrt(2)))
    assert area(*shapes.cube(e)) == pytest.approx(6 * e**2)
    assert volume(*shapes.cube(e)) == pytest.approx(e**3)
    n, r, h = 96, 40.0, 250.0
    base, side = n * r**2 * np.sin(2 * np.pi / n) / 2, 2 * r * np.sin(np.pi / n)
    assert volume(*shapes.cylinder(r, h, n)) == pytest.approx(base * h)
    assert area(*shapes.cylinder(r, h, n)) == pytest.approx(2 * base + n * side * h)


@pytest.mark.parametrize(
    ("coarse", "fine", "truth"),
    [
        (shapes.sphere(50, 3), shapes.sphere(50, 4), 4 / 3 * np.pi * 50**3),
        (
            shapes.ellipsoid((90, 40, 30), 3),
            shapes.ellipsoid((90, 40, 30), 4),
            4 / 3 * np.pi * 90 * 40 * 30,
        ),
        (
            shapes.torus(60, 20, 48, 24),
            shapes.torus(60, 20, 96, 48),
            2 * np.pi**2 * 60 * 20**2,
        ),
    ],
)
def test_inscribed_volumes_converge_with_the_square_of_the_edge(coarse, fine, truth):
    miss, less = (1 - volume(*mesh) / truth for mesh in (coarse, fine))
    assert 0 < less < miss
    assert miss / less == pytest.approx(4, rel=0.0065)  # measured 0.0043


def test_curvature_formulas_agree_on_the_sphere_and_with_gauss_bonnet():
    k1, k2 = shapes.ellipsoid_curvatures(shapes.sphere(50)[0], (50, 50, 50))
    np.testing.assert_allclose(k1, 1 / 50, rtol=6e-8)  # measured 3.1e-8
    np.testing.assert_allclose(k2, 1 / 50, rtol=6e-8)  # measured 3.1e-8
    for mesh, curvatures, total in [
        (
            shapes.ellipsoid((60, 45, 35), 5),
            lambda v: shapes.ellipsoid_curvatures(v, (60, 45, 35)),
            4 * np.pi,
        ),
        (shapes.torus(60, 20, 200, 100), lambda v: shapes.torus_curvatures(v, 60, 20), 0.0),
    ]:
        k1, k2 = curvatures(mesh[0])
        a = np.linalg.norm(cross(*mesh), axis=1) / 2
        # measured 0.0047
        assert (a * (k1 * k2)[mesh[1]].mean(axis=1)).sum() == pytest.approx(total, abs=0.0071)


def test_two_feet_are_mirror_twins_with_a_gap():
    vertices, faces = shapes.cube(100)
    both, both_faces = shapes.two_feet(vertices, faces, gap_mm=40)
    assert np.ptp(both[:, 1]) == pytest.approx(240)
    assert volume(both, both_faces) == pytest.approx(2e6)
    assert is_closed_and_wound(both_faces)


# ------------------------------------------------------------------ distortions


@pytest.fixture
def rng():
    return np.random.default_rng(7)


def test_a_pose_is_rigid_and_poses_cover_all_directions(rng):
    poses = np.array([distortions.random_pose(rng) for _ in range(2000)])
    rotations = poses[:, :3, :3]
    np.testing.assert_allclose(
        rotations @ rotations.transpose(0, 2, 1), np.eye(3)[None].repeat(2000, 0), atol=EXACT
    )
    np.testing.assert_allclose(np.linalg.det(rotations), 1)
    assert np.abs(rotations.mean(axis=0)).max() < 0.026  # a uniform rotation has mean 0
    np.testing.assert_allclose((rotations**2).mean(axis=0), 1 / 3, atol=0.025)  # measured 0.017


@pytest.mark.parametrize(("axis", "start", "end"), [("x", 1, 2), ("y", 2, 0), ("z", 0, 1)])
def test_axis_rotation_is_right_handed(axis, start, end):
    turned = distortions.moved(np.eye(3), distortions.axis_rotation(axis, 90))
    np.testing.assert_allclose(turned[start], np.eye(3)[end], atol=1e-15)


@pytest.mark.parametrize("factor", [1, 4])
def test_mirror_shuffle_and_soup_keep_the_solid(factor, rng):
    vertices, faces = shapes.ellipsoid((100, 40 / factor, 30))
    truth = volume(vertices, faces)
    for mesh in (
        distortions.mirrored(vertices, faces),
        distortions.shuffled(vertices, faces, rng),
        distortions.soup(vertices, faces),
    ):
        assert volume(*mesh) == pytest.approx(truth)
    assert volume(*distortions.inside_out(vertices, faces)) == pytest.approx(-truth)
    assert is_closed_and_wound(distortions.shuffled(vertices, faces, rng)[1])


def test_units_are_the_exact_ones():
    assert distortions.in_metres(np.array([270.0])) == pytest.approx(0.27)
    assert distortions.in_inches(np.array([254.0])) == pytest.approx(10)


def test_white_noise_has_its_standard_deviation(rng):
    moved = distortions.white_noise(np.zeros((20000, 3)), rng, 0.3)
    np.testing.assert_allclose(moved.std(axis=0), 0.3, rtol=0.015)  # measured 0.0084


def test_the_ripple_has_its_size_and_moves_neighbours_together(rng):
    vertices, faces = shapes.sphere(100, 6)
    fields = []
    for _ in range(12):
        rippled = distortions.rippled(vertices, faces, rng, 0.3, wavelength_mm=10)
        fields.append(np.linalg.norm(rippled, axis=1) - 100)
    height = np.array(fields)
    assert height.std() == pytest.approx(0.3, rel=2e-4)  # measured 0.00013
    pairs = edge_counts(faces)[0]
    edge_mm = np.linalg.norm(np.diff(vertices[pairs], axis=1)[:, 0], axis=1).mean()
    x = 2 * np.pi * edge_mm / 10
    correlation = (height[:, pairs[:, 0]] * height[:, pairs[:, 1]]).mean() / height.var()
    assert correlation == pytest.approx(np.sin(x) / x, abs=0.0021)  # the field's own law


def test_a_leg_cut_is_exact_open_and_below_its_height(rng):
    vertices, faces = shapes.cylinder(40, 250, 96, 60)
    cut, cut_faces = distortions.leg_cut(vertices, faces, 101.3)
    assert cut[:, 2].max() == pytest.approx(101.3)
    n = 96
    base, side = n * 40**2 * np.sin(2 * np.pi / n) / 2, 2 * 40 * np.sin(np.pi / n)
    assert area(cut, cut_faces) == pytest.approx(base + n * side * 101.3)
    _, counts = edge_counts(cut_faces)
    assert counts.max() == 2
    assert euler(cut_faces) == 1
    tilted = distortions.plane_cut(
        vertices, faces, np.array([0, 0, 125.0]), np.array([0.3, 0.2, 0.9])
    )
    other = distortions.plane_cut(
        vertices, faces, np.array([0, 0, 125.0]), -np.array([0.3, 0.2, 0.9])
    )
    assert area(*tilted) + area(*other) == pytest.approx(area(vertices, faces))


def test_a_plane_through_vertices_cuts_without_slivers():
    vertices, faces = shapes.cube(100, cells=4)
    cut = distortions.leg_cut(vertices, faces, 50.0)
    assert area(*cut) == pytest.approx(3e4)
    assert np.linalg.norm(cross(*cut), axis=1).min() > 0
    assert euler(cut[1]) == 1


def test_a_cut_that_misses_changes_nothing():
    vertices, faces = shapes.cube()
    np.testing.assert_array_equal(distortions.leg_cut(vertices, faces, 500.0)[1], faces)


def test_holes_take_away_what_is_near(rng):
    vertices, faces = shapes.sphere(50, 5)
    holed, holed_faces = distortions.with_holes(vertices, faces, rng, 3, 10.0)
    lost = area(vertices, faces) - area(holed, holed_faces)
    assert 0.8 * np.pi * 100 < lost < 3.3 * np.pi * 100
    assert (edge_counts(holed_faces)[1] == 1).any()


@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 1.0])
def test_subdivision_moves_nothing_and_opens_nothing(share, rng):
    vertices, faces = shapes.ellipsoid((100, 40, 30), 3)
    chosen = rng.uniform(size=len(faces)) < share
    finer = distortions.subdivided(vertices, faces, chosen)
    assert area(*finer) == pytest.approx(area(vertices, faces))
    assert volume(*finer) == pytest.approx(volume(vertices, faces))
    assert is_closed_and_wound(finer[1])
    assert len(finer[1]) >= len(faces) + 3 * chosen.sum()


def test_half_subdivision_splits_one_half_in_four():
    vertices, faces = shapes.sphere(50, 4)
    finer = distortions.half_subdivided(vertices, faces)[1]
    assert len(finer) / len(faces) == pytest.approx(2.5)


def test_decimation_keeps_the_solid():
    vertices, faces = shapes.ellipsoid((100, 40, 30), 5)
    fewer = distortions.decimated(vertices, faces, 4)
    assert len(fewer[1]) == pytest.approx(len(faces) / 4, rel=2e-3)  # a face or two
    assert volume(*fewer) == pytest.approx(volume(vertices, faces), rel=0.0011)  # measured 0.00073


def test_a_floor_plate_lies_under_the_shape_and_is_open():
    vertices, faces = shapes.sphere(50, 5)
    both, both_faces = distortions.floor_plate(vertices, faces, 40, 5)
    extra = both[len(vertices) :]
    assert np.ptp(extra[:, 2]) == 0
    assert extra[0, 2] == vertices[:, 2].min()
    assert np.ptp(extra[:, 0]) >= 180
    plate = both_faces[len(faces) :]
    assert (cross(both, plate)[:, 2] > 0).all()
    hole = 180 * 180 - area(both, plate)
    assert 0.6 * np.pi * 475 < hole < 1.3 * np.pi * 475 + 500  # the sphere's rim at 5 mm height
