"""A foot against the best lasts: the sole in plan, the profile from the side, and the flare."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.report.pictures.drawn_outlines import side_outline, sole_outline
from footfit.report.pictures.figures import (
    DASHES,
    FILL,
    FOOT,
    FORE_WINDOW,
    QUIET,
    REAR_WINDOW,
    SERIES,
    bare,
    house_style,
    scale_bar,
)
from footfit.report.pictures.flare_figure import windows
from footfit.report.wording.text import file_name, plain, signed, visible

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import Candidate, Match, Profiled, SideName

Shape = tuple[Floats, Ints]
Shapes = Mapping[str, Shape]
"""The lasts' meshes by name, each as the catalogue keeps it: canonical mm, its own side."""

SHOWN = 3
"""How many lasts one picture can hold and still be read."""
NAME_LENGTH = 22


def match_figure(match: Match, shapes: Shapes | None = None, foot: int = 0) -> Figure:
    """One foot of the match with its best lasts drawn over it, heels together.

    Parameters
    ----------
    match : Match
        Its best lasts are drawn, or the nearest where none fits; without any, the foot alone.
    shapes : mapping of str to (vertices_mm, faces), optional
        The lasts' meshes; a last without one is drawn by its centre line alone.
    foot : int
        Which foot of the pair.
    """
    from matplotlib.figure import Figure

    profiled, lasts = match.feet[foot], (match.candidates or match.nearest)[:SHOWN]
    known = {} if shapes is None else shapes
    with house_style():
        figure = Figure(figsize=(10.5, 6.4), layout="constrained")
        grid = figure.add_gridspec(3, 2, width_ratios=(0.9, 1.4))
        _plan(figure.add_subplot(grid[:, 0]), profiled, lasts, known)
        _side(figure.add_subplot(grid[0, 1]), profiled, lasts, known)
        heading = figure.add_subplot(grid[1, 1])
        _heading(heading, profiled, lasts)
        _plan_curvature(figure.add_subplot(grid[2, 1], sharex=heading), profiled, lasts)
        handles, labels = heading.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
        several = "the best lasts" if match.candidates else "the nearest lasts"
        against = visible(lasts[0].last) if len(lasts) == 1 else several
        title = f"{file_name(profiled.aligned.alignment.info.path)} against {against}"
        figure.suptitle(title, x=0.01, ha="left", fontsize=12, fontweight="bold")
    return figure


def on_side(shape: Shape, own: SideName | None, wanted: SideName | None) -> Shape:
    """A mesh of one side as the other's: mirrored in y, its faces turned over."""
    vertices, faces = shape
    if own == wanted or own is None or wanted is None:
        return shape
    return vertices * np.array([1.0, -1.0, 1.0]), faces[:, ::-1]


def legend_name(candidate: Candidate, foot: Profiled) -> str:
    """A last's rank and name, shortened, with its flare against this foot's."""
    name = visible(candidate.last)
    delta = signed(candidate.record.flare.angle_deg - foot.flare.angle_deg)
    short = name if len(name) <= NAME_LENGTH else f"{name[: NAME_LENGTH - 1]}…"
    return f"{candidate.rank}  {short}, flare {delta}° from the foot's"


def _style(index: int) -> dict[str, Any]:
    return {"color": SERIES[index], "linestyle": DASHES[index], "linewidth": 1.4}


def _meshes(
    profiled: Profiled, lasts: tuple[Candidate, ...], shapes: Shapes
) -> list[tuple[int, Shape]]:
    """The lasts' meshes on the foot's side, with their place in the legend."""
    side = profiled.aligned.alignment.side.side
    return [
        (index, on_side(shapes[last.last], last.record.side.side, side))
        for index, last in enumerate(lasts)
        if last.last in shapes
    ]


