"""The page's 3D view: the foot, coloured by its room, in a glassy last; turned without a network.

The meshes stand in the page, quantised. The script (``scene.js``) draws them by WebGL, or paints
them on a plain canvas; without any script the view stays hidden and the pictures stand.
"""

from __future__ import annotations

import base64
import json
from functools import cache
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.report.pictures.heat import BREAKS_MM, COLOURS, NOT_COMPARED, step_words
from footfit.report.pictures.heat_figure import own_side

if TYPE_CHECKING:
    from footfit.results import Comparison

STEPS = 65_535
"""Places on each axis: 0.005 mm on a last."""
MOST_VERTICES = 65_536
"""What 16 bits can name; a heavier mesh has no 3D view, only its pictures."""
UNKNOWN = -32_768
"""The room where nothing is compared, in hundredths of a mm."""
LARGEST_MM = 300.0
MARGIN = 1.12
START = {"right": (58.0, 24.0), "left": (-58.0, 24.0)}
"""Azimuth and elevation at first: from the front of the medial side, where it mostly presses."""


@cache
def scene_script() -> str:
    """The viewer, as it stands in the page."""
    return (Path(__file__).parent / "scene.js").read_text(encoding="utf-8")


def scene_block(comparison: Comparison) -> str:
    """The view with its legend and controls; empty where a mesh is too heavy for it.

    Parameters
    ----------
    comparison : Comparison
        Its meshes as they are to be shown: see ``pipeline.shapes.drawable``.
    """
    foot, last = own_side(comparison)
    if max(len(foot[0]), len(last[0])) > MOST_VERTICES:
        return ""
    data = escape(_scene_data(comparison, foot, last), quote=True)
    views = "".join(
        f'<button type="button" data-view="{azimuth:g},{elevation:g}">{name}</button>'
        for name, (azimuth, elevation) in _views(comparison).items()
    )
    return f"""<figure id="scene" class="scene" hidden>
<canvas id="scene-view" tabindex="0" role="img" data-scene="{data}"
 aria-label="The foot in the last, in three dimensions; the pictures below show the same."></canvas>
<div class="controls">
<label><input type="checkbox" data-show="foot" checked> foot</label>
<label><input type="checkbox" data-show="last" checked> last</label>
<span class="views">{views}</span>
</div>
{legend()}
<figcaption id="scene-status"></figcaption>
</figure>"""


def legend() -> str:
    """The scale of colours with its mm, as boxes with words."""
    width, height = 62, 15
    boxes = "".join(
        f'<rect x="{step * width}" y="0" width="{width}" height="{height}" fill="{colour}"/>'
        f'<text x="{step * width + width / 2:g}" y="{height + 13}">{step_words(step)}</text>'
        for step, colour in enumerate(COLOURS)
    )
    words = (
        f'<text x="0" y="{height + 29}" class="start">tight: the foot is larger</text>'
        f'<text x="{len(COLOURS) * width}" y="{height + 29}" class="end">room to spare</text>'
    )
    return (
        f'<svg class="legend" viewBox="0 0 {len(COLOURS) * width} {height + 34}" role="img" '
        f'aria-label="Colours from tight to room, in mm">{boxes}{words}</svg>'
    )


def _views(comparison: Comparison) -> dict[str, tuple[float, float]]:
    medial = -90.0 if comparison.foot.aligned.alignment.side.side == "left" else 90.0
    return {
        "medial": (medial, 0.0),
        "lateral": (-medial, 0.0),
        "top": (-90.0, 90.0),
        "sole": (-90.0, -90.0),
        "front": (0.0, 10.0),
        "back": (180.0, 10.0),
    }


def _scene_data(
    comparison: Comparison, foot: tuple[Floats, Ints], last: tuple[Floats, Ints]
) -> str:
    """Both meshes, the colours and the first view as one line of JSON."""
    low, high = last[0].min(axis=0), last[0].max(axis=0)
    shown = foot[0][foot[0][:, 2] <= high[2]]
    low, high = np.minimum(low, shown.min(axis=0)), np.maximum(high, shown.max(axis=0))
    length, height = float(np.linalg.norm((high - low)[:2])), float(high[2] - low[2])
    side = comparison.foot.aligned.alignment.side.side or "right"
    turn, lean = np.radians(START[side])
    deep = length * abs(np.cos(turn)) * np.sin(lean)
    scene = {
        "foot": packed_mesh(*foot) | {"room": packed_room(comparison.room_mm)},
        "last": packed_mesh(*last),
        "breaks": BREAKS_MM,
        "colours": COLOURS,
        "unknown": NOT_COMPARED,
        "centre": [round(float(value), 3) for value in 0.5 * (low + high)],
        "size": [
            round(MARGIN * length, 1),
            round(MARGIN * float(height * np.cos(lean) + deep), 1),
        ],
        "view": START[side],
    }
    return json.dumps(scene, sort_keys=True, separators=(",", ":"))


def packed_mesh(vertices: Floats, faces: Ints) -> dict[str, object]:
    """A mesh as 16-bit steps from an origin, base64: little-endian, vertices then faces."""
    origin = vertices.min(axis=0)
    step = float(np.ptp(vertices, axis=0).max()) / STEPS or 1.0
    places = np.rint((vertices - origin) / step).astype("<u2")
    return {
        "origin": [round(float(value), 4) for value in origin],
        "step": step,
        "vertices": _base64(places),
        "faces": _base64(faces.astype("<u2")),
    }


def packed_room(room_mm: Floats) -> str:
    """The room at each vertex in hundredths of a mm, base64 of 16-bit integers."""
    hundredths = np.rint(100.0 * np.clip(np.nan_to_num(room_mm), -LARGEST_MM, LARGEST_MM))
    return _base64(np.where(np.isfinite(room_mm), hundredths, UNKNOWN).astype("<i2"))


def _base64(values: NDArray[np.integer[Any]]) -> str:
    return base64.b64encode(values.tobytes()).decode("ascii")
