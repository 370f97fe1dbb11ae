"""A foot with lasts drawn over it: the sole in plan, the profile from the side, and the flare."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from footfit.number_words import signed
from footfit.report.pictures.drawn_outlines import (
    Mesh,
    is_left,
    on_side,
    ring,
    side_outline,
    sole_outline,
)
from footfit.report.pictures.figures import (
    DASHES,
    FILL,
    INK,
    SERIES,
    draw_scale_bar,
    hide_axes,
    new_figure,
    write_title,
)
from footfit.report.pictures.flare_figure import (
    centre_line_mm,
    label_stations,
    set_up_curves,
    toe_up,
)
from footfit.report.wording.text import angle_text, file_name, visible

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.geometry.flare.definition import FlareProfile
    from footfit.results import LastRecord, Match, Profiled

Shapes = Mapping[str, Mesh]
"""The lasts' meshes by name, each as the catalogue keeps it: canonical mm, its own side."""

SHOWN = 3
"""How many lasts one picture can hold and still be read."""
NAME_LENGTH = 22


@dataclass(frozen=True, slots=True)
class DrawnLast:
    """A last as it is drawn over a foot: without a ``mesh`` its centre line alone.

    ``mesh`` is on the foot's side.
    """

    rank: int
    record: LastRecord
    mesh: Mesh | None


def drawn_lasts(match: Match, foot: Profiled, shapes: Shapes | None) -> list[DrawnLast]:
    """The best lasts of a match, or the nearest where none fits, on the side of one of its feet."""
    side = foot.aligned.alignment.side.side
    return [
        DrawnLast(
            last.rank,
            last.record,
            on_side(shapes[last.last], last.record.side.side, side)
            if shapes and last.last in shapes
            else None,
        )
        for last in (match.candidates or match.nearest)[:SHOWN]
    ]


def overlay_figure(foot: Profiled, lasts: Sequence[DrawnLast], several: str) -> Figure:
    """A foot with lasts drawn over it, heels together; ``several`` is what more than one is called.

    Without any last the foot is drawn alone.
    """
    with new_figure(10.5, 6.4) as figure:
        grid = figure.add_gridspec(3, 2, width_ratios=(0.9, 1.4))
        _draw_plan(figure.add_subplot(grid[:, 0]), foot, lasts)
        _draw_side(figure.add_subplot(grid[0, 1]), foot, lasts)
        heading = figure.add_subplot(grid[1, 1])
        _draw_heading(heading, foot, lasts)
        _draw_plan_curvature(figure.add_subplot(grid[2, 1], sharex=heading), foot.flare, lasts)
        handles, labels = heading.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
        against = visible(lasts[0].record.labels.name) if len(lasts) == 1 else several
        write_title(figure, f"{file_name(foot.aligned.alignment.info.path)} against {against}")
    return figure


def _style(index: int) -> dict[str, Any]:
    return {"color": SERIES[index], "linestyle": DASHES[index], "linewidth": 1.4}


def _label(last: DrawnLast, foot: Profiled) -> str:
    """A last's rank and name, shortened, with its flare against this foot's."""
    name = visible(last.record.labels.name)
    short = name if len(name) <= NAME_LENGTH else f"{name[: NAME_LENGTH - 1]}…"
    delta = last.record.flare.angle_deg - foot.flare.angle_deg
    whose = "this last's" if foot.is_last else "the foot's"
    return f"{last.rank}  {short}, flare {signed(delta)}° from {whose}"


def _draw_plan(axes: Axes, foot: Profiled, lasts: Sequence[DrawnLast]) -> None:
    """Seen from above with the toe up, heels together."""
    mesh, left = foot.aligned, is_left(foot)
    sole = sole_outline(mesh.vertices_mm, mesh.faces).closed()
    axes.fill(*toe_up(sole), facecolor=FILL, edgecolor=INK, linewidth=1.6)
    line = centre_line_mm(foot.flare, mesh.alignment.extent_mm, left=left)
    axes.plot(*toe_up(line), color=INK)
    for index, last in enumerate(lasts):
        if last.mesh is not None:
            axes.plot(*toe_up(ring(sole_outline(*last.mesh).closed())), **_style(index))
    for index, last in enumerate(lasts):
        line = centre_line_mm(last.record.flare, last.record.extent_mm, left=left)
        axes.plot(*toe_up(line), **_style(index))
    drawn = any(last.mesh is not None for last in lasts)
    axes.set_title(
        "Sole and centre line from above"
        if drawn
        else "The sole, and centre lines"
        if foot.is_last
        else "The foot's sole, and centre lines"
    )
    axes.margins(0.08)
    hide_axes(axes)
    draw_scale_bar(axes)


def _draw_side(axes: Axes, foot: Profiled, lasts: Sequence[DrawnLast]) -> None:
    """Seen from the side with the toe on the right, heels together."""
    profile = side_outline(foot.aligned.vertices_mm, foot.aligned.faces).closed()
    axes.fill(*profile.T, facecolor=FILL, edgecolor=INK, linewidth=1.6)
    for index, last in enumerate(lasts):
        if last.mesh is not None:
            axes.plot(*ring(side_outline(*last.mesh).closed()).T, **_style(index))
    axes.set_title("From the side")
    axes.margins(0.03)
    hide_axes(axes)


def _draw_heading(axes: Axes, foot: Profiled, lasts: Sequence[DrawnLast]) -> None:
    flare = foot.flare
    set_up_curves(
        axes, flare.definition, "heading (deg)\n+ to medial", "Heading of the centre line"
    )
    label = f"{'this last' if foot.is_last else 'foot'}, flare {angle_text(flare)}"
    axes.plot(flare.stations, flare.heading_deg, color=INK, linewidth=2.2, label=label)
    for index, last in enumerate(lasts):
        curve = last.record.flare
        axes.plot(curve.stations, curve.heading_deg, label=_label(last, foot), **_style(index))


def _draw_plan_curvature(axes: Axes, flare: FlareProfile, lasts: Sequence[DrawnLast]) -> None:
    quantity, title = (
        "curvature x length\n+ turns inward",
        "Plan curvature: what a search by flare compares",
    )
    set_up_curves(axes, flare.definition, quantity, title)
    label_stations(axes)
    plan = flare.curvature["plan"]
    if plan is not None:
        axes.plot(flare.stations, plan, color=INK, linewidth=2.2)
    for index, last in enumerate(lasts):
        curve = last.record.flare.curvature["plan"]
        if curve is not None:
            axes.plot(last.record.flare.stations, curve, **_style(index))
