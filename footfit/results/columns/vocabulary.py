"""Words that many lasts share, each kept once: columns hold the number of a word."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from footfit.geometry.numeric.arrays import Ints

NO_WORD = -1


class Words:
    """Values in the order in which they were first met; the number of a value is its place."""

    def __init__(self) -> None:
        self.values: list[Any] = []
        self._numbers: dict[Any, int] = {}
        self._of_texts: dict[str, Ints] = {}

    def __len__(self) -> int:
        return len(self.values)

    def number(self, value: Any) -> int:
        """The number of a value; a new value gets the next one."""
        number = self._numbers.get(value)
        if number is None:
            number = self._numbers[value] = len(self.values)
            self.values.append(value)
        return number

    def numbers_of(self, text: str) -> Ints:
        """The numbers of the values of a JSON list; a list in it is a tuple."""
        numbers = self._of_texts.get(text)
        if numbers is None:
            values = (tuple(v) if isinstance(v, list) else v for v in json.loads(text))
            numbers = np.array([self.number(value) for value in values], dtype=np.int64)
            self._of_texts[text] = numbers
        return numbers


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """The words of lasts.

    ``labels`` are (style, size, size system, width), ``profiles`` the texts of flare definitions.
    ``methods`` are the definitions that all measures of a last follow, sorted. ``measures`` are
    (definition of a measure, the reason why it has no value or None).
    """

    labels: Words = field(default_factory=Words)
    profiles: Words = field(default_factory=Words)
    methods: Words = field(default_factory=Words)
    measures: Words = field(default_factory=Words)
