"""Custom lasts of random pairs of a foot and a base, as a judge of its own sees them.

    python -m benchmarks.custom_lasts [--count 200] [--seed 7] [--write]

Bases are lasts of both families with heels of 0 to 80 mm. Feet are those at hand, changed so that
every target lies within 15 mm of the base, and so that ball line, flare and heel are near to what
the base keeps. The toes are the foot's own. ``tests/custom_judge.py`` reads the written file and
the JSON, and shares no code with the deformation. Once in ``SPARSE`` pairs the targets are the
base's own too, and the custom last is put into a catalogue with its base. ``--write`` puts the
table into docs/custom-lasts.md. ``--part 1/2`` does one half of the pairs, and ``--rows FILE``
keeps what was found of them; with several ``--read FILE`` the table is made of such files.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import textwrap
import time
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

import footfit
from benchmarks import stance
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError, OutOfReach
from footfit.geometry.deform.chart import chart_of, eased, eased_sum
from footfit.geometry.fit.foot_in_heel import SurfaceChange, foot_in_heel
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.last_making.base_last import BaseLast, scanned_base
from footfit.pipeline.last_making.custom.custom_aims import (
    ANYWHERE,
    CustomQuestion,
    custom_aims,
    fit_in,
)
from footfit.pipeline.last_making.custom.custom_making import Making, customised
from footfit.pipeline.last_making.custom.custom_reading import Carried, tape_plane
from footfit.results import CustomLast, Profiled
from tests import custom_judge
from tests.self_intersection import welded
from tools.last_specs import wide
from tools.lasts import last_mesh

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = (ROOT / "sample_data" / "feet", ROOT.parent / "shared" / "scans" / "makehuman")
WITHIN_MM = 15.0
LARGER_MM, SPREAD_MM = 7.0, 4.0
BALL_MM, FLARE_DEG, HEEL_MM = 6.0, (-7.0, 3.0), (-3.0, 4.0)
"""How far the base's ball line, flare and short heel girth are from their targets, at most."""
TURN_SHARE, HEIGHTS = 0.67, (-0.25, 0.25)
"""The flare angle changes by so much more than a plan is bent; the heel's height changes by at most
the others, as shares of it."""
HEELS_MM = (0.0, 80.0)
PROFILE = tomllib.loads(
    (ROOT / "footfit/pipeline/fit/profiles/walking.toml").read_text(encoding="utf-8")
)
STYLES = ("shoe", "pump", "boot", "sandal")
SPARSE = 10
Grid = tuple[int, int]
AT_30K, AT_35K = ((150, 100), (150, 84)), ((160, 110), (160, 110))
"""Rings and segments of both families: 25,200 to 30,000 faces, and about 35,000."""
LIMITS = {"widths": (1.0 / 1.25, 1.25), "heights": (1.0 / 1.4, 1.4)}
"""The stated limits of stretch, by which a refused pair is shown to be out of reach."""
KEPT = ("toes", "toe_height", "flare", "plan", "short_heel_girth")
"""Zones that what is kept sets: the toe, the flare, and bottom, back and top around the heel."""
GIRTHS = ("ball_girth_least", "waist_girth_least", "instep_girth_least")
BARS = {
    "refused, %": 5.0,
    "girths in their planes, mm": 0.5,
    "least girths by brute force, mm": 0.5,
    "length, mm": 0.3,
    "widths, mm": 0.5,
    "heel girth in its plane against the answer, mm": 0.5,
    "bottom heights, heel, spring, mm": 0.1,
    "top plane, mm": 0.1,
    "toe besides its shift, mm": 0.1,
    "back curve, mm": 0.6,
    "open edges, flipped faces, self-intersections": 0.0,
    "worst aspect over the base's": 2.0,
    "dihedral change, 99th percentile, deg": 2.0,
    "zones set by the foot, not good": 0.0,
    "equal targets move, mm": 0.01,
    "rank in its catalogue (1: first or tied)": 1.0,
    "time over an align, 35k faces": 8.0,
}


@dataclass(frozen=True)
class Pair:
    """A foot and a base whose targets lie near."""

    foot: Profiled
    base: BaseLast
    question: CustomQuestion


def question() -> CustomQuestion:
    """Walking, as a match asks."""
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.pipeline.fit.heel_model import heel_question
    from footfit.results.worn import BAREFOOT

    return CustomQuestion(fit_profile("walking"), heel_question(), BAREFOOT)


