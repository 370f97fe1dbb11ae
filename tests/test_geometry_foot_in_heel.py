"""The surface of a foot in the heel: its measures are those that the heel model says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import footfit
from footfit.geometry.fit.foot_in_heel import SurfaceChange, foot_in_heel
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.pipeline.fit.heel_model import heel_model, heel_question
from footfit.pipeline.fit.heels import heels_of, surface_change
from tests import answers
from tests.bounds import EXACT
from tests.conftest import SAMPLES

FOLLOWED = {
    "length": 1.2e-5,
    "functional_length": 1.2e-5,
    "ball_length": 0.0013,
    "ball_width": 0.0016,
    "heel_width": 0.0003,
    "ball_girth": 0.00047,
    "waist_girth": 0.00098,
    "instep_girth": 0.0009,
}
"""How far each measure of the surface may be from the model, as a share of it: twice what was
measured at the two drops. The ball's places move a little along the foot, and with them its width.
"""


@pytest.fixture(scope="module")
def foot() -> Shape:
    prepared = footfit.align(SAMPLES / "feet" / "mh008_R.stl").prepared
    return Shape(prepared.vertices_mm, prepared.faces)


@pytest.mark.parametrize("drop_mm", [40.0, 100.0])
def test_the_surface_has_the_sizes_that_the_model_says(foot: Shape, drop_mm: float) -> None:
    record = answers.record(heel_height_mm=drop_mm)
    heels = heels_of(heel_question(), [record])
    raised = Shape(foot_in_heel(foot, surface_change(heels, 0)), foot.faces)
    for name, bound in FOLLOWED.items():
        rule = heel_model().rule_of(name.replace("functional_", ""))
        assert rule is not None
        before, after = (measure_named(name).value_of(shape).value for shape in (foot, raised))
        assert before is not None
        assert after is not None
        expected = 1.0 + float(heels.share[0]) * rule.change
        assert after / before == pytest.approx(expected, abs=bound), name


def test_heel_toes_and_sole_stay_where_they_are(foot: Shape) -> None:
    change = SurfaceChange(-0.015, -0.01, -0.015, 0.01, 0.01, 0.005)
    raised = foot_in_heel(foot, change)
    station = (foot.vertices_mm[:, 0] - foot.x_mm(0.0)) / foot.length_mm
    ends = (station < 1.0 / 6.0) | (station > 0.88)
    assert np.array_equal(raised[ends, 2], foot.vertices_mm[ends, 2])
    flat = foot.vertices_mm[:, 2] == 0.0
    assert np.array_equal(raised[flat, 2], foot.vertices_mm[flat, 2])
    assert foot_in_heel(foot, SurfaceChange()) == pytest.approx(foot.vertices_mm, abs=EXACT)
    wider = foot_in_heel(foot, replace(change, ball_girth=0.02))
    assert wider[:, 2].max() >= raised[:, 2].max()
    assert wider[:, 2].sum() > raised[:, 2].sum(), "more girth at one width is more height"
