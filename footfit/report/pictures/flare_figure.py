"""The flare as a last maker draws it: the sole in plan, its centre line, and how that bends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.flare.definition import CHANNELS
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.geometry.numeric.arrays import Floats
from footfit.number_words import signed
from footfit.report.pictures.drawn_outlines import SHADOW, Outline, is_left, ring, sole_outline
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
    arrow_style,
    draw_scale_bar,
    hide_axes,
    new_figure,
    write_beside,
    write_title,
)
from footfit.report.wording.text import angle_text, class_words, length_text, shape_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.geometry.flare.definition import FlareDefinition, FlareProfile
    from footfit.results import Profiled

Window = tuple[float, float]


def windows(definition: FlareDefinition) -> dict[str, Window]:
    """The two windows of stations whose headings the flare angle compares, each with its colour."""
    return {REAR_WINDOW: definition.rearfoot, FORE_WINDOW: definition.forefoot}


def centre_line_mm(flare: FlareProfile, extent_mm: float, *, left: bool) -> Floats:
    """The centre line (n, 2), x and y in the canonical frame of a left or a right shape."""
    line: Floats = flare.centre_line * extent_mm * np.array([1.0, -1.0 if left else 1.0])
    return line


def toe_up(points: Floats) -> tuple[Floats, Floats]:
    """Canonical x and y (n, 2) as a picture's right and up: the wearer's left is on the left."""
    return -points[:, 1], points[:, 0]


def set_up_curves(axes: Axes, definition: FlareDefinition, quantity: str, title: str) -> None:
    """Set up an axes for curves by station, with the two windows behind them."""
    for colour, window in windows(definition).items():
        axes.axvspan(*window, facecolor=colour, edgecolor="none", zorder=0)
    axes.axhline(0.0, color=QUIET, linewidth=0.7, zorder=1)
    axes.set_xlim(0.0, 1.0)
    axes.tick_params(labelbottom=False)
    axes.set_ylabel(quantity)
    axes.set_title(title)


def label_stations(axes: Axes) -> None:
    """Name the stations, below the lowest axes of a column."""
    axes.tick_params(labelbottom=True)
    axes.set_xlabel("station along the centre line (0 heel, 1 toe)")


LEAST_REACH = 0.5
"""The scale of colours is never narrower: a straight sole is not to look bent."""
MARK_REACH = 1.06
"""How far the two mean headings are drawn, over the length."""


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
    with new_figure(11.0, 7.0) as figure:
        grid = figure.add_gridspec(3, 2, width_ratios=(1.1, 1.4))
        colours = _draw_plan(figure.add_subplot(grid[:, 0]), profiled)
        place = figure.axes[0].inset_axes((0.0, -0.055, 1.0, 0.018))
        bar = figure.colorbar(colours, cax=place, orientation="horizontal", extend="both")
        bar.set_label("plan curvature x length: - turns outward, + turns inward", fontsize=8)
        bar.outline.set_visible(False)
        heading = figure.add_subplot(grid[0, 1])
        _draw_heading(heading, profiled.flare)
        _draw_plan_curvature(figure.add_subplot(grid[1, 1], sharex=heading), profiled.flare)
        _draw_bottom(figure.add_subplot(grid[2, 1], sharex=heading), profiled.flare)
        alignment = profiled.aligned.alignment
        words = f"{shape_words(alignment)}, {length_text(alignment.length)}"
        flare = f"flare {angle_text(profiled.flare)}{class_words(profiled.flare)}"
        write_title(figure, f"{words}, {flare}")
    return figure


# ---------------------------------------------------------------- the plan


def _draw_plan(axes: Axes, profiled: Profiled) -> Any:
    """Seen from above with the toe up, so that the wearer's left is on the left."""
    mesh, flare = profiled.aligned, profiled.flare
    sole = sole_outline(mesh.vertices_mm, mesh.faces)
    shadow = sole_outline(mesh.vertices_mm, mesh.faces, band=SHADOW)
    line = centre_line_mm(flare, mesh.alignment.extent_mm, left=is_left(profiled))
    axes.plot(*toe_up(ring(shadow.closed())), color=QUIET, linewidth=0.7, linestyle=":")
    axes.fill(*toe_up(sole.closed()), facecolor=FILL, edgecolor=INK, linewidth=1.4)
    for colour, window in windows(flare.definition).items():
        start, end = np.interp(window, flare.stations, line[:, 0])
        part = sole.between(start, end).closed()
        if len(part):
            axes.fill(*toe_up(part), facecolor=colour, edgecolor="none", zorder=1.5)
    _draw_angle_mark(axes, profiled, line)
    coloured = _draw_coloured_line(axes, line, flare)
    _write_sides(axes, profiled, sole)
    axes.set_title("Sole from above")
    axes.margins(0.06)
    hide_axes(axes)
    draw_scale_bar(axes)
    return coloured


