"""A parametric shoe last whose plan centre line, and so whose flare, is known.

What is planted
---------------
A last is drawn straight, in coordinates (s along, d across, z up), and then bent in plan along
a curve c(s) of known heading: the point (s, d, z) goes to (c(s) + d n(s), z). Every section
normal to c is therefore the straight section unchanged. In it the widest row of the wall is
at d = +w(s) and d = -w(s), lies less than 0.10 L above the section's lowest point, and is an
edge row of the mesh. So c is, by construction, *the mid-point of the two extremes of the lower
band, normal to itself*: the definition of the flare's centre line, without any smoothing.

What makes the two sides of a real outline differ in plan (medial waist cut, MT1 ahead of
MT5, the toe turned to the big toe) is planted in c itself: a cut of depth 2o on the medial side
is a centre line moved by o to the lateral side and a half width less by o. With
:func:`plain` these are zero and c is one smooth bend. What differs above or under the widest
row (instep ridge, arch, the feather line's cut at the waist) leaves c alone.

A last may also be bent as it stands (``LastSpec.bent_standing``): then s and z are those of the
standing last, c is the mid-point of the widest row there, and seat and tread are level across.

Canonical pose of a right last: x from heel to toe, y medial positive, z up, z = 0 the
resting plane (it touches the seat and the tread, level across), x = 0 the rearmost point, y = 0 the
heel's middle; x runs along the principal plan axis. A left last is the mirror image.

Examples
--------
>>> vertices_mm, faces = last_mesh(LastSpec(length_mm=270.0, flare_deg=6.0, rings=40, segments=32))
>>> round(float(np.ptp(vertices_mm[:, 0])), 6)
270.0
>>> round(true_flare_deg(LastSpec(flare_deg=6.0)), 6)
6.0
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from tools.last_profiles import (
    Draft,
    SideView,
    Widths,
    bell,
    crest_shape,
    eased,
    side_view,
    wall_window,
    widths,
)
from tools.last_specs import LastSpec, graded, plain, share, varied
from tools.resting import at_rest, pitched

__all__ = [
    "LastSpec",
    "centre_line_mm",
    "graded",
    "half_width_mm",
    "last_mesh",
    "plain",
    "true_flare_deg",
    "true_heading_deg",
    "varied",
]


REARFOOT = (0.08, 0.30)  # stations whose mean heading is the flare angle's base
FOREFOOT = (0.55, 0.80)
_GRID = np.linspace(-0.1, 1.1, 4801)  # stations on which the planted heading is integrated


# ------------------------------------------------------------------ the planted curve


def _bell_slope(s: Floats, centre: float, sd: float) -> Floats:
    return (centre - s) / sd**2 * bell(s, centre, sd)


def _offset_slope(spec: LastSpec, s: Floats) -> Floats:
    """Slope of the centre line's own wave: half the difference of the two sides' outlines."""
    bulge = share(spec, "joint_bulge_mm")
    joints = _bell_slope(s, spec.mt1_station, 0.09) - _bell_slope(s, spec.mt5_station, 0.09)
    cut = share(spec, "waist_cut_mm") * _bell_slope(s, 0.42, 0.085)
    return 0.5 * (bulge * joints - cut)


def _ramp(s: Floats, centre: float, width: float) -> Floats:
    return 0.5 * (1.0 + np.tanh((s - centre) / width))


def _window_mean(values: Floats, window: tuple[float, float]) -> float:
    """Mean over a window of stations of values given on ``_GRID`` (exact for the interpolant)."""
    steps = np.diff(_GRID) * 0.5 * (values[1:] + values[:-1])
    integral = np.concatenate(([0.0], np.cumsum(steps)))
    low, high = np.interp(window, _GRID, integral)
    return float((high - low) / (window[1] - window[0]))


def _window_change(values: Floats) -> float:
    return _window_mean(values, FOREFOOT) - _window_mean(values, REARFOOT)


def _heading(spec: LastSpec) -> Floats:
    """The planted heading (radians) on ``_GRID``, before the last is turned onto its axis."""
    bend = _ramp(_GRID, 0.45, 0.14)
    toe = np.radians(spec.toe_turn_deg) * _ramp(_GRID, 0.87, 0.05)
    wave = toe + np.arctan(_offset_slope(spec, _GRID))
    amount = (np.radians(spec.flare_deg) - _window_change(wave)) / _window_change(bend)
    heading: Floats = amount * bend + wave
    return heading


@dataclass(frozen=True, slots=True)
class _Plan:
    """The planted curve over the length, and what brings it into the canonical pose.

    ``pitch`` (radians) leads from the resting last to the pose that is bent. There the widest row
    begins at ``start`` and is ``span`` long, over the length of the resting last.
    """

    pitch: float
    start: float
    span: float
    heading: Floats
    x: Floats
    y: Floats
    half: Floats
    scale: float
    origin: tuple[float, float]

    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        """x, y (over the length) and heading (radians) at stations ``s``."""
        x, y, heading = (np.interp(s, _GRID, v) for v in (self.x, self.y, self.heading))
        return x, y, heading


def _curve(heading: Floats) -> tuple[Floats, Floats]:
    steps = np.diff(_GRID)
    middle = 0.5 * (heading[1:] + heading[:-1])
    x = np.concatenate(([0.0], np.cumsum(steps * np.cos(middle))))
    y = np.concatenate(([0.0], np.cumsum(steps * np.sin(middle))))
    return x - float(np.interp(0.0, _GRID, x)), y - float(np.interp(0.0, _GRID, y))


def _plan(spec: LastSpec, half_width: Floats) -> _Plan:
    """The curve turned so that the principal axis of the plan outline is x, and its scale.

    ``half_width`` is given on ``_GRID``; the plan figure is the strip of that half width.
    """
    view = _side_view(spec)
    pitch = float(np.radians(view.pitch_deg)) if spec.bent_standing else 0.0
    along = np.cos(pitch) * _GRID + np.sin(pitch) * view.widest(_GRID)
    start, end = (float(np.interp(s, _GRID, along)) for s in (0.0, 1.0))
    span = end - start
    half_width = np.interp(_GRID, (along - start) / span, half_width) / span
    heading = _heading(spec)
    yaw = 0.0
    for _ in range(4):
        heading = heading - yaw
        x, y = _curve(heading)
        weight = half_width * np.gradient(_GRID)
        x0, y0 = np.average(x, weights=weight), np.average(y, weights=weight)
        across = half_width**2 / 3.0  # the strip's own second moment, along its normal
        sxx = np.sum(weight * ((x - x0) ** 2 + across * np.sin(heading) ** 2))
        syy = np.sum(weight * ((y - y0) ** 2 + across * np.cos(heading) ** 2))
        sxy = np.sum(weight * ((x - x0) * (y - y0) - across * np.sin(heading) * np.cos(heading)))
        yaw = 0.5 * float(np.arctan2(2.0 * sxy, sxx - syy))
    inside = half_width > 0.0
    edges = np.concatenate([x - side * half_width * np.sin(heading) for side in (-1, 1)])
    ends = edges[np.tile(inside, 2)]
    heel = (_GRID >= 0.02) & (_GRID <= 0.10)
    origin = float(ends.min()), float(y[heel].mean())
    return _Plan(pitch, start, span, heading, x, y, half_width, 1.0 / float(np.ptp(ends)), origin)


def _planted(spec: LastSpec) -> tuple[_Plan, Widths]:
    shape = widths(
        _GRID,
        ball=share(spec, "ball_width_mm"),
        heel=share(spec, "heel_width_mm"),
        waist=share(spec, "waist_width_mm"),
        toe_shape=spec.toe_shape,
    )
    return _plan(spec, shape.half), shape


def true_heading_deg(spec: LastSpec, s: Floats) -> Floats:
    """Heading of the planted centre line of the right last, in degrees against x.

    Parameters
    ----------
    spec : LastSpec
    s : (n,) array
        Stations: the share of the planted curve's arc length, 0 at the heel, 1 at the toe.

    Returns
    -------
    (n,) array
        Degrees, + towards medial.
    """
    heading: Floats = np.degrees(_planted(spec)[0].at(np.asarray(s, dtype=float))[2])
    return heading


def true_flare_deg(spec: LastSpec) -> float:
    """Mean planted heading over stations .55-.80 minus that over .08-.30, in degrees."""
    return float(np.degrees(_window_change(_planted(spec)[0].heading)))


def centre_line_mm(spec: LastSpec, s: Floats) -> Floats:
    """The planted centre line of the right last: (n, 2), x and y.

    In the pose of :func:`last_mesh`, or in that of :func:`standing` if the last was bent there.
    """
    plan, _ = _planted(spec)
    x, y, _ = plan.at(np.asarray(s, dtype=float))
    return np.column_stack([x - plan.origin[0], y - plan.origin[1]]) * _unit_mm(spec, plan)


def half_width_mm(spec: LastSpec, s: Floats) -> Floats:
    """Half the distance of the band's two extremes, normal to the centre line: (n,) in mm."""
    plan, _ = _planted(spec)
    half: Floats = np.interp(np.asarray(s, dtype=float), _GRID, plan.half)
    return half * _unit_mm(spec, plan)


