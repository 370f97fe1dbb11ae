"""How much a mesh file may ask for. What asks for more is refused, and the message says why."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits that are checked before memory is taken.

    Attributes
    ----------
    file_bytes : int
        The largest file that is read.
    faces, vertices : int
        The largest counts, as declared or as counted. An STL has three vertices a face.
    polygon_corners : int
        The largest polygon that is cut into triangles.
    header_bytes : int
        How far the header of a text format may reach.
    coordinate : float
        The largest absolute coordinate, in the file's unit: 1e9 mm are 1,000 km.
    document_bytes : int
        The largest JSON of a GLB, directory of an archive, or XML tag.
    parts : int
        How many nodes, primitives or archive parts a file may have.
    elements : int
        How many XML elements a file may have beside vertices and triangles.
    expanded_bytes, expansion : int
        How large an archive's part may become, in bytes and as a multiple of its packed size.
    """

    file_bytes: int = 640_000_000
    faces: int = 3_000_000
    vertices: int = 9_000_000
    polygon_corners: int = 1_000
    header_bytes: int = 65_536
    coordinate: float = 1e9
    document_bytes: int = 4_000_000
    parts: int = 1_000
    elements: int = 100_000
    expanded_bytes: int = 400_000_000
    expansion: int = 200


LIMITS = Limits()
SIMPLIFY = "simplify the mesh first (100,000 faces are plenty)"
"""What to do with a mesh that is too large."""
