"""The section field: what it must not move, and that it brings measures to their targets."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from benchmarks import stance
from footfit.geometry.deform.chart import chart_of
from footfit.geometry.deform.field import Bump, Field, least_determinant
from footfit.geometry.deform.hump import Hump
from footfit.geometry.deform.probes import girth_probe, span_probe
from footfit.geometry.deform.solver import Knob, solution
from footfit.geometry.deform.wishes import Goal
from footfit.geometry.measures.girths import ball_girth, instep_girth
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.widths import ball_width
from footfit.geometry.mesh.surface import face_normals
from tools.lasts import LastSpec, last_mesh


@cache
def last(heel_mm: float = 30.0) -> Shape:
    """A small right last in its resting frame."""
    spec = LastSpec(heel_height_mm=heel_mm, level_tread=True, rings=90, segments=70)
    return Shape(*last_mesh(spec), "last")


def changed(shape: Shape) -> Field:
    """A field with every curve in use."""
    still = Field.still(chart_of(shape))
    at = still.chart.centres()
    inner = (at > 0.1) & (at < 0.8)
    return still.with_curves(
        ahead=8.0 * np.clip((at - 0.25) / 0.3, 0.0, 1.0),
        wider=np.where(inner, 0.06, 0.0),
        higher=np.where(inner, 0.08, 0.0),
        turned=np.radians(3.0) * np.clip((at - 0.4) / 0.15, 0.0, 1.0),
    )


def test_a_still_field_moves_nothing():
    shape = last()
    moved = Field.still(chart_of(shape)).moved_points(shape.vertices_mm)
    np.testing.assert_array_equal(moved, shape.vertices_mm)


@pytest.mark.parametrize("heel_mm", [0.0, 70.0])
def test_what_a_last_maker_keeps_stays(heel_mm):
    """The bottom's heights and the top plane within .1 mm; the toe turns as a rigid body."""
    shape = last(heel_mm)
    field = changed(shape)
    before = field.chart.standing(shape.vertices_mm)
    after = field.chart.standing(field.moved_points(shape.vertices_mm))
    shift = after - before
    bottom = shape.faces[face_normals(before, shape.faces)[:, 2] < -0.6].ravel()
    assert np.abs(shift[bottom, 2]).max() < 0.1
    assert field.chart.top is not None
    on_top = field.chart.top.heights(before) > 0.5
    assert on_top.sum() > 20
    assert np.linalg.norm(shift[on_top], axis=1).max() < 0.1
    along, _ = shape.bottom_arc.shares(shape.vertices_mm)
    toe = along > 0.94
    start, end = (points[toe] - points[toe].mean(axis=0) for points in (before, after))
    left, _, right = np.linalg.svd(start.T @ end)
    assert np.linalg.norm(start @ left @ right - end, axis=1).max() < 0.02
    assert np.linalg.norm(shift[toe], axis=1).min() > 6.0


def test_the_top_of_a_high_heel_is_seen():
    """It looks backward as the last rests: then the instep was taken for it."""
    if not stance.second_family():
        pytest.skip("../shared/tools/lasts2.py is not here; the project's own lasts are tested")
    case = stance.other(np.random.default_rng(2), (96.0, 100.0), 0)
    shape = Shape(case.vertices_mm, case.faces, "last")
    chart = chart_of(shape)
    standing = chart.standing(shape.vertices_mm)
    assert chart.top is not None
    assert chart.top.normal[2] > 0.9
    held = chart.top.heights(standing) > 0.0
    assert standing[held, 2].min() > 0.8 * standing[:, 2].max()
    assert held.sum() > 100


def test_the_slope_of_heights_does_not_overshoot():
    """The slope rises over .35 of the section's height, and stays: it never overshoots."""
    shape = last()
    chart = chart_of(shape)
    still = Field.still(chart)
    field = replace(still, chart=replace(chart, top=None), higher=np.full_like(still.higher, -0.2))
    x_mm, z_mm = (float(value[0]) for value in chart.arc.line.at(np.array([120.0])))
    up_mm = np.linspace(0.0, 90.0, 400)
    ray = np.column_stack([np.full(400, x_mm), np.zeros(400), z_mm + up_mm])
    slope = np.gradient(field.moved(field.chart.places(ray))[:, 2], up_mm)
    assert (np.diff(slope) < 1e-9).all()
    assert slope[-1] == pytest.approx(np.exp(-0.2), abs=1e-6)


def test_the_determinant_says_how_far_a_field_is_from_a_fold():
    shape = last()
    field = changed(shape)
    assert least_determinant(Field.still(field.chart), shape.vertices_mm) == pytest.approx(1.0)
    assert 0.3 < least_determinant(field, shape.vertices_mm) < 1.0
    folded = field.with_curves(ahead=-90.0 * np.clip((field.chart.centres() - 0.4) / 0.1, 0, 1))
    assert least_determinant(folded, shape.vertices_mm) < 0.0


