"""The sections of a last as tables: the sizes at each station, and the outlines in space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.results.values import Json, Measured, rows


@dataclass(frozen=True, slots=True)
class LastSection:
    """One section of a last, in the frame and on the side of its written mesh.

    Attributes
    ----------
    place : str
        The name of the station, empty for one without a name.
    share : float
        Where it is along the bottom's arc, 0 heel and 1 toe.
    along_mm : float
        The same from the heel in mm along the bottom.
    point_mm, normal : (3,)
        The plane: one of its points, and its unit normal towards the toe.
    sizes : tuple of (str, Measured)
        Width, height and girth in mm.
    loops : tuple of (k, 3)
        The closed outline in mm, a loop for each piece.
    """

    place: str
    share: float
    along_mm: float
    point_mm: Floats
    normal: Floats
    sizes: tuple[tuple[str, Measured], ...]
    loops: tuple[Floats, ...]


@dataclass(frozen=True, slots=True)
class SectionTable:
    """The sizes of a last's sections, a row for each."""

    last: str
    sections: tuple[LastSection, ...]

    columns: ClassVar[tuple[str, ...]] = (
        *("last", "station", "place", "along_mm"),
        *("width_mm", "width_sd_mm", "height_mm", "height_sd_mm", "girth_mm", "girth_sd_mm"),
        *("point_x_mm", "point_y_mm", "point_z_mm", "normal_x", "normal_y", "normal_z", "reason"),
    )

    def rows(self) -> list[Json]:
        """The table; ``reason`` says why a size is missing."""
        values = []
        for section in self.sections:
            sizes = [known for _, known in section.sizes]
            numbers = [number for known in sizes for number in (known.value, known.sd)]
            reason = next((known.reason for known in sizes if known.value is None), None)
            place = (self.last, section.share, section.place, section.along_mm)
            values.append((*place, *numbers, *section.point_mm, *section.normal, reason))
        return rows(self.columns, values)

    def outlines(self) -> OutlineTable:
        """The outlines of the same sections."""
        return OutlineTable(self.last, self.sections)


@dataclass(frozen=True, slots=True)
class OutlineTable:
    """The outlines of a last's sections: a row for each point, loop by loop."""

    last: str
    sections: tuple[LastSection, ...]

    columns: ClassVar[tuple[str, ...]] = (
        "last",
        "station",
        "place",
        "loop",
        "point",
        "x_mm",
        "y_mm",
        "z_mm",
    )

    def rows(self) -> list[Json]:
        """The table; the last point of a loop is joined to its first."""
        return rows(
            self.columns,
            [
                (self.last, section.share, section.place, loop, number, *np.asarray(point).tolist())
                for section in self.sections
                for loop, points in enumerate(section.loops, 1)
                for number, point in enumerate(points, 1)
            ],
        )
