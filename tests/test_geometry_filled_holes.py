"""Holes that a program closed with flat facets: nothing that runs over them is measured."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from manifold3d import CrossSection, FillRule
from scipy.spatial import Delaunay

import footfit
from footfit.geometry.fit.clearance import foot_clearance, zone_clearances
from footfit.geometry.fit.paired_sections import section_pairs
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.mesh.filled_holes import filled_faces
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import boundary_loops
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.pipeline.scan.measure import shape_measures
from tests.conftest import SAMPLES, SCANS
from tests.distortions import decimated, moved, plane_cut, random_pose, subdivided, white_noise
from tests.shapes import grid_faces
from tools import last_cuts
from tools.last_specs import wide
from tools.lasts import LastSpec, last_mesh

CASES = Path(__file__).parents[2] / "shared" / "cases"
NOT_SCANNED = "this part was not scanned"


@cache
def foot(name="mh008_R"):
    aligned = footfit.align(SAMPLES / "feet" / f"{name}.stl", side="right")
    return aligned.vertices_mm, aligned.faces, aligned.alignment.length_mm


# ---------------------------------------------------------------- holes


def dorsum(middles, length_mm):
    """The top of the forefoot and instep, from below and in front of a phone's view."""
    x, z = middles[:, 0] / length_mm, middles[:, 2] / length_mm
    return (x > 0.38) & (x < 0.95) & (z > 0.055 + 0.25 * np.maximum(0.72 - x, 0.0))


def medial_side(middles, length_mm):
    x, y, z = middles.T / length_mm
    return (np.hypot(x - 0.50, z - 0.13) < 0.12) & (y > 0.0)


def ball_side(middles, length_mm):
    x, y, z = middles.T / length_mm
    return (np.hypot(x - 0.72, 1.5 * (z - 0.08)) < 0.11) & (y > 0.0)


def sole(middles, length_mm):
    """What a scanner does not see that goes around a standing foot; the rim lies in no plane."""
    x, y, z = middles.T / length_mm
    return z < 0.035 + 0.01 * np.sin(9.0 * x) + 0.05 * np.maximum(y, 0.0)


HOLES = {"dorsum": dorsum, "medial side": medial_side, "ball": ball_side, "sole": sole}


# ---------------------------------------------------------------- fillings


def fan(points):
    """Around the rim's first point, as the simplest of fillings."""
    count = len(points)
    return points, np.array([[0, k, k + 1] for k in range(1, count - 1)])


def centre_fan(points):
    count = len(points)
    rim = np.arange(count)
    faces = np.column_stack([rim, np.roll(rim, -1), np.full(count, count)])
    return np.vstack([points, points.mean(axis=0)]), faces


def few_facets(points):
    """Strips from one side of the rim to the other: slender triangles, no point inside."""
    low, high, faces = 0, len(points) - 1, []
    while high - low > 1:
        faces.append([low, low + 1, high])
        low += 1
        if high - low > 1:
            faces.append([low, high - 1, high])
            high -= 1
    return points, np.array(faces)


FILLINGS: dict[str, Callable] = {"fan": fan, "centre fan": centre_fan, "strips": few_facets}


def holed(vertices, faces, gone):
    vertices, faces, _ = without_unused_vertices(vertices, faces[~gone])
    return vertices, faces


def filled(vertices, faces, filling):
    """A mesh with its longest boundary loop closed by ``filling``."""
    rim = max(boundary_loops(faces), key=len)[::-1]
    points, patch = filling(vertices[rim])
    numbers = np.append(rim, len(vertices) + np.arange(len(points) - len(rim)))
    return np.vstack([vertices, points[len(rim) :]]), np.vstack([faces, numbers[patch]])


def with_filling(hole, filling, name="mh008_R"):
    vertices, faces, length_mm = foot(name)
    gone = HOLES[hole](vertices[faces].mean(axis=1), length_mm)
    return filled(*holed(vertices, faces, gone), FILLINGS[filling])


