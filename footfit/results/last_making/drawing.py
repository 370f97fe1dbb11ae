"""A foot or a last as it is drawn in true size: its views, and what is written beside them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from footfit.results.values import Document, Json, measures_part, part

if TYPE_CHECKING:
    from footfit.geometry.drawing.views import View
    from footfit.results.alignment import Alignment
    from footfit.results.values import Measure


@dataclass(frozen=True, slots=True)
class Drawing(Document):
    """The views of a shape on its own side, with its measures.

    ``missing`` names the views that cannot be drawn, because the scan is open there. ``labels`` are
    those of a last of the catalogue, by name. ``tolerance_mm`` is by how much a last as delivered
    may differ, by kind of measure; empty for a foot. ``has_rim`` says that outlines may run along
    the rim of a hole that a program closed: nothing was scanned there.
    """

    alignment: Alignment
    measures: tuple[Measure, ...]
    views: tuple[View, ...]
    missing: tuple[str, ...]
    labels: Mapping[str, Any]
    tolerance_mm: Mapping[str, float]
    has_rim: bool = False

    schema = "draw-last/1"

    def _keys(self) -> Json:
        shown = (
            {"name": view.name, "width_mm": view.size_mm[0], "height_mm": view.size_mm[1]}
            for view in self.views
        )
        return {
            **self.alignment.scan_keys(),
            "labels": dict(self.labels),
            "tolerance_mm": dict(self.tolerance_mm),
            "views": [part(view) for view in shown],
            "missing": list(self.missing),
            "has_rim": self.has_rim,
            "measures": measures_part(self.measures),
        }

    def value_of(self, measure: str) -> Measure | None:
        """The measure of that name; None if the shape has none."""
        return next((row for row in self.measures if row.name == measure), None)
