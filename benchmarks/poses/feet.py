"""Feet of every kind with a known pose: small and long, wide, with a bunion, with a leg."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from benchmarks.alignment import KNOWN_AXES, SCANS, soleless, upright, with_leg
from benchmarks.poses.case import Case
from footfit.geometry.numeric.arrays import Floats, Ints
from tests import distortions
from tests.reading import read_scan

SAMPLES = Path(__file__).resolve().parents[2] / "sample_data"
KINDS = (
    "child",
    "long",
    "wide",
    "bunion",
    "leg to the knee",
    "leaning shank",
    "no sole",
    "no sole, long leg",
    "plain",
    "real",
)
LENGTHS_MM = {"child": (110.0, 180.0), "long": (300.0, 340.0)}
ANKLE = 0.35  # of the length: where the leg begins
Mesh = tuple[Floats, Ints]


@lru_cache(maxsize=4)
def _scan(path: Path) -> Mesh:
    scan = read_scan(path)
    return scan.vertices_mm, scan.faces


def foot(rng: np.random.Generator, number: int) -> Case:
    """A foot; the kind goes round."""
    kind = KINDS[number % len(KINDS)]
    if kind == "real":
        mesh = real_foot(rng)
    else:
        paths = sorted((SCANS / "makehuman").glob("*_R.stl"))
        paths = paths or sorted(SAMPLES.glob("**/*_R.stl"))
        mesh = of_kind(*_scan(paths[int(rng.integers(len(paths)))]), kind, rng)
    length_mm = float(np.ptp(mesh[0][mesh[0][:, 2] < mesh[0][:, 2].min() + 60.0, 0]))
    return Case("feet", kind, "-", "none", *mesh, None, length_mm)


def real_foot(rng: np.random.Generator) -> Mesh:
    """One of the scans of other sources, as a right foot that lies along X."""
    name = str(rng.choice(sorted(KNOWN_AXES)))
    vertices, faces = _scan(SCANS / f"{name}.stl")
    vertices = upright(vertices, *map(np.array, KNOWN_AXES[name]))
    if name.endswith("L") or name == "FIND_template":
        return distortions.mirrored(vertices, faces)
    return vertices, faces


def of_kind(vertices: Floats, faces: Ints, kind: str, rng: np.random.Generator) -> Mesh:
    """A foot that lies along X and Z, changed into one of a kind."""
    length = float(np.ptp(vertices[:, 0]))
    wanted = rng.uniform(*LENGTHS_MM.get(kind, (200.0, 290.0)))
    vertices = vertices * (wanted / length)
    if kind == "wide":
        vertices = vertices * [1.0, rng.uniform(1.12, 1.25), 1.0]
    if kind == "bunion":
        vertices = with_bunion(vertices, rng.uniform(6.0, 14.0))
    if kind == "leaning shank":
        vertices, faces = with_leg(vertices, faces, wanted * rng.uniform(0.6, 1.0), ANKLE * wanted)
        vertices = leaned(vertices, rng.uniform(8.0, 20.0), rng.uniform(0.0, 2 * np.pi))
    if kind.endswith(("to the knee", "long leg")):
        vertices, faces = with_leg(vertices, faces, wanted * rng.uniform(1.2, 1.9), ANKLE * wanted)
    if kind.startswith("no sole"):
        vertices, faces = soleless(vertices, faces)
    return vertices, faces


def with_bunion(vertices: Floats, size_mm: float) -> Floats:
    """The inner ball joint of a right foot pushed out, the big toe turned to the others."""
    x, y, z = vertices.T
    length = float(np.ptp(x))
    joint = x.min() + 0.72 * length
    inner = y > np.median(y)
    bump = np.exp(-0.5 * ((x - joint) / (0.045 * length)) ** 2) * np.exp(-z / (0.2 * length))
    turn = np.clip((x - joint) / (0.28 * length), 0.0, 1.0)
    edge = np.clip((y - np.median(y)) / (0.15 * length), 0.0, 1.0)
    return np.column_stack([x, y + inner * edge * size_mm * (bump - 0.8 * turn), z])


def leaned(vertices: Floats, lean_deg: float, towards: float) -> Floats:
    """The shank from 70 mm up leans to one side, its bend at the ankle is soft."""
    above = np.clip(vertices[:, 2] - vertices[:, 2].min() - 70.0, 0.0, None)
    shift = np.tan(np.radians(lean_deg)) * above**2 / (above + 20.0)
    return vertices + shift[:, None] * [np.cos(towards), np.sin(towards), 0.0]