def base_of(rng: np.random.Generator, own: Grid, second: Grid) -> BaseLast:
    """A random last of one of the families, each with its grid of rings and segments."""
    heel_mm = float(rng.uniform(*HEELS_MM))
    if stance.second_family() and rng.random() < 0.5:
        case = stance.other(rng, (heel_mm, heel_mm + 0.1), 0, *second)
        mesh = case.vertices_mm, case.faces
    else:
        style = str(rng.choice(STYLES))
        length_mm = float(rng.uniform(240.0, 290.0))
        spec = wide(
            rng,
            style,
            (heel_mm, heel_mm + 0.1),
            length_mm=length_mm,
            rings=own[0],
            segments=own[1],
        )
        mesh = last_mesh(spec)
    from footfit.api.inputs import source_of
    from footfit.pipeline.batch.sources import ReadingOptions

    return scanned_base(source_of(mesh, {"units": "mm"}), ReadingOptions(units="mm", side="right"))


def foot_for(rng: np.random.Generator, scan: Profiled, base: BaseLast) -> Profiled:
    """A foot that asks for other measures than the base has, each by some random mm."""
    own = {row.name: row.measured.value or np.nan for row in scan.measures}
    larger_mm = rng.uniform(-LARGER_MM, LARGER_MM)

    def change(name: str, allowance_mm: float, more_mm: float, spread_mm: float) -> float:
        base_mm = base.record.value_of(name) or np.nan
        wanted_mm = base_mm - allowance_mm + more_mm + rng.uniform(-spread_mm, spread_mm)
        return float(wanted_mm / own[name] - 1.0)

    girths = {
        name.removesuffix("_least"): change(name, 0.5, larger_mm, SPREAD_MM) for name in GIRTHS
    }
    lengths = SurfaceChange(
        length=change("length", 13.0, 0.0, 2.0 * SPREAD_MM),
        heel_width=change("heel_width", 0.0, larger_mm / 3.0, 0.5 * SPREAD_MM),
        ball_width=change("ball_width", -2.0, larger_mm / 3.0, 0.5 * SPREAD_MM),
        **girths,
    )
    shape = scan.aligned.prepared.shape
    vertices_mm = foot_in_heel(Shape(shape.vertices_mm, shape.faces), lengths)
    vertices_mm = _nearer(rng, scan, base, Shape(vertices_mm, shape.faces))
    return footfit.flare((vertices_mm, shape.faces), units="mm", side="right")


def _nearer(rng: np.random.Generator, scan: Profiled, base: BaseLast, foot: Shape) -> Floats:
    """The vertices (n, 3) of a changed scan, with ball line, flare and heel nearer to the base's.

    The ball moves along the foot, the plan is bent between .30 and .55 of its length, and the heel
    becomes higher or lower behind .30.
    """
    zones = {zone.zone: zone for zone in fit_in(scan, base.record, base, question()).zones}
    off = {
        name: np.nan if zone.clearance.value is None else zone.clearance.value - zone.target
        for name, zone in zones.items()
    }
    x, y, z = foot.vertices_mm.T
    start_mm, length_mm = foot.x_mm(0.0), foot.length_mm
    place = (x - start_mm) / length_mm
    turn_deg = float(np.nan_to_num(off["flare"] - rng.uniform(*FLARE_DEG)))
    bend = 0.25 * length_mm * eased_sum((place - 0.30) / 0.25)
    y = y + np.tan(np.radians(TURN_SHARE * turn_deg)) * bend
    more_mm = _value_mm(base.shape, "ball_length") - _value_mm(foot, "ball_length")
    if np.isfinite(off["ball_line"]) and np.isfinite(more_mm):
        bump = np.cos(np.pi * np.clip((place - 0.72) / 0.56, -0.5, 0.5)) ** 2
        x = x + (more_mm - rng.uniform(-BALL_MM, BALL_MM)) * bump
    scanned_mm = {row.name: row.measured.value for row in scan.measures}["short_heel_girth"]
    wanted_mm = (scanned_mm or np.nan) + off["short_heel_girth"] - rng.uniform(*HEEL_MM)

    def raised(share: float) -> Floats:
        return np.column_stack([x, y, z * (1.0 + share * (1.0 - eased((place - 0.30) / 0.15)))])

    trials = (-0.05, 0.05)
    girths = [_value_mm(Shape(raised(t), foot.faces), "short_heel_girth") for t in trials]
    share = trials[0] + (wanted_mm - girths[0]) / (girths[1] - girths[0]) * np.ptp(trials)
    return raised(float(np.clip(np.nan_to_num(share), *HEIGHTS)))


def _value_mm(shape: Shape, measure: str) -> float:
    """A measure; NaN if the shape does not have it."""
    value = measure_named(measure).value_of(shape).value
    return np.nan if value is None else value