def reasons(vertices, faces, kind="foot"):
    """Measures by name: their value, or their reason."""
    rows = shape_measures(Shape(vertices, faces, kind))
    return {
        row.name: row.measured.reason if row.measured.value is None else row.measured.value
        for row in rows
    }


@cache
def true_values():
    return reasons(*foot()[:2])


LOST = {
    "dorsum": ("ball_girth", "waist_girth", "instep_girth", "long_heel_girth", "toe_height"),
    "medial side": ("instep_girth",),
    "ball": ("ball_girth",),
    "sole": ("instep_girth", "waist_girth", "arch_height"),
}
KEPT = {
    "dorsum": ("length", "heel_width", "arch_height"),
    "medial side": ("length", "ball_girth", "ball_width", "toe_height", "heel_width"),
    "ball": ("length", "instep_girth", "heel_width", "toe_height"),
    "sole": ("length",),
}


@pytest.mark.parametrize("filling", FILLINGS)
@pytest.mark.parametrize("hole", HOLES)
def test_nothing_is_measured_over_a_hole_that_was_closed(hole, filling):
    found = reasons(*with_filling(hole, filling))
    for name in LOST[hole]:
        assert found[name] == NOT_SCANNED, name
    for name in KEPT[hole]:
        assert found[name] == pytest.approx(true_values()[name], abs=0.5), name


@pytest.mark.parametrize("change", ["finer", "twice as fine", "coarser"])
def test_the_filling_is_known_on_a_finer_and_on_a_coarser_scan(change):
    vertices, faces, length_mm = foot()
    if change == "coarser":
        vertices, faces = decimated(vertices, faces, 3.0)
    else:
        for _ in range(1 if change == "finer" else 2):
            vertices, faces = subdivided(vertices, faces)
    gone = dorsum(vertices[faces].mean(axis=1), length_mm)
    found = reasons(*filled(*holed(vertices, faces, gone), few_facets))
    assert found["instep_girth"] == NOT_SCANNED
    assert found["waist_girth"] == NOT_SCANNED


# ---------------------------------------------------------------- planes of small facets


def cut_by_a_plane(origin, normal, pitch_mm=3.0):
    """The foot cut off by a plane, and the plane's cap meshed as finely as the foot is."""
    vertices, faces, _ = foot()
    origin, normal = np.array(origin), np.array(normal) / np.linalg.norm(normal)
    vertices, faces = plane_cut(vertices, faces, origin, normal)
    rim = max(boundary_loops(faces), key=len)
    axes = np.linalg.svd(normal[None])[2][1:]
    flat = (vertices[rim] - origin) @ axes.T
    shadow = CrossSection([flat], FillRule.EvenOdd)

    def inside(points):
        dot = CrossSection.square((1e-3, 1e-3))
        return np.array([not (shadow ^ dot.translate(point)).is_empty() for point in points])

    steps = [np.arange(column.min(), column.max(), pitch_mm) for column in flat.T]
    grid = np.stack(np.meshgrid(*steps), axis=2).reshape(-1, 2)
    points = np.vstack([flat, grid[inside(grid)]])
    patch = Delaunay(points).simplices
    patch = patch[inside(points[patch].mean(axis=1))]
    solid = origin + points @ axes
    looks_in = area_vectors(solid, patch) @ normal < 0.0
    patch[looks_in] = patch[looks_in][:, [0, 2, 1]]
    numbers = np.append(rim, len(vertices) + np.arange(len(points) - len(rim)))
    return np.vstack([vertices, solid[len(rim) :]]), np.vstack([faces, numbers[patch]])


PLANES = {
    "over the instep": ((150.0, 0.0, 50.0), (0.7, 0.0, 0.7), "waist_girth"),
    "over the toes": ((215.0, 0.0, 20.0), (0.30, 0.0, 0.95), "toe_height"),
    "along the inner side": ((135.0, 26.0, 50.0), (0.1, 0.9, 0.45), "instep_girth"),
}


