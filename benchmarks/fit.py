"""Does the right last come first? Feet against a grid of lasts, and lasts against a library.

    python -m benchmarks.fit [--feet 60] [--library 500] [--rescans 100] [--seed 1] [--write]

Everything goes through the whole pipeline: a random pose, noise, alignment, measures. Lasts come
from tools/lasts.py, feet from ../shared/scans/makehuman where it is present. ``--write`` puts the
tables into docs/fit.md.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks.alignment import scan_of
from benchmarks.tables import markdown, put
from footfit.geometry.flare.profile_distance import profile_distances
from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.judging.clearances import last_gain
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.fit.scoring import scales
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.measure import last_record, shape_measures
from footfit.pipeline.shelf.shelf import record_lasts
from footfit.results import LastLabels, LastRecord, Library, Profiled
from footfit.results.columns.vocabulary import Words
from tests.distortions import decimated, moved, random_pose, white_noise
from tests.reading import read_scan
from tests.scans import aligned, right_shape
from tools.lasts import LastSpec, graded, last_mesh, varied

SCANS = Path(__file__).resolve().parents[2] / "shared" / "scans" / "makehuman"
FOOT_MM = (215.0, 300.0)
LENGTHS, WIDTHS, FLARES_DEG = 9, (0.345, 0.365, 0.385), (4.0, 9.0, 14.0)
BALL = {"mt1_station": 0.655, "mt5_station": 0.56}  # under the foot's, at the toe room asked for
HEEL, FULLNESS = 0.240, 1.08  # over the length, and as the sample derby: a survey's mean foot's
JITTER = 0.3  # of the step between two widths, by which a foot's girth is off its group's
NOISE_MM, DECIMATION = 0.3, 4.0
GRADES_MM = np.arange(-2, 3) * 20.0 / 3.0
PROFILE = fit_profile("walking")

Mesh = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Planned:
    """A foot that is made for one width group: its mesh, its true length, its group."""

    mesh: Mesh
    length_mm: float
    group: int


def scanned(mesh: Mesh, side: str, rng: np.random.Generator, decimation: float = 1.0) -> Profiled:
    """A mesh as a scanner in another pose would give it, through the whole pipeline."""
    vertices, faces = mesh
    if decimation > 1.0:
        vertices, faces = decimated(vertices, faces, decimation)
    vertices = white_noise(vertices, rng, NOISE_MM)
    posed = moved(vertices, random_pose(rng))
    return profiled_scan(aligned(scan_of(posed, faces), side=side))


def stored(mesh: Mesh, name: str, rng: np.random.Generator) -> LastRecord:
    """A last as ingest would store it, scanned clean in a random pose."""
    vertices, faces = mesh
    shape = profiled_scan(aligned(scan_of(moved(vertices, random_pose(rng)), faces), side="right"))
    return last_record(shape, LastLabels(name))


# ---------------------------------------------------------------- the grid


def grid_lengths() -> np.ndarray:
    """The lasts' lengths: the feet's range and the toe room, in equal steps."""
    return np.linspace(*FOOT_MM, LENGTHS) + PROFILE.zones[0].target


def grid_specs() -> dict[str, LastSpec]:
    """The grid of lasts by name: length, width, flare."""
    return {
        f"{i}{j}{k}": LastSpec(
            length_mm=float(mm),
            ball_width_mm=float(mm) * width,
            heel_width_mm=float(mm) * HEEL,
            flare_deg=flare,
            fullness=FULLNESS,
            **BALL,
        )
        for i, mm in enumerate(grid_lengths())
        for j, width in enumerate(WIDTHS)
        for k, flare in enumerate(FLARES_DEG)
    }


def girth_mm(mesh: Mesh, kind: str) -> float:
    """The ball girth of a canonical right mesh."""
    rows = {row.name: row.measured.value for row in shape_measures(Shape(*mesh, kind))}
    return float(rows["ball_girth"] or np.nan)


def true_feet(paths: list[Path]) -> list[Mesh]:
    """The feet as canonical right meshes, each once clean."""
    return [right_shape(aligned(read_scan(path))) for path in paths]


def planned_foot(
    mesh: Mesh, length_mm: float, girths_mm: list[float], group: int, rng: np.random.Generator
) -> Planned:
    """A foot scaled along to the length, and across to a girth near its group's."""
    vertices, faces = mesh
    asked = next(rule.target for rule in PROFILE.zones if rule.zone == "ball_girth")
    step = 0.5 * (girths_mm[2] - girths_mm[0])
    wanted = girths_mm[group] - asked + rng.uniform(-JITTER, JITTER) * step
    low = vertices[:, 2] < 0.3 * np.ptp(vertices[:, 0])
    own = float(np.ptp(vertices[low, 0]))
    scale = np.array([length_mm / own, 1.0, 1.0])
    for _ in range(4):
        scale[1:] *= wanted / girth_mm((vertices * scale, faces), "foot")
    return Planned((vertices * scale, faces), length_mm, group)


def right_lengths(foot_mm: float, gains_mm: np.ndarray) -> set[int]:
    """The grid's lengths that are right: the nearest to the target by the profile's own scale,
    and one that is not further off by more than the length's repeatability. A last is longer along
    its bottom by ``gains_mm`` (9,).
    """
    rule = PROFILE.zones[0]
    below, above = scales(rule)
    off = grid_lengths() + gains_mm - foot_mm - rule.target
    score = np.abs(np.where(off < 0, off / below, off / above))
    return {int(i) for i in np.nonzero(score <= score.min() + 0.7 / below)[0]}


