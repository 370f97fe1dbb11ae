"""The field that brings measures of a last to their targets, with curves as smooth as they can be.

Gauss-Newton: the measures are read as they are defined, on the last as the field has moved it. How
they answer to each knob is taken from probes, which keep their planes. After each step it is put
right by what the step did (Broyden), because the planes of measures move too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.deform.chart import Places
from footfit.geometry.deform.field import Field
from footfit.geometry.deform.probes import Probe
from footfit.geometry.numeric.arrays import Bools, Floats


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
    step, most : float
        Of the differences that a knob's effect is taken by, and the most that a knob is turned in
        a round, in the knob's unit.
    shorter : float
        A step that does not help is tried again at this share of its length.
    """

    bend: float = 0.01
    size: float = 0.05
    heights: float = 0.5
    settled_mm: float = 0.05
    near_mm: float = 0.1
    rounds: int = 12
    shaping: int = 5
    step: float = 3e-3
    most: float = 0.25
    shorter: float = 0.5


SOLVER = SolverSettings()
SCALES = ("wider", "higher")
"""The curves whose bends cost; the others have as few knobs as they need."""


@dataclass(frozen=True, slots=True)
class Knob:
    """One number of a field: ``pattern`` (knots,) times it is added to the curve of that name.

    A knob of ``unit`` 1 costs its size; a knob in mm has a larger unit. The search begins with it
    turned to ``value``.
    """

    curve: str
    pattern: Floats
    unit: float = 1.0
    value: float = 0.0


@dataclass(frozen=True, slots=True)
class Goal:
    """A measure's target in mm, and the probe that answers for it where the search begins.

    A miss of ``miss_mm`` costs as much as a bend or a size of ``SolverSettings``. A goal that is
    not ``firm`` is only pulled towards its target: the search does not wait for it.
    """

    target_mm: float
    probe: Probe
    miss_mm: float = 0.01
    firm: bool = True


@dataclass(frozen=True)
class Solution:
    """A field, where it brings the vertices (n, 3), and the measures there, (goals,).

    ``knobs`` are turned to where the search ended.
    """

    field: Field
    knobs: tuple[Knob, ...]
    vertices_mm: Floats
    values_mm: Floats
    rounds: int


def turned_field(field: Field, knobs: Sequence[Knob], values: Floats) -> Field:
    """A field with its knobs turned by ``values`` (knobs,)."""
    curves: dict[str, Floats] = {}
    for knob, value in zip(knobs, values, strict=True):
        curve = curves.get(knob.curve, getattr(field, knob.curve))
        curves[knob.curve] = curve + value * knob.pattern
    return field.with_curves(**curves)


def solution(
    start: Field,
    knobs: Sequence[Knob],
    vertices_mm: Floats,
    goals: Sequence[Goal],
    read: Callable[[Floats], Floats],
    costs: Floats | None = None,
    settings: SolverSettings = SOLVER,
) -> Solution:
    """The smoothest field whose measures meet their targets, or come as near as they can.

    Parameters
    ----------
    start : Field
        What the knobs are turned from.
    knobs : sequence of Knob
    vertices_mm : (n, 3)
        The last that is changed, in its resting frame.
    goals : sequence of Goal
    read : callable
        The measures (goals,) of moved vertices (n, 3).
    costs : (k, knobs), optional
        Sums of knobs that should stay small, beside their sizes and bends.
    """
    targets = np.array([goal.target_mm for goal in goals])
    miss = np.array([goal.miss_mm for goal in goals])
    firm = np.array([goal.firm for goal in goals], dtype=bool)
    units = np.array([knob.unit for knob in knobs])
    cheaper = np.array([settings.heights if k.curve == "higher" else 1.0 for k in knobs])
    bends = [_bends(start, knobs, name) / settings.bend for name in SCALES]
    own_costs = np.vstack([np.diag(1.0 / (settings.size * units)), *bends]) * cheaper
    all_costs = own_costs if costs is None else np.vstack([own_costs, costs])
    values = np.array([knob.value for knob in knobs])

    def at(values: Floats, rounds: int) -> Solution:
        field = turned_field(start, knobs, values)
        turned = tuple(replace(k, value=v) for k, v in zip(knobs, values.tolist(), strict=True))
        moved = field.moved_points(vertices_mm)
        return Solution(field, turned, moved, read(moved), rounds)

    best = at(values, 0)
    if _worst(best, targets, firm) <= settings.near_mm:
        return best
    effect = _effects(best.field, knobs, [goal.probe for goal in goals], vertices_mm, settings)
    rounds, most = 0, settings.most
    while _worst(best, targets, firm) > settings.settled_mm and rounds < settings.rounds:
        rounds += 1
        misses, from_still = np.nan_to_num((targets - best.values_mm) / miss), values
        if rounds > settings.shaping:  # the shape is found: only what the firm goals still miss
            misses, from_still = np.where(firm, misses, 0.0), np.zeros(len(knobs))
        step = _step(from_still, effect / miss[:, None], misses, all_costs)
        step *= min(1.0, most / float(np.abs(step / units).max()))
        trial = at(values + step, rounds)
        more = np.nan_to_num(trial.values_mm - best.values_mm - effect @ step)
        if _worst(trial, targets, firm) < _worst(best, targets, firm):
            best, values, most = trial, values + step, settings.most
        else:
            most = settings.shorter * float(np.abs(step / units).max())
        if np.isfinite(trial.values_mm[firm]).all():
            effect += np.outer(more, step) / (step @ step)
    return replace(best, rounds=rounds)


def _worst(solved: Solution, targets_mm: Floats, firm: Bools) -> float:
    """How far the worst of the firm measures is from its target; infinite if one is gone."""
    off_mm = np.abs(targets_mm - solved.values_mm)[firm]
    return float(np.where(np.isfinite(off_mm), off_mm, np.inf).max(initial=0.0))


def _effects(
    start: Field,
    knobs: Sequence[Knob],
    probes: Sequence[Probe],
    vertices_mm: Floats,
    settings: SolverSettings,
) -> Floats:
    """How each measure changes with each knob of the first field, (goals, knobs)."""
    chart = start.chart
    result = np.empty((len(probes), len(knobs)))
    for row, probe in enumerate(probes):
        places = chart.places(chart.standing(vertices_mm[probe.rows]))

        def value(field: Field, probe: Probe = probe, places: Places = places) -> float:
            return probe.value(chart.resting(field.moved(places)))

        before = value(start)
        for column, knob in enumerate(knobs):
            step = settings.step * knob.unit
            after = value(turned_field(start, [knob], np.array([step])))
            result[row, column] = (after - before) / step
    return result


def _step(values: Floats, effects: Floats, misses: Floats, costs: Floats) -> Floats:
    """By how much the knobs are turned next, (knobs,): the least squares of misses and costs.

    ``effects`` (goals, knobs) and ``misses`` (goals,) are over what each miss may cost.
    """
    rows = np.vstack([effects, costs])
    wanted = np.concatenate([misses, -costs @ values])
    return np.asarray(np.linalg.lstsq(rows, wanted, rcond=None)[0])


def _bends(start: Field, knobs: Sequence[Knob], curve: str) -> Floats:
    """The second differences of one curve for each knob, (knots - 2, knobs)."""
    knots = start.chart.settings.knots
    patterns = [knob.pattern if knob.curve == curve else np.zeros(knots) for knob in knobs]
    return np.diff(np.stack(patterns, axis=1), n=2, axis=0)
