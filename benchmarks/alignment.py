"""Is the pose right, the side right, the frame the same: many seeded runs, one table.

    python -m benchmarks.alignment [--runs 500] [--seed 1] [--write]

Shapes are the generator's lasts, the generated feet and the other scans in ../shared/scans where
they are present; each run takes one, a side, a distortion, a unit and a random pose. ``--write``
puts the tables into docs/alignment.md. Times are of one process: read the ratios.
"""

from __future__ import annotations

import argparse
import io
import time
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from footfit.errors import FootfitError
from footfit.geometry.mesh.surface import face_normals
from footfit.geometry.mesh.topology import boundary_loops
from footfit.geometry.numeric.rotations import angle_deg
from footfit.geometry.pose import paper_frame
from footfit.meshes.units import UNIT_SCALES
from footfit.results import MeshInfo, Reference, Scan
from tests import distortions, shapes
from tests.reading import read_scan
from tests.scans import aligned
from tools.lasts import LastSpec, last_mesh, true_flare_deg

SCANS = Path(__file__).resolve().parents[2] / "shared" / "scans"
DOCS = Path(__file__).resolve().parents[1] / "docs" / "alignment.md"
MARKS = ("<!-- table:alignment -->", "<!-- end -->")
LASTS = 24
POSE_DEG = 10.0  # from the clean mesh's frame
KNOWN_DEG = 20.0  # from the pose that is known by construction, whose plane is another's choice
# Heel-to-toe direction and up of the scans that carry no truth, looked up once by eye.
KNOWN_AXES = {
    "FIND_template": ((1, 0, 0), (0, 0, 1)),
    "MHR_template_L": ((1, 0, 0), (0, 0, 1)),
    "MHR_template_R": ((1, 0, 0), (0, 0, 1)),
    "dupontgu_L": ((0, -1, 0), (0, 0, 1)),
    "dupontgu_R": ((-0.28, -0.96, 0), (0, 0, 1)),
}
SIDES = {"FIND_template": "left"}


@dataclass(frozen=True)
class Shape:
    """One shape in a pose that is known: x heel to toe, z up, and the frame of the clean mesh."""

    name: str
    family: str
    vertices: np.ndarray
    faces: np.ndarray
    side: str
    flare_deg: float | None
    frame: np.ndarray


def scan_of(vertices, faces, unit="mm", source="detected"):
    """A scan as the reader would hand it over: the file is in ``unit``, and that was detected."""
    info = MeshInfo(
        None, "", "stl", len(vertices), len(faces), True, unit, source, UNIT_SCALES[unit]
    )
    fields = {"info": info, "vertices_mm": vertices, "faces": faces, "warnings": ()}
    if "source_to_vertex" in Scan.__dataclass_fields__:
        fields["source_to_vertex"] = np.arange(len(vertices))
    return Scan(**fields)


def random_specs(rng, count=LASTS):
    """Lasts of every kind: heel 0-60 mm, outflare to inflare, four toes, 180-320 mm."""
    toes = ("round", "almond", "square", "pointed")
    for index in range(count):
        length = rng.uniform(200.0, 310.0)
        yield LastSpec(
            length_mm=length,
            ball_width_mm=length * rng.uniform(0.33, 0.40),
            heel_height_mm=(0.0, 15.0, 25.0, 40.0, 60.0)[index % 5],
            toe_spring_mm=rng.uniform(4.0, 16.0),
            flare_deg=(-4.0, 2.0, 6.0, 10.0, 14.0, 18.0)[index % 6],
            toe_shape=toes[index % 4],
            ridge_mm=rng.uniform(3.0, 11.0),
            arch_mm=rng.uniform(2.0, 7.0),
            rings=90,
            segments=64,
        )


def upright(vertices, x, z):
    """Vertices turned so that ``x`` is x and ``z`` is z."""
    y = np.cross(z, x)
    rows = np.array([row / np.linalg.norm(row) for row in (x, y, z)])
    return vertices @ rows.T


