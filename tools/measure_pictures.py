"""Pictures of the lengths, the widths, the heights, and the girths in fixed planes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.geometry.measures.heel_girths import HEEL, angle_to_deg, around_heel, heel_axes
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.measures.landmarks import AXES, LANDMARKS, Shape
from footfit.geometry.measures.lengths import FOREPART
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.measures.underside import BOTTOM, underside
from footfit.geometry.measures.widths import WIDTHS
from footfit.geometry.mesh.outlines import TAPE_OUTLINES
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.hulls import convex_hull
from footfit.report.pictures.drawn_outlines import SHADOW, ring, side_outline, sole_outline
from footfit.report.pictures.figures import (
    DASHES,
    FILL,
    INK,
    QUIET,
    SERIES,
    draw_scale_bar,
    hide_axes,
    new_figure,
    png_bytes,
)
from tests.reading import read_scan
from tests.scans import aligned
from tools.last_specs import LastSpec
from tools.lasts import last_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FOOT = Path(__file__).resolve().parents[1] / "sample_data" / "feet" / "mh007_R.stl"
SPEC = LastSpec(heel_height_mm=25.0, toe_spring_mm=12.0, arch_mm=9.0, level_tread=True)


def measure_pictures() -> dict[str, bytes]:
    """Every picture by its file's name."""
    last = Shape(*last_mesh(SPEC), "last")
    return {
        "lengths_and_widths.png": _from_above(aligned(read_scan(FOOT)).prepared.shape),
        "heights.png": _heights(last),
        "girths.png": _girths(last),
        "bottom_widths.png": _bottom_widths(last),
    }


def _from_above(foot: Shape) -> bytes:
    """The lengths and widths of a foot in plan."""
    medial, lateral = (foot.outermost(side, WIDTHS.forefoot) for side in (1.0, -1.0))
    assert foot.mt1 is not None
    assert foot.mt5 is not None
    assert medial is not None
    assert lateral is not None
    mt1, mt5, start = foot.mt1[:2], foot.mt5[:2], foot.pternion[:2]
    sole = sole_outline(foot.vertices_mm, foot.faces, WIDTHS.height)
    fore = sole.between(foot.x_mm(FOREPART), np.inf).closed()
    toe = fore[np.argmax(np.square(fore - start).sum(axis=1))]
    end_mm, heel_mm, low_mm = foot.x_mm(1.0), foot.x_mm(WIDTHS.heel), float(lateral[1])
    heel = [(heel_mm, np.interp(heel_mm, sole.x_mm, y)) for y in (sole.first_mm, sole.second_mm)]
    with new_figure(8.0, 4.4) as figure:
        axes = figure.subplots()
        axes.fill(*sole.closed().T, facecolor=FILL, edgecolor=QUIET, linewidth=0.8)
        for place, name, offset in (
            (start, "pternion", (-32, 0)),
            (mt1, "MT1", (-4, 9)),
            (mt5, "MT5", (4, -9)),
        ):
            axes.plot(*place, "o", color=INK, markersize=4)
            _write(axes, name, place, offset)
        _dimension(axes, foot, "functional_length", (start, toe), SERIES[2], (0.45, 0, 10))
        _dimension(axes, foot, "ball_width", (mt5, mt1), SERIES[0], (0.36, -48, 0))
        _dimension(axes, foot, "heel_width", heel, SERIES[0], (0.2, 48, 0))
        for name, forward, y_mm, down_from in (
            ("length", end_mm, low_mm - 38.0, toe[1]),
            ("ball_length", mt1[0], low_mm - 20.0, mt1[1]),
        ):
            for x_mm, top_mm in ((start[0], start[1]), (forward, down_from)):
                axes.plot([x_mm, x_mm], [y_mm, top_mm], ":", color=QUIET, linewidth=0.9)
            _dimension(axes, foot, name, ((start[0], y_mm), (forward, y_mm)), INK, (0.4, 0, 7))
        for place in (medial, lateral):
            axes.plot([place[0], end_mm + 14], [place[1]] * 2, ":", color=QUIET, linewidth=0.9)
        across = (end_mm + 14.0, low_mm), (end_mm + 14.0, medial[1])
        _dimension(axes, foot, "ball_width_orthogonal", across, SERIES[1], (0.5, 36, 0), lines=True)
        hide_axes(axes)
        return png_bytes(figure)


