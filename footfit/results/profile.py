"""One aligned mesh, measured: its flare, its measures, its surface's curvature."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.geometry.flare.flare_profile import FlareProfile
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.alignment import AlignedScan, Alignment
    from footfit.results.meshes import MeshInfo
    from footfit.results.values import Measure, Notice


@dataclass(frozen=True, slots=True)
class Profiled:
    """A mesh aligned, measured and profiled: what ingest stores and match ranks.

    ``suspects`` says what is hardly a foot's, or a last's, of the flare.
    """

    aligned: AlignedScan
    flare: FlareProfile
    measures: tuple[Measure, ...]
    suspects: tuple[Notice, ...] = ()

    @property
    def length_mm(self) -> float | None:
        """The measured length, which sizes are read from; None where an end was not scanned."""
        return self.aligned.alignment.length_mm

    @property
    def length_or_extent_mm(self) -> float:
        """The length, or the extent where there is none: tells which of two feet is longer."""
        return self.aligned.alignment.extent_mm if self.length_mm is None else self.length_mm


@dataclass(frozen=True, slots=True)
class MeasuredScan:
    """A mesh aligned and measured; ``suspects`` are values that are hardly a foot's."""

    alignment: Alignment
    measures: tuple[Measure, ...]
    suspects: tuple[Notice, ...]


@dataclass(frozen=True, slots=True)
class SurfaceCurvature:
    """Per-vertex curvature of a surface in 1/mm, (n,) each; NaN where it is undefined.

    ``k1`` <= ``k2``; convex is positive; ``radius_mm`` 0 is the paper's one ring.
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
