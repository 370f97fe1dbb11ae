"""The picture of a standing last: its ground, its lengths, its angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.report.pictures.figures import FILL, INK, SERIES, hide_axes, new_figure, png_bytes
from tools.last_specs import LastSpec
from tools.lasts import last_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SPEC = LastSpec(heel_height_mm=60.0, toe_spring_mm=10.0, level_tread=True, rings=90, segments=64)
HEIGHTS = ("heel_height", "toe_spring_tip", "seat_angle_deg")
LENGTHS = ("stick_length", "bottom_length", "tread_from", "tread_to")


def stance_picture() -> bytes:
    """The side view of a last that stands on its heel, with what is measured along the ground."""
    shape = Shape(*last_mesh(SPEC), "last")
    assert shape.stance is not None
    transform = shape.stance.standing_transform
    points = (shape.vertices_mm @ transform[:3, :3].T + transform[:3, 3])[:, [0, 2]]
    values = {
        name: measure_named(name).value_of(shape).value or 0.0 for name in (*HEIGHTS, *LENGTHS)
    }
    with new_figure(7.0, 3.6) as figure:
        axes = figure.subplots()
        hide_axes(axes)
        for triangle in points[shape.faces]:
            axes.fill(*triangle.T, color=FILL, linewidth=0)
        _draw(axes, shape.stance.middle_mm, float(points[:, 0].max()), values)
        return png_bytes(figure)


def _draw(axes: Axes, line: Floats, front: float, values: dict[str, float]) -> None:
    """The ground, the bottom's middle (k, 2), and the measures with their values."""
    axes.plot([-15, front + 2], [0, 0], color=INK, linewidth=1)
    axes.plot(*line.T, color=SERIES[0], linewidth=1.6)
    stick, tread = values["stick_length"], (values["tread_from"], values["tread_to"])
    _dimension(axes, 0.0, stick, -14, f"stick length {stick:.1f} mm")
    _dimension(axes, *tread, -34, f"tread from {tread[0]:.1f} to {tread[1]:.1f} mm")
    for x, name, side in ((0.0, "heel_height", -4), (front, "toe_spring_tip", 4)):
        axes.plot([x, x], [0.0, values[name]], color=SERIES[1], linewidth=1.6)
        words = f"{name.replace('_', ' ')}\n{values[name]:.1f} mm"
        align = "right" if side < 0 else "left"
        axes.text(x + side, 0.5 * values[name], words, ha=align, va="center", fontsize=8)
    middle, seat = line[int(0.46 * len(line))], line[int(0.1 * len(line))]
    words = f"bottom length {values['bottom_length']:.1f} mm"
    axes.text(middle[0] - 12, middle[1] - 12, words, ha="right", fontsize=8, color=SERIES[0])
    words = f"seat angle {values['seat_angle_deg']:.1f} degrees"
    axes.text(seat[0], seat[1] + 8, words, fontsize=8)


def _dimension(axes: Axes, start: float, end: float, height: float, words: str) -> None:
    """A line with two ends from one place along the ground to another, and its words."""
    axes.plot([start, end], [height, height], color=INK, linewidth=0.8, marker="|")
    axes.text(0.5 * (start + end), height - 3, words, ha="center", va="top", fontsize=8)