def grid_rows(count: int, seed: int) -> Iterator[list[str]]:
    """The share of feet whose first last has the right length, and the right width."""
    rng = np.random.default_rng(seed)
    specs = grid_specs()
    meshes = {name: last_mesh(spec) for name, spec in specs.items()}
    girths = {name: girth_mm(mesh, "last") for name, mesh in meshes.items()}
    lasts = tuple(stored(mesh, name, rng) for name, mesh in meshes.items())
    some = lasts[:: len(lasts) // LENGTHS]
    gains = last_gain(record_lasts(some).base, Words()).value
    library = Library(lasts, len(lasts), None)
    feet = true_feet(sorted(SCANS.glob("*.stl")))
    length, width, both, verdicts, missed = 0, 0, 0, [], []
    for at, foot_mm in enumerate(np.linspace(*FOOT_MM, count)):
        right = min(right_lengths(foot_mm, gains))
        own = [girths[f"{right}{j}1"] for j in range(3)]
        planned = planned_foot(feet[at % len(feet)], foot_mm, own, at % 3, rng)
        found = matched([scanned(planned.mesh, "right", rng)], library, Question(profile=PROFILE))
        first = found.candidates[0].last if found.candidates else "---"
        good = first[0] in {str(i) for i in right_lengths(foot_mm, gains)}
        fits = first[1] == str(planned.group)
        length, width, both = length + good, width + fits, both + (good and fits)
        verdicts.append(found.candidates[0].verdict if found.candidates else "none")
        if not (good and fits):
            missed.append(f"{foot_mm:.0f} mm, width {planned.group}: {first}")
    for words, hits in (("length", length), ("width group", width), ("both", both)):
        yield [f"right {words}", f"{hits} of {count}", f"{100 * hits / count:.0f} %"]
    for verdict in sorted(set(verdicts)):
        yield [f"first is {verdict}", f"{verdicts.count(verdict)} of {count}", ""]
    print("missed:", "; ".join(missed) or "none", file=sys.stderr)


# ---------------------------------------------------------------- the library


def library_specs(count: int, seed: int) -> dict[str, LastSpec]:
    """A library of models, each in five graded sizes."""
    rng = np.random.default_rng(seed + 1)
    models = -(-count // len(GRADES_MM))
    found = {}
    for model in range(models):
        spec = replace(varied(rng), rings=120, segments=84)
        for grade, step in enumerate(GRADES_MM):
            found[f"model-{model:03d}-{grade}"] = graded(spec, spec.length_mm + float(step))
    return dict(list(found.items())[:count])


def shape_rows(count: int, rescans: int, seed: int) -> Iterator[list[str]]:
    """The share of rescanned lasts that are first in the library, and how clearly."""
    rng = np.random.default_rng(seed + 2)
    specs = library_specs(count, seed)
    lasts = tuple(stored(last_mesh(spec), name, rng) for name, spec in specs.items())
    library = Library(lasts, len(lasts), None)
    chosen = rng.choice(sorted(specs), min(rescans, len(specs)), replace=False)
    first, same_model, own, next_best, spreads = 0, 0, [], [], []
    for name in chosen:
        scan = scanned(last_mesh(specs[str(name)]), "right", rng, DECIMATION)
        found = matched([scan], library, Question(by="shape", top=0))
        best = found.candidates[0].last
        first += best == name
        same_model += best[:9] == name[:9]
        distances = {c.last: c.distance for c in found.candidates}
        own.append(distances.pop(str(name)))
        next_best.append(min(distances.values()))
        spreads.append(_difference_noise(scan, library, str(name)))
    total = len(chosen)
    yield ["finds itself first", f"{first} of {total}", f"{100 * first / total:.1f} %"]
    yield ["finds its model", f"{same_model} of {total}", f"{100 * same_model / total:.1f} %"]
    yield ["distance to itself, median and worst", *_two(own)]
    yield ["distance to the next, median and least", *_two(next_best, worst=min)]
    yield ["profile distance D of a rescan, median and 95 %", *_two(spreads, worst=_p95)]


def _difference_noise(scan: Profiled, library: Library, name: str) -> float:
    """D of a rescan to its own record: what a distance is off by for the scan alone."""
    own = next(last for last in library.lasts if last.labels.name == name)
    return float(profile_distances(scan.flare, [own.flare]).total[0])


def _p95(values: list[float]) -> float:
    return float(np.percentile(values, 95))


def _two(values: list[float], worst: Callable[[list[float]], float] = max) -> list[str]:
    return [f"{np.median(values):.2f}", f"{worst(values):.2f}"]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--feet", type=int, default=60)
    parser.add_argument("--library", type=int, default=500)
    parser.add_argument("--rescans", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    started, parts = time.perf_counter(), [f"Seed {options.seed}.\n"]
    if options.feet and SCANS.is_dir():
        lasts = LENGTHS * len(WIDTHS) * len(FLARES_DEG)
        rows = list(grid_rows(options.feet, options.seed))
        parts += [
            f"{options.feet} feet from {FOOT_MM[0]:.0f} to {FOOT_MM[1]:.0f} mm, each made for one "
            f"of three widths,\nagainst a grid of {lasts} lasts ({LENGTHS} lengths, {len(WIDTHS)} "
            f"widths, {len(FLARES_DEG)} flares); random pose, noise {NOISE_MM} mm:\n",
            markdown(["by fit", "feet", "share"], rows),
        ]
    if options.library:
        rows = list(shape_rows(options.library, options.rescans, options.seed))
        parts += [
            f"{options.rescans} lasts rescanned (random pose, noise {NOISE_MM} mm, "
            f"{DECIMATION:.0f}x decimation) against {options.library} of which every model has "
            "five graded sizes:\n",
            markdown(["by shape", "", ""], rows),
        ]
    text = "\n".join(parts)
    print(text)
    print(f"{time.perf_counter() - started:.0f} s", file=sys.stderr)
    if options.write:
        put("fit.md", "fit", text)


if __name__ == "__main__":
    main()