@pytest.mark.parametrize("name", PLANES)
def test_a_plane_that_was_meshed_finely_is_no_skin(name):
    origin, normal, lost = PLANES[name]
    mesh = cut_by_a_plane(origin, normal)
    assert Shape(*mesh).filled.sum() > 50
    assert reasons(*mesh)[lost] == NOT_SCANNED


# ---------------------------------------------------------------- what is no filling


@pytest.mark.parametrize("name", ["mh007_R", "mh008_R"])
@pytest.mark.parametrize("factor", [1.0, 4.0, 10.0])
def test_a_foot_with_its_lid_has_no_filling_however_coarse_it_is(name, factor):
    vertices, faces, _ = foot(name)
    mesh = decimated(vertices, faces, factor) if factor > 1.0 else (vertices, faces)
    assert not Shape(*mesh).filled.any()


@pytest.mark.parametrize("meshed", ["finely", "in one polygon", "around its middle"])
def test_a_flat_sole_on_the_ground_is_no_filling(meshed):
    """A foot that stands on glass has one, and a polygon of an OBJ may be all of it."""
    vertices, faces, _ = foot()
    if meshed == "finely":
        mesh = np.column_stack([vertices[:, :2], np.maximum(vertices[:, 2], 3.0)]), faces
    else:
        cut = plane_cut(vertices, faces, np.array([0.0, 0.0, 3.0]), np.array([0.0, 0.0, -1.0]))
        mesh = filled(*cut, few_facets if meshed == "in one polygon" else centre_fan)
    mesh = mesh[0] - [0.0, 0.0, 3.0], mesh[1]
    assert not Shape(*mesh).filled.any()


@pytest.mark.parametrize("heel_mm", [0.0, 60.0])
@pytest.mark.parametrize("factor", [1.0, 10.0])
def test_a_last_with_its_cones_top_has_no_filling(heel_mm, factor):
    vertices, faces = last_mesh(LastSpec(heel_height_mm=heel_mm))
    mesh = decimated(vertices, faces, factor) if factor > 1.0 else (vertices, faces)
    assert not Shape(*mesh, "last").filled.any()


@pytest.mark.parametrize("noise_mm", [0.0, 0.2])
@pytest.mark.parametrize(
    ("heel_mm", "rings", "segments"), [(15, 200, 24), (50, 240, 28), (20, 170, 24)]
)
def test_a_boot_of_slender_strips_has_no_filling(heel_mm, rings, segments, noise_mm):
    """A strip's neighbour across its long edge is as long; a filling's neighbours are short."""
    rng = np.random.default_rng(4)
    spec = wide(rng, "boot", (heel_mm, heel_mm + 1.0), rings=rings, segments=segments)
    vertices, faces = last_mesh(spec)
    shape = Shape(white_noise(vertices, rng, noise_mm), faces, "last")
    assert not shape.filled.any()


@pytest.mark.parametrize(("power", "noise_mm"), [(8, 0.3), (14, 0.2), (14, 0.3)])
def test_noise_on_flat_walls_of_long_facets_is_no_crease(power, noise_mm):
    """A body with boxy sections, whose rings have short facets at the corners and long ones."""
    along, around = np.linspace(0.0, 1.0, 170), (np.arange(96) + 0.5) * 2.0 * np.pi / 96
    size = np.sqrt(np.clip(1.0 - (2.0 * along - 1.0) ** 4, 0.004, 1.0))[:, None]
    y, z = (
        np.sign(wave) * np.abs(wave) ** (2.0 / power) for wave in (np.cos(around), np.sin(around))
    )
    x = np.broadcast_to(260.0 * along[:, None], (170, 96))
    points = np.stack([x, 45.0 * size * y, 35.0 * size * (1.0 + z)], axis=2).reshape(-1, 3)
    faces = grid_faces(170, 96, (False, True))
    noisy = white_noise(points, np.random.default_rng(2), noise_mm)
    known = np.zeros(len(faces), dtype=bool)
    assert not filled_faces(noisy, faces, 260.0, known, plane_is_shape=True).any()


