"""Shapes whose truth is a formula. Each returns (vertices (n, 3), faces (m, 3)), wound outward.

Lengths are mm. "Inscribed" means that the vertices lie on the smooth surface: areas and volumes of
the mesh are then a little smaller than the formula's, by O(h^2) of the edge length h.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints

Mesh = tuple[Floats, Ints]


def tetrahedron(edge_mm: float = 100.0) -> Mesh:
    """A regular tetrahedron about the origin.

    Area sqrt(3) e^2, volume e^3 / (6 sqrt 2), angle defect pi at each vertex, Euler 2.
    """
    corners = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    return corners * edge_mm / np.sqrt(8.0), faces


def cube(edge_mm: float = 100.0, cells: int = 4) -> Mesh:
    """A cube about the origin, each side cut into ``cells`` x ``cells`` squares of two triangles.

    Area 6 e^2, volume e^3, angle defect pi/2 at the corners and 0 elsewhere, Euler 2.
    """
    t = np.linspace(-0.5, 0.5, cells + 1)
    u, v = (g.ravel() for g in np.meshgrid(t, t, indexing="ij"))
    quads = grid_faces(cells + 1, cells + 1)
    points: list[Floats] = []
    faces: list[Ints] = []
    for axis in range(3):
        for sign in (-0.5, 0.5):
            side = np.empty((len(u), 3))
            side[:, axis], side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = sign, u, v
            faces.append((quads if sign > 0 else quads[:, ::-1]) + len(points) * len(u))
            points.append(side)
    # Twice the cell's number: a half would round to even, and merge neighbours where cells is odd.
    key = np.round(np.concatenate(points) * 2 * cells).astype(np.int64)
    _, first, which = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return np.concatenate(points)[first] * edge_mm, which.reshape(-1)[np.concatenate(faces)]


def sphere(radius_mm: float = 50.0, subdivisions: int = 4) -> Mesh:
    """An icosphere about the origin, inscribed: 20 * 4^subdivisions faces.

    Area 4 pi r^2, volume 4/3 pi r^3, k1 = k2 = 1/r everywhere, total angle defect 4 pi, Euler 2.
    """
    g = (1.0 + np.sqrt(5.0)) / 2.0
    # fmt: off
    vertices = np.array(
        [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g],
         [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]]
    )
    faces = np.array(
        [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
         [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
         [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
         [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]]
    )
    # fmt: on
    vertices = vertices / np.linalg.norm(vertices, axis=1, keepdims=True)
    for _ in range(subdivisions):
        sides = np.sort(np.stack([faces, np.roll(faces, -1, 1)], 2).reshape(-1, 2), axis=1)
        pairs, which = np.unique(sides, axis=0, return_inverse=True)
        p, q, r = (which.reshape(-1, 3) + len(vertices)).T
        a, b, c = faces.T
        middles = vertices[pairs].sum(axis=1)
        middles /= np.linalg.norm(middles, axis=1, keepdims=True)
        vertices = np.concatenate([vertices, middles])
        quarters = [(a, p, r), (p, b, q), (r, q, c), (p, q, r)]
        faces = np.concatenate([np.stack(t, axis=1) for t in quarters])
    return vertices * radius_mm, faces


def ellipsoid(
    radii_mm: tuple[float, float, float] = (120.0, 45.0, 35.0), subdivisions: int = 4
) -> Mesh:
    """An icosphere stretched to the half axes a, b, c, inscribed.

    Volume 4/3 pi a b c; Gaussian curvature h^4 / (abc)^2 and mean curvature
    h^3 (a^2 + b^2 + c^2 - |p|^2) / (2 (abc)^2) with h^-2 = x^2/a^4 + y^2/b^4 + z^2/c^4.
    """
    vertices, faces = sphere(1.0, subdivisions)
    return vertices * radii_mm, faces


def ellipsoid_curvatures(
    vertices: Floats, radii_mm: tuple[float, float, float]
) -> tuple[Floats, Floats]:
    """k1 <= k2 (n,) in 1/mm of the smooth ellipsoid at points on it."""
    a2, b2, c2 = np.square(radii_mm)
    product = a2 * b2 * c2
    h = 1.0 / np.sqrt(np.sum(vertices**2 / np.square([a2, b2, c2]), axis=1))
    gaussian = h**4 / product
    mean = h**3 * (a2 + b2 + c2 - np.sum(vertices**2, axis=1)) / (2.0 * product)
    root = np.sqrt(np.maximum(mean**2 - gaussian, 0.0))
    return mean - root, mean + root


def torus(ring_mm: float = 60.0, tube_mm: float = 20.0, around: int = 96, across: int = 48) -> Mesh:
    """A torus about z, inscribed.

    Area 4 pi^2 R r, volume 2 pi^2 R r^2, curvatures 1/r and cos v / (R + r cos v), total angle
    defect 0, Euler 0.
    """
    u, v = np.meshgrid(_turn(around), _turn(across), indexing="ij")
    reach = ring_mm + tube_mm * np.cos(v)
    points = np.stack([reach * np.cos(u), reach * np.sin(u), tube_mm * np.sin(v)], axis=2)
    return points.reshape(-1, 3), grid_faces(around, across, wrap=(True, True))


def torus_curvatures(vertices: Floats, ring_mm: float, tube_mm: float) -> tuple[Floats, Floats]:
    """k1 <= k2 (n,) in 1/mm of the smooth torus at points on it."""
    reach = np.hypot(vertices[:, 0], vertices[:, 1])
    return (reach - ring_mm) / (tube_mm * reach), np.full(len(vertices), 1.0 / tube_mm)


def cylinder(
    radius_mm: float = 40.0, height_mm: float = 250.0, around: int = 96, along: int = 60
) -> Mesh:
    """A closed cylinder about z from 0 to its height, inscribed; flat ends of one fan each.

    With the n-gon's area P = n r^2 sin(2 pi/n) / 2 and side q = 2 r sin(pi/n): volume P h, area
    2 P + n q h exactly. Wall curvatures 0 and 1/r. Euler 2.
    """
    angle, z = np.meshgrid(_turn(around), np.linspace(0.0, height_mm, along + 1), indexing="ij")
    wall = np.stack([radius_mm * np.cos(angle), radius_mm * np.sin(angle), z], axis=2)
    vertices = np.concatenate([wall.reshape(-1, 3), [[0.0, 0.0, 0.0], [0.0, 0.0, height_mm]]])
    rim = np.arange(around) * (along + 1)
    after, low, high = np.roll(rim, -1), len(vertices) - 2, len(vertices) - 1
    ends = [
        np.stack([np.full(around, low), after, rim], 1),
        np.stack([np.full(around, high), rim + along, after + along], 1),
    ]
    return vertices, np.concatenate([grid_faces(around, along + 1, wrap=(True, False)), *ends])


def flat_sheet(length_mm: float = 260.0, width_mm: float = 100.0, cells: int = 40) -> Mesh:
    """A rectangle in the plane z = 0, facing up. Area l w, no curvature, Euler 1, one boundary."""
    x, y = np.meshgrid(
        np.linspace(0.0, length_mm, cells + 1),
        np.linspace(0.0, width_mm, cells + 1),
        indexing="ij",
    )
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    return points, grid_faces(cells + 1, cells + 1)


def open_cap(
    radius_mm: float = 50.0, opening_deg: float = 60.0, rings: int = 24, around: int = 72
) -> Mesh:
    """A spherical cap about +z, polar angle 0 to ``opening_deg``, inscribed; one pole vertex.

    Area 2 pi r^2 (1 - cos a), total angle defect 2 pi (1 - cos a) within O(h^2), and with the
    boundary's turning exactly 2 pi (Gauss-Bonnet). Euler 1, one boundary.
    """
    polar = np.radians(opening_deg) * np.arange(1, rings + 1) / rings
    angle, theta = np.meshgrid(_turn(around), polar, indexing="ij")
    unit = np.stack(
        [np.sin(theta) * np.cos(angle), np.sin(theta) * np.sin(angle), np.cos(theta)], axis=2
    )
    vertices = np.concatenate([unit.reshape(-1, 3), [[0.0, 0.0, 1.0]]]) * radius_mm
    first = np.arange(around) * rings
    fan = np.stack([np.full(around, len(vertices) - 1), first, np.roll(first, -1)], 1)
    wall = grid_faces(around, rings, wrap=(True, False))[:, ::-1]
    return vertices, np.concatenate([wall, fan])


def convex_cloud(
    count: int, rng: np.random.Generator, radii_mm: tuple[float, float, float] = (50.0, 50.0, 50.0)
) -> Mesh:
    """The convex hull of ``count`` random points on an ellipsoid: an irregular triangulation.

    Points are uniform on the unit sphere before it is stretched; curvatures as ``ellipsoid``.
    """
    from scipy.spatial import ConvexHull

    points = rng.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    faces = ConvexHull(points).simplices.astype(np.int64)
    a, b, c = (points[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0.0
    faces[inward] = faces[inward][:, ::-1]
    return points * radii_mm, faces


# ------------------------------------------------------------------ what is not a foot


def hand(length_mm: float = 190.0, subdivisions: int = 5) -> Mesh:
    """A flat palm with five fingers: closed, Euler 2, star-shaped about the palm's middle.

    Extent along x is ``length_mm`` exactly.
    """
    unit, faces = sphere(1.0, subdivisions)
    fingers = [(62.0, 0.62, 60.0), (21.0, 1.15, 130.0), (3.0, 1.30, 150.0), (-15.0, 1.18, 140.0)]
    fingers += [(-34.0, 0.85, 120.0)]  # direction in the palm's plane (deg), length, sharpness
    flat = unit * [1.0, 1.0, 0.55]
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    reach = np.ones(len(unit))
    for angle_deg, length, sharpness in fingers:
        angle = np.radians(angle_deg)
        toward = flat @ [np.cos(angle), np.sin(angle), 0.0]
        reach += length * np.exp(sharpness * (toward - 1.0))
    vertices = unit * reach[:, None] * [1.0, 0.85, 0.32]
    return vertices * (length_mm / np.ptp(vertices[:, 0])), faces


def shin(
    height_mm: float = 300.0, ankle_mm: float = 35.0, calf_mm: float = 55.0, around: int = 80
) -> Mesh:
    """A leg without its foot: a tube about z, oval (1 to .85), open at both ends.

    Half width from ``ankle_mm`` at z = 0 to ``calf_mm`` at .7 of the height. Euler 0, two
    boundaries.
    """
    rows = 90
    t = np.linspace(0.0, 1.0, rows)
    half = ankle_mm + (calf_mm - ankle_mm) * np.sin(0.5 * np.pi * np.minimum(t / 0.7, 2.0))
    angle, level = np.meshgrid(_turn(around), np.arange(rows), indexing="ij")
    reach = half[level]
    points = np.stack(
        [reach * np.cos(angle), 0.85 * reach * np.sin(angle), height_mm * t[level]], axis=2
    )
    return points.reshape(-1, 3), grid_faces(around, rows, wrap=(True, False))


def two_feet(vertices: Floats, faces: Ints, gap_mm: float = 40.0) -> Mesh:
    """A canonical right shape and its mirror image beside it, as one mesh of two components.

    The left one stands on the wearer's left (+y), ``gap_mm`` between the two.
    """
    left = vertices * np.array([1.0, -1.0, 1.0])
    left[:, 1] += vertices[:, 1].max() + gap_mm - left[:, 1].min()
    both = np.concatenate([faces, faces[:, ::-1] + len(vertices)])
    return np.concatenate([vertices, left]), both


# ------------------------------------------------------------------ grids


def _turn(count: int) -> Floats:
    return np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)


def grid_faces(rows: int, columns: int, wrap: tuple[bool, bool] = (False, False)) -> Ints:
    """Two triangles per cell of a (rows, columns) grid of vertices, facing row x column."""
    across = columns if wrap[1] else columns - 1
    i, j = np.divmod(np.arange((rows if wrap[0] else rows - 1) * across), across)
    after_i, after_j = (i + 1) % rows, (j + 1) % columns
    a, b = i * columns + j, after_i * columns + j
    c, d = after_i * columns + after_j, i * columns + after_j
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
