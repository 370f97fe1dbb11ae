"""What the pictures draw, in numbers: lines, areas, images, marks and the figures in their words.

``tests/data/drawings.json`` keeps it, and `tests.test_report_drawings` compares. A change that is
meant to change a picture writes it anew, ``python -m tests.drawings``, and looks at the picture.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from footfit.report.pictures.curvature_figure import curvature_figure
from footfit.report.pictures.flare_figure import flare_figure
from footfit.report.pictures.frames_figure import frames_figure
from footfit.report.pictures.heat_figure import heat_figure
from footfit.report.pictures.overlay_figure import drawn_lasts, overlay_figure
from footfit.report.pictures.section_figure import STRIP, section_figure
from tests import answers
from tests.comparisons import comparison
from tests.conftest import ROOT

KEPT = ROOT / "tests" / "data" / "drawings.json"
NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?")
DIGITS = 7
"""Significant digits that are kept."""


def foot(left: bool = False) -> Any:
    """A foot with one channel that could not be measured."""
    known = answers.foot("anna.stl", left=left, turn_deg=13.0 if left else 10.0)
    return replace(known, flare=answers.profile(13.0, ("bottom_80",))) if left else known


def overlay(left: bool) -> Any:
    """A foot with the lasts that were found for it."""
    match = answers.match((foot(left),))
    lasts = {"derby-42": answers.tube(271.5), "oxford-42": answers.tube(275.0, turn_deg=7.0)}
    return overlay_figure(match.feet[0], drawn_lasts(match, match.feet[0], lasts), "lasts")


FIGURES: dict[str, Callable[[], Any]] = {
    "frames": lambda: frames_figure(foot().aligned),
    "frames of a left foot": lambda: frames_figure(foot(left=True).aligned),
    "flare": lambda: flare_figure(foot()),
    "flare of a left foot": lambda: flare_figure(foot(left=True)),
    "curvature": lambda: curvature_figure(answers.curvature()),
    "lasts over a foot": lambda: overlay(left=False),
    "lasts over a left foot": lambda: overlay(left=True),
    "heat": lambda: heat_figure(comparison()),
    "heat of a left foot": lambda: heat_figure(comparison(True, True)),
    "sections": lambda: section_figure(comparison()),
    "sections in a strip": lambda: section_figure(comparison(), STRIP, titled=False),
    "sections of a left foot": lambda: section_figure(comparison(True, True)),
}


def drawing(figure: Any) -> list[Any]:
    """Everything on a figure, axes by axes, as numbers."""
    return [[float(side) for side in figure.get_size_inches()], *map(_axes, figure.axes)]


def _axes(axes: Any) -> dict[str, Any]:
    words = [axes.get_title(), axes.get_xlabel(), axes.get_ylabel()]
    ticks = [label.get_text() for label in (*axes.get_xticklabels(), *axes.get_yticklabels())]
    return {
        "frame": [side for side, spine in axes.spines.items() if spine.get_visible()],
        "limits": [*_rounded(axes.get_xlim()), *_rounded(axes.get_ylim())],
        "words": [NUMBER.findall(text) for text in words],
        "ticks": [NUMBER.findall(text) for text in ticks if text],
        "marks": [*_marks(axes)],
    }


def _marks(axes: Any) -> Iterator[list[Any]]:
    """Lines, areas, patches, images and texts, in the order in which they lie over each other."""
    for line in axes.lines:
        style = [line.get_linewidth(), line.get_zorder(), line.get_alpha()]
        yield ["line", style, *summary(np.asarray(line.get_xydata(), dtype=float))]
    for area in axes.collections:
        paths = [path.vertices for path in area.get_paths()]
        points = np.concatenate(paths) if paths else np.zeros((0, 2))
        yield ["area", len(paths), *summary(points), *summary(area.get_facecolor())]
    for patch in axes.patches:
        yield ["patch", *summary(patch.get_path().vertices), *summary([patch.get_facecolor()])]
    for image in axes.images:
        yield ["image", _rounded(image.get_extent()), *summary(np.asarray(image.get_array()))]
    for text in axes.texts:
        numbers = NUMBER.findall(text.get_text())
        yield ["text", numbers, *_rounded(text.get_position()), float(text.get_rotation())]


def summary(values: Any) -> list[Any]:
    """How many values, and of each column: mean, spread, both ends, and how they are ordered."""
    array = np.asarray(values, dtype=float)
    columns = array.reshape(-1, array.shape[-1]) if array.ndim > 1 else array.reshape(-1, 1)
    parts: list[Any] = [len(columns)]
    for column in columns.T:
        known = column[np.isfinite(column)]
        if len(known):
            order = np.linspace(-1.0, 1.0, len(known))
            figures = [known.mean(), known.std(), known.min(), known.max(), known @ order]
            parts.append([len(known), *_rounded(figures)])
    return parts


def _rounded(values: Any) -> list[float]:
    return [float(f"{float(value):.{DIGITS}g}") for value in values]


def main() -> None:
    """Write the drawings of this tree."""
    lines = [f"{json.dumps(name)}: {json.dumps(drawing(make()))}" for name, make in FIGURES.items()]
    KEPT.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
