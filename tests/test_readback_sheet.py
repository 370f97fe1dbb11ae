"""Every number and verdict of the customer's sheet is the one of the JSON document."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from footfit.pipeline.width.foot_width import foot_widths, survey_words
from footfit.report.page import sheet_page
from footfit.results import Match
from tests import answers
from tests.conftest import SAMPLES, Footfit
from tests.readback import problems
from tests.readback_sheet import SHEET, read_sheet, sheet_facts
from tests.test_readback import CASES

DAY, DAY_WORDS = date(2026, 11, 28), "28 November 2026"
BY_FIT = [name for name, match in CASES.items() if match.by == "fit"]


def sheet_of(match: Match) -> str:
    meshes = [answers.tube(foot.length_mm) for foot in match.feet]
    head = {"title": "Shoes & more", "customer": "Ana"}
    return sheet_page.sheet_page(match, meshes, day=DAY, survey=survey_words(), **head)


def found(match: Match) -> list[str]:
    facts = sheet_facts(match.to_dict(), "Shoes & more", "Ana", DAY_WORDS)
    return problems(SHEET, read_sheet(sheet_of(match)), facts)


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sheet without its picture, which other tests look at."""
    monkeypatch.setattr(sheet_page, "feet_figure", lambda _: None)
    monkeypatch.setattr(sheet_page, "picture_data", lambda _: "")


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("name", BY_FIT)
def test_the_sheet_shows_the_match(name: str) -> None:
    match = CASES[name]
    match = replace(match, widths=foot_widths(match.feet))
    assert found(match) == []


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("name", ["a pair", "nothing fits", "UK sizes"])
def test_any_number_that_is_changed_is_found(name: str) -> None:
    match = replace(CASES[name], widths=foot_widths(CASES[name].feet))
    facts = list(sheet_facts(match.to_dict(), "Shoes & more", "Ana", DAY_WORDS))
    page, changed = sheet_of(match), 0
    for what, text in read_sheet(page).cells.items():
        for digit in re.finditer(r"\d", text):
            reading, other = read_sheet(page), str((int(digit[0]) + 3) % 10)
            reading.cells[what] = text[: digit.start()] + other + text[digit.end() :]
            assert problems(SHEET, reading, facts), (what, reading.cells[what])
            changed += 1
    assert changed > 40  # measured 78 and more


@pytest.mark.parametrize("pair", [False, True], ids=["one foot", "a pair"])
def test_the_command_writes_what_it_answers(
    footfit: Footfit, stocked: Path, tmp_path: Path, pair: bool
) -> None:
    feet = sorted((SAMPLES / "feet").iterdir())[: 1 + pair]
    more = ("--pair",) if pair else ()
    sheet = tmp_path / "sheet.html"
    head = ("--title", "Shoes & more", "--customer", "Ana")
    run = footfit("match", *feet, *more, "--catalogue", stocked, "--sheet", sheet, *head, "--json")
    assert run.code == 0
    day = read_sheet(sheet.read_text(encoding="utf-8")).cells["head"].removeprefix("Ana ")
    facts = sheet_facts(json.loads(run.out), "Shoes & more", "Ana", day)
    assert problems(SHEET, read_sheet(sheet.read_text(encoding="utf-8")), facts) == []
