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
from footfit.geometry.deform.wishes import SOLVER, Goal, SolverSettings, Wishes
from footfit.geometry.numeric.arrays import Floats

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


@dataclass(frozen=True)
class Solution:
    """A field, where it brings the vertices (n, 3), and the measures there, (goals,).

    ``knobs`` are turned to where the search ended. ``targets_mm`` (goals,) are the targets; those
    that gave way are where the search moved them. ``effect`` (goals, knobs) is how each measure
    changes with each knob, as the search knows it; None if no step was needed. ``met`` says whether
    the search ended because it arrived.
    """

    field: Field
    knobs: tuple[Knob, ...]
    vertices_mm: Floats
    values_mm: Floats
    targets_mm: Floats
    rounds: int
    effect: Floats | None = None
    met: bool = True


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
    wishes = Wishes.of(goals, settings)
    units = np.array([knob.unit for knob in knobs])
    all_costs = _own_costs(start, knobs, units, settings)
    if costs is not None:
        all_costs = np.vstack([all_costs, costs])
    values = np.array([knob.value for knob in knobs])

    chart = start.chart
    places = None if start.even else chart.places(chart.standing(vertices_mm))

    def at(values: Floats) -> Solution:
        field = turned_field(start, knobs, values)
        turned = tuple(replace(k, value=v) for k, v in zip(knobs, values.tolist(), strict=True))
        moved = field.moved_points(vertices_mm, places)
        return Solution(field, turned, moved, read(moved), wishes.targets, 0)

    best = at(values)
    if wishes.missed_mm(best.values_mm) + wishes.beyond_mm(best.values_mm) <= settings.near_mm:
        return best
    effect = _effects(best.field, knobs, goals, vertices_mm, settings)
    if settings.ahead_mm and any(isinstance(goal.probe, Probe) for goal in goals):
        for column in (k for k, knob in enumerate(knobs) if knob.curve == "ahead"):
            by = np.eye(len(knobs))[column] * settings.ahead_mm
            change = (at(values + by).values_mm - best.values_mm) / settings.ahead_mm
            effect[:, column] = np.where(np.isfinite(change), change, effect[:, column])
    rounds, most, failed = 0, settings.most, 0
    while not (
        rounds == settings.rounds or failed > settings.failing or wishes.met(best.values_mm)
    ):
        rounds += 1
        if rounds == settings.shaping + 1:  # the shape is found: only what firm goals still miss
            wishes = wishes.settled(best.values_mm)
        from_still = values if wishes.shaping else np.zeros(len(knobs))
        step, wishes = wishes.step(from_still, best.values_mm, effect, all_costs)
        step *= min(1.0, most / float(np.abs(step / units).max()))
        trial = at(values + step)
        more = np.nan_to_num(trial.values_mm - best.values_mm - effect @ step)
        if wishes.worse(best.values_mm, trial.values_mm):
            best, values, most, failed = trial, values + step, settings.most, 0
        else:
            failed += 1
            most = settings.shorter * float(np.abs(step / units).max())
        if np.isfinite(trial.values_mm[wishes.firm]).all():
            effect += np.outer(more, step) / (step @ step)
    met = wishes.met(best.values_mm)
    return replace(best, targets_mm=wishes.targets, rounds=rounds, effect=effect, met=met)


def _own_costs(
    start: Field, knobs: Sequence[Knob], units: Floats, settings: SolverSettings
) -> Floats:
    """What the sizes of knobs and the bends of curves cost, (k, knobs)."""
    cheaper = np.array([settings.heights if k.curve == "higher" else 1.0 for k in knobs])
    bends = [_bends(start, knobs, name) / settings.bend for name in SCALES]
    return np.asarray(np.vstack([np.diag(1.0 / (settings.size * units)), *bends]) * cheaper)


def _effects(
    start: Field,
    knobs: Sequence[Knob],
    goals: Sequence[Goal],
    vertices_mm: Floats,
    settings: SolverSettings,
) -> Floats:
    """How each measure changes with each knob of the first field, (goals, knobs)."""
    chart = start.chart
    result = np.zeros((len(goals), len(knobs)))
    patterns = np.stack([knob.pattern for knob in knobs], axis=1)
    for row, goal in enumerate(goals):
        if not isinstance(goal.probe, Probe):
            result[row] = goal.probe
            continue
        probe = goal.probe
        places = chart.places(chart.standing(vertices_mm[probe.rows]))

        def value(field: Field, probe: Probe = probe, places: Places = places) -> float:
            return probe.value(chart.resting(field.moved(places)))

        before = value(start)
        near = (places.splines @ patterns).any(axis=0) | bool(start.turned.any())
        for column in np.flatnonzero(near).tolist():  # no other knob moves the probe's points
            step = settings.step * knobs[column].unit
            after = value(turned_field(start, [knobs[column]], np.array([step])))
            result[row, column] = (after - before) / step
    return result


def _bends(start: Field, knobs: Sequence[Knob], curve: str) -> Floats:
    """The second differences of one curve for each knob, (knots - 2, knobs)."""
    knots = start.chart.settings.knots
    patterns = [knob.pattern if knob.curve == curve else np.zeros(knots) for knob in knobs]
    return np.diff(np.stack(patterns, axis=1), n=2, axis=0)
