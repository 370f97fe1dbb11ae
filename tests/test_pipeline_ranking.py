"""The order of the lasts over random catalogues and customers: all outputs lead with the best."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.cli.commands.match import Summary
from footfit.errors import CheckFailed
from footfit.pipeline.batch.runs import Outcome
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.match import Question, matched, meets
from footfit.report.csv import csv_text
from footfit.report.terminal.match_tables import match_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import Candidate, LastRecord, Library, Match, Measure, Measured, Profiled
from tests import answers

VERDICTS = ("good", "acceptable", "poor", "reject")
REQUIRED = {rule.zone for rule in fit_profile("walking").zones if rule.required}
SD_MM = 0.5


def rows(**values_mm: float | None) -> tuple[Measure, ...]:
    return tuple(
        Measure(name, Measured(mm, SD_MM if mm else None, None if mm else "a gap"), f"{name}/1")
        for name, mm in values_mm.items()
    )


sizes_mm = {
    "ball_girth": st.none() | st.floats(225.0, 255.0),
    "ball_width": st.none() | st.floats(88.0, 106.0),
    "heel_width": st.floats(56.0, 70.0),
    "ball_length": st.floats(180.0, 196.0),
    "instep_girth": st.none() | st.floats(225.0, 255.0),
}


@st.composite
def feet(draw: st.DrawFn) -> tuple[Profiled, ...]:
    """One foot, or a pair."""
    sides = draw(st.sampled_from([(False,), (True,), (True, False)]))
    shapes = []
    for left in sides:
        length_mm = draw(st.floats(255.0, 265.0))
        shape = answers.foot(left=left, length_mm=length_mm, turn_deg=draw(st.floats(2.0, 20.0)))
        taken = {name: draw(values) for name, values in sizes_mm.items()}
        shapes.append(replace(shape, measures=rows(length=length_mm, **taken)))
    return tuple(shapes)


@st.composite
def catalogues(draw: st.DrawFn) -> Library:
    """Up to eight lasts, most of a length that can fit, some with a measure that is missing."""
    lasts: list[LastRecord] = []
    for number in range(draw(st.integers(1, 8))):
        length_mm = draw(st.floats(262.0, 288.0))
        heel_mm = draw(st.sampled_from([None, 20.0, 60.0, 110.0]))
        record = answers.record(
            f"l{number}", draw(st.floats(-4.0, 20.0)), length_mm, heel_height_mm=heel_mm
        )
        taken = {name: draw(values) for name, values in sizes_mm.items()}
        lasts.append(replace(record, measures=rows(length=length_mm, **taken)))
    return Library(tuple(lasts), len(lasts), lasts[0].labels.name)


def place(candidate: Candidate, longer: int) -> tuple[Any, ...]:
    """What a last's place must follow, taken from its zones alone."""
    zones = [zone for fit in candidate.fits for zone in fit.zones if zone.counts]
    unsure = any(zone.zone in REQUIRED and zone.verdict is None for zone in zones)
    worst = max([VERDICTS.index(zone.verdict) for zone in zones if zone.verdict])
    verdict = max(worst, VERDICTS.index("acceptable")) if unsure else worst
    room = next(zone for zone in candidate.fits[longer].zones if zone.zone == "length")
    assert room.verdict is not None
    assert VERDICTS[verdict] == candidate.verdict
    return verdict, unsure, VERDICTS.index(room.verdict), round(candidate.distance, 6)


@given(feet(), catalogues())
@settings(deadline=None, max_examples=60)
def test_the_verdict_ranks_then_the_toe_room_then_the_distance(
    customer: tuple[Profiled, ...], library: Library
) -> None:
    answer = matched(customer, library, Question(top=0))
    longer = max(range(len(customer)), key=lambda i: customer[i].length_mm or 0.0)
    places = [place(candidate, longer) for candidate in answer.candidates]
    assert places == sorted(places)
    assert [candidate.rank for candidate in answer.candidates] == list(range(1, len(places) + 1))
    if answer.candidates:
        first = answer.candidates[0]
        best = min(answer.candidates, key=lambda one: VERDICTS.index(one.verdict or ""))
        assert first.verdict == best.verdict
        assert answer.best_verdict == (None if places[0][1] else first.verdict)


@given(feet(), catalogues(), st.sampled_from(["fit", "flare"]), st.integers(1, 3))
@settings(deadline=None, max_examples=60)
def test_every_output_and_the_check_speak_of_the_first_last(
    customer: tuple[Profiled, ...], library: Library, by: Any, top: int
) -> None:
    answer = matched(customer, library, Question(by=by, top=top))
    shown = answer.candidates or answer.nearest
    document = answer.to_dict()
    told = document["candidates"] or document["nearest"]
    assert [one["last"] for one in told] == [one.last for one in shown]
    assert [one["verdict"] for one in told] == [one.verdict for one in shown]
    table = terminal_text(match_table(answer), 400)
    if not answer.candidates:
        assert "No last fits." in table
        assert not meets(answer, "acceptable")
        return
    first = answer.candidates[0]
    lines = table.splitlines()
    row = next(line.split() for line in lines if line.split()[:1] == ["1"])
    assert (row[1], first.verdict in row) == (first.last, True)
    spoken = next(csv.DictReader(io.StringIO(csv_text(Match, [answer]))))
    assert (spoken["last"], spoken["verdict"]) == (first.last, first.verdict)
    assert document["best_verdict"] in (first.verdict, None)
    for least in ("good", "acceptable"):
        sure = not any(
            zone.zone in REQUIRED and zone.counts and zone.verdict is None
            for fit in first.fits
            for zone in fit.zones
        )
        passed = sure and VERDICTS.index(first.verdict or "") <= VERDICTS.index(least)
        assert meets(answer, least) == passed
        summary = Summary(least)
        summary.add(Outcome(SimpleNamespace(title="Ana", path=None), answer, None))
        if passed:
            assert summary.checked_code(0, as_json=False) == 0
        else:
            with pytest.raises(CheckFailed):
                summary.checked_code(0, as_json=False)


@given(feet(), catalogues())
@settings(deadline=None, max_examples=40)
def test_ties_stay_inside_of_a_verdict_and_of_a_toe_room(
    customer: tuple[Profiled, ...], library: Library
) -> None:
    answer = matched(customer, library, Question(top=0))
    longer = max(range(len(customer)), key=lambda i: customer[i].length_mm or 0.0)
    group = {one.last: place(one, longer)[:3] for one in answer.candidates}
    ties = {one.last: set(one.tied_with) for one in answer.candidates}
    for last, others in ties.items():
        assert all(group[other] == group[last] and last in ties[other] for other in others)
