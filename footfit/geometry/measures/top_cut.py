"""The top cut: the flat face that closes a leg, or the top of a last's cone.

Canonical mm: x from heel to toe, z up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.samples import calm_vectors
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import face_components
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, row_lengths
from footfit.geometry.numeric.planes import Plane, robust_plane


@dataclass(frozen=True, slots=True)
class TopCutSettings:
    """Where a top cut is looked for and how flat it is; lengths over L, areas over L squared.

    Attributes
    ----------
    height, front : float
        A leg is cut above this height, and behind this place along X.
    facing : float
        Faces look up from this cosine to Z on; the dorsum is steeper there.
    calm_rounds : int
        How often the normals are calmed first: noise turns small faces of the dorsum up.
    scale, rounds : float, int
        The plane is fitted with Cauchy weights of this width, so that other faces that look up have
        almost no weight.
    thickness, flat_share : float, float
        How far from its plane a face may lie, and how much of what looks up must lie so near.
    flatness : float
        The least cosine of a face to the plane's normal. Calming draws the normals of the faces at
        the rim towards the wall's; the coarser the mesh, the more.
    area : float
        The least area; a leg's cut has .05.
    middle, ridge_deg : float, float
        If this share of a section's run over a top turns by more, the top is a ridge and no cut.
    fewest : int
        If that share has fewer segments, the mesh is too coarse to tell a ridge from a cut.
    beside, wall_deg : float, float
        So near to both ends of the run over a cut, over L, the section falls more steeply.
    """

    height: float = 0.15
    front: float = 0.45
    facing: float = 0.80
    calm_rounds: int = 2
    scale: float = 0.004
    rounds: int = 12
    thickness: float = 0.01
    flat_share: float = 0.7
    flatness: float = 0.85
    area: float = 0.01
    middle: float = 0.7
    ridge_deg: float = 12.0
    fewest: int = 4
    beside: float = 0.03
    wall_deg: float = 25.0


TOP_CUT = TopCutSettings()


def top_cut_faces(vertices: Floats, faces: Ints, length: float, start_x: float) -> Bools:
    """The faces (m,) that close a shape at its top.

    These are the faces that look up behind the bend of the ankle. If those lie in one plane, then
    all faces in that plane count that are connected with them: the forepart of a last with a high
    heel may lie in it too.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    length, start_x : float
        The shape's length, and where it begins along X.
    """
    on_top = np.zeros(len(faces), dtype=bool)
    a, b, c = (vertices[:, 2] > TOP_CUT.height * length)[faces.T]
    candidates = np.flatnonzero(a & b & c)
    high = faces[candidates]
    vectors = area_vectors(vertices, high)
    for _ in range(TOP_CUT.calm_rounds):
        vectors = calm_vectors(vectors, high, len(vertices))
    areas = row_lengths(vectors)
    middles = (vertices[high[:, 0]] + vertices[high[:, 1]]) / 3.0 + vertices[high[:, 2]] / 3.0
    behind = middles[:, 0] < start_x + TOP_CUT.front * length
    behind &= vectors[:, 2] > TOP_CUT.facing * areas
    total = float(areas[behind].sum())
    if total <= TOP_CUT.area * length**2:
        return on_top
    points, share = middles[behind], areas[behind]
    normal = vectors[behind].sum(axis=0)
    normal /= np.linalg.norm(normal)
    start = Plane(normal, float(normal @ (share @ points) / share.sum()))
    plane = robust_plane(points, share, TOP_CUT.scale * length, TOP_CUT.rounds, start)
    level = np.abs(plane.heights(middles)) < TOP_CUT.thickness * length
    level &= vectors @ plane.normal > TOP_CUT.flatness * areas
    flat = float(areas[behind & level].sum()) > TOP_CUT.flat_share * total
    if flat:
        labels = face_components(high[level], len(vertices))
        level[level] = np.isin(labels, labels[behind[level]])
    on_top[candidates[level if flat else behind]] = True
    return on_top


def standing_top(standing_mm: Floats, faces: Ints) -> Ints:
    """The faces (k, 3) that close a last at its top, found as it stands.

    The top of a high heel looks backward as the last rests. ``standing_mm`` (n, 3) are counted from
    the rearmost point along the ground.
    """
    return faces[top_cut_faces(standing_mm, faces, float(np.ptp(standing_mm[:, 0])), 0.0)]


def runs_over_cut(segments: Floats, on_top: Bools, length: float) -> bool:
    """Whether a section's run over a top is flat and ends at a rim, as a cut does.

    The round instep of a last may lie in the plane of its cone's top. Its section turns all over,
    and goes on as smoothly beside the run.

    Parameters
    ----------
    segments : (m, 2, 2)
        The section's segments, across and up.
    on_top : (m,)
        Which of them run over the top.
    length : float
        The shape's length.
    """
    run, rest = segments[on_top], segments[~on_top]
    ends = run.reshape(-1, 2)[[run[:, :, 0].argmin(), run[:, :, 0].argmax()]]
    # On a coarse mesh some faces of a ridge are no part of the top: they tell how it turns, too.
    middles, others = segments.mean(axis=1), rest.mean(axis=1)
    high = middles[:, 1] > run[:, :, 1].min() - TOP_CUT.thickness * length
    middles = middles[high & (middles[:, 0] > ends[0, 0]) & (middles[:, 0] < ends[1, 0])]
    across = middles[:, 0]
    inner = np.abs(across - ends[:, 0].mean()) < 0.5 * TOP_CUT.middle * np.ptp(ends[:, 0])
    if np.count_nonzero(inner) < TOP_CUT.fewest:
        return True
    bend = np.polyfit(across[inner], middles[inner, 1], 2)[0]
    if 2.0 * abs(bend) * np.ptp(across[inner]) > np.radians(TOP_CUT.ridge_deg):
        return False
    rise = np.abs(rest[:, 1] - rest[:, 0])
    near = np.linalg.norm(others - ends[:, None], axis=2) < TOP_CUT.beside * length
    falls = [np.arctan2(*rise[beside].sum(axis=0)[::-1]) for beside in near]
    return bool(min(falls) > np.radians(TOP_CUT.wall_deg))