def test_a_bump_swells_to_its_size_and_ends_at_its_radius():
    shape = last()
    chart = chart_of(shape)
    centre = chart.standing(shape.mt1[None])[0]
    still = Field.still(chart)
    field = Field(**{**vars(still), "bumps": (Bump(centre, AXES[1], 25.0, 4.0),)})
    shift = field.moved_points(shape.vertices_mm) - shape.vertices_mm
    far = np.linalg.norm(chart.standing(shape.vertices_mm) - centre, axis=1) > 25.0
    assert np.abs(shift[far]).max() == 0.0
    assert shift[:, 1].max() == pytest.approx(4.0, abs=0.2)


def family(name: str) -> Shape:
    """A last of a family."""
    if name == "own":
        return last()
    if not stance.second_family():
        pytest.skip("../shared/tools/lasts2.py is not here; the project's own lasts are tested")
    case = stance.other(np.random.default_rng(5), (20.0, 50.0), 0)
    return Shape(case.vertices_mm, case.faces, "last")


HUMPS = tuple(
    Hump(curve, size, 0.70, 0.84, 0.93)
    for curve, size in (("wider", 0.05), ("aside", 2.0), ("higher", 0.12))
)


@pytest.mark.parametrize("name", ["own", "lasts2"])
@pytest.mark.parametrize("bottom_kept", [False, True])
def test_a_hump_changes_only_its_stretch_of_the_arc(name, bottom_kept):
    shape = family(name)
    chart = chart_of(shape)
    field = replace(Field.still(chart, bottom_kept=bottom_kept), humps=HUMPS)
    standing = chart.standing(shape.vertices_mm)
    places = chart.places(standing)
    shift = field.moved(places) - standing
    beyond = (places.share >= 0.93) | (places.share <= 0.70)
    assert np.abs(shift[beyond]).max() == 0.0
    assert np.abs(shift[places.scaled_mm == 0.0, 2]).max() == 0.0  # the bottom keeps its heights
    assert np.abs(shift[:, 0]).max() == 0.0
    at = np.abs(places.share - 0.84) < 0.01
    assert 2.0 < shift[at, 2].max() < 4.0
    assert shift[at, 1].max() > 3.0  # to the medial side, and wider
    if bottom_kept:
        assert np.abs(shift[places.risen == 0.0]).max() == 0.0
    assert 0.9 < least_determinant(field, shape.vertices_mm) < 1.0
    wider, higher = field.scales(shape.vertices_mm)
    assert wider.max() == pytest.approx(np.exp(0.05), abs=2e-3) or bottom_kept
    assert 1.05 < higher.max() < np.exp(0.12)


def test_an_even_field_with_humps_leads_back():
    shape = last()
    chart = chart_of(shape)
    even = replace(Field.still(chart), even=True, humps=HUMPS)
    back = replace(even, humps=tuple(replace(hump, size=-hump.size) for hump in HUMPS))
    there = even.moved_points(shape.vertices_mm)
    assert np.abs(there - shape.vertices_mm).max() > 3.0
    np.testing.assert_allclose(back.moved_points(there), shape.vertices_mm, atol=0.01)


@pytest.mark.parametrize("heel_mm", [10.0, 70.0])
def test_the_solver_meets_girths_and_widths(heel_mm):
    shape = last(heel_mm)
    chart = chart_of(shape)
    ones = np.eye(chart.settings.knots)
    at = chart.centres()
    free = np.flatnonzero((at > 0.1) & (at < 0.8))
    knobs = [Knob(curve, ones[k]) for curve in ("wider", "higher") for k in free]
    measures = (ball_girth, instep_girth, ball_width)

    def read(vertices_mm: np.ndarray) -> np.ndarray:
        now = Shape(vertices_mm, shape.faces, "last")
        return np.array([measure(now).value for measure in measures])

    across = (shape.mt1 - shape.mt5) * [1.0, 1.0, 0.0]
    vertices_mm, faces = shape.vertices_mm, shape.faces
    probes = (
        girth_probe(vertices_mm, faces, *shape.ball_plane),
        girth_probe(vertices_mm, faces, shape.instep, AXES[1:]),
        span_probe(vertices_mm, shape.mt5, shape.mt1, across / np.linalg.norm(across)),
    )
    own = read(vertices_mm)
    targets = own + np.array([9.0, -4.0, 2.0])
    goals = [Goal(target, probe) for target, probe in zip(targets, probes, strict=True)]
    solved = solution(Field.still(chart), knobs, vertices_mm, goals, read)
    np.testing.assert_allclose(solved.values_mm, targets, atol=0.05)
    assert solved.rounds <= 8
    assert least_determinant(solved.field, shape.vertices_mm) > 0.4
    goals = [Goal(target, probe) for target, probe in zip(own, probes, strict=True)]
    same = solution(Field.still(chart), knobs, vertices_mm, goals, read)
    np.testing.assert_array_equal(same.vertices_mm, shape.vertices_mm)
