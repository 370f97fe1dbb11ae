"""A map of a surface's curvature: the sole, the two sides and the top, one scale of colours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points
from footfit.number_words import plain
from footfit.report.pictures.figures import (
    DIVERGING,
    draw_scale_bar,
    new_figure,
    show_image,
    write_title,
)
from footfit.report.pictures.shading import VIEWS, frame_around, shaded_image
from footfit.report.wording.text import file_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from footfit.results import SurfaceCurvature

SHOWN_QUANTILE = 0.95
"""The scale of colours reaches to this quantile of the size, so that a spike does not bleach it."""
UNDEFINED = (0.62, 0.62, 0.62)
"""Grey: no curvature is defined there, at a rim."""
COLUMNS = 700
BARS_MM = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)

PANELS = {
    "Sole, from below": VIEWS["from_below"],
    "From above": VIEWS["from_above"],
    "From the right": VIEWS["from_right"],
    "From the left": VIEWS["from_left"],
}


def curvature_figure(
    curvature: SurfaceCurvature, canonical_transform: Floats | None = None
) -> Figure:
    """Four views of the surface coloured by its mean curvature.

    Parameters
    ----------
    curvature : SurfaceCurvature
        Its vertices are in the file's axes, mm.
    canonical_transform : (4, 4), optional
        The alignment's, from the file's coordinates to canonical mm. Without one the mesh is
        drawn along its longest and shortest directions, and the views are numbered.
    """
    points = _drawn_points(curvature, canonical_transform)
    colours, scale = _colours(curvature.mean)
    with new_figure(10.5, 6.6) as figure:
        panels = zip(figure.subplots(2, 2).flat, PANELS.items(), strict=True)
        for number, (axes, (title, view)) in enumerate(panels, start=1):
            _draw_panel(axes, points @ view.T, curvature.faces, colours)
            axes.set_title(f"View {number}" if canonical_transform is None else title)
        bar = figure.colorbar(scale, ax=figure.axes, location="right", shrink=0.7, extend="both")
        bar.set_label("mean curvature (1/mm), + convex, - hollow")
        bar.outline.set_visible(False)
        radius = curvature.radius_mm
        around = f"over a radius of {plain(radius)} mm" if radius else "of one ring of neighbours"
        write_title(figure, f"{file_name(curvature.info.path)}   mean curvature {around}")
    return figure


def colour_reach(values: Floats) -> float:
    """The value at the end of the scale of colours; 1 where nothing is defined or all is flat."""
    known = np.abs(values[np.isfinite(values)])
    return (float(np.quantile(known, SHOWN_QUANTILE)) if len(known) else 0.0) or 1.0


def curvature_colours(curvature: SurfaceCurvature) -> NDArray[np.uint8]:
    """The mean curvature of each vertex as red, green, blue (n, 3), on the picture's scale."""
    return np.rint(_colours(curvature.mean)[0] * 255.0).astype(np.uint8)


def _drawn_points(curvature: SurfaceCurvature, canonical_transform: Floats | None) -> Floats:
    """The vertices in the canonical frame, or along their own principal directions."""
    points = curvature.vertices_mm
    if canonical_transform is not None:
        return moved_points(canonical_transform, points / curvature.info.unit_scale)
    centred = points - points.mean(axis=0)
    columns = np.linalg.eigh(centred.T @ centred)[1][:, ::-1]
    columns[:, 2] *= np.sign(np.linalg.det(columns))
    return np.asarray(centred @ columns)


def _colours(values: Floats) -> tuple[Floats, Any]:
    """One colour per vertex (n, 3), and the scale that gave it."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    reach = colour_reach(values)
    scale = ScalarMappable(Normalize(-reach, reach), colormaps[DIVERGING])
    colours = scale.to_rgba(np.nan_to_num(values, nan=0.0))[:, :3].astype(np.float64)
    colours[~np.isfinite(values)] = UNDEFINED
    return colours, scale


def _draw_panel(axes: Axes, projected: Floats, faces: Ints, colours: Floats) -> None:
    frame = frame_around(projected, margin=0.06)
    show_image(axes, shaded_image(projected, faces, frame, COLUMNS, colours), frame)
    fifth = (frame.right - frame.left) / 5.0
    length_mm = min(BARS_MM, key=lambda length: abs(length - fifth))
    draw_scale_bar(axes, length_mm=length_mm, place=(0.03, 0.0))
