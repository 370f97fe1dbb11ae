"""How high a heel stands and how far a toe springs, on two families of lasts.

    python -m benchmarks.stance [--count 8] [--seed 3] [--write]

The lasts lie in their resting frame, as drafted by ``tools.last_specs.wide`` and, where it stands
beside the project, by ``../shared/tools/lasts2.py``. Errors are in mm: of the heel height by the
shape alone, and of the toe spring at the tip if the heel is labelled. ``sd`` is the mean of the
total standard deviation that is stated; ``ms`` is the time of the stance by the shape.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.tables import markdown, put
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.cues import StanceLabels
from footfit.geometry.stance.stance import STANCE, stance_of
from footfit.pipeline.scan.trueness import measured
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import last_mesh, standing
from tools.resting import at_rest

SHARED = Path(__file__).resolve().parents[2] / "shared" / "tools"
HIGHEST_MM = 112.0  # of lasts2
HEADS = ["family", "heel mm", "lasts", "heel RMS", "bias", "worst", "sd", "within 2 sd"]
HEADS += ["spring RMS", "worst", "sd"]


@dataclass(frozen=True, slots=True)
class Case:
    """A last in its resting frame, its seat's line at the rear, and its drafted toe spring."""

    vertices_mm: Floats
    faces: Ints
    heel_mm: float
    spring_mm: float


Draw = Callable[[np.random.Generator, tuple[float, float], int], Case]


def own(rng: np.random.Generator, band: tuple[float, float], number: int) -> Case:
    """A last of the project's generator."""
    spec = wide(rng, STYLES[number % 4], band, rings=100, segments=72)
    drafted = standing(spec)
    x, z = drafted.middle_mm.T
    place = (x - x[0]) / np.ptp(x)
    seat = (place >= STANCE.seat[0]) & (place <= STANCE.seat[1])
    heel_mm = np.polyfit(x[seat] - x[0], z[seat] - z.min(), 1)[1]
    return Case(*last_mesh(spec), float(heel_mm), drafted.tip_mm)


def second_family() -> bool:
    """Whether the second family stands beside the project; it can be imported then."""
    if SHARED.exists() and str(SHARED) not in sys.path:
        sys.path.insert(0, str(SHARED))
    return SHARED.exists()


def other(
    rng: np.random.Generator,
    band: tuple[float, float],
    _: int,
    rings: int = 150,
    segments: int = 84,
) -> Case:
    """A last of the second family, laid on its resting line."""
    import lasts2

    spec = other_spec(rng, band)
    mesh = lasts2.mesh(spec, n_long=rings, n_round=segments)
    vertices_mm = at_rest(np.array(mesh.vertices))[0]
    return Case(vertices_mm, np.array(mesh.faces), spec.heel_height, spec.toe_spring)


def other_spec(rng: np.random.Generator, band: tuple[float, float]) -> Any:
    """A random last of the second family with a heel of a band."""
    import lasts2

    spec = lasts2.random_last(rng, length=rng.uniform(225, 280))
    spec.heel_height, spec.toe_spring = min(rng.uniform(*band), HIGHEST_MM), rng.uniform(3, 8)
    return spec


def rows(count: int, seed: int) -> Iterator[list[str]]:
    """A row for each family and band of heels."""
    families: dict[str, Draw] = {"own": own} | ({"lasts2": other} if second_family() else {})
    for name, draw in families.items():
        rng = np.random.default_rng(seed)
        for band in HEEL_BANDS_MM:
            cases = [draw(rng, band, number) for number in range(count)]
            yield [name, f"{band[0]:.0f}-{band[1]:.0f}", *_figures(cases)]


def _figures(cases: list[Case]) -> list[str]:
    readings = [reading for case in cases if (reading := _reading(case)) is not None]
    heel, heel_sd, spring, spring_sd = np.array(readings).T
    return [
        f"{len(readings)} of {len(cases)}",
        f"{np.sqrt(np.mean(heel**2)):.1f}",
        f"{np.mean(heel):+.1f}",
        f"{np.abs(heel).max():.1f}",
        f"{heel_sd.mean():.1f}",
        f"{100 * np.mean(np.abs(heel) < 2 * heel_sd):.0f} %",
        f"{np.sqrt(np.mean(spring**2)):.1f}",
        f"{np.abs(spring).max():.1f}",
        f"{spring_sd.mean():.1f}",
    ]


def _reading(case: Case) -> tuple[float, ...] | None:
    """Errors and standard deviations of heel and labelled spring; None if refused."""
    by_shape = stance_of(case.vertices_mm, case.faces, "last")
    labels = StanceLabels(case.heel_mm)
    by_label = stance_of(case.vertices_mm, case.faces, "last", labels)
    if by_shape is None or by_label is None:
        return None
    heel_mm, tip_mm = by_shape.heel_mm(), by_label.tip_mm()
    if heel_mm is None or tip_mm is None:
        return None
    length_mm = float(np.ptp(case.vertices_mm[:, 0]))
    shape_heel_mm = by_shape.shape_heel_mm(length_mm)
    sds = (
        measured(measure_named(name), MeasureValue(0.0, convention_sd=sd), "last", shape_heel_mm)
        for name, sd in (
            ("heel_height", by_shape.level_sd_mm(0.0)),
            ("toe_spring_tip", by_label.level_sd_mm(by_label.length_mm)),
        )
    )
    heel_sd, tip_sd = (float(value.total_sd or 0.0) for value in sds)
    return heel_mm - case.heel_mm, heel_sd, tip_mm - case.spring_mm, tip_sd


def main() -> None:
    """Print the table, or write it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    text = markdown(HEADS, list(rows(options.count, options.seed)))
    print(text)
    if options.write:
        put("stance.md", "stance", text)


if __name__ == "__main__":
    main()
