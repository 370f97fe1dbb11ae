"""One last bent to other heels: its bottom stays as long, and so does the toe room in it."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from footfit.geometry.fit.along_the_bottom import (
    ALONG_BOTTOM,
    LastLengths,
    length_along_bottom,
)
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from tests.bounds import EXACT
from tools.bent_lasts import bent
from tools.last_specs import LastSpec
from tools.lasts import last_mesh
from tools.resting import at_rest

SPEC = LastSpec(
    length_mm=255.0,
    heel_height_mm=0.0,
    toe_spring_mm=6.0,
    level_tread=True,
    rings=110,
    segments=80,
)
HEELS_MM = (0.0, 30.0, 60.0, 90.0, 110.0)
DRAWN = LastLengths(249.7, 229.7, 83.1, 20.2, 139.8, 182.8, 6.0)


def bent_lasts(spec: LastSpec, turning: float) -> list[dict[str, float]]:
    """The lengths of one last, by name, at rest with each heel."""
    vertices, faces = last_mesh(spec)
    stance = Shape(vertices, faces, "last").stance
    assert stance is not None
    stands = stance.standing_transform
    level = vertices @ stands[:3, :3].T + stands[:3, 3]
    names = ("functional_length", *(field.name for field in fields(LastLengths)))
    rows = []
    for heel_mm in HEELS_MM:
        raised, _ = at_rest(bent(level, stance.length_mm, heel_mm, turning))
        shape = Shape(raised, faces, "last")
        rows.append({name: measure_named(name).value_of(shape).value for name in names})
    return rows


@pytest.mark.parametrize("turning", [0.0, 0.5, 1.0])
def test_one_last_is_as_long_along_its_bottom_at_every_heel(turning: float) -> None:
    """Its sections stay upright, or turn with the bottom: real bending lies between."""
    rows = bent_lasts(SPEC, turning)
    assert np.ptp([row["bottom_length"] for row in rows]) < 0.75  # measured .50, .14 and .28
    along = []
    for row in rows:
        level_mm = row.pop("functional_length")
        mm, sd_mm = length_along_bottom(level_mm, LastLengths(**row))
        along.append(mm)
        assert abs(mm - along[0]) <= 2.0 * sd_mm + 0.5
    assert along[0] == pytest.approx(254.8, abs=0.1)
    assert np.abs(np.array(along) - along[0]).max() < 2.0  # measured 1.4, .5 and 1.3


def test_a_level_last_is_as_long_as_it_is_and_no_heel_makes_a_step() -> None:
    for heel_mm in (0.0, 2.0, ALONG_BOTTOM.level_mm):
        low = replace(DRAWN, heel_height=heel_mm)
        assert length_along_bottom(255.0, low) == (255.0, 0.0)
    heels = np.linspace(0.0, 110.0, 441)
    mm = [length_along_bottom(255.0, replace(DRAWN, heel_height=heel))[0] for heel in heels]
    assert np.abs(np.diff(mm)).max() < 0.4


def test_a_graded_last_is_graded_along_its_bottom() -> None:
    shares = {
        field.name: 1.1 * getattr(DRAWN, field.name)
        for field in fields(LastLengths)
        if field.name != "seat_angle_deg"
    }
    larger = length_along_bottom(1.1 * 255.0, replace(DRAWN, **shares))
    assert larger == pytest.approx(1.1 * np.array(length_along_bottom(255.0, DRAWN)), abs=EXACT)


def test_the_overhang_is_what_the_stick_shows_of_a_low_last_and_the_usual_one_of_a_high() -> None:
    """A stick that shows 3 mm more overhang: 2.6 mm of it count at 40 mm of heel."""
    for heel_mm, seat_deg, least, most in ((40.0, 2.0, 2.4, 2.95), (110.0, 27.0, 0.3, 1.0)):
        last = replace(DRAWN, heel_height=heel_mm, seat_angle_deg=seat_deg)
        more = replace(last, stick_length=last.stick_length + 3.0)
        more_mm = length_along_bottom(255.0, more)[0] - length_along_bottom(255.0, last)[0]
        assert least < more_mm < most