def shapes_at_hand(rng):
    """Every shape, each with the frame that its clean mesh gets."""
    found = [
        ("last", "lasts", *last_mesh(spec), "right", true_flare_deg(spec))
        for spec in random_specs(rng)
    ]
    for path in sorted((SCANS / "makehuman").glob("*.stl")):
        scan = read_scan(path)
        side = "left" if path.stem.endswith("L") else "right"
        found.append((path.stem, "generated feet", scan.vertices_mm, scan.faces, side, None))
    for name, axes in KNOWN_AXES.items():
        path = SCANS / f"{name}.stl"
        if not path.exists():
            continue
        scan = read_scan(path)
        side = SIDES.get(name, "left" if name.endswith("L") else "right")
        vertices = upright(scan.vertices_mm, *map(np.array, axes))
        found.append((name, "other scans", vertices, scan.faces, side, None))
    for name, family, vertices, faces, side, flare in found:
        frame = aligned(scan_of(vertices, faces)).alignment.canonical_transform
        yield Shape(name, family, vertices, faces, side, flare, frame)


def with_leg(vertices, faces, height_mm, cut_mm=80.0):
    """The shape cut at ``cut_mm``, a calf of the cut's outline up to ``height_mm``; open on top."""
    vertices, faces = distortions.leg_cut(vertices, faces, cut_mm)
    loop = max(boundary_loops(faces), key=len)[::-1]
    rim = vertices[loop]
    middle = rim.mean(axis=0)
    levels = np.linspace(0.0, 1.0, int((height_mm - cut_mm) / 4.0))[1:, None, None]
    swell = 1 + 0.35 * np.sin(0.5 * np.pi * np.minimum(levels * (height_mm - cut_mm) / 250.0, 2.0))
    rings = middle + (rim - middle) * np.concatenate([swell, swell, 0 * swell + 1], axis=2)
    rings[:, :, 2] += levels[:, :, 0] * (height_mm - cut_mm)
    first = len(vertices) + np.arange(len(levels))[:, None] * len(loop) + np.arange(len(loop))
    index = np.concatenate([loop[None], first])
    a, b = index[:-1], index[1:]
    c, d = np.roll(a, -1, axis=1), np.roll(b, -1, axis=1)
    tube = [np.stack(t, axis=2).reshape(-1, 3) for t in ((a, c, b), (c, d, b))]
    return np.concatenate([vertices, rings.reshape(-1, 3)]), np.concatenate([faces, *tube])


def holed(vertices, faces, rng, count, radius_mm, front=0.70):
    """Holes behind ``front`` of the length of a shape that lies along X: none bites off a toe."""
    start, length = vertices[:, 0].min(), np.ptp(vertices[:, 0])
    behind = np.flatnonzero(vertices[:, 0] < start + front * length)
    middles, keep = vertices[faces].mean(axis=1), np.ones(len(faces), dtype=bool)
    for centre in vertices[rng.choice(behind, count, replace=False)]:
        keep &= np.linalg.norm(middles - centre, axis=1) > radius_mm
    used, renamed = np.unique(faces[keep], return_inverse=True)
    return vertices[used], renamed.reshape(-1, 3)


def soleless(vertices, faces, steepest=-0.5):
    """A shape that stands along X and Z without the faces below .35 L that look down."""
    low = vertices[faces].mean(axis=1)[:, 2] < vertices[:, 2].min() + 0.35 * np.ptp(vertices[:, 0])
    used, renamed = np.unique(
        faces[~(low & (face_normals(vertices, faces)[:, 2] < steepest))], return_inverse=True
    )
    return vertices[used], renamed.reshape(-1, 3)


DISTORTIONS = {
    "clean": lambda v, f, _: (v, f),
    "noise 0.3 mm": lambda v, f, rng: (distortions.white_noise(v, rng, 0.3), f),
    "ripple 0.3 mm": lambda v, f, rng: (distortions.rippled(v, f, rng, 0.3), f),
    "4x decimated": lambda v, f, _: distortions.decimated(v, f, 4),
    "half subdivided": lambda v, f, _: distortions.half_subdivided(v, f),
    "leg cut 62-100 mm": lambda v, f, rng: distortions.leg_cut(v, f, rng.uniform(62, 100)),
    "leg cut 50-62 mm": lambda v, f, rng: distortions.leg_cut(v, f, rng.uniform(50, 62)),
    "three holes of 18 mm": lambda v, f, rng: distortions.with_holes(v, f, rng, 3, 9.0),
    "three of 24 mm, not in toes": lambda v, f, rng: holed(v, f, rng, 3, 12.0),
    "no sole": lambda v, f, _: soleless(v, f),
    "floor plate": lambda v, f, _: distortions.floor_plate(v, f),
    "leg to 250-500 mm": lambda v, f, rng: with_leg(v, f, rng.uniform(250.0, 500.0)),
    "inside out": lambda v, f, _: distortions.inside_out(v, f),
}


