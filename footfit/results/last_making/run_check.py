"""The increments of a graded run, size by size and width by width, and where they break."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal

from footfit.errors import FootfitError
from footfit.number_words import plain
from footfit.results.last_making.grading_rule import LawName
from footfit.results.values import Document, Json, Notice, Part, fields, json_number, part, rows

StepKind = Literal["size", "width"]


@dataclass(frozen=True, slots=True)
class RunLast(Part):
    """One last of a run: its name, its labels, and its measures in mm by name.

    ``size_number`` is the size on the adults' scale. ``size_from`` says where the size comes from:
    "catalogue", "manifest" or "file name". ``stands_by`` is "label" or "shape", None if it is not
    known how the last stands. Of one that stands by its label, ``measures_mm`` also has the heights
    as its shape alone stands. ``sd_mm`` are the spreads of a second scan, by name.
    """

    last: str
    size: str
    size_number: float
    width: str | None
    side: str | None
    size_from: str
    measures_mm: Mapping[str, float]
    stands_by: str | None = None
    sd_mm: Mapping[str, float] = field(default_factory=dict)

    def _keys(self) -> Json:
        measures = {name: json_number(value) for name, value in self.measures_mm.items()}
        spreads = {name: json_number(value) for name, value in self.sd_mm.items()}
        return fields(self) | {"measures_mm": measures, "sd_mm": spreads}


@dataclass(frozen=True, slots=True)
class RunStep(Part):
    """What one measure grows by from a last to the next size, or to the next width.

    ``expected_mm`` is by the run itself, or by the rule; ``off_mm`` is the increment minus that. It
    is ``broken`` if that is more than ``tolerance_mm``. ``sd_mm`` is the spread of the increment if
    both lasts are scanned again.
    """

    measure: str
    kind: StepKind
    at: str
    start: str
    end: str
    first: str
    second: str
    increment_mm: float
    expected_mm: float
    tolerance_mm: float
    sd_mm: float = 0.0

    @property
    def off_mm(self) -> float:
        """The increment minus the expected one."""
        return self.increment_mm - self.expected_mm

    @property
    def broken(self) -> bool:
        """Is the increment farther off than is allowed?"""
        return abs(self.off_mm) > self.tolerance_mm

    @property
    def sure(self) -> bool:
        """Is it farther from its tolerance than the increment's standard deviation?"""
        return abs(abs(self.off_mm) - self.tolerance_mm) > self.sd_mm

    @property
    def words(self) -> str:
        """The step in words.

        Examples
        --------
        >>> RunStep("ball_girth_least", "size", "G", "41", "42", "a", "b", 7.06, 5.0, 2.0).words
        'ball girth least from size 41 to 42 (G): 7.1 mm, 5.0 mm expected, 2.1 mm too much'
        """
        size = "mm too much" if self.off_mm > 0.0 else "mm too little"
        off = f"{plain(abs(self.off_mm))} {size}"
        common = f" ({self.at})" if self.at else ""
        step = f"{self.measure.replace('_', ' ')} from {self.kind} {self.start} to {self.end}"
        numbers = f"{plain(self.increment_mm)} mm, {plain(self.expected_mm)} mm expected"
        return f"{step}{common}: {numbers}, {off}"

    def _keys(self) -> Json:
        renamed = {"from": self.start, "to": self.end, "last": self.first, "next_last": self.second}
        kept = fields(self, "start", "end", "first", "second")
        judged = {"off_mm": self.off_mm, "broken": self.broken, "sure": self.sure}
        return kept | renamed | judged


@dataclass(frozen=True, slots=True)
class RunLaw(Part):
    """What one measure grows by in a step of size or of width: mm, or percent in a geometric run.

    ``steps`` are so many neighbours; ``by`` is "run", or the name of a rule.
    """

    measure: str
    kind: StepKind
    law: LawName
    unit: Literal["mm", "percent"]
    per_step: float
    steps: int
    by: str


