"""How high a heel stands by ``footfit.geometry.stance``, on two families of lasts.

    python -m benchmarks.stance [--count 8] [--seed 7]

The lasts lie in their resting frame, as drafted by ``tools.last_specs.wide`` and, where it stands
beside the project, by ``../shared/tools/lasts2.py``. Errors are mm of heel height; ``sd`` is the
mean standard deviation that the stance states.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.tables import markdown
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.ground import standing_ground
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import last_mesh, standing

SHARED = Path(__file__).resolve().parents[2] / "shared" / "tools"
HIGHEST_MM = 112.0  # of lasts2
SEAT = 0.62  # from the tread to the seat, over the standing length
Case = tuple[Floats, Ints, float]
Draw = Callable[[np.random.Generator, tuple[float, float], int], Case]


def own(rng: np.random.Generator, band: tuple[float, float], number: int) -> Case:
    """A last of the project's generator, and how far its ground is turned, radians."""
    spec = wide(rng, STYLES[number % 4], band, rings=100, segments=72)
    return *last_mesh(spec), float(np.radians(standing(spec).pitch_deg))


def second_family() -> bool:
    """Whether the second family stands beside the project; it can be imported then."""
    if SHARED.exists() and str(SHARED) not in sys.path:
        sys.path.insert(0, str(SHARED))
    return SHARED.exists()


def other(rng: np.random.Generator, band: tuple[float, float], _: int) -> Case:
    """A last of the second family, laid on its resting line."""
    import lasts2

    return at_rest(lasts2.mesh(other_spec(rng, band), n_long=150, n_round=84))


def other_spec(rng: np.random.Generator, band: tuple[float, float]) -> Any:
    """A random last of the second family with a heel of a band."""
    import lasts2

    spec = lasts2.random_last(rng, length=rng.uniform(225, 280))
    spec.heel_height, spec.toe_spring = min(rng.uniform(*band), HIGHEST_MM), rng.uniform(3, 8)
    return spec


def at_rest(mesh: Any) -> Case:
    """A standing mesh on its resting line, and how far that turned it, radians."""
    from scipy.spatial import ConvexHull

    points = np.array(mesh.vertices)
    hull = points[ConvexHull(points[:, [0, 2]]).vertices][:, [0, 2]]
    edges = np.roll(hull, -1, axis=0) - hull
    below = edges[np.argmax(np.where(edges[:, 0] > 0, edges[:, 0], 0.0))]
    angle = -float(np.arctan2(below[1], below[0]))
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    return points @ turn, np.array(mesh.faces), angle


def rows(count: int, seed: int) -> Iterator[list[str]]:
    """A row for each family and band of heels."""
    families = {"own": own} | ({"lasts2": other} if second_family() else {})
    for name, draw in families.items():
        rng = np.random.default_rng(seed)
        for band in HEEL_BANDS_MM:
            yield [name, f"{band[0]:.0f}-{band[1]:.0f}", *_errors(rng, draw, band, count)]


def _errors(
    rng: np.random.Generator, draw: Draw, band: tuple[float, float], count: int
) -> list[str]:
    off, sds = [], []
    for number in range(count):
        vertices, faces, angle = draw(rng, band, number)
        ground = standing_ground(vertices, faces)
        if ground is None:
            continue
        arm_mm = SEAT * ground.line.length_mm
        off.append(arm_mm * np.tan(ground.angle - angle))
        sds.append(np.hypot(arm_mm * ground.sd, 0.5))
    error, sd = np.array(off), np.array(sds)
    return [
        f"{len(error)} of {count}",
        f"{np.sqrt(np.mean(error**2)):.1f}",
        f"{np.mean(error):+.1f}",
        f"{np.abs(error).max():.1f}",
        f"{sd.mean():.1f}",
        f"{100 * np.mean(np.abs(error) < 2 * sd):.0f} %",
    ]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=7)
    options = parser.parse_args()
    heads = ["family", "heel mm", "lasts", "RMS", "bias", "worst", "sd", "within 2 sd"]
    print(markdown(heads, list(rows(options.count, options.seed))))


if __name__ == "__main__":
    main()
