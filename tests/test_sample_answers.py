"""The numbers, verdicts and codes about the sample scans are the ones that were kept."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.conftest import Footfit
from tests.sample_answers import COMMANDS, KEPT, answer, lay_out
from tools.answer_differences import HARMLESS, differences, number_in

LAST_PLACES = 2
"""By how many units of its last printed digit a number may differ on another machine."""


@pytest.fixture(scope="module")
def kept() -> dict[str, object]:
    """The answers by the commands' names."""
    return json.loads(KEPT.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def place(stocked: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the scans."""
    folder = tmp_path_factory.mktemp("answers")
    lay_out(folder, stocked)
    return folder


@pytest.mark.parametrize("name", COMMANDS)
def test_the_samples_answers_stay(
    footfit: Footfit, place: Path, monkeypatch: pytest.MonkeyPatch, kept: dict, name: str
) -> None:
    monkeypatch.chdir(place)
    run = footfit(*COMMANDS[name].split(), "--json")
    found = answer(run.code, run.out, run.err)
    changed = [
        f"{known.key}: {known.before} became {known.after}"
        for known in differences(kept[name], found, name)
        if known.kind not in HARMLESS and not nearly(known.before, known.after)
    ]
    assert changed == []


def nearly(before: object, after: object) -> bool:
    """Whether two numbers differ by no more than another machine's rounding."""
    one, other = number_in(before), number_in(after)
    if one is None or other is None:
        return False
    places = max(len(str(value).partition(".")[2]) for value in (before, after))
    return abs(one - other) <= (LAST_PLACES + 0.5) * 10.0**-places


def test_every_kept_answer_is_asked_for(kept: dict) -> None:
    assert kept.keys() == COMMANDS.keys()


@pytest.mark.parametrize(
    ("before", "after", "same"),
    [
        (1.234, 1.236, True),
        (1.234, 1.237, False),
        (3, 4, True),
        ("a", "b", False),
        (1.2, None, False),
    ],
)
def test_only_the_last_printed_digits_may_differ(before, after, same) -> None:
    assert nearly(before, after) == same
