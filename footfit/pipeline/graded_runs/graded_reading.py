"""What is read of the file of a graded last: its measures, their planes, and its flare."""

from __future__ import annotations

import math

import numpy as np

from footfit.errors import GeometryRefused
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.pipeline.graded_runs.run_increments import CHECKED
from footfit.pipeline.last_making.custom.custom_reading import TAPES, file_plane
from footfit.pipeline.scan.flare import shape_flare
from footfit.pipeline.scan.preparation import mirror_of
from footfit.pipeline.scan.trueness import measured
from footfit.results import GirthPlane, PreparedScan


def measures_of(shape: Shape) -> dict[str, float]:
    """The checked measures of a last, in mm by name."""
    values = {name: measure_named(name).taken_of(shape).value for name in CHECKED}
    return {name: value for name, value in values.items() if value is not None}


def spreads_of(shape: Shape) -> dict[str, float | None]:
    """The spread of a second scan of each checked measure of a last, in mm by name."""
    entries = map(measure_named, CHECKED)
    return {each.name: measured(each, each.taken_of(shape), "last", None).sd for each in entries}


def flare_of(shape: Shape) -> tuple[float, float] | None:
    """The flare angle of a last and its standard deviation, degrees; None if it is not shown."""
    try:
        flare = shape_flare(shape)
    except GeometryRefused:
        return None
    angle_deg, sd_deg = flare.angle_deg, flare.angle_sd_deg
    return (angle_deg, sd_deg) if math.isfinite(angle_deg) else None


def planes_of(scan: PreparedScan, names: frozenset[str]) -> dict[str, GirthPlane]:
    """The planes of those girths that are among ``names``, in the axes of the file of a last."""
    mirror = np.diag([*mirror_of(scan.side.side), 1.0])
    to_file = np.asarray(np.linalg.inv(scan.canonical_transform) @ mirror, np.float64)
    planes = {name: file_plane(scan.shape, name, to_file) for name in names & TAPES.keys()}
    return {name: plane for name, plane in planes.items() if plane is not None}
