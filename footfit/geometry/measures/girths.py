"""Girths: what a tape reads around the ball, the waist, the instep and the heel."""

from __future__ import annotations

import numpy as np

from footfit.geometry.measures.heel_girths import angle_to_deg, around_heel, shortest_around_heel
from footfit.geometry.measures.landmarks import AXES, LANDMARKS, Shape
from footfit.geometry.measures.lengths import NO_BALL
from footfit.geometry.measures.measure_value import CUT, OPEN, Reading, lacking
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outlines import Outline


def ball_girth(shape: Shape) -> Reading:
    """Around the ball, in the upright plane through MT1 and MT5."""
    if shape.mt1 is None or shape.mt5 is None:
        return Reading(None, NO_BALL)
    across = (shape.mt1 - shape.mt5) * [1.0, 1.0, 0.0]
    across /= np.linalg.norm(across)
    return _girth(shape, shape.cut(shape.mt5, np.stack([across, AXES[2]])), "ball")


def waist_girth(shape: Shape) -> Reading:
    """Around the section across X half-way between the ball (MT1 to MT5) and the instep."""
    if shape.mt1 is None or shape.mt5 is None:
        return Reading(None, NO_BALL)
    ball_mm = 0.5 * (shape.mt1[0] + shape.mt5[0])
    ball = (ball_mm - shape.x_mm(0.0)) / shape.length_mm
    return _girth(shape, shape.across(0.5 * (ball + LANDMARKS.instep)), "waist")


def instep_girth(shape: Shape) -> Reading:
    """Around the section across X at half the length."""
    return _girth(shape, shape.at_instep, "instep")


def long_heel_girth(shape: Shape) -> Reading:
    """Around heel and instep, in the plane across the foot through the heel's base and the top of
    the section at half the length.
    """
    missing = lacking(shape, shape.at_instep, "instep")
    if missing is not None:
        return Reading(None, missing)
    return _girth(shape, around_heel(shape, angle_to_deg(shape, shape.instep)), "instep")


def short_heel_girth(shape: Shape) -> Reading:
    """The least girth around the heel's base and the bend of the ankle (over a last's cone)."""
    missing = lacking(shape, shape.at_instep, "instep")
    if missing is not None:
        return Reading(None, missing)
    if shape.kind == "last" and shape.opened(shape.across(LANDMARKS.cone)):
        return Reading(None, OPEN.format(place="cone"))
    section = shortest_around_heel(shape)
    if section is None:
        return Reading(None, CUT.format(place="bend of the ankle"))
    return _girth(shape, section, "heel", over_cone=True)


def _girth(shape: Shape, section: Outline, place: str, *, over_cone: bool = False) -> Reading:
    missing = lacking(shape, section, place, over_cone=over_cone)
    if missing is not None:
        return Reading(None, missing)
    return Reading(hull_girth(section.points))
