"""The flare of lasts by the height of their heel, on two families.

    python -m benchmarks.heels [--count 20] [--seed 7] [--write]

The lasts lie in their resting frame, as drawn by ``tools.last_specs.wide`` and, where it stands
beside the project, by ``../shared/tools/lasts2.py``. ``--write`` puts the table into docs/flare.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchmarks import stance
from benchmarks.tables import markdown, put
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.flare_profile import flare_profile
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.stance import stance_of
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import centre_line_mm, last_mesh
from tools.outline_slab import outline_slab, own_slab, plan_side
from tools.resting import at_rest

DEFINITION = FlareDefinition()
ON_THE_FLAT = replace(DEFINITION, length_height=DEFINITION.flat_length_height)
AT = np.linspace(0.0, 1.0, 4001)


@dataclass(frozen=True)
class Case:
    """A last at rest, the outline of its bottom laid flat, and its planted angle, degrees."""

    mesh: tuple[Floats, Ints]
    slab: tuple[Floats, Ints]
    planted_deg: float


def planted_deg(line: Floats, side: Floats) -> float:
    """The flare angle of a plan line (n, 2) that is laid flat along a side view (k, 2)."""
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(side, axis=0), axis=1))])
    flat = np.column_stack([np.interp(line[:, 0], side[:, 0], arc), line[:, 1]])
    station = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(flat, axis=0), axis=1))])
    heading = np.degrees(np.arctan2(np.gradient(flat[:, 1]), np.gradient(flat[:, 0])))
    heading = np.interp(AT, station / station[-1], heading)
    fore, rear = (
        heading[(low <= AT) & (high >= AT)].mean()
        for low, high in (DEFINITION.forefoot, DEFINITION.rearfoot)
    )
    return float(fore - rear)


def own(rng: np.random.Generator, band: tuple[float, float], number: int) -> Case:
    """A last of the project's generator."""
    spec = wide(rng, STYLES[number % len(STYLES)], band, rings=110, segments=80)
    spec = replace(spec, side="right")
    line = centre_line_mm(spec, AT)
    return Case(last_mesh(spec), own_slab(spec), planted_deg(line, plan_side(spec)))


def other(rng: np.random.Generator, band: tuple[float, float], _: int) -> Case:
    """A last of the second family."""
    import lasts2

    spec = stance.other_spec(rng, band)
    mesh = lasts2.mesh(spec, n_long=150, n_round=84)
    vertices, faces = at_rest(np.array(mesh.vertices))[0], np.array(mesh.faces)
    plan = lasts2.Plan(spec)
    at = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, 700))
    x, y, heading = plan.at(at)
    aside = lasts2.half_width(spec, at)[:, None] * np.column_stack(
        [-np.sin(heading), np.cos(heading)]
    )
    line = np.column_stack([x, y])
    along = np.linspace(-20.0, spec.length + 20.0, 4000)
    side = np.column_stack([along, lasts2.bottom(spec, np.interp(along, x, at))])
    slab = outline_slab(line + aside, line - aside, side)
    whole = np.column_stack(plan.at(AT)[:2])
    return Case((vertices, faces), slab, planted_deg(whole, side))


def rows(count: int, seed: int) -> Iterator[list[str]]:
    """A row for each family and band of heels."""
    draws = {"own": own} | ({"lasts2": other} if stance.second_family() else {})
    for name, draw in draws.items():
        rng = np.random.default_rng(seed)
        for band in HEEL_BANDS_MM:
            cases = [draw(rng, band, number) for number in range(count)]
            yield [name, f"{band[0]:.0f}-{band[1]:.0f}", *_errors(cases)]


def _errors(cases: list[Case]) -> list[str]:
    off, total_sds = [], []
    for case in cases:
        standing = stance_of(*case.mesh, "last")
        read = flare_profile(*case.mesh, stance=standing, kind="last")
        outline = flare_profile(*case.slab, ON_THE_FLAT, kind="last").angle_deg
        off.append((read.angle_deg - outline, read.angle_deg - case.planted_deg))
        total_sds.append(read.angle_total_sd_deg)
    rms, worst = np.sqrt(np.mean(np.square(off), axis=0)), np.abs(off).max(axis=0)
    pairs = zip(rms, worst, strict=True)
    inside = np.mean(np.abs(off)[:, 1] <= 2.0 * np.array(total_sds))
    figures = [f"{value:.2f}" for pair in pairs for value in pair]
    return [str(len(off)), *figures, f"{100 * inside:.0f} %", f"{np.mean(total_sds) / rms[1]:.1f}"]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    heads = ["family", "heel mm", "lasts", "outline: RMS deg", "worst", "planted: RMS deg", "worst"]
    heads += ["within 2 total", "total / RMS"]
    table = markdown(heads, list(rows(options.count, options.seed)))
    print(table)
    if options.write:
        put("flare.md", "heels", f"Seed {options.seed}.\n\n{table}")


if __name__ == "__main__":
    main()
