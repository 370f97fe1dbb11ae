"""From a scan to the one foot or last in it: plate off, pieces told apart, rough pose found."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from footfit.errors import HalfScan, NotAFoot, SeveralFeet
from footfit.geometry.mesh.caps import extent_of
from footfit.geometry.mesh.topology import boundary_loops, is_closed
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.pose.facing import Facing, facing, lacks_its_sole
from footfit.geometry.pose.floor_plate import is_flat, without_plate
from footfit.geometry.pose.pieces import PIECES, comparable, gap, part_of, pieces, stand_apart
from footfit.geometry.pose.pose_search import SOLELESS, Orientation, orientation
from footfit.pipeline.scan.cleaning import PLATE_REMOVED, turned_notices
from footfit.pipeline.scan.shipped_templates import shipped_references
from footfit.results import Notice, Scan

_PIECES_REMOVED = Notice("pieces_removed", "pieces beside the foot were left out")

Windows = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class PosedShape:
    """A foot or last with its rough pose: mesh (provisional mm, file axes) and what was done.

    ``sheet``: it is a sheet, like a sole without the rest.
    """

    vertices: Floats
    faces: Ints
    orientation: Orientation
    sheet: bool
    notices: tuple[Notice, ...]


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
    body = _without_floor(scan)
    found = comparable(body.vertices, body.faces, body.pieces)
    if len(found) == 1:
        alone = _largest_with_near(body)
        shape = _oriented(alone.vertices, alone.faces, windows, alone.notices)
    else:
        shape = _the_one_foot(body, found, windows)
    if shape.orientation.accepted and shape.sheet:
        raise HalfScan("this is a sheet, like a scan of the sole alone; scan the whole foot")
    if not shape.orientation.accepted:
        raise NotAFoot(
            "neither a foot nor a last, as far as the shape tells"
            f" (cost {shape.orientation.cost:.2f}, margin {shape.orientation.margin:.2f}"
            f"{_opening_words(shape)}); check that the file holds one whole foot or last"
        )
    return shape


def _opening_words(shape: PosedShape) -> str:
    """How wide the surface is open, where that is wide enough to be a part of something."""
    rims = [shape.vertices[rim] for rim in boundary_loops(shape.faces)]
    widest = max((extent_of(rim) for rim in rims), default=0.0)
    share = widest / float(np.ptp(shape.vertices, axis=0).max())
    return f", open over {100 * share:.0f} % of its size" if share > PIECES.wide_open else ""


@dataclass(frozen=True, slots=True)
class _Body:
    """A mesh without its floor plate, its pieces' faces (largest first), and what was done."""

    vertices: Floats
    faces: Ints
    pieces: list[Ints]
    notices: tuple[Notice, ...]


def _without_floor(scan: Scan) -> _Body:
    """The scan without its plate, which may be a piece by itself or grown to the foot."""
    vertices, faces = scan.vertices_mm, scan.faces
    found = pieces(vertices, faces)
    if len(found) == 1 and without_plate(vertices, faces).all():
        return _Body(vertices, faces, found, ())
    flat = [is_flat(part_of(vertices, faces, piece)[0]) for piece in found]
    removed = any(flat) and not all(flat)
    if removed:
        found = [piece for piece, thin in zip(found, flat, strict=True) if not thin]
    kept = [part_of(vertices, faces, piece) for piece in found]
    masks = [without_plate(*mesh) for mesh in kept]
    removed = removed or not all(mask.all() for mask in masks)
    if not removed:
        return _Body(vertices, faces, found, ())
    # Cutting a plate away may leave crumbs and, where two feet stood on it, two pieces.
    chosen = np.sort(np.concatenate([p[mask] for p, mask in zip(found, masks, strict=True)]))
    vertices, faces = part_of(vertices, faces, chosen)
    return _Body(vertices, faces, pieces(vertices, faces), (PLATE_REMOVED,))


def _largest_with_near(body: _Body) -> _Body:
    """The largest piece with what lies close to it; lesser things beside it are left out."""
    if len(body.pieces) == 1:
        return body
    near = _near(body, part_of(body.vertices, body.faces, body.pieces[0])[0])
    if len(near) == len(body.pieces):
        return body
    vertices, faces = part_of(body.vertices, body.faces, np.sort(np.concatenate(near)))
    return _Body(vertices, faces, near, (*body.notices, _PIECES_REMOVED))


def _near(body: _Body, points: Floats) -> list[Ints]:
    """The pieces that come close to points (n, 3) of the shape, itself among them."""
    size = float(np.ptp(points, axis=0).max())
    return [
        piece
        for piece in body.pieces
        if gap(points, part_of(body.vertices, body.faces, piece)[0]) < PIECES.gap * size
    ]


