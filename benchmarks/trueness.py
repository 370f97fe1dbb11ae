"""How true each measure is: its errors against what is known of a shape, by family and heel.

    python -m benchmarks.trueness [--count 6] [--seed 11] [--write]

Shapes are lasts of ``tools.last_specs.wide``, and, where they stand beside the project, lasts of
``../shared/tools/lasts2.py`` and generated feet of ``../shared/scans``. The truth is read by brute
force on a fine mesh in its drafted pose (``tests/measure_peer.py`` shares no code with footfit);
the heel height is the planted one. A coarser mesh of the same shape goes the whole way from a scan,
in a random pose: clean, with 0.3 mm of white noise, with 0.3 mm of ripple, or decimated, in turn.
``--write`` puts the tables into docs/measures.md.
"""

from __future__ import annotations

import argparse
import csv
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchmarks import measures, stance
from benchmarks.alignment import scan_of
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError
from footfit.geometry.measures.measure_table import of_kind
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.scan.measure import scan_measures
from footfit.pipeline.scan.trueness import TRUENESS
from footfit.results import Measured
from tests.measure_peer import Drafted, true_measures
from tests.reading import read_scan
from tests.scans import aligned
from tools.last_specs import HEEL_BANDS_MM, STYLES, wide
from tools.lasts import last_mesh, standing

FINE = {"rings": 170, "segments": 120}
FINE_OTHER = {"n_long": 170, "n_round": 104}
STATED = ("stated trueness", "stated bias", "total")


@dataclass(frozen=True)
class Case:
    """A shape of a family and a band of heels: its scan's mesh, its side, and its draft."""

    family: str
    band: str
    mesh: tuple[Floats, Ints]
    side: str
    draft: Drafted


@dataclass(frozen=True)
class Error:
    """How far a value is from the true one, and its ``total_sd`` with and without trueness; mm."""

    error: float
    other_sd: float
    total_sd: float


Errors = dict[tuple[str, str, str], list[Error]]
"""By measure, family and band."""


