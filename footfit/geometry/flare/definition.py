"""What a flare profile is: all its parameters, and the profile that they make."""

from __future__ import annotations

import math
from dataclasses import dataclass

from footfit.geometry.numeric.arrays import Floats

ANOTHER_LINE_SD_DEG = 0.38
"""How far the angle is from that of the line along which a generator bent its last.

It is the root mean square over the project's own lasts at all heels (benchmarks/heels.py), of which
a quarter have an oblique toe. Lines that halve an outline equally well are so far apart.
"""
CHANNELS = ("plan", "bottom_20", "bottom_50", "bottom_80", "bottom_surface")


@dataclass(frozen=True, slots=True)
class FlareDefinition:
    """All parameters of the flare profile. Two profiles compare only if all these are equal.

    Lengths are shares of the shape's length L, stations are shares of the centre line's own
    length (0 heel, 1 toe), headings and angles are degrees. ``docs/flare.md`` explains each.
    The last block says how finely these things are solved and integrated.

    Examples
    --------
    >>> from dataclasses import asdict
    >>> asdict(FlareDefinition())["band_height"]
    0.1
    """

    version: str = "flare/3"

    # A last stands on its heel, and its bottom is laid flat along its own arc (a foot lies flat).
    line_window: tuple[float, float] = (0.035, 0.965)  # of the standing length
    line_bandwidth: float = 0.03  # of the local parabolas that smooth the middle line
    line_beyond: float = 0.2  # how far the line is drawn on straight at each end
    flat_height: float = 0.135  # faces that lie higher over the line are no bottom
    # Heights lean with the bottom as far as the heel's back says that the sections do.
    seat_place: float = 0.12  # of the bottom's arc: where the pitch of the seat is read
    back_heights: tuple[float, float] = (0.05, 0.085)  # where the lean of the back is read
    seat_sure_deg: tuple[float, float] = (4.0, 12.0)  # a flatter seat says nothing, a steeper all
    lean_window: tuple[float, float] = (0.16, 0.70)  # beyond, heights lean as at its ends

    # The band that counts as the bottom, and its edges.
    length_height: float = 0.30  # L of a foot is the extent along x of the part that lies lower
    flat_length_height: float = 0.05  # L of a last, in the same way, on the bottom laid flat
    band_height: float = 0.10  # over each section's own lowest point: a raised heel has one too
    edge_depth: float = 0.01  # an edge is the mean of the outermost part, as deep as this

    # Where a shape stands: it is turned about x until these are level across.
    seat: tuple[float, float] = (0.08, 0.18)
    tread: tuple[float, float] = (0.64, 0.76)
    level_rounds: int = 10
    level_settled: float = 5e-5  # radians: 0.003 degrees
    level_gain: tuple[float, float] = (0.3, 1.5)  # limits of a step's estimated gain

    # The centre line: cubic splines, the mid-points of the bands normal to it.
    sections: int = 180  # as many again move feet by 0.07 degrees RMS: where toes begin
    sections_from: float = 0.03
    sections_to: float = 0.96
    trusted_to: float = 0.88  # in front, a section's weight falls: toes end one by one
    trust_bandwidth: float = 0.04
    splines: int = 20
    axis_stiffness: float = 3e-6  # of the axis that the sections are cut across (2nd differences)
    line_stiffness: float = 1e-7  # of the last correction, which may bend more (3rd differences)
    toe_from: float = 0.74  # beyond, both are stiffer
    toe_stiffness: float = 30.0
    width_stiffness: float = 1e-7  # of the widths' curve, of which only the slope is used
    settled: float = 2e-4  # the axis is settled when nothing moves more
    passes: int = 10
    full_steps: int = 4  # then half steps: a foot's toes can make whole ones swing for ever
    straight_ends: tuple[float, float] = (0.05, 0.95)  # outside these the line is straight
    found_least: float = 0.6  # share of sections that must exist for a channel to be measured

    # What is read from it.
    stations: int = 47
    stations_from: float = 0.04
    stations_to: float = 0.96
    rearfoot: tuple[float, float] = (0.08, 0.30)  # the flare angle's base
    forefoot: tuple[float, float] = (0.55, 0.80)

    # The bottom curves, and the sole's surface.
    bottom_places: tuple[float, float, float] = (0.20, 0.50, 0.80)  # of the width, from medial
    bottom_bandwidth: float = 0.10
    surface_bandwidth: float = 0.05  # along the line
    surface_width: float = 0.70  # of the half width, where the weight has fallen to 0
    surface_ends: tuple[float, float] = (0.03, 0.12)  # no weight before, whole weight after
    surface_piece: float = 0.03  # longer facets are weighed piece by piece
    surface_halvings: int = 6  # at most: enough for one facet as long as the foot
    surface_least: float = 0.1  # of the usual area of sole, else a station has none
    surface_width_bandwidth: float = 0.03  # of the widths' curve, whose slope is used

    # What the angle of a last is called: below the first outflare, above the second inflare.
    last_straight_deg: tuple[float, float] = (4.0, 12.0)

    # The angle's uncertainty: the scatter of the mid-points, and the frame's own.
    scatter_bandwidth: float = 0.02
    scatter_lags: int = 2
    frame_sd_deg: float = 0.05  # a frame wrong by half a degree of yaw: benchmarks/flare.py

    # How finely: a finer choice of any moves the angle by less than 0.001 degrees.
    line_points: int = 401  # of the side line's table
    back_points: int = 12  # heights at which the heel's back is read
    lean_rounds: int = 20  # steps to the place that a point stands over
    lean_step: float = 0.7  # of a whole step: a bottom bends below high points
    table: tuple[float, float, int] = (-0.1, 1.1, 1201)  # x of the tabulated line: from, to, points
    projections: int = 2  # Newton steps onto the line
    turn_least: float = 0.2  # keeps a point beyond the line's centre of curvature on its own side
    window_points: int = 50  # where a window's mean heading is read
    surface_bins: int = 601  # over the table's reach
    length_rounds: int = 3  # of measuring L below a height that is itself a share of L


@dataclass(frozen=True, slots=True)
class FlareProfile:
    """The flare profile of one shape, as a right one; (n,) arrays at ``stations``.

    ``heading_deg`` is the direction of the centre line, + towards medial; ``curvature`` maps
    each of ``CHANNELS`` to curvature times length (dimensionless), or None where it cannot be
    measured; ``centre_line`` is (n, 2), x and y in the plan of the canonical frame over the extent.
    ``flare_class`` is None for a foot. ``angle_sd_deg`` is the spread of a second scan.
    """

    definition: FlareDefinition
    angle_deg: float
    angle_sd_deg: float
    flare_class: str | None
    stations: Floats
    heading_deg: Floats
    curvature: dict[str, Floats | None]
    centre_line: Floats

    @property
    def angle_total_sd_deg(self) -> float:
        """The angle's standard deviation with what an outline leaves open of its centre line."""
        return math.hypot(self.angle_sd_deg, ANOTHER_LINE_SD_DEG)


def flare_class(angle_deg: float, kind: str, definition: FlareDefinition) -> str | None:
    """What the trade calls the flare angle of a last: outflare, straight or inflare.

    A foot has no such name: too few real feet are measured to say which angle is usual.

    Examples
    --------
    >>> flare_class(13.0, "last", FlareDefinition()), flare_class(13.0, "foot", FlareDefinition())
    ('inflare', None)
    """
    if kind != "last":
        return None
    least, most = definition.last_straight_deg
    if angle_deg < least:
        return "outflare"
    return "inflare" if angle_deg > most else "straight"
