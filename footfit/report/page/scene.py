"""The 3D view of a page: the foot, coloured by its clearance, in a last of glass.

The page holds the meshes, quantised, so that nothing is fetched. The script (``scene.js``) draws
them with WebGL, or on a plain canvas. Without a script the view stays hidden, and the page shows
its pictures.
"""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.report.pictures.drawn_outlines import Mesh, is_left, own_side
from footfit.report.pictures.heat import NOT_COMPARED, SHADE, breaks_mm, scale_colours, step_words
from footfit.report.pictures.shading import light_direction
from footfit.results import Comparison

STEPS = 65_535
"""Steps along an axis: one is 0.005 mm on a last."""
MOST_VERTICES = 65_536
"""The most that 16 bits can number; a mesh with more is shown in pictures only."""
UNKNOWN = -32_768
"""Stands for a clearance, in hundredths of a mm, where nothing is compared."""
LARGEST_MM = 300.0
"""The largest clearance that the view keeps: it fits into 16 bits."""
MARGIN = 1.12
"""The space around foot and last in the first view."""
START = {"right": (58.0, 24.0), "left": (-58.0, 24.0)}
"""The first view, azimuth and elevation in degrees: the medial side from the front.

Most lasts press there.
"""


@dataclass(frozen=True, slots=True)
class Scene:
    """The 3D view of a page.

    ``data`` is what the script draws, as JSON; ``views`` are the buttons, each with azimuth and
    elevation in degrees; ``steps`` are the legend's colours, each with its range in mm; ``ends``
    say what lies beyond the first and the last of them.
    """

    data: str
    views: tuple[tuple[str, str], ...]
    steps: tuple[tuple[str, str], ...]
    ends: tuple[str, str]


def scene_of(comparison: Comparison) -> Scene | None:
    """The view of a foot in a last; None if a mesh has too many vertices.

    Parameters
    ----------
    comparison : Comparison
        Its meshes as they are to be shown: see ``pipeline.drawables.drawable``.
    """
    foot, last = own_side(comparison)
    if max(len(foot[0]), len(last[0])) > MOST_VERTICES:
        return None
    views = tuple((name, f"{a:g},{e:g}") for name, (a, e) in _views(comparison).items())
    step_mm, (first, second) = comparison.step_mm, comparison.nouns
    neutral = comparison.is_difference
    steps = tuple(
        (colour, step_words(step, step_mm, neutral=neutral))
        for step, colour in enumerate(scale_colours(neutral=neutral))
    )
    ends = f"tight, mm: the {first} is larger", "loose, mm: space to spare"
    if comparison.is_difference:
        ends = f"mm: the {second} is smaller", f"mm: the {second} is larger"
    return Scene(_scene_data(comparison, foot, last), views, steps, ends)


def _views(comparison: Comparison) -> dict[str, tuple[float, float]]:
    medial = -90.0 if is_left(comparison.foot) else 90.0
    return {
        "medial": (medial, 0.0),
        "lateral": (-medial, 0.0),
        "top": (-90.0, 90.0),
        "sole": (-90.0, -90.0),
        "front": (0.0, 10.0),
        "back": (180.0, 10.0),
    }


def _scene_data(comparison: Comparison, foot: Mesh, last: Mesh) -> str:
    """Both meshes, the colours and the first view as one line of JSON."""
    low, high = last[0].min(axis=0), last[0].max(axis=0)
    shown = foot[0][foot[0][:, 2] <= high[2]]
    low, high = np.minimum(low, shown.min(axis=0)), np.maximum(high, shown.max(axis=0))
    length, height = float(np.linalg.norm((high - low)[:2])), float(high[2] - low[2])
    side = comparison.foot.aligned.alignment.side.side or "right"
    turn, lean = np.radians(START[side])
    deep = length * abs(np.cos(turn)) * np.sin(lean)
    scene = {
        "foot": packed_mesh(*foot) | {"clearance": packed_clearance(comparison.clearance_mm)},
        "last": packed_mesh(*last),
        "breaks": breaks_mm(comparison.step_mm, neutral=comparison.is_difference),
        "colours": scale_colours(neutral=comparison.is_difference),
        "grey": NOT_COMPARED,
        "light": [round(float(value), 3) for value in light_direction()],
        "shade": SHADE,
        "unknown": UNKNOWN,
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


def packed_clearance(clearance_mm: Floats) -> str:
    """The clearance at each vertex in hundredths of a mm, base64 of 16-bit integers."""
    hundredths = np.rint(100.0 * np.clip(np.nan_to_num(clearance_mm), -LARGEST_MM, LARGEST_MM))
    return _base64(np.where(np.isfinite(clearance_mm), hundredths, UNKNOWN).astype("<i2"))


def _base64(values: NDArray[np.integer[Any]]) -> str:
    return base64.b64encode(values.tobytes()).decode("ascii")