def _unit_mm(spec: LastSpec, plan: _Plan) -> float:
    """How many mm a unit of the planted curve is."""
    if spec.bent_standing:
        return plan.span * _placed(spec).unit_mm
    return plan.scale * spec.length_mm


# ------------------------------------------------------------------ the straight last


def _stations(rings: int) -> Floats:
    """``rings`` + 1 stations from heel to toe, closer where the ends round off."""
    t = np.linspace(0.0, 1.0, rings + 1)
    return 0.25 * t + 0.75 * 0.5 * (1.0 - np.cos(np.pi * t))


@dataclass(frozen=True, slots=True)
class _Straight:
    """What the ribs are drawn from, per station (n,) and over the length."""

    s: Floats
    half: Floats
    cap: Floats
    view: SideView
    spec: LastSpec


def _along(straight: _Straight, rise: Floats, foot: Floats) -> Floats:
    """Where a rib's points lie along the last: at the ends the wall leans, rounds and tucks in.

    ``rise`` is 0 at the widest row and 1 at the crest, ``foot`` 0 there and 1 at the feather.
    """
    s = straight.s[:, None]
    heel = np.clip(1.0 - s / 0.30, 0.0, 1.0) ** 3
    toe = np.clip(1.0 - (1.0 - s) / 0.24, 0.0, 1.0) ** 3
    back = 0.040 * rise**1.5 * (1.3 - 0.3 * rise) + 0.016 * foot**2
    front = 0.062 * (1.0 - np.sqrt(1.0 - np.minimum(rise, 1.0) ** 2)) + 0.010 * foot**2
    along: Floats = s + heel * back - toe * front
    return along


