"""Whether a part of a shape is missing: the heel, the toes, one side, all but the sole."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.mesh.samples import SurfaceSample
from footfit.geometry.numeric.arrays import Floats

Missing = Literal["heel", "toes", "side", "upper part"]


@dataclass(frozen=True, slots=True)
class EndSettings:
    """Everything numeric of the cuts; lengths over L, areas over L squared."""

    height: float = 0.30
    reach: float = 0.10
    facing: float = 0.94
    flat_area: float = 0.03  # a heel or a square toe has .005-.02, a cut across .05-.09
    rim_width: float = 0.18
    rim_height: float = 0.08
    open_area: float = 0.015  # seen along X: toes cut off at .92 L have .016-.025
    doubtful_area: float = 0.004  # toes cut off at .98 L have .004-.009, a hole of 24 mm .005
    slant_area: float = 0.010  # the same of one loop that only reaches the end
    long_rim: float = 0.26  # a longer loop is the rim of a missing sole or leg, and no hole
    low_end: float = 0.20  # higher a rim is that of a leg
    on_rim: float = 0.001  # such a rim this near to the end has cut the end off
    side_low: float = 0.06  # half a foot's rim reaches lower than this
    side_high: float = 0.18  # and higher than this
    side_area: float = 0.06  # seen along Y: half a foot has .15 or more
    side_facing: float = 0.985
    side_reach: float = 0.02
    least_height: float = 0.145  # a lower shape is only a sole: a leg cut at 50 mm, L 340 mm


ENDS = EndSettings()


def missing_part(
    sample: SurfaceSample, rims: list[Floats], length: float, back_height: float = ENDS.height
) -> Missing | None:
    """What was cut off a canonical shape: closed by a flat face, or left open.

    Parameters
    ----------
    sample : SurfaceSample
        The whole surface, canonical.
    rims : list of (n, 3) float64
        The mesh's boundary loops, canonical; none for a closed mesh.
    length : float
    back_height : float
        Over the length; what is higher is no heel.
    """
    for name, end, height in _ends(sample, length, back_height):
        if _is_cut_off(sample, rims, end, length, height):
            return name
    if float(sample.points[:, 2].max()) < ENDS.least_height * length:
        return "upper part"
    half = any(_is_half(rim, length) for rim in rims)
    if half or _flat_side(sample, length) > ENDS.side_area * length**2:
        return "side"
    return None


def doubtful_end(
    sample: SurfaceSample,
    points: Floats,
    rims: list[Floats],
    length: float,
    back_height: float = ENDS.height,
) -> Literal["heel", "toes"] | None:
    """The end of a canonical shape that is open over so much that its length may be short.

    Parameters
    ----------
    sample : SurfaceSample
        The whole surface, canonical.
    points : (n, 3) float64
        The mesh's vertices, canonical.
    rims : list of (k, 3) float64
        The mesh's boundary loops.
    length : float
    back_height : float
        Over the length; what is higher is no heel.
    """
    for name, end, _ in _ends(sample, length, back_height):
        if _open_area(rims, end, length) > ENDS.doubtful_area * length**2:
            return name
        outward = -1.0 if name == "heel" else 1.0
        if any(_is_oblique(rim, end, length) for rim in rims):
            return name
        if any(_is_reached(rim, points, outward, length) for rim in rims):
            return name
    return None


def _is_oblique(rim: Floats, end: float, length: float) -> bool:
    """Whether a loop that cuts slantwise through an end comes down to the floor there."""
    there = np.abs(rim[:, 0] - end) < ENDS.reach * length
    there &= rim[:, 2] < ENDS.side_low * length
    return bool(there.any() and abs(_vector_area(rim)[0]) > ENDS.slant_area * length**2)


def _is_reached(rim: Floats, points: Floats, outward: float, length: float) -> bool:
    """Whether an end lies on the rim of a missing sole: the shape goes on where it was cut."""
    if float(np.ptp(rim[:, 0])) < ENDS.long_rim * length:
        return False
    farthest, reached = (
        (outward * place[place[:, 2] < ENDS.low_end * length, 0]).max(initial=-np.inf)
        for place in (points, rim)
    )
    return bool(reached > farthest - ENDS.on_rim * length)


def _ends(
    sample: SurfaceSample, length: float, back_height: float
) -> tuple[tuple[Literal["heel"], float, float], tuple[Literal["toes"], float, float]]:
    """The rearmost and the foremost x below the heights over which there is leg, and these."""
    x, z = sample.points[:, 0], sample.points[:, 2]
    back, front = x[z < back_height * length], x[z < ENDS.height * length]
    heel, toes = float(back.min()), float(front.max())
    return ("heel", heel, back_height), ("toes", toes, ENDS.height)


def _is_cut_off(
    sample: SurfaceSample, rims: list[Floats], end: float, length: float, height: float
) -> bool:
    """Whether the end at x = ``end`` is a flat face, or open as wide and as high as an end is."""
    below, reach = height * length, ENDS.reach * length
    flat = (sample.points[:, 2] < below) & (np.abs(sample.normals[:, 0]) > ENDS.facing)
    flat &= np.abs(sample.points[:, 0] - end) < reach
    if sample.areas[flat].sum() > ENDS.flat_area * length**2:
        return True
    for rim in rims:
        part = rim[(np.abs(rim[:, 0] - end) < reach) & (rim[:, 2] < below)]
        if len(part):
            _, width, tall = np.ptp(part, axis=0)
            if width > ENDS.rim_width * length and tall > ENDS.rim_height * length:
                return True
    return _open_area(rims, end, length) > ENDS.open_area * length**2


def _open_area(rims: list[Floats], end: float, length: float) -> float:
    """The area, seen along X, of the loops near an end: five cut toes leave five loops."""
    near = [
        rim
        for rim in rims
        if abs(float(rim[:, 0].mean()) - end) < ENDS.reach * length
        and rim[:, 2].max() < ENDS.height * length
    ]
    return float(sum(abs(_vector_area(rim)[0]) for rim in near))


def _is_half(rim: Floats, length: float) -> bool:
    """Whether a loop runs along the foot both low and high: a side is open, not a leg or sole."""
    low, high = rim[:, 2].min(), rim[:, 2].max()
    if low > ENDS.side_low * length or high < ENDS.side_high * length:
        return False
    return bool(abs(_vector_area(rim)[1]) > ENDS.side_area * length**2)


def _flat_side(sample: SurfaceSample, length: float) -> float:
    """The larger area of the flat face, if any, that ends the shape medially or laterally."""
    low = sample.points[:, 2] < ENDS.height * length
    y, across = sample.points[low, 1], sample.normals[low, 1]
    reach = ENDS.side_reach * length
    areas = [
        sample.areas[low][(sign * across > ENDS.side_facing) & (np.abs(y - end) < reach)].sum()
        for sign, end in ((1.0, y.max()), (-1.0, y.min()))
    ]
    return float(max(areas))


def _vector_area(loop: Floats) -> Floats:
    """The area (3,) that a closed polygon encloses, seen along each axis."""
    away = loop - loop.mean(axis=0)
    return np.asarray(0.5 * np.cross(away, np.roll(away, -1, axis=0)).sum(axis=0))
