"""Units: what is declared wins, what is plausible is found, what is neither is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.errors import BadOption, UnknownUnits
from footfit.geometry.pose.extents import principal_extents
from footfit.meshes.units import (
    UNIT_SCALES,
    UNIT_SETTINGS,
    check_unit_options,
    plausible_unit,
    settled_units,
)
from tests import distortions, shapes
from tests.bounds import ROUNDING

FOOT = shapes.ellipsoid((130.0, 50.0, 40.0), subdivisions=3)[0]


@given(length_mm=st.floats(180.1, 339.9), unit=st.sampled_from(sorted(UNIT_SCALES)))
def test_the_unit_of_a_foots_length_is_found(length_mm, unit):
    assert plausible_unit(length_mm / UNIT_SCALES[unit]) == (unit, UNIT_SCALES[unit])


@given(length_mm=st.floats(180.1, 339.9))
def test_no_two_units_make_a_foots_length(length_mm):
    low, high = UNIT_SETTINGS.length_mm
    for unit, scale in UNIT_SCALES.items():
        fits = [u for u, other in UNIT_SCALES.items() if low <= length_mm / scale * other <= high]
        assert fits == [unit]


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_a_long_leg_is_taken_too(unit):
    assert plausible_unit(700.0 / UNIT_SCALES[unit])[0] == unit


@pytest.mark.parametrize("extent", [0.0, 1e-12, 0.05, 3.0, 95.0, 1e4, 1e12, float("inf")])
def test_no_plausible_unit_is_an_error_that_says_what_to_type(extent):
    with pytest.raises(UnknownUnits, match="--known-length MM"):
        plausible_unit(extent)


@pytest.mark.parametrize(
    ("extent", "proposed"), [(108.0, "cm"), (0.95, "m"), (950.0, "mm"), (4.0, None), (0.05, None)]
)
def test_a_unit_is_proposed_only_if_it_can_make_a_long_leg(extent, proposed):
    with pytest.raises(UnknownUnits) as caught:
        plausible_unit(extent)
    words = caught.value.message
    assert ("--units" in words) == (proposed is not None)
    if proposed is not None:
        assert words.endswith(f"if it has a long leg, give --units {proposed}")


def test_a_shape_that_is_too_short_is_told_how_long_it_is():
    with pytest.raises(UnknownUnits, match="108 mm if in mm"):
        plausible_unit(108.0)


def test_a_known_length_that_is_not_a_number_is_said():
    with pytest.raises(BadOption, match="not a number"):
        check_unit_options("auto", float("nan"))


@pytest.mark.parametrize(("extent", "unit"), [(112.0, "mm"), (178.0, "mm"), (0.112, "m")])
def test_a_small_childs_length_has_a_unit(extent, unit):
    assert plausible_unit(extent)[0] == unit


def test_what_is_declared_wins_over_what_is_plausible():
    units = settled_units(FOOT, "in", None, None)
    assert (units.name, units.source, units.scale, units.warnings) == ("in", "declared", 25.4, ())
    assert settled_units(FOOT, "auto", None, "m").name == "m"
    assert settled_units(FOOT, "cm", None, "m").name == "cm"


def test_a_detected_unit_is_said_unless_it_is_mm():
    assert settled_units(FOOT, "auto", None, None).warnings == ()
    (notice,) = settled_units(FOOT / 25.4, "auto", None, None).warnings
    assert notice.code == "units_detected"
    assert "inches" in notice.message
    assert "260 mm" in notice.message


def test_a_known_length_scales_the_longest_extent_in_any_pose():
    turned = distortions.moved(FOOT / 7.3, distortions.random_pose(np.random.default_rng(4)))
    units = settled_units(turned, "auto", 255.0, None)
    assert (units.name, units.source) == ("scaled", "known-length")
    assert principal_extents(turned * units.scale)[0][0] == pytest.approx(255.0)


@pytest.mark.parametrize(
    ("wanted", "known"),
    [
        ("ft", None),
        ("auto", 0.0),
        ("auto", 109.0),
        ("auto", 371.0),
        ("auto", -3.0),
        ("auto", float("nan")),
        ("mm", 255.0),
    ],
)
def test_options_that_cannot_be_carried_out_are_refused(wanted, known):
    with pytest.raises(BadOption):
        check_unit_options(wanted, known)


@given(seed=st.integers(0, 1000))
def test_extents_do_not_depend_on_the_pose(seed):
    turned = distortions.moved(FOOT, distortions.random_pose(np.random.default_rng(seed)))
    assert np.allclose(principal_extents(turned)[0], [260.0, 100.0, 80.0], atol=ROUNDING, rtol=0)
