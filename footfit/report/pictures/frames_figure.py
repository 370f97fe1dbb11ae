"""The paper's figures 1 and 2: a mesh with its eigenvectors, before and after the alignment."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points
from footfit.number_words import plain
from footfit.report.pictures.figures import (
    INK,
    SERIES,
    SKIN,
    arrow_style,
    draw_scale_bar,
    new_figure,
    show_image,
    write_beside,
    write_title,
)
from footfit.report.pictures.shading import VIEWS, axonometric_view, frame_around, shaded_image
from footfit.report.wording.text import length_text, shape_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import AlignedScan

EYE_DEG = (-52.0, 24.0)
"""Azimuth and elevation of the eye in the two oblique views."""
COLUMNS = 560
REACH = 2.0
"""An eigenvector's arrow, in standard deviations of the surface along it: each row's own value."""
ARROWS = tuple(zip(("e1", "e2", "e3"), SERIES, strict=False))


def frames_figure(mesh: AlignedScan) -> Figure:
    """The mesh as the file has it, and aligned: oblique, from above and from the side.

    Parameters
    ----------
    mesh : AlignedScan
        Of any method: the picture shows what the alignment's own ``transform`` does.
    """
    alignment = mesh.alignment
    back = np.linalg.inv(alignment.canonical_transform).astype(np.float64)
    file_mm = alignment.info.unit_scale * moved_points(back, mesh.vertices_mm)
    aligned_mm = moved_points(alignment.transform @ back, mesh.vertices_mm)
    frame = alignment.eigenframe
    turn = alignment.transform[:3, :3] / alignment.info.unit_scale
    arrows = frame.eigenvectors * REACH * np.sqrt(frame.eigenvalues_mm2)[:, None]
    scaled = frame.centroid_mm / alignment.info.unit_scale
    centre = moved_points(alignment.transform, scaled[None])[0]
    before = file_mm, frame.centroid_mm, arrows
    after = aligned_mm, centre, arrows @ turn.T
    oblique = axonometric_view(*EYE_DEG)
    panels = (
        ("Before: the file's axes", oblique, before),
        (f"After: aligned ({alignment.method})", oblique, after),
        ("After, from above", VIEWS["from_above"], after),
        ("After, from the right", VIEWS["from_right"], after),
    )
    with new_figure(10.5, 7.4) as figure:
        for axes, (title, view, state) in zip(figure.subplots(2, 2).flat, panels, strict=True):
            points, origin, ends = (array @ view.T for array in state)
            _draw_panel(axes, (points, mesh.faces), origin, ends)
            _draw_triad(axes, view)
            axes.set_title(title)
        spread = ", ".join(plain(float(value)) for value in np.sqrt(frame.eigenvalues_mm2))
        words = f"{shape_words(alignment)}, {length_text(alignment.length)}"
        write_title(figure, f"{words}; spread along e1, e2, e3: {spread} mm")
    return figure


def _draw_panel(axes: Axes, mesh: tuple[Floats, Ints], origin: Floats, ends: Floats) -> None:
    """One shaded view with the eigenvectors over it; all in view coordinates."""
    projected, faces = mesh
    frame = frame_around(np.concatenate([projected, origin + ends]), margin=0.07)
    show_image(axes, shaded_image(projected, faces, frame, COLUMNS, np.array(SKIN)), frame)
    for (name, colour), end in zip(ARROWS, ends, strict=True):
        _draw_arrow(axes, origin[:2], end[:2], name, colour)
    draw_scale_bar(axes, place=(0.03, 0.01))


def _draw_arrow(axes: Axes, origin: Floats, way: Floats, name: str, colour: str) -> None:
    tip = _pair(origin + way)
    axes.annotate("", tip, _pair(origin), arrowprops=arrow_style(colour, 2.0), zorder=4)
    long = float(np.linalg.norm(way))
    if long > 0:
        style = {"color": colour, "fontweight": "bold", "va": "center", "zorder": 5}
        write_beside(axes, name, tip, _pair(9.0 * way / long), **style)


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def _draw_triad(axes: Axes, view: Floats) -> None:
    """The directions of X, Y and Z in the upper right corner; an axis towards the eye is a dot."""
    corner, size = (0.9, 0.88), 22.0
    for name, way in zip("XYZ", view[:2].T, strict=True):
        if float(np.linalg.norm(way)) >= 0.2:
            style = {"xycoords": "axes fraction", "va": "center", "fontsize": 8}
            arrow = arrow_style(INK, 0.9, "<-", 4)
            write_beside(axes, name, corner, _pair(size * way), arrowprops=arrow, **style)
