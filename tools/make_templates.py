"""Make footfit/pipeline/scan/templates.npz: the foot and the lasts that every pose is fitted to.

    python -m tools.make_templates FOOT.stl [-o footfit/pipeline/scan/templates.npz]

FOOT is a right foot in mm with x from heel to toe and the sole near z = 0; the shipped file is
made from the CC0 foot mh006_R of the generated feet. The lasts are the generator's own.
Same input, same bytes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from footfit.geometry.mesh.samples import even_sample, quadrature
from footfit.geometry.pose.frame import canonical_frame
from footfit.pipeline.scan.shipped_templates import FILE, NORMAL_STEP, POINT_STEP
from tests.reading import read_scan
from tools.lasts import LastSpec, last_mesh, standing

PITCH = 0.025
POINTS = 6000
LEG_POINTS = 1800
LEG_TOP = 1.35
LEG_BAND = (0.06, 0.01)  # of L below the cut: what is repeated upwards as a leg
MARGIN = 0.15
HEELED = {"toe_spring_mm": 6.0, "break_length": 0.06, "level_tread": True}
TALL_MM = 165.0
LASTS = {  # those after "last" are tried in this order, only if the first two fit badly
    "last": LastSpec(),
    "boot_30": LastSpec(heel_height_mm=30.0, cone_height_mm=TALL_MM, **HEELED),
    "heel_90": LastSpec(heel_height_mm=90.0, **HEELED),
    "heel_115": LastSpec(heel_height_mm=115.0, cone_height_mm=70.0, **HEELED),
    "boot_85": LastSpec(heel_height_mm=85.0, cone_height_mm=TALL_MM, **HEELED),
    "boot_75": LastSpec(heel_height_mm=75.0, cone_height_mm=TALL_MM, **HEELED),
}
ERECT = ("heel_90", "boot_85")
"""Lasts whose sections are upright where they stand; the others' are where they rest."""
EDGE_STATIONS = 60


def erect(vertices, pitch_deg):
    """A last at rest, its sections leaned back about the bottom by the pitch that it stands at."""
    x, z = vertices[:, 0], vertices[:, 2]
    place = np.minimum(((x - x.min()) / np.ptp(x) * EDGE_STATIONS).astype(int), EDGE_STATIONS - 1)
    stations = [place == i for i in range(EDGE_STATIONS)]
    edge = [x[there].mean() for there in stations], [z[there].min() for there in stations]
    bottom = np.interp(x, *edge)
    height, angle = z - bottom, np.radians(pitch_deg)
    upper = np.maximum(height, 0.0)
    away = [x - np.sin(angle) * upper, vertices[:, 1], z - (1.0 - np.cos(angle)) * upper]
    return np.column_stack(away)


def canonical_points(vertices, faces, count, *, last):
    """Even points and normals of a mesh, canonical, over its length."""
    fine = quadrature(vertices, faces, edge=3.0)
    frame = canonical_frame(fine, np.ptp(vertices[:, 0]), last=last)
    sample = even_sample(vertices, faces, count)
    points = (sample.points @ frame.rotation.T + frame.shift) / frame.length
    print(f"length {frame.length:.2f}, support {frame.support:.3f}")
    return points, sample.normals @ frame.rotation.T


def with_leg(points, normals):
    """A foot's points with the band under its cut repeated up to LEG_TOP, and without the cap."""
    top = points[:, 2].max()
    cap = (points[:, 2] > top - 0.01) & (normals[:, 2] > 0.7)
    points, normals = points[~cap], normals[~cap]
    low, high = top - LEG_BAND[0], top - LEG_BAND[1]
    band = (points[:, 2] > low) & (points[:, 2] <= high) & (np.abs(normals[:, 2]) < 0.7)
    body = points[:, 2] <= high
    period = high - low
    repeats = int(np.ceil((LEG_TOP - high) / period))
    legs = [points[band] + [0, 0, period * (i + 1)] for i in range(repeats)]
    flat = normals[band] * [1, 1, 0]
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    leg, leg_normals = np.concatenate(legs), np.tile(flat, (repeats, 1))
    return (points[body], normals[body]), (leg, leg_normals)


def thinned(points, normals, count):
    """``count`` of the points, evenly by index."""
    chosen = np.linspace(0, len(points) - 1, min(count, len(points))).astype(int)
    return points[chosen], normals[chosen]


def arrays_of(name, points, normals):
    """What the file holds of one shape."""
    from scipy.spatial import cKDTree

    origin = points.min(axis=0) - MARGIN
    shape = np.ceil((points.max(axis=0) + MARGIN - origin) / PITCH).astype(int)
    middles = np.moveaxis(np.indices(shape), 0, 3) * PITCH + origin + PITCH / 2
    stored = np.round(points / POINT_STEP).astype(np.int16)
    _, table = cKDTree(stored * POINT_STEP).query(middles.reshape(-1, 3))
    low = points[points[:, 2] < 0.35, 1]
    return {
        f"{name}_points": stored,
        f"{name}_normals": np.round(normals / NORMAL_STEP).astype(np.int8),
        f"{name}_origin": origin.astype(np.float32),
        f"{name}_table": table.reshape(shape).astype(np.int16),
        f"{name}_middle_y": np.float32((low.min() + low.max()) / 2),
    }


def foot_arrays(path):
    """The foot with its leg."""
    scan = read_scan(path, units="mm")
    points, normals = canonical_points(scan.vertices_mm, scan.faces, 12000, last=False)
    body, leg = with_leg(points, normals)
    parts = thinned(*body, POINTS - LEG_POINTS), thinned(*leg, LEG_POINTS)
    joined = [np.concatenate(columns) for columns in zip(*parts, strict=True)]
    return arrays_of("foot", *joined)


def last_arrays(name):
    """A last of the generator."""
    vertices, faces = last_mesh(LASTS[name])
    if name in ERECT:
        vertices = erect(vertices, standing(LASTS[name]).pitch_deg)
    return arrays_of(name, *canonical_points(vertices, faces, POINTS, last=True))


def main():
    """Write the file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("foot", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=FILE)
    options = parser.parse_args()
    arrays = {
        "names": np.array(["foot", *LASTS]),
        "kinds": np.array(["foot"] + ["last"] * len(LASTS)),
        "pitch": np.float32(PITCH),
        **foot_arrays(options.foot),
    }
    for name in LASTS:
        arrays |= last_arrays(name)
    np.savez_compressed(options.output, **arrays)
    print(f"{options.output}: {options.output.stat().st_size} bytes")


if __name__ == "__main__":
    main()
