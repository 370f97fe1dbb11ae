"""The coverage of a population as plots: feet and lasts, lasts and shares, flare, measures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from footfit.number_words import plain
from footfit.report.pictures.figures import FILL, INK, QUIET, SERIES, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.population.coverage_answer import Coverage

MOST_POINTS = 3000
"""A scatter of more feet shows so many of them, evenly taken in the order of their lengths."""
MOST_NAMED = 12
"""So many boxes have the names of their lasts."""
STATUSES = {  # label, colour, marker: the shape says what the colour says
    "good": ("good last", SERIES[2], "o"),
    "acceptable": ("acceptable last", SERIES[4], "s"),
    "poor": ("poor last at best", SERIES[0], "^"),
    "no_last_fits": ("no last fits", SERIES[1], "x"),
    "not_judged": ("not judged", QUIET, "."),
}
COLUMNS = 3


def scatter_figure(answer: Coverage) -> Figure:
    """Length over ball girth: each foot by its verdict, and the box of each last."""
    with new_figure(9.0, 5.6) as figure:
        axes = figure.subplots()
        length = answer.feet.values["length"]
        girth = answer.feet.values.get("ball_girth", np.full(len(length), np.nan))
        _draw_boxes(axes, answer)
        shown = _some(length, girth)
        status = np.array(answer.feet.status)
        for name, (label, colour, marker) in STATUSES.items():
            rows = shown[status[shown] == name]
            if len(rows):
                count = int((status == name).sum())
                axes.plot(
                    length[rows], girth[rows], marker, color=colour, markersize=3.2, alpha=0.65,
                    markeredgewidth=0.7, linestyle="", label=f"{label} ({count:,} feet)",
                )  # fmt: skip
        axes.set_xlabel("length of the foot, mm")
        axes.set_ylabel("ball girth of the foot, mm")
        _fit_limits(axes, length[shown], girth[shown])
        figure.legend(loc="outside lower center", ncols=3, markerscale=1.8)
    return figure


def _draw_boxes(axes: Axes, answer: Coverage) -> None:
    """The feet that each last is acceptable for in length and ball girth, as a box."""
    from matplotlib.patches import Rectangle

    boxes = [b for b in answer.boxes if np.isfinite([*b.length_mm, *b.ball_girth_mm]).all()]
    alpha = 0.9 if len(boxes) <= 60 else 0.35
    for number, box in enumerate(boxes):
        corner = box.length_mm[0], box.ball_girth_mm[0]
        size = np.subtract((box.length_mm[1], box.ball_girth_mm[1]), corner)
        label = f"box of a last ({len(boxes):,} lasts)" if number == 0 else None
        axes.add_patch(
            Rectangle(corner, *size, fill=False, edgecolor=INK, linewidth=0.7, alpha=alpha,
                      label=label)
        )  # fmt: skip
        if len(boxes) <= MOST_NAMED:
            axes.annotate(
                box.last, (corner[0], corner[1] + size[1]), (2, -2), textcoords="offset points",
                va="top", fontsize=6.5, color=INK,
            )  # fmt: skip


def _some(length: Floats, girth: Floats) -> Ints:
    """The rows of the feet that are drawn."""
    known: Ints = np.flatnonzero(np.isfinite(length) & np.isfinite(girth))
    if len(known) <= MOST_POINTS:
        return known
    order: Ints = known[np.lexsort((girth[known], length[known]))]
    some: Ints = order[np.linspace(0, len(order) - 1, MOST_POINTS).astype(np.int64)]
    return some


def _fit_limits(axes: Axes, length: Floats, girth: Floats) -> None:
    """Show the feet, whatever the boxes reach over."""
    if not len(length):
        return
    for values, limit in ((length, axes.set_xlim), (girth, axes.set_ylim)):
        low, high = float(values.min()), float(values.max())
        more = max(5.0, 0.06 * (high - low))
        limit(low - more, high + more)


def cover_figure(answer: Coverage) -> Figure:
    """The share of feet with an acceptable last over the number of lasts, then the planned ones."""
    with new_figure(9.0, 3.6) as figure:
        axes = figure.subplots()
        shares = [0.0, *(100.0 * step.covered for step in answer.cover)]
        axes.step(
            range(len(shares)), shares, where="post", color=SERIES[1],
            label="the lasts of the catalogue, those first that serve most feet more",
        )  # fmt: skip
        last = len(shares) - 1
        planned = [100.0 * (each.covered.value or 0.0) for each in answer.next_lasts]
        if planned:
            places = range(last, last + len(planned) + 1)
            axes.step(
                places, [shares[-1], *planned], where="post", color=SERIES[0],
                linestyle=(0, (6, 2)), label="lasts to make next",
            )  # fmt: skip
            most = [100.0 * each.covered_at_most for each in answer.next_lasts]
            axes.plot(
                places[1:], most, ".", color=QUIET, markersize=4,
                label="what no choice of as many planned lasts passes",
            )  # fmt: skip
        axes.set_ylim(0.0, 103.0)
        axes.set_xlim(0, max(1, last + len(planned)))
        axes.set_xlabel("number of lasts")
        axes.set_ylabel("feet with an acceptable last, %")
        axes.locator_params(axis="x", integer=True)
        figure.legend(loc="outside lower center", ncols=2)
    return figure


def flare_figure_of(answer: Coverage) -> Figure | None:
    """The flare angles of the feet against those of the lasts; None if no foot's is known."""
    feet = answer.feet.flare_deg[np.isfinite(answer.feet.flare_deg)]
    lasts = np.array([box.flare_deg for box in answer.boxes if box.flare_deg is not None])
    if not len(feet):
        return None
    both = np.concatenate([feet, lasts])
    edges = np.arange(math.floor(both.min() / 2.0) * 2.0, both.max() + 2.0, 2.0).tolist()
    with new_figure(9.0, 3.4) as figure:
        axes = figure.subplots()
        axes.hist(
            feet, edges, weights=np.full(len(feet), 100.0 / len(feet)), color=FILL,
            edgecolor=INK, linewidth=0.6, label=f"{len(feet):,} feet",
        )  # fmt: skip
        if len(lasts):
            axes.hist(
                lasts, edges, weights=np.full(len(lasts), 100.0 / len(lasts)), histtype="step",
                color=SERIES[0], linewidth=1.8, label=f"{len(lasts):,} lasts",
            )  # fmt: skip
        axes.set_xlabel("flare angle, degrees (+ is inward)")
        axes.set_ylabel("share, %")
        figure.legend(loc="outside lower center", ncols=2)
    return figure


def measures_figure(answer: Coverage) -> Figure | None:
    """A histogram of each measure of the feet; None without feet."""
    values = {d.measure: answer.feet.values.get(d.measure) for d in answer.distributions}
    known = {name: each[np.isfinite(each)] for name, each in values.items() if each is not None}
    if not known:
        return None
    columns = min(COLUMNS, len(known))
    rows = math.ceil(len(known) / columns)
    with new_figure(3.0 * columns, 1.9 * rows) as figure:
        panels = list(figure.subplots(rows, columns, squeeze=False).flat)
        for axes, (name, each) in zip(panels, known.items(), strict=False):
            axes.hist(
                each, min(24, max(5, len(each) // 4)), color=FILL, edgecolor=INK, linewidth=0.5
            )
            axes.axvline(each.mean(), color=SERIES[0], linewidth=1.2)
            axes.set_title(f"{name.replace('_', ' ')}: {plain(float(each.mean()))} mm")
            axes.set_yticks([])
            axes.spines["left"].set_visible(False)
        for axes in panels[len(known) :]:
            axes.set_visible(False)
    return figure
