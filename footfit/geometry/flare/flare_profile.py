"""Flare: the plan and bottom curvature of a sole, per station, and the angle they make.

Everything is relative to the length, so that a graded last has the identical profile. The shape
comes in the canonical frame as a right one: x from heel to toe, y to the medial side, z up.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.flare.bottom_curves import bottom_curvature, extended_stations
from footfit.geometry.flare.centre_line import CentreLine, centre_line
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, FlareProfile, flare_class
from footfit.geometry.flare.flattened import Flattened, flattened
from footfit.geometry.flare.levelled_bottom import low_length
from footfit.geometry.flare.sole_curvature import surface_curvature_profile
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.polylines import curvature_density
from footfit.geometry.numeric.smoothing import cubic_splines, local_quadratic
from footfit.geometry.stance.stance import Stance


def flare_profile(
    vertices_mm: Floats,
    faces: Ints,
    definition: FlareDefinition | None = None,
    stance: Stance | None = None,
    kind: str = "foot",
) -> FlareProfile:
    """The flare profile of a canonical right shape.

    Parameters
    ----------
    vertices_mm : (n, 3)
        In the canonical frame; a left shape mirrored (y to -y, faces turned over).
    faces : (m, 3)
        Wound outward.
    definition : FlareDefinition, optional
    stance : Stance, optional
        How a last stands. Without it the shape lies flat, as a foot does.
    kind : {"foot", "last"}
        A foot's angle has no class.

    Returns
    -------
    FlareProfile

    Raises
    ------
    HalfScan
        The scan does not show enough of the bottom's length.
    """
    definition = FlareDefinition() if definition is None else definition
    bottom = flattened(vertices_mm, faces, stance, definition)
    return bottom_profile(bottom, vertices_mm, kind, definition)


def bottom_profile(
    bottom: Flattened, vertices_mm: Floats, kind: str, definition: FlareDefinition
) -> FlareProfile:
    """The flare profile of a bottom that is laid flat already.

    ``vertices_mm`` (n, 3) is the shape that it belongs to, and ``definition`` how it was laid flat.

    Raises
    ------
    HalfScan
        The scan does not show enough of the bottom's length.
    """
    line = centre_line(bottom.shape, bottom.reading)
    angle_deg, gradient_deg = _flare_angle(line, definition)
    stations = extended_stations(definition)[1:-1]
    x = line.x_at(stations)
    slope = np.interp(x, line.x, line.slope)
    _, extent_mm = low_length(vertices_mm, definition.length_height, definition.length_rounds)
    return FlareProfile(
        definition=definition,
        angle_deg=angle_deg,
        angle_sd_deg=_angle_sd(line, gradient_deg, definition),
        flare_class=flare_class(angle_deg, kind, definition),
        stations=stations,
        heading_deg=np.degrees(np.arctan(slope)),
        curvature=_channels(bottom, line),
        centre_line=bottom.plan_mm(line, x) / extent_mm,
    )


def _channels(bottom: Flattened, line: CentreLine) -> dict[str, Floats | None]:
    shape, reading = bottom.shape, bottom.reading
    x = line.x_at(extended_stations(reading))
    points = np.column_stack([x, np.interp(x, line.x, line.y)])
    plan = curvature_density(points)[1:-1] * line.arc_length  # III.B
    down = area_vectors(shape.vertices, shape.faces)[line.bands.segments.face, 2] < 0.0
    side = bottom.side_view(line, line.bands.x)
    places = (bottom_curvature(line, down, p, side, reading) for p in reading.bottom_places)
    surface = surface_curvature_profile(shape, line, side, reading)
    return dict(zip(CHANNELS, (plan, *places, surface), strict=True))


def _flare_angle(line: CentreLine, definition: FlareDefinition) -> tuple[float, Floats]:
    """The forefoot's mean heading over the rearfoot's, and its gradient by the coefficients."""
    angle, gradient = 0.0, np.zeros_like(line.coefficients)
    for window, sign in ((definition.forefoot, 1.0), (definition.rearfoot, -1.0)):
        share = (np.arange(definition.window_points) + 0.5) / definition.window_points
        x = line.x_at(window[0] + share * (window[1] - window[0]))
        basis = cubic_splines(x, len(line.coefficients))[1]
        slope = basis @ line.coefficients
        angle += sign * float(np.degrees(np.arctan(slope)).mean())
        gradient += sign * np.degrees(basis / (1.0 + slope**2)[:, None]).mean(axis=0)
    return angle, gradient


def _angle_sd(line: CentreLine, gradient_deg: Floats, definition: FlareDefinition) -> float:
    """The angle's standard deviation, carried from how the mid-points scatter around the line.

    Near the solution the angle is linear in the mid-points. Their offsets from the line are scatter
    only if they vary over less than ``scatter_bandwidth``: a toe is longer, and the next scan shows
    it again. Neighbours share vertices, so their products count too, up to ``scatter_lags``
    sections apart. The weights fall with the lag, which keeps the variance positive.
    """
    smooth, _ = local_quadratic(line.bands.x, line.bands.x, definition.scatter_bandwidth)
    rough = line.scatter - smooth @ line.scatter
    felt = (gradient_deg @ line.response) * rough
    variance = float(felt @ felt)
    for lag in range(1, definition.scatter_lags + 1):
        falling = 1.0 - lag / (definition.scatter_lags + 1)
        variance += 2.0 * falling * float(felt[lag:] @ felt[:-lag])
    freedom = line.freedom - float(np.trace(smooth))
    variance *= len(felt) / max(freedom, 1.0)
    return float(np.hypot(np.sqrt(variance), definition.frame_sd_deg))
