"""Pictures of the girths by the least tape: where the tape lies on a last, and its section."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.least_tape import Tape, heel_tape, tape_about, tape_over
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.hulls import convex_hull
from footfit.report.pictures.drawn_outlines import SHADOW, ring, side_outline, sole_outline
from footfit.report.pictures.figures import (
    FILL,
    INK,
    QUIET,
    SERIES,
    draw_scale_bar,
    hide_axes,
    new_figure,
    png_bytes,
    write_title,
)
from tools.last_specs import LastSpec
from tools.lasts import last_mesh

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPEC = LastSpec(heel_height_mm=60.0, toe_spring_mm=6.0, level_tread=True)


def tapes(shape: Shape) -> dict[str, tuple[Tape, dict[str, Floats]]]:
    """The tapes by measure, each with the places (3,) that it goes through by name."""
    assert shape.joints is not None
    assert shape.waist_crown is not None
    outer, inner = shape.joints
    waist, instep, base = shape.waist_crown.place, shape.instep_crown.place, shape.heel_base
    return {
        "ball_girth_least": (
            tape_about(shape, outer, inner, shape.upright),
            {"outer joint": outer, "inner joint": inner},
        ),
        "waist_girth_least": (tape_over(shape, waist), {"waist's crown": waist}),
        "instep_girth_least": (tape_over(shape, instep), {"instep's crown": instep}),
        "heel_girth_instep": (
            heel_tape(shape),
            {"heel's base": base, "instep's crown": instep},
        ),
    }


def tape_pictures() -> dict[str, bytes]:
    """Every picture by its file's name."""
    shape = Shape(*last_mesh(SPEC), "last")
    return {
        f"{name}.png": png_bytes(_tape_figure(shape, name, tape, places))
        for name, (tape, places) in tapes(shape).items()
    }


def _tape_figure(shape: Shape, measure: str, tape: Tape, places: dict[str, Floats]) -> Figure:
    """One tape: from the side, from above, and in its own plane."""
    loop = max(tape.section(shape).loops, key=len)
    hull = ring(convex_hull(loop))
    around = tape.origin + hull @ tape.axes
    side_view = side_outline(shape.vertices_mm, shape.faces).closed()
    plan_view = sole_outline(shape.vertices_mm, shape.faces, SHADOW).closed()
    with new_figure(9.0, 2.6) as figure:
        side, plan, section = figure.subplots(1, 3, width_ratios=[2.6, 2.6, 1.1])
        for axes, title, outline, up in (
            (side, "From the side", side_view, 2),
            (plan, "From above", plan_view, 1),
        ):
            axes.fill(*outline.T, facecolor=FILL, edgecolor=QUIET, linewidth=0.8)
            axes.plot(*around[:, [0, up]].T, color=SERIES[0], linewidth=1.5)
            axes.set_title(title)
            for name, place in places.items():
                axes.plot(*place[[0, up]], "o", color=INK, markersize=4)
                if axes is plan:
                    axes.annotate(name, place[:2], (6, 6), textcoords="offset points", fontsize=8)
        section.fill(*loop.T, facecolor=FILL, edgecolor=INK, linewidth=1.2)
        section.plot(*hull.T, color=SERIES[0], linewidth=1.5)
        section.set_title(f"The tape: {hull_girth(loop):.1f} mm")
        for axes in (side, plan, section):
            hide_axes(axes)
        draw_scale_bar(plan)
        write_title(figure, f"{measure}, turned by {tape.tilt_deg:.0f} degrees")
    return figure
