"""What every reader returns: the file's own vertices and faces, checked but not cleaned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, EmptyMesh, TooLarge
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.read_limits import SIMPLIFY, Limits
from footfit.results.values import Notice


@dataclass(frozen=True, slots=True)
class RawMesh:
    """Vertices (n, 3) in the file's unit and order, faces (m, 3), and warnings.

    ``unit`` is the unit that the file declares ("mm", "cm", "m", "in"), or None where its format
    has no unit.
    """

    vertices: Floats
    faces: Ints
    warnings: tuple[Notice, ...] = ()
    unit: str | None = None


def doubles(values: NDArray[np.generic]) -> Floats:
    """The numbers as float64; `checked_mesh` refuses a signalling NaN, so NumPy need not warn."""
    with np.errstate(invalid="ignore"):
        return values.astype(np.float64)


def checked_mesh(raw: RawMesh, limits: Limits) -> RawMesh:
    """The same mesh, after its numbers, indices and counts have been checked.

    Raises
    ------
    EmptyMesh
        There are no faces.
    DamagedMesh
        A coordinate is NaN, infinite or beyond ``limits.coordinate``, or a face names a vertex
        that is not there.
    TooLarge
        More vertices or faces than ``limits`` allow.
    """
    check_counts(len(raw.vertices), len(raw.faces), limits)
    if len(raw.faces) == 0:
        points = f"{len(raw.vertices)} points but no faces"
        content = points if len(raw.vertices) else "no triangles"
        raise EmptyMesh(f"the file holds {content}: export a triangle mesh")
    if raw.faces.min() < 0 or raw.faces.max() >= len(raw.vertices):
        raise DamagedMesh(
            f"a face names a vertex that is not there (the file has {len(raw.vertices)} vertices):"
            " export the mesh again"
        )
    low, high = raw.vertices.min(), raw.vertices.max()  # a NaN comes through both
    if not np.isfinite([low, high]).all():
        bad = np.flatnonzero(~np.isfinite(raw.vertices).all(axis=1))
        raise DamagedMesh(
            f"{len(bad):,} of the vertices lack a finite number (the first is vertex"
            f" {bad[0] + 1:,}): export the mesh again"
        )
    if max(-low, high) > limits.coordinate:
        raise DamagedMesh(
            f"a coordinate is over {limits.coordinate:g}: the file is damaged, export it again"
        )
    return raw


def check_counts(vertices: int, faces: int, limits: Limits) -> None:
    """Refuse counts over the limits.

    Raises
    ------
    TooLarge
        Naming the count and its limit.
    """
    for count, most, noun in (
        (faces, limits.faces, "faces"),
        (vertices, limits.vertices, "vertices"),
    ):
        if count > most:
            raise TooLarge(
                f"the mesh has {count:,} {noun} and footfit reads up to {most:,}: {SIMPLIFY}"
            )
