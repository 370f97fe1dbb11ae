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

StepKind = Literal["size", "width", "run"]
"""From size to size, from width to width, or over several sizes and widths."""


@dataclass(frozen=True, slots=True)
class RunLast(Part):
    """One last of a run: its name, its labels, and its measures in mm by name.

    ``size_number`` is the size on the adults' scale. ``size_from`` says where the size comes from:
    "catalogue", "manifest" or "file name". ``stands_by`` is "label" or "shape", None if it is not
    known how the last stands. Of one that stands by its label, ``measures_mm`` also has the heights
    as its shape alone stands. ``sd_mm`` are the spreads of a second scan, by name. ``size_system``,
    ``style`` and ``family`` are its labels, None if they are not known.
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
    size_system: str | None = None
    style: str | None = None
    family: str | None = None

    def _keys(self) -> Json:
        measures = {name: json_number(value) for name, value in self.measures_mm.items()}
        spreads = {name: json_number(value) for name, value in self.sd_mm.items()}
        return fields(self) | {"measures_mm": measures, "sd_mm": spreads}


@dataclass(frozen=True, slots=True)
class RunStep(Part):
    """What one measure grows by from a last to the next size, or to the next width; or from one to
    another one that is several sizes and widths away.

    ``expected_mm`` is by the run itself, or by the rule; None if there is nothing to judge it by.
    ``off_mm`` is the increment minus that. It is ``broken`` if that is more than ``tolerance_mm``.
    ``sd_mm`` is the spread of the increment if both lasts are scanned again.
    """

    measure: str
    kind: StepKind
    at: str
    start: str
    end: str
    first: str
    second: str
    increment_mm: float
    expected_mm: float | None
    tolerance_mm: float
    sd_mm: float = 0.0

    @property
    def judged(self) -> bool:
        """Is there anything to judge it by?"""
        return self.expected_mm is not None

    @property
    def off_mm(self) -> float:
        """The increment minus the expected one; 0 if that is not known."""
        return 0.0 if self.expected_mm is None else self.increment_mm - self.expected_mm

    @property
    def broken(self) -> bool:
        """Is the increment farther off than is allowed?"""
        return abs(self.off_mm) > self.tolerance_mm

    @property
    def sure(self) -> bool:
        """Is it farther from its tolerance than the increment's standard deviation?"""
        return not self.judged or abs(abs(self.off_mm) - self.tolerance_mm) > self.sd_mm

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
        kind = "size" if self.kind == "run" else self.kind
        step = f"{self.measure.replace('_', ' ')} from {kind} {self.start} to {self.end}"
        numbers = f"{plain(self.increment_mm)} mm, {plain(self.expected_mm or 0.0)} mm expected"
        return f"{step}{common}: {numbers}, {off}"

    def _keys(self) -> Json:
        renamed = {"from": self.start, "to": self.end, "last": self.first, "next_last": self.second}
        kept = fields(self, "start", "end", "first", "second")
        off_mm = self.off_mm if self.judged else None
        judged = {"off_mm": off_mm, "broken": self.broken, "sure": self.sure}
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

    @property
    def alone(self) -> bool:
        """Is it the run's own increment, and there is one alone?"""
        return self.by == "run" and self.steps == 1


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
    are: in a rule, or the least in the run. ``tolerance_mm`` is by kind of measure. ``sums`` are of
    a run that is compared with a rule: for each of its measures the two lasts that are farthest
    from its plan, over all sizes and widths between them.
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
    sums: tuple[RunStep, ...] = ()
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
    def broken_sums(self) -> tuple[RunStep, ...]:
        """What adds up to more than its tolerance over the run, the worst first."""
        bad = (each for each in self.sums if each.broken)
        return tuple(sorted(bad, key=lambda each: -abs(each.off_mm)))

    @property
    def judged(self) -> tuple[RunStep, ...]:
        """The steps that there is anything to judge by."""
        return tuple(step for step in self.steps if step.judged)

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
        """The worst break in words: a last that is wrong by itself, else a step, else a sum."""
        if not self.broken:
            return self.broken_sums[0].words if self.broken_sums else ""
        worst = self.broken[0]
        ends = worst.first, worst.second
        wrong = (each for each in self.off_lasts if each.measure == worst.measure)
        words = (each.words for each in wrong if each.last in ends)
        return next(words, worst.words)

    @property
    def broken_words(self) -> str:
        """How much is out of tolerance, and the worst of it; nothing if nothing is."""
        counts = [
            f"{count} {name if count == 1 else names}"
            for count, name, names in (
                (len(self.broken), "increment", "increments"),
                (len(self.broken_sums), "sum over the run", "sums over the run"),
            )
            if count
        ]
        if not counts:
            return ""
        verb = "is" if counts[0].startswith("1 ") and len(counts) == 1 else "are"
        return f"{' and '.join(counts)} {verb} out of tolerance; the worst: {self.worst_words}"

    def _keys(self) -> Json:
        return {
            **fields(self, "warnings", "failed"),
            "tolerance_mm": part(self.tolerance_mm),
            "broken": self.broken,
            "broken_sums": self.broken_sums,
            "off_lasts": self.off_lasts,
            "failed": [error.to_dict() for error in self.failed],
            "warnings": self.warnings,
        }

    def rows(self) -> list[Json]:
        """A table: a row for each step of each measure."""
        parts = [step.to_dict() for step in self.steps]
        return rows(self.columns, [[each[name] for name in self.columns] for each in parts])
