"""Plausible entries of the fit log made by code."""

from __future__ import annotations

import hashlib

import numpy as np

from footfit.results import FitEntry, RatedZone

ZONES = {
    "length": 14.0,
    "ball_girth": 0.0,
    "ball_width": 1.0,
    "instep_girth": 2.0,
    "heel_width": -2.0,
}


def entry(seed: int = 0, **given: object) -> FitEntry:
    """An entry; another ``seed`` is another foot."""
    rng = np.random.default_rng(seed)
    zones = tuple(
        RatedZone(name, "mm", float(mean + rng.normal(0.0, 4.0)), 0.7, f"{name}/1")
        for name, mean in ZONES.items()
    )
    usual: dict[str, object] = {
        "id": f"{seed:012x}",
        "recorded": "2026-01-02T03:04:05Z",
        "last": "derby-42",
        "last_sha256": hashlib.sha256(b"last").hexdigest(),
        "foot_sha256": hashlib.sha256(f"foot {seed}".encode()).hexdigest(),
        "side": "left",
        "wearer": f"W{seed}",
        "profile": "walking",
        "profile_version": 1,
        "profile_sha256": hashlib.sha256(b"profile").hexdigest(),
        "worn": {"sock_mm": 1.5},
        "zones": zones,
        "ratings": {"ball": int(rng.integers(-2, 3)), "toe": 0},
        "comfort": 80.0,
        "outcome": "kept",
        "footfit_version": "1",
    }
    return FitEntry(**{**usual, **given})