def _resampled(points: Floats, count: int) -> Floats:
    """Each rib of (n, p, 3) cut anew into ``count`` + 1 points at equal arc length."""
    steps = np.linalg.norm(np.diff(points, axis=1), axis=2)
    arc = np.concatenate([np.zeros((len(points), 1)), np.cumsum(steps, axis=1)], axis=1)
    share_of = np.linspace(0.0, 1.0, count + 1)
    out = np.empty((len(points), count + 1, 3))
    for i, (rib, length) in enumerate(zip(points, arc, strict=True)):
        for k in range(3):
            out[i, :, k] = np.interp(share_of * length[-1], length, rib[:, k])
    return out


def _upper(straight: _Straight, sign: float, count: int) -> Floats:
    """The wall from the widest row to the crest: (n, count + 1, 3) as (s, d, z)."""
    rise = 1.0 - (1.0 - np.linspace(0.0, 1.0, 121)) ** 2
    rise = rise[None, :] * np.ones((len(straight.s), 1))
    s = _along(straight, rise, np.zeros_like(rise))
    spec = straight.spec
    keep, power, ridge = crest_shape(straight.s, spec.cone_length, spec.cone_width)
    if sign > 0:
        upright = spec.medial_wall * wall_window(straight.s)
        keep, power = keep + upright * (1.0 - keep), power + upright * (3.0 - power)
    taper = 1.0 - (1.0 - keep[:, None]) * rise**1.6 * (1.5 - 0.5 * rise)
    d = straight.half[:, None] * taper * np.sqrt(1.0 - rise ** power[:, None])
    swing = share(straight.spec, "ridge_mm") * ridge[:, None] * rise**2
    low = straight.view.widest(s)
    z = low + (straight.view.crest(s[:, -1])[:, None] - low) * rise
    swing = swing * np.minimum(1.0, straight.half[:, None] / 0.1)
    if spec.shaft_mm > 0.0:  # upright where the boot stands, so that at rest it leans back
        s = s - np.tan(np.radians(straight.view.pitch_deg)) * np.clip(z - low - 0.25, 0.0, None)
    return _resampled(np.stack([s, sign * d + swing, z], axis=2), count)


