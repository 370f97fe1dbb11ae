"""Closed surfaces f(x) + f(y) + f(z) = 1 with the curvatures that f, f' and f'' give. Lengths mm.

Neither the normals, the principal directions nor the two curvatures follow the mesh or an axis.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from tests.shapes import Mesh, convex_cloud

Profile = Callable[[Floats], tuple[Floats, Floats, Floats]]


def bumpy(radius_mm: float = 50.0, bump: float = 0.15, waves: float = 3.0) -> Profile:
    """A ball with bumps and hollows: f = x^2/R^2 + bump sin(waves x/R)."""

    def profile(x: Floats) -> tuple[Floats, Floats, Floats]:
        w, phase = waves / radius_mm, waves * x / radius_mm
        return (
            x**2 / radius_mm**2 + bump * np.sin(phase),
            2.0 * x / radius_mm**2 + bump * w * np.cos(phase),
            2.0 / radius_mm**2 - bump * w * w * np.sin(phase),
        )

    return profile


def rounded_cube(radius_mm: float = 50.0, square: float = 0.6) -> Profile:
    """Between a ball and a cube: f = (1 - square) x^2/R^2 + square x^4/R^4."""

    def profile(x: Floats) -> tuple[Floats, Floats, Floats]:
        t, ball = x / radius_mm, 1.0 - square
        return (
            ball * t**2 + square * t**4,
            (2.0 * ball * t + 4.0 * square * t**3) / radius_mm,
            (2.0 * ball + 12.0 * square * t**2) / radius_mm**2,
        )

    return profile


def irregular(count: int, rng: np.random.Generator, profile: Profile) -> Mesh:
    """``count`` random points of the surface, seen from the origin, as an irregular closed mesh.

    By Newton's steps along each ray: the surface must be star-shaped about the origin.
    """
    rays, faces = convex_cloud(count, rng, (1.0, 1.0, 1.0))
    reach = np.full(count, 50.0)
    for _ in range(50):
        value, slope, _ = profile(rays * reach[:, None])
        reach -= (value.sum(axis=1) - 1.0) / np.einsum("ij,ij->i", slope, rays)
    points = rays * reach[:, None]
    assert np.allclose(profile(points)[0].sum(axis=1), 1.0), "not star-shaped about the origin"
    return points, faces


def curvatures(points: Floats, profile: Profile) -> tuple[Floats, Floats]:
    """k1 <= k2 (n,) in 1/mm at points of the surface, from its gradient g and Hessian diag(h).

    K = g adj(diag h) g / |g|^4 and 2 H = (|g|^2 sum h - g diag(h) g) / |g|^3.
    """
    _, g, h = profile(points)
    square = np.sum(g * g, axis=1)
    adjugate = h[:, [1, 0, 0]] * h[:, [2, 2, 1]]
    gaussian = np.sum(g * g * adjugate, axis=1) / square**2
    mean = (square * h.sum(axis=1) - np.sum(g * g * h, axis=1)) / (2.0 * square**1.5)
    root = np.sqrt(np.maximum(mean**2 - gaussian, 0.0))
    return mean - root, mean + root