def in_unit(pose, mm_per_unit):
    """The pose (4, 4) with its result in another unit than mm."""
    return np.diag([1 / mm_per_unit] * 3 + [1.0]) @ pose


def upright_enough(turn):
    """Whether X and Z lie near those of the pose that is known: no heel taken for a toe."""
    return min(turn[0, 0], turn[2, 2]) > np.cos(np.radians(KNOWN_DEG))


def one_run(shape, distortion, rng):
    """Pose, side, repeatability and time of one distorted, posed, perhaps mirrored copy."""
    vertices, faces = DISTORTIONS[distortion](shape.vertices, shape.faces, rng)
    mirror = rng.random() < 0.5
    side, expected = shape.side, shape.frame
    if mirror:
        vertices, faces = distortions.mirrored(vertices, faces)
        side = "left" if side == "right" else "right"
        flip = np.diag([1.0, -1.0, 1.0, 1.0])
        expected = flip @ expected @ flip
    pose = distortions.random_pose(rng)
    unit = rng.choice(list(UNIT_SCALES))
    started = time.perf_counter()
    try:
        answer = aligned(scan_of(distortions.moved(vertices, pose), faces, unit)).alignment
    except FootfitError as error:
        return {"refused": error.code, "pose": False}
    elapsed = time.perf_counter() - started
    # from the undistorted shape's mm, through the pose and the file's unit, to canonical mm
    found = answer.canonical_transform @ in_unit(pose, UNIT_SCALES[unit])
    turn = found[:3, :3]
    origin, there = (np.linalg.solve(t[:3, :3], -t[:3, 3]) for t in (found, expected))
    return {
        "turn_deg": angle_deg(turn, expected[:3, :3]),
        "shift_mm": float(np.linalg.norm(origin - there)),
        "pose": angle_deg(turn, expected[:3, :3]) < POSE_DEG and upright_enough(turn),
        "side": answer.side.side == side,
        "word": answer.side.confidence,
        "score": answer.side.score * (1 if side == "right" else -1),
        "cost": answer.pose.cost,
        "margin": answer.pose.margin,
        "sole": answer.pose.sole,
        "time": elapsed,
        "unit": answer.info.units == unit,
    }


# ---------------------------------------------------------------- tables


def repeatability(shapes_found, runs, rng, complain):
    """Rows of the table of runs, by distortion, and the run times."""
    names, rows = list(DISTORTIONS), defaultdict(list)
    for index in range(runs):
        shape = shapes_found[rng.integers(len(shapes_found))]
        name = names[index % len(names)]
        if shape.family == "lasts" and "leg" in name:
            name = "three holes of 18 mm"  # a last has no leg to cut or to stretch
        row = one_run(shape, name, rng)
        rows[name].append((shape, row))
        if not row["pose"]:
            complain(f"run {index}: wrong pose: {name}, {shape.name}, {row}")
    return rows


def median_and_worst(values):
    """Two figures in one cell."""
    return f"{np.median(values):.3f} / {np.max(values):.3f}"


def pose_table(rows):
    """Pose, unit, repeatability, cost and margin per distortion."""
    yield "| distortion | runs | pose right | unit right | turn, deg | shift, mm | cost | margin |"
    yield "|---|---|---|---|---|---|---|---|"
    for name, pairs in rows.items():
        good = [row for _, row in pairs if row["pose"]]
        cells = [
            name,
            len(pairs),
            len(good),
            sum(row["unit"] for row in good),
            median_and_worst([row["turn_deg"] for row in good]),
            median_and_worst([row["shift_mm"] for row in good]),
            f"{max(row['cost'] for row in good):.2f}",
            f"{min(row['margin'] for row in good):.2f}",
        ]
        yield "| " + " | ".join(map(str, cells)) + " |"


