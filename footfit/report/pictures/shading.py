"""Pictures of meshes as arrays: an orthographic view with hidden surfaces removed and soft light.

A view is a (3, 3) matrix whose rows are the picture's right, its up, and the direction towards
the eye. Everything is NumPy and gives the same bytes on every run.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import vertex_normals
from footfit.geometry.mesh.topology import is_closed
from footfit.geometry.numeric.arrays import Bools, Floats, Ints

VIEWS = {
    "from_above": np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    "from_below": np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
    "from_right": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    "from_left": np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
}
"""Views of a mesh in the canonical frame; the toe is on the right, but on the left in the last."""


@dataclass(frozen=True, slots=True)
class Lighting:
    """How a surface is lit: a soft light beside the eye, and what is left in the shade."""

    direction: tuple[float, float, float] = (-0.35, 0.55, 0.75)
    ambient: float = 0.35
    gain: float = 1.12
    oversampling: int = 2


LIGHTING = Lighting()


@dataclass(frozen=True, slots=True)
class Frame:
    """The part of the picture plane that is drawn: (left, right, bottom, top) in mm."""

    left: float
    right: float
    bottom: float
    top: float


@dataclass(frozen=True, slots=True)
class Fragments:
    """What each pixel of a picture shows: ``face`` (rows, columns), -1 for none, and where in it.

    ``weights`` (rows, columns, 3) are barycentric.
    """

    face: Ints
    weights: Floats


def axonometric_view(azimuth_deg: float, elevation_deg: float) -> Floats:
    """The view of an eye at this azimuth (from +X towards +Y) and elevation.

    Examples
    --------
    >>> bool(np.allclose(axonometric_view(-90.0, 0.0), VIEWS["from_right"]))
    True
    """
    a, e = np.radians([azimuth_deg, elevation_deg])
    right = [-np.sin(a), np.cos(a), 0.0]
    up = [-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)]
    eye = [np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)]
    return np.array([right, up, eye])


def frame_around(points: Floats, margin: float = 0.04) -> Frame:
    """The smallest frame around projected ``points`` (n, 2 or more), with a margin."""
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    pad = margin * float((high - low).max())
    return Frame(low[0] - pad, high[0] + pad, low[1] - pad, high[1] + pad)


_PIXELS_AT_ONCE = 300_000


def fragments(projected: Floats, faces: Ints, frame: Frame, shape: tuple[int, int]) -> Fragments:
    """The nearest face of each pixel of a (rows, columns) picture.

    ``projected`` (n, 3) is right, up, towards the eye, in mm. Each triangle is tested at the
    centre of every pixel of its bounding box.
    """
    rows, columns = shape
    scale = np.array([columns / (frame.right - frame.left), rows / (frame.top - frame.bottom), 1.0])
    corners = ((projected - [frame.left, frame.bottom, 0.0]) * scale)[faces]
    low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
    low = np.maximum(np.ceil(low - 0.5).astype(np.int64), 0)
    beyond = np.minimum(np.floor(high + 0.5).astype(np.int64), [columns, rows])
    size = np.maximum(beyond - low, 0)
    face, weights = np.full(rows * columns, -1), np.zeros((rows * columns, 3))
    depth = np.full(rows * columns, -np.inf)
    parts = np.flatnonzero(np.diff(np.cumsum(size.prod(axis=1)) // _PIXELS_AT_ONCE)) + 1
    for chunk in np.split(np.arange(len(faces)), parts):
        triangle, row, column, weight = _hits(corners[chunk], low[chunk], size[chunk])
        triangle, pixel = chunk[triangle], row * columns + column
        height = np.einsum("ij,ij->i", weight, corners[triangle, :, 2])
        front = np.flatnonzero(height > depth[pixel])
        front = front[np.lexsort((-triangle[front], height[front]))]  # the nearest is last
        pixel = pixel[front]
        depth[pixel], face[pixel], weights[pixel] = height[front], triangle[front], weight[front]
    return Fragments(face.reshape(shape), weights.reshape(rows, columns, 3))


def _hits(corners: Floats, low: Ints, size: Ints) -> tuple[Ints, Ints, Ints, Floats]:
    """Which pixel centres of each triangle's box lie in it: triangle, row, column and weights."""
    count = size.prod(axis=1)
    triangle = np.repeat(np.arange(len(corners)), count)
    place = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count)
    row, column = np.divmod(place, size[triangle, 0])
    row, column = row + low[triangle, 1], column + low[triangle, 0]
    first, second = (_weight(corners, corner, count, (row, column)) for corner in (0, 1))
    third = 1.0 - first - second
    inside = np.flatnonzero((first >= 0) & (second >= 0) & (third >= 0))
    weights = np.stack([weight[inside] for weight in (first, second, third)], axis=1)
    return triangle[inside], row[inside], column[inside], weights


