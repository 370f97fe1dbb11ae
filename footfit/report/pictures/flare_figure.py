"""The flare as a last maker draws it: the sole in plan, its centre line, and how that bends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.report.pictures.drawn_outlines import SHADOW, Outline, sole_outline
from footfit.report.pictures.figures import (
    DASHES,
    DIVERGING,
    FILL,
    FORE_WINDOW,
    INK,
    PAPER,
    QUIET,
    REAR_WINDOW,
    SERIES,
    bare,
    house_style,
    scale_bar,
)
from footfit.report.wording.text import file_name, length_text, plain, signed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.geometry.flare.definition import FlareDefinition, FlareProfile
    from footfit.results import Alignment, Profiled

Window = tuple[float, float]

BOTTOM_LABELS = {
    "bottom_20": "at 20 % from medial",
    "bottom_50": "at 50 %",
    "bottom_80": "at 80 %",
}
COMPARED = (0.08, 0.80)
"""The stations that profiles are compared on; their curvature fills the scale of colours."""
LEAST_REACH = 0.5
"""The scale of colours is never narrower: a straight sole is not to look bent."""
MARK_REACH = 1.06
"""How far the two mean headings are drawn, over the length."""


def windows(definition: FlareDefinition) -> tuple[Window, Window]:
    """The two windows of stations whose headings the flare angle compares: rear, fore."""
    return definition.rearfoot, definition.forefoot


def mean_heading_deg(flare: FlareProfile, window: Window) -> float:
    """The mean heading over a window of stations."""
    inside = (flare.stations >= window[0]) & (flare.stations <= window[1])
    return float(np.nanmean(flare.heading_deg[inside]))


def flare_figure(profiled: Profiled) -> Figure:
    """The sole in plan with the centre line coloured by its curvature, and the profile's curves.

    Parameters
    ----------
    profiled : Profiled
        One shape with its mesh in the canonical frame, either side.
    """
    from matplotlib.figure import Figure

    with house_style():
        figure = Figure(figsize=(11.0, 7.0), layout="constrained")
        grid = figure.add_gridspec(3, 2, width_ratios=(1.1, 1.4))
        colours = _plan(figure.add_subplot(grid[:, 0]), profiled)
        _colour_bar(figure, figure.axes[0], colours)
        heading = figure.add_subplot(grid[0, 1])
        _heading(heading, profiled.flare)
        _plan_curvature(figure.add_subplot(grid[1, 1], sharex=heading), profiled.flare)
        _bottom(figure.add_subplot(grid[2, 1], sharex=heading), profiled.flare)
        figure.suptitle(_title(profiled), x=0.01, ha="left", fontsize=12, fontweight="bold")
    return figure


def _colour_bar(figure: Figure, axes: Axes, colours: Any) -> None:
    place = axes.inset_axes((0.0, -0.055, 1.0, 0.018))
    bar = figure.colorbar(colours, cax=place, orientation="horizontal", extend="both")
    bar.set_label("plan curvature x length: - turns outward, + turns inward", fontsize=8)
    bar.outline.set_visible(False)


def _title(profiled: Profiled) -> str:
    alignment = profiled.aligned.alignment
    length = length_text(alignment.length)
    return f"{shape_words(alignment)}, {length}, flare {angle_words(profiled.flare)}"


def shape_words(alignment: Alignment) -> str:
    """The file's name, the side, and whether it is a foot or a last."""
    side = alignment.side.side or "side undecided,"
    return f"{file_name(alignment.info.path)}   {side} {alignment.pose.kind}"


def angle_words(flare: FlareProfile) -> str:
    """The flare angle with its uncertainty and class."""
    return f"{signed(flare.angle_deg)}° ± {plain(flare.angle_sd_deg)}° ({flare.flare_class})"


# ---------------------------------------------------------------- the plan


def centre_line_mm(profiled: Profiled) -> Floats:
    """The centre line (n, 2), x and y in the canonical frame of the shape's own side."""
    alignment = profiled.aligned.alignment
    mirror = -1.0 if alignment.side.side == "left" else 1.0
    line: Floats = profiled.flare.centre_line * alignment.extent_mm * np.array([1.0, mirror])
    return line


