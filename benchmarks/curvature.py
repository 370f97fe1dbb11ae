"""Accuracy and time of curvature at a scale, against peers in the same run.

    python -m benchmarks.curvature [--vertices 5000 50000] [--seed 0] [--write]

Error: median / 95th percentile over the vertices of |k - truth| / max(|k1|, |k2|), for k1 and k2.
Noise is white, over the longest extent. Time: the processor's, the best of three, over that of
libigl's ball method on the same mesh.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from benchmarks.tables import markdown, put
from footfit.geometry.curvature.one_ring import one_ring_curvature
from footfit.geometry.curvature.pooled_curvature import pooled_curvature
from footfit.geometry.numeric.arrays import Floats, Ints
from tests import implicit, shapes
from tests.distortions import white_noise

Pair = tuple[Floats, Floats]
Method = Callable[[Floats, Ints, float], Pair]
EDGES = 5
NOISES = (0.0, 0.001, 0.003)
HEAD = ("vertices", "shape", "noise", "method", "k1 error", "k2 error", "time")


def uneven_torus(count: int, rng: np.random.Generator) -> tuple[Floats, Ints, Pair]:
    """A torus of 60 and 20 mm on a grid whose points are moved by up to .3 of a cell."""
    across = round(np.sqrt(count / 3.0))
    around = count // across
    _, faces = shapes.torus(60.0, 20.0, around, across)
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u = (u + rng.uniform(-0.3, 0.3, u.shape)) * 2 * np.pi / around
    v = (v + rng.uniform(-0.3, 0.3, v.shape)) * 2 * np.pi / across
    reach = 60.0 + 20.0 * np.cos(v)
    points = np.stack([reach * np.cos(u), reach * np.sin(u), 20.0 * np.sin(v)], axis=2)
    vertices = points.reshape(-1, 3)
    return vertices, faces, shapes.torus_curvatures(vertices, 60.0, 20.0)


def surfaces(count: int, seed: int) -> dict[str, tuple[Floats, Ints, Pair]]:
    """Irregular meshes with known curvature."""
    rng = np.random.default_rng(seed)
    sphere = shapes.convex_cloud(count, rng)
    radii = (100.0, 60.0, 45.0)
    ellipsoid = shapes.convex_cloud(count, rng, radii)
    truth = np.full(count, 1 / 50.0)
    return {
        "sphere": (*sphere, (truth, truth)),
        "torus": uneven_torus(count, rng),
        "ellipsoid": (*ellipsoid, shapes.ellipsoid_curvatures(ellipsoid[0], radii)),
        "bumpy ball": implicit_surface(count, rng, implicit.bumpy()),
        "rounded cube": implicit_surface(count, rng, implicit.rounded_cube()),
    }


def implicit_surface(
    count: int, rng: np.random.Generator, profile: implicit.Profile
) -> tuple[Floats, Ints, Pair]:
    """An irregular mesh of it and its curvatures."""
    vertices, faces = implicit.irregular(count, rng, profile)
    return vertices, faces, implicit.curvatures(vertices, profile)


# ---------------------------------------------------------------- methods


def footfit_pooled(vertices: Floats, faces: Ints, radius: float) -> Pair:
    """The default."""
    found = pooled_curvature(vertices, faces, radius)
    return found.k1, found.k2


def footfit_one_ring(vertices: Floats, faces: Ints, _radius: float) -> Pair:
    """The paper's III.C as a density."""
    found = one_ring_curvature(vertices, faces)
    return found.k1, found.k2


def libigl(k_ring: bool) -> Method:
    """Quadric fits of libigl over a ball of, or a ring of, EDGES edges."""
    import igl

    def fitted(vertices: Floats, faces: Ints, _radius: float) -> Pair:
        found = igl.principal_curvature(vertices, faces, EDGES, k_ring)
        return outward(np.stack([found[2], found[3]]))

    return fitted