def side_table(rows):
    """Side and confidence per family, for lasts by flare angle."""
    groups = defaultdict(list)
    for pairs in rows.values():
        for shape, row in pairs:
            if row["pose"]:
                outward = shape.flare_deg is not None and shape.flare_deg < 0
                straight = shape.flare_deg is not None and 0 <= shape.flare_deg < 4
                kind = (
                    "lasts, outflare"
                    if outward
                    else "lasts, straight"
                    if straight
                    else ("lasts, flare >= 4 deg" if shape.flare_deg is not None else shape.family)
                )
                groups[kind].append(row)
    yield "| shapes | runs | side right | sure | sure and wrong | undecided | least score |"
    yield "|---|---|---|---|---|---|---|"
    for kind, found in sorted(groups.items()):
        sure = [row for row in found if row["word"] == "sure"]
        cells = [
            kind,
            len(found),
            sum(row["side"] for row in found),
            len(sure),
            sum(not row["side"] for row in sure),
            sum(row["word"] == "undecided" for row in found),
            f"{min(row['score'] for row in found):.2f}",
        ]
        yield "| " + " | ".join(map(str, cells)) + " |"


def negatives():
    """Shapes that must be refused, by name."""
    last = last_mesh(LastSpec(rings=60, segments=40))
    across = {"heel half of a last": (1.0, 140.0), "toe half of a last": (-1.0, 130.0)}
    slabs = {f"sole slab of {height:.0f} mm": height for height in (12.0, 20.0, 25.0, 30.0)}
    box, box_faces = shapes.cube(1.0, 8)
    found = {
        "cylinder": shapes.cylinder(),
        "short cylinder": shapes.cylinder(50.0, 180.0),
        "ellipsoid": shapes.ellipsoid(),
        "sphere": shapes.sphere(130.0),
        "cube": shapes.cube(250.0, 8),
        "box": (box * [260.0, 95.0, 80.0], box_faces),
        "hand": shapes.hand(),
        "large hand": shapes.hand(240.0),
        "sheet": shapes.flat_sheet(),
        "shin": shapes.shin(),
        "long shin": shapes.shin(400.0),
        "torus": shapes.torus(100.0, 30.0),
        "two lasts": shapes.two_feet(*last),
    }
    for name, (sign, x) in across.items():
        found[name] = distortions.plane_cut(
            *last, np.array([x, 0.0, 0.0]), np.array([sign, 0.0, 0.0])
        )
    for name, height in slabs.items():
        found[name] = distortions.leg_cut(*last, height)
    low, high = last[0].min(axis=0), last[0].max(axis=0)
    for share in (0.3, 0.5, 0.7):
        at = low + share * (high - low)
        cut = distortions.plane_cut(*last, at, np.array([0.0, 1.0, 0.0]))
        found[f"lateral {100 * share:.0f} % of a last"] = cut
        found[f"the same {100 * share:.0f} %, closed"] = with_lids(*cut)
    return found


def with_lids(vertices, faces):
    """Every opening closed by a flat fan."""
    for loop in boundary_loops(faces):
        fan = np.stack([np.roll(loop, -1), loop, np.full(len(loop), len(vertices))], axis=1)
        vertices = np.vstack([vertices, vertices[loop].mean(axis=0)])
        faces = np.vstack([faces, fan])
    return vertices, faces


def negative_table(rng, poses=6):
    """How often each is accepted: its unit to be detected, declared, and no scale at all."""
    yield "| not a foot | accepted | refused as |"
    yield "|---|---|---|"
    for name, (vertices, faces) in negatives().items():
        accepted, reasons = 0, set()
        for index in range(poses):
            moved = distortions.moved(vertices, distortions.random_pose(rng))
            source = ("detected", "declared", "known-length")[index % 3]
            known = 250.0 if source == "known-length" else None
            try:
                aligned(scan_of(moved, faces, source=source), known_length_mm=known)
                accepted += 1
            except FootfitError as error:
                reasons.add(error.code)
        yield f"| {name} | {accepted} of {poses} | {', '.join(sorted(reasons))} |"


