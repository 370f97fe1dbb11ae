"""A judge of custom lasts: it reads the written STL and the JSON.

It shares no code with footfit. Where it needs to know how the base stands, it is told so.
"""

from __future__ import annotations

import numpy as np

from tests.self_intersection import self_intersections, welded
from tests.tape_peer import edges_of, hull_perimeter, turned

TILTS_DEG = np.arange(-8.0, 8.1, 2.0)
UPRIGHT = 0.005
"""A plane whose normal rises by less over the resting plane does not lean back."""


def stl_mesh(data: bytes):
    """The corners (3 n, 3) and faces (n, 3) of a binary STL."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    rows = np.frombuffer(data, kind, offset=84)
    return rows["corners"].reshape(-1, 3).astype(float), np.arange(3 * len(rows)).reshape(-1, 3)


def girth_misses(data: bytes, document) -> dict[str, float]:
    """By girth, how far the section in the stated plane is from the target, in mm."""
    vertices, faces = welded(*stl_mesh(data))
    edges = edges_of(faces)
    misses = {}
    for zone in document["zones"]:
        if zone["plane"] is not None:
            point, normal = (np.array(zone["plane"][key]) for key in ("point_mm", "normal"))
            misses[zone["name"]] = hull_perimeter(vertices, edges, point, normal) - zone["target"]
    return misses


def least_misses(data: bytes, document, up=(0.0, 0.0, 1.0)) -> dict[str, float]:
    """By girth, how far the least perimeter of planes through its point is from the target.

    The planes are turned by a few degrees about the level axis of the stated plane. By definition a
    tape does not lean back from ``up``, which is the normal of the plane that the last rests on.
    """
    vertices, faces = welded(*stl_mesh(data))
    edges = edges_of(faces)
    misses = {}
    for zone in document["zones"]:
        if zone["plane"] is None or zone["name"] in ("ball_girth_least", "heel_girth_instep"):
            continue
        point, normal = (np.array(zone["plane"][key]) for key in ("point_mm", "normal"))
        normal = normal * np.sign(normal[0])
        across = np.cross(up, normal)
        planes = [turned(across, normal, tilt) for tilt in TILTS_DEG]
        forward = [plane for plane in planes if plane @ up < UPRIGHT] or [normal]
        least = min(hull_perimeter(vertices, edges, point, plane) for plane in forward)
        misses[zone["name"]] = least - zone["target"]
    return misses


def zones_not_good(data: bytes, document, profile) -> list[str]:
    """The measures of the document whose clearance is not in its zone's good range.

    ``profile`` is the fit profile's TOML. Girths are cut in their planes, widths are the extents of
    sections, and the length is how far the file reaches along X. A waist's range is the mean of
    those of ball and instep, and what follows has no range.
    """
    vertices, faces = welded(*stl_mesh(data))
    edges = edges_of(faces)
    zones = {zone["name"]: zone for zone in document["zones"] if not zone["follows"]}
    own = {name: _own_mm(vertices, edges, name, zones) for name in zones}
    result = []
    for name, zone in zones.items():
        if name == "length":
            (room,) = (z["custom"] for z in document["judged"] if z["name"] == "length")
            clearance = room + own[name] - zone["reached"]
        else:
            clearance = own[name] - zone["foot"]
        parts = ("ball_girth", "instep_girth") if name.startswith("waist") else (zone["zone"],)
        ranges = [profile["zones"][part]["good_mm"] for part in parts]
        low, high = np.mean(ranges, axis=0)
        if not low <= clearance <= high:
            result.append(name)
    return result


def _own_mm(vertices, edges, name, zones) -> float:
    """A measure of the written file: near enough to say in which range it is."""
    low = vertices[:, 2] < vertices[:, 2].min() + 0.3 * np.ptp(vertices[:, 0])
    rear, length = vertices[low, 0].min(), float(np.ptp(vertices[low, 0]))  # without a boot's shaft
    if name == "length":
        return length
    if name == "heel_width":
        plane = np.array([rear + length / 6.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0])
        section = _section(vertices, edges, *plane)
        low = section[section[:, 2] < section[:, 2].min() + 0.15 * length]
        return float(np.ptp(low[:, 1]))
    plane = (
        np.array(zones["ball_girth_least" if name == "ball_width" else name]["plane"][key])
        for key in ("point_mm", "normal")
    )
    point, normal = plane
    if name == "ball_width":  # both joints lie in the plane of the ball's tape
        across = np.cross([0.0, 0.0, 1.0], normal)
        section = _section(vertices, edges, point, normal)
        return float(np.ptp(section @ (across / np.linalg.norm(across))))
    return hull_perimeter(vertices, edges, point, normal)


def _section(vertices, edges, point, normal):
    """Where edges cross a plane, (k, 3)."""
    height = (vertices - point) @ normal
    start, end = edges[height[edges[:, 0]] * height[edges[:, 1]] < 0.0].T
    share = height[start] / (height[start] - height[end])
    return vertices[start] + share[:, None] * (vertices[end] - vertices[start])


def kept_moves(before, after, faces, up) -> dict[str, float]:
    """By how many mm the parts moved that a last maker keeps.

    ``up`` is what was up when the base stood. Heel, spring and toe are 15, 7 and 7 % of its length
    along the ground; the back curve is the rearmost place of level sections every 3 mm, and the top
    plane what is flat on top.
    """
    up = np.asarray(up) / np.linalg.norm(up)
    ahead = np.cross([0.0, 1.0, 0.0], up)
    along, over = before @ ahead, before @ up
    place = (along - along.min()) / np.ptp(along)
    normals = _normals(before, faces)
    down = np.unique(faces[normals @ up < -0.8])
    bottom = down[over[down] < over.min() + 0.3 * np.ptp(over)]
    risen = np.abs((after - before) @ up)
    toe = np.flatnonzero(place > 0.93)
    lid = faces[_lid(before, normals, faces, over, up)]
    rear = over[place < 0.05]
    levels = np.arange(rear.min() + 4.0, rear.max() - 4.0, 3.0)
    back = before, faces, ahead, up
    parts = {
        "bottom heights": risen[bottom],
        "heel height": risen[bottom[place[bottom] < 0.15]],
        "toe spring": risen[bottom[place[bottom] > 0.93]],
        "toe": _not_rigid(before[toe], after[toe]),
        "back curve": np.abs(_back(after, faces, ahead, up, levels) - _back(*back, levels)),
        "top plane": np.linalg.norm((after - before)[np.unique(lid)], axis=1),
    }
    return {name: float(moved.max(initial=0.0)) for name, moved in parts.items()}


def _lid(points, normals, faces, over, up):
    """Which faces lie in the plane of the top: those that look as most of what looks up there."""
    high = over[faces].min(axis=1) > over.min() + 0.6 * np.ptp(over)
    looks_up = np.flatnonzero(high & (normals @ up > 0.7))
    if not len(looks_up):
        return looks_up
    mean = np.median(normals[looks_up], axis=0)
    flat = looks_up[normals[looks_up] @ (mean / np.linalg.norm(mean)) > 0.9998]
    height = points[faces].mean(axis=1) @ mean
    return flat[np.abs(height[flat] - np.median(height[flat])) < 0.2] if len(flat) else flat


def _not_rigid(before, after):
    """How far points moved besides their common shift and turn."""
    start, end = before - before.mean(axis=0), after - after.mean(axis=0)
    left, _, right = np.linalg.svd(start.T @ end)
    return np.linalg.norm(start @ left @ right - end, axis=1)


def _back(points, faces, ahead, up, levels):
    """The rearmost place of the level section at each of ``levels``."""
    along, over = points @ ahead, points @ up
    edges = edges_of(faces)
    result = []
    for level in levels:
        height = over[edges] - level
        cut = height[:, 0] * height[:, 1] < 0.0
        share = height[cut, 0] / (height[cut, 0] - height[cut, 1])
        start, end = along[edges[cut]].T
        result.append((start + share * (end - start)).min())
    return np.array(result)


def reachable_girths(vertices, faces, point, normal, up, widths, heights) -> tuple[float, float]:
    """The least and the largest girth in a plane, if all widths and all heights were scaled.

    ``widths`` and ``heights`` are the least and the largest scale of each.
    """
    edges, middle = edges_of(faces), vertices.mean(axis=0)
    girths = []
    for wider, higher in zip(widths, heights, strict=True):
        turn = np.eye(3) + (higher - 1.0) * np.outer(up, up)
        turn += (wider - 1.0) * np.outer([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])
        scaled = (vertices - middle) @ turn + middle
        place = (point - middle) @ turn + middle
        plane = np.linalg.inv(turn) @ normal
        girths.append(hull_perimeter(scaled, edges, place, plane / np.linalg.norm(plane)))
    return girths[0], girths[1]


def mesh_changes(before, after, faces) -> dict[str, float]:
    """What became of a mesh whose faces stayed: flipped faces, aspect ratios, dihedral angles.

    ``aspect`` is the worst aspect ratio over the worst one before, ``dihedral_deg`` the 99th
    percentile of how far the angles at edges changed.
    """
    normals = [_normals(points, faces) for points in (before, after)]
    worst = [_aspects(points, faces).max() for points in (before, after)]
    angles = [_dihedrals(each, faces) for each in normals]
    return {
        "flipped": float((np.einsum("ij,ij->i", *normals) < 0.0).sum()),
        "aspect": float(worst[1] / worst[0]),
        "dihedral_deg": float(np.percentile(np.abs(angles[1] - angles[0]), 99.0)),
        "intersections": float(_new_intersections(before, after, faces)),
    }


def _new_intersections(before, after, faces) -> int:
    """How often a surface cuts itself; 0 if it did before: nothing is known of its change then."""
    count = self_intersections(after, faces)
    return 0 if count and self_intersections(before, faces) else count


def _normals(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return normal / np.where(length > 0.0, length, 1.0)


def _aspects(points, faces):
    """The longest edge over the height on it."""
    corners = points[faces]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    area = 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return edges.max(axis=1) ** 2 / np.maximum(2.0 * area, 1e-12)


def _dihedrals(normals, faces):
    """The angle between the two faces of each edge, in degrees."""
    half = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort((half[:, 1], half[:, 0]))
    face = np.repeat(np.arange(len(faces)), 3)[order]
    ordered = half[order]
    same = np.flatnonzero((ordered[1:] == ordered[:-1]).all(axis=1))
    one, other = normals[face[same]], normals[face[same + 1]]
    return np.degrees(np.arccos(np.clip((one * other).sum(axis=1), -1.0, 1.0)))


def open_edges(faces) -> int:
    """How many edges do not have exactly two faces."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return int((np.unique(edges, axis=0, return_counts=True)[1] != 2).sum())
