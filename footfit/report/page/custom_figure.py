"""A custom last from four sides, coloured by how far its surface moved from its base."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from footfit.report.pictures import shading
from footfit.report.pictures.figures import INK, draw_scale_bar, new_figure, show_image, write_title
from footfit.report.pictures.heat import heat_colours
from footfit.report.pictures.heat_figure import COLUMNS, PANELS, draw_scale, heat_image

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import CustomLast

STEPS_MM = (0.25, 0.5, 1.0, 2.0)
"""So many mm is a colour wide: the least with which the largest move is within the scale."""


def custom_figure(custom: CustomLast, *, titled: bool = True) -> Figure:
    """Four views; red moved inward, blue outward, and cream hardly moved."""
    sides = ("from_right", "from_left")
    medial, lateral = sides if custom.side == "left" else sides[::-1]
    named = {"medial": medial, "lateral": lateral}
    most_mm = float(abs(custom.moved_mm).max())
    step_mm = next((step for step in STEPS_MM if 4.0 * step >= most_mm), STEPS_MM[-1])
    with new_figure(10.5, 4.9 if titled else 4.5) as figure:
        grid = figure.add_gridspec(2, 3, width_ratios=(1.0, 1.0, 0.16))
        for index, (title, view) in enumerate(PANELS.items()):
            axes = figure.add_subplot(grid[index // 2, index % 2])
            _draw_panel(axes, custom, named.get(view, view), step_mm)
            axes.set_title(title)
        _draw_legend(figure.add_subplot(grid[:, 2]), step_mm)
        if titled:
            name = custom.record.labels.name
            write_title(figure, f"{name}: how far the surface moved from {custom.base}")
    return figure


def _draw_panel(axes: Axes, custom: CustomLast, view_name: str, step_mm: float) -> None:
    view = shading.VIEWS[view_name]
    projected = custom.vertices_mm @ view.T
    frame = shading.frame_around(projected[:, :2])
    colours = partial(heat_colours, step_mm=step_mm, neutral=True)
    image = heat_image(projected, custom.faces, custom.moved_mm, frame, COLUMNS, colours)
    show_image(axes, image, frame)
    draw_scale_bar(axes, place=(0.02, 0.0))


def _draw_legend(axes: Axes, step_mm: float) -> None:
    """The colours as boxes, with the mm at their edges."""
    top = draw_scale(axes, step_mm, neutral=True)
    axes.text(0.0, top + 0.25, "moved, mm", fontsize=8.5, fontweight="bold", color=INK)
    axes.text(1.15, top - 0.5, "outward", va="center", fontsize=8)
    axes.text(1.15, 0.5, "inward", va="center", fontsize=8)
    axes.set_xlim(0.0, 3.6)
    axes.set_ylim(-0.2, top + 1.0)
    axes.set_axis_off()