@dataclass(frozen=True, slots=True)
class OffLast(Part):
    """A last that its neighbours on both sides show to be wrong in one measure, by ``off_mm``."""

    last: str
    size: str
    measure: str
    off_mm: float

    @property
    def words(self) -> str:
        """What is wrong with it.

        Examples
        --------
        >>> OffLast("derby-43", "43", "ball_girth_least", 2.81).words
        "'derby-43' (43) is wrong by itself: ball girth least 2.8 mm too large"
        """
        size = "large" if self.off_mm > 0.0 else "small"
        off = f"{self.measure.replace('_', ' ')} {plain(abs(self.off_mm))} mm too {size}"
        return f"{self.last!r} ({self.size}) is wrong by itself: {off}"


@dataclass(frozen=True, slots=True)
class RunCheck(Document):
    """A run that was graded: its lasts, its own increments, and each step with what it is off by.

    ``family`` is the label of the lasts, None for files. ``size_step`` is how far apart two sizes
    are: in a rule, or the least in the run. ``tolerance_mm`` is by kind of measure.
    ``failed`` are the errors of files that could not be read or measured.
    """

    family: str | None
    law: LawName
    size_step: float
    rule: str | None
    tolerance_mm: Mapping[str, float]
    lasts: tuple[RunLast, ...]
    laws: tuple[RunLaw, ...]
    steps: tuple[RunStep, ...]
    warnings: tuple[Notice, ...] = ()
    failed: tuple[FootfitError, ...] = ()

    schema = "check-run/1"
    columns = (
        *("measure", "kind", "at", "from", "to", "last", "next_last"),
        *("increment_mm", "expected_mm", "off_mm", "tolerance_mm", "broken", "sd_mm", "sure"),
    )

    @property
    def broken(self) -> tuple[RunStep, ...]:
        """The steps that break the run's increments, the worst first."""
        bad = (step for step in self.steps if step.broken)
        return tuple(sorted(bad, key=lambda step: -abs(step.off_mm)))

    @property
    def unsure(self) -> tuple[RunStep, ...]:
        """The steps whose verdict is not sure."""
        return tuple(step for step in self.steps if not step.sure)

    @property
    def off_lasts(self) -> tuple[OffLast, ...]:
        """The lasts that are too large or too small by themselves: the steps before and after one
        are off by the same, one way and the other.
        """
        return tuple(
            OffLast(after.first, after.start, after.measure, 0.5 * (before.off_mm - after.off_mm))
            for before, after in pairwise(self.steps)
            if before.broken and after.broken
            if (before.measure, before.second) == (after.measure, after.first)
            if abs(before.off_mm + after.off_mm) < after.tolerance_mm
        )

    @property
    def jumps(self) -> tuple[RunStep, ...]:
        """The steps that break the increments and touch no last that is wrong by itself."""
        off = {(each.last, each.measure) for each in self.off_lasts}
        return tuple(
            step
            for step in self.broken
            if not {(step.first, step.measure), (step.second, step.measure)} & off
        )

    @property
    def worst_words(self) -> str:
        """The worst break in words: a last that is wrong by itself, else a step."""
        if not self.broken:
            return ""
        worst = self.broken[0]
        ends = worst.first, worst.second
        wrong = (each for each in self.off_lasts if each.measure == worst.measure)
        words = (each.words for each in wrong if each.last in ends)
        return next(words, worst.words)

    def _keys(self) -> Json:
        return {
            **fields(self, "warnings", "failed"),
            "tolerance_mm": part(self.tolerance_mm),
            "broken": self.broken,
            "off_lasts": self.off_lasts,
            "failed": [error.to_dict() for error in self.failed],
            "warnings": self.warnings,
        }

    def rows(self) -> list[Json]:
        """A table: a row for each step of each measure."""
        parts = [step.to_dict() for step in self.steps]
        return rows(self.columns, [[each[name] for name in self.columns] for each in parts])