def pairs(rng: np.random.Generator, own: Grid, second: Grid) -> Iterator[Pair]:
    """Pairs without an end: every firm target lies within 15 mm of its base."""
    files = [file for folder in FOLDERS for file in sorted(folder.glob("*_R.stl"))]
    scans = [footfit.flare(str(file)) for file in files]
    asked = question()
    while True:
        try:
            base = base_of(rng, own, second)
            foot = foot_for(rng, scans[int(rng.integers(len(scans)))], base)
            aims = [aim for aim in custom_aims(foot, base, asked) if aim.firm]
        except FootfitError:
            continue
        if len(aims) == 6 and all(abs(aim.target - aim.base) <= WITHIN_MM for aim in aims):
            yield Pair(foot, base, asked)


def judged(pair: Pair, custom: CustomLast, *, full: bool) -> dict[str, float]:
    """What the judge says of a custom last, by the rows of the table."""
    data = footfit.mesh_file(custom, "stl")
    document = custom.to_dict()
    zones = {zone["name"]: zone for zone in document["zones"]}
    girths = custom_judge.girth_misses(data, document)
    heel = girths.pop("heel_girth_instep", 0.0)
    before, after = custom.base_vertices_mm, custom.vertices_mm
    changes = custom_judge.mesh_changes(before, after, custom.faces)
    kept = custom_judge.kept_moves(before, after, custom.faces, pair.base.shape.upright)
    again = footfit.measure(data, units="mm", side="right")
    up = again.alignment.canonical_transform[2, :3]
    least = custom_judge.least_misses(data, document, up)
    read = {row.name: row.measured.value or np.nan for row in again.measures}
    off = {name: abs(read[name] - zone["target"]) for name, zone in zones.items()}
    corners = welded(*custom_judge.stl_mesh(data))[1]
    rows = {
        "girths in their planes, mm": max(map(abs, girths.values())),
        "least girths by brute force, mm": max(map(abs, least.values())),
        "heel girth in its plane against the answer, mm": abs(heel),
        "length, mm": off["length"],
        "widths, mm": max(off["ball_width"], off["heel_width"]),
        "bottom heights, heel, spring, mm": max(
            kept[name] for name in ("bottom heights", "heel height", "toe spring")
        ),
        "top plane, mm": kept["top plane"],
        "toe besides its shift, mm": kept["toe"],
        "back curve, mm": kept["back curve"],
        "open edges, flipped faces, self-intersections": changes["flipped"]
        + changes["intersections"]
        + custom_judge.open_edges(corners),
        "worst aspect over the base's": changes["aspect"],
        "dihedral change, 99th percentile, deg": changes["dihedral_deg"],
        "zones set by the foot, not good": len(
            custom_judge.zones_not_good(data, document, PROFILE)
        ),
    }
    if full:
        rows["equal targets move, mm"] = _moved_by_equal_targets(pair)
        rows["rank in its catalogue (1: first or tied)"] = _rank(pair, custom, data)
    return rows


def _rank(pair: Pair, custom: CustomLast, data: bytes) -> float:
    """Where the written last stands in a catalogue with its base; 1 if it is first or tied."""
    base = pair.base.shape
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lasts.footfit"
        with footfit.open_catalogue(path) as catalogue:
            meshes: dict[str, Any] = {"custom": data, "base": (base.vertices_mm, base.faces)}
            for name, mesh in meshes.items():
                labels = replace(custom.record.labels, name=name)
                catalogue.ingest([mesh], labels=labels, units="mm", side="right")
            vertices_mm, faces = pair.foot.aligned.vertices_mm, pair.foot.aligned.faces
            match = catalogue.match((vertices_mm, faces), units="mm", side="right")
    ranked = match.candidates or match.nearest
    names = [each.last for each in ranked]
    tied = "custom" in getattr(ranked[0], "tied_with", ())
    return 1.0 if tied else float(names.index("custom") + 1) if "custom" in names else np.inf


def beyond_reach(pair: Pair) -> str | None:
    """Why a pair is out of reach by the stated limits alone; None if they do not show it.

    A girth is out of reach if it is not within those of its base's own section with all widths and
    heights scaled to their limits; at the ball, with its width scaled to the width's target.
    """
    shape, up = pair.base.shape, pair.base.shape.upright
    aims = {aim.measure: aim for aim in custom_aims(pair.foot, pair.base, pair.question)}
    width = aims["ball_width"].target / aims["ball_width"].base
    for name in GIRTHS:
        plane, aim = tape_plane(shape, name), aims[name]
        assert plane is not None
        widths = (width, width) if name == GIRTHS[0] else LIMITS["widths"]
        low, high = custom_judge.reachable_girths(
            *(shape.vertices_mm, shape.faces, plane.origin, plane.normal, up),
            *(widths, LIMITS["heights"]),
        )
        if not low <= aim.target <= high:
            words = f"{low:.1f} to {high:.1f} mm are within the limits, not {aim.target:.1f} mm"
            return f"the {aim.words}: {words}"
    return None


