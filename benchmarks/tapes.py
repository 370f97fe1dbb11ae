"""How near the least-tape girths are to a search of every plane, and what they cost.

    python -m benchmarks.tapes [--count 3] [--seed 3] [--write]

Lasts of both families by heel, in their resting frame, and the feet at hand. The table has the
worst difference in mm between a girth and the least of a grid of planes through the same places
(``tests/tape_peer.py``, which shares no code with footfit), and the core time of the four girths.
``--write`` puts it into docs/measures.md.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator

import numpy as np

from benchmarks import stance
from benchmarks.alignment import scan_of
from benchmarks.measures import cases
from benchmarks.tables import markdown, put
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from tests.scans import aligned, right_shape
from tests.tape_peer import least_girths
from tools.last_specs import HEEL_BANDS_MM

LEAST = ("ball_girth_least", "waist_girth_least", "instep_girth_least", "heel_girth_instep")


def shapes(count: int, seed: int) -> Iterator[tuple[str, str, Shape]]:
    """Shapes with their family and heel band."""
    families = {"own": stance.own} | ({"lasts2": stance.other} if stance.second_family() else {})
    for family, draw in families.items():
        rng = np.random.default_rng(seed)
        for band in HEEL_BANDS_MM:
            for number in range(count):
                case = draw(rng, band, number)
                shape = Shape(case.vertices_mm, case.faces, "last")
                yield family, f"{band[0]:.0f}-{band[1]:.0f}", shape
    feet = [case for case in cases(np.random.default_rng(seed), 0) if case.kind == "foot"]
    for case in feet[:: max(1, len(feet) // (2 * count))]:
        scan = aligned(scan_of(case.vertices, case.faces), side=case.side)
        yield "feet", "", Shape(*right_shape(scan), "foot")


def trial(shape: Shape) -> list[float]:
    """What the four girths are off by (NaN if not measured), their core time in ms, the faces."""
    places = shape.joints, shape.waist_crown, shape.instep_crown, shape.heel_base
    assert None not in places[:2]
    start = time.process_time()
    values = [measure_named(name).value_of(shape).value for name in LEAST]
    cost_ms = 1000.0 * (time.process_time() - start)
    least = least_girths(shape)
    pairs = zip(LEAST, values, strict=True)
    off = [np.nan if value is None else value - least[name] for name, value in pairs]
    return [*off, cost_ms, len(shape.faces)]


def row(family: str, band: str, trials: np.ndarray) -> list[str]:
    """The worst differences of a group, how many values are missing, and the mean cost."""
    off = np.abs(trials[:, :4])
    lost = int(np.isnan(off).sum())
    cost_ms, faces = trials[:, 4:].mean(axis=0)
    worst = [f"{value:.2f}" for value in np.nanmax(off, axis=0)]
    ends = [str(lost) if lost else "", f"{cost_ms:.0f}", f"{faces / 1000:.0f}"]
    return [family, band, str(len(trials)), *worst, *ends]


def main() -> None:
    """Run and print, or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    groups: dict[tuple[str, str], list[list[float]]] = {}
    for family, band, shape in shapes(arguments.count, arguments.seed):
        groups.setdefault((family, band), []).append(trial(shape))
    head = ["family", "heel, mm", "n", *LEAST, "missing", "ms", "1000 faces"]
    text = markdown(head, [row(*group, np.array(trials)) for group, trials in groups.items()])
    print(text)
    if arguments.write:
        put("measures.md", "tapes", text)


if __name__ == "__main__":
    main()
