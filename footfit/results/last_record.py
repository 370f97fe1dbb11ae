"""A last as the catalogue holds it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.results.values import Measured

if TYPE_CHECKING:
    from footfit.geometry.flare.flare_profile import FlareProfile
    from footfit.geometry.numeric.arrays import Floats
    from footfit.results.alignment import Eigenframe, PoseQuality, SideVerdict
    from footfit.results.meshes import MeshInfo
    from footfit.results.values import Measure, Notice


@dataclass(frozen=True, slots=True)
class LastLabels:
    """What people say of a last; kept as given and never trusted over its geometry."""

    name: str
    style: str | None = None
    size: str | None = None
    size_system: str | None = None
    width_label: str | None = None
    heel_height_mm: float | None = None
    family: str | None = None
    parent: str | None = None


@dataclass(frozen=True, slots=True)
class LastRecord:
    """A last as the catalogue holds it, without its mesh.

    ``eigenframe`` is of the exact moments, ``printed_frame`` by Eq. 1-4 as printed.
    ``paper_transform`` (4, 4) takes the file's coordinates (mirrored in its first axis for a
    left last) to the reference's frame by the paper's Eq. 8, from the printed frames; None while
    there is no reference.
    ``extent_mm`` is how far the mesh reaches along X; definitions are scaled by it.
    ``upgraded_from`` names the older flare definition that this profile replaces.
    """

    labels: LastLabels
    info: MeshInfo
    side: SideVerdict
    pose: PoseQuality
    eigenframe: Eigenframe
    printed_frame: Eigenframe
    canonical_transform: Floats
    paper_transform: Floats | None
    extent_mm: float
    flare: FlareProfile
    measures: tuple[Measure, ...]
    warnings: tuple[Notice, ...]
    upgraded_from: str | None = None

    @property
    def length(self) -> Measured:
        """The measured length, which people read; it has no value where an end was not scanned."""
        rows = (row.measured for row in self.measures if row.name == "length")
        return next(rows, Measured(None, reason="the catalogue holds no length of this last"))

    @property
    def length_mm(self) -> float | None:
        """The value of ``length``."""
        return self.length.value
