"""A foot in its last from four sides, coloured by the room around it, the last as an outline."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.mesh.surface import vertex_normals
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.report.pictures.drawn_outlines import SHADOW, side_outline, sole_outline
from footfit.report.pictures.figures import INK, bare, house_style, scale_bar
from footfit.report.pictures.heat import BREAKS_MM, COLOURS, NOT_COMPARED, heat_colours
from footfit.report.pictures.shading import VIEWS, Frame, blended, fragments, frame_around
from footfit.report.wording.text import file_name, visible

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import Comparison

Mesh = tuple[Floats, Ints]
COLUMNS = 560
SHADE, LIGHT = 0.42, np.array([-0.35, 0.55, 0.75]) / np.linalg.norm([-0.35, 0.55, 0.75])
"""How much of a colour the shade may take: little, so that it is still the legend's."""
PANELS = {
    "Sole": "from_below",
    "Top": "from_above",
    "Medial side": "medial",
    "Lateral side": "lateral",
}


def heat_figure(comparison: Comparison, *, titled: bool = True) -> Figure:
    """Four views on the foot's own side; the last is the dashed line around the foot."""
    from matplotlib.figure import Figure

    foot, last = own_side(comparison)
    with house_style():
        figure = Figure(figsize=(10.5, 4.9 if titled else 4.5), layout="constrained")
        grid = figure.add_gridspec(2, 3, width_ratios=(1.0, 1.0, 0.16))
        for index, (title, view) in enumerate(_views(comparison).items()):
            axes = figure.add_subplot(grid[index // 2, index % 2])
            _panel(axes, (foot, last), VIEWS[view], comparison.clearance_mm)
            axes.set_title(title)
        _legend(figure.add_subplot(grid[:, 2]))
        if titled:
            figure.suptitle(_title(comparison), x=0.01, ha="left", fontsize=12, fontweight="bold")
    return figure


def own_side(comparison: Comparison) -> tuple[Mesh, Mesh]:
    """Foot and last, on the foot's own side: the comparison holds right shapes."""
    foot = comparison.vertices_mm, comparison.faces
    last = comparison.last_vertices_mm, comparison.last_faces
    if comparison.foot.aligned.alignment.side.side != "left":
        return foot, last
    mirror = np.array([1.0, -1.0, 1.0])
    return (foot[0] * mirror, foot[1][:, ::-1]), (last[0] * mirror, last[1][:, ::-1])


def _title(comparison: Comparison) -> str:
    foot = file_name(comparison.foot.aligned.alignment.info.path)
    return f"{foot} in {visible(comparison.last.labels.name)}: the room around the foot"


def _views(comparison: Comparison) -> dict[str, str]:
    """The panels' titles and views; a left foot's medial side is seen from its right."""
    left = comparison.foot.aligned.alignment.side.side == "left"
    sides = ("from_right", "from_left") if left else ("from_left", "from_right")
    named = dict(zip(("medial", "lateral"), sides, strict=True))
    return {title: named.get(view, view) for title, view in PANELS.items()}


def _panel(axes: Axes, meshes: tuple[Mesh, Mesh], view: Floats, room_mm: Floats) -> None:
    (vertices, faces), last = meshes
    outline = _outline(last, view)
    low = vertices[vertices[:, 2] <= last[0][:, 2].max()]  # a leg makes no room on the page
    frame = frame_around(np.concatenate([outline, (low @ view.T)[:, :2]]))
    axes.imshow(
        heat_image(vertices @ view.T, faces, room_mm, frame, COLUMNS),
        extent=frame.extent,
        interpolation="antialiased",
    )
    closed = np.concatenate([outline, outline[:1]])
    axes.plot(closed[:, 0], closed[:, 1], color=INK, linewidth=1.0, linestyle=(0, (5, 2)))
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
    bare(axes)
    scale_bar(axes, place=(0.02, 0.0))


def heat_image(
    projected: Floats, faces: Ints, room_mm: Floats, frame: Frame, columns: int
) -> Floats:
    """An RGBA picture (rows, columns, 4), first row on top; the steps are decided pixel by pixel.

    Parameters
    ----------
    projected : (n, 3)
        Vertices in view coordinates: right, up, towards the eye, mm.
    faces : (m, 3)
    room_mm : (n,)
    frame : Frame
    columns : int
    """
    rows = max(1, round(columns * (frame.top - frame.bottom) / (frame.right - frame.left)))
    normals = vertex_normals(projected, faces)
    faces = _facing(projected, faces)
    seen = fragments(projected, faces, frame, (rows, columns))
    covered = seen.face >= 0
    corners, weights = faces[seen.face[covered]], seen.weights[covered]
    room = np.einsum("pj,pj->p", weights, room_mm[corners])
    normals = blended(normals, corners, weights)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    light = 1.0 - SHADE * (1.0 - np.clip(normals @ LIGHT, 0.0, 1.0))
    picture = np.zeros((rows, columns, 4))
    picture[covered, :3] = heat_colours(room) * light[:, None]
    picture[covered, 3] = 1.0
    return picture[::-1]


def _facing(projected: Floats, faces: Ints) -> Ints:
    """The faces wound towards the eye: what is hidden behind them need not be drawn."""
    a, b, c = (projected[faces[:, corner], :2] for corner in range(3))
    one, two = b - a, c - a
    return faces[one[:, 0] * two[:, 1] > one[:, 1] * two[:, 0]]


def _outline(last: Mesh, view: Floats) -> Floats:
    """The last's outline (n, 2) in a view along Z or Y."""
    from_side = abs(float(view[2, 2])) < 0.5
    points = (side_outline(*last) if from_side else sole_outline(*last, SHADOW)).closed()
    signs = (view[0, 0], 1.0) if from_side else (1.0, view[1, 1])
    return np.asarray(points * signs, dtype=np.float64)


def _legend(axes: Axes) -> None:
    """The steps as boxes, with the mm at their edges."""
    for step, colour in enumerate(COLOURS):
        axes.bar(0.5, 1.0, width=1.0, bottom=step, color=colour, edgecolor="white", linewidth=0.6)
    axes.bar(0.5, 0.8, width=1.0, bottom=-1.4, color=NOT_COMPARED, edgecolor="white")
    for edge, value in enumerate(BREAKS_MM, start=1):
        axes.text(1.15, edge, f"{value:+.0f}" if value else "0", va="center", fontsize=8)
    axes.text(1.15, -1.0, "not\ncompared", va="center", fontsize=7.5)
    axes.text(0.0, len(COLOURS) + 0.25, "mm of room", fontsize=8.5, fontweight="bold")
    axes.text(1.15, len(COLOURS) - 0.5, "room", va="center", fontsize=8)
    axes.text(1.15, 0.5, "tight", va="center", fontsize=8)
    axes.set_xlim(0.0, 3.6)
    axes.set_ylim(-1.6, len(COLOURS) + 1.0)
    axes.set_axis_off()