def on_plan_axis(vertices: Floats, faces: Ints) -> Floats:
    """A shape turned in plan until its longest direction below .15 of the length is x."""
    vertices = vertices - [vertices[:, 0].min(), 0.0, vertices[:, 2].min()]
    corners = vertices[faces]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    middle = corners.mean(axis=1)
    low_mm = 0.30 * np.ptp(vertices[:, 0])
    low = middle[:, 2] < 0.15 * np.ptp(vertices[vertices[:, 2] < low_mm, 0])
    plan = middle[low, :2] - np.average(middle[low, :2], axis=0, weights=area[low])
    axis = np.linalg.eigh(plan.T @ (plan * area[low, None]))[1][:, 1]
    axis = axis * np.sign(axis[0])
    turn = np.array([[axis[0], -axis[1], 0.0], [axis[1], axis[0], 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(vertices @ turn)


def own(rng: np.random.Generator, band: tuple[float, float], number: int) -> Case:
    """A last of the project's generator."""
    spec = replace(wide(rng, STYLES[number % 4], band), side="right", rings=100, segments=72)
    drafted = standing(spec)
    x, z = drafted.middle_mm.T
    place = (x - x[0]) / np.ptp(x)
    seat = (place >= 0.06) & (place <= 0.14)
    heel_mm = float(np.polyfit(x[seat] - x[0], z[seat] - z.min(), 1)[1])
    vertices, faces = last_mesh(replace(spec, **FINE))
    vertices = on_plan_axis(vertices, faces)
    pitch = np.radians(drafted.pitch_deg)
    planted = {
        "heel_height": heel_mm,
        "toe_spring_tip": drafted.tip_mm,
        "bottom_length": drafted.bottom_length_mm,
    }
    draft = Drafted(vertices, faces, "last", float(pitch), planted)
    return Case("own", band_words(band), last_mesh(spec), "right", draft)


def other(rng: np.random.Generator, band: tuple[float, float], _: int) -> Case:
    """A last of the second family."""
    import lasts2

    spec = stance.other_spec(rng, band)
    fine = lasts2.mesh(spec, **FINE_OTHER)
    vertices, faces = stance.at_rest(fine)
    drafted = np.array(fine.vertices)
    away = vertices - vertices.mean(axis=0)
    turn = np.linalg.lstsq(drafted - drafted.mean(axis=0), away, rcond=None)[0]
    pitch = float(np.arctan2(turn[0, 2], turn[0, 0]))
    vertices = on_plan_axis(vertices, faces)
    planted = {"heel_height": spec.heel_height, "toe_spring_tip": spec.toe_spring}
    draft = Drafted(vertices, faces, "last", pitch, planted)
    mesh = stance.at_rest(lasts2.mesh(spec, n_long=150, n_round=84))
    return Case("lasts2", band_words(band), mesh, "right", draft)


def feet() -> Iterator[Case]:
    """The generated feet at hand, as right ones."""
    table = measures.SCANS / "makehuman" / "truth.csv"
    for row in csv.DictReader(table.open()) if table.exists() else ():
        scan = read_scan(table.parent / row["file"])
        vertices, faces = scan.vertices_mm, scan.faces
        if row["side"] == "L":
            vertices, faces = vertices * (1.0, -1.0, 1.0), faces[:, ::-1]
        draft = Drafted(on_plan_axis(vertices, faces), faces, "foot", 0.0, {})
        yield Case("feet", "", (vertices, faces), "right", draft)


def band_words(band: tuple[float, float]) -> str:
    """A band of heels as a table has it."""
    return f"{band[0]:.0f}-{band[1]:.0f}"


def cases(count: int, seed: int) -> Iterator[Case]:
    """``count`` lasts for each family and band, and up to three times as many feet."""
    draws = {"own": own} | ({"lasts2": other} if stance.second_family() else {})
    for draw in draws.values():
        rng = np.random.default_rng(seed)
        for band in HEEL_BANDS_MM:
            for number in range(count):
                yield draw(rng, band, number)
    yield from list(feet())[: 3 * count]


def values(case: Case, change: str, rng: np.random.Generator) -> dict[str, Measured]:
    """The measures of a changed scan of a case, by name."""
    made = measures.Case(case.family, case.draft.kind, case.side, *case.mesh, {})
    scan = aligned(scan_of(*measures.changed(made, change, rng)), side=case.side)
    return {row.name: row.measured for row in scan_measures(scan.prepared)}


def errors(count: int, seed: int) -> tuple[Errors, list[str]]:
    """Every error, and what was refused."""
    taken: Errors = defaultdict(list)
    refused = []
    rng = np.random.default_rng(seed)
    for number, case in enumerate(cases(count, seed)):
        change = measures.CHANGES[number % len(measures.CHANGES)]
        try:
            read = values(case, change, rng)
        except FootfitError as error:
            refused.append(f"{case.family} {case.band}: {error.code}")
            continue
        for name, true_mm in true_measures(case.draft).items():
            known = read.get(name, Measured(None))
            if known.value is not None and known.total_sd is not None:
                trueness = TRUENESS[case.draft.kind][name].sd
                other_sd = np.sqrt(known.total_sd**2 - trueness**2)
                off = Error(known.value - true_mm, float(other_sd), known.total_sd)
                taken[name, case.family, case.band].append(off)
    return taken, refused


def rms(numbers: list[float]) -> float:
    """The root of the mean square."""
    return float(np.sqrt(np.mean(np.square(numbers))))


def trueness_rows(taken: Errors, kind: str) -> Iterator[list[str]]:
    """A row a measure: bias and RMS error by family, and what the measures should then state."""
    families = ("feet",) if kind == "foot" else ("own", "lasts2")
    for entry in of_kind(kind):
        groups = {
            family: [e for key, es in taken.items() if key[:2] == (entry.name, family) for e in es]
            for family in families
        }
        known = {family: group for family, group in groups.items() if group}
        if not known:
            continue
        cells = []
        for family in families:
            off = [e.error for e in groups[family]]
            cells += [f"{np.mean(off):+.2f}", f"{rms(off):.2f}"] if off else ["", ""]
        mse = np.mean([rms([e.error for e in group]) ** 2 for group in known.values()])
        bias = np.mean([np.mean([e.error for e in group]) for group in known.values()])
        other = np.mean([e.other_sd**2 for group in known.values() for e in group])
        measured = [f"{np.sqrt(max(mse - other, 0.0)):.2f}", f"{bias:+.2f}"]
        stated = TRUENESS[kind][entry.name]
        total = rms([e.total_sd for group in known.values() for e in group])
        stated_words = [f"{stated.sd:.2f}", f"{stated.bias:+.2f}", f"{total:.2f}"]
        yield [entry.name, *cells, f"{np.sqrt(other):.2f}", *measured, *stated_words]


def coverage_rows(taken: Errors, kind: str) -> Iterator[list[str]]:
    """A row a measure: by family and band the share within 2 total_sd, and mean total over RMS."""
    groups = sorted({key[1:] for key in taken if (key[1] == "feet") == (kind == "foot")})
    for entry in of_kind(kind):
        cells = []
        for group in groups:
            known = taken.get((entry.name, *group), [])
            if not known:
                cells.append("")
                continue
            inside = np.mean([abs(e.error) <= 2.0 * e.total_sd for e in known])
            ratio = np.mean([e.total_sd for e in known]) / rms([e.error for e in known])
            cells.append(f"{100 * inside:.0f} %, {ratio:.1f}")
        if any(cells):
            yield [entry.name, *cells]


def tables(taken: Errors) -> dict[str, str]:
    """The tables of docs/measures.md by name."""
    made = {}
    for kind in ("last", "foot"):
        families = ("feet",) if kind == "foot" else ("own", "lasts2")
        heads = [f"{family}: {word}" for family in families for word in ("bias", "RMS")]
        heads = ["measure", *heads, "other", "trueness", "bias", *STATED]
        made[f"trueness-{kind}"] = markdown(heads, list(trueness_rows(taken, kind)))
        groups = sorted({key[1:] for key in taken if (key[1] == "feet") == (kind == "foot")})
        heads = ["measure", *(" ".join(group).strip() for group in groups)]
        made[f"coverage-{kind}"] = markdown(heads, list(coverage_rows(taken, kind)))
    return made


def main() -> None:
    """Print the tables, or write them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=6)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    taken, refused = errors(options.count, options.seed)
    for name, text in tables(taken).items():
        print(f"{name}\n{text}")
        if options.write:
            put("measures.md", name, text)
    print("refused:", "; ".join(refused) or "none")


if __name__ == "__main__":
    main()
