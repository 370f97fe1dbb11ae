"""What wider walls and a higher top give the toes of a foot, read once from a light copy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.catalogue.blocks.record_columns import TOES_SECTION
from footfit.geometry.deform.hump import Hump
from footfit.geometry.fit.named_sections import toes_outline_mm
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.fit.judging.judged_lasts import JudgedLasts
from footfit.pipeline.fit.judging.toe_box import behind_share, toes_of_foot
from footfit.pipeline.fit.zones import TOE_HEIGHT
from footfit.pipeline.last_making.custom.custom_tries import Attempt, Given

NEAR_MM = np.array([-4.0, 0.0, 4.0])
"""What moves least so near along the wall counts: the nearest place of the wall becomes another
one."""


@dataclass(frozen=True, slots=True)
class ToeGains:
    """How a foot lies in one last with n toe rooms, and what the largest humps would add.

    Attributes
    ----------
    off_mm : (n, m)
        How far points of the foot's outline are from the walls, + is inside; m is 0 if the toes are
        not known.
    heading : (n, m)
        + for points that are nearest to the outer wall, - for the inner one, 0 for the front.
    wider_mm : (n, m)
        By how much farther they would be.
    higher_mm : (n,)
        By how much the toe box would be higher over the toe.
    """

    off_mm: Floats
    heading: Floats
    wider_mm: Floats
    higher_mm: Floats


def toe_gains(
    given: Given, attempt: Attempt, lasts: JudgedLasts, rooms_mm: Floats, humps: Sequence[Hump]
) -> ToeGains:
    """What humps would add to a try, for one foot.

    Parameters
    ----------
    given : Given
        What ``attempt`` was made of.
    attempt : Attempt
    lasts : JudgedLasts
        The last with n toe rooms, its toes known.
    rooms_mm : (n,)
        The toe rooms, with the cavity.
    humps : sequence of Hump
    """
    carried, field = attempt.carried(given), replace(attempt.shape.solved.field, humps=tuple(humps))
    changed = carried.shape(field.moved_points(given.base.shape.vertices_mm))
    every, foot = np.arange(len(rooms_mm)), lasts.asked.toes[0]
    toes, heels = lasts.lasts.toes, lasts.heels
    assert toes is not None
    off_mm = heading = gains_mm = np.zeros((len(rooms_mm), 0))
    if not isinstance(foot.plan, str) and toes.whole.all():
        near = toes_of_foot(foot, toes, every, heels, heels.share, rooms_mm).near
        off_mm, heading = near.off_mm, near.heading
        outline_mm = attempt.made.with_sections.sections.toes_outline_mm
        wider = _wider_mm(outline_mm, toes_outline_mm(changed), near.along_mm)
        gains_mm = np.where(heading > 0.0, wider[0], wider[1]) * np.abs(heading)
    front_mm, behind_mm = _heights_mm(changed) - _heights_mm(attempt.made.shape)
    last_mm = lasts.lasts.measure("length").value
    share = behind_share(foot.foot.length_mm or np.nan, last_mm, rooms_mm)
    higher_mm = (1.0 - share) * front_mm + share * behind_mm
    return ToeGains(off_mm, heading, gains_mm, np.nan_to_num(higher_mm))


def _wider_mm(
    before: Floats | None, after: Floats | None, along_mm: Floats
) -> tuple[Floats, Floats]:
    """How far the outer and the inner edge of an outline (k, 3) moved out at places (n, m)."""
    if before is None or after is None:
        return np.zeros_like(along_mm), np.zeros_like(along_mm)
    x = before[:, 0]
    outer, inner = (np.interp(x, after[:, 0], after[:, k]) - before[:, k] for k in (1, 2))
    near_mm = along_mm + NEAR_MM[:, None, None]
    return np.interp(near_mm, x, -outer).min(axis=0), np.interp(near_mm, x, inner).min(axis=0)


def _heights_mm(shape: Shape) -> Floats:
    """The toe height of a last, and the height of its section at the toes, (2,)."""
    front_mm = measure_named(TOE_HEIGHT).taken_of(shape).value
    behind = shape.across(TOES_SECTION.share).points[:, 1]
    return np.array([np.nan if front_mm is None else front_mm, np.ptp(behind)])
