"""The flare, the measures and the curvature of one mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.flare.definition import CHANNELS
from footfit.geometry.measures.measure_table import MEASURES
from footfit.results.values import Document, Json, exact, fields, measures_part, part, rows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from footfit.errors import FootfitError
    from footfit.geometry.flare.definition import FlareProfile
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.alignment import AlignedScan, Alignment
    from footfit.results.meshes import MeshInfo
    from footfit.results.values import Measure, Notice

QUANTILES = (0.05, 0.5, 0.95)
MEASURE_NAMES = tuple(entry.name for entry in MEASURES)


def flare_part(flare: FlareProfile) -> Json:
    """The flare profile with its whole definition."""
    return part(
        {
            "flare_angle_deg": flare.angle_deg,
            "flare_angle_sd_deg": flare.angle_sd_deg,
            "flare_angle_total_sd_deg": flare.angle_total_sd_deg,
            "class": flare.flare_class,
            "definition": exact(fields(flare.definition)),
            "stations": flare.stations,
            "heading_deg": flare.heading_deg,
            "curvature": part({name: flare.curvature.get(name) for name in CHANNELS}),
        }
    )


@dataclass(frozen=True, slots=True)
class Profiled(Document):
    """A mesh aligned, measured and profiled: what ingest stores and match ranks.

    ``unusual`` are notices of a flare that is unusual for a foot or a last. ``labels`` are what
    people say of a last of the catalogue, by the names of `LastLabels`.
    """

    aligned: AlignedScan
    flare: FlareProfile
    measures: tuple[Measure, ...]
    unusual: tuple[Notice, ...] = ()
    labels: Mapping[str, Any] | None = None

    columns = (
        *("path", "side", "flare_angle_deg", "flare_angle_sd_deg", "flare_angle_total_sd_deg"),
        *("class", "definition"),
        *("station", "heading_deg", *CHANNELS),
    )

    schema = "flare/1"

    def _keys(self) -> Json:
        alignment = self.aligned.alignment
        return {
            **alignment.scan_keys(),
            **flare_part(self.flare),
            "length_mm": alignment.length_mm,
            "extent_mm": alignment.extent_mm,
            "warnings": (*alignment.warnings, *self.unusual),
        }

    def rows(self) -> list[Json]:
        """The profile as a table: a row for each station."""
        alignment, flare = self.aligned.alignment, self.flare
        start = (
            alignment.info.path,
            alignment.side.side,
            flare.angle_deg,
            flare.angle_sd_deg,
            flare.angle_total_sd_deg,
            flare.flare_class,
            flare.definition.version,
        )
        nothing = (None,) * len(flare.stations)
        curves = [flare.curvature.get(name) for name in CHANNELS]
        known = (nothing if curve is None else curve for curve in curves)
        stations = zip(flare.stations, flare.heading_deg, *known, strict=True)
        return rows(self.columns, [(*start, *values) for values in stations])

    @property
    def is_last(self) -> bool:
        """Whether it is a last: by its shape, or as a last of the catalogue."""
        alignment = self.aligned.alignment
        return alignment.pose.kind == "last" or alignment.info.is_stored_last

    @property
    def length_mm(self) -> float | None:
        """The measured length, which sizes are read from; None if an end was not scanned."""
        return self.aligned.alignment.length_mm

    @property
    def length_or_extent_mm(self) -> float:
        """The length, or the extent if there is none: it shows which of two feet is longer."""
        return self.aligned.alignment.extent_mm if self.length_mm is None else self.length_mm


@dataclass(frozen=True, slots=True)
class MeasuredScan(Document):
    """A mesh aligned and measured; ``unusual`` are notices of unusual values."""

    alignment: Alignment
    measures: tuple[Measure, ...]
    unusual: tuple[Notice, ...]

    columns = (
        *("path", "side", "kind", "measure"),
        *("value_mm", "sd_mm", "total_sd_mm", "bias_mm", "reason", "definition"),
        *("value_deg", "sd_deg", "total_sd_deg", "bias_deg"),
    )

    schema = "measure/1"

    def _keys(self) -> Json:
        alignment = self.alignment
        return {
            **alignment.scan_keys(),
            "measures": measures_part(self.measures),
            "definitions": {row.name: row.definition for row in self.measures},
            "warnings": (*alignment.warnings, *self.unusual),
        }

    def wide(self) -> WideMeasures:
        """The measures as one row of a table that has a column for each measure."""
        alignment = self.alignment
        shape = (alignment.info.path, alignment.side.side, alignment.pose.kind)
        return WideMeasures(*shape, measures=self.measures)

    def rows(self) -> list[Json]:
        """The measures as a table: a row for each; one without a value has a reason."""
        alignment = self.alignment
        start = (alignment.info.path, alignment.side.side, alignment.pose.kind)
        nothing, values = (None,) * 4, []
        for row in self.measures:
            taken = row.measured
            spreads = (taken.value, taken.sd, taken.total_sd, taken.bias)
            lengths, angles = (nothing, spreads) if row.unit == "deg" else (spreads, nothing)
            values.append((*start, row.name, *lengths, taken.reason, row.definition, *angles))
        return rows(self.columns, values)


@dataclass(frozen=True, slots=True)
class WideMeasures:
    """The measures of one mesh in one row, with a column for each measure."""

    path: str | None
    side: str | None = None
    kind: str | None = None
    status: str = "measured"
    error: str | None = None
    why: str | None = None
    measures: tuple[Measure, ...] = ()

    columns = (
        *("path", "side", "kind", "status", "error", "why"),
        *(name if name.endswith("_deg") else f"{name}_mm" for name in MEASURE_NAMES),
    )

    @classmethod
    def failed(cls, source: Any, error: FootfitError) -> WideMeasures:
        """The row of a mesh that could not be measured."""
        return cls(source.path, status="failed", error=error.code, why=error.message)

    def rows(self) -> list[Json]:
        """The one row; a measure that was not taken is empty."""
        start = (self.path, self.side, self.kind, self.status, self.error, self.why)
        taken = {row.name: row.measured.value for row in self.measures}
        return rows(self.columns, [(*start, *(taken.get(name) for name in MEASURE_NAMES))])


@dataclass(frozen=True, slots=True)
class SurfaceCurvature(Document):
    """The curvature of a surface at each vertex in 1/mm, (n,) each; NaN if it is undefined.

    ``k1`` <= ``k2``; convex is positive; ``radius_mm`` 0 is the paper's one ring. ``output``
    names the file that holds the values of every vertex, if one was written.
    """

    info: MeshInfo
    radius_mm: float
    vertices_mm: Floats
    faces: Ints
    k1: Floats
    k2: Floats
    mean: Floats
    gaussian: Floats
    source_to_vertex: Ints
    warnings: tuple[Notice, ...]
    output: str | None = None

    schema = "curvature/1"

    def _keys(self) -> Json:
        return {
            "mesh": self.info,
            "radius_mm": self.radius_mm,
            "defined_vertices": int(np.count_nonzero(np.isfinite(self.mean))),
            "k1_per_mm": spread_part(self.k1),
            "k2_per_mm": spread_part(self.k2),
            "mean_per_mm": spread_part(self.mean),
            "gaussian_per_mm2": spread_part(self.gaussian),
            "output": self.output,
            "warnings": self.warnings,
        }


def spread_part(values: Floats) -> Json:
    """The 5 %, 50 % and 95 % quantiles over the defined vertices; null if there is none."""
    defined = values[np.isfinite(values)]
    quantiles = np.quantile(defined, QUANTILES) if len(defined) else [None] * len(QUANTILES)
    names = (f"p{round(100 * level):02d}" for level in QUANTILES)
    return part(dict(zip(names, quantiles, strict=True)))