def _plan(axes: Axes, profiled: Profiled) -> Any:
    """Seen from above with the toe up, so that the wearer's left is on the left."""
    mesh, flare = profiled.aligned, profiled.flare
    sole = sole_outline(mesh.vertices_mm, mesh.faces)
    shadow = sole_outline(mesh.vertices_mm, mesh.faces, band=SHADOW)
    line = centre_line_mm(profiled)
    axes.plot(*_on_page(shadow.closed(), close=True), color=QUIET, linewidth=0.7, linestyle=":")
    axes.fill(*_on_page(sole.closed()), facecolor=FILL, edgecolor=INK, linewidth=1.4)
    for window, colour in zip(windows(flare.definition), (REAR_WINDOW, FORE_WINDOW), strict=True):
        start, end = np.interp(window, flare.stations, line[:, 0])
        part = sole.between(start, end).closed()
        if len(part):
            axes.fill(*_on_page(part), facecolor=colour, edgecolor="none", zorder=1.5)
    _angle_mark(axes, profiled, line)
    coloured = _coloured_line(axes, line, flare)
    _medial_label(axes, profiled, sole)
    axes.set_title("Sole from above")
    axes.margins(0.06)
    bare(axes)
    scale_bar(axes)
    return coloured


def _on_page(points: Floats, *, close: bool = False) -> tuple[Floats, Floats]:
    """Canonical (x, y) as the page's (right, up): toe up, the wearer's left on the left."""
    line = np.concatenate([points, points[:1]]) if close else points
    return -line[:, 1], line[:, 0]


def _coloured_line(axes: Axes, line_mm: Floats, flare: FlareProfile) -> Any:
    from matplotlib.collections import LineCollection

    right, up = _on_page(line_mm)
    points = np.column_stack([right, up])
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    plan = flare.curvature["plan"]
    values = np.zeros(len(pieces)) if plan is None else 0.5 * (plan[:-1] + plan[1:])
    stations = 0.5 * (flare.stations[:-1] + flare.stations[1:])
    compared = np.abs(values[(stations >= COMPARED[0]) & (stations <= COMPARED[1])])
    reach = max(float(np.nanmax(compared, initial=0.0)), LEAST_REACH)
    axes.plot(right, up, color=INK, linewidth=6.0, solid_capstyle="round", zorder=3)
    coloured = LineCollection(list(pieces), cmap=DIVERGING, linewidths=4.0, zorder=4)
    coloured.set_array(np.ma.masked_invalid(values))
    coloured.set_clim(-reach, reach)
    axes.add_collection(coloured)
    return coloured


