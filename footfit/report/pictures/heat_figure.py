"""A foot in its last from four sides, coloured by its clearance; the last is an outline."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.report.pictures import shading
from footfit.report.pictures.drawn_outlines import (
    SHADOW,
    Mesh,
    is_left,
    own_side,
    ring,
    side_outline,
    sole_outline,
)
from footfit.report.pictures.figures import (
    INK,
    draw_scale_bar,
    new_figure,
    picture_bytes,
    show_image,
    write_title,
)
from footfit.report.pictures.heat import (
    NOT_COMPARED,
    SHADE,
    break_words,
    breaks_mm,
    heat_colours,
    scale_colours,
)
from footfit.report.wording.comparison_words import comparison_names

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import Comparison

HEAT_KINDS = ("ply", "svg", "png")
COLUMNS = 560
PANELS = {
    "Sole": "from_below",
    "Top": "from_above",
    "Medial side": "medial",
    "Lateral side": "lateral",
}


def heat_figure(comparison: Comparison, *, titled: bool = True) -> Figure:
    """Four views on the foot's own side; the last is the dashed line around the foot."""
    meshes = own_side(comparison)
    with new_figure(10.5, 4.9 if titled else 4.5) as figure:
        grid = figure.add_gridspec(2, 3, width_ratios=(1.0, 1.0, 0.16))
        for index, (title, view) in enumerate(_views(comparison).items()):
            axes = figure.add_subplot(grid[index // 2, index % 2])
            _draw_panel(axes, meshes, shading.VIEWS[view], comparison)
            axes.set_title(title)
        _draw_legend(figure.add_subplot(grid[:, 2]), comparison)
        if titled:
            foot, last = comparison_names(comparison)
            title = f"{foot} in {last}: the clearance around the {comparison.nouns[0]}"
            if comparison.is_difference:
                title = f"{last} minus {foot}: the difference of the surfaces"
            write_title(figure, title)
    return figure


def heat_bytes(comparison: Comparison, kind: str) -> bytes:
    """That figure as "svg" or "png"; or the coloured foot as "ply", in the last's frame.

    The mesh is on the foot's own side and carries ``room_mm`` at every vertex, NaN where nothing
    is compared.
    """
    from footfit.meshes.write import COLOUR, encoded_mesh

    if kind != "ply":
        return picture_bytes(heat_figure(comparison), kind)
    (vertices, faces), _ = own_side(comparison)
    clearance = comparison.clearance_mm
    shown = heat_colours(clearance, comparison.step_mm, neutral=comparison.is_difference)
    colours = np.rint(255.0 * shown).astype(np.uint8)
    return encoded_mesh(vertices, faces, "ply", {"room_mm": clearance, COLOUR: colours})


def _views(comparison: Comparison) -> dict[str, str]:
    """The panels' titles and views; a left foot's medial side is seen from its right."""
    sides = ("from_right", "from_left")
    medial, lateral = sides if is_left(comparison.foot) else sides[::-1]
    named = {"medial": medial, "lateral": lateral}
    return {title: named.get(view, view) for title, view in PANELS.items()}


def _draw_panel(
    axes: Axes, meshes: tuple[Mesh, Mesh], view: Floats, comparison: Comparison
) -> None:
    (vertices, faces), last = meshes
    outline = _outline(last, view)
    low = vertices[vertices[:, 2] <= last[0][:, 2].max()]  # the leg needs no space in the picture
    frame = shading.frame_around(np.concatenate([outline, (low @ view.T)[:, :2]]))
    colours = partial(heat_colours, step_mm=comparison.step_mm, neutral=comparison.is_difference)
    image = heat_image(vertices @ view.T, faces, comparison.clearance_mm, frame, COLUMNS, colours)
    show_image(axes, image, frame)
    axes.plot(*ring(outline).T, color=INK, linewidth=1.0, linestyle=(0, (5, 2)))
    draw_scale_bar(axes, place=(0.02, 0.0))


def heat_image(
    projected: Floats,
    faces: Ints,
    clearance_mm: Floats,
    frame: shading.Frame,
    columns: int,
    colours: Callable[[Floats], Floats] = heat_colours,
) -> Floats:
    """An RGBA picture (rows, columns, 4), first row on top; each pixel has one of the colours.

    Parameters
    ----------
    projected : (n, 3)
        Vertices in view coordinates: right, up, towards the eye, mm.
    faces : (m, 3)
    clearance_mm : (n,)
    frame : Frame
    columns : int
    colours : callable
        The colours (p, 3) of clearances (p,).
    """
    shape = (shading.rows_for(frame, columns), columns)
    seen = shading.seen_surface(projected, faces, frame, shape, culled=True)
    clearance = np.einsum("pj,pj->p", seen.weights, clearance_mm[seen.corners])
    light = 1.0 - SHADE * (1.0 - np.clip(seen.normals @ shading.light_direction(), 0.0, 1.0))
    picture = np.zeros((*shape, 4))
    picture[seen.covered, :3] = colours(clearance) * light[:, None]
    picture[seen.covered, 3] = 1.0
    return picture[::-1]


def _outline(last: Mesh, view: Floats) -> Floats:
    """The last's outline (n, 2) in a view along Z or Y."""
    from_side = abs(float(view[2, 2])) < 0.5
    points = (side_outline(*last) if from_side else sole_outline(*last, SHADOW)).closed()
    signs = (view[0, 0], 1.0) if from_side else (1.0, view[1, 1])
    return np.asarray(points * signs, dtype=np.float64)


def draw_scale(axes: Axes, step_mm: float, *, neutral: bool) -> int:
    """Draw the colours as boxes, with the mm at their edges; returns how many there are."""
    colours = scale_colours(neutral=neutral)
    for step, colour in enumerate(colours):
        axes.bar(0.5, 1.0, width=1.0, bottom=step, color=colour, edgecolor="white", linewidth=0.6)
    for edge, value in enumerate(breaks_mm(step_mm, neutral=neutral), start=1):
        axes.text(1.15, edge, break_words(value), va="center", fontsize=8)
    return len(colours)


def _draw_legend(axes: Axes, comparison: Comparison) -> None:
    """The colours, what they mean, and that of what is not compared."""
    top = draw_scale(axes, comparison.step_mm, neutral=comparison.is_difference)
    axes.bar(0.5, 0.8, width=1.0, bottom=-1.4, color=NOT_COMPARED, edgecolor="white")
    head, most, least = ("clearance, mm", "loose", "tight")
    if comparison.is_difference:
        head, most, least = ("difference, mm", "second larger", "second smaller")
    axes.text(1.15, -1.0, "not\ncompared", va="center", fontsize=7.5)
    axes.text(0.0, top + 0.25, head, fontsize=8.5, fontweight="bold")
    axes.text(1.15, top - 0.5, most, va="center", fontsize=8)
    axes.text(1.15, 0.5, least, va="center", fontsize=8)
    axes.set_xlim(0.0, 3.6)
    axes.set_ylim(-1.6, top + 1.0)
    axes.set_axis_off()
