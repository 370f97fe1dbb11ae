"""Ratings over the clearance: each zone with its curve and its bands, before and after."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from footfit.errors import BadOption
from footfit.report.pictures.figures import FILL, INK, QUIET, SERIES, new_figure, write_title
from footfit.results.fit import ZONE_LABELS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import Calibration, ZoneEvidence, ZoneRule

RATING_WORDS = {
    -2: "much too tight",
    -1: "too tight",
    0: "right",
    1: "too loose",
    2: "much too loose",
}
COLUMNS = 2
SPREAD = 0.16
"""Ratings of one kind are spread by so much, so that they do not hide each other."""
BAND_HEIGHT = 0.16
BAND_AT = {"before": -2.62, "after": -2.84}


def ratings_figure(calibration: Calibration) -> Figure:
    """A panel for each zone that enough wearers rated.

    Raises
    ------
    BadOption
        No zone was rated often enough to be drawn.
    """
    zones = [zone for zone in calibration.zones if zone.shown is not None]
    if not zones:
        raise BadOption("no zone was rated often enough for a picture; leave out --plot")
    columns = min(COLUMNS, len(zones))
    rows = math.ceil(len(zones) / columns)
    with new_figure(0.5 + 5.5 * columns, 0.6 + 3.2 * rows) as figure:
        panels = list(figure.subplots(rows, columns, squeeze=False).flat)
        for axes, zone in zip(panels, zones, strict=False):
            _draw_zone(axes, zone)
        for axes in panels[len(zones) :]:
            axes.set_visible(False)
        name = calibration.before.name
        write_title(figure, f"What wearers said of shoes of the profile {name}")
    return figure


def _draw_zone(axes: Axes, zone: ZoneEvidence) -> None:
    """The ratings of one zone, the curves, and the ranges under them."""
    shown = zone.shown
    assert shown is not None
    order = np.argsort(shown.clearance_mm, kind="stable")
    spread = SPREAD * np.sin(2.4 * np.arange(len(order)))  # the same on every run
    axes.plot(
        shown.clearance_mm[order],
        shown.rating[order] + spread,
        "o",
        color=QUIET,
        markersize=3.5,
        alpha=0.6,
        label=f"{zone.ratings} ratings of {zone.wearers} wearers",
    )
    places, before, after = shown.curve.T
    axes.plot(places, before, color=INK, linestyle=(0, (6, 2)), label="expected by the profile")
    axes.plot(places, after, color=SERIES[0], label="as the ratings teach")
    _draw_ranges(axes, zone.before, "before", INK)
    _draw_ranges(axes, zone.after, "after", SERIES[0])
    axes.set_yticks(list(RATING_WORDS), list(RATING_WORDS.values()))
    axes.set_ylim(-3.05, 2.5)
    axes.set_xlabel("last minus foot, mm")
    kept = "" if zone.status == "applied" else " (the profile keeps its range)"
    axes.set_title(f"{ZONE_LABELS[zone.zone]}{kept}")
    axes.legend(loc="upper left")


def _draw_ranges(axes: Axes, rule: ZoneRule, when: str, colour: str) -> None:
    """The acceptable and the good range as bars, and the target as a mark."""
    at = BAND_AT[when]
    for ends, face in ((rule.acceptable, FILL), (rule.good, colour)):
        width = ends[1] - ends[0]
        axes.barh(at, width, BAND_HEIGHT, ends[0], color=face, edgecolor=colour, linewidth=0.6)
    axes.plot([rule.target], [at], "|", color="white", markersize=7, markeredgewidth=1.5)
    axes.annotate(
        when,
        (rule.acceptable[1], at),
        xytext=(3, 0),
        textcoords="offset points",
        va="center",
        fontsize=7,
        color=colour,
    )
