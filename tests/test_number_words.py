"""Shown numbers: the document's number rounded half up, and more decimals where they decide."""

from __future__ import annotations

from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.geometry.fit.sizes import label_in
from footfit.geometry.measures.measure_table import MEASURES
from footfit.number_words import plain, rounded, signed, some_digits
from footfit.pipeline.fit.fit_profile import FOLDER, fit_profile
from footfit.pipeline.fit.scoring import levels, shown_digits
from footfit.pipeline.fit.zones import UNIT_KEYS, ZONES
from footfit.results import Measured
from footfit.results.fit import ZONE_ENDS, ZONE_LABELS
from footfit.results.values import json_number

measures = st.floats(-400.0, 400.0)


@pytest.mark.parametrize(("sd", "shown"), [(0.25, "0.3"), (0.35, "0.4"), (0.45, "0.5")])
def test_a_five_goes_up_whatever_the_digit_before_it(sd: float, shown: str) -> None:
    assert plain(sd) == shown
    assert signed(-sd) == f"-{shown}"


@given(measures, st.integers(0, 3))
def test_what_is_shown_is_the_number_of_the_document_rounded(value: float, digits: int) -> None:
    document = Measured(value).to_dict()["value"]
    assert plain(value, digits) == plain(document, digits)
    assert abs(Decimal(repr(document)) - rounded(value, digits)) <= Decimal(5).scaleb(-digits - 1)
    assert not signed(value, digits).startswith("-0.0 ")
    assert (signed(value, digits)[0] == "-") == (rounded(value, digits) < 0)


@given(st.floats(0.0, 5.0))
def test_a_miss_is_never_shown_as_nothing(miss: float) -> None:
    assert (float(some_digits(miss)) > 0.0) == (json_number(miss) > 0.0)


SHIPPED = sorted(path.stem for path in FOLDER.glob("*.toml"))
zones = st.sampled_from([rule for name in SHIPPED for rule in fit_profile(name).zones])


@given(zones, st.data())
def test_equal_shown_numbers_have_equal_verdicts(rule, data) -> None:
    """Near the ends of the ranges, where one decimal is not enough."""
    ends = sorted({end for ends in (rule.good, rule.acceptable, rule.poor) if ends for end in ends})
    value = data.draw(st.sampled_from(ends)) + data.draw(st.floats(-0.2, 0.2))
    digits = shown_digits(value, rule, ZONES[rule.zone].unit)
    level = levels(np.array([[value], [float(plain(value, digits))]]), [rule], np.zeros((2, 1)))
    assert level[0, 0] == level[1, 0]


def test_a_zone_of_a_measure_has_the_name_of_the_measure() -> None:
    measures = {entry.name for entry in MEASURES} - {"length"}  # its zone is the toe room
    named = {zone: label for zone, label in ZONE_LABELS.items() if zone in measures}
    assert named == {zone: zone.replace("_", " ") for zone in named}


def test_every_zone_has_its_columns() -> None:
    assert {name: UNIT_KEYS[zone.unit] for name, zone in ZONES.items()} == ZONE_ENDS


@pytest.mark.parametrize(
    ("label", "system", "asked", "words"),
    [
        ("40", "eu", "uk", "UK 7"),
        ("7", "uk", "eu", "EU 40"),
        ("42 2/3", "eu", "mondopoint", "Mondopoint 270"),
        ("40", "eu", "EU", None),
        ("40", None, "uk", None),
        ("40", "eu", None, None),
        ("M", "eu", "uk", None),
    ],
)
def test_a_label_in_another_system_is_of_the_same_foot(label, system, asked, words) -> None:
    assert label_in(label, system, asked) == words
