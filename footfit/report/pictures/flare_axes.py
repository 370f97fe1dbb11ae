"""What both pictures of a flare share: the plan with the toe up, and the curves by station."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.report.pictures.figures import FORE_WINDOW, QUIET, REAR_WINDOW

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from footfit.geometry.flare.definition import FlareDefinition, FlareProfile

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
