"""Flare against its planted truth, and how far it moves when only the scan changes.

    python -m benchmarks.flare [--lasts 24] [--feet 12] [--seed 1] [--write]

Lasts of known turn come from tools/lasts.py, feet from ../shared/scans/makehuman where it is
present. ``--write`` puts the tables into docs/flare.md.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks import bends
from benchmarks.alignment import holed, scan_of
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, FlareProfile
from footfit.geometry.flare.flare_profile import flare_profile
from footfit.geometry.flare.levelled_bottom import low_length
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.preparation import closed_shape
from footfit.results import Profiled
from tests import distortions
from tests.distortions import half_subdivided, rippled, white_noise
from tests.reading import read_scan
from tests.scans import aligned, right_shape
from tools.lasts import LastSpec, last_mesh, true_heading_deg, varied

ROOT = Path(__file__).resolve().parents[1]
SCANS = ROOT.parent / "shared" / "scans" / "makehuman"
BENDS_DEG = (-8.0, -4.0, 4.0, 8.0)

Mesh = tuple[np.ndarray, np.ndarray]
Change = Callable[[np.ndarray, np.ndarray, np.random.Generator], Mesh]


@dataclass(frozen=True)
class Shape:
    """A canonical right shape; ``spec`` where its turn is known."""

    vertices: np.ndarray
    faces: np.ndarray
    kind: str
    spec: LastSpec | None = None


def turned(axis: str, angle_deg: float) -> Change:
    """A frame that is wrong by this angle about this axis."""

    def change(vertices, faces, rng):
        sign = 1.0 if rng.random() < 0.5 else -1.0
        matrix = distortions.axis_rotation(axis, sign * angle_deg)[:3, :3]
        return vertices @ matrix.T, faces

    return change


def closed(change: Change) -> Change:
    """A change after which holes are closed, as they are between the frame and the flare."""
    return lambda v, f, rng: closed_shape(*change(v, f, rng))


CHANGES: dict[str, Change] = {
    "noise 0.3 mm": lambda v, f, rng: (white_noise(v, rng, 0.3), f),
    "noise 1 mm": lambda v, f, rng: (white_noise(v, rng, 1.0), f),
    "ripple 0.3 mm, wavelength 10 mm": lambda v, f, rng: (rippled(v, f, rng, 0.3), f),
    "4x decimation": lambda v, f, _: distortions.decimated(v, f, 4.0),
    "10x decimation": lambda v, f, _: distortions.decimated(v, f, 10.0),
    "half of the mesh subdivided": lambda v, f, _: half_subdivided(v, f),
    "scaled by 1.7": lambda v, f, _: (v * 1.7, f),
    "leg cut": lambda v, f, _: distortions.leg_cut(v, f, 0.27 * np.ptp(v[:, 0])),
    "3 holes of 18 mm": closed(lambda v, f, rng: holed(v, f, rng, 3, 9.0)),
    "3 holes of 24 mm": closed(lambda v, f, rng: holed(v, f, rng, 3, 12.0)),
    "3 bites of 24 mm, toes too": closed(
        lambda v, f, rng: distortions.with_holes(v, f, rng, 3, 12.0)
    ),
    "roll of the frame 0.3 deg": turned("x", 0.3),
    "roll 2 deg": turned("x", 2.0),
    "pitch 0.3 deg": turned("y", 0.3),
    "yaw 1 deg": turned("z", 1.0),
}
POSED: dict[str, Change] = {
    "pose alone": lambda v, f, _: (v, f),
    "pose, noise 0.3 mm": CHANGES["noise 0.3 mm"],
    "pose, ripple 0.3 mm": CHANGES["ripple 0.3 mm, wavelength 10 mm"],
    "pose, 4x decimation": CHANGES["4x decimation"],
    "pose, half subdivided": CHANGES["half of the mesh subdivided"],
    "pose, leg cut": CHANGES["leg cut"],
    "pose, 3 holes of 24 mm": lambda v, f, rng: holed(v, f, rng, 3, 12.0),
}


def lasts(count: int, seed: int) -> list[Shape]:
    """Lasts of every kind, with their planted turn."""
    rng = np.random.default_rng(seed)
    specs = [varied(rng) for _ in range(count)]
    return [Shape(*last_mesh(spec), "last", spec) for spec in specs]


def feet(count: int) -> list[Shape]:
    """Generated feet in their own canonical frame, as right ones."""
    paths = sorted(SCANS.glob("*.stl"))
    chosen = paths[:: max(1, len(paths) // max(count, 1))][:count]
    return [Shape(*right_shape(aligned(read_scan(path))), "foot") for path in chosen]


def through_the_pipeline(shape: Shape, change: Change, rng: np.random.Generator) -> Profiled:
    """Changed, put in a random pose, aligned and profiled like any scan."""
    vertices, faces = change(shape.vertices, shape.faces, rng)
    posed = distortions.moved(vertices, distortions.random_pose(rng))
    return profiled_scan(aligned(scan_of(posed, faces), side="right"))


def rms(values: list[float]) -> float:
    """Root mean square; NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")