def method_table(shapes_found, rng, poses=12):
    """What each method leaves: the distance between a posed shape and the same shape at home."""
    first = next(shape for shape in shapes_found if shape.family == "lasts")
    home = aligned(scan_of(first.vertices, first.faces)).alignment
    frame = home.printed_frame
    reference = Reference(
        "first",
        paper_frame.om_e(frame.eigenvectors, home.canonical_transform),
        paper_frame.canonical_centroid_mm(frame.centroid_mm, home.canonical_transform, 1.0),
    )
    chosen = [first, *(s for s in shapes_found if s.family == "lasts" and s is not first)][:6]
    chosen += [s for s in shapes_found if s.family == "generated feet"][:4]
    chosen += [s for s in shapes_found if s.family == "other scans"]
    yield "| method | same shape, two poses: median, mm | axes off canonical: median, worst, deg |"
    yield "|---|---|---|"
    for method in ("paper-literal", "paper", "footfit"):
        apart, off = [], []
        for shape in chosen:
            placed = []
            for _ in range(max(2, poses // 6)):
                moved = distortions.moved(shape.vertices, distortions.random_pose(rng))
                side = shape.side
                found = aligned(
                    scan_of(moved, shape.faces), method=method, side=side, reference=reference
                ).alignment
                linear = found.transform[:3, :3] @ found.canonical_transform[:3, :3].T
                off.append(angle_deg(np.eye(3), linear))
                placed.append(moved @ found.transform[:3, :3].T + found.transform[:3, 3])
            apart += [np.median(np.linalg.norm(p - placed[0], axis=1)) for p in placed[1:]]
        yield f"| {method} | {np.median(apart):.2f} | {np.median(off):.1f}, {np.max(off):.1f} |"


def stl_bytes(vertices, faces):
    """A binary STL."""
    from footfit.meshes.write import encoded_mesh

    return encoded_mesh(vertices, faces, "stl")


def time_table(rng, repeats=5):
    """Alignment of one last against reading the same file with trimesh, in one process."""
    import trimesh

    yield "| faces | align, ms of a core | over trimesh.load_mesh of the same STL |"
    yield "|---|---|---|"
    for rings, segments in ((90, 50), (150, 100), (180, 125)):
        vertices, faces = last_mesh(LastSpec(rings=rings, segments=segments))
        vertices = distortions.moved(vertices, distortions.random_pose(rng))
        data = stl_bytes(vertices, faces)
        scan = scan_of(vertices, faces)
        ours, theirs = [], []
        for _ in range(repeats):
            started = time.process_time()
            aligned(scan)
            ours.append(time.process_time() - started)
            started = time.process_time()
            trimesh.load_mesh(io.BytesIO(data), file_type="stl")
            theirs.append(time.process_time() - started)
        ratio = min(ours) / min(theirs)
        yield f"| {len(faces)} | {1e3 * min(ours):.0f} | {ratio:.2f} |"


def report(runs, seed, complain):
    """All tables as Markdown lines."""
    rng = np.random.default_rng(seed)
    found = list(shapes_at_hand(rng))
    count = {
        family: sum(s.family == family for s in found)
        for family in dict.fromkeys(s.family for s in found)
    }
    rows = repeatability(found, runs, rng, complain)
    good = sum(row["pose"] for pairs in rows.values() for _, row in pairs)
    yield f"Seed {seed}, {runs} runs over " + ", ".join(f"{n} {k}" for k, n in count.items())
    yield f"in random poses, sides and units: {good} poses right. Median / worst:"
    yield ""
    yield from pose_table(rows)
    yield ""
    yield from side_table(rows)
    yield ""
    yield from negative_table(rng)
    yield ""
    yield from method_table(found, rng)
    yield ""
    yield from time_table(rng)


def main():
    """Print the tables; put them into the page where asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    lines = []
    for line in report(options.runs, options.seed, complain=print):
        print(line, flush=True)
        lines.append(line)
    if options.write:
        page = DOCS.read_text(encoding="utf-8")
        before, rest = page.split(MARKS[0])
        after = rest.split(MARKS[1], 1)[1]
        body = "\n".join([MARKS[0], *lines, MARKS[1]])
        DOCS.write_text(before + body + after, encoding="utf-8")


if __name__ == "__main__":
    main()
