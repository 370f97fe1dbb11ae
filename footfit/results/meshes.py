"""What a mesh file holds, and what the catalogue keeps of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.results.values import Part

if TYPE_CHECKING:
    from collections.abc import Mapping

    from footfit.geometry.fit.stations import NamedSection
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.geometry.search.pose_search import RoughPose
    from footfit.results.values import Notice


FROM_CATALOGUE = "catalogue"
"""The format of a shape that is a last of the catalogue; its path is the last's name."""


@dataclass(frozen=True, slots=True)
class MeshInfo(Part):
    """What is known of a mesh file.

    ``vertices`` and ``faces`` count what is left after welding and cleaning, ``sha256`` is of
    the file's bytes, ``unit_scale`` takes the file's coordinates to mm, ``units`` is
    "mm", "cm", "m", "in" or "scaled" (``--known-length``), ``units_source`` is
    "declared", "detected" or "known-length". ``step`` is the step in which the file keeps its
    coordinates, 0 if there is none. ``scanner`` is the kind of scanner, if that is known.
    """

    path: str | None
    sha256: str
    format: str
    vertices: int
    faces: int
    watertight: bool
    units: str
    units_source: str
    unit_scale: float
    step: float = 0.0
    scanner: str | None = None

    not_written = (
        "format",
        "unit_scale",
        "step",
        "scanner",
    )

    @property
    def is_stored_last(self) -> bool:
        """Whether the mesh is the copy of a last of the catalogue."""
        return self.format == FROM_CATALOGUE

    @property
    def resolution_mm(self) -> float:
        """The step in which the file keeps its coordinates, in mm; 0 if there is none."""
        return self.step * self.unit_scale


@dataclass(frozen=True, slots=True)
class Scan:
    """A mesh ready for geometry: mm, welded, cleaned, wound outward.

    ``vertices_mm`` is (n, 3) float64 in the file's own axes, ``faces`` is (m, 3) int64.
    ``source_to_vertex`` is, for each vertex of the file, its row of ``vertices_mm``, -1 if it
    was dropped; None for a scan without a file. ``pose`` is known of a shape that
    was told apart from others in its file, and None of all others.
    """

    info: MeshInfo
    vertices_mm: Floats
    faces: Ints
    warnings: tuple[Notice, ...]
    source_to_vertex: Ints | None = None
    pose: RoughPose | None = None


@dataclass(frozen=True, slots=True)
class ShapeSections:
    """What is kept of a last's shape beside its mesh, in mm of the canonical right frame.

    ``sections`` by the name of their station; ``toes_outline_mm`` (n, 3) are the edges of the toes
    on the bottom laid flat: the way along it, the lateral and the medial edge.
    """

    sections: Mapping[str, NamedSection]
    toes_outline_mm: Floats | None


@dataclass(frozen=True, slots=True)
class MeshCopy:
    """A last's mesh as the catalogue keeps it: canonical mm, decimated, compressed.

    ``error_mm`` is the largest measured distance between the copy and the mesh it stands for,
    ``data`` the compressed bytes of ``meshes.copies``.
    """

    data: bytes
    faces: int
    error_mm: float
