"""The planes of a graded last's girths: anyone can cut the written file there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import footfit
from footfit.meshes.write import encoded_mesh
from footfit.report.terminal.last_making_tables import graded_run_table
from footfit.report.terminal.scan_tables import terminal_text
from tests.test_pipeline_grade import base_mesh

TAPE_MM = 0.3
"""A mesh of few faces: ``measure`` takes a little of the facets for noise."""


@pytest.mark.parametrize("side", ["right", "left"])
def test_a_girth_is_found_again_in_its_plane(side: str, tmp_path: Path) -> None:
    vertices, faces = base_mesh(60.0)
    sign = 1 if side == "right" else -1
    mesh = encoded_mesh(vertices * [1.0, sign, 1.0], faces[:, ::sign], "stl")
    (tmp_path / f"derby_{side}.stl").write_bytes(mesh)
    run = footfit.grade(
        tmp_path / f"derby_{side}.stl", "43", size_system="eu", base_size="42", base_width="G"
    )
    assert run.side == side
    (last,) = run.lasts
    written = footfit.read(last.data, units="mm")
    girths = {each.name: each for each in last.measures if each.plane is not None}
    assert {"ball_girth_least", "instep_girth_least", "waist_girth_least"} <= set(girths)
    for each in girths.values():
        assert each.plane is not None
        origin, normal = np.array(each.plane.point_mm), np.array(each.plane.normal)
        assert np.linalg.norm(normal) == pytest.approx(1.0)
        if each.name != "heel_girth_instep":  # whose plane also cuts the cone
            girth_mm = hull_mm(written.vertices_mm, written.faces, origin, normal)
            assert girth_mm == pytest.approx(each.reached, abs=TAPE_MM), each.name
    document = run.to_dict()["lasts"][0]["measures"]
    assert {each["name"] for each in document if each["plane"]} == set(girths)
    text = terminal_text(graded_run_table(run), 160)
    assert "size 42 of eu, width G" in text
    assert "; flare " in text.split("farthest from its plan")[1]


def hull_mm(
    vertices: np.ndarray, faces: np.ndarray, origin: np.ndarray, normal: np.ndarray
) -> float:
    """The perimeter of the convex hull of a cut, in mm."""
    height = (vertices - origin) @ normal
    points = []
    for first, second in ((0, 1), (1, 2), (2, 0)):
        low, high = faces[:, first], faces[:, second]
        cut = height[low] * height[high] < 0.0
        share = height[low[cut]] / (height[low[cut]] - height[high[cut]])
        points.append(
            vertices[low[cut]] + share[:, None] * (vertices[high[cut]] - vertices[low[cut]])
        )
    placed = np.concatenate(points) - origin
    across = np.linalg.svd(normal[None])[2][1:]
    flat = placed @ across.T
    ring = flat[ConvexHull(flat).vertices]
    return float(np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1).sum())
