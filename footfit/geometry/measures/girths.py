"""Girths: what a tape reads around the ball, the waist, the instep and the heel."""

from __future__ import annotations

from footfit.geometry.measures.heel_girths import angle_to_deg, around_heel, shortest_around_heel
from footfit.geometry.measures.landmarks import LANDMARKS, Shape
from footfit.geometry.measures.least_tape import heel_tape, tape_about, tape_over
from footfit.geometry.measures.measure_value import (
    BLOCKED,
    CUT,
    CUT_OUT,
    OPEN,
    MeasureValue,
    lacking,
    no_ball,
    section_value,
)
from footfit.geometry.measures.tape import Crown, hull_girth


def ball_girth(shape: Shape) -> MeasureValue:
    """Around the ball, in the upright plane through MT1 and MT5."""
    plane = shape.ball_plane
    if plane is None:
        return no_ball(shape)
    return section_value(shape, shape.cut(*plane), "ball", hull_girth)


def waist_girth(shape: Shape) -> MeasureValue:
    """Around the section across X half-way between the ball (MT1 to MT5) and the instep."""
    plane = shape.ball_plane
    if plane is None:
        return no_ball(shape)
    ball = (plane[0][0] - shape.x_mm(0.0)) / shape.length_mm
    section = shape.across(0.5 * (ball + LANDMARKS.instep))
    return section_value(shape, section, "waist", hull_girth)


def instep_girth(shape: Shape) -> MeasureValue:
    """Around the section across X at half the length."""
    return section_value(shape, shape.at_instep, "instep", hull_girth)


def long_heel_girth(shape: Shape) -> MeasureValue:
    """Around heel and instep: in the plane across the foot through the heel's base and the top of
    the section at half the length.
    """
    missing = lacking(shape, shape.at_instep, "instep")
    if missing is not None:
        return MeasureValue(None, missing)
    section = around_heel(shape, angle_to_deg(shape, shape.instep))
    return section_value(shape, section, "instep", hull_girth)


def short_heel_girth(shape: Shape) -> MeasureValue:
    """The least girth around the heel's base and the bend of the ankle (over a last's cone)."""
    missing = lacking(shape, shape.at_instep, "instep")
    if missing is not None:
        return MeasureValue(None, missing)
    if shape.kind == "last" and shape.opened(shape.across(LANDMARKS.cone)):
        return MeasureValue(None, OPEN.format(place="cone"))
    section = shortest_around_heel(shape)
    if section is None:
        foot = shape.kind == "foot"
        return MeasureValue(None, CUT.format(place="bend of the ankle") if foot else CUT_OUT)
    return section_value(shape, section, "heel", hull_girth, over_cone=True)


def ball_girth_least(shape: Shape) -> MeasureValue:
    """Around the ball by the least tape: the plane turns about the line from the outer to the inner
    joint until the girth is least.
    """
    if shape.joints is None:
        return no_ball(shape)
    section = tape_about(shape, *shape.joints, shape.upright).section(shape)
    return section_value(shape, section, "ball", hull_girth)


def waist_girth_least(shape: Shape) -> MeasureValue:
    """Around the waist by the least tape: over the crown half-way between ball and instep, in the
    plane in which the girth is least.
    """
    if shape.waist_crown is None:
        return no_ball(shape)
    return _least_over(shape, shape.waist_crown, "waist")


def instep_girth_least(shape: Shape) -> MeasureValue:
    """Around the instep by the least tape: over its crown, in the plane in which the girth is
    least.
    """
    return _least_over(shape, shape.instep_crown, "instep")


def heel_girth_instep(shape: Shape) -> MeasureValue:
    """Around heel and instep by the least tape: the plane turns about the line from the heel's base
    to the instep's crown until the girth is least.
    """
    missing = lacking(shape, shape.instep_crown.section, "instep")
    if missing is not None:
        return MeasureValue(None, missing)
    tape = heel_tape(shape)
    section = tape.section(shape)
    if tape.goes_on(section, shape.length_mm):
        return MeasureValue(None, BLOCKED)
    return section_value(shape, section, "instep", hull_girth)


def _least_over(shape: Shape, crown: Crown, place: str) -> MeasureValue:
    """The girth of the shortest tape over a crown, or what is missing there."""
    missing = lacking(shape, crown.section, place)
    if missing is not None:
        return MeasureValue(None, missing)
    section = tape_over(shape, crown.place).section(shape)
    return section_value(shape, section, place, hull_girth)
