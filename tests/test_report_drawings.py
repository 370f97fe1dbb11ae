"""Every line, area, image and figure of the pictures is where it was kept."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.drawings import FIGURES, KEPT, drawing


def apart(before: Any, after: Any, place: str) -> list[str]:
    """Where two drawings differ by more than another machine's rounding."""
    if isinstance(before, dict) and isinstance(after, dict) and before.keys() == after.keys():
        return [text for key in before for text in apart(before[key], after[key], f"{place}.{key}")]
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        pairs = enumerate(zip(before, after, strict=True))
        return [text for at, pair in pairs for text in apart(*pair, f"{place}.{at}")]
    numbers = isinstance(before, float) and isinstance(after, float)
    same = before == pytest.approx(after, rel=1e-4, abs=1e-5) if numbers else before == after
    return [] if same else [f"{place}: {before} became {after}"]


@pytest.mark.parametrize("name", FIGURES)
def test_a_picture_draws_what_was_kept(name: str) -> None:
    kept = json.loads(KEPT.read_text(encoding="utf-8"))
    found = json.loads(json.dumps(drawing(FIGURES[name]())))
    assert apart(kept[name], found, name) == []


def test_every_kept_picture_is_drawn() -> None:
    assert json.loads(KEPT.read_text(encoding="utf-8")).keys() == FIGURES.keys()


def test_a_moved_line_is_noticed() -> None:
    kept = {"marks": [["line", 3.0, 4.0]]}
    assert apart(kept, {"marks": [["line", 3.0001, 4.0]]}, "a") == []
    assert apart(kept, {"marks": [["line", 3.001, 4.0]]}, "a") == ["a.marks.0.1: 3.0 became 3.001"]
    assert apart(kept, {"marks": []}, "a") != []