def pymeshlab(name: str) -> Method:
    """A method of MeshLab, each on its own neighbourhood (it takes no radius)."""
    import pymeshlab as lab

    def found(vertices: Floats, faces: Ints, _radius: float) -> Pair:
        values = []
        for kind in ("Min Curvature", "Max Curvature"):
            meshes = lab.MeshSet()
            meshes.add_mesh(lab.Mesh(vertices, faces))
            meshes.compute_curvature_principal_directions_per_vertex(
                method=name, curvcolormethod=kind, autoclean=False
            )
            values.append(meshes.current_mesh().vertex_scalar_array())
        return outward(np.stack(values))

    return found


def outward(values: Floats) -> Pair:
    """Sorted, with the sign that makes most of the shape convex (peers differ in it)."""
    values = values if np.nanmedian(values.sum(axis=0)) > 0.0 else -values
    k1, k2 = np.sort(values, axis=0)
    return k1, k2


def methods() -> dict[str, Method]:
    """Those of footfit and those of the peers that are installed; the others are named."""
    found: dict[str, Method] = {}
    if find_spec("igl"):
        found |= {"libigl ball": libigl(False), f"libigl {EDGES} rings": libigl(True)}
    else:
        print("libigl is not installed: no ratios (pip install libigl)")
    found |= {"footfit pooled": footfit_pooled, "footfit one ring": footfit_one_ring}
    if find_spec("pymeshlab"):
        found |= {
            "MeshLab quadric": pymeshlab("Quadric Fitting"),
            "MeshLab Taubin": pymeshlab("Taubin approximation"),
        }
    else:
        print("pymeshlab is not installed: left out (pip install pymeshlab)")
    print("potpourri3d estimates no curvature: not in the table")
    return found


# ---------------------------------------------------------------- table


def timed(method: Method, vertices: Floats, faces: Ints, radius: float) -> tuple[Pair, float]:
    """The method's answer and the best of three processor times in seconds."""
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        answer = method(vertices, faces, radius)
        best = min(best, time.process_time() - start)
    return answer, best


def errors(found: Pair, truth: Pair) -> list[str]:
    """Median / 95th percentile for k1 and for k2."""
    size = np.maximum(np.abs(truth[0]), np.abs(truth[1]))
    share = [np.abs(k - t) / size for k, t in zip(found, truth, strict=True)]
    return [f"{np.nanmedian(error):.4f} / {np.nanquantile(error, 0.95):.3f}" for error in share]


def rows(counts: list[int], seed: int) -> list[list[str]]:
    """One row per mesh size, shape, noise and method; each is printed as it comes."""
    compared, found = methods(), []
    for count in counts:
        for shape, (vertices, faces, truth) in surfaces(count, seed).items():
            sides = vertices[np.roll(faces, 1, axis=1)] - vertices[faces]
            radius = EDGES * float(np.linalg.norm(sides, axis=2).mean())
            for noise in NOISES:
                sd = noise * float(np.ptp(vertices, axis=0).max())
                noisy = white_noise(vertices, np.random.default_rng(seed + 1), sd)
                runs = {name: timed(run, noisy, faces, radius) for name, run in compared.items()}
                base = runs["libigl ball"][1] if "libigl ball" in runs else np.nan
                for name, (answer, seconds) in runs.items():
                    where = [str(count), shape, f"{noise:.1%}", name]
                    found.append([*where, *errors(answer, truth), f"{seconds / base:.2f}"])
                    print(" | ".join(found[-1]), flush=True)
    return found


def main() -> None:
    """Print the table, and put it into docs/curvature.md where asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--vertices", type=int, nargs="+", default=[5000, 50000])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--write", action="store_true", help="put the table into docs/curvature.md")
    chosen = parser.parse_args()
    heading = f"Seed {chosen.seed}, radius {EDGES} mean edges.\n"
    print(heading)
    table = markdown(HEAD, rows(chosen.vertices, chosen.seed))
    if chosen.write:
        put("curvature.md", "curvature", f"{heading}\n{table}")


if __name__ == "__main__":
    main()
