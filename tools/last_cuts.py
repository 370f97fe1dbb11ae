"""What is cut out of a last: a thimble hole, a V-cut, a hinge. Solids by boolean operations.

manifold3d does the cutting; it is a dependency of the tests only.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold, Mesh

from footfit.geometry.numeric.arrays import Floats, Ints

Solid = tuple[Floats, Ints]


def thimble(
    vertices_mm: Floats, faces: Ints, *, radius_mm: float = 7.0, depth_mm: float = 35.0
) -> Solid:
    """A last with a round blind hole drilled down into the top of its cone."""
    place = _cone_top(vertices_mm)
    drill = Manifold.cylinder(depth_mm + 40.0, radius_mm, circular_segments=48)
    return _mesh(_solid(vertices_mm, faces) - drill.translate(place - [0.0, 0.0, depth_mm]))


def v_cut(
    vertices_mm: Floats, faces: Ints, *, angle_deg: float = 24.0, depth_mm: float = 30.0
) -> Solid:
    """A last with a wedge cut out across the front of its cone, as lasts that break have."""
    length_mm = float(np.ptp(vertices_mm[:, 0]))
    x = vertices_mm[:, 0].min() + 0.40 * length_mm
    near = np.abs(vertices_mm[:, 0] - x) < 0.02 * length_mm
    top = float(vertices_mm[near, 2].max())
    half = np.tan(np.radians(angle_deg / 2)) * (depth_mm + 60.0)
    wedge = [[x, top - depth_mm], [x + half, top + 60.0], [x - half, top + 60.0]]
    return cut_out(vertices_mm, faces, wedge)


def cut_out(vertices_mm: Floats, faces: Ints, outline: Sequence[Sequence[float]]) -> Solid:
    """A last without what lies within an outline of (x, z), across its whole width."""
    return _mesh(_solid(vertices_mm, faces) - _across(outline))


def hinge(
    vertices_mm: Floats, faces: Ints, *, gap_mm: float = 2.0, share: float = 0.44
) -> list[Solid]:
    """A hinged last: cut through from the instep to the shank.

    Parameters
    ----------
    gap_mm : float
        The width of the cut; 0 gives two closed bodies that touch along the cut.
    share : float
        Where the cut is, over the length.

    Returns
    -------
    list of (vertices (n, 3), faces (m, 3))
        The bodies: the heel part first.
    """
    length_mm = float(np.ptp(vertices_mm[:, 0]))
    x = vertices_mm[:, 0].min() + share * length_mm
    solid = _solid(vertices_mm, faces)
    low, high = -50.0, 0.7 * length_mm
    lean = 0.25 * (high - low)  # the cut runs forward as it goes up
    far = 2.0 * length_mm
    bodies = []
    for side in (-1.0, 1.0):
        edge = 0.5 * gap_mm * side
        half_space = [
            [x + edge - lean / 2, low],
            [x + edge + lean / 2, high],
            [x + side * far, high],
            [x + side * far, low],
        ]
        bodies.append(_mesh(solid ^ _across(half_space)))
    return bodies


def slit(vertices_mm: Floats, faces: Ints, *, gap_mm: float = 2.0, left_mm: float = 15.0) -> Solid:
    """A last of one body with a hinge: a slit across it that ends ``left_mm`` over its bottom."""
    length_mm = float(np.ptp(vertices_mm[:, 0]))
    x = vertices_mm[:, 0].min() + 0.44 * length_mm
    near = np.abs(vertices_mm[:, 0] - x) < 0.02 * length_mm
    low, half = float(vertices_mm[near, 2].min()) + left_mm, gap_mm / 2
    outline = [[x - half, low], [x + half, low], [x + half + 40.0, 200.0], [x - half + 40.0, 200.0]]
    return cut_out(vertices_mm, faces, outline)


def v_of_bodies(
    vertices_mm: Floats, faces: Ints, edges_mm: Sequence[float] = (5.0, 4.0, 6.0)
) -> list[Solid]:
    """A last with a V-cut as a modeller may leave it: three closed bodies, each meshed alone.

    The bottom, and on it the rear and the front of the cone; ``edges_mm`` are their longest edges.
    """
    length_mm = float(np.ptp(vertices_mm[:, 0]))
    x = vertices_mm[:, 0].min() + 0.36 * length_mm
    near = np.abs(vertices_mm[:, 0] - x) < 0.02 * length_mm
    z = float(vertices_mm[near, 2].min()) + 0.12 * length_mm
    upper, lower = _solid(vertices_mm, faces).split_by_plane((0.0, 0.0, 1.0), z)
    lean = 0.25 * length_mm  # so far each wall leans over this height
    high, far = z + length_mm, 400.0
    walls = [
        upper
        ^ _across([[x, z], [x + side * lean, high], [x + side * far, high], [x + side * far, z]])
        for side in (-1.0, 1.0)
    ]
    bodies = zip((lower, *walls), edges_mm, strict=True)
    return [_mesh(body.refine_to_length(edge_mm)) for body, edge_mm in bodies]


def joined(bodies: Sequence[Solid]) -> Solid:
    """Several bodies as the faces of one file."""
    start, faces = 0, []
    for vertices, triangles in bodies:
        faces.append(triangles + start)
        start += len(vertices)
    return np.concatenate([vertices for vertices, _ in bodies]), np.concatenate(faces)


def as_one(bodies: Sequence[Solid]) -> Solid:
    """Bodies that touch as one solid."""
    whole = _solid(*bodies[0])
    for body in bodies[1:]:
        whole += _solid(*body)
    return _mesh(whole)


def _cone_top(vertices_mm: Floats) -> Floats:
    """The middle of what lies highest of the rear half, (3,)."""
    rear = vertices_mm[vertices_mm[:, 0] < np.median(vertices_mm[:, 0])]
    return np.asarray(rear[rear[:, 2] > rear[:, 2].max() - 3.0].mean(axis=0))


def _across(outline: Sequence[Sequence[float]]) -> Manifold:
    """A prism along Y with an outline of (x, z)."""
    from manifold3d import CrossSection

    points = np.array(outline)
    if (
        np.sum(points[:, 0] * np.roll(points[:, 1], -1) - np.roll(points[:, 0], -1) * points[:, 1])
        < 0
    ):
        points = points[::-1]
    prism = CrossSection([points]).extrude(400.0)  # along z, with (x, y) for (x, z)
    return prism.rotate([90.0, 0.0, 0.0]).translate([0.0, 200.0, 0.0])


def _solid(vertices_mm: Floats, faces: Ints) -> Manifold:
    solid = Manifold(Mesh(vertices_mm.astype(np.float32), faces.astype(np.uint32)))
    if solid.is_empty():
        raise ValueError(f"the mesh is no solid: {solid.status()}")
    return solid


def _mesh(solid: Manifold) -> Solid:
    mesh = solid.to_mesh()
    return np.asarray(mesh.vert_properties[:, :3], dtype=np.float64), np.asarray(
        mesh.tri_verts, dtype=np.int64
    )
