"""How a shape stands: its stance with the labels, as a result, and what should be said of it."""

from __future__ import annotations

import math

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.measures.heights import HEIGHTS, heel_height, toe_spring
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.stance.cues import StanceLabels
from footfit.pipeline.scan.trueness import measured
from footfit.results import GroundCue, LastLabels, LastStance, MeshInfo, Notice

LABELLED_MM = {"heel_height_mm": (0, 200), "toe_spring_mm": (0, 80), "platform_mm": (0, 100)}
"""What labels may say."""
CONTRADICTED_SDS = 2.0
"""A label that is further from the shape than this many of their standard deviations is told."""


def stance_labels(labels: LastLabels) -> StanceLabels:
    """What the labels of a last say of how it stands."""
    platform_mm = labels.platform_mm or 0.0
    return StanceLabels(labels.heel_height_mm, labels.toe_spring_mm, platform_mm)


def check_stance_labels(labels: StanceLabels) -> None:
    """Refuse labels that no last has.

    Raises
    ------
    BadOption
        A height outside its range.

    Examples
    --------
    >>> check_stance_labels(StanceLabels(heel_height_mm=60.0, platform_mm=15.0))
    """
    for name, (low, high) in LABELLED_MM.items():
        value = getattr(labels, name)
        if value is not None and not low <= value <= high:  # a NaN too
            words = name.removesuffix("_mm").replace("_", " ")
            raise BadOption(f"a {words} is from {low} to {high} mm, not {value}")


def last_stance(shape: Shape, info: MeshInfo | None = None) -> LastStance | None:
    """How a last stands, as a result; None of a foot, and if its ground is not known."""
    stance = shape.stance
    if stance is None or shape.kind == "foot":
        return None
    heel, spring = (
        measured(measure_named(name), value, shape.kind, shape.shape_heel_mm, info)
        for name, value in (("heel_height", heel_height(shape)), ("toe_spring", toe_spring(shape)))
    )
    return LastStance(
        decided_by=stance.decided_by,
        ground_deg=math.degrees(stance.ground),
        ground_sd_deg=math.degrees(stance.ground_sd),
        length_mm=stance.length_mm,
        heel_height_mm=heel.value,
        heel_height_sd_mm=heel.total_sd,
        toe_spring_mm=spring.value,
        toe_spring_sd_mm=spring.total_sd,
        spring_per_heel=1.0 - HEIGHTS.toe_spring * shape.length_mm / stance.touching_x_mm,
        cues=tuple(
            GroundCue(cue.name, math.degrees(cue.ground), math.degrees(cue.sd))
            for cue in stance.cues
        ),
    )


def stance_notices(shape: Shape) -> tuple[Notice, ...]:
    """A label that is of no use, or that the shape contradicts."""
    labels, stance = shape.labels, shape.stance
    if labels.heel_height_mm is None and labels.toe_spring_mm is None:
        return ()
    if shape.kind == "foot":
        words = "heel height and toe spring are labels of lasts; this is a foot, which stands flat"
        return (Notice("stance_label_unused", words),)
    if stance is None:
        words = "the bottom is open, so the labels of heel height and toe spring are of no use"
        return (Notice("stance_label_unused", words),)
    grounds = {cue.name: cue for cue in stance.cues}
    own, label = grounds["shape"], grounds.get("label")
    if label is None:
        return ()
    apart, sd = abs(label.ground - own.ground), float(np.hypot(label.sd, own.sd))
    if apart <= CONTRADICTED_SDS * sd:
        return ()
    arm_mm = stance.touching_x_mm
    more = "lower" if own.ground < label.ground else "higher"
    words = (
        f"the shape alone would stand its heel {arm_mm * apart:.0f} mm {more} than the label says"
        f" (± {arm_mm * sd:.0f} mm): check the label, or give the forepart's height with --platform"
    )
    return (Notice("stance_label_contradicted", words),)
