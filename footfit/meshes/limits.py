"""How much a mesh file may ask for; everything past this is refused by name, not tried."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """Caps that are checked before memory is asked for.

    Attributes
    ----------
    file_bytes : int
        The largest file that is read.
    faces, vertices : int
        The largest counts, declared or found. An STL has three vertices a face.
    polygon_corners : int
        The largest polygon that is cut into triangles.
    header_bytes : int
        How far the header of a text format may reach.
    coordinate : float
        The largest absolute coordinate, in the file's unit: 1e9 mm are 1,000 km.
    """

    file_bytes: int = 640_000_000
    faces: int = 3_000_000
    vertices: int = 9_000_000
    polygon_corners: int = 1_000
    header_bytes: int = 65_536
    coordinate: float = 1e9


LIMITS = Limits()
