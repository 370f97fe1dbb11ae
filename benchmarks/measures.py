"""How well a measure comes back, and how near the truth it is.

    python -m benchmarks.measures [--lasts 20] [--seed 1] [--write]

Shapes are the generated and the other feet of ../shared/scans where they are present, and the
generator's lasts of every style and heel. Each is read, aligned and measured as it is, and again in
a random pose: clean, with 0.3 mm of white noise, with 0.3 mm of a scanner's ripple, and decimated
to a quarter.
``--write`` puts the tables into docs/measures.md.
"""

from __future__ import annotations

import argparse
import csv
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.alignment import random_specs, scan_of
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import MEASURES
from footfit.pipeline.scan.measure import shape_measures
from tests import distortions
from tests.reading import read_scan
from tests.scans import aligned
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import last_mesh

SCANS = Path(__file__).resolve().parents[2] / "shared" / "scans"
CHANGES = ("pose", "noise", "ripple", "decimated")
ASKED = ("pose", "noise", "decimated")
NOISE_MM = 0.3
BOUNDS_MM = {  # of the 95th percentile under what is ASKED
    **dict.fromkeys(("length", "functional_length", "tape_length"), 0.5),
    **{entry.name: 1.0 for entry in MEASURES if "width" in entry.name},
    **{entry.name: 2.0 for entry in MEASURES if "girth" in entry.name},
}
TRUTHS = {"length": ("length", 1.0), "ball_width_orthogonal": ("ball_width", 1.5)}


@dataclass(frozen=True)
class Case:
    """One shape and, where it was generated, what is known of it."""

    name: str
    kind: str
    side: str
    vertices: np.ndarray
    faces: np.ndarray
    truth: dict[str, float]


def cases(rng, lasts):
    """The feet at hand, and ``lasts`` generated lasts."""
    table = SCANS / "makehuman" / "truth.csv"
    rows = list(csv.DictReader(table.open())) if table.exists() else []
    for row in rows:
        scan = read_scan(table.parent / row["file"])
        truth = {name: float(row[column]) for name, (column, _) in TRUTHS.items()}
        side = {"L": "left", "R": "right"}[row["side"]]
        yield Case(row["file"], "foot", side, scan.vertices_mm, scan.faces, truth)
    for name in ("dupontgu_L", "dupontgu_R", "MHR_template_R", "FIND_template"):
        path = SCANS / f"{name}.stl"
        if path.exists():
            scan = read_scan(path)
            side = "right" if name.endswith("R") else "left"
            yield Case(name, "foot", side, scan.vertices_mm, scan.faces, {})
    for index in range(lasts):
        style, band = STYLES[index % len(STYLES)], HEEL_BANDS_MM[index % len(HEEL_BANDS_MM)]
        spec = wide(rng, style, band, side="right", rings=100, segments=72)
        yield Case(f"last {index}", "last", "right", *last_mesh(spec), {})


def changed(case, change, rng):
    """The case's mesh under one change, in a random pose."""
    vertices, faces = case.vertices, case.faces
    if change == "noise":
        vertices = distortions.white_noise(vertices, rng, NOISE_MM)
    if change == "ripple":
        vertices = distortions.rippled(vertices, faces, rng, NOISE_MM)
    if change == "decimated":
        vertices, faces = distortions.decimated(vertices, faces, 4.0)
    return distortions.moved(vertices, distortions.random_pose(rng)), faces


def values(vertices, faces, side):
    """The measures of one mesh by name, through the whole way from a scan."""
    scan = aligned(scan_of(vertices, faces), side=side)
    rows = shape_measures(scan.prepared.shape)
    return {row.name: row.measured.value for row in rows}


class Findings:
    """What was found: differences by kind, measure and change; errors by measure."""

    def __init__(self):
        self.moved = defaultdict(lambda: defaultdict(list))
        self.lost = defaultdict(int)
        self.errors = defaultdict(list)
        self.failed = []

    def take(self, case, rng):
        """Measure one case, as it is and changed."""
        before = values(case.vertices, case.faces, case.side)
        for change in CHANGES:
            try:
                after = values(*changed(case, change, rng), case.side)
            except FootfitError as error:
                self.failed.append(f"{case.name}, {change}: {error.code}")
                continue
            self._compare(case, change, before, after)

    def _compare(self, case, change, before, after):
        for name in set(before) | set(after):
            one, other = before.get(name), after.get(name)
            if one is not None and other is not None:
                self.moved[case.kind, name][change].append(other - one)
            elif one is not other:
                self.lost[case.kind, name] += 1
        for name, truth in case.truth.items():
            if after.get(name) is not None:
                self.errors[case.kind, name].append(after[name] - truth)


def rms(numbers):
    """The root of the mean square; NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(numbers)))) if len(numbers) else float("nan")


def repeat_rows(found: Findings, kind: str) -> Iterator[list[str]]:
    """A row per measure: the spread under each change, the 95th percentile of all."""
    for entry in MEASURES:
        moved = found.moved[kind, entry.name]
        every = np.array([value for change in CHANGES for value in moved[change]])
        if not len(every):
            continue
        spread = [f"{rms(moved[change]):.2f}" for change in CHANGES]
        asked = [value for change in ASKED for value in moved[change]]
        p95 = float(np.percentile(np.abs(asked), 95))
        bound, sd = BOUNDS_MM.get(entry.name), f"{entry.sd_of(kind):g}"
        lost = found.lost[kind, entry.name]
        yield [
            entry.name, str(len(every)), *spread, f"{rms(every):.2f}", f"{p95:.2f}",
            "" if bound is None else f"{bound:g}", str(lost) if lost else "", sd,
        ]  # fmt: skip


def truth_rows(found: Findings) -> Iterator[list[str]]:
    """A row per truth: bias and mean absolute error over all changes."""
    for (kind, name), errors in sorted(found.errors.items()):
        mae = float(np.mean(np.abs(errors)))
        yield [kind, name, str(len(errors)), f"{np.mean(errors):+.2f}", f"{mae:.2f}"]


def seconds(kind: str, faces: int = 30_000) -> float:
    """The core time of all measures of a generated last of about that many faces, best of five."""
    from dataclasses import replace

    spec = next(random_specs(np.random.default_rng(0), 1))
    vertices, triangles = last_mesh(replace(spec, rings=150, segments=faces // 300))
    best = np.inf
    for _ in range(5):
        start = time.process_time()
        shape_measures(Shape(vertices, triangles, kind))
        best = min(best, time.process_time() - start)
    return float(best)


def main() -> None:
    """Run and print, or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lasts", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    found = Findings()
    for case in cases(rng, arguments.lasts):
        found.take(case, rng)
    head = ["measure", "n", *CHANGES, "rms", "p95", "bound", "lost", "sd"]
    tables = {
        "feet": markdown(head, list(repeat_rows(found, "foot"))),
        "lasts": markdown(head, list(repeat_rows(found, "last"))),
        "truth": markdown(["kind", "measure", "n", "bias", "MAE"], list(truth_rows(found))),
    }
    for name, text in tables.items():
        print(f"{name}\n{text}")
        if arguments.write:
            put("measures.md", name, text)
    print("failed:", "; ".join(found.failed) or "none")
    print(f"all measures of a 30,000-face mesh: {1000 * seconds('foot'):.0f} ms")


if __name__ == "__main__":
    main()
