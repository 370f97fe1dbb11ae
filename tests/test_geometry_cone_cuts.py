"""What was cut out of a last: its girths are those of the uncut last, or are not measured."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.measure_value import CUT_OUT, MeasureValue
from footfit.geometry.mesh.topology import boundary_loops
from footfit.geometry.numeric.arrays import Floats, Ints
from tests.distortions import decimated, plane_cut, white_noise
from tools.last_cuts import cut_out, slit, thimble, v_cut
from tools.last_specs import wide
from tools.lasts import last_mesh

AS_UNCUT_MM = 1.0  # measured: 0.62
GIRTHS = (
    "ball_girth", "waist_girth", "instep_girth", "long_heel_girth", "ball_girth_least",
    "waist_girth_least", "instep_girth_least", "heel_girth_instep",
)  # fmt: skip


@cache
def mesh_of(style: str, heel_mm: float) -> tuple[Floats, Ints]:
    return last_mesh(wide(np.random.default_rng(3), style, (heel_mm, heel_mm + 1.0)))


def taken(name: str, vertices: Floats, faces: Ints) -> MeasureValue:
    return measure_named(name).taken_of(Shape(vertices, faces, "last"))


@cache
def uncut(name: str, style: str, heel_mm: float) -> float:
    value = taken(name, *mesh_of(style, heel_mm)).value
    assert value is not None
    return value


@pytest.mark.parametrize(
    ("heel_mm", "angle_deg", "depth_mm"),
    [(10.0, 24.0, 60.0), (30.0, 30.0, 80.0), (30.0, 40.0, 80.0)],
)
def test_the_heel_girth_of_a_boot_is_measured_past_a_v_cut(
    heel_mm: float, angle_deg: float, depth_mm: float
) -> None:
    """The tape passes the cut near its rim. In the cut the girth would be up to 28 mm less."""
    cut = v_cut(*mesh_of("boot", heel_mm), angle_deg=angle_deg, depth_mm=depth_mm)
    girth = taken("short_heel_girth", *cut).value
    assert girth == pytest.approx(uncut("short_heel_girth", "boot", heel_mm), abs=AS_UNCUT_MM)


@pytest.mark.parametrize(("angle_deg", "depth_mm"), [(24.0, 80.0), (30.0, 80.0), (40.0, 60.0)])
def test_the_heel_girth_of_a_boot_is_not_measured_through_a_v_cut(
    angle_deg: float, depth_mm: float
) -> None:
    cut = v_cut(*mesh_of("boot", 10.0), angle_deg=angle_deg, depth_mm=depth_mm)
    assert taken("short_heel_girth", *cut) == MeasureValue(None, CUT_OUT)


@pytest.mark.parametrize(
    ("style", "heel_mm", "cut"),
    [
        ("shoe", 15.0, v_cut),
        ("pump", 90.0, v_cut),
        ("child", 5.0, v_cut),
        ("sandal", 50.0, thimble),
        ("pump", 90.0, thimble),
    ],
)
def test_a_cones_front_edge_that_was_cut_away_gives_no_heel_girth(style, heel_mm, cut) -> None:
    mesh = cut(*mesh_of(style, heel_mm))
    assert taken("short_heel_girth", *mesh) == MeasureValue(None, CUT_OUT)
    for name in GIRTHS:
        assert taken(name, *mesh).value == pytest.approx(uncut(name, style, heel_mm), abs=0.2), name


@pytest.mark.parametrize(("style", "heel_mm"), [("shoe", 15.0), ("sandal", 50.0), ("child", 5.0)])
def test_the_floor_of_a_cut_is_no_top_of_the_cone(style: str, heel_mm: float) -> None:
    """A long heel girth passes over it: it was "sawn off below the instep"."""
    vertices, faces = mesh_of(style, heel_mm)
    length_mm = float(np.ptp(vertices[:, 0]))
    x = float(vertices[:, 0].min()) + 0.38 * length_mm
    top = float(vertices[np.abs(vertices[:, 0] - x) < 0.02 * length_mm, 2].max())
    low, half = 0.5 * top, 0.03 * length_mm
    trough = [[x - half, low], [x + half, low], [x + 2 * half, 300.0], [x - 2 * half, 300.0]]
    mesh = cut_out(vertices, faces, trough)
    name = "long_heel_girth"
    assert taken(name, *mesh).value == pytest.approx(uncut(name, style, heel_mm), abs=0.5)


@pytest.mark.parametrize(("style", "heel_mm"), [("shoe", 15.0), ("boot", 30.0), ("pump", 90.0)])
def test_a_slit_changes_no_girth(style: str, heel_mm: float) -> None:
    mesh = slit(*mesh_of(style, heel_mm))
    for name in (*GIRTHS, "short_heel_girth"):
        assert taken(name, *mesh).value == pytest.approx(uncut(name, style, heel_mm), abs=0.3), name


@pytest.mark.parametrize(
    ("style", "heel_mm"),
    [
        ("shoe", 15.0),
        ("boot", 30.0),
        ("boot", 100.0),
        ("pump", 115.0),
        ("sandal", 50.0),
        ("child", 5.0),
    ],
)
def test_a_whole_last_has_no_cut(style: str, heel_mm: float) -> None:
    vertices, faces = mesh_of(style, heel_mm)
    noisy = white_noise(vertices, np.random.default_rng(5), 0.3)
    for mesh in ((vertices, faces), (noisy, faces), decimated(vertices, faces, 8.0)):
        assert Shape(*mesh, "last").cone_cut is None


@pytest.mark.parametrize(
    ("style", "heel_mm", "depth_mm", "tilt"),
    [("shoe", 15.0, 4.0, 0.03), ("sandal", 50.0, 8.0, 0.0), ("shoe", 60.0, 12.0, -0.05)],
)
def test_a_cones_top_of_a_few_large_facets_has_its_edge(
    style: str, heel_mm: float, depth_mm: float, tilt: float
) -> None:
    """A top of slender facets from its rear is the same top as one of fine ones: 1.4 mm apart."""
    vertices, faces = mesh_of(style, heel_mm)
    highest = vertices[vertices[:, 0] < 0.3 * vertices[:, 0].max(), 2].max()
    normal = np.array([tilt, 0.0, 1.0]) / np.hypot(tilt, 1.0)
    points, open_faces = plane_cut(
        vertices, faces, np.array([0.0, 0.0, highest - depth_mm]), normal
    )
    rim = max(boundary_loops(open_faces), key=len)[::-1]
    rim = np.roll(rim, -int(np.argmin(points[rim, 0])))
    fan = np.column_stack([np.full(len(rim) - 2, rim[0]), rim[1:-1], rim[2:]])
    middle, rings, caps = points[rim].mean(axis=0), [points], []
    inner = rim
    for share in np.linspace(0.95, 0.05, 19):
        outer, inner = inner, sum(map(len, rings)) + np.arange(len(rim))
        rings.append(middle + share * (points[rim] - middle))
        after = np.roll(outer, -1)
        caps += [np.column_stack([outer, after, inner])]
        caps += [np.column_stack([after, np.roll(inner, -1), inner])]
    last = np.full(len(rim), sum(map(len, rings)))
    caps.append(np.column_stack([inner, np.roll(inner, -1), last]))
    coarse = taken("short_heel_girth", points, np.vstack([open_faces, fan])).value
    fine = np.vstack([*rings, middle]), np.vstack([open_faces, *caps])
    assert coarse == pytest.approx(taken("short_heel_girth", *fine).value, abs=2.0)
