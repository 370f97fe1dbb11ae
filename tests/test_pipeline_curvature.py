"""Curvature of a scan: the default scale, the one ring, what is said, and real scans."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from footfit.errors import BadOption
from footfit.geometry.mesh.welding import welded_vertices
from footfit.pipeline.scan.curvature import surface_curvature
from footfit.results import MeshInfo, Scan
from tests import shapes
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES
from tests.distortions import random_rotation, soup, white_noise
from tests.reading import read_scan


def _scan(vertices, faces, source=None):
    info = MeshInfo(None, "0" * 64, "stl", len(vertices), len(faces), True, "mm", "declared", 1.0)
    return Scan(info, vertices, faces, (), source)


def test_the_default_scale_is_six_percent_of_the_length_in_any_pose():
    vertices, faces = shapes.ellipsoid((130.0, 45.0, 35.0), 3)
    for rotation in (np.eye(3), random_rotation(np.random.default_rng(0))):
        found = surface_curvature(_scan(vertices @ rotation.T, faces))
        assert found.radius_mm == pytest.approx(0.06 * 260.0, rel=ROUNDING)


def test_radius_zero_is_the_one_ring_and_drowns_where_the_default_does_not():
    vertices, faces = shapes.sphere(125.0, 5)
    noisy = white_noise(vertices, np.random.default_rng(1), 0.3)
    ring, pooled = (surface_curvature(_scan(noisy, faces), radius) for radius in (0.0, None))
    worst = [np.nanmedian(np.abs(found.k2 * 125.0 - 1.0)) for found in (ring, pooled)]
    assert ring.radius_mm == 0.0
    assert worst[0] > 10 * worst[1]
    # Noise sigma over M vertices within r leaves about 8 sigma / (r^2 sqrt M).
    members = np.pi * pooled.radius_mm**2 / (4 * np.pi * 125.0**2 / len(vertices))
    assert worst[1] < 125.0 * 8 * 0.3 / (pooled.radius_mm**2 * np.sqrt(members))


def test_each_vertex_of_the_file_finds_its_own():
    vertices, faces = shapes.torus(60.0, 20.0, 28, 14)
    loose, corners = soup(vertices, faces)
    merged, merged_faces, source = welded_vertices(loose, corners)
    found = surface_curvature(_scan(merged, merged_faces, source), 15.0)
    np.testing.assert_array_equal(found.vertices_mm[found.source_to_vertex], loose)
    assert surface_curvature(_scan(vertices, faces), 15.0).source_to_vertex.tolist() == list(
        range(len(vertices))
    )


def test_what_is_undefined_or_below_the_edges_is_said():
    vertices, faces = shapes.open_cap(50.0, 60.0, 10, 30)
    ring = surface_curvature(_scan(vertices, faces), 0.0)
    assert [notice.code for notice in ring.warnings] == ["curvature_undefined"]
    assert "30 of 301" in ring.warnings[0].message
    fine = surface_curvature(_scan(vertices, faces), 0.5)
    assert [notice.code for notice in fine.warnings] == ["radius_below_edges"]
    assert not surface_curvature(_scan(vertices, faces), 15.0).warnings


def test_a_radius_of_more_edges_than_pooling_follows_is_said():
    sheet = _scan(*shapes.flat_sheet(100.0, 100.0, 100))
    cut = surface_curvature(sheet, 80.0)
    assert [notice.code for notice in cut.warnings] == ["radius_cut"]
    assert "80 mm" in cut.warnings[0].message
    assert not surface_curvature(sheet, 30.0).warnings


@pytest.mark.parametrize("radius", [-1.0, float("nan"), float("inf")])
def test_a_radius_that_is_no_length_is_refused(radius):
    with pytest.raises(BadOption, match="radius"):
        surface_curvature(_scan(*shapes.sphere(50.0, 1)), radius)


def test_every_sample_gets_finite_values_of_a_foots_order():
    lasts = sorted((SAMPLES / "lasts").glob("*-40.stl"))
    assert_values_are_of_a_foots_order([*sorted((SAMPLES / "feet").glob("*.stl")), *lasts])


def test_every_real_scan_gets_finite_values_of_a_foots_order(scans):
    assert_values_are_of_a_foots_order(sorted(scans.glob("*.stl")))


def assert_values_are_of_a_foots_order(paths):
    """Finite, in order, and no sharper than the scale that they are read at."""
    assert paths
    for path in paths:
        scan = read_scan(path)
        found = surface_curvature(replace(scan, warnings=()))
        assert not found.warnings, path.name
        assert np.isfinite(np.stack([found.k1, found.k2])).all(), path.name
        assert np.all(found.k1 <= found.k2)
        # Nothing at this scale can bend much more than a ball of its deviation.
        # measured 5
        assert np.abs(np.stack([found.k1, found.k2])).max() * found.radius_mm < 7.5, path.name
