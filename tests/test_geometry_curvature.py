"""III.C against a slow reference, pooling against truth, both under the laws they must obey."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from footfit.geometry.curvature.one_ring import PrincipalCurvatures, one_ring_curvature
from footfit.geometry.curvature.pooled_curvature import (
    POOLING,
    longest_radius,
    pooled_curvature,
)
from footfit.geometry.mesh.topology import boundary_vertices
from footfit.geometry.mesh.welding import welded_vertices
from footfit.geometry.numeric.angles import angle_between
from footfit.geometry.numeric.polylines import curvature_density
from tests import implicit, shapes
from tests.bounds import EXACT, ROUNDING
from tests.distortions import (
    decimated,
    half_subdivided,
    joined,
    mirrored,
    random_rotation,
    shuffled,
    soup,
    subdivided,
    white_noise,
    with_holes,
)
from tests.strategies import rotations, scales, seeds, shifts_mm, surfaces

FIELDS = ("k1", "k2", "mean", "gaussian")
RADIUS = 15.0


# ---------------------------------------------------------------- one ring (III.C)


def _slow_one_ring(vertices: np.ndarray, faces: np.ndarray, density: bool) -> np.ndarray:
    """III.C word for word, one vertex at a time: k1, k2, mean (3, n)."""
    rim = boundary_vertices(faces, len(vertices))
    out = np.full((3, len(vertices)), np.nan)
    for p in np.flatnonzero(~rim):
        star = faces[(faces == p).any(axis=1)]
        corners = vertices[star]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal = np.mean(normals / np.linalg.norm(normals, axis=1)[:, None], axis=0)
        normal /= np.linalg.norm(normal)
        link = [tuple(np.roll(face, -list(face).index(p))[1:]) for face in star]
        values = [_slow_normal_curvature(vertices, p, v, link, normal, density) for v, _ in link]
        known = [value for value in values if value is not None]
        if known:
            out[:, p] = min(known), max(known), np.mean(known)
    return out


def _slow_normal_curvature(vertices, p, v, link, normal, density):
    ray = vertices[v] - vertices[p]
    across = np.cross(normal, ray)
    best, found = -np.inf, None
    for a, b in link:
        qa, qb = vertices[a] - vertices[p], vertices[b] - vertices[p]
        sa, sb = qa @ across, qb @ across
        if v in (a, b) or (sa < 0) == (sb < 0):
            continue
        w = qa + sa / (sa - sb) * (qb - qa)
        flat = ray - (ray @ normal) * normal
        back = -(w @ flat) / np.linalg.norm(flat) / np.linalg.norm(w)
        if w @ flat < 0 and back > best:
            best, found = back, w
    if found is None:
        return None
    gamma = angle_between(ray, found)
    middle = ray / np.linalg.norm(ray) + found / np.linalg.norm(found)  # inside the angle at p
    value = (np.pi - gamma) * (1.0 if middle @ normal < 0 else -1.0)
    return value / (0.5 * (np.linalg.norm(ray) + np.linalg.norm(found))) if density else value


@given(surfaces())
@settings(max_examples=8, deadline=None)
def test_one_ring_is_the_papers_construction(mesh):
    vertices, faces = mesh
    for density in (False, True):
        found = one_ring_curvature(vertices, faces, density)
        slow = _slow_one_ring(vertices, faces, density)
        for field, expected in zip((found.k1, found.k2, found.mean), slow, strict=True):
            np.testing.assert_allclose(field, expected, atol=ROUNDING)
        np.testing.assert_allclose(found.gaussian, slow[0] * slow[1], atol=ROUNDING)


def test_one_ring_on_a_regular_octahedron_by_hand():
    # At each corner gamma is the right angle between opposite neighbours: pi - gamma = pi / 2.
    v = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    upper = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    faces = np.array(upper + [[b, a, 5] for a, b, _ in upper])
    found = one_ring_curvature(v, faces, density=False)
    for field in (found.k1, found.k2, found.mean):
        np.testing.assert_allclose(field, np.pi / 2)
    np.testing.assert_allclose(one_ring_curvature(v, faces).mean, np.pi / 2 / np.sqrt(2.0))


def test_one_ring_signs_saddles_and_boundaries():
    vertices, faces = shapes.torus(60.0, 20.0, 96, 48)
    k1, k2 = shapes.torus_curvatures(vertices, 60.0, 20.0)
    found = one_ring_curvature(vertices, faces)
    # The planes of a regular mesh hold the principal directions: exact up to the edges' squares.
    assert np.quantile(np.abs(found.k2 - k2) * 20.0, 0.95) < 0.0012  # measured 0.00075
    assert np.median(np.abs(found.k1 - k1)) * 20.0 < 0.019  # measured 0.013
    inner = k1 < -0.002
    assert (found.k1[inner] < 0).all()
    cap, cap_faces = shapes.open_cap(50.0, 60.0, 10, 30)
    rim = boundary_vertices(cap_faces, len(cap))
    for name in FIELDS:
        np.testing.assert_array_equal(
            np.isnan(getattr(one_ring_curvature(cap, cap_faces), name)), rim
        )


def test_flipping_the_faces_flips_the_sign_and_exchanges_k1_and_k2():
    vertices, faces = shapes.torus(60.0, 20.0, 28, 14)
    for kind in (one_ring_curvature, lambda v, f: pooled_curvature(v, f, RADIUS)):
        out, back = kind(vertices, faces), kind(vertices, faces[:, ::-1])
        np.testing.assert_allclose(back.k1, -out.k2, atol=EXACT)
        np.testing.assert_allclose(back.k2, -out.k1, atol=EXACT)
        np.testing.assert_allclose(back.mean, -out.mean, atol=EXACT)


def test_the_sum_of_k1_k2_is_no_gauss_bonnet():
    """The concentrated curvatures' product is 15.0 on a sphere, and 4 pi is 12.57 (Eq. 11)."""
    vertices, faces = shapes.sphere(50.0, 4)
    product = one_ring_curvature(vertices, faces, density=False).gaussian.sum()
    assert product > 1.1 * 4 * np.pi


