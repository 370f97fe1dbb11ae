"""What each change of a scan must do to the frame, the flare and the curvature: one law a row.

From the file's bytes through the whole pipeline. Which law holds how closely is in ``LAWS``: a
motion, a mirror, another unit or order may cost rounding only; subdivision lays the points of the
frame's integrals elsewhere on the same surface.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.numeric.rotations import moved_points
from footfit.meshes.units import UNIT_SCALES
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.scan.curvature import surface_curvature
from footfit.pipeline.scan.flare import profiled_scan
from tests import distortions
from tests.bounds import POSED, ROUNDING
from tests.conftest import SAMPLES
from tests.reading import scan_from_bytes
from tests.scans import aligned
from tools.lasts import LastSpec, last_mesh

RADIUS_MM = 12.0
FLIP = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Changed:
    """A mesh in its file's unit.

    ``placed`` says where a point (n, 3) of the first mesh, in mm, now is in the file;
    ``source`` (k,) which vertex of the first mesh each of the first k vertices is.
    """

    vertices: np.ndarray
    faces: np.ndarray
    placed: Callable[[np.ndarray], np.ndarray]
    source: np.ndarray
    units: str = "mm"
    mirrored: bool = False


def unchanged(vertices, faces, rng):
    return Changed(vertices, faces, lambda p: p, np.arange(len(vertices)))


def rotated(vertices, faces, rng):
    turn = distortions.random_rotation(rng)
    return Changed(vertices @ turn.T, faces, lambda p: p @ turn.T, np.arange(len(vertices)))


def shifted(vertices, faces, rng):
    shift = rng.uniform(-2000.0, 2000.0, 3)
    return Changed(vertices + shift, faces, lambda p: p + shift, np.arange(len(vertices)))


def in_another_unit(vertices, faces, rng):
    units = str(rng.choice(sorted(UNIT_SCALES)))
    scale = UNIT_SCALES[units]
    every = np.arange(len(vertices))
    return Changed(vertices / scale, faces, lambda p: p / scale, every, units)


def mirrored(vertices, faces, rng):
    every = np.arange(len(vertices))
    return Changed(vertices * FLIP, faces[:, ::-1], lambda p: p * FLIP, every, mirrored=True)


def reordered(vertices, faces, rng):
    order = rng.permutation(len(vertices))
    rank = np.argsort(order)
    turned = np.roll(rank[faces], int(rng.integers(3)), axis=1)
    return Changed(vertices[order], rng.permutation(turned), lambda p: p, order)


def with_duplicates(vertices, faces, rng):
    doubled, corners = distortions.soup(vertices, faces)
    return Changed(doubled, corners, lambda p: p, faces.ravel())


def subdivided(vertices, faces, rng):
    finer = distortions.subdivided(vertices, faces, rng.random(len(faces)) < rng.uniform(0.1, 0.9))
    return Changed(*finer, lambda p: p, np.arange(len(vertices)))


@dataclass(frozen=True)
class Law:
    """A change, and how far the points, their middle, the length (mm), the flare angle, its
    channels and the curvatures (over 1/radius) may move: by rounding if nothing else is said.

    The order of the sums moves the pose most, by 3.4e-8 mm at a point. Curvature moves by 1e-11.
    """

    change: Callable[[np.ndarray, np.ndarray, np.random.Generator], Changed]
    points_mm: float = 6.5e-8
    middle_mm: float = 4.7e-8
    length_mm: float = POSED
    flare_deg: float = ROUNDING
    channel: float = POSED
    curvature: float = ROUNDING
    median_curvature: float = ROUNDING


LAWS = {
    "rotation": Law(rotated),
    "translation": Law(shifted),
    "scale with units": Law(in_another_unit),
    "mirror": Law(mirrored),
    "order": Law(reordered),
    "duplicate vertices": Law(with_duplicates),
    # measured:                   0.256, 0.253, 0.0010, 1.6e-3, 0.084, 0.138, 0.020
    "subdivision": Law(subdivided, 0.49, 0.48, 0.002, 3.2e-3, 0.16, 0.25, 0.039),
}


def read(changed: Changed):
    """As from a PLY file in a declared unit, which keeps every bit."""
    data = encoded_mesh(changed.vertices, changed.faces, "ply")
    return scan_from_bytes(data, format="ply", units=changed.units)


@dataclass(frozen=True)
class Home:
    """The first mesh and what the pipeline says of it."""

    vertices: np.ndarray
    faces: np.ndarray
    profile: object
    curvature: object


def at_home(vertices, faces) -> Home:
    scan = read(unchanged(vertices, faces, None))
    return Home(vertices, faces, profiled_scan(aligned(scan)), surface_curvature(scan, RADIUS_MM))


@pytest.fixture(scope="module")
def homes():
    """A last that is closed, and a foot with a hole and a leg that is cut."""
    last = last_mesh(LastSpec(length_mm=261.0, heel_height_mm=20.0, rings=60, segments=40))
    path = SAMPLES / "feet" / "mh007_R.stl"
    scan = scan_from_bytes(path.read_bytes(), format="stl")
    foot = distortions.leg_cut(scan.vertices_mm, scan.faces, 75.0)
    holed = distortions.with_holes(*foot, np.random.default_rng(11), 1, 9.0)
    return {"last": at_home(*last), "foot": at_home(*holed)}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("body", ["last", "foot"])
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=3, deadline=None)
def test_frame_and_flare_obey(homes, body, law, seed):
    home, bound = homes[body], LAWS[law]
    changed = bound.change(home.vertices, home.faces, np.random.default_rng(seed))
    found = profiled_scan(aligned(read(changed)))
    one, other = home.profile.aligned.alignment, found.aligned.alignment
    flip = FLIP if changed.mirrored else np.ones(3)
    # where the frames put the first mesh's points: the same place, or its mirror image
    there = moved_points(other.canonical_transform, changed.placed(home.vertices))
    here = moved_points(one.canonical_transform, home.vertices) * flip
    assert np.abs(there - here).max() < bound.points_mm
    middle = np.abs(there.mean(axis=0) - here.mean(axis=0))
    assert middle.max() < bound.middle_mm
    assert other.length_mm == pytest.approx(one.length_mm, abs=bound.length_mm)
    assert (other.side.side != one.side.side) == changed.mirrored
    assert found.flare.angle_deg == pytest.approx(home.profile.flare.angle_deg, abs=bound.flare_deg)
    for channel, curve in home.profile.flare.curvature.items():
        np.testing.assert_allclose(
            found.flare.curvature[channel], curve, rtol=0, atol=bound.channel
        )


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("body", ["last", "foot"])
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=2, deadline=None)
def test_curvature_obeys(homes, body, law, seed):
    home, bound = homes[body], LAWS[law]
    changed = bound.change(home.vertices, home.faces, np.random.default_rng(seed))
    found = surface_curvature(read(changed), RADIUS_MM)
    for name in ("k1", "k2", "mean"):
        read_back = getattr(found, name)[found.source_to_vertex][: len(changed.source)]
        moved = np.abs(read_back - getattr(home.curvature, name)[changed.source]) * RADIUS_MM
        # a subdivided facet stays flat: what it adds bends at the old edges only
        top = 0.95 if law == "subdivision" else 1.0
        assert np.quantile(moved, top) < bound.curvature
        assert np.median(moved) < bound.median_curvature