def worst(values: list[float]) -> float:
    """The largest absolute value; NaN of nothing."""
    return float(np.abs(values).max()) if values else float("nan")


def angle_rows(shapes: dict[str, list[Shape]], seed: int) -> Iterator[list[str]]:
    """How far the angle moves under each change, in the canonical frame."""
    rng = np.random.default_rng(seed)
    profiles = {
        kind: [flare_profile(s.vertices, s.faces) for s in of] for kind, of in shapes.items()
    }
    errors = [
        p.angle_deg - s.spec.flare_deg
        for s, p in zip(shapes["last"], profiles["last"], strict=True)
        if s.spec is not None
    ]
    yield [
        "nothing: against the planted turn",
        f"{rms(errors):.3f}",
        f"{worst(errors):.3f}",
        "",
        "",
    ]
    for name, change in CHANGES.items():
        row = [name]
        for kind in ("last", "foot"):
            moved = [
                flare_profile(*change(s.vertices, s.faces, rng)).angle_deg - p.angle_deg
                for s, p in zip(shapes[kind], profiles[kind], strict=True)
            ]
            row += [f"{rms(moved):.2g}", f"{worst(moved):.2g}"]
        yield row


def bend_rows(shapes: list[Shape], seed: int) -> Iterator[list[str]]:
    """What a planted bend changes, straight and bent foot each in a random pose of its own."""
    rng = np.random.default_rng(seed + 3)
    still = [through_the_pipeline(s, POSED["pose alone"], rng).flare for s in shapes]
    for name in ("its centre line", "X"):
        for turn in BENDS_DEG:
            errors, truths = [], []
            for shape, straight in zip(shapes, still, strict=True):
                change, truth = bend(shape, turn, own=name != "X")
                run = through_the_pipeline(shape, change, rng).flare
                truths.append(truth)
                errors.append(run.angle_deg - straight.angle_deg - truth)
            yield [
                f"{turn:+.0f} along {name}",
                f"{np.mean(truths):+.2f}",
                f"{np.mean(errors):+.2f}",
                f"{rms(errors):.2f}",
                f"{worst(errors):.2f}",
            ]


def bend(shape: Shape, turn_deg: float, *, own: bool) -> tuple[Change, float]:
    """A bend of a foot, and what it truly changes of its flare angle."""
    definition = FlareDefinition()
    length_mm = low_length(shape.vertices, definition.length_height)[1]
    line = bends.own_line(flare_profile(shape.vertices, shape.faces), length_mm)
    axis = line if own else bends.x_axis(length_mm)

    def change(vertices, faces, _):
        return bends.bent(vertices, axis, turn_deg), faces

    return change, bends.true_change_deg(line, axis, turn_deg)


@dataclass
class Posed:
    """What the whole pipeline gives in random poses: changes against the shape's own first run."""

    errors: dict[str, list[float]]
    angles: dict[tuple[str, str], list[float]]
    said: dict[tuple[str, str], list[float]]
    channels: dict[str, list[np.ndarray]]
    spread: dict[str, list[np.ndarray]]
    refused: int = 0


def posed_runs(shapes: dict[str, list[Shape]], seed: int) -> Posed:
    """Every shape through the whole pipeline, once still and once under each change."""
    rng = np.random.default_rng(seed + 1)
    found = Posed({}, {}, {}, {c: [] for c in CHANNELS}, {c: [] for c in CHANNELS})
    for shape in [s for of in shapes.values() for s in of]:
        still = through_the_pipeline(shape, POSED["pose alone"], rng)
        for channel, curve in still.flare.curvature.items():
            if curve is not None:
                found.spread[channel].append(curve)
        for name, change in POSED.items():
            try:
                run = through_the_pipeline(shape, change, rng)
            except FootfitError as error:
                print(f"refused: {shape.kind}, {name}: {error}", file=sys.stderr)
                found.refused += 1
                continue
            _note(found, shape, name, still, run)
    return found


def _note(found: Posed, shape: Shape, name: str, still: Profiled, run: Profiled) -> None:
    key = (name, shape.kind)
    if shape.spec is not None:
        found.errors.setdefault(name, []).append(run.flare.angle_deg - shape.spec.flare_deg)
    found.angles.setdefault(key, []).append(run.flare.angle_deg - still.flare.angle_deg)
    found.said.setdefault(key, []).append(run.flare.angle_sd_deg)
    for channel, moved in channel_changes(still.flare, run.flare).items():
        found.channels[channel].append(moved)


