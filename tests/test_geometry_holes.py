"""Small holes are closed as the surface goes on; openings, patches and closed meshes are left."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.caps import Facets, cap, extent_of
from footfit.geometry.mesh.holes import HOLES, closed_mesh
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import boundary_loops, is_closed
from tests import distortions, shapes
from tests.bounds import EXACT, ROUNDING
from tests.solids import is_consistently_wound, signed_volume
from tests.strategies import rotations, scales, shifts_mm
from tools.lasts import LastSpec, last_mesh

LENGTH_MM = 250.0


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(rings=60, segments=48))


def holed_sphere(radius_mm, seed=1, subdivisions=5):
    vertices, faces = shapes.sphere(50.0, subdivisions)
    return distortions.with_holes(vertices, faces, np.random.default_rng(seed), 1, radius_mm)


def caps_of(whole, vertices):
    return whole.vertices[len(vertices) :]


@pytest.mark.parametrize("radius_mm", [6.0, 12.0, 20.0])
@pytest.mark.parametrize("subdivisions", [4, 5])
def test_a_spheres_cap_is_the_spheres_to_a_seventh_of_what_a_flat_one_misses(
    radius_mm, subdivisions
):
    vertices, faces = holed_sphere(radius_mm, subdivisions=subdivisions)
    whole = closed_mesh(vertices, faces, LENGTH_MM)
    assert is_closed(whole.faces)
    assert is_consistently_wound(whole.faces)
    assert len(whole.extents) == 1
    flat_misses = 50.0 - np.sqrt(50.0**2 - radius_mm**2)
    away = np.linalg.norm(caps_of(whole, vertices), axis=1) - 50.0
    assert np.abs(away).max() < flat_misses / 7.0
    assert signed_volume(whole.vertices, whole.faces) == pytest.approx(
        signed_volume(*shapes.sphere(50.0, subdivisions)),
        rel=7.1e-4,  # measured 0.00047
    )


def test_noise_on_the_rim_does_not_make_a_cap_wild():
    vertices, faces = holed_sphere(15.0)
    noisy = distortions.white_noise(vertices, np.random.default_rng(2), 0.3)
    whole = closed_mesh(noisy, faces, LENGTH_MM)
    away = np.linalg.norm(caps_of(whole, vertices), axis=1) - 50.0
    assert np.abs(away).max() < 0.55  # measured 0.36


def test_a_cap_of_a_plane_lies_in_it():
    vertices, faces = shapes.flat_sheet(cells=60)
    middles = vertices[faces].mean(axis=1)
    keep = np.hypot(middles[:, 0] - 130.0, (middles[:, 1] - 50.0) / 0.6) > 22.0
    whole = closed_mesh(vertices, faces[keep], LENGTH_MM)
    cap = caps_of(whole, vertices)
    assert len(whole.extents) == 1
    assert np.abs(cap[:, 2]).max() < ROUNDING
    vectors = area_vectors(whole.vertices, whole.faces)
    assert vectors[:, 2].sum() == pytest.approx(260.0 * 100.0, rel=ROUNDING)


def test_a_closed_mesh_comes_back_as_it_is(last):
    whole = closed_mesh(*last, LENGTH_MM)
    assert whole.vertices is last[0]
    assert whole.faces is last[1]
    assert whole.extents == ()


def test_a_cut_leg_a_missing_sole_and_a_half_are_no_holes(last):
    vertices, faces = last
    sole = area_vectors(vertices, faces)[:, 2] < 0.0
    cut_at = np.array([130.0, 0.0, 0.0])
    for mesh in (
        distortions.leg_cut(vertices, faces, 60.0),
        (vertices, faces[~sole]),
        distortions.plane_cut(vertices, faces, cut_at, np.array([1.0, 0.0, 0.0])),
        distortions.plane_cut(vertices, faces, cut_at, np.array([-1.0, 0.0, 0.0])),
        distortions.plane_cut(vertices, faces, np.zeros(3), np.array([0.0, 1.0, 0.0])),
    ):
        assert boundary_loops(mesh[1])
        assert closed_mesh(*mesh, LENGTH_MM).extents == ()


def test_a_patch_that_lies_on_its_own_is_not_turned_into_a_body():
    whole = closed_mesh(*shapes.open_cap(40.0, 30.0), LENGTH_MM)
    assert whole.extents == ()


def test_a_mesh_whose_winding_breaks_at_the_rim_is_left_there():
    vertices, faces = holed_sphere(12.0, subdivisions=4)
    rim = np.isin(faces, boundary_loops(faces)[0]).any(axis=1)
    turned = faces.copy()
    turned[np.flatnonzero(rim)[::3]] = turned[np.flatnonzero(rim)[::3]][:, ::-1]
    whole = closed_mesh(vertices, turned, LENGTH_MM)
    assert np.isfinite(whole.vertices).all()


def test_of_thousands_of_holes_the_largest_are_closed():
    vertices, faces = shapes.sphere(60.0, 5)
    vertices, faces = distortions.with_holes(vertices, faces, np.random.default_rng(4), 90, 4.0)
    whole = closed_mesh(vertices, faces, LENGTH_MM)
    known = sorted((extent_of(vertices[rim]) for rim in whole.rims), reverse=True)
    assert len(whole.extents) == HOLES.most < len(known)
    assert whole.extents == pytest.approx(known[: HOLES.most])


@settings(max_examples=15, deadline=None)
@example(rotation=np.eye(3), shift=np.zeros(3), scale=1.0, seed=406193, mirror=False)
@given(
    rotation=rotations(),
    shift=shifts_mm(),
    scale=scales(),
    seed=st.integers(0, 2**32 - 1),
    mirror=st.booleans(),
)
def test_caps_move_with_the_mesh_whatever_its_order(last, rotation, shift, scale, seed, mirror):
    vertices, faces = distortions.with_holes(*last, np.random.default_rng(seed), 3, 10.0)
    home = closed_mesh(vertices, faces, LENGTH_MM)
    flip = np.array([1.0, -1.0, 1.0]) if mirror else np.ones(3)
    order = faces[:, ::-1] if mirror else faces
    there = (vertices * flip @ rotation.T + shift) * scale
    there = closed_mesh(
        *distortions.shuffled(there, order, np.random.default_rng(seed)), LENGTH_MM * scale
    )
    assert there.extents == pytest.approx([scale * extent for extent in home.extents])
    # A mirrored rim is walked the other way round: the same surface, its faces in another order.
    expected = _moments(home.vertices * flip @ rotation.T + shift, home.faces)
    # Moments are up to a million mm2, so that rounding is a share of them; measured: 6e-15.
    found = _moments(there.vertices / scale, there.faces)
    assert np.allclose(found, expected, atol=ROUNDING, rtol=EXACT)


def _moments(vertices, faces):
    areas = np.linalg.norm(area_vectors(vertices, faces), axis=1)
    middles = vertices[faces].mean(axis=1)
    return [areas.sum(), *(areas @ middles / areas.sum()), *(areas @ middles**2 / areas.sum())]


@pytest.mark.parametrize("waves", range(1, 9))
def test_a_cap_follows_six_waves_of_its_rim_and_no_finer_ones(waves):
    turn = _turn(96)
    rim = np.stack([50.0 * np.cos(turn), 50.0 * np.sin(turn), np.cos(waves * turn)], axis=1)
    around, away = np.meshgrid(turn, np.linspace(51.0, 65.0, 8))
    flat = np.stack([away * np.cos(around), away * np.sin(around), 0.0 * away], axis=-1)
    middles = flat.reshape(-1, 3)
    capped = cap(rim, Facets(middles, np.tile([0.0, 0.0, 1.0], (len(middles), 1))), 5.0)
    assert capped is not None
    highest = np.abs(capped[0][:, 2]).max()
    if waves <= 6:
        assert highest > 0.5  # of 1 at the rim; measured: 0.82 or more
    else:
        assert highest < 3.9e-5  # of the rim's even samples; measured: 2.0e-5


def _turn(count):
    return 2.0 * np.pi * np.arange(count) / count
