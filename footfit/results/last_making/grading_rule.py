"""A grading rule: by how much each measure of a last grows from size to size and width to width."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from footfit.results.fit import Grade
from footfit.results.values import Json, Part

LawName = Literal["arithmetic", "geometric"]


@dataclass(frozen=True, slots=True)
class Increment(Part):
    """What one measure grows by: mm by an arithmetic rule, percent by a geometric one.

    ``grade`` says how sure it is, as in a fit profile; ``source`` says who says so.
    """

    by: float
    grade: Grade
    source: str


@dataclass(frozen=True, slots=True)
class GradingRule(Part):
    """The increments of a whole size and of a width, by the names of measures.

    Attributes
    ----------
    systems : tuple of str
        The size systems whose sizes it counts; none stands for all.
    size_step, width_step : float
        How far apart the numbers of two whole sizes are, and those of two widths if they are
        numbers.
    widths : tuple of str
        The labels of the widths, the narrowest first; without any, letters follow the alphabet.
    sha256 : str
        Of what the rule says; the order of its file does not count.
    """

    name: str
    version: int
    summary: str
    law: LawName
    systems: tuple[str, ...]
    size: Mapping[str, Increment]
    width: Mapping[str, Increment]
    size_step: float = 1.0
    width_step: float = 1.0
    widths: tuple[str, ...] = ()
    sha256: str = ""

    def planned(self, measure: str, base: float, sizes: float, widths: float) -> float | None:
        """What a measure should be, so many sizes and widths from a base; None without a rule.

        Examples
        --------
        >>> girth = {"ball_girth_least": Increment(5.0, "B", "trade")}
        >>> rule = GradingRule("eu", 1, "-", "arithmetic", (), girth, girth)
        >>> rule.planned("ball_girth_least", 240.0, 1.5, -1.0)
        242.5
        >>> rule.planned("toe_height", 25.0, 1.0, 0.0) is None
        True
        """
        size, width = self.size.get(measure), self.width.get(measure)
        if size is None and width is None:
            return None
        by = [step.by * count for step, count in ((size, sizes), (width, widths)) if step]
        if self.law == "arithmetic":
            return base + sum(by)
        result = base
        for step, count in ((size, sizes), (width, widths)):
            result *= 1.0 if step is None else (1.0 + step.by / 100.0) ** count
        return result

    def increment_mm(self, measure: str, base: float, kind: Literal["size", "width"]) -> float:
        """What one size, or one width, adds to a measure of a base; 0 without a rule."""
        planned = self.planned(measure, base, *((1.0, 0.0) if kind == "size" else (0.0, 1.0)))
        return 0.0 if planned is None else planned - base

    def _keys(self) -> Json:
        tables = {"size": self.size, "width": self.width}
        listed = {
            name: {measure: step.to_dict() for measure, step in table.items()}
            for name, table in tables.items()
        }
        return {
            "name": self.name,
            "version": self.version,
            "sha256": self.sha256,
            "law": self.law,
            "systems": self.systems,
            "size_step": self.size_step,
            **listed,
        }