def _heights(last: Shape) -> bytes:
    """The heights of a last that rests on its sole plane, and the tape along its bottom."""
    arch = underside(last, BOTTOM.arch, BOTTOM.arch_places)
    middle = underside(last, BOTTOM.whole, BOTTOM.middle_places)
    assert arch is not None
    assert middle is not None
    assert last.stance is not None
    inner = arch.smooth(BOTTOM.bandwidth * last.length_mm)
    along = middle.smooth(BOTTOM.tape_bandwidth * last.length_mm)
    top = int(np.argmax(inner.z_mm))
    toe_mm, spring_mm = last.x_mm(HEIGHTS.toe), last.x_mm(HEIGHTS.toe_spring)
    thick = last.across(HEIGHTS.toe).points[:, 1]
    low_mm = float(last.across(HEIGHTS.toe_spring).points[:, 1].min())
    with new_figure(8.0, 4.2) as figure:
        axes = figure.subplots()
        outline = side_outline(last.vertices_mm, last.faces).closed()
        axes.fill(*outline.T, facecolor=FILL, edgecolor=QUIET, linewidth=0.8)
        ends = np.array([last.x_mm(-0.04), last.x_mm(1.04)])
        axes.plot(ends, [0, 0], color=INK, linewidth=1)
        ground = _ground(last, ends)
        axes.plot(ends, ground, color=INK, linewidth=1, dashes=(6, 3))
        axes.plot(along.x_mm, along.z_mm, color=SERIES[0], linewidth=1.6)
        axes.plot(inner.x_mm, inner.z_mm, color=SERIES[2], linewidth=1.2, dashes=(3, 2))
        instep = last.instep
        _dimension(
            axes, last, "instep_height", ((instep[0], 0), (instep[0], instep[2])), INK, (0.6, 52, 0)
        )
        place = inner.x_mm[top], inner.z_mm[top]
        _dimension(axes, last, "arch_height", ((place[0], 0), place), SERIES[2], (1.0, -20, 12))
        span = (toe_mm, thick.min()), (toe_mm, thick.max())
        _dimension(axes, last, "toe_height", span, SERIES[1], (1.0, -6, 9))
        foot_mm = float(_ground(last, np.array([spring_mm]))[0])
        span = (spring_mm, foot_mm), (spring_mm, low_mm)
        _dimension(axes, last, "toe_spring", span, INK, (0.0, 22, -18))
        _write(axes, _words(last, "tape_length"), (along.x_mm[12], -4.0), (20, -10), SERIES[0])
        _write(axes, "dashed: the ground that it stands on", (ends[0], ground[0]), (80, -9), QUIET)
        hide_axes(axes)
        return png_bytes(figure)


def _ground(last: Shape, x_mm: Floats) -> Floats:
    """How high the ground that a last stands on lies in its resting frame, (k,)."""
    assert last.stance is not None
    up = last.stance.standing_transform[2]
    return np.asarray(-(up[3] + up[0] * x_mm) / up[2])


def _girths(last: Shape) -> bytes:
    """The girths in fixed planes, from the side and from above, with their values."""
    side_view = side_outline(last.vertices_mm, last.faces).closed()
    plan_view = sole_outline(last.vertices_mm, last.faces, SHADOW).closed()
    words_at = {
        "ball_girth": (76, 8),
        "waist_girth": (58, 14),
        "instep_girth": (60, 12),
        "long_heel_girth": (-54, -60),
        "short_heel_girth": (66, 8),
    }
    with new_figure(9.0, 3.0) as figure:
        side, plan = figure.subplots(1, 2)
        for axes, title, outline, up in (
            (side, "From the side", side_view, 2),
            (plan, "From above", plan_view, 1),
        ):
            axes.fill(*outline.T, facecolor=FILL, edgecolor=QUIET, linewidth=0.8)
            axes.set_title(title)
            hide_axes(axes)
            for (name, (origin, across)), colour, dash in zip(
                _planes(last).items(), SERIES, DASHES, strict=True
            ):
                loop = max(last.cut(origin, across).loops, key=len)
                around = origin + ring(convex_hull(loop)) @ across
                axes.plot(*around[:, [0, up]].T, color=colour, linewidth=1.4, linestyle=dash)
                if axes is side:
                    top = around[np.argmax(around[:, 2]), [0, 2]]
                    _write(axes, _words(last, name), top, words_at[name], colour)
        draw_scale_bar(plan)
        return png_bytes(figure)


