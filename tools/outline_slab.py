"""The outline of a generated last, laid flat and drawn as a slab: the truth of its flare.

The flare is read from a mesh. Its definition can be read from the outline alone, which a generator
knows exactly: both edges, laid flat along the bottom's own arc, with straight walls on them. No
stance, no section of a last and no smoothing of its middle line takes part.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from tools.lasts import LastSpec, centre_line_mm, half_width_mm, standing

ACROSS = 9  # points of the slab's bottom, from edge to edge
HEIGHT = 0.08  # of the walls over the length


def outline_slab(medial: Floats, lateral: Floats, side: Floats) -> tuple[Floats, Ints]:
    """A slab with the outline of a bottom that is laid flat.

    Parameters
    ----------
    medial, lateral : (n, 2)
        The two edges in the plan from heel to toe, mm; the same number of points in pairs.
    side : (k, 2)
        The bottom's middle in the side view, x and z in mm, beyond both ends of the edges.

    Returns
    -------
    vertices_mm : (v, 3)
        Turned so that the principal axis of the plan is x.
    faces : (f, 3)
        Wound outward.
    """
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(side, axis=0), axis=1))])
    edges = [
        np.column_stack([np.interp(edge[:, 0], side[:, 0], arc), edge[:, 1]])
        for edge in (lateral, medial)
    ]
    share = np.linspace(0.0, 1.0, ACROSS)[:, None, None]
    plan = edges[0] + share * (edges[1] - edges[0])  # (across, n, 2)
    flat = _on_its_axis(plan.reshape(-1, 2)).reshape(plan.shape)
    height = HEIGHT * float(np.ptp(flat[..., 0]))
    floor = np.insert(flat, 2, 0.0, axis=2)
    top = floor[::-1] + np.array([0.0, 0.0, height])
    return _lofted(np.concatenate([floor, top]).transpose(1, 0, 2))


def own_slab(spec: LastSpec, points: int = 700) -> tuple[Floats, Ints]:
    """The slab of a last of :mod:`tools.lasts`."""
    at = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, points))
    line, half = centre_line_mm(spec, at), half_width_mm(spec, at)
    along = np.gradient(line, at, axis=0)
    aside = np.column_stack([-along[:, 1], along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    edges = (line + sign * half[:, None] * aside for sign in (1.0, -1.0))
    return outline_slab(*edges, plan_side(spec))


def plan_side(spec: LastSpec) -> Floats:
    """The side view of a bottom in the pose in which the last was bent in plan, drawn on straight
    at both ends.
    """
    pose = standing(spec)
    side = pose.middle_mm
    if not spec.bent_standing:
        angle = np.radians(pose.pitch_deg)
        cosine, sine = np.cos(angle), np.sin(angle)
        side = side @ np.array([[cosine, sine], [-sine, cosine]])
        side -= [side[0, 0], 0.0]
    first, last = side[1] - side[0], side[-1] - side[-2]
    far = 0.2 * spec.length_mm
    return np.concatenate(
        [[side[0] - far * first / first[0]], side, [side[-1] + far * last / last[0]]]
    )


def _on_its_axis(points: Floats) -> Floats:
    """Plan points (n, 2) turned to their principal axis; the rearmost is at x = 0."""
    away = points - points.mean(axis=0)
    axis = np.linalg.eigh(away.T @ away)[1][:, 1]
    axis *= np.sign(axis[0])
    turned = away @ np.array([[axis[0], -axis[1]], [axis[1], axis[0]]])
    return np.asarray(turned - [turned[:, 0].min(), 0.0])


def _lofted(rings: Floats) -> tuple[Floats, Ints]:
    """A closed strip through rings (n, m, 3), open at both ends, wound outward."""
    count, around = rings.shape[:2]
    row, place = np.meshgrid(np.arange(count - 1), np.arange(around), indexing="ij")
    a, b = row * around + place, row * around + (place + 1) % around
    first = np.stack([a, a + around, b], axis=-1).reshape(-1, 3)
    second = np.stack([b, a + around, b + around], axis=-1).reshape(-1, 3)
    vertices, faces = rings.reshape(-1, 3), np.concatenate([first, second])
    corners = vertices[faces]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    return vertices, faces if volume > 0.0 else faces[:, ::-1].copy()