# ---------------------------------------------------------------- the laws, both kinds


def _pooled(vertices, faces, scale=1.0) -> PrincipalCurvatures:
    return pooled_curvature(vertices, faces, RADIUS * scale)


def _ring(vertices, faces, scale=1.0) -> PrincipalCurvatures:
    return one_ring_curvature(vertices, faces)


def _assert_same(found, expected, atol=1e-7):
    for name in FIELDS:
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), atol=atol)


@pytest.mark.parametrize("kind", [_pooled, _ring])
@given(surfaces(), rotations(), shifts_mm(), scales())
@settings(max_examples=12, deadline=None)
def test_rotation_and_shift_keep_and_scale_divides(kind, mesh, rotation, shift, scale):
    vertices, faces = mesh
    still = kind(vertices, faces)
    moved = kind(scale * (vertices @ rotation.T + shift), faces, scale)
    for name, power in (("k1", 1), ("k2", 1), ("mean", 1), ("gaussian", 2)):
        np.testing.assert_allclose(
            getattr(moved, name) * scale**power, getattr(still, name), atol=ROUNDING
        )


@pytest.mark.parametrize("kind", [_pooled, _ring])
@given(surfaces(), seeds)
@settings(max_examples=12, deadline=None)
def test_a_mirror_and_another_order_change_nothing(kind, mesh, seed):
    vertices, faces = mesh
    still = kind(vertices, faces)
    _assert_same(kind(*mirrored(vertices, faces)), still)
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(vertices))
    place = np.argsort(order)
    other = rng.permutation(np.roll(place[faces], 1, axis=1))
    mixed = kind(vertices[order], other)
    for name in FIELDS:
        np.testing.assert_allclose(getattr(mixed, name)[place], getattr(still, name), atol=ROUNDING)


@given(surfaces(), seeds)
@settings(max_examples=10, deadline=None)
def test_duplicate_vertices_change_nothing_after_the_weld(mesh, seed):
    vertices, faces = shuffled(*mesh, np.random.default_rng(seed))
    still = pooled_curvature(vertices, faces, RADIUS)
    merged, merged_faces, source = welded_vertices(*soup(vertices, faces))
    found = pooled_curvature(merged, merged_faces, RADIUS)
    np.testing.assert_allclose(found.mean[source], still.mean[faces.ravel()], atol=ROUNDING)


# ---------------------------------------------------------------- at a scale: truth


def _error(found, truth) -> tuple[float, float]:
    """Median errors of k1 and k2 over max(|k1|, |k2|)."""
    size = np.maximum(np.abs(truth[0]), np.abs(truth[1]))
    pairs = zip((found.k1, found.k2), truth, strict=True)
    return tuple(float(np.nanmedian(np.abs(k - t) / size)) for k, t in pairs)


