"""A graded run: one last in other sizes and widths, each measured again from its written file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from footfit.results.last_making.custom_last import BaseMesh, GirthPlane
from footfit.results.last_making.grading_rule import GradingRule
from footfit.results.values import (
    Document,
    Json,
    Notice,
    Part,
    SideName,
    fields,
    in_mm,
    json_number,
    rows,
)

if TYPE_CHECKING:
    from footfit.results.last_record import LastLabels

By = Literal["rule", "held", "scaled", "follows", "kept"]
"""What a measure of a graded last is by. What a rule does not plan and nothing holds follows. The
flare is kept: a longer bottom keeps the heading of its middle.
"""


@dataclass(frozen=True, slots=True)
class GradedMeasure(Part):
    """One measure of a graded last: of the base, as planned, and as the written file has it.

    ``planned`` is None if the measure follows. ``sd`` is the spread of a second scan of the last. A
    girth has its ``plane``, in the axes of the written file.
    """

    name: str
    unit: str
    base: float
    planned: float | None
    reached: float | None
    by: By
    sd: float | None = None
    plane: GirthPlane | None = None

    @property
    def difference(self) -> float | None:
        """Reached minus planned; None if one of them is."""
        if self.planned is None or self.reached is None:
            return None
        return self.reached - self.planned

    def _keys(self) -> Json:
        return in_mm(fields(self) | {"difference": self.difference})


@dataclass(frozen=True, slots=True)
class GradedLast(Part):
    """One last of a graded run, ``sizes`` and ``widths`` from the base.

    ``output`` is its file, ``stored`` whether the catalogue has it now, and ``not_stored`` why it
    was not stored, if that was asked for. ``data`` is the content of the file, an STL in mm in the
    base's canonical frame. ``heel_by_shape_mm`` is what its heel height reads without its labels.
    ``flare`` is the flare angle in degrees, as planned and as reached; None if the bottom does not
    show it.
    """

    last: str
    size: str
    width: str | None
    sizes: float
    widths: float
    measures: tuple[GradedMeasure, ...]
    labels: LastLabels
    data: bytes = field(repr=False)
    output: str | None = None
    stored: bool = False
    not_stored: str | None = None
    heel_by_shape_mm: float | None = None
    flare: GradedMeasure | None = None
    warnings: tuple[Notice, ...] = ()

    not_written = ("labels", "data")

    @property
    def heel_off_mm(self) -> float:
        """How far its heel height reads without its labels from what it reads with them."""
        reached = next((each.reached for each in self.measures if each.name == "heel_height"), None)
        if reached is None or self.heel_by_shape_mm is None:
            return 0.0
        return self.heel_by_shape_mm - reached

    @property
    def shown(self) -> tuple[GradedMeasure, ...]:
        """All measures that a table has: those in mm, and the flare."""
        return self.measures if self.flare is None else (*self.measures, self.flare)

    @property
    def worst(self) -> GradedMeasure | None:
        """The measure that is farthest from its plan."""
        known = [each for each in self.measures if each.difference is not None]
        return max(known, key=lambda each: abs(each.difference or 0.0), default=None)


@dataclass(frozen=True, slots=True)
class GradedRun(Document):
    """One last in other sizes and widths.

    ``mesh`` says which mesh of the base was graded. ``held`` is what keeps its measure.
    """

    base: str
    base_sha256: str
    base_size: str
    base_width: str | None
    side: SideName | None
    family: str
    mesh: BaseMesh
    size_system: str
    rule: GradingRule
    held: tuple[str, ...]
    lasts: tuple[GradedLast, ...]
    folder: str | None = None
    warnings: tuple[Notice, ...] = ()

    schema = "grade/1"
    columns = (
        *("last", "size", "width", "output", "measure", "by", "unit"),
        *("base", "planned", "reached", "difference", "sd"),
    )

    def rows(self) -> list[Json]:
        """A table: a row for each measure of each last."""
        values = [
            (
                *(last.last, last.size, last.width, last.output, each.name, each.by, each.unit),
                *map(json_number, (each.base, each.planned, each.reached)),
                *map(json_number, (each.difference, each.sd)),
            )
            for last in self.lasts
            for each in last.shown
        ]
        return rows(self.columns, values)