def channel_changes(a: FlareProfile, b: FlareProfile) -> dict[str, np.ndarray]:
    """The difference of two profiles over the stations that the distance reads."""
    low, high = DISTANCE.stations
    inside = (a.stations >= low) & (a.stations <= high)
    pairs = {name: (a.curvature[name], b.curvature[name]) for name in CHANNELS}
    return {
        name: (one - other)[inside]
        for name, (one, other) in pairs.items()
        if one is not None and other is not None
    }


def posed_rows(found: Posed) -> Iterator[list[str]]:
    """The flare angle in random poses."""
    for name in POSED:
        row = [name, f"{rms(found.errors.get(name, [])):.3f}"]
        for kind in ("last", "foot"):
            moved = found.angles.get((name, kind), [])
            said = rms(found.said.get((name, kind), []))
            row += [f"{rms(moved):.3f}", f"{worst(moved):.2f}"]
            row += [f"{said:.3f}", f"{rms(moved) / said:.2f}"]
        yield row


def channel_rows(found: Posed) -> Iterator[list[str]]:
    """How a channel repeats, and how shapes differ in it."""
    for index, name in enumerate(CHANNELS):
        moved = found.channels[name]
        sd = rms(list(np.concatenate(moved))) if moved else float("nan")
        between = float(np.std(np.array(found.spread[name]), axis=0).mean())
        yield [name, f"{sd:.3f}", f"{between:.3f}", f"{between / sd:.1f}", f"{DISTANCE.sd[index]}"]


def curve_rows(shapes: list[Shape], seed: int) -> Iterator[list[str]]:
    """The plan channel against the planted curvature, over the distance's stations."""
    rng = np.random.default_rng(seed + 2)
    for name in ("nothing", "noise 0.3 mm"):
        change = CHANGES.get(name, lambda v, f, _: (v, f))
        found = []
        for shape in shapes:
            profile = flare_profile(*change(shape.vertices, shape.faces, rng))
            s, step = profile.stations, 1e-3
            ahead, behind = (true_heading_deg(shape.spec, s + d) for d in (step, -step))
            truth = np.radians(ahead - behind) / (2.0 * step)
            inside = (s >= DISTANCE.stations[0]) & (s <= DISTANCE.stations[1])
            found.append(np.corrcoef(truth[inside], profile.curvature["plan"][inside])[0, 1])
        yield [name, f"{np.median(found):.4f}", f"{min(found):.3f}"]


def seconds(shapes: list[Shape]) -> tuple[float, float]:
    """One core's time of the profile and, in turn with it, of a weld: read the ratio."""
    from footfit.geometry.mesh.welding import welded_vertices

    times: tuple[list[float], list[float]] = ([], [])
    for shape in shapes[:6]:
        for into, work in zip(times, (flare_profile, welded_vertices), strict=True):
            start = time.process_time()
            work(shape.vertices, shape.faces)
            into.append(time.process_time() - start)
    return float(np.median(times[0])), float(np.median(times[1]))


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lasts", type=int, default=24)
    parser.add_argument("--feet", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    shapes = {"last": lasts(options.lasts, options.seed), "foot": feet(options.feet)}
    found = posed_runs(shapes, options.seed)
    own, weld = seconds(shapes["last"])
    move = ["lasts RMS", "lasts worst", "feet RMS", "feet worst"]
    posed_head = ["lasts: RMS error"]
    for kind in ("lasts", "feet"):
        posed_head += [
            f"{kind} moved RMS",
            f"{kind} worst",
            f"{kind} predicted sd",
            "moved / predicted",
        ]
    text = "\n".join(
        [
            f"Seed {options.seed}, {len(shapes['last'])} lasts, {len(shapes['foot'])} feet.\n",
            "Flare angle in a given frame (degrees):\n",
            markdown(["changed", *move], list(angle_rows(shapes, options.seed))),
            f"Whole pipeline in random poses (degrees); {found.refused} refused:\n",
            markdown(["changed", *posed_head], list(posed_rows(found))),
            "Feet of known bend, whole pipeline in random poses (degrees):\n",
            markdown(
                ["planted", "true change", "mean error", "RMS error", "worst error"],
                list(bend_rows(shapes["foot"], options.seed)),
            ),
            "Plan curvature against the planted one (correlation over the stations):\n",
            markdown(
                ["changed", "median", "worst"], list(curve_rows(shapes["last"], options.seed))
            ),
            "Channels, whole pipeline (curvature times length):\n",
            markdown(
                ["channel", "repeatability", "between shapes", "ratio", "sd in use"],
                list(channel_rows(found)),
            ),
            f"The profile of a last of {len(shapes['last'][0].faces)} faces takes "
            f"{own / weld:.1f} times as long as welding it ({1000 * own:.0f} ms of a core).\n",
        ]
    )
    print(text)
    if options.write:
        put("flare.md", "flare", text)


if __name__ == "__main__":
    main()