def _feather(straight: _Straight, sign: float) -> tuple[Floats, Floats]:
    """Half width and height of the feather line of one side, per station (n,)."""
    s = straight.s
    waist = bell(s, 0.43, 0.11) if sign > 0 else 0.25 * bell(s, 0.45, 0.11)
    inside = straight.spec.feather_inset + 0.02 * bell(s, 0.68, 0.10)
    cut = share(straight.spec, "arch_cut_mm") * waist / np.maximum(straight.half, 0.05)
    level = straight.spec.level_tread  # then at the tread both edges lie on the ground
    behind = 1.0 - eased((s - 0.48) / 0.16) if level else 1.0
    arch = share(straight.spec, "arch_mm") * (waist * behind if sign > 0 else 0.0)
    width = straight.half * (1.0 - inside - cut)
    return width, straight.view.bottom(s) + straight.view.crown(s) + arch


def _lower(straight: _Straight, sign: float, count: int) -> Floats:
    """The wall from the feather line to the widest row: (n, count + 1, 3)."""
    t = np.linspace(0.0, 1.0, 41)[None, :] * np.ones((len(straight.s), 1))
    edge, height = _feather(straight, sign)
    s = _along(straight, np.zeros_like(t), 1.0 - t)
    d = edge[:, None] + (straight.half - edge)[:, None] * np.sin(0.5 * np.pi * t)
    z = height[:, None] + (straight.view.widest(straight.s) - height)[:, None] * t
    return _resampled(np.stack([s, sign * d, z], axis=2), count)


def _sole(straight: _Straight, lateral: Floats, medial: Floats, count: int) -> Floats:
    """The sole between the two feather lines, both left out: (n, count - 1, 3)."""
    t = np.linspace(0.0, 1.0, count + 1)[None, 1:-1, None]
    flat = lateral[:, None, :] * (1.0 - t) + medial[:, None, :] * t
    depth = (straight.view.crown(straight.s) * straight.cap)[:, None]
    flat[:, :, 2] -= depth * (1.0 - (2.0 * t[:, :, 0] - 1.0) ** 2)
    return flat


def _side_view(spec: LastSpec) -> SideView:
    draft = Draft(
        heel=share(spec, "heel_height_mm"),
        spring=share(spec, "toe_spring_mm"),
        seat_pitch=spec.seat_pitch,
        break_station=spec.break_station,
        break_length=spec.break_length,
        spring_station=spec.spring_station,
        level_tread=spec.level_tread,
    )
    return side_view(
        draft,
        cone=share(spec, "cone_height_mm"),
        cone_length=spec.cone_length,
        fullness=spec.fullness,
        shaft=share(spec, "shaft_mm"),
        sole_crown=spec.sole_crown,
    )


def _rings(spec: LastSpec, shape: Widths) -> Floats:
    """All rings of the straight last, (rings + 1, segments, 3) as (s, d, z) over the length.

    A ring starts at the medial feather, goes up to the crest, down to the lateral feather and
    back under the sole.
    """
    s = _stations(spec.rings)
    view = _side_view(spec)
    half = np.interp(s, _GRID, shape.half)
    half[[0, -1]] = 0.0
    straight = _Straight(s, half, np.interp(s, _GRID, shape.cap), view, spec)
    wall, low = _rows(spec.segments)
    medial, lateral = (
        np.concatenate([_lower(straight, sign, low)[:, :-1], _upper(straight, sign, wall)], axis=1)
        for sign in (1.0, -1.0)
    )
    sole = _sole(straight, lateral[:, 0], medial[:, 0], spec.segments - 2 * (wall + low))
    return np.concatenate([medial, lateral[:, -2::-1], sole], axis=1)


def _rows(segments: int) -> tuple[int, int]:
    """How many of a ring's segments lie, on each side, above and under the widest row."""
    return max(6, round(0.26 * segments)), max(2, round(0.06 * segments))


