"""How a shape stands: its stance with the labels, as a result, and what should be said of it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.stance.cues import StanceLabels
from footfit.geometry.stance.middle_line import middle_line
from footfit.geometry.stance.missing_bottom import missing_for_labels
from footfit.number_words import plain
from footfit.pipeline.batch.sources import LABELLED_MM
from footfit.pipeline.scan.trueness import measured
from footfit.results import Notice

if TYPE_CHECKING:
    from footfit.geometry.measures.landmarks import Shape
    from footfit.geometry.stance.cues import Cue
    from footfit.geometry.stance.stance import Stance
    from footfit.results import LastLabels, LastStance, MeshInfo

LONE_PLATFORM = "a platform counts together with a heel height only: give --heel-height too"
OF_A_FOOT = "heel height and toe spring are labels of lasts; this is a foot, which stands flat"
OPEN_BOTTOM = "the bottom {place}, so the labels of heel height and toe spring are of no use"
NO_TREAD = "shows no tread"
UNSURE_HEEL_MM = 10.0
"""A heel without a label that is less sure than this is told, by one standard deviation."""
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
        A height outside its range, or a platform that is higher than the heel.

    Examples
    --------
    >>> check_stance_labels(StanceLabels(heel_height_mm=60.0, platform_mm=15.0))
    """
    for name, (low, high) in LABELLED_MM.items():
        value = getattr(labels, name)
        if value is not None and not low <= value <= high:  # a NaN too
            words = name.removesuffix("_mm").replace("_", " ")
            raise BadOption(f"a {words} is from {low} to {high} mm, not {value}")
    heel_mm, platform_mm = labels.heel_height_mm, labels.platform_mm
    if heel_mm is not None and platform_mm > heel_mm:
        raise BadOption(
            f"the platform ({plain(platform_mm)} mm) is higher than the heel ({plain(heel_mm)} mm):"
            " check both"
        )


def last_stance(shape: Shape, info: MeshInfo | None = None) -> LastStance | None:
    """How a last stands, as a result; None of a foot, and if its ground is not known."""
    stance = shape.stance
    if stance is None or shape.kind == "foot":
        return None
    from footfit.results import GroundCue, LastStance

    entries = map(measure_named, ("heel_height", "toe_spring", "toe_spring_tip"))
    heel, spring, tip = (
        measured(entry, entry.taken_of(shape), shape.kind, shape.shape_heel_mm, info)
        for entry in entries
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
        toe_spring_tip_mm=tip.value,
        toe_spring_tip_sd_mm=tip.total_sd,
        spring_per_heel=1.0 - HEIGHTS.toe_spring * shape.length_mm / stance.touching_x_mm,
        cues=tuple(
            GroundCue(cue.name, math.degrees(cue.ground), math.degrees(cue.sd))
            for cue in stance.cues
        ),
    )


def heights_by_shape(stance: Stance | None) -> dict[str, float]:
    """The heel height and the toe spring at the tip (mm) of a last as its shape alone stands,
    whatever its labels say; without those that are not known.
    """
    alone = stance.alone if stance else None
    if alone is None:
        return {}
    heights = {"heel_height": alone.heel_mm(), "toe_spring_tip": alone.tip_mm()}
    return {name: mm for name, mm in heights.items() if mm is not None}


def stance_notices(shape: Shape) -> tuple[Notice, ...]:
    """A label that is of no use, or that the shape or the other label contradicts; without a label,
    a shape that does not show well how it stands.
    """
    labels, stance = shape.labels, shape.stance
    if labels.heel_height_mm is None and labels.toe_spring_mm is None:
        unused = (_unused(LONE_PLATFORM),) if labels.platform_mm else ()
        return (*unused, *_unsure(stance))
    if shape.kind == "foot":
        return (_unused(OF_A_FOOT),)
    grounds = {} if stance is None else {cue.name: cue for cue in stance.cues}
    if stance is None or "label" not in grounds:
        place = missing_for_labels(middle_line(shape.vertices_mm, shape.faces, 0.0), labels)
        return (_unused(OPEN_BOTTOM.format(place=f"is open {place}" if place else NO_TREAD)),)
    words = _two_labels(stance, grounds) or _contradiction(shape, stance)
    return (Notice("stance_label_contradicted", words),) if words else ()


def _unsure(stance: Stance | None) -> tuple[Notice, ...]:
    """What is said of a last whose bottom does not show well where it is level."""
    if stance is None or (sd_mm := stance.level_sd_mm(0.0)) < UNSURE_HEEL_MM:
        return ()
    heel_mm = stance.heel_mm()
    if heel_mm is None:
        return ()
    words = (
        f"the bottom does not show well how it stands: the heel is {heel_mm:.0f} mm high"
        f" ± {sd_mm:.0f} mm (one standard deviation). Lengths along the ground and the bottom"
        " depend on it: give --heel-height if you know it"
    )
    return (Notice("stance_unsure", words),)


def _unused(words: str) -> Notice:
    return Notice("stance_label_unused", words)


def _apart(first: Cue, second: Cue) -> float:
    """How far the second ground is over the first, radians; 0 if their deviations allow it."""
    apart, sd = second.ground - first.ground, float(np.hypot(first.sd, second.sd))
    return apart if abs(apart) > CONTRADICTED_SDS * sd else 0.0


def _two_labels(stance: Stance, grounds: Mapping[str, Cue]) -> str:
    """What is said if the labels of heel and toe spring do not go together."""
    if "heel_label" not in grounds:
        return ""
    heel, spring = grounds["heel_label"], grounds["spring_label"]
    apart = _apart(heel, spring)
    if not apart:
        return ""
    more = "lower" if apart < 0.0 else "higher"
    words = (
        "the labels of heel height and toe spring do not go together: by the toe spring the heel"
        f" is {abs(apart) * stance.touching_x_mm:.0f} mm {more}"
    )
    own = grounds.get("shape")
    if own is None:
        return f"{words}: check both labels"
    by_heel = abs(heel.ground - own.ground) < abs(spring.ground - own.ground)
    nearer = "heel height" if by_heel else "toe spring"
    return f"{words}. The shape agrees better with the {nearer}: check both labels"


def _contradiction(shape: Shape, stance: Stance) -> str:
    """What is said if the shape stands otherwise than a label says."""
    grounds, alone = {cue.name: cue for cue in stance.cues}, stance.alone
    if alone is None or not _apart(grounds["label"], grounds["shape"]):
        return ""
    label, own = grounds["label"], grounds["shape"]
    of_toe = shape.labels.heel_height_mm is None
    said_mm, own_mm = (each.tip_mm() if of_toe else each.heel_mm() for each in (stance, alone))
    if said_mm is None or own_mm is None:
        return ""
    arm_mm = stance.length_mm - stance.touching_x_mm if of_toe else stance.touching_x_mm
    sd_mm = arm_mm * float(np.hypot(label.sd, own.sd))
    higher = own_mm > said_mm
    words = (
        f"the shape alone would stand its {'toe' if of_toe else 'heel'}"
        f" {abs(own_mm - said_mm):.0f} mm {'higher' if higher else 'lower'} than the label says"
        f" (± {sd_mm:.0f} mm): check the label"
    )
    platform = not (of_toe or higher or shape.labels.platform_mm)
    return f"{words}, or give the forepart's height with --platform" if platform else words
