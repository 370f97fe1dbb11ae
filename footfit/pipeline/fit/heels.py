"""What the heels of lasts change of a foot: by one heel model, for all lasts at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.results import (
    HeelChange,
    HeelModel,
    HeelQuestion,
    HeelRule,
    LastRecord,
    Measured,
    Profiled,
)
from footfit.results.heel import FLARE

if TYPE_CHECKING:
    from footfit.geometry.fit.foot_in_heel import SurfaceChange

SAME_DROP_MM = 5.0
"""Two drops that differ by less are one: a foot that was scanned at it needs no model."""


@dataclass(frozen=True, slots=True)
class Heels:
    """The heels of n lasts, for feet that are compared as ``question`` says.

    ``drop_mm`` (n,) is NaN where it is not known. ``share`` (n,) of the model's full change is
    applied. Where ``length_only`` (n,) holds, the model says nothing of girths.
    """

    question: HeelQuestion
    drop_mm: Floats
    share: Floats
    length_only: Bools

    def taken(self, rows: Ints) -> Heels:
        """Those of some lasts."""
        return Heels(self.question, self.drop_mm[rows], self.share[rows], self.length_only[rows])


def heels_of(question: HeelQuestion, lasts: Sequence[LastRecord]) -> Heels:
    """The heels of lasts of which there are records."""
    drops_mm = (last.drop_mm for last in lasts)
    return heels_at(question, np.array([np.nan if mm is None else mm for mm in drops_mm]))


def heels_at(question: HeelQuestion, drop_mm: Floats) -> Heels:
    """How much of the model's full change the heels of n lasts ask for; a drop is NaN if it is not
    known.

    A share is the drop over the full drop, up to the model's largest drop, minus that of the drop
    that the foot was scanned at. It is 0 where the drop is not known.
    """
    drop_mm = drop_mm + question.heel_lift_mm
    model = question.model
    if model is None:
        nothing = np.zeros(len(drop_mm))
        return Heels(question, drop_mm, nothing, nothing > 0.0)
    scanned_mm, largest_mm = question.scanned_at_drop_mm, model.largest_drop_mm
    known_mm = np.where(np.isnan(drop_mm), scanned_mm, drop_mm)
    share = (np.clip(known_mm, 0.0, largest_mm) - min(scanned_mm, largest_mm)) / model.full_drop_mm
    apart = np.abs(known_mm - scanned_mm) > SAME_DROP_MM
    return Heels(question, drop_mm, share, apart & (np.maximum(known_mm, scanned_mm) > largest_mm))


def joined_heels(parts: Sequence[Heels]) -> Heels:
    """The heels of lasts one after the other."""
    names = ("drop_mm", "share", "length_only")
    arrays = (np.concatenate([getattr(part, name) for part in parts]) for name in names)
    return Heels(parts[0].question, *arrays)


def full_change(model: HeelModel | None, foot: Profiled, measure: str) -> tuple[float, float]:
    """How a foot's measure changes at the model's full drop, and the standard deviation of that:
    in mm, or in degrees for the flare angle. It is 0 where the model has no rule.
    """
    rule = rule_of(model, measure)
    size = 1.0 if measure == FLARE else _value_mm(foot, measure)
    return rule.change * size, rule.sd * size


def heel_change(heels: Heels, row: int, foot: Profiled) -> HeelChange | None:
    """What the heel of one last changes of one foot; None for a foot that is taken as scanned."""
    model, scanned_mm = heels.question.model, heels.question.scanned_at_drop_mm
    if model is None:
        return None
    drop_mm, share = float(heels.drop_mm[row]), float(heels.share[row])
    changes = []
    for rule in model.rules:
        if rule.measure == FLARE or _value_mm(foot, rule.measure):
            change, sd = full_change(model, foot, rule.measure)
            changes.append((rule.measure, Measured(share * change, abs(share) * sd)))
    return HeelChange(
        drop_mm=None if np.isnan(drop_mm) else drop_mm,
        scanned_at_drop_mm=scanned_mm,
        model=model.model_id,
        share=share,
        unproven=abs(drop_mm - scanned_mm) >= model.unproven_from_mm,
        length_only=bool(heels.length_only[row]),
        changes=tuple(changes),
    )


def surface_change(heels: Heels, row: int) -> SurfaceChange:
    """How the surface of any foot changes in the heel of one last."""
    from footfit.geometry.fit.foot_in_heel import SurfaceChange

    return SurfaceChange(
        **{
            field.name: float(heels.share[row]) * rule_of(heels.question.model, field.name).change
            for field in fields(SurfaceChange)
        }
    )


def share_sd(heels: Heels, row: int, measure: str) -> float:
    """The standard deviation, as a share, of how a measure changes in the heel of one last."""
    return abs(float(heels.share[row])) * rule_of(heels.question.model, measure).sd


def rule_of(model: HeelModel | None, measure: str) -> HeelRule:
    """The rule of a measure, or one that changes nothing."""
    rule = None if model is None else model.rule_of(measure)
    return rule or HeelRule(measure, 0.0, 0.0, "", "")


def _value_mm(foot: Profiled, measure: str) -> float:
    """A measure of a foot; 0 if it has none."""
    values = (row.measured.value for row in foot.measures if row.name == measure)
    return next(values, None) or 0.0
