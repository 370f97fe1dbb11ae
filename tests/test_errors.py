"""The error tree: as drawn, as documented, each leaf with its code."""

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


def test_the_drawing_is_the_tree() -> None:
    drawn = re.findall(r"^    ([│├└─ ]*)(\w+)(.*)$", errors.__doc__ or "", re.M)
    in_drawing = [(len(indent) // 4, name) for indent, name, _ in drawn]
    assert in_drawing == [(depth, cls.__name__) for depth, cls in tree(FootfitError)]
    for (_, name, rest), (_, cls) in zip(drawn, tree(FootfitError), strict=True):
        if not cls.__subclasses__():
            assert rest.split()[-1] == cls.code, name
        elif cls is not FootfitError:
            assert f"exit {int(cls.exit)}" in rest, name


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
