"""From a scan to the one shape in it: plate off, pieces told apart, faces outward, pose found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import HalfScan, NotAFoot, SeveralFeet
from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.feet import (
    PIECES,
    comparable,
    gap,
    is_sheet,
    outwardness,
    part_of,
    pieces,
    stand_apart,
)
from footfit.geometry.orientation import Orientation, orientation
from footfit.geometry.plate import is_flat, without_plate
from footfit.pipeline.references import shipped_references
from footfit.results import Notice, Scan

_STRAYS = Notice("pieces_removed", "pieces beside the foot were left out")

Windows = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Posed:
    """The one foot or last of a scan: mesh (provisional mm, file axes), its pose, what was done."""

    vertices: Floats
    faces: Ints
    orientation: Orientation
    notices: tuple[Notice, ...]


def posed(scan: Scan, windows: Windows) -> Posed:
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
    body = _without_floor(scan)
    found = comparable(body.vertices, body.faces, body.pieces)
    if len(found) == 1:
        alone = _without_strays(body)
        shape = _oriented(alone.vertices, alone.faces, windows, alone.notices)
    else:
        shape = _the_one_foot(body, found, windows)
    if is_sheet(shape.vertices, shape.faces):
        raise HalfScan("this is a sheet, like a scan of the sole alone; scan the whole foot")
    if not shape.orientation.accepted:
        raise NotAFoot(
            "neither a foot nor a last, as far as the shape tells"
            f" (cost {shape.orientation.cost:.2f}, margin {shape.orientation.margin:.2f});"
            " check that the file holds one whole foot or last"
        )
    return shape


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
    notice = Notice("plate_removed", "a floor plate was cut away")
    return _Body(vertices, faces, pieces(vertices, faces), (notice,))


def _without_strays(body: _Body) -> _Body:
    """The largest piece with what lies close to it; lesser things beside it are left out."""
    largest = part_of(body.vertices, body.faces, body.pieces[0])[0]
    size = float(np.ptp(largest, axis=0).max())
    near = [
        piece
        for piece in body.pieces
        if gap(largest, part_of(body.vertices, body.faces, piece)[0]) < PIECES.gap * size
    ]
    if len(near) == len(body.pieces):
        return body
    vertices, faces = part_of(body.vertices, body.faces, np.sort(np.concatenate(near)))
    return _Body(vertices, faces, near, (*body.notices, _STRAYS))


def _the_one_foot(body: _Body, found: list[Ints], windows: Windows) -> Posed:
    """The foot among comparable pieces, or the pieces together where they are one cracked scan."""
    shapes = [
        _oriented(*part_of(body.vertices, body.faces, piece), windows, body.notices)
        for piece in found
    ]
    feet = [shape for shape in shapes if shape.orientation.accepted]
    if any(
        stand_apart(one.vertices, other.vertices)
        for place, one in enumerate(feet)
        for other in feet[place + 1 :]
    ):
        raise SeveralFeet(f"{len(feet)} feet or lasts in one file; give each its own file")
    whole = _oriented(body.vertices, body.faces, windows, body.notices)
    if not feet:
        return whole
    best = min(feet, key=lambda shape: shape.orientation.cost)
    if whole.orientation.accepted and whole.orientation.cost <= best.orientation.cost:
        return whole
    return Posed(best.vertices, best.faces, best.orientation, (*best.notices, _STRAYS))


def _oriented(
    vertices: Floats, faces: Ints, windows: Windows, notices: tuple[Notice, ...]
) -> Posed:
    """One mesh with its pose; turned inside out where its faces look inward."""
    references = shipped_references()
    outward = outwardness(vertices, faces)
    inverted = faces[:, [0, 2, 1]]
    turned = (*notices, Notice("winding_fixed", "the faces looked inward and were turned"))
    if outward < -PIECES.inside_out:
        return Posed(
            vertices, inverted, orientation(vertices, inverted, references, windows), turned
        )
    as_is = Posed(vertices, faces, orientation(vertices, faces, references, windows), notices)
    if outward > PIECES.inside_out:
        return as_is
    other = Posed(vertices, inverted, orientation(vertices, inverted, references, windows), turned)
    return min(as_is, other, key=lambda shape: shape.orientation.cost)