def _plan(axes: Axes, profiled: Profiled, lasts: tuple[Candidate, ...], shapes: Shapes) -> None:
    """Seen from above with the toe up, heels together."""
    foot = profiled.aligned
    mirror = -1.0 if foot.alignment.side.side == "left" else 1.0
    sole = sole_outline(foot.vertices_mm, foot.faces).closed()
    axes.fill(-sole[:, 1], sole[:, 0], facecolor=FILL, edgecolor=FOOT, linewidth=1.6)
    _centre(axes, profiled.flare.centre_line * foot.alignment.extent_mm, mirror, color=FOOT)
    for index, (vertices, faces) in _meshes(profiled, lasts, shapes):
        outline = sole_outline(vertices, faces).closed()
        outline = np.concatenate([outline, outline[:1]])
        axes.plot(-outline[:, 1], outline[:, 0], **_style(index))
    for index, last in enumerate(lasts):
        line = last.record.flare.centre_line * last.record.extent_mm
        _centre(axes, line, mirror, **_style(index))
    axes.set_title(
        "Sole and centre line from above" if shapes else "The foot's sole, and centre lines"
    )
    axes.margins(0.08)
    bare(axes)
    scale_bar(axes)


def _centre(axes: Axes, line_mm: Floats, mirror: float, **style: Any) -> None:
    axes.plot(-mirror * line_mm[:, 1], line_mm[:, 0], **style)


def _side(axes: Axes, profiled: Profiled, lasts: tuple[Candidate, ...], shapes: Shapes) -> None:
    """Seen from the side with the toe on the right, heels together."""
    foot = profiled.aligned
    profile = side_outline(foot.vertices_mm, foot.faces).closed()
    axes.fill(profile[:, 0], profile[:, 1], facecolor=FILL, edgecolor=FOOT, linewidth=1.6)
    for index, (vertices, faces) in _meshes(profiled, lasts, shapes):
        outline = side_outline(vertices, faces).closed()
        outline = np.concatenate([outline, outline[:1]])
        axes.plot(outline[:, 0], outline[:, 1], **_style(index))
    axes.set_title("From the side")
    axes.margins(0.03)
    bare(axes)


def _stations(axes: Axes, profiled: Profiled) -> None:
    rear, fore = windows(profiled.flare.definition)
    axes.axvspan(*rear, facecolor=REAR_WINDOW, edgecolor="none", zorder=0)
    axes.axvspan(*fore, facecolor=FORE_WINDOW, edgecolor="none", zorder=0)
    axes.axhline(0.0, color=QUIET, linewidth=0.7, zorder=1)
    axes.set_xlim(0.0, 1.0)


def _heading(axes: Axes, profiled: Profiled, lasts: tuple[Candidate, ...]) -> None:
    flare = profiled.flare
    _stations(axes, profiled)
    angle = f"foot, flare {signed(flare.angle_deg)}° ± {plain(flare.angle_sd_deg)}°"
    axes.plot(flare.stations, flare.heading_deg, color=FOOT, linewidth=2.2, label=angle)
    for index, last in enumerate(lasts):
        curve = last.record.flare
        label = legend_name(last, profiled)
        axes.plot(curve.stations, curve.heading_deg, label=label, **_style(index))
    axes.tick_params(labelbottom=False)
    axes.set_ylabel("heading (deg)\n+ to medial")
    axes.set_title("Heading of the centre line")


def _plan_curvature(axes: Axes, profiled: Profiled, lasts: tuple[Candidate, ...]) -> None:
    _stations(axes, profiled)
    plan = profiled.flare.curvature["plan"]
    if plan is not None:
        axes.plot(profiled.flare.stations, plan, color=FOOT, linewidth=2.2)
    for index, last in enumerate(lasts):
        curve = last.record.flare.curvature["plan"]
        if curve is not None:
            axes.plot(last.record.flare.stations, curve, **_style(index))
    axes.set_ylabel("curvature x length\n+ turns inward")
    axes.set_xlabel("station along the centre line (0 heel, 1 toe)")
    axes.set_title("Plan curvature: what a search by flare compares")
