"""Hypothesis strategies: motions, and meshes whose shape is irregular on purpose."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from tests import shapes
from tests.distortions import random_rotation, subdivided, white_noise
from tests.shapes import Mesh

seeds = st.integers(0, 2**32 - 1)


def rotations() -> st.SearchStrategy[np.ndarray]:
    """Rotations (3, 3), uniform."""
    return seeds.map(lambda seed: random_rotation(np.random.default_rng(seed))[:3, :3])


def shifts_mm(most: float = 500.0) -> st.SearchStrategy[np.ndarray]:
    """Translations (3,) in mm."""
    return st.tuples(*[st.floats(-most, most)] * 3).map(np.array)


def scales() -> st.SearchStrategy[float]:
    """Scale factors from inch-in-mm-like to metre-in-mm-like, both ways."""
    return st.floats(-3.0, 3.0).map(lambda power: float(10.0**power))


@st.composite
def surfaces(draw: st.DrawFn, open_too: bool = True) -> Mesh:
    """A small sphere, ellipsoid, torus or cap (where ``open_too``), uneven and a little noisy."""
    kinds = ["sphere", "cloud", "torus", *(["cap"] if open_too else [])]
    kind = draw(st.sampled_from(kinds))
    rng = np.random.default_rng(draw(seeds))
    vertices, faces = {
        "sphere": lambda: shapes.sphere(50.0, 2),
        "cloud": lambda: shapes.convex_cloud(250, rng, (60.0, 45.0, 35.0)),
        "torus": lambda: shapes.torus(60.0, 20.0, 28, 14),
        "cap": lambda: shapes.open_cap(50.0, 70.0, 7, 20),
    }[kind]()
    if draw(st.booleans()):
        vertices, faces = subdivided(vertices, faces, rng.random(len(faces)) < 0.2)
    return white_noise(vertices, rng, draw(st.sampled_from([0.0, 0.1, 0.5]))), faces
