"""Plausible results, built by code: a foot-shaped tube with a planted bend, and answers with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from footfit.geometry.fit.clearance import ZoneClearance
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, FlareProfile
from footfit.results import (
    Alignment,
    Candidate,
    CatalogueFacts,
    Eigenframe,
    FlareDifference,
    IngestOutcome,
    LastLabels,
    LastRecord,
    Match,
    Measure,
    Measured,
    MeasuredScan,
    MeshInfo,
    Notice,
    PoseQuality,
    Profiled,
    Reference,
    SideVerdict,
    SurfaceClearance,
    SurfaceCurvature,
)
from tests.scans import aligned_of

STATIONS = np.linspace(0.04, 0.96, 60)


def heading(s, turn_deg):
    """A smooth turn of ``turn_deg`` between heel and forefoot, degrees."""
    return turn_deg / (1.0 + np.exp(-(s - 0.45) / 0.06))


def centre_offset(s, turn_deg):
    """The centre line's offset to medial over the length: the integral of the heading."""
    grid = np.linspace(0.0, 1.0, 400)
    slopes = np.tan(np.radians(heading(grid, turn_deg)))
    path = np.concatenate([[0.0], np.cumsum(0.5 * (slopes[1:] + slopes[:-1]) * np.diff(grid))])
    return np.interp(s, grid, path - np.interp(0.15, grid, path))


def tube(length_mm=260.0, turn_deg=10.0, left=False, rings=80, sides=48):
    """A closed foot-shaped tube in the canonical frame: (vertices_mm, faces)."""
    s = 0.5 - 0.5 * np.cos(np.linspace(0.03, np.pi - 0.03, rings))
    wide = np.interp(
        s, [0, 0.04, 0.15, 0.45, 0.7, 0.9, 1], [0.05, 0.09, 0.12, 0.135, 0.19, 0.13, 0.03]
    )
    high = np.interp(s, [0, 0.05, 0.2, 0.4, 0.65, 0.9, 1], [0.15, 0.3, 0.36, 0.3, 0.18, 0.09, 0.04])
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    x = np.repeat(s[:, None], sides, 1)
    y = centre_offset(s, turn_deg)[:, None] + 0.5 * wide[:, None] * np.cos(angle)
    z = 0.5 * high[:, None] * (1 + np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** 0.6)
    vertices = length_mm * np.stack([x, -y if left else y, z], axis=-1).reshape(-1, 3)
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    a = (ring * sides + side).ravel()
    b = (ring * sides + (side + 1) % sides).ravel()
    walls = np.concatenate([np.stack([a, a + sides, b], 1), np.stack([b, a + sides, b + sides], 1)])
    start, end = len(vertices), len(vertices) + 1
    k = np.arange(sides)
    heel = np.stack([np.full(sides, start), k, (k + 1) % sides], 1)
    last = (rings - 1) * sides
    toe = np.stack([np.full(sides, end), last + (k + 1) % sides, last + k], 1)
    tips = np.stack([vertices[:sides].mean(0), vertices[last : last + sides].mean(0)])
    faces = np.concatenate([walls, heel, toe])
    return np.concatenate([vertices, tips]), faces if left else faces[:, ::-1]


def profile(turn_deg=10.0, spoilt=()):
    """A right shape's flare profile; the channels of ``spoilt`` could not be measured."""
    plan = np.gradient(np.radians(heading(STATIONS, turn_deg)), STATIONS)
    waves = {
        "plan": plan,
        "bottom_20": 1.5 * np.sin(2 * np.pi * STATIONS),
        "bottom_50": 1.0 * np.sin(2 * np.pi * STATIONS + 0.3),
        "bottom_80": 0.6 * np.sin(2 * np.pi * STATIONS + 0.6),
        "bottom_surface": 4.0 + np.cos(5 * STATIONS),
    }
    return FlareProfile(
        definition=FlareDefinition(),
        angle_deg=float(turn_deg),
        angle_sd_deg=0.21,
        flare_class="straight" if 4 <= turn_deg <= 12 else "inflare",
        stations=STATIONS,
        heading_deg=heading(STATIONS, turn_deg),
        curvature={name: None if name in spoilt else waves[name] for name in CHANNELS},
        centre_line=np.stack([STATIONS, centre_offset(STATIONS, turn_deg)], axis=1),
    )


def turned(angle=0.7):
    """A rotation about a skew axis, as a 3x3 matrix."""
    axis = np.array([1.0, 2.0, -0.5]) / np.linalg.norm([1.0, 2.0, -0.5])
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) - np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def placed(rotation, shift, scale=1.0):
    """A similarity as a 4x4 matrix."""
    transform = np.eye(4)
    transform[:3, :3] = scale * rotation
    transform[:3, 3] = shift
    return transform


def info(path="feet/anna.stl", unit_scale=1.0):
    return MeshInfo(path, "0" * 64, "stl", 3842, 7680, True, "mm", "detected", unit_scale)


NOISE_MM = 0.4
"""What an extent is longer than the measured length."""


def alignment(path="feet/anna.stl", left=False, length_mm=260.0, warnings=(), reference=None):
    transform = placed(turned(), [12.0, -3.0, 40.0])
    vertices, _ = tube(length_mm, left=left)
    centred = vertices - vertices.mean(0)
    values, columns = np.linalg.eigh(centred.T @ centred / len(vertices))
    order = [2, 0, 1]  # along X, Y, Z: an unsorted row of values shows what pairs them wrongly
    rows = columns[:, order].T * np.sign(np.linalg.det(columns[:, order]))
    inverse = np.linalg.inv(transform)
    centroid = inverse[:3, :3] @ vertices.mean(0) + inverse[:3, 3]
    frame = Eigenframe(centroid, rows @ transform[:3, :3], values[order])
    return Alignment(
        info=info(path),
        method="footfit",
        side=SideVerdict("left" if left else "right", "sure", -4.1 if left else 4.1, "detected"),
        transform=transform,
        canonical_transform=transform,
        eigenframe=frame,
        printed_frame=replace(frame, centroid_mm=centroid + 1.0),
        pose=PoseQuality(0.21, 0.18, 0.15, True, "foot"),
        reference=reference,
        length=Measured(length_mm, 0.25),
        extent_mm=length_mm + NOISE_MM,
        stance=None,
        standing_transform=np.eye(4),
        warnings=tuple(warnings),
    )