def _uneven_sphere(count=4000, seed=0):
    return shapes.convex_cloud(count, np.random.default_rng(seed))


@pytest.mark.parametrize("radius", [4.0, 8.0, 16.0, 32.0])
def test_a_sphere_is_exact_at_any_radius_up_to_its_mesh(radius):
    vertices, faces = _uneven_sphere()
    truth = np.full((2, len(vertices)), 1 / 50.0)
    assert max(_error(pooled_curvature(vertices, faces, radius), truth)) < 0.0055  # measured 0.0037
    assert (
        np.quantile(np.abs(pooled_curvature(vertices, faces, radius).mean * 50 - 1), 0.99) < 0.019
    )  # measured 0.012


@pytest.mark.parametrize("radius", [10.0, 30.0])
def test_a_cylinders_wall_is_exact_even_where_the_radius_is_near_its_own(radius):
    vertices, faces = shapes.cylinder(40.0, 400.0, 96, 150)
    wall = np.abs(vertices[:, 2] - 200.0) < 60.0
    found = pooled_curvature(vertices, faces, radius)
    np.testing.assert_allclose(found.k1[wall] * 40.0, 0.0, atol=ROUNDING)
    np.testing.assert_allclose(found.k2[wall] * 40.0, 1.0, atol=ROUNDING)


def test_torus_and_ellipsoid_at_a_scale():
    vertices, faces = shapes.torus(60.0, 20.0, 192, 96)
    found = pooled_curvature(vertices, faces, 8.0)
    assert (
        max(_error(found, shapes.torus_curvatures(vertices, 60.0, 20.0))) < 5.7e-4
    )  # measured 0.00038
    radii = (60.0, 45.0, 35.0)
    vertices, faces = shapes.convex_cloud(4000, np.random.default_rng(1), radii)
    found = pooled_curvature(vertices, faces, 10.0)
    assert (
        max(_error(found, shapes.ellipsoid_curvatures(vertices, radii))) < 0.0072
    )  # measured 0.0048


@pytest.mark.parametrize("profile", [implicit.bumpy(), implicit.rounded_cube()])
def test_implicit_curvatures_are_those_of_finite_differences_of_the_normal(profile):
    """The oracle's oracle: the normal's change along two tangents, 1e-4 mm wide."""
    points, _ = implicit.irregular(50, np.random.default_rng(0), profile)
    normal = profile(points)[1] / np.linalg.norm(profile(points)[1], axis=1)[:, None]
    k1, k2 = implicit.curvatures(points, profile)
    for p, n, low, high in zip(points, normal, k1, k2, strict=True):
        basis = np.linalg.svd(n[None])[2][1:]
        ahead, behind = (profile(p + step * basis)[1] for step in (1e-4, -1e-4))
        ahead, behind = (g / np.linalg.norm(g, axis=1)[:, None] for g in (ahead, behind))
        np.testing.assert_allclose(
            np.linalg.eigvalsh((ahead - behind) @ basis.T / 2e-4), [low, high], atol=ROUNDING
        )


@pytest.mark.parametrize(
    ("profile", "most"), [(implicit.bumpy(), 0.01), (implicit.rounded_cube(), 0.03)]
)
def test_bumps_hollows_and_rounded_corners_come_out_at_a_scale(profile, most):
    vertices, faces = implicit.irregular(8000, np.random.default_rng(5), profile)
    sides = vertices[np.roll(faces, 1, axis=1)] - vertices[faces]
    edge = np.linalg.norm(sides, axis=2).mean()
    truth = implicit.curvatures(vertices, profile)
    assert max(_error(pooled_curvature(vertices, faces, 5 * edge), truth)) < most


@pytest.mark.parametrize("radius", [9.0, 12.0, 18.0, 24.0])
def test_of_a_wave_no_more_is_smoothed_away_than_two_widths_leave(radius):
    """Heat leaves exp(-t l) of a wave; two widths lose (t l)^2 / 2 where one loses t l."""
    vertices, faces = shapes.flat_sheet(240.0, 240.0, 240)
    depth, rate = 1e-3, (2.0 * np.pi / 60.0) ** 2
    vertices[:, 2] = depth * np.cos(np.sqrt(rate) * vertices[:, 0])
    crest = np.hypot(vertices[:, 0] - 120.0, vertices[:, 1] - 120.0) < 1e-6
    found = pooled_curvature(vertices, faces, radius).k2[crest]
    lost = 1.0 - float(found[0]) / (depth * rate)
    x, wider = 0.5 * (radius / POOLING.radius_over_deviation) ** 2 * rate, POOLING.wider
    expected = 1.0 - (wider * np.exp(-x) - np.exp(-wider * x)) / (wider - 1.0)
    assert lost < expected + 0.01 < 0.55 * (1.0 - np.exp(-x))


