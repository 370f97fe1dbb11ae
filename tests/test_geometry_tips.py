"""The outermost point of a surface: exact on spheres, steady under noise, never beyond a vertex."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.mesh.outermost_point import LAST_TIPS, TIPS, TipSettings, share_over, tip
from tests import shapes
from tests.bounds import EXACT, ROUNDING
from tests.distortions import random_rotation, subdivided, white_noise
from tests.strategies import seeds

LENGTH_MM = 250.0


@pytest.mark.parametrize("law", [TIPS, LAST_TIPS])
@settings(max_examples=10, deadline=None)
@given(seeds)
def test_the_reach_of_a_sphere_is_its_radius(law: TipSettings, seed: int) -> None:
    vertices, faces = shapes.sphere(40.0, 4)
    direction = random_rotation(np.random.default_rng(seed))[0]
    found = tip(vertices, faces, direction, LENGTH_MM, law)
    # an inscribed mesh of 5 mm edges lies up to e^2 / 6 r = .1 mm inside
    assert found.reach == pytest.approx(40.0, abs=0.06)
    assert np.linalg.norm(np.cross(found.place, direction)) < 0.02


def test_noise_moves_the_outermost_vertex_and_not_the_tip() -> None:
    vertices, faces = shapes.sphere(40.0, 5)
    rng = np.random.default_rng(3)
    noisy = [white_noise(vertices, rng, 0.3) for _ in range(12)]
    directions = [random_rotation(rng)[0] for _ in noisy]
    pairs = list(zip(noisy, directions, strict=True))
    vertex = np.mean([(v @ d).max() for v, d in pairs]) - 40.0
    found = np.array([tip(v, faces, d, LENGTH_MM).reach for v, d in pairs]) - 40.0
    assert vertex > 0.4
    assert abs(found.mean()) < 0.035  # measured 0.023
    assert np.sqrt(np.mean(found**2)) < 0.09  # measured 0.059


@pytest.mark.parametrize("turn_deg", [15.0, 30.0, 45.0])
def test_the_reach_over_an_edge_is_nearer_by_a_parabola(turn_deg: float) -> None:
    # a disc's rim, seen aslant, as the toe of a heeled last is
    tube, faces = shapes.cylinder(45.0, 60.0, 360, 80)
    turn = np.radians(turn_deg)
    direction = np.array([np.cos(turn), 0.0, np.sin(turn)])
    outermost = float((tube @ direction).max())
    by_line, by_parabola = (
        outermost - tip(tube, faces, direction, LENGTH_MM, law).reach for law in (TIPS, LAST_TIPS)
    )
    assert 0.0 <= by_parabola < 0.6 * by_line


def test_the_reach_of_a_flat_wall_is_the_wall() -> None:
    vertices, faces = shapes.cube(60.0, 6)
    assert tip(vertices, faces, np.array([1.0, 0.0, 0.0]), LENGTH_MM).reach == pytest.approx(30.0)


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_the_tip_is_the_surfaces_not_the_meshs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.convex_cloud(400, rng, (120.0, 45.0, 35.0))
    direction = random_rotation(rng)[0]
    one = tip(vertices, faces, direction, LENGTH_MM)
    other = tip(*subdivided(vertices, faces, rng.random(len(faces)) < 0.5), direction, LENGTH_MM)
    assert other.reach == pytest.approx(one.reach, abs=ROUNDING)
    outermost = float((vertices @ direction).max())
    assert outermost - TIPS.law[0] * LENGTH_MM <= one.reach <= outermost


@pytest.mark.parametrize("lopsided", [-1e-5, 0.0, 1e-5])
def test_a_shallower_cap_lies_nearer_to_the_top_of_a_lopsided_outline(lopsided: float) -> None:
    sheet, faces = shapes.flat_sheet(80.0, 60.0, 80)
    x, z = sheet[:, 0] - 40.0, sheet[:, 1] - 30.0
    outward = -np.square(x) / 300.0 + lopsided * x**3 - np.square(z) / 80.0
    vertices = np.column_stack([x, outward, z])
    deep, shallow = (
        tip(vertices, faces, np.array([0.0, 1.0, 0.0]), LENGTH_MM, settings).place[0]
        for settings in (TIPS, LAST_TIPS)
    )
    assert abs(shallow) <= 0.55 * abs(deep) + ROUNDING  # it grows as the depth does
    assert np.sign(deep.round(6)) == np.sign(lopsided)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=3))
def test_the_shares_over_all_levels_add_up_to_the_mean(corner: list[float]) -> None:
    """The integral of the share over the levels is the mean height over the lowest level."""
    levels = np.linspace(-5.0, 5.0, 20001)
    shares = share_over(np.array([corner]), levels)[0]
    assert np.all(np.diff(shares) <= EXACT)
    assert np.trapezoid(shares, levels) == pytest.approx(
        np.mean(corner) + 5.0, abs=5e-4
    )  # measured 2.5e-4: the trapezoids