def foot(path="feet/anna.stl", left=False, length_mm=260.0, turn_deg=10.0, **more):
    vertices, faces = tube(length_mm, turn_deg, left)
    measures = (Measure("length", Measured(length_mm, 0.4), "length/1"),)
    aligned = aligned_of(alignment(path, left, length_mm, **more), vertices, faces)
    return Profiled(aligned, profile(turn_deg), measures)


def measured_scan(path="feet/anna.stl"):
    """A foot with one measure, and one that could not be taken."""
    none = Measured(None, None, "the leg is cut below the instep")
    measures = (
        Measure("length", Measured(260.0, 0.25), "length/2"),
        Measure("instep_girth", none, "instep_girth/1"),
    )
    return MeasuredScan(alignment(path), measures, (Notice("suspect_measure", "unusual"),))


def record(name="derby-42", turn_deg=8.0, length_mm=273.0, left=False, **labels):
    known = alignment(left=left, length_mm=length_mm)
    given = {"style": "derby", "size": "42", "size_system": "eu", "width_label": "G"} | labels
    return LastRecord(
        labels=LastLabels(name, **given),
        info=info(f"{name}.stl"),
        side=known.side,
        pose=known.pose,
        eigenframe=known.eigenframe,
        printed_frame=known.printed_frame,
        canonical_transform=known.canonical_transform,
        paper_transform=known.canonical_transform,
        extent_mm=length_mm + NOISE_MM,
        flare=profile(turn_deg),
        measures=(Measure("length", Measured(length_mm, 0.4), "length/1"),),
        warnings=(),
    )


def candidate(rank, last, foot_length_mm=260.0, foot_turn_deg=10.0, **more):
    labels, delta = last.labels, last.flare.angle_deg - foot_turn_deg
    room, more_or_less = last.length_mm - foot_length_mm, "more" if delta > 0 else "less"
    values = {
        "verdict": None,
        "why": f"{room:.1f} mm toe room (wanted: 13 mm); "
        f"turns {abs(delta):.1f} deg {more_or_less} inward than the foot",
        "tied_with": (),
        "mirrored": False,
    } | more
    return Candidate(
        rank=rank,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        distance=0.31 * abs(delta) + 0.8,
        flare=FlareDifference(0.31 * abs(delta) + 0.8, delta, (("plan", 0.4), ("bottom_50", 0.2))),
        clearance_mm=(("length", Measured(last.length_mm - foot_length_mm, 0.7)),),
        record=last,
        **values,
    )


def roomy_candidate(side="right"):
    """A last that the foot was laid into: tight at the inner side, loose at the toes."""
    zones = (
        ZoneClearance("medial", 0.63, -6.15, 9.19, 91.1, 26.4, 5.2),
        ZoneClearance("toe", 5.61, -1.08, 12.31, 47.3, 1.5, 17.6),
        ZoneClearance("bottom", None, None, None, 0.0, 0.0, 0.0),
    )
    return candidate(1, record("derby-42"), surfaces=(SurfaceClearance(side, 2.9, zones),))


def match(feet=None, names=("derby-42", "oxford-42", "trainer-42", "boot-42", "derby-43"), **more):
    feet = (foot(),) if feet is None else feet
    lasts = [record(name, 8.0 + 2.1 * i, 271.5 + 1.4 * i) for i, name in enumerate(names)]
    values = {
        "feet": tuple(feet),
        "by": "fit",
        "profile": "walking",
        "catalogue_lasts": 12,
        "reference": "derby-42",
        "candidates": tuple(candidate(i + 1, last) for i, last in enumerate(lasts)),
        "rejected": (("too_long", 3), ("too_short", 4)),
        "warnings": (),
    } | more
    return Match(**values)


def reference():
    return Reference("derby-42", turned(0.1), np.array([120.0, 1.0, 40.0]))


def outcome(**more):
    values = {
        "path": "lasts/derby-42.stl",
        "status": "added",
        "last": "derby-42",
        "side": "right",
        "flare_angle_deg": 8.02,
    } | more
    return IngestOutcome(**values)


def facts(**more):
    values = {
        "path": "lasts.footfit",
        "bytes": 1_850_000,
        "lasts": 12,
        "reference": "derby-42",
        "schema_revision": "0001",
        "definitions": ((FlareDefinition().version, 12),),
        "styles": (("derby", 6), ("oxford", 6)),
        "size_systems": (("eu", 12),),
        "sides": (("right", 12),),
        "mesh_copies": 12,
        "mesh_copy_bytes": 1_400_000,
        "worst_copy_error_mm": 0.18,
        "kept": (("last", 12), ("mesh_copy", 12)),
    } | more
    return CatalogueFacts(**values)


def curvature(path="feet/anna.stl"):
    vertices, faces = tube()
    wave = 0.02 * np.sin(vertices[:, 0] / 20.0)
    wave[:5] = np.nan
    source = np.arange(len(vertices))
    warnings = (Notice("open_mesh", "the mesh is open; its rim has no curvature"),)
    return SurfaceCurvature(
        info(path), 15.0, vertices, faces, wave - 0.01, wave + 0.01, wave, wave**2, source, warnings
    )
