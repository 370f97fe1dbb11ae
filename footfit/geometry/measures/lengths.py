"""Lengths: along X, to the ball, to the farthest toe, along the bottom."""

from __future__ import annotations

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import MeasureValue, no_ball
from footfit.geometry.measures.underside import BOTTOM, underside
from footfit.geometry.mesh.outermost_point import tip

FOREPART = 0.7
TURNS = 2  # of the direction towards the farthest toe; the second changes it by under .01 mm


def length(shape: Shape) -> MeasureValue:
    """From the pternion to the foremost point along X, without the leg (ISO 7250-1 foot length).

    Of a last it is the stick length.
    """
    return MeasureValue(shape.length_mm)


def functional_length(shape: Shape) -> MeasureValue:
    """From the pternion to the tip of the toe that lies farthest from it, in plan.

    If a shoe is too short, this toe touches it first, whichever way the shoe turns about the heel.
    """
    start = shape.pternion[:2]
    fore = shape.low[shape.vertices_mm[shape.low[:, 0], 0] > shape.x_mm(FOREPART)]
    corners = shape.vertices_mm[fore[:, 0], :2]
    end = corners[np.argmax(np.square(corners - start).sum(axis=1))]
    distance = 0.0
    for _ in range(TURNS):
        direction = (end - start) / np.hypot(*(end - start))
        toe = tip(shape.vertices_mm, fore, np.array([*direction, 0.0]), shape.length_mm)
        distance = toe.reach - float(start @ direction)
        end = toe.place[:2]
    return MeasureValue(distance)


def ball_length(shape: Shape) -> MeasureValue:
    """From the pternion to the inner joint (MT1) along X."""
    if shape.mt1 is None:
        return no_ball(shape)
    return MeasureValue(float(shape.mt1[0] - shape.x_mm(0.0)))


def tape_length(shape: Shape) -> MeasureValue:
    """Along the middle of the bottom, as a tape reads that lies along a last's bottom.

    The length along X, plus how much longer the bottom's curve is than its run along X. The curve
    is smoothed first, since 0.3 mm of ripple makes a path over it one per cent longer.
    """
    bottom = underside(shape, BOTTOM.whole, BOTTOM.middle_places)
    if bottom is None:
        return MeasureValue(None, "the sole is open along its middle")
    curve = bottom.smooth(BOTTOM.bandwidth * shape.length_mm)
    run, rise = np.diff(curve.x_mm), np.diff(curve.z_mm)
    return MeasureValue(shape.length_mm + float((np.hypot(run, rise) - run).sum()))