def _draw_coloured_line(axes: Axes, line_mm: Floats, flare: FlareProfile) -> Any:
    from matplotlib.collections import LineCollection

    right, up = toe_up(line_mm)
    points = np.column_stack([right, up])
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    plan = flare.curvature["plan"]
    values = np.zeros(len(pieces)) if plan is None else 0.5 * (plan[:-1] + plan[1:])
    stations = 0.5 * (flare.stations[:-1] + flare.stations[1:])
    compared = DISTANCE.stations
    shown = np.abs(values[(stations >= compared[0]) & (stations <= compared[1])])
    reach = max(float(np.nanmax(shown, initial=0.0)), LEAST_REACH)
    axes.plot(right, up, color=INK, linewidth=6.0, solid_capstyle="round", zorder=3)
    coloured = LineCollection(list(pieces), cmap=DIVERGING, linewidths=4.0, zorder=4)
    coloured.set_array(np.ma.masked_invalid(values))
    coloured.set_clim(-reach, reach)
    axes.add_collection(coloured)
    return coloured


def _draw_angle_mark(axes: Axes, profiled: Profiled, line_mm: Floats) -> None:
    """The two mean headings as straight lines through their windows, and the angle between."""
    flare, length = profiled.flare, profiled.aligned.alignment.extent_mm
    mirror = -1.0 if is_left(profiled) else 1.0
    tips = []
    for window, back in zip(windows(flare.definition).values(), (0.12, 0.32), strict=True):
        slope = mirror * np.tan(np.radians(mean_heading_deg(flare, window)))
        x, y = (np.interp(np.mean(window), flare.stations, line_mm[:, axis]) for axis in (0, 1))
        reach = np.array([x - back * length, MARK_REACH * length])
        ends = np.column_stack([reach, y + slope * (reach - x)])
        axes.plot(*toe_up(ends), color=INK, linewidth=0.9, linestyle=(0, (5, 3)), zorder=5)
        tips.append((-ends[1, 1], ends[1, 0]))
    axes.annotate("", tips[1], xytext=tips[0], arrowprops=arrow_style(SERIES[0], 1.4))
    axes.text(
        0.5 * (tips[0][0] + tips[1][0]),
        (MARK_REACH + 0.02) * length,
        angle_text(flare),
        ha="center",
        fontsize=10,
        fontweight="bold",
    )


def _write_sides(axes: Axes, profiled: Profiled, sole: Outline) -> None:
    medial = 1 if is_left(profiled) else -1
    widest = float(np.nanmax(np.abs(np.concatenate([sole.first_mm, sole.second_mm]))))
    height = 0.42 * profiled.aligned.alignment.extent_mm
    for word, side in (("medial", medial), ("lateral", -medial)):
        text = axes.text(side * 1.12 * widest, height, word, ha="center", va="center")
        text.set(rotation=90, color=QUIET, fontsize=8)


# ---------------------------------------------------------------- the curves


def _draw_heading(axes: Axes, flare: FlareProfile) -> None:
    title = "Heading: flare angle = fore minus rear"
    set_up_curves(axes, flare.definition, "heading (deg)\n+ to medial", title)
    axes.plot(flare.stations, flare.heading_deg, color=INK, linewidth=1.6)
    for window, word in zip(windows(flare.definition).values(), ("rear", "fore"), strict=True):
        mean = mean_heading_deg(flare, window)
        axes.plot(window, (mean, mean), color=SERIES[0], linewidth=2.0)
        box = {"facecolor": PAPER, "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
        place = (0.5 * sum(window), mean)
        write_beside(axes, f"{word} {signed(mean)}°", place, (0, 4), fontsize=8, bbox=box)
    axes.margins(y=0.25)


def _draw_plan_curvature(axes: Axes, flare: FlareProfile) -> None:
    quantity, title = "curvature x length\n+ turns inward", "Plan: how the centre line bends"
    set_up_curves(axes, flare.definition, quantity, title)
    plan = flare.curvature["plan"]
    if plan is None:
        _write_absent(axes, "the plan curvature is not measurable")
        return
    axes.plot(flare.stations, plan, color=INK, linewidth=1.6)
    for turns, colour in ((plan > 0, SERIES[0]), (plan < 0, SERIES[1])):
        axes.fill_between(
            flare.stations, plan, 0.0, where=turns, color=colour, alpha=0.25, linewidth=0
        )


def _draw_bottom(axes: Axes, flare: FlareProfile) -> None:
    quantity, title = "curvature x length\n+ convex", "Bottom: how the sole bends along its length"
    set_up_curves(axes, flare.definition, quantity, title)
    label_stations(axes)
    shares = [f"at {100 * share:.0f} %" for share in flare.definition.bottom_places]
    labels = (f"{shares[0]} from medial", *shares[1:], "whole surface")
    styles = [*zip(SERIES, DASHES, (1.5, 1.5, 1.5), strict=False), (QUIET, "-", 1.2)]
    for channel, label, (colour, dash, width) in zip(CHANNELS[1:], labels, styles, strict=True):
        values = flare.curvature.get(channel)
        if values is not None:
            style = {"color": colour, "linestyle": dash, "linewidth": width}
            axes.plot(flare.stations, values, label=label, **style)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(ncols=4, loc="upper left", bbox_to_anchor=(-0.01, -0.32), columnspacing=1.2)
    else:
        _write_absent(axes, "no sole: the bottom is not measurable")


def _write_absent(axes: Axes, words: str) -> None:
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", color=QUIET)
    axes.set_yticks([])