def test_even_and_uneven_spheres_read_their_radius_to_a_thousandth():
    """Centroids of facets lie under the surface: left there they read a third of (edge / R)^2."""
    even, uneven = shapes.sphere(50.0, 4), _uneven_sphere()
    for vertices, faces in (even, uneven):
        mean = pooled_curvature(vertices, faces, 15.0).mean * 50.0
        assert abs(np.median(mean) - 1.0) < 1e-3


@pytest.mark.parametrize("share", [0.001, 0.003])
def test_noise_is_pooled_away_where_one_ring_drowns(share):
    vertices, faces = _uneven_sphere(6000)
    edge = np.sqrt(4 * np.pi * 50.0**2 / 6000 * 2 / np.sqrt(3))
    noisy = white_noise(vertices, np.random.default_rng(2), share * 100.0)
    truth = np.full((2, len(vertices)), 1 / 50.0)
    pooled = max(_error(pooled_curvature(noisy, faces, 8 * edge), truth))
    assert pooled < 30.0 * share  # .03 at .1 %, .09 at .3 %
    assert max(_error(one_ring_curvature(noisy, faces), truth)) > 20.0 * pooled


def test_libigl_at_the_same_radius_errs_more():
    igl = pytest.importorskip("igl", reason="libigl is a benchmark-only peer")
    vertices, faces = _uneven_sphere(4000)
    noisy = white_noise(vertices, np.random.default_rng(3), 0.1)
    sides = vertices[np.roll(faces, 1, axis=1)] - vertices[faces]
    edge = np.linalg.norm(sides, axis=2).mean()
    truth = np.full((2, len(vertices)), 1 / 50.0)
    ours = _error(pooled_curvature(noisy, faces, 5 * edge), truth)
    peer = igl.principal_curvature(noisy, faces, 5, False)
    theirs = np.sort(np.abs(np.stack([peer[2], peer[3]])), axis=0)
    medians = np.median(np.abs(theirs * 50.0 - 1.0), axis=1)
    assert (np.array(ours) < 0.6 * medians).all()


# ---------------------------------------------------------------- at a scale: what scans are like


def test_subdivision_of_a_half_moves_it_little():
    vertices, faces = shapes.sphere(50.0, 4)
    finer, finer_faces = half_subdivided(vertices, faces)
    found = pooled_curvature(finer, finer_faces, RADIUS)
    kept = found.mean[: len(vertices)]
    np.testing.assert_allclose(kept * 50.0, 1.0, atol=0.014)  # measured 0.0091


def test_decimation_moves_it_little():
    vertices, faces = shapes.sphere(50.0, 5)
    coarse, coarse_faces = decimated(vertices, faces, 4.0)
    found = pooled_curvature(coarse, coarse_faces, RADIUS)
    assert np.quantile(np.abs(found.mean * 50.0 - 1.0), 0.95) < 0.0054  # measured 0.0036


def test_a_boundary_is_one_sided_and_not_nan():
    vertices, faces = shapes.open_cap(50.0, 60.0, 24, 72)
    found = pooled_curvature(vertices, faces, RADIUS)
    assert np.isfinite(found.mean).all()
    np.testing.assert_allclose(found.mean * 50.0, 1.0, atol=8.2e-5)  # measured 5.4e-05
    holed, kept = with_holes(*_uneven_sphere(3000), np.random.default_rng(4), 6, 8.0)
    worst = np.abs(pooled_curvature(holed, kept, 12.0).mean * 50.0 - 1.0)
    assert np.quantile(worst, 0.99) < 0.0065  # measured 0.0043


def test_a_plane_is_flat_and_big_facets_are_flat_inside():
    vertices, faces = shapes.flat_sheet(260.0, 100.0, 20)
    found = pooled_curvature(vertices, faces, RADIUS)
    np.testing.assert_allclose(np.stack([found.k1, found.k2]), 0.0, atol=EXACT)
    box, box_faces = shapes.cube(100.0, 16)
    far = np.sort(np.abs(box), axis=1)[:, 1] < 50.0 - 2 * RADIUS
    flat = pooled_curvature(box, box_faces, RADIUS)
    assert far.sum() > 170  # measured 290
    np.testing.assert_allclose(flat.k2[far] * RADIUS, 0.0, atol=0.0012)  # measured 0.00076