@pytest.mark.parametrize("filling", FILLINGS)
def test_the_filling_of_a_noisy_scan_is_known(filling):
    vertices, faces = with_filling("dorsum", filling)
    noisy = white_noise(vertices, np.random.default_rng(7), 0.2)
    assert reasons(noisy, faces)["instep_girth"] == NOT_SCANNED


@pytest.mark.parametrize("cut", [last_cuts.thimble, last_cuts.v_cut, last_cuts.slit])
def test_what_was_cut_out_of_a_last_takes_no_measure_away(cut):
    vertices, faces = last_mesh(LastSpec(rings=80, segments=64))
    whole, found = reasons(vertices, faces, "last"), reasons(*cut(vertices, faces), "last")
    for name in ("ball_girth", "waist_girth", "instep_girth", "heel_width", "toe_height"):
        assert found[name] == pytest.approx(whole[name], abs=1.0), name


# ---------------------------------------------------------------- the whole way


def test_from_a_scan_the_reason_reaches_the_answer():
    pose = random_pose(np.random.default_rng(3))
    vertices, faces = with_filling("dorsum", "strips")
    scan = footfit.read((moved(vertices, pose), faces), units="mm")
    rows = {row.name: row.measured for row in footfit.measure(scan, side="right").measures}
    assert rows["instep_girth"].value is None
    assert rows["instep_girth"].reason == NOT_SCANNED
    assert rows["length"].value == pytest.approx(foot()[2], abs=1.0)


@pytest.mark.parametrize("filling", FILLINGS)
def test_no_room_is_read_over_a_hole_that_was_closed(filling):
    last = Shape(*last_mesh(LastSpec(length_mm=290.0, rings=60, segments=48)), "last")
    whole, closed = Shape(*foot()[:2]), Shape(*with_filling("dorsum", filling))
    sizes = {pair.station.name: pair.foot_sizes for pair in section_pairs(closed, last)}
    for name in ("instep", "waist", "ball"):
        assert sizes[name]["height"] == MeasureValue(None, NOT_SCANNED)
    assert sizes["heel"]["width"].value is not None
    rooms, true = (
        {zone.zone: zone for zone in zone_clearances(shape, foot_clearance(shape, last))}
        for shape in (closed, whole)
    )
    for zone in rooms:  # the rim's triangles count a little more than before
        assert rooms[zone].area_cm2 < true[zone].area_cm2 + 1.0
    assert rooms["dorsal"].area_cm2 < 0.3 * true["dorsal"].area_cm2


@pytest.mark.skipif(not CASES.exists(), reason="the cases beside the project are not here")
def test_a_phones_scan_from_below_has_no_girth_over_the_dorsum():
    rows = {row.name: row.measured for row in footfit.measure(CASES / "nodorsum.stl").measures}
    for name in ("ball_girth", "waist_girth", "instep_girth", "toe_height", "instep_height"):
        assert (rows[name].value, rows[name].reason) == (None, NOT_SCANNED)
    assert rows["arch_height"].value == pytest.approx(9.0, abs=0.2)


@pytest.mark.skipif(not SCANS.exists(), reason="the scans beside the project are not here")
@pytest.mark.parametrize("name", ["dupontgu_L", "dupontgu_R", "MHR_template_R"])
def test_real_scans_with_flat_soles_and_lids_are_measured(name):
    aligned = footfit.align(SCANS / f"{name}.stl")
    assert not Shape(*right(aligned)).filled.any()


def right(aligned):
    return aligned.prepared.vertices_mm, aligned.prepared.faces
