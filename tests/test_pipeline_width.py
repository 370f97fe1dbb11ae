"""The width fitting beside the size, and how wide a foot is among the people of a survey."""

from __future__ import annotations

import csv
from dataclasses import replace
from statistics import mean

import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.geometry.fit.sizes import SYSTEMS, exact_size
from footfit.geometry.fit.width_fitting import LETTERS, RULES, fittings, letter
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.width.foot_width import foot_widths, survey, width_share
from footfit.results import Library, Measure, Measured
from tests import answers
from tools import make_survey

needs_survey = pytest.mark.skipif(
    not make_survey.PEOPLE.is_dir(), reason="the survey is not beside the project"
)


def foot(length_mm=250.0, girth_mm=235.0, width_mm=96.4):
    shape = answers.foot(length_mm=length_mm)
    rows = [row for row in shape.measures if not row.name.startswith("ball_")]
    rows.append(Measure("ball_girth", Measured(girth_mm, 0.6, None, 1.0), "ball_girth/1"))
    rows.append(Measure("ball_width", Measured(width_mm, 0.3), "ball_width/1"))
    return replace(shape, measures=tuple(rows))


@given(st.floats(180, 300), st.floats(1, 30), st.sampled_from(sorted(RULES)))
def test_a_larger_girth_never_has_a_narrower_letter(girth_mm: float, more: float, system: str):
    order = ["under A", *LETTERS, "over H"]

    def place(text: str) -> float:
        return mean(order.index(part) for part in text.split("-"))

    size = exact_size(255.0, SYSTEMS[system])
    narrow, wide = (letter(mm, size, RULES[system]) for mm in (girth_mm, girth_mm + more))
    assert place(narrow) <= place(wide)


def test_a_letter_has_the_girth_that_its_table_says():
    assert letter(235.0, 37.0, RULES["eu"]) == "H"
    assert letter(251.0, 9.0, RULES["uk"]) == "F"
    assert letter(251.0, 8.0, RULES["uk"]) == "G"


def test_the_two_tables_agree_where_they_meet():
    """UK 8 is EU 41: the girth of F there is 245 mm in one table and in the other."""
    rule, size = RULES["eu"], round(exact_size(262.5, SYSTEMS["eu"]))
    f_mm = rule.girth_mm + rule.per_size_mm * (size - rule.size) - rule.per_letter_mm
    assert abs(f_mm - RULES["uk"].girth_mm) <= 2.0  # docs/fit.md says 2


def test_the_mean_man_has_the_width_that_shops_call_normal():
    """F is the usual width of men's shoes in UK sizes; docs/fit.md says these letters."""
    letters = {}
    for people, group in survey().groups.items():
        known = fittings(group.mean_length_mm, group.mean_girth_mm, None)
        letters[people] = {fitting.system: fitting.width for fitting in known}
    assert letters == {"men": {"eu": "E-F", "uk": "F"}, "women": {"eu": "D-E", "uk": "E"}}


def test_what_was_not_measured_has_no_width():
    assert [known.system for known in fittings(250.0, None, 96.4)] == ["mondopoint"]
    assert [known.system for known in fittings(250.0, 235.0, None)] == ["eu", "uk"]
    assert [known.system for known in fittings(190.0, 180.0, 75.0)] == ["mondopoint"]  # a child


def test_a_match_says_how_wide_each_foot_is():
    feet = (foot(250.0, 235.0), foot(258.0, 241.0))
    document = matched(feet, Library((answers.record(),), 1, None)).to_dict()
    left, right = (known["width"] for known in document["feet"])
    assert left["fittings"]["eu"] == {"width": "D", "about": True}  # 235 mm at EU 41, not EU 40
    assert right["fittings"]["eu"] == {"width": "E", "about": True}
    assert left["fittings"]["mondopoint"] == {"width": "96", "about": False}
    women, men = (right["wider_than"][people] for people in ("women", "men"))
    assert 70 < women["percent"] < 80
    assert women["percent_sd"] > 0
    assert women["reason"] is None
    assert 30 < men["percent"] < 45


def test_a_child_is_not_compared_with_adults():
    asked = Question(profile=fit_profile("child"))
    document = matched((foot(),), Library((answers.record(),), 1, None), asked).to_dict()
    shares = document["feet"][0]["width"]["wider_than"]
    assert {share["reason"] for share in shares.values()} == {"the survey has no children"}
    small = foot_widths((foot(190.0, 180.0),))[0]
    assert {share.reason for share in small.shares} == {
        "the survey has no women with feet this short",
        "the survey has no men with feet this short",
    }


def test_a_foot_without_a_girth_says_so():
    unknown = foot(girth_mm=None)
    share = foot_widths((unknown,))[0].shares[0]
    assert share.percent is None
    assert share.reason == "the ball girth of the foot is not known"


@needs_survey
def test_the_summary_is_that_of_the_survey():
    shipped = (make_survey.SUMMARY).read_text(encoding="utf-8")
    assert make_survey.text() == shipped


@needs_survey
@pytest.mark.parametrize(("people", "within"), [("women", 2.5), ("men", 2.0)])
def test_the_share_is_that_of_the_surveys_people(people: str, within: float):
    """Each person's share against the count of those who are narrower at their length."""
    group = survey().groups[people]
    rows = list(csv.DictReader((make_survey.PEOPLE / make_survey.FILES[people]).open()))
    shares = []
    for row in rows:
        length, girth = float(row["footlength"]), float(row["balloffootcircumference"])
        share = width_share(people, group, length, Measured(girth)).percent
        if share is not None:
            shares.append(share)
    shares.sort()
    off = max(abs(share - 100 * (i + 0.5) / len(shares)) for i, share in enumerate(shares))
    assert off < within  # measured 2.2 and 1.5 points
