"""How a low last rests on a table, how sure its tread is level, and what measures make of both."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import at_rest, measure_named
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.middle_line import turned
from tools.last_specs import LastSpec
from tools.lasts import last_mesh
from tools.resting import at_rest as laid_down

SMALL = {"rings": 90, "segments": 64}
LOW = LastSpec(level_tread=True, **SMALL)
TILT_DEG = 0.03  # of the angle of a last's resting line; measured: .017
TILTED_MM = 0.015  # of a height over that line; measured: .008
SAME_MM = 0.0002  # of what is read as the last stands; measured: .0001


@pytest.fixture(scope="module")
def low() -> Shape:
    """A low last on its resting line, turned from there by a degree: its toes are lowered."""
    vertices, faces = straight_mesh()
    return Shape(turned(vertices, np.radians(1.0)), faces, "last")


def straight_mesh() -> tuple[Floats, Ints]:
    """A low last on the longest lower edge of its side view."""
    vertices, faces = last_mesh(LOW)
    return laid_down(vertices)[0], faces


def test_a_last_that_was_turned_is_turned_back(low: Shape) -> None:
    rests = at_rest(low)
    assert rests is not None
    heel = np.argmin(low.vertices_mm[:, 0])
    toe = np.argmax(low.vertices_mm[:, 0])
    off = [shape.vertices_mm[toe] - shape.vertices_mm[heel] for shape in (low, rests)]
    angles = [np.degrees(np.arctan2(z, x)) for x, _, z in off]
    assert angles[1] - angles[0] == pytest.approx(1.0, abs=TILT_DEG)


def test_what_a_height_would_change_by_is_told(low: Shape) -> None:
    straight = Shape(*straight_mesh(), "last")
    height = measure_named("instep_height")
    value = height.with_tilt(low)
    assert value.value is not None
    right_mm = height.value_of(straight).value
    assert value.value + value.tilt_mm == pytest.approx(right_mm, abs=TILTED_MM)
    assert abs(value.tilt_mm) > TILTED_MM


def test_a_last_that_is_laid_down_stands_as_before(low: Shape) -> None:
    rests = at_rest(low)
    assert rests is not None
    for name in ("heel_height", "toe_spring_tip", "bottom_length"):
        before, after = (measure_named(name).value_of(shape).value for shape in (low, rests))
        assert after == pytest.approx(before, abs=SAME_MM)


def test_a_foot_rests_as_it_stands(low: Shape) -> None:
    assert at_rest(Shape(low.vertices_mm, low.faces, "foot")) is None


def test_what_the_cues_leave_open_is_in_the_level_of_the_tread() -> None:
    """Behind a crease the slope near the tread and the model of the bottom differ by a degree."""
    level, apart = [], []
    for length in (0.05, 0.15):
        spec = replace(LOW, heel_height_mm=60.0, break_length=length)
        stance = Shape(*last_mesh(spec), "last").stance
        assert stance is not None
        grounds = {cue.name: cue.ground for cue in stance.cues}
        level.append(stance.level_sd)
        apart.append(abs(grounds["tread"] - grounds["bottom"]))
    assert apart[0] > 2.0 * apart[1]  # .90 and .09 degrees
    assert level[0] > 1.2 * level[1]  # .62 and .45 degrees
