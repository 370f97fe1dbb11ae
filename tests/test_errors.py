"""The error tree: as documented, each leaf with its code."""

from __future__ import annotations

import pickle
import re
from collections.abc import Iterator
from pathlib import Path

import footfit.errors as errors
from footfit.errors import ExitCode, FootfitError

DOCS = Path(__file__).resolve().parents[1] / "docs" / "exit-codes.md"


def tree(cls: type[FootfitError], depth: int = 0) -> Iterator[tuple[int, type[FootfitError]]]:
    yield depth, cls
    for child in cls.__subclasses__():
        if child.__module__ == errors.__name__:
            yield from tree(child, depth + 1)


def test_a_class_has_the_exit_code_of_the_one_above_it() -> None:
    for depth, cls in tree(FootfitError):
        assert depth <= 2, cls
        if depth == 2:
            assert cls.exit == cls.__bases__[0].exit, cls
    assert [int(cls.exit) for depth, cls in tree(FootfitError) if depth == 1] == list(range(2, 8))


def test_the_page_lists_every_exit_code_with_its_codes() -> None:
    page = {
        int(number): set(re.findall(r"`(\w+)`", codes))
        for number, codes in re.findall(r"^\| (\d+) \|[^|]*\|([^|]*)\|", DOCS.read_text(), re.M)
    }
    assert set(page) == {int(code) for code in ExitCode}
    for number in range(2, 8):
        codes = {cls.code for _, cls in tree(FootfitError) if cls.exit == number}
        assert page[number] == codes


def test_codes_are_unique() -> None:
    codes = [cls.code for _, cls in tree(FootfitError)]
    assert len(codes) == len(set(codes))


def test_an_error_crosses_a_process_boundary_whole() -> None:
    for _, cls in tree(FootfitError):
        copy = pickle.loads(pickle.dumps(cls("what, and what to do", "foot.stl")))
        assert type(copy) is cls
        assert (copy.message, copy.path) == ("what, and what to do", "foot.stl")
