"""A top cut is flat and ends at a rim; a round instep in its plane is none."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.top_cut import runs_over_cut, top_cut_faces
from tools.lasts import LastSpec, last_mesh

LENGTH_MM = 260.0
OVER_MM = 0.01 * LENGTH_MM  # as near to the plane of the top as a top cut's faces


def segments_of(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    points = np.column_stack([across, up])
    return np.stack([points[:-1], points[1:]], axis=1)


def ridge(radius_mm: float, noise_mm: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A round top, 2 mm from point to point, and which of it lies near the plane of its top."""
    angle = np.arange(-1.4, 1.4, 2.0 / radius_mm)
    noise = noise_mm * np.random.default_rng(3).standard_normal(len(angle))
    segments = segments_of(radius_mm * np.sin(angle), radius_mm * np.cos(angle) + noise)
    return segments, segments[:, :, 1].mean(axis=1) > radius_mm - OVER_MM


def sawn(
    radius_mm: float, depth_mm: float, rim_mm: float, noise_mm: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """The same top, sawn off so deep, with a rim of that radius; and which of it is the cut."""
    half = np.sqrt(2.0 * radius_mm * depth_mm - depth_mm**2) - rim_mm
    flat = np.arange(-half, half, 2.0)
    start = np.arcsin((half + rim_mm) / radius_mm)
    wall = np.arange(start, 1.5, 2.0 / radius_mm)
    turn = np.linspace(0.1, start, 4)
    side = np.concatenate(
        [
            half + rim_mm * np.sin(turn),
            half + rim_mm * np.sin(start) + radius_mm * (np.sin(wall) - np.sin(start)),
        ]
    )
    down = np.concatenate(
        [
            -rim_mm * (1.0 - np.cos(turn)),
            -rim_mm * (1.0 - np.cos(start)) + radius_mm * (np.cos(wall) - np.cos(start)),
        ]
    )
    across = np.concatenate([-side[::-1], flat, side])
    up = np.concatenate([down[::-1], 0.0 * flat, down])
    noise = noise_mm * np.random.default_rng(4).standard_normal(len(up))
    segments = segments_of(across, up + noise)
    return segments, up_to(segments, -OVER_MM)


def up_to(segments: np.ndarray, level_mm: float) -> np.ndarray:
    return np.asarray(segments[:, :, 1].mean(axis=1) > level_mm)


@pytest.mark.parametrize("noise_mm", [0.0, 0.2])
@pytest.mark.parametrize("radius_mm", [18.0, 25.0, 40.0, 70.0, 120.0])
def test_a_round_top_is_no_cut(radius_mm: float, noise_mm: float) -> None:
    assert not runs_over_cut(*ridge(radius_mm, noise_mm), LENGTH_MM)


@pytest.mark.parametrize("noise_mm", [0.0, 0.2])
@pytest.mark.parametrize("rim_mm", [0.5, 3.0, 6.0])
@pytest.mark.parametrize(("radius_mm", "depth_mm"), [(25.0, 10.0), (40.0, 8.0), (40.0, 20.0)])
def test_a_sawn_top_is_a_cut(
    radius_mm: float, depth_mm: float, rim_mm: float, noise_mm: float
) -> None:
    assert runs_over_cut(*sawn(radius_mm, depth_mm, rim_mm, noise_mm), LENGTH_MM)


@pytest.mark.parametrize("radius_mm", [50.0, 65.0, 80.0])
def test_a_coarse_ridge_of_which_a_face_is_no_part_of_the_top_is_no_cut(radius_mm: float) -> None:
    """A decimated instep: two of its faces lean too far to be counted."""
    across = np.array(
        [-20.0, -16.0, -12.5, -9.5, -7.2, -4.3, 2.4, 4.6, 6.7, 7.8, 9.6, 11.6, 15.0, 19.0]
    )
    segments = segments_of(across, np.sqrt(radius_mm**2 - across**2))
    on_top = (np.abs(across) < 11.7)[:-1] & (np.abs(across) < 11.7)[1:]
    on_top[[5, 8]] = False  # from -4.3 to 2.4 mm, and from 6.7 to 7.8 mm
    assert not runs_over_cut(segments, on_top, LENGTH_MM)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_a_part_of_a_round_top_is_no_cut(share: float) -> None:
    segments, near = ridge(90.0)
    run = np.flatnonzero(near)
    part = np.zeros(len(near), dtype=bool)
    part[run[: round(share * len(run)) + 5]] = True
    assert not runs_over_cut(segments, part, LENGTH_MM)


def test_the_round_instep_of_a_low_last_is_measured() -> None:
    """Its ridge lies in the plane of its cone's top, and farther than a cut may be crossed."""
    spec = LastSpec(length_mm=265.0, cone_height_mm=58.0, rings=100, segments=72)
    low = Shape(*last_mesh(spec), "last")
    section = low.at_instep
    assert section.length_mm[low.top_cut[section.face]].sum() > 0.05 * low.length_mm
    around_mm = ConvexHull(section.segments.reshape(-1, 2)).area  # in a plane, the perimeter
    girth_mm = measure_named("instep_girth").value_of(low).value
    assert girth_mm == pytest.approx(around_mm, abs=1.4)  # measured .69, which smoothing takes
    assert measure_named("instep_height").value_of(low).value is not None


def box(corner_mm: tuple[float, float, float], size_mm: tuple[float, float, float]) -> np.ndarray:
    """The top of a box as a grid of triangles, (m, 3, 3)."""
    x, y = (np.linspace(0.0, size, 12) for size in size_mm[:2])
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    grid = np.concatenate([grid, np.full((12, 12, 1), size_mm[2])], axis=2) + corner_mm
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    triangles = [np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]
    return np.concatenate([each.reshape(-1, 3, 3) for each in triangles])


def test_a_forepart_in_the_plane_of_the_top_is_no_top() -> None:
    """As a last with a high heel rests, its forepart may lie in the plane of its cone's top."""
    triangles = np.concatenate(
        [box((10.0, -15.0, 0.0), (80.0, 30.0, 70.0)), box((180.0, -40.0, 0.0), (40.0, 80.0, 70.0))]
    )
    vertices, faces = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    on_top = top_cut_faces(vertices, faces.reshape(-1, 3), LENGTH_MM, 0.0)
    assert on_top.tolist() == (triangles[:, :, 0].max(axis=1) < 100.0).tolist()