def _moved_by_equal_targets(pair: Pair) -> float:
    """How far the base moves if the foot asks for what it has."""
    from footfit.pipeline.last_making.custom.custom_field import custom_shape, first_field

    aims = tuple(
        replace(aim, target=aim.base, good_mm=ANYWHERE)
        for aim in custom_aims(pair.foot, pair.base, pair.question)
    )
    start = first_field(chart_of(pair.base.shape), 0.0, bottom_kept=False)
    carried = Carried(pair.base.shape, pair.base)
    moved = custom_shape(pair.base, aims, start, carried).vertices_mm
    return float(np.abs(moved - pair.base.shape.vertices_mm).max())


def timed(rng: np.random.Generator, count: int) -> tuple[float, float]:
    """The core time of a custom last over that of an align, at 35,000 faces: median and worst."""
    ratios = []
    for pair, _ in zip(pairs(rng, *AT_35K), range(count), strict=False):
        mesh = pair.base.shape.vertices_mm, pair.base.shape.faces
        start = time.process_time()
        footfit.align(mesh, units="mm")
        middle = time.process_time()
        try:
            customised(pair.foot, pair.base, Making(pair.question))
        except OutOfReach:
            continue
        ratios.append((time.process_time() - middle) / (middle - start))
    return float(np.median(ratios)), float(np.max(ratios))


def found(options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """What is found of each pair of this part: its rows, or why it was refused."""
    rng = np.random.default_rng(options.seed)
    part, parts = (int(each) for each in options.part.split("/"))
    for number, pair in zip(range(options.count), pairs(rng, *AT_30K), strict=False):
        if number % parts != part - 1:
            continue
        try:
            custom = customised(pair.foot, pair.base, Making(pair.question))
        except OutOfReach as error:
            yield {"pair": number, "refused": error.message, "shown": beyond_reach(pair)}
            continue
        rows = judged(pair, custom, full=number // parts % SPARSE == 0)
        whys = {zone.name: zone.why for zone in custom.judged if zone.why is not None}
        suits = {zone.base_verdict for zone in custom.judged if zone.name in KEPT} <= {None, "good"}
        yield {"pair": number, "rows": rows, "not good": whys, "suits": suits}


def table(pairs_found: Sequence[dict[str, Any]], ratio: tuple[float, float]) -> str:
    """The table of all pairs, and what is said below it."""
    refused = [each for each in pairs_found if "refused" in each]
    rows = [each["rows"] for each in pairs_found if "rows" in each]
    cells = [["refused, %", f"{100.0 * len(refused) / len(pairs_found):.1f}", "", "5"]]
    for name in BARS:
        values = np.array([row[name] for row in rows if name in row])
        if len(values):
            high = f"{np.percentile(values, 95):.3g}"
            cells.append([name, f"{values.max():.3g}", high, f"{BARS[name]:g}"])
    cells.append(
        ["time over an align, 35k faces", f"{ratio[1]:.1f}", f"median {ratio[0]:.1f}", "8"]
    )
    done = [each for each in pairs_found if "rows" in each]
    zones = Counter(name for each in done for name in each["not good"])
    free = sum(count for name, count in zones.items() if name not in KEPT)
    cells.append(["other zones that are not good", f"{free}", "", "0"])
    good, suiting = (
        [each for each in done if not each["not good"]],
        [e for e in done if e["suits"]],
    )
    of_these = sum(not each["not good"] for each in suiting)
    shown = sum(each["shown"] is not None for each in refused)
    names = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in zones.most_common())
    bent = sum(row["dihedral change, 99th percentile, deg"] > 2.0 for row in rows)
    words = f"{len(pairs_found)} pairs; {len(refused)} refused, {shown} of them shown to be beyond"
    words += f" the limits. {bent} exceed the dihedral bar. In {len(suiting)} the base's kept zones"
    words += f" (toes, toe height, flare, plan, short heel girth) are good: all zones of {of_these}"
    words += f" of these custom lasts are good, and of {len(good)} of all. Not good: {names}."
    words = textwrap.fill(words, 118)
    return f"{markdown(['what', 'worst', '95 % within', 'bar'], cells)}\n{words}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--rows", type=Path)
    parser.add_argument("--read", type=Path, action="append", default=[])
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    kept = [json.loads(line) for file in options.read for line in file.read_text().splitlines()]
    for each in found(options) if not options.read else ():
        kept.append(each)
        line = json.dumps(each, default=float)
        print(line, flush=True)
        if options.rows is not None:
            with options.rows.open("a", encoding="utf-8") as file:
                file.write(f"{line}\n")
    if options.part == "1/1":
        ratio = timed(np.random.default_rng(options.seed + 1), max(3, options.count // 10))
        text = table(kept, ratio)
        print(text)
        if options.write:
            put("custom-lasts.md", "custom", text)


if __name__ == "__main__":
    main()
