"""What a last rests on: the longest lower edge of its side view, and its tread across.

Points are in an approximate canonical pose: x heel to toe, z up, the ground near z = 0; mm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.samples import SurfaceSample
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.planes import Plane
from footfit.geometry.numeric.quantiles import area_quantile


@dataclass(frozen=True, slots=True)
class RestingSettings:
    """Everything numeric of the resting line; lengths over L.

    Attributes
    ----------
    reach : float
        A point that is higher is no bottom.
    facing : float
        Nor is one whose normal's z is above this.
    stations, share
        The side view's lower edge: the height below which this share of a station's points lie.
    some_points : int
        Of the whole surface: enough to find the line and the rise.
    contact_share : float
        Seat and tread touch the ground where this share of the area of their half lies below.
    near : float
        How near the ground the points lie whose middle is the place where seat or tread touches.
    waist : float
        Seat and tread are looked for behind and in front of this share of the bottom.
    tread : (2,)
        What levels a last across, beside the seat behind its touching place: from here to there in
        front of the place where the tread touches. The shank bends into the tread about that
        place, often along a slanting line: there is no level.
    width : float
        How near their parabolas the points lie that level the last across.
    heeled : (2,)
        The rise of the bottom over the resting line from which, and up to which, the resting line
        takes the place of the sole plane. Lasts with a heel of 0-20 mm rise .010-.020, those with
        60 mm .034-.058.
    """

    reach: float = 0.25
    facing: float = -0.3
    stations: int = 64
    share: float = 0.03
    fewest_points: int = 3
    some_points: int = 8000
    contact_share: float = 0.003
    near: float = 0.004
    waist: float = 0.40
    tread: tuple[float, float] = (0.05, 0.22)
    width: float = 0.012
    levelling_rounds: int = 4
    heeled: tuple[float, float] = (0.018, 0.028)


RESTING = RestingSettings()


@dataclass(frozen=True, slots=True)
class RestingLine:
    """The longest lower edge of a side view.

    ``contacts`` (2, 2) are x and z where it touches the seat and the tread, ``rise`` how far the
    bottom between them rises over it, ``summit`` the x of the rise.
    """

    contacts: Floats
    rise: float
    summit: float


def thinned(sample: SurfaceSample) -> SurfaceSample:
    """Every so many points of a sample, at most ``RESTING.some_points`` or twice as many."""
    step = max(1, len(sample.areas) // RESTING.some_points)
    return SurfaceSample(sample.points[::step], sample.normals[::step], sample.areas[::step])


def bottom_of(sample: SurfaceSample, ground: float, length: float) -> SurfaceSample:
    """The points of a sample that face down and lie low over a level ground."""
    points, normals = sample.points, sample.normals
    low = (points[:, 2] < ground + RESTING.reach * length) & (normals[:, 2] < RESTING.facing)
    return SurfaceSample(points[low], normals[low], sample.areas[low])


def resting_line(bottom: SurfaceSample) -> RestingLine | None:
    """The resting line of a bottom; None if there is too little of it."""
    edge = _lower_edge(bottom.points)
    hull = _lower_hull(edge)
    if len(hull) < 2:
        return None
    longest = int(np.diff(hull[:, 0]).argmax())
    contacts = hull[longest : longest + 2]
    inside = edge[(edge[:, 0] > contacts[0, 0]) & (edge[:, 0] < contacts[1, 0])]
    if not len(inside):
        return None
    over = inside[:, 1] - np.interp(inside[:, 0], *contacts.T)
    return RestingLine(contacts, float(over.max()), float(inside[over.argmax(), 0]))


def heeled_share(line: RestingLine | None, length: float) -> float:
    """How much of the plane is the resting plane: 0 for a low last, 1 for one with a heel."""
    if line is None:
        return 0.0
    low, high = RESTING.heeled
    share = float(np.clip((line.rise / length - low) / (high - low), 0.0, 1.0))
    return share * share * (3.0 - 2.0 * share)


def resting_plane(bottom: SurfaceSample, line: RestingLine, length: float) -> Plane:
    """The plane that a bottom rests on: along its resting line, level across its tread."""
    x, y, z = bottom.points.T
    (x_seat, z_seat), (x_tread, z_tread) = line.contacts
    along = float((z_tread - z_seat) / (x_tread - x_seat))
    height = z - z_seat - along * (x - x_seat)
    across = slope_across(bottom, height, length)
    height = height - across * y
    front = x > line.summit
    seat, tread = (
        area_quantile(height[half], bottom.areas[half], RESTING.contact_share)
        for half in (~front, front)
    )
    along += (tread - seat) / float(x_tread - x_seat)
    normal = np.array([-along, -across, 1.0]) / np.sqrt(1.0 + along**2 + across**2)
    return Plane(normal, area_quantile(bottom.points @ normal, bottom.areas, RESTING.contact_share))


def slope_across(bottom: SurfaceSample, height: Floats, length: float) -> float:
    """The slope in y that seat and tread share, whatever parabola in x each of them follows.

    A last stands level across its tread. Its shank and its arch are steep, and higher on one side:
    they do not count. ``height`` (n,) is that of the bottom over the ground, nearly.
    """
    x = bottom.points[:, 0]
    down = np.square(np.square(bottom.normals[:, 2])) * bottom.areas
    near = down * np.exp(-((height / (RESTING.near * length)) ** 2))
    front = x > area_quantile(x, bottom.areas, RESTING.contact_share) + RESTING.waist * length
    moment = near * x
    touching = [float(moment[half].sum() / max(near[half].sum(), 1e-9)) for half in (~front, front)]
    first, last = touching[1] + np.multiply(RESTING.tread, length)
    level = (x < touching[0]) | ((x > first) & (x < last))
    (x, y, z), tread = bottom.points[level].T, front[level]
    u, v = ((x - place) / length for place in touching)
    rows = np.column_stack([~tread, ~tread * u, tread, tread * v, tread * v * v, y])
    down = down[level]
    weights, solution = down, np.zeros(rows.shape[1])
    for _ in range(RESTING.levelling_rounds):
        weighted = rows * weights[:, None]
        solution = np.linalg.lstsq(weighted.T @ rows, weighted.T @ z, rcond=None)[0]
        weights = down * np.exp(-(((z - rows @ solution) / (RESTING.width * length)) ** 2))
    return float(solution[-1])


def _lower_edge(points: Floats) -> Floats:
    """The lower edge (k, 2), x and z, of the side view of points (n, 3), by stations along x."""
    x, z = points[:, 0], points[:, 2]
    if len(x) == 0:
        return np.empty((0, 2))
    place = ((x - x.min()) * (RESTING.stations / max(float(np.ptp(x)), 1e-9))).astype(np.int64)
    order = np.lexsort((z, place))
    starts = np.flatnonzero(np.append(True, np.diff(place[order]) != 0))
    counts = np.diff(np.append(starts, len(order)))
    many = counts >= RESTING.fewest_points
    chosen = order[(starts + RESTING.share * counts).astype(np.int64)[many]]
    return np.column_stack([x[chosen], z[chosen]])


def _lower_hull(edge: Floats) -> Floats:
    """The corners of the convex hull of (k, 2) from below, from left to right."""
    hull: list[Floats] = []
    for point in edge:
        while len(hull) > 1:
            (ax, az), (bx, bz) = hull[-2], hull[-1]
            if (bx - ax) * (point[1] - az) > (bz - az) * (point[0] - ax):
                break
            hull.pop()
        hull.append(point)
    return np.array(hull)
