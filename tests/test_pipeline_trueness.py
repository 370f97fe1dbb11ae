"""What a value says of its own uncertainty: total_sd, bias, and what is added to them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.trueness import laid_down
from footfit.errors import BadOption
from footfit.geometry.measures.measure_table import HEELS_MM, MEASURES, measure_named, of_kind
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.pipeline.scan.measure import scan_measures
from footfit.pipeline.scan.trueness import SCANNER_SD_MM, check_scanner, measured
from tests import answers
from tests.measure_peer import Drafted, true_measures
from tests.scans import aligned, cleaned
from tools.last_specs import LastSpec
from tools.lasts import last_mesh, standing
from tools.resting import pitched

GIRTH = measure_named("ball_girth")


def test_every_measure_states_a_trueness_for_each_kind_and_heel() -> None:
    for kind, count in (("foot", 1), ("last", len(HEELS_MM))):
        for entry in of_kind(kind):
            stands_flat = (kind, entry.name) == ("foot", "heel_height")  # a foot has no such value
            assert stands_flat or len(entry.trueness(kind).sd) == count, (kind, entry.name)


def test_the_squares_of_all_parts_are_added() -> None:
    trueness = GIRTH.last
    info = replace(answers.info(), step=0.4, scanner="phone")
    taken = MeasureValue(240.0, convention_sd=0.7, tilt_mm=-0.2)
    value = measured(GIRTH, taken, "last", HEELS_MM[1], info)
    scanner_sd = SCANNER_SD_MM["phone"]["girth"]
    parts = (GIRTH.sd, trueness.sd[1], 0.7, 0.2, 0.65 * 0.4, scanner_sd)
    assert value.total_sd == pytest.approx(math.hypot(*parts))
    assert (value.value, value.sd, value.bias) == (240.0, GIRTH.sd, trueness.bias)


def test_a_value_that_is_missing_has_no_uncertainty() -> None:
    value = measured(GIRTH, MeasureValue(None, "open"), "last", None)
    assert (value.sd, value.total_sd, value.bias, value.reason) == (None, None, None, "open")


@pytest.mark.parametrize("scanner", SCANNER_SD_MM)
def test_a_known_scanner_is_taken(scanner: str) -> None:
    check_scanner(scanner)


def test_an_unknown_scanner_is_refused_with_the_known_ones() -> None:
    with pytest.raises(BadOption, match="laser, handheld, phone, photos"):
        check_scanner("lidar")


@pytest.mark.parametrize("heel_mm", [15.0, 60.0])
def test_true_values_lie_within_two_total_sd(heel_mm: float) -> None:
    # The benchmark asks for 95 % over many lasts; of the 23 values of one, two may lie outside.
    spec = LastSpec(
        length_mm=262.0,
        heel_height_mm=heel_mm,
        toe_spring_mm=8.0,
        mt1_station=0.69,
        level_tread=True,
        rings=80,
        segments=64,
    )
    drafted = standing(spec)
    x, z = drafted.middle_mm.T
    place = (x - x[0]) / np.ptp(x)
    seat = (place >= 0.06) & (place <= 0.14)
    heel = np.polyfit(x[seat] - x[0], z[seat] - z.min(), 1)[1]
    vertices, faces = last_mesh(replace(spec, rings=120, segments=90))
    stands = pitched(vertices, float(np.radians(drafted.pitch_deg)))
    resting, pitch = laid_down(stands, faces)
    planted = {"heel_height": float(heel), "toe_spring_tip": drafted.tip_mm}
    truth = true_measures(Drafted(resting, faces, "last", pitch, planted))
    rows = scan_measures(aligned(cleaned(*last_mesh(spec)), side="right").prepared)
    values = {row.name: row.measured for row in rows}
    assert set(truth) == {entry.name for entry in MEASURES}
    outside = [
        name
        for name, true_mm in truth.items()
        if abs((values[name].value or 0.0) - true_mm) > 2.0 * (values[name].total_sd or 0.0)
    ]
    assert len(outside) <= 2, outside