def _planes(last: Shape) -> dict[str, tuple[Floats, Floats]]:
    """A point (3,) and the axes (2, 3) of the plane of each of these girths."""
    assert last.ball_plane is not None
    ball = float(last.ball_plane[0][0] - last.x_mm(0.0)) / last.length_mm
    upright = {"waist_girth": 0.5 * (ball + LANDMARKS.instep), "instep_girth": LANDMARKS.instep}
    shortest_mm = measure_named("short_heel_girth").value_of(last).value
    level_deg = angle_to_deg(last, last.instep)
    steep_deg = min(
        np.arange(level_deg, HEEL.steepest_deg, 0.25),
        key=lambda deg: abs(hull_girth(around_heel(last, deg).points) - (shortest_mm or 0.0)),
    )
    heel = {"long_heel_girth": level_deg, "short_heel_girth": steep_deg}
    return {
        "ball_girth": last.ball_plane,
        **{name: (last.x_mm(at) * AXES[0], AXES[1:]) for name, at in upright.items()},
        **{name: (last.heel_base, heel_axes(deg)) for name, deg in heel.items()},
    }


def _bottom_widths(last: Shape) -> bytes:
    """The sections of heel and ball, with the widths that are read in them."""
    with new_figure(8.0, 3.4) as figure:
        places = (("heel", WIDTHS.heel, "1/6"), ("ball", WIDTHS.ball, f"{WIDTHS.ball:.2f}"))
        for axes, (place, share, words) in zip(figure.subplots(1, 2), places, strict=True):
            points = max(last.across(share, TAPE_OUTLINES).loops, key=len)
            axes.fill(*points.T, facecolor=FILL, edgecolor=INK, linewidth=1.2)
            axes.set_title(f"The {place}, at {words} of the length")
            bottom_mm, high_mm = points[:, 1].min(), WIDTHS.height * last.length_mm
            edges = [_touched(points, side) for side in (1.0, -1.0)]
            for side, edge in zip((1.0, -1.0), edges, strict=True):
                line = edge + np.array([[-1.0], [0.7]]) * 14.0 * np.array([side, 1.0])
                axes.plot(*line.T, color=QUIET, linewidth=1.0)
                drop = [edge[0]] * 2, [edge[1], bottom_mm - 14.0]
                axes.plot(*drop, ":", color=QUIET, linewidth=0.9)
            below = [(edge[0], bottom_mm - 14.0) for edge in edges]
            _dimension(axes, last, f"bottom_width_{place}", below, SERIES[0], (0.5, 0, -9))
            if place == "heel":
                low = points[points[:, 1] < bottom_mm + high_mm]
                ends = low[[np.argmin(low[:, 0]), np.argmax(low[:, 0])]]
                span = [(x, ends[:, 1].mean()) for x in ends[:, 0]]
                _dimension(axes, last, "heel_width", span, SERIES[1], (0.5, 0, 8))
                top = [points[:, 0].min(), points[:, 0].max()], [bottom_mm + high_mm] * 2
                axes.plot(*top, ":", color=QUIET, linewidth=1.0)
                limit = f"{WIDTHS.height:.2f} of the length\nover the lowest point"
                _write(axes, limit, (top[0][1], top[1][0]), (44, 0), QUIET)
            hide_axes(axes)
        return png_bytes(figure)


def _touched(points: Floats, side: float) -> Floats:
    """Where a line of 45 degrees touches a section (k, 2) from below, on one side, (2,)."""
    return np.asarray(points[np.argmax(points @ np.array([side, -1.0]))])


def _dimension(
    axes: Axes,
    shape: Shape,
    measure: str,
    ends: Any,
    colour: str,
    words_at: tuple[float, float, float],
    *,
    lines: bool = False,
) -> None:
    """A line between two places with an end mark on both, and the measure with its value.

    ``words_at``: the share of the way from the first to the second place, and points away from it.
    """
    start, end = np.asarray(ends, dtype=float)
    arrow = {"arrowstyle": "|-|,widthA=.25,widthB=.25", "color": colour, "linewidth": 1.4}
    axes.annotate("", end, start, arrowprops=arrow | {"shrinkA": 0, "shrinkB": 0})
    words = _words(shape, measure)
    words = words.replace(" ", "\n").replace("\nmm", " mm") if lines else words
    _write(axes, words, start + words_at[0] * (end - start), words_at[1:], colour)


def _words(shape: Shape, measure: str) -> str:
    """A measure with its value."""
    value = measure_named(measure).value_of(shape).value
    assert value is not None
    return f"{measure.replace('_', ' ')} {value:.1f} mm"


def _write(axes: Axes, words: str, place: Any, offset: Any, colour: str = INK) -> None:
    """Words some points away from a place."""
    axes.annotate(
        words,
        place,
        offset,
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=8,
        color=colour,
    )
