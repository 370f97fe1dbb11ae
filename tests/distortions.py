"""What a scanner, a table, a saw and an exporter do to a mesh: pure functions, seeded.

Each takes and returns ``(vertices (n, 3) float64, faces (m, 3) int64)`` unless its docstring says
otherwise; what is random takes a ``numpy.random.Generator``. Lengths are in the mesh's unit, mm
wherever a name says so. Nothing is changed in place.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints

Mesh = tuple[Floats, Ints]


# ------------------------------------------------------------------ pose and order


def random_rotation(rng: np.random.Generator) -> Floats:
    """A rotation (3, 3), det +1, uniform over all rotations (a normed Gaussian quaternion)."""
    w, x, y, z = (q := rng.normal(size=4)) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def random_pose(rng: np.random.Generator, shift_mm: float = 300.0) -> Floats:
    """A rigid transform (4, 4): a uniform rotation and a shift of up to ``shift_mm`` per axis."""
    pose = np.eye(4)
    pose[:3, :3] = random_rotation(rng)
    pose[:3, 3] = rng.uniform(-shift_mm, shift_mm, 3)
    return pose


def axis_rotation(axis: str, angle_deg: float) -> Floats:
    """The rotation (4, 4) about "x" (roll), "y" (pitch) or "z" (yaw), right-handed."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    turn = np.eye(4)
    turn[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return turn


def moved(vertices: Floats, transform: Floats) -> Floats:
    """The vertices under a (4, 4) transform."""
    return vertices @ transform[:3, :3].T + transform[:3, 3]


def mirrored(vertices: Floats, faces: Ints) -> Mesh:
    """The mirror image in y: a left shape from a right one, still wound outward."""
    return vertices * [1.0, -1.0, 1.0], faces[:, ::-1].copy()


def inside_out(vertices: Floats, faces: Ints) -> Mesh:
    """The same surface with every face wound the other way."""
    return vertices.copy(), faces[:, ::-1].copy()


def shuffled(vertices: Floats, faces: Ints, rng: np.random.Generator) -> Mesh:
    """The same surface: vertices and faces in another order, each face from another corner."""
    order = rng.permutation(len(vertices))
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    start = rng.integers(0, 3, len(faces))[:, None]
    turned = np.take_along_axis(faces, (np.arange(3) + start) % 3, axis=1)
    return vertices[order], rank[turned][rng.permutation(len(faces))]


def soup(vertices: Floats, faces: Ints) -> Mesh:
    """Every face with corners of its own, as an STL file holds them."""
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


def in_metres(vertices_mm: Floats) -> Floats:
    """The coordinates of a file in metres."""
    return vertices_mm * 1e-3


def in_inches(vertices_mm: Floats) -> Floats:
    """The coordinates of a file in inches."""
    return vertices_mm / 25.4


def joined(*meshes: Mesh) -> Mesh:
    """All meshes in one, unconnected."""
    starts = np.cumsum([0] + [len(v) for v, _ in meshes[:-1]])
    faces = [f + start for (_, f), start in zip(meshes, starts, strict=True)]
    return np.concatenate([v for v, _ in meshes]), np.concatenate(faces)


# ------------------------------------------------------------------ noise


def white_noise(vertices: Floats, rng: np.random.Generator, sd_mm: float) -> Floats:
    """Every coordinate moved by independent Gaussian noise of ``sd_mm``."""
    return vertices + rng.normal(0.0, sd_mm, vertices.shape)


def rippled(
    vertices: Floats,
    faces: Ints,
    rng: np.random.Generator,
    sd_mm: float,
    wavelength_mm: float = 10.0,
) -> Floats:
    """The vertices moved along their normals by a scanner's ripple.

    The ripple is a Gaussian random field of standard deviation ``sd_mm``: 48 plane waves of one
    wavelength, random directions and phases. Neighbours move together, so it does not average
    out over a patch shorter than a wavelength.
    """
    waves = 48
    direction = rng.normal(size=(waves, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    phase = rng.uniform(0.0, 2.0 * np.pi, waves)
    height = np.zeros(len(vertices))
    for d, p in zip(direction, phase, strict=True):
        height += np.cos(vertices @ d * (2.0 * np.pi / wavelength_mm) + p)
    height *= sd_mm * np.sqrt(2.0 / waves)
    return vertices + height[:, None] * _vertex_normals(vertices, faces)


def _vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    normals = np.stack(
        [
            np.bincount(faces.ravel(), np.repeat(cross[:, k], 3), minlength=len(vertices))
            for k in range(3)
        ],
        axis=1,
    )
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(size > 0.0, size, 1.0)


# ------------------------------------------------------------------ missing and extra parts


def _compacted(vertices: Floats, faces: Ints) -> Mesh:
    used, renamed = np.unique(faces, return_inverse=True)
    return vertices[used], renamed.reshape(-1, 3)


def with_holes(
    vertices: Floats, faces: Ints, rng: np.random.Generator, count: int, radius_mm: float
) -> Mesh:
    """The surface without the faces within ``radius_mm`` of ``count`` random vertices."""
    centres = vertices[rng.choice(len(vertices), count, replace=False)]
    middles = vertices[faces].mean(axis=1)
    keep = np.ones(len(faces), dtype=bool)
    for centre in centres:
        keep &= np.linalg.norm(middles - centre, axis=1) > radius_mm
    return _compacted(vertices, faces[keep])


def plane_cut(vertices: Floats, faces: Ints, origin: Floats, normal: Floats) -> Mesh:
    """The part with (p - origin) . normal <= 0, cut exactly and left open along the plane."""
    height = (vertices - origin) @ np.asarray(normal, dtype=float)
    above = height > 0.0
    count = above[faces].sum(axis=1)
    whole, mixed = faces[count == 0], faces[(count == 1) | (count == 2)]
    if len(mixed) == 0:
        return _compacted(vertices, whole)
    # turn each cut face so that the corner alone on its side of the plane comes first
    lone = above[mixed] == (above[mixed].sum(axis=1) == 1)[:, None]
    mixed = np.take_along_axis(mixed, (np.argmax(lone, axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    a, b, c = mixed.T
    pairs = np.concatenate([np.stack([a, b], 1), np.stack([a, c], 1)])
    pairs.sort(axis=1)  # one new vertex per cut edge, so that the cut stays connected
    pairs, which = np.unique(pairs, axis=0, return_inverse=True)
    share = height[pairs[:, 0]] / (height[pairs[:, 0]] - height[pairs[:, 1]])
    fresh = vertices[pairs[:, 0]] + share[:, None] * (vertices[pairs[:, 1]] - vertices[pairs[:, 0]])
    ab, ac = (which.reshape(2, -1) + len(vertices)).copy()
    tip, base = ~above[a], above[a]
    parts = [
        whole,
        np.stack([a, ab, ac], 1)[tip],
        np.stack([ab, b, c], 1)[base],
        np.stack([ab, c, ac], 1)[base],
    ]
    return _without_slivers(np.concatenate([vertices, fresh]), np.concatenate(parts))


def _without_slivers(vertices: Floats, faces: Ints) -> Mesh:
    """Without the zero-area faces that a plane through a vertex leaves."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return _compacted(vertices, faces[area > 0.0])


def leg_cut(vertices: Floats, faces: Ints, height_mm: float) -> Mesh:
    """A canonical shape cut off at ``height_mm`` over its lowest point, open at the top."""
    z = float(vertices[:, 2].min()) + height_mm
    return plane_cut(vertices, faces, np.array([0.0, 0.0, z]), np.array([0.0, 0.0, 1.0]))


def floor_plate(
    vertices: Floats, faces: Ints, margin_mm: float = 40.0, pitch_mm: float = 5.0
) -> Mesh:
    """A canonical shape standing on a sheet of floor, as a scanner sees both.

    The sheet lies at the shape's lowest point, reaches ``margin_mm`` beyond it, faces up, and
    is missing where the shape is nearer than ``pitch_mm`` to the floor.
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    size = np.ceil((high - low + 2.0 * margin_mm) / pitch_mm).astype(int)[:2]
    origin = low[:2] - margin_mm
    x, y = np.meshgrid(*(np.arange(n + 1) for n in size), indexing="ij")
    grid = np.column_stack([x.ravel(), y.ravel()]) * pitch_mm + origin
    plate = np.column_stack([grid, np.full(len(grid), low[2])])
    cell = np.zeros(tuple(size), dtype=bool)
    near = vertices[vertices[:, 2] < low[2] + pitch_mm, :2]
    cell[tuple(((near - origin) / pitch_mm).astype(int).T)] = True
    i, j = np.nonzero(~cell)
    a = i * (size[1] + 1) + j
    b, c, d = a + size[1] + 1, a + size[1] + 2, a + 1
    sheet = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return joined((vertices, faces), _compacted(plate, sheet))


# ------------------------------------------------------------------ other tessellations


def decimated(vertices: Floats, faces: Ints, factor: float) -> Mesh:
    """About 1/``factor`` of the faces, by quadric error collapse (fast_simplification)."""
    import fast_simplification

    out_vertices, out_faces = fast_simplification.simplify(
        np.ascontiguousarray(vertices, dtype=np.float32),
        np.ascontiguousarray(faces, dtype=np.int32),
        target_count=max(4, round(len(faces) / factor)),
    )
    return out_vertices.astype(np.float64), out_faces.astype(np.int64)


def subdivided(vertices: Floats, faces: Ints, chosen: Bools | None = None) -> Mesh:
    """The same surface with the ``chosen`` (m,) faces split in four; None splits all.

    A neighbour of a chosen face is split in two or three along the shared edges' mid-points,
    so that a closed mesh stays closed. No point of the surface moves.
    """
    chosen = np.ones(len(faces), dtype=bool) if chosen is None else chosen
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)  # edge k runs from corner k
    pairs, edge = np.unique(np.sort(sides.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    edge = edge.reshape(-1, 3)
    split = np.zeros(len(pairs), dtype=bool)
    split[edge[chosen]] = True
    middle = np.cumsum(split) - 1 + len(vertices)
    vertices = np.concatenate([vertices, vertices[pairs[split]].mean(axis=1)])
    marks = split[edge]
    # turn each face so that its pattern of split edges is one of 000, 100, 110, 111
    first = np.argmax(marks & ~np.roll(marks, 1, axis=1), axis=1)
    turn = (first[:, None] + np.arange(3)) % 3
    (a, b, c), (p, q, r) = (
        np.take_along_axis(t, turn, axis=1).T for t in (faces, np.where(marks, middle[edge], -1))
    )
    count = marks.sum(axis=1)
    patterns = {
        0: [(a, b, c)],
        1: [(a, p, c), (p, b, c)],
        2: [(p, b, q), (a, p, q), (a, q, c)],
        3: [(a, p, r), (p, b, q), (r, q, c), (p, q, r)],
    }
    parts = [
        np.stack(corners, axis=1)[count == n]
        for n, triangles in patterns.items()
        for corners in triangles
    ]
    return vertices, np.concatenate(parts)


def half_subdivided(vertices: Floats, faces: Ints, axis: int = 0) -> Mesh:
    """The same surface, its half beyond the middle of the extent along ``axis`` split in four."""
    middles = vertices[faces].mean(axis=1)[:, axis]
    middle = 0.5 * (vertices[:, axis].min() + vertices[:, axis].max())
    return subdivided(vertices, faces, middles > middle)
