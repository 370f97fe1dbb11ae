"""A foot that a coverage judges has the verdict that a match gives, with the same measures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import footfit
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.fit.scoring import NOT_JUDGED, REJECT
from footfit.pipeline.fit.worn_shifts import worn_with
from footfit.pipeline.population.foot_measures import foot_measures, foot_table
from footfit.pipeline.population.judging import Asking, judged_feet
from footfit.pipeline.population.tables import last_table, zone_measures
from footfit.pipeline.shelf.candidates import choice
from footfit.results import Library, Measure, Measured, Profiled, Worn
from footfit.results.values import VERDICTS
from footfit.results.worn import BAREFOOT
from tests.conftest import SAMPLES
from tests.test_pipeline_ranking import catalogues, feet

WORN = st.sampled_from(
    [Worn(), Worn(sock_mm=2.0, insole_mm=3.0), Worn(load="air", time="morning", heel_lift_mm=8.0)]
)
PROFILES = st.sampled_from(["walking", "pump", "child", "safety"])


def same_answers(many: list[Profiled], library: Library, name: str, worn: Worn = BAREFOOT) -> None:
    """Compare each foot's row with the answer of a match."""
    profile = fit_profile(name)
    asking = Asking(profile, heel_question(), worn_with(profile, worn))
    measures = [foot_measures(foot) for foot in many]
    table = foot_table([str(i) for i in range(len(many))], measures, zone_measures(profile))
    lasts = last_table(library.lasts, profile, library.file)
    judged = judged_feet(table, lasts, asking)
    for row, foot in enumerate(many):
        question = Question(top=0, profile=profile, worn=worn)
        answer = matched([foot], library, question)
        level = judged.level[row]
        if not answer.candidates:
            assert level == REJECT
            assert [c.last for c in answer.nearest[:1]] == [
                lasts.names[judged.last[row]] for _ in answer.nearest[:1]
            ]
            continue
        first = answer.candidates[0]
        assert lasts.names[judged.last[row]] == first.last
        assert answer.best_verdict == (None if level == NOT_JUDGED else VERDICTS[level])
        for zone, place_level, mm in zip(
            first.fits[0].zones, judged.zone_level[row], judged.clearance[row], strict=True
        ):
            assert zone.verdict == (VERDICTS[place_level] if place_level != NOT_JUDGED else None)
            if zone.verdict is not None:
                assert mm == pytest.approx(zone.clearance.value, abs=6e-4)
        bits = np.unpackbits(judged.served, axis=2)[:, :, row]
        served = {c.last: c.verdict for c in answer.candidates if not required_unknown(c, profile)}
        for at, last in enumerate(lasts.names):
            assert bits[0, at] == (served.get(last) == "good")
            assert bits[1, at] == (served.get(last) in ("good", "acceptable"))


def required_unknown(candidate, profile) -> bool:
    required = {rule.zone for rule in profile.zones if rule.required}
    return bool(required & set(candidate.not_judged))


def with_bottoms(library: Library) -> Library:
    """The lasts with all that a length along the bottom is read from, so that heels are judged."""
    lasts = []
    for last in library.lasts:
        heel_mm, length_mm = last.labels.heel_height_mm, last.length_mm or 0.0
        if heel_mm is not None:
            values = (1.01 * length_mm, 0.97 * length_mm, heel_mm, 0.2 * heel_mm,
                      0.55 * length_mm, 0.75 * length_mm, 6.0)  # fmt: skip
            bottom = tuple(
                Measure(name, Measured(mm, 0.5), definition)
                for (name, definition), mm in zip(LENGTHS.items(), values, strict=True)
            )
            last = replace(last, measures=(*last.measures, *bottom))
        lasts.append(last)
    return replace(library, lasts=tuple(lasts))


@given(st.lists(feet(), min_size=1, max_size=3), catalogues(), PROFILES, WORN)
@settings(deadline=None, max_examples=60)
def test_a_coverage_and_a_match_have_one_verdict(customers, library, name, worn) -> None:
    many = [foot for customer in customers for foot in customer]
    same_answers(many, library, name, worn)
    same_answers(many, with_bottoms(library), name, worn)


def test_scans_have_it_too_with_their_toe_boxes(stocked: Path) -> None:
    scans = [footfit.flare(path) for path in sorted((SAMPLES / "feet").glob("*.stl"))[:3]]
    lasts = Library(choice(stocked, None, None).with_records()[1], 1, None, file=stocked)
    for name in ("walking", "dress"):
        same_answers(scans, lasts, name)
        same_answers(scans, lasts, name, Worn(sock_mm=2.0))
    asking = Asking(fit_profile("walking"), heel_question(), BAREFOOT)
    table = foot_table(
        "abc", [foot_measures(foot) for foot in scans], zone_measures(asking.profile)
    )
    judged = judged_feet(table, last_table(lasts.lasts, asking.profile, stocked), asking)
    toes = asking.zones.index("toes")
    assert (judged.zone_level[:, toes] != NOT_JUDGED).any()
