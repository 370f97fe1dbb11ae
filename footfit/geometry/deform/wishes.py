"""What a search asks of the measures of a last: targets, ranges, and targets that give way.

A measure that is only pulled has a range that it should not leave. If it leaves it with all targets
met, the target that gives way to it moves, within a range of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.deform.probes import Probe
from footfit.geometry.numeric.arrays import Bools, Floats, Ints

ROUNDS = 4
"""So often at most a step is taken anew, because it would lead out of a range."""
NEAR_MM = 1e-6


@dataclass(frozen=True, slots=True)
class SolverSettings:
    """What the curves cost, and when it is enough.

    Attributes
    ----------
    bend, size : float
        What costs as much as a goal's ``miss_mm``, of a logarithm of a scale: the second difference
        from knot to knot, and the value.
    heights : float
        What a scale of heights costs, over a scale of widths: it bends less of the surface.
    settled_mm, near_mm : float
        The search ends when no firm measure is farther from its target, and does not begin if none
        is farther than ``near_mm``: a last that fits is left as it is.
    rounds, shaping : int, int
        After the first ``shaping`` rounds nothing is pulled any more, and a round is the smoothest
        step that brings the firm measures to their targets.
    failing : int
        The search ends if more steps than these, one after the other, do not help: the probes are
        out of date.
    step, most : float
        Of the differences that a knob's effect is taken by, and the most that a knob is turned in
        a round, in the knob's unit.
    ahead_mm : float
        If it is not 0, the effect of a knob that moves places ahead is read, and not probed: it
        moves the planes of girths too. The difference is taken by so many mm.
    shorter : float
        A step that does not help is tried again at this share of its length.
    loose_mm : float
        The miss that costs as much, of a target that gives way to another goal's range.
    beyond_mm : float
        A range counts as left if a measure lies so far outside.
    """

    bend: float = 0.01
    size: float = 0.05
    heights: float = 0.5
    settled_mm: float = 0.05
    near_mm: float = 0.1
    rounds: int = 12
    shaping: int = 5
    failing: int = 12
    step: float = 3e-3
    most: float = 0.25
    ahead_mm: float = 0.0
    shorter: float = 0.5
    loose_mm: float = 1.0
    beyond_mm: float = 0.2


SOLVER = SolverSettings()


@dataclass(frozen=True, slots=True)
class Goal:
    """A measure's target in mm, and the probe that answers for it where the search begins.

    Instead of a probe it may have what a search before knew of its change with each knob, (knobs,).
    A miss of ``miss_mm`` costs as much as a bend or a size of ``SolverSettings``. A goal that is
    not ``firm`` is only pulled towards its target: the search does not wait for it. Each goal
    should stay within its ``range_mm``. If the goal in the row ``gives_way_to`` cannot stay in its
    own one, the target moves within ``range_mm``. To be outside of a range by ``edge_mm`` costs as
    much as a miss of ``miss_mm``.
    """

    target_mm: float
    probe: Probe | Floats
    miss_mm: float = 0.01
    firm: bool = True
    range_mm: tuple[float, float] = (-np.inf, np.inf)
    edge_mm: float = 0.05
    gives_way_to: int | None = None


@dataclass(frozen=True)
class Wishes:
    """What goals (n,) ask for, in mm.

    Attributes
    ----------
    asked, targets : (n,)
        The targets as they were given, and as they moved.
    miss, edge, firm : (n,)
        Of :class:`Goal`.
    low, high : (n,)
        The ends of their ranges.
    partner : (n,)
        The row of the goal that each gives way to; -1 if there is none.
    shaping : bool
        Whether anything is pulled, and targets may move.
    """

    asked: Floats
    targets: Floats
    miss: Floats
    edge: Floats
    firm: Bools
    low: Floats
    high: Floats
    partner: Ints
    settings: SolverSettings
    shaping: bool = True

    @classmethod
    def of(cls, goals: Sequence[Goal], settings: SolverSettings) -> Wishes:
        """Those of goals."""
        targets = np.array([goal.target_mm for goal in goals])
        partner = [-1 if goal.gives_way_to is None else goal.gives_way_to for goal in goals]
        return cls(
            targets,
            targets,
            np.array([goal.miss_mm for goal in goals]),
            np.array([goal.edge_mm for goal in goals]),
            np.array([goal.firm for goal in goals], dtype=bool),
            np.array([goal.range_mm[0] for goal in goals]),
            np.array([goal.range_mm[1] for goal in goals]),
            np.array(partner, dtype=np.int64),
            settings,
        )

    def missed_mm(self, values: Floats) -> float:
        """How far the worst of the firm measures is from its target; infinite if one is gone."""
        off_mm = np.abs(self.targets - values)[self.firm]
        return float(np.where(np.isfinite(off_mm), off_mm, np.inf).max(initial=0.0))

    def beyond_mm(self, values: Floats) -> float:
        """How far the worst measure lies outside of its range."""
        return float(np.nan_to_num(self._outside_mm(values)).max(initial=0.0))

    def _outside_mm(self, values: Floats) -> Floats:
        return np.asarray(np.maximum(self.low - values, values - self.high).clip(0.0))

    def met(self, values: Floats) -> bool:
        """Whether the search may end."""
        inside = not self.shaping or self.beyond_mm(values) <= self.settings.beyond_mm
        return inside and self.missed_mm(values) <= self.settings.settled_mm

    def worse(self, before: Floats, after: Floats) -> bool:
        """Whether the values before were worse than those after."""
        first, second = (self.missed_mm(v) + self.beyond_mm(v) for v in (before, after))
        return second < first

    def settled(self, values: Floats) -> Wishes:
        """The same without pulls: targets stay, and what is outside of a range goes no farther."""
        known = np.where(np.isfinite(values), values, self.targets)
        low, high = np.minimum(self.low, known), np.maximum(self.high, known)
        return replace(self, low=low, high=high, shaping=False)

    def step(
        self, from_still: Floats, values: Floats, effect: Floats, costs: Floats
    ) -> tuple[Floats, Wishes]:
        """By how much the knobs are turned next, (knobs,), and the wishes with their targets.

        Parameters
        ----------
        from_still : (knobs,)
            How far each knob is turned already, as far as that costs.
        values : (n,)
            The measures now.
        effect : (n, knobs)
            How each measure changes with each knob.
        costs : (k, knobs)
            Sums of knobs that should stay small.
        """
        outside = gives = np.zeros(len(values), dtype=bool)
        ends, step = self.targets, np.zeros(len(from_still))
        for _ in range(ROUNDS):
            gives = (self.partner >= 0) & outside[self.partner] & self.shaping
            edge = outside & (gives | ~self.firm)
            miss = np.where(gives, self.settings.loose_mm, self.miss)
            miss = np.where(edge, self.edge, miss)
            wanted = np.where(edge, ends, self.asked if self.shaping else self.targets)
            counts = (self.firm & ~gives) | edge | self.shaping
            off = np.nan_to_num((wanted - values) * counts / miss)
            rows = np.vstack([effect * (counts / miss)[:, None], costs])
            step = np.linalg.lstsq(rows, np.concatenate([off, -costs @ from_still]), rcond=None)[0]
            after = values + effect @ step
            leaves = np.nan_to_num(self._outside_mm(after)) > NEAR_MM
            if not (leaves & ~outside).any():
                break
            ends = np.where(leaves & ~outside, np.clip(after, self.low, self.high), ends)
            outside = outside | leaves
        if not self.shaping:
            return step, self
        kept = np.clip(values + effect @ step, self.low, self.high)
        return step, replace(self, targets=np.where(gives, kept, self.asked))
