"""Two lasts: how they differ in each measure, over the surface, and section by section."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from footfit.results.values import Document, Json, Measured, Part, fields, json_number, part, rows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from footfit.geometry.fit.laid_bottoms import LaidBottom
    from footfit.geometry.fit.surface_difference import SurfaceDifference
    from footfit.results.compare import Comparison
    from footfit.results.profile import Profiled
    from footfit.results.values import Notice

TOLERANCE_SOURCE = (
    "makers, for a last as it is delivered: girth 2, length 1.5, width 1 mm (second hand; a"
    " standard of 2014 allows 3 mm of girth); height 1.5 mm is footfit's own"
)


@dataclass(frozen=True, slots=True)
class ValueDifference(Part):
    """A measure, or a size of a section, of both lasts, and the second minus the first.

    ``tolerance`` is None for one that is not judged.
    """

    name: str
    unit: str
    first: Measured
    second: Measured
    difference: Measured
    tolerance: float | None = None

    not_written = ("name",)

    @property
    def inside(self) -> bool | None:
        """Whether the difference is within the tolerance; None if it is not judged."""
        if self.tolerance is None or self.difference.value is None:
            return None
        return abs(self.difference.value) <= self.tolerance

    @property
    def sure(self) -> bool | None:
        """Whether the difference is farther from its tolerance than its standard deviation."""
        if self.inside is None or self.tolerance is None or self.difference.value is None:
            return None
        return abs(abs(self.difference.value) - self.tolerance) > (self.difference.sd or 0.0)

    def _keys(self) -> Json:
        judged = {"tolerance": self.tolerance, "inside": self.inside, "sure": self.sure}
        return fields(self, "name", "tolerance") | judged


@dataclass(frozen=True, slots=True)
class StationDifference(Part):
    """The sections of both lasts at one named station of their own bottoms' arcs."""

    station: str
    first_share: float
    second_share: float
    sizes: tuple[ValueDifference, ...]

    def _keys(self) -> Json:
        names = ("unit", "tolerance", "inside", "sure")
        sizes = {
            size.name: {k: v for k, v in size.to_dict().items() if k not in names}
            for size in self.sizes
        }
        return fields(self, "sizes") | {"sizes": sizes}


@dataclass(frozen=True, slots=True)
class LastDifference(Document):
    """How a second last differs from a first one on whose bottom it is laid.

    ``resolution_mm`` is the step of the coarser file, or what a stored copy lies from its scan;
    smaller differences of the surfaces say nothing. ``tolerance_mm`` is by kind of measure.
    ``drawn`` are both as pictures show them.
    """

    first: Profiled
    second: Profiled
    mirrored: bool
    laid: LaidBottom
    tolerance_mm: Mapping[str, float]
    measures: tuple[ValueDifference, ...]
    surface: SurfaceDifference
    sections: tuple[StationDifference, ...]
    resolution_mm: float
    warnings: tuple[Notice, ...]
    drawn: Comparison = field(repr=False)

    schema = "compare-lasts/1"
    columns = (
        *("first", "second", "part", "place", "quantity", "unit"),
        *("first_value", "second_value", "difference", "sd", "tolerance", "inside", "reason"),
    )

    @property
    def names(self) -> tuple[str, str]:
        """The files or the names of the two lasts."""
        first, second = (s.aligned.alignment.info.path or "-" for s in (self.first, self.second))
        return first, second

    @property
    def judged(self) -> tuple[ValueDifference, ...]:
        """The measures that have a tolerance and a difference."""
        return tuple(row for row in self.measures if row.inside is not None)

    @property
    def outside(self) -> tuple[ValueDifference, ...]:
        """Those that are outside of it."""
        return tuple(row for row in self.judged if not row.inside)

    @property
    def inside(self) -> bool:
        """Whether no judged measure is outside of its tolerance."""
        return not self.outside

    def _keys(self) -> Json:
        surface, largest = self.surface, self.surface.largest
        return {
            "first": _last_part(self.first),
            "second": _last_part(self.second),
            "mirrored": self.mirrored,
            "laid": part(fields(self.laid)),
            "tolerance_mm": part(self.tolerance_mm),
            "tolerance_source": TOLERANCE_SOURCE,
            "inside": self.inside,
            "outside": [row.name for row in self.outside],
            "measures": part({row.name: row for row in self.measures}),
            "surface": part(
                {
                    "mean_mm": surface.mean_mm,
                    "p95_mm": surface.p95_mm,
                    "largest": None if largest is None else part(fields(largest)),
                    "resolution_mm": self.resolution_mm,
                    "zones": {zone.zone: part(fields(zone, "zone")) for zone in surface.zones},
                }
            ),
            "sections": self.sections,
            "warnings": self.warnings,
        }

    def rows(self) -> list[Json]:
        """A table: a row for each measure, each size of each section, each figure of each zone."""
        values: list[tuple[object, ...]] = [
            self._row("measure", row.name, row.name, row) for row in self.measures
        ]
        values += [
            self._row("section", station.station, size.name, size)
            for station in self.sections
            for size in station.sizes
        ]
        for zone in self.surface.zones:
            for name in ("mean_mm", "p05_mm", "p95_mm"):
                place = (*self.names, "surface", zone.zone, name.removesuffix("_mm"), "mm")
                values.append((*place, None, None, json_number(getattr(zone, name)), *[None] * 4))
        return rows(self.columns, values)

    def _row(self, kind: str, place: str, name: str, row: ValueDifference) -> tuple[object, ...]:
        first, second, more = (m.to_dict() for m in (row.first, row.second, row.difference))
        numbers = (first["value"], second["value"], more["value"], more["sd"])
        judged = (row.tolerance, row.inside, more["reason"])
        return (*self.names, kind, place, name, row.unit, *numbers, *judged)


def _last_part(last: Profiled) -> Json:
    alignment = last.aligned.alignment
    return {
        "mesh": alignment.info.to_dict(),
        "kind": "last" if last.is_last else "foot",
        **alignment.side.to_dict(),
    }
