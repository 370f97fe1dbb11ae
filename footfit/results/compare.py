"""One foot in one last: surface against surface, section by section."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.geometry.fit.clearance import ZoneClearance
    from footfit.geometry.fit.placement import Docking
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.last_record import LastRecord
    from footfit.results.profile import Profiled
    from footfit.results.values import Measured, Notice, SideName


@dataclass(frozen=True, slots=True)
class SizeDifference:
    """One size of one section in mm: of the foot, of the last, and last minus foot."""

    name: str
    foot: Measured
    last: Measured
    difference: Measured


@dataclass(frozen=True, slots=True)
class SectionComparison:
    """Foot and last cut by one plane at a named ``station``, ``x_mm`` from the foot's heel.

    The outlines are closed loops (k, 2), across (+ is medial) and up, mm.
    """

    station: str
    x_mm: float
    foot_outline: tuple[Floats, ...]
    last_outline: tuple[Floats, ...]
    sizes: tuple[SizeDifference, ...]


@dataclass(frozen=True, slots=True)
class SurfaceRoom:
    """One foot of a customer laid into one last: the room between the surfaces, zone by zone.

    ``swing_mm`` is how far the foot's tread had to go to medial to lie on the last's. ``reason``
    says why the foot could not be laid in; there are no zones then.
    """

    side: SideName | None
    swing_mm: float | None
    zones: tuple[ZoneClearance, ...]
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class Comparison:
    """A foot in a last, both as right shapes in the last's frame, mm.

    ``vertices_mm`` (n, 3) and ``faces`` (m, 3) are the foot as it is docked, ``room_mm`` (n,) its
    clearance at each vertex, NaN where the shoe does not reach; ``last_vertices_mm`` and
    ``last_faces`` are the last. ``mirrored``: the last is of the other side than the foot.
    """

    foot: Profiled
    last: LastRecord
    mirrored: bool
    docking: Docking
    vertices_mm: Floats
    faces: Ints
    last_vertices_mm: Floats
    last_faces: Ints
    room_mm: Floats
    zones: tuple[ZoneClearance, ...]
    sections: tuple[SectionComparison, ...]
    warnings: tuple[Notice, ...]

    @property
    def longer_mm(self) -> float | None:
        """How much longer the last is than the foot; None where one length is not known."""
        foot_mm, last_mm = self.foot.length_mm, self.last.length_mm
        return None if foot_mm is None or last_mm is None else last_mm - foot_mm
