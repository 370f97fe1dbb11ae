"""The wide openings of a shape, where its leg or its sole was not scanned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.caps import extent_of
from footfit.geometry.mesh.surface import unit
from footfit.geometry.mesh.topology import boundary_loops
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class OpeningSettings:
    """When an opening is wide, over the shape's size, and when it looks up or down."""

    wide: float = 0.25
    upright: float = 0.70  # cosine with Z of where it looks


OPENINGS = OpeningSettings()


@dataclass(frozen=True, slots=True)
class Openings:
    """Wide openings: their rims, and where each looks, (k, 3) unit vectors."""

    rims: list[Ints]
    directions: Floats

    @classmethod
    def of(cls, vertices: Floats, faces: Ints) -> Openings:
        """The wide openings of a mesh whose faces look outward."""
        size = float(np.ptp(vertices, axis=0).max())
        rims = [
            rim for rim in boundary_loops(faces) if extent_of(vertices[rim]) > OPENINGS.wide * size
        ]
        areas = np.array([_area_vector(vertices[rim]) for rim in rims]).reshape(-1, 3)
        return cls(rims, unit(areas))  # a rim that runs there and back looks nowhere

    @classmethod
    def none(cls) -> Openings:
        """Those of a closed surface."""
        return cls([], np.empty((0, 3)))

    def look_up_and_down(self, up: Floats) -> bool:
        """Whether each opening is that of a leg or a sole, if ``up`` (3,) is up."""
        return bool((np.abs(self.directions @ up) > OPENINGS.upright).all())

    def lack_a_sole(self, up: Floats) -> bool:
        """Whether one of them looks down."""
        return bool((self.directions @ up < -OPENINGS.upright).any())

    def closed(self, vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
        """The mesh with a flat lid on each opening."""
        lids = [
            np.stack([np.roll(rim, -1), rim, np.full(len(rim), len(vertices) + number)], axis=1)
            for number, rim in enumerate(self.rims)
        ]
        middles = [vertices[rim].mean(axis=0) for rim in self.rims]
        return np.vstack([vertices, *middles]), np.concatenate([faces, *lids])


def _area_vector(rim: Floats) -> Floats:
    """The area vector (3,) of the lid that closes a rim (k, 3) of outward faces: it looks out."""
    away = rim - rim.mean(axis=0)
    return np.asarray(0.5 * np.cross(np.roll(away, -1, axis=0), away).sum(axis=0))
