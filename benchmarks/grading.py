"""Graded runs: planned increments, held measures, and grading there and back.

    python -m benchmarks.grading [--count 64] [--seed 7] [--write]

Lasts of ``tools.last_specs.wide`` and, where it stands beside the project, of
``../shared/tools/lasts2.py``, with heels of 0-100 mm, are graded as `grade-last` grades them: from
file to file, there and back. The trials go through every set of parts that ``--hold`` takes, whole
sizes, halves, thirds and widths, and the ten rules.

The judge shares no code with grading: it reads the triangles of the written files. Girths are least
tapes by brute force over planes (``tests.tape_peer``), heights are those of the bottom's vertices,
and the way back is how far the corners of the triangles are from those of the first file, laid on
them. The measures are those that `grade-last` itself reads in each file. ``--write`` puts the table
into docs/custom-lasts.md.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np

import footfit
from benchmarks import stance
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.reading import prepared_source
from footfit.results import GradedLast
from tests.tape_peer import least_girths
from tools.last_specs import STYLES, wide
from tools.lasts import last_mesh
from tools.resting import at_rest

HEELS_MM = ((0.0, 20.0), (20.0, 40.0), (40.0, 60.0), (60.0, 80.0), (80.0, 100.0))
STEPS = (
    *((1.0, 0), (-1.0, 0), (0.5, 0), (-1.0 / 3.0, 0), (0.0, 1), (2.0 / 3.0, -1), (2.0, 0)),
    *((-1.0, 1), (1.0, 1)),
)
"""How many sizes, and how many widths."""
PARTS = ("heel", "spring", "bottom", "toe", "top")
HOLDS = tuple(",".join(some) or "none" for n in range(6) for some in combinations(PARTS, n))
RULES: dict[str, tuple[str, float, float, str, tuple[str, str, str]]] = {
    "eu": ("eu", 42.0, 1.0, "", ("F", "G", "H")),
    "uk": ("uk", 8.0, 1.0, "", ("F", "G", "H")),
    "us": ("us-men", 9.0, 1.0, "", ("C", "D", "E")),
    "uk-makers": ("uk", 8.0, 1.0, "", ("F", "G", "H")),
    "uk-child": ("uk", 10.0, 1.0, "C", ("F", "G", "H")),
    "mondopoint": ("mondopoint", 260.0, 5.0, "", ("99", "100", "101")),
    "mondopoint-7-5": ("mondopoint", 260.0, 7.5, "", ("99", "100", "101")),
    "jis": ("mondopoint", 260.0, 5.0, "", ("E", "EE", "EEE")),
    "china": ("mondopoint", 260.0, 10.0, "", ("1", "2", "3")),
    "geometric": ("eu", 42.0, 1.0, "", ("F", "G", "H")),
}
"""Of each rule: a size system, the base's size, how far apart sizes are, a letter, and widths."""
GROUPS = {
    "neither bottom nor top": lambda held: not held & {"bottom", "top"},
    "the top": lambda held: "top" in held and "bottom" not in held,
    "the bottom": lambda held: "bottom" in held and "top" not in held,
    "bottom and top": lambda held: {"bottom", "top"} <= held,
}
GIRTHS = ("ball_girth_least", "instep_girth_least")
STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])


@dataclass(frozen=True)
class Trial:
    """A last, what it is graded by, and how."""

    family: str
    mesh: bytes
    rule: str
    hold: str
    step: tuple[float, int]

    def label(self, sizes: float) -> str:
        """The label of so many sizes from the base's."""
        _, size, step, letter, _ = RULES[self.rule]
        return f"{size + sizes * step:.6f}".rstrip("0").rstrip(".") + letter


@dataclass(frozen=True)
class Graded:
    """What one way there and back came to, in mm: of measures, by the judge, of vertices."""

    hold: str
    measures: float
    judged: float
    heights: float
    back: float
    back_mean: float


