"""From a scan to the one foot or last in it: plate off, pieces told apart, rough pose found."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np

from footfit.errors import HalfScan, NotAFoot, SeveralFeet
from footfit.geometry.mesh.caps import extent_of
from footfit.geometry.mesh.topology import boundary_loops, is_closed
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points, transform
from footfit.geometry.pose.facing import Facing, facing, lacks_its_sole
from footfit.geometry.pose.floor_plate import is_flat, without_plate
from footfit.geometry.pose.openings import Openings
from footfit.geometry.pose.pieces import (
    PIECES,
    Piece,
    comparable_pieces,
    near_pieces,
    part_of,
    pieces,
    stand_apart,
)
from footfit.geometry.pose.toes import has_toes
from footfit.geometry.search.pose_search import SOLELESS, RoughPose, Windows, rough_pose
from footfit.pipeline.scan.cleaning import PLATE_REMOVED, turned_notices
from footfit.pipeline.scan.shipped_templates import shipped_templates
from footfit.results import KindName, KindWord, Notice, Scan

SURE_KIND = 0.08
"""A shape that fits one kind so much better than the other is surely of it (decision 0224)."""
TOELESS_KIND = 0.15
"""A shape that fits a last so much better than a foot is not looked at for toes."""
_PIECES_REMOVED = Notice("pieces_removed", "pieces beside the foot were left out")


@dataclass(frozen=True, slots=True)
class PosedShape:
    """A foot or last with its rough pose: mesh (provisional mm, file axes) and what was done.

    ``sheet``: it is a sheet, like a sole without the rest.
    """

    vertices: Floats
    faces: Ints
    pose: RoughPose
    sheet: bool
    notices: tuple[Notice, ...]

    def with_kind(self, kind: KindName | Literal["auto"]) -> tuple[PosedShape, KindWord]:
        """The shape with a kind that is given or settled, and how sure it is.

        A shape that fits a last about as well as a foot is surely a foot if it has toes.
        """
        if kind != "auto":
            return replace(self, pose=replace(self.pose, kind=kind)), "given"
        pose = self.pose
        if pose.kind_margin <= (SURE_KIND if pose.kind == "foot" else TOELESS_KIND):
            about = moved_points(transform(pose.rotation, pose.shift), self.vertices) / pose.length
            if has_toes(about, self.faces):
                return replace(self, pose=replace(pose, kind="foot")), "sure"
        return self, "sure" if pose.kind_margin > SURE_KIND else "low"


def shape_in(scan: Scan, windows: Windows) -> PosedShape:
    """The one foot or last of a scan, with its rough pose.

    Parameters
    ----------
    scan : Scan
    windows : pairs of float
        Plausible lengths in the scan's provisional mm; empty: any.

    Raises
    ------
    SeveralFeet
        If two comparable pieces beside each other each look like a foot or last.
    HalfScan
        If it is a sheet: a sole without the rest.
    NotAFoot
        If nothing in it looks like a foot or last.
    """
    if scan.pose is not None:
        return PosedShape(scan.vertices_mm, scan.faces, scan.pose, False, ())
    body = _without_plate(scan)
    alike = comparable_pieces(body.parts)
    if len(alike) == 1:
        shape = _gathered(body, near_pieces(body.parts, alike[0].vertices), windows)
    else:
        shape = _the_one_foot(body, alike, windows)
    if not shape.pose.accepted:
        raise _no_foot(shape)
    if shape.sheet:
        raise HalfScan("this is a sheet, like a scan of the sole alone: scan the whole foot")
    return shape


def scans_in(scan: Scan, windows: Windows) -> list[Scan]:
    """Each foot or last that stands beside another in a scan as a scan of its own, largest first.

    The unit and the notices are the file's; the pose is known. Empty if there are not at least
    two: the scan is then one shape, or none.
    """
    body = _without_plate(scan)
    alike = comparable_pieces(body.parts)
    if not 1 < len(alike) <= PIECES.most_comparable:
        return []
    shapes = _shapes_among(alike, windows, body.notices)
    if not _beside(shapes):
        return []
    notices = scan.warnings + ((_PIECES_REMOVED,) if len(body.parts) > len(shapes) else ())
    return [_alone(scan, shape, i, notices) for i, shape in enumerate(shapes, start=1)]


def _alone(scan: Scan, shape: PosedShape, number: int, notices: tuple[Notice, ...]) -> Scan:
    """One shape of a scan as a scan. A sheet has no pose yet: it is refused as every sheet is."""
    info = replace(
        scan.info,
        path=f"{scan.info.path or '-'}#{number}",
        vertices=len(shape.vertices),
        faces=len(shape.faces),
        watertight=is_closed(shape.faces),
    )
    pose = None if shape.sheet else shape.pose
    return Scan(info, shape.vertices, shape.faces, notices + shape.notices, pose=pose)


def _no_foot(shape: PosedShape) -> NotAFoot:
    """What to say of a shape that fits no template; one that is wide open is a part of something.

    The numbers behind it are the error's details.
    """
    rims = [shape.vertices[rim] for rim in boundary_loops(shape.faces)]
    widest = max((extent_of(rim) for rim in rims), default=0.0)
    share = widest / float(np.ptp(shape.vertices, axis=0).max())
    numbers = f"cost {shape.pose.cost:.2f}, margin {shape.pose.margin:.2f}"
    if share > PIECES.wide_open:
        numbers += f", open over {100 * share:.0f} % of its size"
        words = "part of the foot is missing; scan again"
    else:
        words = "the shape is neither a foot nor a last: check that the file holds one of them"
    return NotAFoot(words, details=numbers)


@dataclass(frozen=True, slots=True)
class _Body:
    """A mesh without its floor plate, its pieces (largest first), and what was done."""

    vertices: Floats
    faces: Ints
    parts: list[Piece]
    notices: tuple[Notice, ...] = ()


def _without_plate(scan: Scan) -> _Body:
    """The scan without its plate, which may be a piece by itself or grown to the foot."""
    vertices, faces = scan.vertices_mm, scan.faces
    parts = pieces(vertices, faces)
    thick = [part for part in parts if not is_flat(part.vertices)] or parts
    masks = [without_plate(part.vertices, part.faces) for part in thick]
    if len(thick) == len(parts) and all(mask.all() for mask in masks):
        return _Body(vertices, faces, parts)
    # Cutting a plate away may leave crumbs and, if two feet stood on it, two pieces.
    rows = [part.rows[mask] for part, mask in zip(thick, masks, strict=True)]
    vertices, faces = part_of(vertices, faces, np.sort(np.concatenate(rows)))
    return _Body(vertices, faces, pieces(vertices, faces), (PLATE_REMOVED,))


def _gathered(body: _Body, parts: list[Piece], windows: Windows) -> PosedShape:
    """Some pieces of a body as one shape with its pose; what is left out is said."""
    if len(parts) == len(body.parts):
        return _posed(body.vertices, body.faces, windows, body.notices)
    rows = np.sort(np.concatenate([part.rows for part in parts]))
    notices = (*body.notices, _PIECES_REMOVED)
    return _posed(*part_of(body.vertices, body.faces, rows), windows, notices)


def _the_one_foot(body: _Body, alike: list[Piece], windows: Windows) -> PosedShape:
    """The foot among comparable pieces, or the pieces together if they are one cracked scan."""
    whole_body = body.vertices, body.faces, windows, body.notices
    if len(alike) > PIECES.most_comparable:  # trying each takes minutes
        return _posed(*whole_body)
    feet = _shapes_among(alike, windows, body.notices)
    if _beside(feet):
        raise SeveralFeet(
            f"the file holds {len(feet)} feet or lasts: save each in a file of its own"
        )
    if not feet:
        return _posed(*whole_body)
    best = feet[0]  # the largest, so of two shells of one surface it is always the same
    together = near_pieces(body.parts, best.vertices)
    if len(together) > 1:
        whole = _gathered(body, together, windows)
        goes_on = any(stand_apart(best.vertices, part.vertices) for part in together)
        more = PIECES.hinged_beside if goes_on else PIECES.hinged
        if whole.pose.accepted and whole.pose.cost <= best.pose.cost + more:
            return whole
    return replace(best, notices=(*best.notices, _PIECES_REMOVED))


def _shapes_among(
    parts: list[Piece], windows: Windows, notices: tuple[Notice, ...]
) -> list[PosedShape]:
    """The pieces that each look like a foot or last, the largest first."""
    shapes = [_posed(part.vertices, part.faces, windows, notices) for part in parts]
    return [shape for shape in shapes if shape.pose.accepted]


def _beside(shapes: list[PosedShape]) -> bool:
    """Whether one of them stands beside another."""
    pairs = combinations(shapes, 2)
    return any(stand_apart(first.vertices, second.vertices) for first, second in pairs)


def _posed(
    vertices: Floats, faces: Ints, windows: Windows, notices: tuple[Notice, ...]
) -> PosedShape:
    """One mesh with its pose; its faces turned over if they look inward, or seem to."""
    looks = facing(vertices, faces)
    shapes = []
    if looks.outward > -PIECES.inside_out:
        shapes.append(_wound(vertices, faces, windows, looks, notices))
    if looks.outward < PIECES.inside_out:
        notices = (*notices, *turned_notices(len(faces)))
        turned = replace(looks, toward=-looks.toward)
        shapes.append(_wound(vertices, faces[:, [0, 2, 1]], windows, turned, notices))
    return min(shapes, key=lambda shape: shape.pose.cost)


def _wound(
    vertices: Floats, faces: Ints, windows: Windows, looks: Facing, notices: tuple[Notice, ...]
) -> PosedShape:
    """One mesh, wound as it is, with its pose; first with lids on it if its sole seems missing."""
    openings = Openings.of(vertices, faces) if looks.one_way > PIECES.closed else Openings.none()
    pose = None
    if looks.one_way > PIECES.shell:
        pose = _pose_with_lids(vertices, faces, windows, openings)
    if pose is not None and pose.kind == "last":
        # A lid at 15 mm makes a foot as flat below as a last. It is one only if both fits say so.
        other = rough_pose(vertices, faces, shipped_templates(), windows, SOLELESS)
        fits = pose.cost <= PIECES.lidded_last
        pose = replace(pose, kind=other.kind if fits else "foot")
    if pose is None:
        pose = rough_pose(vertices, faces, shipped_templates(), windows)
        if not (pose.accepted and openings.look_up_and_down(pose.rotation[2])):
            pose = _pose_with_lids(vertices, faces, windows, openings) or pose
        if looks.one_way > PIECES.shell and not (pose.accepted and pose.kind == "foot"):
            pose = _pose_without_sole(vertices, faces, windows, looks) or pose
    sheet = looks.one_way > PIECES.sheet and not lacks_its_sole(looks, pose.rotation[2])
    return PosedShape(vertices, faces, pose, sheet, notices)


def _pose_without_sole(
    vertices: Floats, faces: Ints, windows: Windows, looks: Facing
) -> RoughPose | None:
    """The pose of a shape in which the template's sole is not looked for, if its sole is missing.

    Without its sole a foot is as near to a last as to a foot. It is a last only if it fits well.
    """
    pose = rough_pose(vertices, faces, shipped_templates(), windows, SOLELESS)
    if not (pose.accepted and lacks_its_sole(looks, pose.rotation[2])):
        return None
    return replace(pose, kind="foot") if pose.cost > PIECES.soleless_last else pose


def _pose_with_lids(
    vertices: Floats, faces: Ints, windows: Windows, openings: Openings
) -> RoughPose | None:
    """The pose of a shape with a lid on each opening, if that shows that it lacks its sole.

    Without lids a foot without its sole may fit a last better, and below a long leg it is a tube
    with two open ends, which passes for a foot when it lies down.
    """
    if not openings.rims:
        return None
    closed = openings.closed(vertices, faces)
    pose = rough_pose(*closed, shipped_templates(), windows, ends=openings.directions)
    up = pose.rotation[2]
    likely = openings.look_up_and_down(up) and openings.lack_a_sole(up)
    return pose if pose.accepted and likely else None
