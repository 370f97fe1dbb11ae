"""Plausible lasts made by code, without meshes: what a catalogue stores, at once."""

from __future__ import annotations

import hashlib
from dataclasses import fields, is_dataclass, replace

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, FlareProfile
from footfit.results import (
    Eigenframe,
    LastLabels,
    LastRecord,
    Measure,
    Measured,
    MeshCopy,
    MeshInfo,
    Notice,
    Parentage,
    PoseQuality,
    SideVerdict,
    Target,
)

STATIONS = FlareDefinition().stations


def rotation(generator: np.random.Generator) -> np.ndarray:
    """A random rotation (3, 3)."""
    q, r = np.linalg.qr(generator.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)


def profile(seed: int = 0, definition: FlareDefinition | None = None) -> FlareProfile:
    """A smooth profile with one channel that could not be measured."""
    generator = np.random.default_rng(seed)
    s = np.linspace(0.04, 0.96, STATIONS)
    heading = np.cumsum(generator.normal(size=STATIONS)) / 10
    curvature: dict[str, np.ndarray | None] = {
        name: np.sin(3 * s + i) + generator.normal(size=STATIONS) / 50
        for i, name in enumerate(CHANNELS)
    }
    curvature["bottom_80"] = None
    return FlareProfile(
        definition=definition or FlareDefinition(),
        angle_deg=float(generator.normal(8, 3)),
        angle_sd_deg=0.15,
        flare_class="straight",
        stations=s,
        heading_deg=heading,
        curvature=curvature,
        centre_line=np.column_stack([s, heading / 50]),
    )


def labels(name: str, seed: int = 0, **given: object) -> LastLabels:
    """Labels as a manifest would give them."""
    usual: dict[str, object] = {
        "style": ("oxford", "trainer", "boot")[seed % 3],
        "size": str(36 + seed % 12),
        "size_system": ("eu", "uk")[seed % 2],
        "width_label": "G",
        "heel_height_mm": 25.0,
    }
    return LastLabels(name=name, **{**usual, **given})


def last(
    name: str = "oxford-42", seed: int = 0, *, side: str = "right", **given: object
) -> LastRecord:
    """A last's record; another ``seed`` is another scan."""
    generator = np.random.default_rng(seed)
    scale = (1.0, 10.0, 1000.0)[seed % 3]
    canonical = np.eye(4)
    turn = rotation(generator)
    canonical[:3, :3] = turn * scale
    canonical[:3, 3] = generator.normal(size=3) * 100
    near_axes = turn + generator.normal(size=(3, 3)) * 0.05
    u, _, vt = np.linalg.svd(near_axes)
    length = float(generator.normal(270, 12))
    return LastRecord(
        labels=labels(name, seed, **given),
        info=MeshInfo(
            path=f"/home/somebody/scans/{name}.stl",
            sha256=hashlib.sha256(f"scan {seed}".encode()).hexdigest(),
            format="stl",
            vertices=17_000 + seed,
            faces=34_000 + 2 * seed,
            watertight=seed % 2 == 0,
            units=("mm", "cm", "m")[seed % 3],
            units_source="detected",
            unit_scale=scale,
        ),
        side=SideVerdict(side, "sure", 3.5, "detected"),
        pose=PoseQuality(0.31, 0.22, 0.17, True, "last"),
        eigenframe=Eigenframe(
            centroid_mm=generator.normal(size=3) * 50,
            eigenvectors=u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt,
            eigenvalues_mm2=np.array([5200.0, 480.0, 610.0]) + generator.normal(size=3),
        ),
        printed_frame=Eigenframe(
            centroid_mm=generator.normal(size=3) * 50,
            eigenvectors=turn @ rotation(generator),
            eigenvalues_mm2=np.array([5300.0, 620.0, 470.0]) + generator.normal(size=3),
        ),
        canonical_transform=canonical,
        paper_transform=None,
        extent_mm=length + 0.4,
        flare=profile(seed),
        measures=(
            Measure("length", Measured(length, 0.4), "pternion to foremost point along X"),
            Measure("instep_girth", Measured(None, None, "the leg is cut too low"), "girth/1"),
        ),
        warnings=(Notice("open_mesh", "has 2 holes"), Notice("units_detected", "taken as cm")),
    )


def mesh_copy(seed: int = 0, size: int = 2_000) -> MeshCopy:
    """Bytes in place of a compressed mesh."""
    return MeshCopy(np.random.default_rng(seed).bytes(size), faces=10_000, error_mm=0.12)


def parentage(base: str, seed: int = 0, **given: object) -> Parentage:
    """How a last was graded from the last ``base`` of the same seed."""
    usual: dict[str, object] = {
        "base_sha256": hashlib.sha256(f"scan {seed}".encode()).hexdigest(),
        "made_by": "grade",
        "rule": "eu",
        "figures": {"steps": 1, "hold": ["heel", "spring"], "length_mm": 6.667},
        "targets": (
            Target("bottom_length", "mm", 270.0, 276.667, 276.66),
            Target("instep_girth", "mm", None, 245.5, None),
        ),
    }
    return Parentage(base, **{**usual, **given})


def plain(value: object) -> object:
    """A result as nested tuples: arrays become (shape, bytes), so that == is exact."""
    if isinstance(value, np.ndarray):
        return value.shape, value.astype("<f8").tobytes()
    if is_dataclass(value):
        return tuple((f.name, plain(getattr(value, f.name))) for f in fields(value))
    if isinstance(value, dict):
        return tuple((key, plain(value[key])) for key in sorted(value))
    if isinstance(value, (tuple, list)):
        return tuple(plain(item) for item in value)
    return value


def as_stored(record: LastRecord) -> LastRecord:
    """A record as the catalogue gives it back, but for its paper transform: no folder is kept."""
    path = record.info.path
    name = None if path is None else path.rpartition("/")[2]
    return replace(record, info=replace(record.info, path=name), paper_transform=None)
