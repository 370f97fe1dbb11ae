"""The files of a comparison: the coloured foot as a mesh or a picture, the sections drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.report.pictures.figures import picture_bytes

if TYPE_CHECKING:
    from footfit.results import Comparison

HEAT_KINDS = ("ply", "svg", "png")


def heat_bytes(comparison: Comparison, kind: str) -> bytes:
    """The foot in the last's frame, coloured by its room: "ply", "svg" or "png".

    The mesh is on the foot's own side and carries ``room_mm`` at every vertex, NaN where nothing
    is compared.
    """
    from footfit.meshes.write import COLOUR, encoded_mesh
    from footfit.report.pictures.heat import heat_colours
    from footfit.report.pictures.heat_figure import heat_figure, own_side

    if kind != "ply":
        return picture_bytes(heat_figure(comparison), kind)
    (vertices, faces), _ = own_side(comparison)
    colours = np.rint(255.0 * heat_colours(comparison.clearance_mm)).astype(np.uint8)
    return encoded_mesh(
        vertices, faces, "ply", {"room_mm": comparison.clearance_mm, COLOUR: colours}
    )


def sections_plot(comparison: Comparison, kind: str) -> bytes:
    """Every section of foot and last, "svg" or "png"."""
    from footfit.report.pictures.section_figure import section_figure

    return picture_bytes(section_figure(comparison), kind)
