"""Graded runs: planned increments, held measures, and grading there and back.

    python -m benchmarks.grading [--count 8] [--seed 7] [--write]

Lasts of ``tools.last_specs.wide`` and, where it stands beside the project, of
``../shared/tools/lasts2.py``, with heels of 0-80 mm, are graded by a size up, a size down, two
sizes up or a width, and back. The judge shares no code with the deformation: girths are least tapes
by brute force over planes (``tests.tape_peer``), heights are read from the vertices of the bottom,
and the way back from the vertices themselves. ``--write`` puts the table into docs/custom-lasts.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from benchmarks import stance
from benchmarks.tables import markdown, put
from footfit.errors import OutOfReach
from footfit.geometry.fit.sizes import SYSTEMS
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.graded_runs.grade_plan import (
    HEEL,
    SPRING,
    GradePlan,
    grade_plan,
    standing,
    targets,
)
from footfit.pipeline.graded_runs.grade_shape import GradeStep, graded
from footfit.pipeline.graded_runs.grading_rules import grading_rule
from footfit.pipeline.graded_runs.run_increments import CHECKED
from tests.tape_peer import least_girths
from tools.last_specs import STYLES, wide
from tools.lasts import last_mesh

HEELS_MM = ((0.0, 20.0), (20.0, 40.0), (40.0, 60.0), (60.0, 80.0))
STEPS = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (2.0, 0.0))
HOLDS = ("heel,spring,toe", "heel,spring,bottom,toe", "none")
GIRTHS = ("ball_girth_least", "instep_girth_least")
Measures = dict[str, float]
Place = tuple[float, float]


@dataclass(frozen=True)
class Graded:
    """What one way there and back came to, in mm: of measures, by the judge, of vertices."""

    family: str
    hold: str
    measures: float
    judged: float
    heights: float
    back: float
    back_mean: float


def bases(count: int, seed: int) -> Iterator[tuple[str, Shape]]:
    """Lasts of both families, from low heels to high ones."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        band = HEELS_MM[number % len(HEELS_MM)]
        style = [style for style in STYLES if style not in ("child", "boot")][number % 3]
        spec = wide(rng, style, band, rings=110, segments=72)
        yield "own", Shape(*last_mesh(replace(spec, side="right")), "last")
        if stance.second_family():
            import lasts2

            mesh = lasts2.mesh(stance.other_spec(rng, band), n_long=130, n_round=72)
            vertices = stance.at_rest(np.array(mesh.vertices))[0]
            yield "second", Shape(vertices, np.array(mesh.faces), "last")


def measured(shape: Shape) -> Measures:
    """The measures that a run checks."""
    values = {name: measure_named(name).value_of(shape).value for name in CHECKED}
    return {name: value for name, value in values.items() if value is not None}


def heights_mm(shape: Shape, stands: Floats, rows: Ints) -> Floats:
    """How high some vertices stand over the ground of the base, (n,)."""
    return np.asarray(shape.vertices_mm[rows] @ stands[2, :3] + stands[2, 3])


def middle_rows(shape: Shape, stands: Floats) -> Ints:
    """The vertices (n,) that are lowest in strips across the seat and across the toe."""
    standing_mm = shape.vertices_mm @ stands[:3, :3].T + stands[:3, 3]
    share = standing_mm[:, 0] / standing_mm[:, 0].max()
    rows = []
    for low in (0.06, 0.10, 0.90, 0.94):
        strip = np.flatnonzero((share > low) & (share < low + 0.02))
        rows.append(strip[np.argmin(standing_mm[strip, 2])])
    return np.array(rows)


def trial(family: str, shape: Shape, hold: str, step: Place) -> Graded | None:
    """A last, graded by a step and back; None if it has no stance or cannot be reached."""
    rule = grading_rule("eu")
    plan = grade_plan(rule, SYSTEMS["eu"], ("42", "G"), ("42", None), hold)
    if shape.stance is None:
        return None
    labels = standing(targets(plan, measured(shape), 0.0, 0.0), None)
    base = Shape(shape.vertices_mm, shape.faces, "last", labels)
    base_mm = measured(base)
    count = round(max(map(abs, step)))
    path = [(step[0] * at / count, step[1] * at / count) for at in range(count + 1)]
    try:
        there = base
        for before, after in pairwise(path):
            there = one_step(there, base_mm, plan, before, after)
        back = there
        for before, after in pairwise(path[::-1]):
            back = one_step(back, base_mm, plan, before, after)
    except OutOfReach as error:
        print(f"  refused: {family}, {hold}, {step}: {error.message}")
        return None
    planned = targets(plan, base_mm, *step)
    reached = measured(there)
    misses = [abs(reached[name] - goal.target) for name, goal in planned.items() if name in reached]
    before_mm, after_mm = least_girths(base), least_girths(there)
    judged = [
        abs(after_mm[name] - before_mm[name] - (planned[name].target - base_mm[name]))
        for name in GIRTHS
        if name in planned
    ]
    assert base.stance is not None
    stands = base.stance.standing_transform
    rows = middle_rows(base, stands)
    moved = heights_mm(there, stands, rows) - heights_mm(base, stands, rows)
    off = np.linalg.norm(back.vertices_mm - base.vertices_mm, axis=1)
    heights = float(np.abs(moved).max()) if hold != "none" else 0.0
    return Graded(
        family, hold, max(misses), max(judged), heights, float(off.max()), float(off.mean())
    )


def one_step(
    shape: Shape, base_mm: Measures, plan: GradePlan, before: Place, after: Place
) -> Shape:
    """A last after one step of a plan."""
    old, new = (targets(plan, base_mm, *at) for at in (before, after))
    goals = {name: goal.target for name, goal in new.items() if name not in (HEEL, SPRING)}
    ratio = new["bottom_length"].target / old["bottom_length"].target
    return graded(shape, GradeStep(ratio, goals, plan.held, standing(new, None)))


def main() -> None:
    """Print the table, or put it into the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    results: list[Graded] = []
    tried = 0
    for number, (family, shape) in enumerate(bases(given.count, given.seed)):
        hold, step = HOLDS[number % len(HOLDS)], STEPS[(number // 2) % len(STEPS)]
        tried += 1
        result = trial(family, shape, hold, step)
        if result is not None:
            results.append(result)
            print(result)
    rows = []
    for hold in HOLDS:
        of_hold = [each for each in results if each.hold == hold]
        if of_hold:
            worst = [max(getattr(each, name) for each in of_hold) for name in FIGURES]
            rows.append([hold, str(len(of_hold)), *(f"{value:.3f}" for value in worst)])
    heads = ["held", "runs", *FIGURES.values()]
    table = markdown(heads, rows)
    print(table)
    print(f"{len(results)} of {tried} were graded")
    if given.write:
        put("custom-lasts.md", "graded", table)


FIGURES = {
    "measures": "measures off their plan, mm",
    "judged": "girths by the other tape, mm",
    "heights": "seat and tip raised, mm",
    "back": "there and back, worst vertex, mm",
    "back_mean": "mean vertex, mm",
}


if __name__ == "__main__":
    main()
