"""The shortest way of a tape, against a search that shares no code with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.spatial import ConvexHull

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.least_tape import heel_tape, tape_over
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.tape import hull_girth
from tests import shapes
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES
from tests.distortions import axis_rotation, leg_cut, moved, shuffled, white_noise
from tests.reading import read_scan
from tests.scans import aligned, right_shape
from tests.solids import capped
from tests.strategies import seeds
from tests.tape_peer import edges_of, least_about, least_girths
from tools.bent_lasts import bent
from tools.last_specs import LastSpec
from tools.lasts import last_mesh

LEAST = ("ball_girth_least", "waist_girth_least", "instep_girth_least", "heel_girth_instep")
SPEC = LastSpec(length_mm=275.0, toe_spring_mm=5.0, level_tread=True, rings=110, segments=72)


def foot() -> Shape:
    scan = read_scan(SAMPLES / "feet" / "mh007_R.stl")
    return Shape(*right_shape(aligned(scan, side="right")), "foot")


def last(heel_mm: float, **given: float) -> Shape:
    spec = LastSpec(**{"rings": 120, "segments": 80, "heel_height_mm": heel_mm, **given})
    return Shape(*last_mesh(spec), "last")


def girths(shape: Shape, names: tuple[str, ...] = LEAST) -> dict[str, float]:
    """Measures that must be there, by name."""
    values = {name: measure_named(name).value_of(shape) for name in names}
    assert all(value.value is not None for value in values.values()), values
    return {name: value.value for name, value in values.items()}


# ------------------------------------------------------------------ truth


@pytest.mark.parametrize("heel_mm", [None, 0.0, 50.0, 110.0])
def test_no_plane_through_the_places_has_a_lesser_girth(heel_mm: float | None) -> None:
    shape = foot() if heel_mm is None else last(heel_mm)
    assert girths(shape) == pytest.approx(least_girths(shape), abs=0.15)  # asked: 0.3


@pytest.mark.parametrize(("lean_deg", "turn_deg"), [(5.0, 0.0), (20.0, 6.0), (38.0, -9.0)])
def test_a_tape_around_a_leaning_tube_is_its_circle(lean_deg: float, turn_deg: float) -> None:
    """The shortest way around a round tube is square to its axis, however the tube lies."""
    tube, faces = shapes.cylinder(35.0, 300.0, around=120, along=40)
    tube = moved(tube, axis_rotation("y", 90.0 + lean_deg))
    shape = Shape(moved(tube, axis_rotation("z", -turn_deg)), faces)
    middle = shape.vertices_mm.mean(axis=0)
    upright = axis_rotation("z", -turn_deg)[:3, :3] @ axis_rotation("y", lean_deg)[:3, 2]
    tape = tape_over(shape, middle + 34.9 * upright)
    circle_mm = 120 * 2.0 * 35.0 * np.sin(np.pi / 120)
    assert hull_girth(tape.section(shape).points) == pytest.approx(circle_mm, abs=0.05)
    assert tape.tilt_deg == pytest.approx(lean_deg, abs=2.0)


@pytest.mark.parametrize("turning", [0.0, 0.5])
def test_one_last_bent_to_a_higher_heel_keeps_its_ball_girth(turning: float) -> None:
    flat, faces = last_mesh(replace(SPEC, heel_height_mm=0.0))
    ball = []
    for heel_mm in (0.0, 30.0, 60.0, 90.0, 110.0):
        vertices = at_rest(bent(flat, SPEC.length_mm, heel_mm, turning))
        ball.append(girths(Shape(vertices, faces, "last"), ("ball_girth_least",)))
    values = [value["ball_girth_least"] for value in ball]
    assert np.ptp(values) < 1.0, values


def test_a_cone_that_leans_over_the_ball_does_not_stop_the_tape() -> None:
    """Bent to a heel of 110 mm with its sections turned, a last has its cone over its ball. The
    tape stopped 2.1 mm over the least where its plane runs into the cone.
    """
    flat, faces = last_mesh(replace(SPEC, heel_height_mm=0.0))
    shape = Shape(at_rest(bent(flat, SPEC.length_mm, 110.0, 1.0)), faces, "last")
    assert shape.joints is not None
    least = least_about(shape.vertices_mm, edges_of(faces), *shape.joints, shape.upright)
    ball = girths(shape, ("ball_girth_least",))["ball_girth_least"]
    assert ball == pytest.approx(least, abs=0.3)  # measured: 0.14


def at_rest(vertices: np.ndarray) -> np.ndarray:
    """A standing last, turned until its heel and its ball lie on the ground (the hull's line)."""
    side = vertices[:, [0, 2]]
    hull = side[ConvexHull(side).vertices]
    edges = np.roll(hull, -1, axis=0) - hull
    under = edges[np.argmax(edges[:, 0])]
    pitch_deg = float(np.degrees(np.arctan2(under[1], under[0])))
    lying = moved(vertices, axis_rotation("y", pitch_deg))
    return lying - lying.min(axis=0) * [1.0, 0.0, 1.0]


# ------------------------------------------------------------------ laws


@pytest.mark.parametrize("heel_mm", [None, 25.0, 90.0])
def test_the_tape_is_not_longer_than_in_the_fixed_plane(heel_mm: float | None) -> None:
    """At the ball the fixed plane is one of those that the tape may take; the tape's corners may
    add what the fixed plane's outline rounds off.
    """
    shape = foot() if heel_mm is None else last(heel_mm)
    found = girths(shape, ("ball_girth", "ball_girth_least"))
    assert found["ball_girth_least"] < found["ball_girth"] + 0.8


def test_the_order_of_faces_and_vertices_is_no_matter() -> None:
    shape = last(50.0)
    rng = np.random.default_rng(4)
    other = Shape(*shuffled(shape.vertices_mm, shape.faces, rng), "last")
    assert girths(other) == pytest.approx(girths(shape), abs=ROUNDING)


@settings(max_examples=3, deadline=None)
@given(seeds)
def test_noise_moves_the_least_girth_by_no_more_than_three_sds(seed: int) -> None:
    shape = last(60.0)
    rng = np.random.default_rng(seed)
    noisy = Shape(white_noise(shape.vertices_mm, rng, 0.3), shape.faces, "last")
    before, after = girths(shape), girths(noisy)
    for name in LEAST:
        assert abs(after[name] - before[name]) < 3.0 * measure_named(name).sd, name


# ------------------------------------------------------------------ missing geometry


@pytest.mark.parametrize("closed", [True, False])
def test_a_leg_cut_at_the_instep_has_no_girth_over_it(closed: bool) -> None:
    whole = foot()
    vertices, faces = leg_cut(whole.vertices_mm, whole.faces, 55.0)
    if closed:
        vertices, faces = capped(vertices, faces)
    cut = Shape(vertices, faces, "foot")
    for name in ("instep_girth_least", "heel_girth_instep"):
        taken = measure_named(name).value_of(cut)
        assert taken.value is None, name
        assert "instep" in (taken.reason or "")
    near = ("ball_girth_least", "waist_girth_least")
    assert girths(cut, near) == pytest.approx(girths(whole, near), abs=0.01)


def test_an_open_sole_gives_reasons() -> None:
    whole = foot()
    low = whole.vertices_mm[whole.faces].mean(axis=1)[:, 2] < 8.0
    soleless = Shape(whole.vertices_mm, whole.faces[~low], "foot")
    for name in LEAST:
        taken = measure_named(name).value_of(soleless)
        assert taken.value is None, name
        assert "open" in (taken.reason or ""), name


def test_a_last_that_is_sawn_off_low_has_no_instep() -> None:
    whole = last(25.0)
    sawn = Shape(*capped(*leg_cut(whole.vertices_mm, whole.faces, 50.0)), "last")
    for name in ("instep_girth_least", "heel_girth_instep"):
        assert measure_named(name).value_of(sawn).reason == (
            "the last is sawn off below the instep"
        ), name
    near = ("ball_girth_least",)
    assert girths(sawn, near) == pytest.approx(girths(whole, near), abs=ROUNDING)


def test_a_toe_that_rises_over_the_instep_is_not_within_the_tape() -> None:
    """A flat last that is bent to a heel of 90 mm with upright sections has its toe so high."""
    flat, faces = last_mesh(replace(SPEC, heel_height_mm=0.0))
    low, high = (
        Shape(at_rest(bent(flat, SPEC.length_mm, heel_mm)), faces, "last") for heel_mm in (60, 90)
    )
    tape = heel_tape(high)
    assert girths(high)["heel_girth_instep"] == pytest.approx(
        girths(low)["heel_girth_instep"], rel=0.05
    )
    assert tape.section(high).points[:, 0].max() < tape.reach_mm + 5.0


def test_a_plane_that_runs_through_the_whole_forepart_gives_no_girth() -> None:
    """A short flat last, bent to 110 mm with upright sections: its toe rises over its instep."""
    flat, faces = last_mesh(replace(SPEC, length_mm=255.0, heel_height_mm=0.0))
    folded = Shape(at_rest(bent(flat, 255.0, 110.0)), faces, "last")
    taken = measure_named("heel_girth_instep").value_of(folded)
    assert (taken.value, taken.reason) == (None, "the forepart is in the tape's way")