@pytest.mark.parametrize("radius", [1e-3, 1.0, 100.0, 1e4])
@pytest.mark.parametrize(
    "mesh",
    [shapes.tetrahedron(), shapes.cube(100.0, 1), shapes.cylinder(40.0, 250.0, 12, 1)],
    ids=["tetrahedron", "box", "prism"],
)
def test_a_radius_far_from_the_edges_is_answered_within_reason(mesh, radius):
    found = pooled_curvature(*mesh, radius)
    size = np.ptp(mesh[0], axis=0).max()
    assert np.isfinite(found.k1).all()
    assert np.abs(np.stack([found.k1, found.k2])).max() * size < 7.3  # measured 4.8
    assert (found.mean > 0.0).mean() > 0.8  # convex


def test_beyond_the_longest_radius_nothing_more_is_smoothed():
    vertices, faces = shapes.sphere(50.0, 4)
    bumpy = (
        vertices * (1.0 + 0.01 * np.cos(6.0 * np.arctan2(vertices[:, 1], vertices[:, 0])))[:, None]
    )
    longest = longest_radius(vertices, faces)
    at, beyond = (pooled_curvature(bumpy, faces, k * longest) for k in (1.5, 6.0))
    np.testing.assert_allclose(beyond.mean * 50.0, at.mean * 50.0, atol=ROUNDING)
    assert longest_radius(3.0 * vertices, faces) == pytest.approx(3.0 * longest)
    assert longest_radius(vertices, faces[:0]) == np.inf


@pytest.mark.parametrize("share", [0.2, 0.5, 1.0, 3.0])
def test_a_coarse_sphere_reads_its_radius_even_below_its_edges(share):
    vertices, faces = shapes.sphere(50.0, 2)
    edge = np.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 1]], axis=1).mean()
    found = pooled_curvature(vertices, faces, share * edge)
    np.testing.assert_allclose(found.mean * 50.0, 1.0, atol=0.016)  # measured 0.01


def test_two_sheets_close_together_do_not_mix():
    ball = _uneven_sphere(3000)
    inner = (ball[0] * 0.98, ball[1][:, ::-1])
    alone = pooled_curvature(*ball, 12.0)
    both = pooled_curvature(*joined(ball, inner), 12.0)
    np.testing.assert_allclose(
        both.mean[: len(ball[0])], alone.mean, atol=8.9e-7
    )  # measured 5.9e-07


def test_slivers_lonely_vertices_and_empty_faces_break_nothing():
    vertices, faces = shapes.sphere(50.0, 3)
    vertices = np.concatenate([vertices, [[500.0, 0.0, 0.0]], vertices[:1] * (1 + 1e-9)])
    faces = np.concatenate([faces, [[0, len(vertices) - 1, 0]]])
    found = pooled_curvature(vertices, faces, RADIUS)
    assert np.isnan(found.mean[-2])
    np.testing.assert_allclose(found.mean[5:-2] * 50.0, 1.0, atol=0.0012)  # measured 0.00074
    nothing = pooled_curvature(vertices, faces[:0], RADIUS)
    assert np.isnan(nothing.k1).all()
    with pytest.raises(ValueError, match="positive"):
        pooled_curvature(vertices, faces, 0.0)


def test_sections_of_a_torus_bend_as_its_surface_says():
    """III.B on the section and III.C at a scale on the surface tell one story."""
    vertices, faces = shapes.torus(60.0, 20.0, 192, 96)
    ring = vertices[np.abs(np.arctan2(vertices[:, 1], vertices[:, 0])) < 1e-9]
    plane = np.stack([np.hypot(ring[:, 0], ring[:, 1]) - 60.0, ring[:, 2]], axis=1)
    bend = np.median(np.abs(curvature_density(plane, closed=True)))
    found = pooled_curvature(vertices, faces, 8.0)
    assert bend == pytest.approx(np.median(found.k2), rel=7.8e-4)  # measured 0.00052


def test_random_poses_of_a_subdivided_noisy_scan_agree():
    rng = np.random.default_rng(7)
    vertices, faces = subdivided(*_uneven_sphere(2000), None)
    vertices = white_noise(vertices, rng, 0.1)
    still = pooled_curvature(vertices, faces, 8.0)
    moved = pooled_curvature(vertices @ random_rotation(rng).T + 1000.0, faces, 8.0)
    _assert_same(moved, still, 1e-9)
