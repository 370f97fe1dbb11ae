"""Room between surfaces, and how a foot is laid into a last: formulas and planted poses."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import NoSole
from footfit.geometry.fit.clearance import (
    CLEARANCE,
    ZONES,
    foot_clearance,
    signed_clearance,
    zone_clearances,
    zone_of,
)
from footfit.geometry.fit.paired_sections import section_pairs
from footfit.geometry.fit.placement import Placement, placed, placement
from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.nearest import nearest_on_surface, part_middles
from footfit.geometry.mesh.surface import area_vectors, unit
from tests import shapes
from tests.bounds import ROUNDING
from tools.lasts import LastSpec, last_mesh


@cache
def last(length_mm: float = 272.0, flare_deg: float = 7.0) -> Shape:
    return Shape(*last_mesh(LastSpec(length_mm=length_mm, flare_deg=flare_deg)), "last")


def scaled(shape: Shape, factor: float) -> Shape:
    return Shape(shape.vertices_mm * factor, shape.faces, shape.kind)


def turned(vertices, pitch_deg, yaw_deg, shift):
    p, y = np.radians([pitch_deg, yaw_deg])
    about_y = np.array([[np.cos(p), 0, -np.sin(p)], [0, 1, 0], [np.sin(p), 0, np.cos(p)]])
    about_z = np.array([[np.cos(y), -np.sin(y), 0], [np.sin(y), np.cos(y), 0], [0, 0, 1]])
    return vertices @ (about_z @ about_y).T + shift


# ---------------------------------------------------------------- the signed distance


@pytest.mark.parametrize(("inner", "outer"), [(50.0, 60.0), (30.0, 31.0)])
def test_a_sphere_in_a_larger_one_has_room_and_the_larger_in_it_has_none(inner, outer):
    small, large = shapes.sphere(inner, 4), shapes.sphere(outer, 4)
    sagitta = outer * 0.002  # the inscribed sphere's faces lie inside it
    room = signed_clearance(small[0], *large)
    assert np.all(np.abs(room - (outer - inner)) < sagitta)
    tight = signed_clearance(large[0], *small)
    assert np.all(np.abs(tight + (outer - inner)) < sagitta)


def test_a_surface_has_no_room_against_itself():
    vertices, faces = shapes.ellipsoid()
    assert np.abs(signed_clearance(vertices, vertices, faces)).max() < ROUNDING


@settings(deadline=None, max_examples=60)
@given(st.lists(st.floats(-90.0, 90.0), min_size=3, max_size=3))
def test_the_distance_to_a_cube_is_the_formula_inside_and_outside(point):
    """A cube is all creases: the side of a point whose nearest place is an edge or a corner."""
    vertices, faces = shapes.cube(100.0, 4)
    inside = 50.0 - np.max(np.abs(point))
    outside = np.linalg.norm(np.maximum(np.abs(point) - 50.0, 0.0))
    truth = inside if inside > 0.0 else -outside
    found = signed_clearance(np.array([point]), vertices, faces)[0]
    # In the very middle six faces are as near, and another than the nearest may be tried: 2.2e-7.
    assert found == pytest.approx(truth, abs=3e-7)


def test_the_side_of_a_sharp_edge_is_known_all_around_it():
    """Two faces of a tetrahedron look 109 degrees apart: one of them alone names a wrong side."""
    vertices, faces = shapes.tetrahedron(100.0)
    points = np.random.default_rng(5).uniform(-70.0, 70.0, (500, 3))
    outward = unit(area_vectors(vertices, faces))
    ahead = np.einsum("pfx,fx->pf", points[:, None] - vertices[faces[:, 0]], outward)
    assert np.array_equal(
        signed_clearance(points, vertices, faces) > 0.0, (ahead < 0.0).all(axis=1)
    )


def test_large_and_small_triangles_give_the_same_distance():
    points = np.random.default_rng(3).uniform(-80.0, 80.0, (400, 3))
    coarse, fine = (shapes.cube(100.0, cells) for cells in (2, 12))
    one, other = (nearest_on_surface(points, *mesh).distance for mesh in (coarse, fine))
    assert np.abs(one - other).max() < ROUNDING


def test_an_open_rim_has_no_side():
    vertices, faces = shapes.cylinder()
    wall = faces[(faces < len(vertices) - 2).all(axis=1)]
    room = signed_clearance(np.array([[0.0, 0.0, -30.0], [0.0, 0.0, 125.0]]), vertices, wall)
    assert np.isnan(room[0])
    assert room[1] == pytest.approx(40.0, abs=0.0091)  # measured 0.0061


@pytest.mark.parametrize("split", [1, 2, 5])
def test_the_parts_of_a_triangle_are_equal_and_fill_it(split):
    middles = part_middles(split)
    assert len(middles) == split * split
    assert np.allclose(middles.sum(axis=1), 1.0)
    assert np.allclose(middles.mean(axis=0), 1 / 3)


# ---------------------------------------------------------------- placement


def test_a_placement_that_is_not_sought_yet_moves_nothing():
    start = Placement(np.zeros(2), 1.0)
    vertices, _ = last_mesh(LastSpec(rings=60, segments=40))
    assert np.array_equal(placed(vertices, start), vertices)
    assert start.swing_mm == 0.0


def test_a_last_lies_in_itself_without_moving():
    way = placement(last(), last())
    assert np.abs(placed(last().vertices_mm, way) - last().vertices_mm).max() < ROUNDING
    assert way.swing_mm == pytest.approx(0.0, abs=ROUNDING)
    room = foot_clearance(last(), last())
    assert np.nanmax(np.abs(room)) < ROUNDING


@pytest.mark.parametrize(
    ("pitch_deg", "yaw_deg", "shift"),
    [(4.0, 0.0, (0.0, 0.0, 0.0)), (0.0, -5.0, (3.0, -2.0, 6.0)), (-6.0, 3.0, (-8.0, 4.0, -3.0))],
)
def test_a_moved_copy_is_brought_back(pitch_deg, yaw_deg, shift):
    moved = Shape(turned(last().vertices_mm, pitch_deg, yaw_deg, shift), last().faces, "last")
    back = placed(moved.vertices_mm, placement(moved, last()))
    low = last().vertices_mm[:, 2] < 0.3 * 272.0
    assert np.abs(back - last().vertices_mm)[low].max() < 0.5


def test_the_swing_is_how_far_the_axes_part_at_the_ball():
    yaw_deg = 4.0
    moved = Shape(turned(last().vertices_mm, 0.0, yaw_deg, np.zeros(3)), last().faces, "last")
    way = placement(moved, last())
    assert way.yaw_deg == pytest.approx(-yaw_deg, abs=1.3e-8)  # measured 8.3e-09
    assert way.swing_mm == pytest.approx(
        -np.tan(np.radians(yaw_deg)) * 0.65 * 272.0, abs=0.046
    )  # measured 0.03


def test_a_flat_foot_bends_at_its_tread_into_a_toe_spring():
    """The foot is a last whose forepart was bent down: the bend that brings it back is found."""
    bend = replace(placement(last(), last()), bend_deg=-8.0)
    flat = Shape(placed(last().vertices_mm, bend), last().faces, "foot")
    way = placement(flat, last())
    assert way.bend_deg == pytest.approx(8.0, abs=0.6)
    assert abs(way.pitch_deg) < 0.0013  # measured 0.00084
    back = placed(flat.vertices_mm, way)
    low = last().vertices_mm[:, 2] < 20.0
    assert np.abs(back - last().vertices_mm)[low].max() < 1.0


def test_no_bottom_is_refused_in_words():
    open_front = last().faces[(last().vertices_mm[last().faces][:, :, 0] < 150.0).all(axis=1)]
    with pytest.raises(NoSole, match="to rest on"):
        placement(last(), Shape(last().vertices_mm, open_front, "last"))


# ---------------------------------------------------------------- zones


def in_the_last(foot: Shape, around: Shape) -> tuple[Shape, np.ndarray]:
    inside = Shape(placed(foot.vertices_mm, placement(foot, around)), foot.faces, foot.kind)
    return inside, foot_clearance(inside, around)


def test_a_smaller_copy_has_room_on_every_side_and_a_larger_one_is_tight():
    for factor, sign in ((0.94, 1.0), (1.06, -1.0)):
        foot, room = in_the_last(Shape(scaled(last(), factor).vertices_mm, last().faces), last())
        zones = {zone.zone: zone for zone in zone_clearances(foot, room)}
        for name in ("medial", "lateral", "dorsal", "toe"):
            assert sign * zones[name].mean_mm > 1.0, (factor, name)
        assert abs(zones["bottom"].mean_mm) < 0.29  # it rests on the last's bottom


def test_a_fat_foot_is_tight_and_a_thin_one_loose_over_square_centimetres():
    for factor in (0.75, 1.25):
        foot = Shape(last().vertices_mm * [1.0, factor, factor], last().faces)
        zones = zone_clearances(*in_the_last(foot, last()))
        tight, loose = (
            sum(getattr(z, f"{word}_cm2") for z in zones) for word in ("tight", "loose")
        )
        assert max(tight, loose) > 110.0  # measured 190
        assert (tight > loose) == (factor > 1.0)


def test_width_alone_is_felt_at_the_sides_by_half_of_it():
    """A foot as the last but 6 % narrower: 6 % of half the width on either side, none in length."""
    narrow = Shape(last().vertices_mm * [1.0, 0.94, 1.0], last().faces)
    _, room = in_the_last(narrow, last())
    ball = (np.abs(last().vertices_mm[:, 0] - 0.66 * 272.0) < 6.0) & (last().vertices_mm[:, 2] < 20)
    lateral = ball & (zone_of(narrow) == ZONES.index("lateral"))
    half_mm = 0.06 * np.abs(last().vertices_mm[lateral, 1]).max()
    assert np.nanmax(room[lateral]) == pytest.approx(half_mm, abs=0.47)  # measured 0.31


def test_a_leg_changes_nothing():
    """The same foot with a column on top: what lies over the topline is not compared."""
    foot = Shape(scaled(last(), 0.95).vertices_mm, last().faces)
    taller = foot.vertices_mm.copy()
    high = taller[:, 2] > 0.31 * foot.length_mm
    taller[high, 2] += 60.0
    tall = Shape(taller, foot.faces)
    assert np.isnan(foot_clearance(tall, last())[high]).all()
    low = foot.vertices_mm[:, 2] < 0.2 * foot.length_mm
    one, other = foot_clearance(foot, last()), foot_clearance(tall, last())
    assert np.nanmax(np.abs(one[low] - other[low])) < ROUNDING


def test_the_zones_hold_the_whole_foot_and_their_areas_sum():
    foot, room = in_the_last(Shape(scaled(last(), 0.95).vertices_mm, last().faces), last())
    zones = zone_clearances(foot, room)
    assert [zone.zone for zone in zones] == list(ZONES)
    for zone in zones:
        assert zone.p05_mm <= zone.mean_mm <= zone.p95_mm
        assert 0.0 <= zone.tight_cm2 + zone.loose_cm2 <= zone.area_cm2
    nothing = zone_clearances(foot, np.full(len(room), np.nan))
    assert all(zone.mean_mm is None and zone.area_cm2 == 0.0 for zone in nothing)
    assert CLEARANCE.tight_mm < 0.0 < CLEARANCE.loose_mm


# ---------------------------------------------------------------- sections


def test_the_sections_of_a_last_against_itself_are_the_same():
    for pair in section_pairs(last(), last()):
        assert pair.foot_sizes == pair.last_sizes
        assert pair.foot_sizes["width"].value > 40.0


def test_a_wider_last_is_wider_in_every_section_by_its_share():
    wide = Shape(last().vertices_mm * [1.0, 1.05, 1.0], last().faces, "last")
    for pair in section_pairs(last(), wide):
        assert pair.last_sizes["width"].value == pytest.approx(
            1.05 * pair.foot_sizes["width"].value,
            abs=0.1,  # measured 0.066
        )
        assert pair.station in STATIONS


def test_a_section_through_the_cut_top_has_no_height_but_a_width():
    heel = section_pairs(last(), last())[0]
    assert heel.station.name == "heel"
    assert heel.last_sizes["height"].value is None
    assert "heel" in heel.last_sizes["height"].reason
    assert heel.last_sizes["width"].value > 40.0
