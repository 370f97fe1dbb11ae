"""Lasts of two families with a known pose: every style, heel and cut."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from benchmarks.poses.case import Case
from footfit.geometry.numeric.arrays import Floats, Ints
from tools import last_cuts
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import last_mesh
from tools.resting import at_rest

TOOLS = Path(__file__).resolve().parents[3] / "shared" / "tools"
CUTS = ("none", "thimble", "v-cut", "hinge open", "hinge touching", "hinge in one body")
HIGHEST_MM = 115.0
SHORTEST_MM = 200.0  # of a last with a heel over 30 mm in the second family
RINGS, SEGMENTS = 100, 72


def bands() -> list[str]:
    """The names of the heel bands."""
    return [f"{low:.0f}-{high:.0f}" for low, high in HEEL_BANDS_MM]


def cut_last(vertices_mm: Floats, faces: Ints, cut: str) -> tuple[Floats, Ints]:
    """A last with what is cut out of lasts: a hole for the thimble, a V, a hinge."""
    if cut == "thimble":
        return last_cuts.thimble(vertices_mm, faces)
    if cut == "v-cut":
        return last_cuts.v_cut(vertices_mm, faces)
    if cut == "hinge open":
        return last_cuts.joined(last_cuts.hinge(vertices_mm, faces))
    if cut == "hinge touching":
        return last_cuts.joined(last_cuts.hinge(vertices_mm, faces, gap_mm=0.0))
    if cut == "hinge in one body":
        return last_cuts.slit(vertices_mm, faces)
    return vertices_mm, faces


def own_last(rng: np.random.Generator, number: int) -> Case:
    """A last of the project's generator: the style, the band and the cut go round."""
    style = STYLES[number % len(STYLES)]
    band = HEEL_BANDS_MM[number // len(STYLES) % len(HEEL_BANDS_MM)]
    cut = CUTS[int(rng.integers(len(CUTS)))] if number % 2 else "none"
    spec = wide(rng, style, band, rings=RINGS, segments=SEGMENTS)
    mesh = cut_last(*last_mesh(spec), cut)
    heel = "0-30" if style == "child" else f"{band[0]:.0f}-{band[1]:.0f}"
    return Case("own lasts", style, heel, cut, *mesh, spec.flare_deg, spec.length_mm)


def other_last(rng: np.random.Generator, number: int) -> Case:
    """A last of the second family, laid on its resting line."""
    if str(TOOLS) not in sys.path:
        sys.path.insert(0, str(TOOLS))
    import lasts2

    style = STYLES[number % len(STYLES)]
    band = HEEL_BANDS_MM[number // len(STYLES) % len(HEEL_BANDS_MM)]
    child = style == "child"
    length_mm = rng.uniform(115, 215) if child else rng.uniform(215, 320)
    spec = lasts2.random_last(rng, length=length_mm)
    ratio = length_mm / 275.0
    heel_mm = rng.uniform(*band)
    spec.heel_height = min(heel_mm, (0.10 if child else 0.44) * length_mm, HIGHEST_MM)
    spec.toe_spring = rng.uniform(3, 8) * ratio
    if style == "pump":
        spec.cone_height = rng.uniform(52, 66) * ratio
    if style == "boot":
        spec.cone_height, spec.cone_width = rng.uniform(130, 240) * ratio, rng.uniform(45, 60)
    mesh = lasts2.mesh(spec, n_long=130, n_round=72)
    cut = CUTS[int(rng.integers(len(CUTS)))] if number % 2 else "none"
    vertices, faces = cut_last(np.array(mesh.vertices), np.array(mesh.faces), cut)
    flare_deg = lasts2.truth(spec, mesh)["flare_angle_deg"]
    heel = "0-30" if child else f"{band[0]:.0f}-{band[1]:.0f}"
    return Case("lasts2", style, heel, cut, at_rest(vertices)[0], faces, flare_deg, length_mm)
