"""The sections of a foot over those of its last, by station, with the differences in mm."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.number_words import plain, signed
from footfit.report.pictures.drawn_outlines import is_left, ring
from footfit.report.pictures.figures import (
    FILL,
    INK,
    QUIET,
    SERIES,
    draw_scale_bar,
    hide_axes,
    new_figure,
    write_title,
)
from footfit.report.wording.comparison_words import comparison_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import Comparison, SectionComparison

ACROSS = 3
STRIP = 6
"""Panels side by side if all are in one strip, with fewer words for each."""
SHOWN_OVER_MM = 6.0
"""How far above the last a leg is drawn."""
HALF_WIDTH_MM, UNDER_MM, WIDTH_INCHES = 66.0, 6.0, 10.5
"""How much a panel shows, and how wide the picture is."""


def section_figure(comparison: Comparison, across: int = ACROSS, *, titled: bool = True) -> Figure:
    """A panel for each station, seen from behind, all at one scale; foot filled, last a line."""
    mirror = 1.0 if is_left(comparison.foot) else -1.0
    sections, brief = comparison.sections, across > ACROSS
    rows = [sections[at : at + across] for at in range(0, len(sections), across)]
    tall = [max(_top(section) for section in row) + UNDER_MM for row in rows]
    inches = WIDTH_INCHES / across / (2.0 * HALF_WIDTH_MM)
    height = (0.7 if titled else 0.4) + sum(
        (0.9 if brief else 0.6) + inches * high for high in tall
    )
    with new_figure(WIDTH_INCHES, height) as figure:
        grid = figure.add_gridspec(len(rows), across, height_ratios=tall)
        for at, row in enumerate(rows):
            for column, section in enumerate(row):
                axes = figure.add_subplot(grid[at, column])
                _draw_panel(axes, section, mirror, comparison, brief=brief)
                axes.set_xlim(-HALF_WIDTH_MM, HALF_WIDTH_MM)
                axes.set_ylim(-UNDER_MM, tall[at] - UNDER_MM)
        draw_scale_bar(figure.axes[0], length_mm=20.0, place=(0.0, -0.02))
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
        if titled:
            foot, last = comparison_names(comparison)
            joint = "and" if comparison.is_difference else "in"
            write_title(figure, f"{foot} {joint} {last}: sections from behind")
    return figure


def _draw_panel(
    axes: Axes, section: SectionComparison, mirror: float, comparison: Comparison, *, brief: bool
) -> None:
    top, nouns = _top(section), comparison.nouns
    for index, loop in enumerate(section.foot_outline):
        across, up = (ring(loop) * [mirror, 1.0]).T
        label = nouns[0] if index == 0 else None
        axes.fill(
            across, np.minimum(up, top), facecolor=FILL, edgecolor=INK, linewidth=1.5, label=label
        )
    for index, loop in enumerate(section.last_outline):
        label = nouns[1] if index == 0 else None
        axes.plot(*(ring(loop) * [mirror, 1.0]).T, color=SERIES[0], linewidth=1.5, label=label)
    where = f"{plain(section.x_mm, 0)} mm" + ("" if brief else " from the heel")
    axes.set_title(f"{section.station.capitalize()}, {where}")
    axes.axhline(0.0, color=QUIET, linewidth=0.5, zorder=0)
    hide_axes(axes)
    axes.set_xlabel(_words(section, comparison, brief=brief), fontsize=8)


def _top(section: SectionComparison) -> float:
    """The height up to which a foot is drawn."""
    loops = section.last_outline or section.foot_outline
    return max((float(loop[:, 1].max()) for loop in loops), default=0.0) + SHOWN_OVER_MM


def _words(section: SectionComparison, comparison: Comparison, *, brief: bool) -> str:
    """The differences that are known: "last minus foot: width +3.2, height +4.4 mm"."""
    known = [
        f"{size.name} {signed(size.difference.value)}"
        for size in section.sizes
        if size.difference.value is not None and size.name not in ("medial", "lateral")
    ]
    if not known:
        return "not measurable here"
    first, second = ("first", "second") if comparison.is_difference else comparison.nouns
    return "\n".join(known) if brief else f"{second} minus {first}: {', '.join(known)} mm"