def _angle_mark(axes: Axes, profiled: Profiled, line_mm: Floats) -> None:
    """The two mean headings as straight lines through their windows, and the angle between."""
    flare, length = profiled.flare, profiled.aligned.alignment.extent_mm
    mirror = -1.0 if profiled.aligned.alignment.side.side == "left" else 1.0
    tips = []
    for window, back in zip(windows(flare.definition), (0.12, 0.32), strict=True):
        slope = mirror * np.tan(np.radians(mean_heading_deg(flare, window)))
        x, y = (np.interp(np.mean(window), flare.stations, line_mm[:, axis]) for axis in (0, 1))
        reach = np.array([x - back * length, MARK_REACH * length])
        ends = np.column_stack([reach, y + slope * (reach - x)])
        axes.plot(*_on_page(ends), color=INK, linewidth=0.9, linestyle=(0, (5, 3)), zorder=5)
        tips.append((-ends[1, 1], ends[1, 0]))
    arrow = {"arrowstyle": "-|>", "color": SERIES[0], "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tips[1], xytext=tips[0], arrowprops=arrow)
    axes.text(
        0.5 * (tips[0][0] + tips[1][0]),
        (MARK_REACH + 0.02) * length,
        f"{signed(flare.angle_deg)}° ± {plain(flare.angle_sd_deg)}°",
        ha="center",
        fontsize=10,
        fontweight="bold",
    )


def _medial_label(axes: Axes, profiled: Profiled, sole: Outline) -> None:
    left = profiled.aligned.alignment.side.side == "left"
    widest = float(np.nanmax(np.abs(np.concatenate([sole.first_mm, sole.second_mm]))))
    height = 0.42 * profiled.aligned.alignment.extent_mm
    for word, side in (("medial", 1 if left else -1), ("lateral", -1 if left else 1)):
        axes.text(
            side * 1.12 * widest,
            height,
            word,
            rotation=90,
            ha="center",
            va="center",
            color=QUIET,
            fontsize=8,
        )


# ---------------------------------------------------------------- the curves


def _station_axis(axes: Axes, flare: FlareProfile, *, last: bool = False) -> None:
    for window, colour in zip(windows(flare.definition), (REAR_WINDOW, FORE_WINDOW), strict=True):
        axes.axvspan(*window, facecolor=colour, edgecolor="none", zorder=0)
    axes.axhline(0.0, color=QUIET, linewidth=0.7, zorder=1)
    axes.set_xlim(0.0, 1.0)
    if last:
        axes.set_xlabel("station along the centre line (0 heel, 1 toe)")
    else:
        axes.tick_params(labelbottom=False)


def _heading(axes: Axes, flare: FlareProfile) -> None:
    _station_axis(axes, flare)
    axes.plot(flare.stations, flare.heading_deg, color=INK, linewidth=1.6)
    for window, word in zip(windows(flare.definition), ("rear", "fore"), strict=True):
        mean = mean_heading_deg(flare, window)
        axes.plot(window, (mean, mean), color=SERIES[0], linewidth=2.0)
        axes.annotate(
            f"{word} {signed(mean)}°",
            (0.5 * sum(window), mean),
            xytext=(0, 4),
            textcoords="offset points",
            ha="center",
            fontsize=8,
            bbox={"facecolor": PAPER, "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
        )
    axes.set_ylabel("heading (deg)\n+ to medial")
    axes.margins(y=0.25)
    axes.set_title("Heading: flare angle = fore minus rear")


def _plan_curvature(axes: Axes, flare: FlareProfile) -> None:
    _station_axis(axes, flare)
    plan = flare.curvature["plan"]
    if plan is None:
        _absent(axes, "the plan curvature is not measurable")
    else:
        axes.plot(flare.stations, plan, color=INK, linewidth=1.6)
        axes.fill_between(
            flare.stations, plan, 0.0, where=plan > 0, color=SERIES[0], alpha=0.25, linewidth=0
        )
        axes.fill_between(
            flare.stations, plan, 0.0, where=plan < 0, color=SERIES[1], alpha=0.25, linewidth=0
        )
    axes.set_ylabel("curvature x length\n+ turns inward")
    axes.set_title("Plan: how the centre line bends")


def _bottom(axes: Axes, flare: FlareProfile) -> None:
    _station_axis(axes, flare, last=True)
    drawn = False
    for index, (channel, label) in enumerate(BOTTOM_LABELS.items()):
        values = flare.curvature.get(channel)
        if values is None:
            continue
        drawn = True
        style = {"color": SERIES[index], "linestyle": DASHES[index], "linewidth": 1.5}
        axes.plot(flare.stations, values, label=label, **style)
    surface = flare.curvature.get("bottom_surface")
    if surface is not None:
        drawn = True
        axes.plot(flare.stations, surface, color=QUIET, linewidth=1.2, label="whole surface")
    if drawn:
        axes.legend(ncols=4, loc="upper left", bbox_to_anchor=(-0.01, -0.32), columnspacing=1.2)
    else:
        _absent(axes, "no sole: the bottom is not measurable")
    axes.set_ylabel("curvature x length\n+ convex")
    axes.set_title("Bottom: how the sole bends along its length")


def _absent(axes: Axes, words: str) -> None:
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", color=QUIET)
    axes.set_yticks([])
