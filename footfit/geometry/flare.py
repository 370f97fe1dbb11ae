"""Flare: the plan and bottom curvature of a sole, per station, and the angle they make."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.geometry.arrays import Floats

CHANNELS = ("plan", "bottom_20", "bottom_50", "bottom_80", "bottom_surface")


@dataclass(frozen=True, slots=True)
class FlareDefinition:
    """All parameters of the flare profile; a change of any is a new version."""

    version: str = "flare/1"


@dataclass(frozen=True, slots=True)
class FlareProfile:
    """The flare profile of one shape, as a right one; (n,) arrays at ``stations``.

    ``heading_deg`` is the direction of the centre line, + towards medial; ``curvature`` maps
    each of ``CHANNELS`` to curvature times length (dimensionless), or None where it cannot be
    measured; ``centre_line`` is (n, 2), x and y over the length.
    """

    definition: FlareDefinition
    angle_deg: float
    angle_sd_deg: float
    flare_class: str
    stations: Floats
    heading_deg: Floats
    curvature: dict[str, Floats | None]
    centre_line: Floats