def scans_in(scan: Scan, windows: Windows) -> list[Scan]:
    """Each foot or last that stands beside another in a scan as a scan of its own, largest first.

    The unit and the notices are the file's; the pose is known. Empty where there are not at least
    two: the scan is then one shape, or none.
    """
    body = _without_floor(scan)
    found = comparable(body.vertices, body.faces, body.pieces)
    if not 1 < len(found) <= PIECES.most_comparable:
        return []
    shapes = _feet(body, found, windows)
    if not _beside(shapes):
        return []
    beside = (_PIECES_REMOVED,) if len(body.pieces) > len(shapes) else ()
    return [_alone(scan, shape, i, beside) for i, shape in enumerate(shapes, start=1)]


def _alone(scan: Scan, shape: PosedShape, number: int, notices: tuple[Notice, ...]) -> Scan:
    """One shape of a scan as a scan. A sheet's pose is left out: it is refused as every sheet."""
    info = replace(
        scan.info,
        path=f"{scan.info.path or '-'}#{number}",
        vertices=len(shape.vertices),
        faces=len(shape.faces),
        watertight=is_closed(shape.faces),
    )
    return Scan(
        info=info,
        vertices_mm=shape.vertices,
        faces=shape.faces,
        warnings=(*scan.warnings, *shape.notices, *notices),
        pose=None if shape.sheet else shape.orientation,
    )


def _feet(body: _Body, found: list[Ints], windows: Windows) -> list[PosedShape]:
    """The pieces that each look like a foot or last, the largest first."""
    parts = (part_of(body.vertices, body.faces, piece) for piece in found)
    shapes = [_oriented(*part, windows, body.notices) for part in parts]
    return [shape for shape in shapes if shape.orientation.accepted]


def _beside(feet: list[PosedShape]) -> bool:
    """Does one of them stand beside another?"""
    pairs = combinations(feet, 2)
    return any(stand_apart(one.vertices, other.vertices) for one, other in pairs)


def _the_one_foot(body: _Body, found: list[Ints], windows: Windows) -> PosedShape:
    """The foot among comparable pieces, or the pieces together where they are one cracked scan."""
    if len(found) > PIECES.most_comparable:  # no shelf of feet: looking at each would take minutes
        return _oriented(body.vertices, body.faces, windows, body.notices)
    feet = _feet(body, found, windows)
    if _beside(feet):
        raise SeveralFeet(f"{len(feet)} feet or lasts in one file; add --split to take them apart")
    if not feet:
        return _oriented(body.vertices, body.faces, windows, body.notices)
    best = feet[0]  # the largest: of two shells of one surface always the same
    together = _near(body, best.vertices)
    if len(together) == 1:
        return replace(best, notices=(*best.notices, _PIECES_REMOVED))
    notices = (
        body.notices if len(together) == len(body.pieces) else (*body.notices, _PIECES_REMOVED)
    )
    chosen = np.sort(np.concatenate(together))
    whole = _oriented(*part_of(body.vertices, body.faces, chosen), windows, notices)
    if whole.orientation.accepted and whole.orientation.cost <= best.orientation.cost:
        return whole
    return replace(best, notices=(*best.notices, _PIECES_REMOVED))


def _oriented(
    vertices: Floats, faces: Ints, windows: Windows, notices: tuple[Notice, ...]
) -> PosedShape:
    """One mesh with its pose; its faces turned over where they look inward."""
    looks = facing(vertices, faces)
    turned = (*notices, *turned_notices(len(faces)))
    ways = []
    if looks.outward > -PIECES.inside_out:
        ways.append((faces, 1.0, notices))
    if looks.outward < PIECES.inside_out:
        ways.append((faces[:, [0, 2, 1]], -1.0, turned))
    shapes = [
        _wound(vertices, wound, windows, replace(looks, toward=sign * looks.toward), said)
        for wound, sign, said in ways
    ]
    return min(shapes, key=lambda shape: shape.orientation.cost)


def _wound(
    vertices: Floats, faces: Ints, windows: Windows, looks: Facing, notices: tuple[Notice, ...]
) -> PosedShape:
    """One mesh, wound as it is; where it fits badly, tried again as one without its sole."""
    references = shipped_references()
    found = orientation(vertices, faces, references, windows)
    if not found.accepted and looks.one_way > PIECES.shell:
        again = orientation(vertices, faces, references, windows, SOLELESS)
        if again.accepted and lacks_its_sole(looks.toward, looks.one_way, again.rotation[2]):
            found = again
    open_below = lacks_its_sole(looks.toward, looks.one_way, found.rotation[2])
    sheet = looks.one_way > PIECES.sheet and not open_below
    return PosedShape(vertices, faces, found, sheet, notices)