def trials(count: int, seed: int) -> Iterator[Trial]:
    """Lasts of the families in turn, over the holds, the heels, the steps and the rules."""
    rng = np.random.default_rng(seed)
    styles = [style for style in STYLES if style not in ("child", "boot")]
    families = ("own", "second") if stance.second_family() else ("own",)
    for number in range(count):
        hold = HOLDS[number % len(HOLDS)]
        family = families[(number + number // len(HOLDS)) % len(families)]
        band, style = HEELS_MM[number % len(HEELS_MM)], styles[number % len(styles)]
        mesh = own_mesh(rng, style, band) if family == "own" else second_mesh(rng, band)
        rule = list(RULES)[number % len(RULES)]
        yield Trial(family, encoded_mesh(*mesh, "stl"), rule, hold, STEPS[number % len(STEPS)])


def own_mesh(
    rng: np.random.Generator, style: str, band: tuple[float, float]
) -> tuple[Floats, Ints]:
    """A last of the project's own generator."""
    return last_mesh(replace(wide(rng, style, band, rings=80, segments=56), side="right"))


def second_mesh(rng: np.random.Generator, band: tuple[float, float]) -> tuple[Floats, Ints]:
    """A last of the second family."""
    import lasts2

    mesh = lasts2.mesh(stance.other_spec(rng, band), n_long=90, n_round=56)
    return at_rest(np.array(mesh.vertices))[0], np.array(mesh.faces)


def corners_mm(data: bytes) -> Floats:
    """The corners (n, 3) of the triangles of a binary STL, in their order."""
    triangles = np.frombuffer(data[84:], dtype=STL)["corners"]
    return triangles.reshape(-1, 3).astype(np.float64)


def laid_on_mm(moved: Floats, still: Floats) -> Floats:
    """How far points (n, 3) are from the same ones, turned and shifted to lie on them (Kabsch)."""
    first, second = still - still.mean(axis=0), moved - moved.mean(axis=0)
    left, _, right = np.linalg.svd(second.T @ first)
    signs = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return np.asarray(np.linalg.norm(second @ left @ signs @ right - first, axis=1))


def shape_of(last: GradedLast) -> Shape:
    """The last in a written file, as it lies by itself: the tape's places depend on that."""
    labels = last.labels
    heel_mm, spring_mm = labels.heel_height_mm, labels.toe_spring_mm
    stands = ReadingOptions(
        units="mm", side="right", heel_height_mm=heel_mm, toe_spring_mm=spring_mm
    )
    return replace(prepared_source(Source(None, last.data, "stl"), stands).shape, kind="last")


def middle_rows(corners: Floats) -> Ints:
    """The corners (n,) that are lowest in strips across the seat and across the toe."""
    share = (corners[:, 0] - corners[:, 0].min()) / np.ptp(corners[:, 0])
    rows = []
    for low in (0.06, 0.10, 0.90, 0.94):
        strip = np.flatnonzero((share > low) & (share < low + 0.02))
        rows.append(strip[np.argmin(corners[strip, 2])])
    return np.array(rows)


def graded(trial: Trial, folder: Path) -> Graded | None:
    """What a last comes to, graded by a step and back; None if that is refused."""
    system, *_, widths = RULES[trial.rule]
    sizes, wider = trial.step
    keys = {"size_system": system, "rule": trial.rule, "hold": trial.hold}
    base, there = folder / "base.stl", folder / "there.stl"
    base.write_bytes(trial.mesh)
    start, end = trial.label(0.0), trial.label(sizes)
    old, new = widths[1], widths[1 + wider]
    try:
        asked = ",".join(dict.fromkeys((start, end)))
        in_widths = ",".join(dict.fromkeys((old, new)))
        run = footfit.grade(base, asked, base_size=start, base_width=old, widths=in_widths, **keys)
        first = next(last for last in run.lasts if (last.sizes, last.widths) == (0.0, 0.0))
        last = next(last for last in run.lasts if (last.size, last.width) == (end, new))
        there.write_bytes(last.data)
        stands = {
            "heel_height_mm": last.labels.heel_height_mm,
            "toe_spring_mm": last.labels.toe_spring_mm,
        }
        back = footfit.grade(
            there, start, base_size=end, base_width=new, widths=old, **stands, **keys
        ).lasts[0]
    except FootfitError as error:
        print(f"  refused: {trial.family}, {trial.hold}, {trial.step}: {error.message}")
        return None
    misses = [abs(each.difference) for each in last.measures if each.difference is not None]
    off = laid_on_mm(corners_mm(back.data), corners_mm(trial.mesh))
    return Graded(
        hold=trial.hold,
        measures=max(misses),
        judged=judged_mm(first, last),
        heights=raised_mm(trial, first, last),
        back=float(off.max()),
        back_mean=float(off.mean()),
    )


def judged_mm(first: GradedLast, last: GradedLast) -> float:
    """How far the increments of the planned girths are from their plan, by the other tape."""
    before_mm, after_mm = least_girths(shape_of(first)), least_girths(shape_of(last))
    return max(
        abs(after_mm[each.name] - before_mm[each.name] - (each.planned - each.base))
        for each in last.measures
        if each.name in GIRTHS and each.planned is not None
    )


def raised_mm(trial: Trial, first: GradedLast, last: GradedLast) -> float:
    """How far seat and tip are raised over the base's ground, as far as they are held."""
    held = set(trial.hold.split(","))
    seat, tip = held & {"heel", "bottom"}, held & {"spring", "bottom"}
    rows = middle_rows(corners_mm(first.data))
    rows = rows[[bool(seat), bool(seat), bool(tip), bool(tip)]]
    arc = shape_of(first).bottom_arc
    if not len(rows) or arc is None:
        return 0.0
    shift = corners_mm(last.data)[rows] - corners_mm(first.data)[rows]
    return float(np.abs(shift @ arc.stands[2, :3]).max())


FIGURES = {
    "measures": "measures off their plan, mm",
    "judged": "girths by the other tape, mm",
    "heights": "seat and tip raised, mm",
    "back": "there and back, worst vertex, mm",
    "back_mean": "mean vertex, mm",
}


def table_of(results: list[Graded]) -> str:
    """The worst of each figure by what is held."""
    rows = []
    for name, belongs in GROUPS.items():
        of_group = [each for each in results if belongs(set(each.hold.split(",")))]
        if of_group:
            worst = [max(getattr(each, figure) for each in of_group) for figure in FIGURES]
            rows.append([name, str(len(of_group)), *(f"{value:.3f}" for value in worst)])
    return markdown(["held", "runs", *FIGURES.values()], rows)


def main() -> None:
    """Print the table, or put it into the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=2 * len(HOLDS))
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for trial in trials(given.count, given.seed):
            result = graded(trial, Path(folder))
            if result is not None:
                results.append(result)
                print(trial.family, trial.rule, trial.step, result, flush=True)
    words = f"{len(results)} of {given.count} were graded; seed {given.seed}."
    table = f"{table_of(results)}\n\n{words}"
    print(table)
    if given.write:
        put("custom-lasts.md", "graded", table)


if __name__ == "__main__":
    main()
