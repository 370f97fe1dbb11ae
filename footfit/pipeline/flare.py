"""From an aligned mesh to its flare profile and its measures."""

from __future__ import annotations

import numpy as np

from footfit.errors import SideUndecided
from footfit.geometry import measures
from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.flare import FlareDefinition, flare_profile
from footfit.results import AlignedScan, Measure, Measured, Profiled, SideName


def profiled(aligned: AlignedScan, definition: FlareDefinition | None = None) -> Profiled:
    """Profile and measure an aligned mesh; a left one as its mirror image.

    Parameters
    ----------
    aligned : AlignedScan
    definition : FlareDefinition, optional

    Returns
    -------
    Profiled

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    HalfScan
        The bottom cannot be followed over enough of the length.
    """
    alignment = aligned.alignment
    if alignment.side.side is None:
        raise SideUndecided(
            "the shape does not tell left from right: say --side left or --side right",
            alignment.info.path,
        )
    vertices_mm, faces = right_shape(aligned)
    flare = flare_profile(vertices_mm, faces, definition, alignment.pose.kind)
    return Profiled(aligned, flare, measured(vertices_mm, faces))


def right_shape(aligned: AlignedScan) -> tuple[Floats, Ints]:
    """The canonical mesh as a right one: vertices (n, 3) in mm and faces (m, 3), wound outward."""
    return as_right(aligned.vertices_mm, aligned.faces, aligned.alignment.side.side)


def as_right(vertices_mm: Floats, faces: Ints, side: SideName | None) -> tuple[Floats, Ints]:
    """A canonical mesh as a right one; a left mesh is mirrored, its faces turned over."""
    if side != "left":
        return vertices_mm, faces
    return vertices_mm * np.array([1.0, -1.0, 1.0]), faces[:, ::-1]


def measured(vertices_mm: Floats, faces: Ints) -> tuple[Measure, ...]:
    """Every measure of the table on a canonical right shape, in the table's order."""
    return tuple(_row(entry, vertices_mm, faces) for entry in measures.MEASURES)


def _row(entry: measures.Measure, vertices_mm: Floats, faces: Ints) -> Measure:
    reading = entry.reading(vertices_mm, faces)
    sd = None if reading.value is None else entry.sd
    return Measure(entry.name, Measured(reading.value, sd, reading.reason), entry.definition)
