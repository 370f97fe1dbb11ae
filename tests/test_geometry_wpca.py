"""The paper's alignment: the literal reading aligns nothing, the consistent one does."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry import wpca
from footfit.geometry.moments import principal_axes, printed_covariance, vertex_mean
from footfit.geometry.rotations import angle_deg, applied, turned_by
from tests import distortions
from tools.lasts import LastSpec, last_mesh

SEEDS = st.integers(0, 2**32 - 1)


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(rings=40, segments=32))


def posed_frame(last, rng):
    """A posed last with its centroid and settled axes, and its canonical transform."""
    vertices, faces = last
    pose = distortions.random_pose(rng)
    moved = distortions.moved(vertices, pose)
    canonical = np.linalg.inv(pose)
    rows = principal_axes(printed_covariance(moved, faces))[1]
    return moved, vertex_mean(moved), wpca.settled(rows, canonical[:3, :3]), canonical


@settings(max_examples=15, deadline=None)
@given(seed=SEEDS)
def test_the_literal_reading_equals_om_e_v_prime(last, seed):
    rng = np.random.default_rng(seed)
    vertices, faces = last
    moved = distortions.moved(vertices, distortions.random_pose(rng))
    OM_E = distortions.random_rotation(rng)
    aligned = wpca.aligned_by_wpca(moved, faces, OM_E, literal=True)
    expected = (moved - vertex_mean(moved)) @ OM_E.T
    assert np.abs(aligned - expected).max() < 1e-9


def test_what_the_literal_reading_costs(last):
    """In random poses the mesh stays tens of millimetres away; the consistent reading does not."""
    vertices, _faces = last
    rng = np.random.default_rng(7)
    _, centroid, axes, canonical = posed_frame(last, rng)
    OM_E = wpca.om_e(axes, canonical)
    reference = wpca.canonical_centroid_mm(centroid, canonical, 1.0)
    literal, consistent = [], []
    for _ in range(25):
        moved, centroid, axes, _ = posed_frame(last, rng)
        wrong = wpca.literal_transform(centroid, 1.0, OM_E, reference)
        right = wpca.paper_transform(centroid, axes, 1.0, OM_E, reference)
        for found, displacement in ((wrong, literal), (right, consistent)):
            away = np.linalg.norm(applied(found, moved) - vertices, axis=1)
            displacement.append(np.median(away))
    assert np.median(literal) > 40.0
    assert max(consistent) < 1e-6


@settings(max_examples=15, deadline=None)
@given(seed=SEEDS)
def test_the_steps_and_the_stored_transform_agree_up_to_signs(last, seed):
    moved, centroid, axes, canonical = posed_frame(last, np.random.default_rng(seed))
    OM_E = wpca.om_e(axes, canonical)
    stored = applied(wpca.paper_transform(centroid, axes, 1.0, OM_E, np.zeros(3)), moved)
    steps = wpca.aligned_by_wpca(moved, last[1], np.eye(3), literal=False)
    closeness = np.abs(np.corrcoef((stored @ OM_E).T, steps.T)[:3, 3:])
    assert closeness.max(axis=0).min() > 1 - 1e-9


@settings(max_examples=15, deadline=None)
@given(seed=SEEDS, scale=st.sampled_from([1.0, 10.0, 25.4, 1000.0]))
def test_a_left_last_lands_on_its_right_twin(last, seed, scale):
    """Mirrored before Eq. 1, the left twin's file has the very place of the right one's."""
    rng = np.random.default_rng(seed)
    _, centroid, axes, canonical = posed_frame(last, rng)
    OM_E = wpca.om_e(axes, canonical)
    reference = wpca.canonical_centroid_mm(centroid, canonical, 1.0)
    twin = distortions.mirrored(*last)
    left, left_centroid, left_axes, left_canonical = posed_frame(twin, rng)
    found = wpca.paper_transform(left_centroid, left_axes, scale, OM_E, reference, mirrored=True)
    file = left / scale * [-1.0, 1.0, 1.0]
    assert np.abs(applied(found, file) - last[0]).max() < 1e-6
    direct = wpca.unmirrored(found, mirrored=True)
    assert np.linalg.det(direct[:3, :3]) > 0
    assert np.abs(applied(direct, left / scale) - twin[0]).max() < 1e-6
    left_canonical = left_canonical @ np.diag([scale, scale, scale, 1.0])
    assert angle_deg(wpca.om_e(left_axes, left_canonical, mirrored=True), OM_E) < 1e-6
    of_left = wpca.canonical_centroid_mm(left_centroid, left_canonical, scale, mirrored=True)
    assert np.abs(of_left - reference).max() < 1e-6


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_settled_axes_are_a_rotation_whatever_order_and_signs_came(seed):
    rng = np.random.default_rng(seed)
    canonical = distortions.random_rotation(rng)
    near = turned_by(rng.uniform(-0.2, 0.2, (1, 3)))[0]
    axes = near @ canonical
    shuffled = axes[rng.permutation(3)] * rng.choice([-1.0, 1.0], 3)[:, None]
    np.testing.assert_allclose(wpca.settled(shuffled, canonical), axes, atol=1e-12)


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_largest_positive_is_a_rotation(seed):
    rng = np.random.default_rng(seed)
    rows = distortions.random_rotation(rng) * rng.choice([-1.0, 1.0], 3)[:, None]
    signed = wpca.largest_positive(rows)
    assert np.linalg.det(signed) == pytest.approx(1.0)
    assert (signed[np.arange(2), np.abs(signed[:2]).argmax(axis=1)] > 0).all()