def _ring_faces(spec: LastSpec) -> tuple[Ints, Ints]:
    """Faces over the ring slots, and the slots that stand for a vertex of their own.

    The first and the last ring are flat: one rib instead of two, no sole. Their lateral and
    sole slots are the medial rib's vertices, and the faces that this folds up are left out.
    """
    n, m = spec.rings + 1, spec.segments
    top = sum(_rows(m))
    slots = np.arange(n * m).reshape(n, m)
    for ring in (0, n - 1):
        slots[ring, top + 1 : 2 * top + 1] = slots[ring, top - 1 :: -1][:top]
        slots[ring, 2 * top + 1 :] = slots[ring, 0]
    a, b = slots[:-1], np.roll(slots[:-1], -1, axis=1)
    c, d = slots[1:], np.roll(slots[1:], -1, axis=1)
    first = np.stack([a, b, c], axis=2).reshape(-1, 3)
    second = np.stack([b, d, c], axis=2).reshape(-1, 3)
    faces = np.concatenate([first, second])
    whole = (
        (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    )
    used, faces = np.unique(faces[whole], return_inverse=True)
    return faces.reshape(-1, 3).astype(np.int64), used


def last_mesh(spec: LastSpec) -> tuple[Floats, Ints]:
    """The last as a closed mesh in the canonical pose.

    Parameters
    ----------
    spec : LastSpec

    Returns
    -------
    vertices_mm : (n, 3) float64
        Canonical frame; the extent along x is ``spec.length_mm``. A left last has its medial
        side at -y.
    faces : (m, 3) int64
        Wound outward, watertight, no degenerate face.
    """
    placed = _placed(spec)
    vertices, faces = placed.vertices_mm, placed.faces
    if spec.side == "left":
        vertices[:, 1] *= -1.0
        faces = faces[:, ::-1].copy()
    return vertices, faces


@dataclass(frozen=True, slots=True)
class _Placed:
    """The right last in the canonical pose, how many mm a unit of the curves is, and the angle
    (radians) that leads from there to where it stands.
    """

    vertices_mm: Floats
    faces: Ints
    unit_mm: float
    pitch: float


def _placed(spec: LastSpec) -> _Placed:
    plan, shape = _planted(spec)
    ring = _rings(spec, shape).reshape(-1, 3)
    faces, used = _ring_faces(spec)
    along, d, z = pitched(ring[used], plan.pitch).T
    x, y, heading = plan.at((along - plan.start) / plan.span)
    x, y = plan.span * x - d * np.sin(heading), plan.span * y + d * np.cos(heading)
    vertices = np.column_stack([x, y, z])
    vertices -= [plan.span * plan.origin[0], plan.span * plan.origin[1], z.min()]
    pitch = float(np.radians(_side_view(spec).pitch_deg))
    if spec.bent_standing:
        vertices, pitch = at_rest(vertices)
    unit_mm = spec.length_mm / float(np.ptp(vertices[:, 0]))
    vertices *= unit_mm
    vertices[:, 0] -= vertices[:, 0].min()
    return _Placed(vertices, faces, unit_mm, pitch)


@dataclass(frozen=True, slots=True)
class Standing:
    """How a last stands on its heel as it was drafted: the truth for stance.

    Attributes
    ----------
    pitch_deg : float
        From the resting plane to the floor, + where the heel is raised.
    middle_mm : (k, 2)
        The bottom's middle from heel to toe, x along the floor and z over it. x = 0 is where the
        plan outline begins if the last was bent as it stands.
    tip_mm : float
        The toe spring of the trade: the height of the feather edge at the tip, as it is drawn. It
        is a sharp corner, which lies a little behind the foremost place of the bottom.
    """

    pitch_deg: float
    middle_mm: Floats
    tip_mm: float

    def height_mm(self, station: float) -> float:
        """The bottom's height over the floor at a share of its length along the floor."""
        x, z = self.middle_mm.T
        return float(np.interp(x[0] + station * (x[-1] - x[0]), x, z))

    @property
    def bottom_length_mm(self) -> float:
        """The length of the bottom's middle along its own arc."""
        return float(np.linalg.norm(np.diff(self.middle_mm, axis=0), axis=1).sum())


def standing(spec: LastSpec) -> Standing:
    """How the last of a spec stands, as it was drafted."""
    view, placed = _side_view(spec), _placed(spec)
    middle = view.drafted
    if spec.bent_standing:  # the bend in plan makes it a little shorter along the floor
        plan, _ = _planted(spec)
        along = middle[:, 0] + np.sin(plan.pitch) * float(view.bottom(np.zeros(1))[0])
        x = plan.at((along - plan.start) / plan.span)[0] - plan.origin[0]
        middle = np.column_stack([plan.span * x, middle[:, 1]])
    middle_mm = middle * placed.unit_mm
    tip_mm = placed.unit_mm * _tip_height(spec, view)
    return Standing(float(np.degrees(placed.pitch)), middle_mm, tip_mm)


def _tip_height(spec: LastSpec, view: SideView) -> float:
    """How high the feather edge of the foremost ring stands over the tread, over the length."""
    s = np.linspace(0.0, 1.0, 1001)
    feather = _rings(spec, _planted(spec)[1])[-1, :1]
    bottom = np.column_stack([s, np.zeros_like(s), view.bottom(s)])
    tip, stands = (pitched(line, np.radians(view.pitch_deg))[:, 2] for line in (feather, bottom))
    return float(tip[0] - stands.min())
