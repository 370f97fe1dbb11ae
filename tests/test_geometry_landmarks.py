"""Landmarks of lasts with planted joints, of legs that were cut, and of coarser meshes."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from footfit.geometry.measures.heel_girths import cone_edge
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.surface import face_areas
from tests import shapes
from tests.conftest import SAMPLES
from tests.distortions import decimated, leg_cut, white_noise
from tests.reading import read_scan
from tests.scans import aligned, right_shape
from tools.lasts import LastSpec, last_mesh


@cache
def last(**given) -> Shape:
    vertices, faces = last_mesh(LastSpec(rings=100, segments=70, **given))
    return Shape(vertices, faces, "last")


def test_the_ends_are_the_ends() -> None:
    shape = last(length_mm=270.0)
    assert shape.length_mm == pytest.approx(270.0, abs=0.5)
    assert shape.pternion[0] == pytest.approx(0.0, abs=0.3)
    assert shape.x_mm(1.0) == pytest.approx(270.0, abs=0.12)  # measured 0.075
    assert shape.x_mm(1.0) == pytest.approx(shape.ends[1].reach)


def test_a_joint_farther_forward_is_found_farther_forward() -> None:
    places = []
    for station in (0.69, 0.72, 0.75):
        shape = last(mt1_station=station, joint_bulge_mm=6.0)
        places.append(shape.mt1[0] / shape.length_mm)
    assert np.all(np.diff(places) > 0.005)
    assert places == pytest.approx([0.69, 0.72, 0.75], abs=0.03)


def test_the_joints_lie_on_the_outline() -> None:
    shape = last(length_mm=270.0, flare_deg=6.0)
    near = shape.vertices_mm[np.abs(shape.vertices_mm[:, 0] - shape.mt1[0]) < 3.0]
    assert shape.mt1[1] == pytest.approx(near[:, 1].max(), abs=0.29)  # measured 0.19
    near = shape.vertices_mm[np.abs(shape.vertices_mm[:, 0] - shape.mt5[0]) < 3.0]
    assert shape.mt5[1] == pytest.approx(near[:, 1].min(), abs=0.37)  # measured 0.24
    assert shape.mt5[0] < shape.mt1[0]


def test_where_nothing_is_no_joint_is_found() -> None:
    vertices, faces = shapes.ellipsoid((125.0, 48.0, 40.0), 4)
    away = vertices[faces].mean(axis=1)[:, 0]
    shape = Shape(vertices, faces[np.abs(away - 40.0) > 50.0])
    assert shape.mt1 is None
    assert shape.mt5 is None


def test_the_lid_is_a_lasts_cone_top_whatever_the_noise() -> None:
    shape = last(length_mm=270.0)
    noisy = Shape(white_noise(shape.vertices_mm, np.random.default_rng(1), 0.3), shape.faces)
    top_mm = shape.vertices_mm[:, 2].max()
    for one in (shape, noisy):
        lid_mm = one.vertices_mm[one.faces[one.top_cut]].mean(axis=1)[:, 2]
        assert len(lid_mm) > 160  # measured 270
        assert np.mean(lid_mm > top_mm - 12.0) > 0.9


def test_a_cut_that_is_left_open_has_no_lid_but_a_gap() -> None:
    vertices, faces = leg_cut(last().vertices_mm, last().faces, 60.0)
    shape = Shape(vertices, faces)
    assert not shape.top_cut.any()
    assert shape.opened(shape.across(0.2))
    assert not shape.opened(shape.across(0.8))


def test_a_lasts_cone_edge_is_where_the_cone_ends() -> None:
    for cone_length in (0.30, 0.34, 0.38):
        shape = last(cone_length=cone_length)
        assert cone_edge(shape)[0] / shape.length_mm == pytest.approx(cone_length, abs=0.05)
        assert cone_edge(shape)[2] > 0.85 * shape.vertices_mm[:, 2].max()


@pytest.mark.parametrize("thinning", [1.0, 2.0, 4.0])
def test_a_leg_that_is_cut_is_closed_by_its_lid_and_no_dorsum(thinning: float) -> None:
    """However coarse its triangles: the lid's area is that of the cut, all of it at the top."""
    scan = read_scan(SAMPLES / "feet" / "mh008_R.stl")
    vertices, faces = right_shape(aligned(scan, side="right"))
    whole = Shape(vertices, faces)
    if thinning > 1.0:
        vertices, faces = decimated(vertices, faces, thinning)
    shape = Shape(vertices, faces)
    lid, cut = shape.faces[shape.top_cut], whole.faces[whole.top_cut]
    assert face_areas(vertices, lid).sum() == pytest.approx(
        face_areas(whole.vertices_mm, cut).sum(),
        rel=0.026,  # measured 0.017
    )
    assert vertices[lid][:, :, 2].min() > vertices[:, 2].max() - 12.0