def _weight(corners: Floats, corner: int, count: Ints, pixels: tuple[Ints, Ints]) -> Floats:
    """One corner's barycentric weight at the pixel centres, of which each triangle has ``count``.

    A triangle seen edge-on has no weights: NaN, which lies in no triangle.
    """
    own, start, end = (corners[:, (corner + k) % 3, :2] for k in range(3))
    across = end - start
    area = across[:, 0] * (own[:, 1] - start[:, 1]) - across[:, 1] * (own[:, 0] - start[:, 0])
    slope = across / np.where(area == 0.0, np.nan, area)[:, None]
    right, up, x, y = np.repeat(np.column_stack([slope, start]), count, axis=0).T
    return np.asarray(right * (pixels[0] + 0.5 - y) - up * (pixels[1] + 0.5 - x))


def values_at(values: Floats, corners: Ints, weights: Floats) -> Floats:
    """Per-vertex ``values`` (n, k) at points given by their corners and weights, (p, 3) each."""
    mixed: Floats = np.einsum("pj,pjk->pk", weights, values[corners])
    return mixed


@dataclass(frozen=True, slots=True)
class SeenSurface:
    """The p pixels of a picture that show a surface: ``covered`` (rows, columns) says which.

    ``corners`` and ``weights`` (p, 3) say where in the mesh; ``normals`` (p, 3) are of length 1.
    """

    covered: Bools
    corners: Ints
    weights: Floats
    normals: Floats


def seen_surface(
    projected: Floats, faces: Ints, frame: Frame, shape: tuple[int, int], *, culled: bool
) -> SeenSurface:
    """What a (rows, columns) picture of a mesh in view coordinates shows; the first row is below.

    ``culled`` leaves out the faces that are turned away from the eye.
    """
    normals = vertex_normals(projected, faces)
    if culled:
        a, b, c = (projected[faces[:, corner], :2] for corner in range(3))
        along, aside = b - a, c - a
        faces = faces[along[:, 0] * aside[:, 1] > along[:, 1] * aside[:, 0]]
    seen = fragments(projected, faces, frame, shape)
    covered: Bools = seen.face >= 0
    corners, weights = faces[seen.face[covered]], seen.weights[covered]
    normals = values_at(normals, corners, weights)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return SeenSurface(covered, corners, weights, normals)


def light_direction() -> Floats:
    """The direction to the light, of length 1, in view coordinates."""
    light: Floats = np.asarray(LIGHTING.direction) / np.linalg.norm(LIGHTING.direction)
    return light


def rows_for(frame: Frame, columns: int) -> int:
    """How many rows a picture of ``frame`` has that is ``columns`` wide."""
    return max(1, round(columns * (frame.top - frame.bottom) / (frame.right - frame.left)))


def shaded_image(
    projected: Floats, faces: Ints, frame: Frame, columns: int, colours: Floats
) -> Floats:
    """An RGBA picture (rows, columns, 4), first row on top, of a mesh in view coordinates.

    A surface seen from behind is lit as if from before.

    Parameters
    ----------
    projected : (n, 3)
        Vertices in view coordinates: right, up, towards the eye, mm.
    faces : (m, 3)
        A closed mesh is wound outward.
    frame : Frame
        What is drawn.
    columns : int
        The picture's width in pixels; its height follows.
    colours : (3,) or (n, 3)
        The surface's colour, one for all or one per vertex, each in 0-1.
    """
    fine = LIGHTING.oversampling
    shape = (rows_for(frame, columns) * fine, columns * fine)
    seen = seen_surface(projected, faces, frame, shape, culled=is_closed(faces))
    base = colours if colours.ndim == 1 else values_at(colours, seen.corners, seen.weights)
    facing = np.where(seen.normals[:, 2] < 0, -1.0, 1.0)[:, None]
    brightness = np.clip((facing * seen.normals) @ light_direction(), 0.0, 1.0)
    shade = LIGHTING.ambient + (1.0 - LIGHTING.ambient) * brightness
    shaded = np.zeros((*shape, 3))
    shaded[seen.covered] = np.clip(base * shade[:, None] * LIGHTING.gain, 0.0, 1.0)
    return _coarse_image(shaded, seen.covered)[::-1]


def _coarse_image(shaded: Floats, covered: Bools) -> Floats:
    """Blocks of fine pixels as one with their share of coverage as alpha."""
    n = LIGHTING.oversampling
    rows, columns = covered.shape[0] // n, covered.shape[1] // n
    weight = covered.astype(np.float64).reshape(rows, n, columns, n)
    alpha = weight.mean(axis=(1, 3))
    blocks = shaded.reshape(rows, n, columns, n, 3) * weight[..., None]
    colour = blocks.sum(axis=(1, 3)) / np.maximum(weight.sum(axis=(1, 3)), 1.0)[..., None]
    return np.concatenate([colour, alpha[..., None]], axis=-1)
