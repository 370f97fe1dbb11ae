"""A shape as its flare is read: a last stands on its heel, and its bottom is laid flat."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.flare.centre_line import CentreLine
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.leaning_shank import without_leaning_shank
from footfit.geometry.flare.levelled_bottom import BottomShape, bottom_shape
from footfit.geometry.flare.unrolling import FlatBottom, SideLine, flat_bottom, side_line
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.stance import Stance


@dataclass(frozen=True, slots=True)
class Flattened:
    """A bottom laid flat, and the way back.

    Attributes
    ----------
    shape : BottomShape
        Over its length, level, low faces only.
    reading : FlareDefinition
        The definition with the length's height of this kind of shape.
    side : SideLine
        The middle line in the side view, along which the bottom was laid flat.
    turn : (2, 2)
        Took the plan to the principal axis.
    resting : (4, 4)
        From the frame of ``side`` to the canonical frame.
    """

    shape: BottomShape
    reading: FlareDefinition
    side: SideLine
    turn: Floats
    resting: Floats

    def side_view(self, line: CentreLine, x: Floats) -> Floats:
        """Where the side line is below the centre line at ``x`` (n,): (n, 2), over the length.

        The first column is the way along the ground, counted along the centre line's plan; the
        second is the height. Of a shape that lies flat they are the arc length and 0.
        """
        arc_mm, _ = self._unturned(line, x)
        along, height = self.side.at(arc_mm)
        way = line.station_at(x) * line.arc_length
        return np.column_stack([way - (arc_mm - along) / self.shape.length_mm, self._over(height)])

    def plan_mm(self, line: CentreLine, x: Floats) -> Floats:
        """The centre line at ``x`` (n,) in the plan of the canonical frame, (n, 2) in mm."""
        arc_mm, aside = self._unturned(line, x)
        along, height = self.side.at(arc_mm)
        points = np.column_stack([along, aside, height])
        return np.asarray((points @ self.resting[:3, :3].T + self.resting[:3, 3])[:, :2])

    def _over(self, value_mm: Floats) -> Floats:
        return value_mm / self.shape.length_mm

    def _unturned(self, line: CentreLine, x: Floats) -> tuple[Floats, Floats]:
        points = np.column_stack([x, np.interp(x, line.x, line.y)]) * self.shape.length_mm
        points[:, 0] += self.shape.origin_mm
        arc_mm, aside = (points @ self.turn.T).T
        return arc_mm, aside


def flattened(
    vertices_mm: Floats, faces: Ints, stance: Stance | None, definition: FlareDefinition
) -> Flattened:
    """A canonical right shape with its bottom laid flat; without a stance it lies flat already.

    Raises
    ------
    HalfScan
        The shape has no length.
    """
    if stance is None:
        flat = FlatBottom(*without_leaning_shank(vertices_mm, faces), np.eye(2))
        shape = bottom_shape(flat.vertices_mm, flat.faces, definition)
        return Flattened(shape, definition, SideLine.level(), flat.turn, np.eye(4))
    from footfit.geometry.flare.turning import laid_flat

    stands = stance.standing_transform
    line = side_line(stance.middle_mm, stance.length_mm, definition)
    standing_mm = vertices_mm @ stands[:3, :3].T + stands[:3, 3]
    flat_mm = laid_flat(standing_mm, faces, line, stance.length_mm, definition)
    flat = flat_bottom(flat_mm, faces, definition.flat_height * stance.length_mm)
    reading = replace(definition, length_height=definition.flat_length_height)
    shape = bottom_shape(flat.vertices_mm, flat.faces, reading)
    return Flattened(shape, reading, line, flat.turn, np.asarray(np.linalg.inv(stands)))
