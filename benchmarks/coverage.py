"""How right and how fast is the coverage of a population?

    python -m benchmarks.coverage [--write] [--only NAME]

``closed-form`` draws 10^6 women's feet from a bivariate normal of length and ball girth and asks
which of them have a last, in runs of lasts whose share is known in closed form. ``growth`` runs the
command on 10^3 and 10^4 feet against a catalogue of 10^3 lasts, in a process of its own each, and
``check-lasts`` runs on catalogues of 10^3 and 10^4 lasts. ``--write`` puts the tables into
docs/coverage.md.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.stats import norm, qmc

from benchmarks.tables import markdown, put
from footfit.catalogue.store import open_catalogue
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.population.cover import served_by_any
from footfit.pipeline.population.judging import Asking, judged_feet
from footfit.pipeline.population.shape_columns import MeasureColumn, ShapeColumns
from footfit.pipeline.population.tables import FootTable, LastTable
from footfit.results import FitProfile, LastRecord, Measure, Measured, ZoneRule
from footfit.results.heel import AS_SCANNED
from footfit.results.worn import BAREFOOT

ROOT = Path(__file__).resolve().parents[1]
SURVEY = ROOT.parent / "shared" / "population" / "ansur2_female.csv"
MEAN_MM, SD_MM, R = (246.3, 228.1), (12.4, 11.8), 0.606
SIZE_MM, GIRTH_MM, WIDTH_MM = 8.467, 6.5, 4.0
DRAWS = 1_000_000
FINE = 4
"""So many lasts in each size, so that their girths follow the feet's mean without steps."""
SATRA = {"sizes 1-11 in D": 24.5, "sizes 5-7 in C-E": 47.0}
LASTS, FEET = 1_000, (1_000, 10_000)
CHECKED = (1_000, 10_000)
CHECK_FAILED = 7
MEMORY = Path("/dev/shm")
"""A disk in memory: a last is stored with a durable commit, which is not what is measured here."""


def draws(*, even: bool, seed: int = 1, base2: int = 20) -> FootTable:
    """Women's feet, drawn: independently, or evenly spread (a scrambled Sobol sequence)."""
    if even:
        z = norm.ppf(qmc.Sobol(2, seed=seed).random_base2(base2)).T
    else:
        z = np.random.default_rng(seed).normal(size=(2, DRAWS))
    length = MEAN_MM[0] + SD_MM[0] * z[0]
    girth = MEAN_MM[1] + SD_MM[1] * (R * z[0] + np.sqrt(1.0 - R * R) * z[1])
    nobody = ("",) * len(length)
    return FootTable(nobody, (None,) * len(length), columns(length=length, ball_girth=girth))


def columns(**values: Floats) -> ShapeColumns:
    """Shapes with these measures and nothing else."""
    count = len(values["length"])
    nothing, zero = np.full(count, np.nan), np.zeros(count)
    code = np.zeros(count, dtype=np.int64)
    return ShapeColumns(
        extent_mm=values["length"],
        measures={name: MeasureColumn(value, zero, code) for name, value in values.items()},
        flare_deg=nothing,
        flare_sd_deg=zero,
        plan=np.empty((count, 0)),
        heel_mm=nothing,
        gain_mm=zero,
        gain_sd_mm=zero,
    )


def boxes(half_mm: dict[str, float]) -> Asking:
    """A profile that asks only that a foot is in the box of a last."""
    rules = tuple(
        ZoneRule(zone, 0.0, (-half, half), (-half, half), (-half, half), 1.0, True, 0.0)
        for zone, half in half_mm.items()
    )
    return Asking(FitProfile("boxes", 1, "", 1.0, rules, ""), AS_SCANNED, BAREFOOT)


def run_of(sizes: Sequence[int], measure: str, mean: Floats, fine: int) -> LastTable:
    """A run of lasts: the middle of each size, or ``fine`` places in it, at a mean measure."""
    first, last = MEAN_MM[0] + SIZE_MM * (sizes[0] - 6.5), MEAN_MM[0] + SIZE_MM * (sizes[-1] - 5.5)
    edges = np.linspace(first, last, fine * len(sizes) + 1)
    length = 0.5 * (edges[1:] + edges[:-1])
    values = {measure: mean[0] + mean[1] * (length - MEAN_MM[0])}
    return table_of(columns(length=length, **values))


def share_served(feet: FootTable, lasts: LastTable, asking: Asking) -> float:
    """The share of the feet with an acceptable last, in percent."""
    judged = judged_feet(feet, lasts, asking)
    return 100.0 * float(served_by_any(judged.served[1], len(feet)).mean())


def closed_form(sizes: Sequence[int], half_mm: float, fine: int) -> float:
    """The share of a bivariate normal in the boxes of a run, in percent.

    With endlessly many places in a size (``fine`` 0) the girth follows the mean of each length.
    """
    slope = R * SD_MM[1] / SD_MM[0]
    rest = SD_MM[1] * np.sqrt(1.0 - R * R)
    first, last = (
        SIZE_MM * (size - 6.0 + end) for size, end in ((sizes[0], -0.5), (sizes[-1], 0.5))
    )
    if not fine:
        along = norm.cdf(last / SD_MM[0]) - norm.cdf(first / SD_MM[0])
        return float(100.0 * along * (2.0 * norm.cdf(half_mm / rest) - 1.0))
    edges = np.linspace(first, last, fine * len(sizes) + 1)

    def density(x: float, middle: float) -> float:
        off = slope * (x - middle)
        inside = norm.cdf((half_mm - off) / rest) - norm.cdf((-half_mm - off) / rest)
        return float(norm.pdf(x / SD_MM[0]) / SD_MM[0] * inside)

    cells = pairwise(edges)
    return 100.0 * sum(quad(density, a, b, args=(0.5 * (a + b),))[0] for a, b in cells)


def closed_form_rows() -> Iterator[list[str]]:
    """Runs of sizes and widths: the closed form, what footfit says, and SATRA's figure."""
    feet = [draws(even=False), draws(even=True)]
    slope = np.array([MEAN_MM[1], R * SD_MM[1] / SD_MM[0]])
    runs = (("sizes 1-11 in D", range(1, 12), 1), ("sizes 5-7 in C-E", range(5, 8), 3))
    for (name, sizes, widths), fine in ((run, fine) for run in runs for fine in (1, FINE)):
        half = 0.5 * widths * GIRTH_MM
        lasts = run_of(list(sizes), "ball_girth", slope, fine)
        asking = boxes({"length": 0.5 * SIZE_MM / fine + 1e-3, "ball_girth": half})
        said = [share_served(each, lasts, asking) for each in feet]
        known = closed_form(list(sizes), half, fine if fine == 1 else 0)
        error = 100.0 * np.sqrt(known / 100.0 * (1.0 - known / 100.0) / DRAWS)
        kind = "one last a size" if fine == 1 else "girth follows the length"
        yield [
            name, kind, f"{known:.2f} %", f"{said[0]:.2f} % ({said[0] - known:+.2f} ± {error:.2f})",
            f"{said[1]:.2f} % ({said[1] - known:+.2f})",
            f"{SATRA[name]:.1f} % ({said[1] - SATRA[name]:+.1f})",
        ]  # fmt: skip


def width_rows() -> Iterator[list[str]]:
    """The surveyed women in one to four widths of 4 mm of ball width around their mean."""
    if not SURVEY.is_file():
        return
    people = list(csv.DictReader(SURVEY.open()))
    names = ("footlength", "footbreadthhorizontal")
    length, width = (np.array([float(row[name]) for row in people]) for name in names)
    slope, start = np.polyfit(length, width, 1)
    shapes = columns(length=length, ball_width=width)
    feet = FootTable(("",) * len(length), (None,) * len(length), shapes)
    made = np.arange(length.min(), length.max() + 1.0)  # the survey is in whole mm
    lasts = table_of(columns(length=made, ball_width=start + slope * made))
    off = np.abs(width - start - slope * length)
    for widths in (1, 2, 3, 4):
        half = 0.5 * widths * WIDTH_MM
        said = share_served(feet, lasts, boxes({"length": 0.5, "ball_width": half}))
        normal = 100.0 * (2.0 * norm.cdf(half / np.std(width - start - slope * length)) - 1.0)
        counted = 100.0 * np.mean(off <= half)
        yield [str(widths), f"{said:.1f} %", f"{counted:.1f} %", f"{normal:.1f} %"]


def table_of(shapes: ShapeColumns) -> LastTable:
    """Lasts with these shapes, without heels and sides."""
    names = tuple(f"{place:05d}" for place in range(len(shapes)))
    every = np.ones(len(shapes), dtype=bool)
    return LastTable(names, shapes, np.full(len(shapes), np.nan), {None: every})


# ---------------------------------------------------------------- growth


def write_feet(path: Path, count: int, seed: int = 1) -> Path:
    """A CSV of feet with five measures."""
    rng = np.random.default_rng(seed)
    z = 0.6 * rng.normal(size=(count, 1)) + 0.8 * rng.normal(size=(count, 5))
    rows = np.array((246.3, 228.1, 92.7, 57.0, 228.0)) + z * np.array((12.4, 11.8, 4.8, 4.0, 12.0))
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("id", "length", "ball_girth", "ball_width", "heel_width", "instep_girth"))
        writer.writerows((f"p{i}", *(f"{v:.1f}" for v in row)) for i, row in enumerate(rows))
    return path


def write_lasts(path: Path, base: Path, count: int, seed: int = 1) -> Path:
    """A catalogue of so many lasts: those of ``base`` with other sizes and widths."""
    rng = np.random.default_rng(seed)
    with open_catalogue(base) as stored:
        records = stored.lasts().records
        sections = [stored.sections(record.labels.name) for record in records]
    with open_catalogue(path, write=True) as catalogue:
        for number in range(count):
            at = number % len(records)
            catalogue.add(_variant(records[at], number, rng), None, sections[at])
    return path


def _variant(record: LastRecord, number: int, rng: np.random.Generator) -> LastRecord:
    """Another last: longer or shorter, wider or narrower."""
    longer, wider = rng.uniform(0.86, 1.10), rng.uniform(0.92, 1.08)

    def factor(row: Measure) -> float:
        along = "length" in row.name or "tread" in row.name
        return longer if along else wider if row.unit == "mm" else 1.0

    rows = (replace(row, measured=_scaled(row.measured, factor(row))) for row in record.measures)
    return replace(
        record,
        labels=replace(record.labels, name=f"last-{number:05d}", **_labels(number)),
        info=replace(record.info, sha256=hashlib.sha256(str(number).encode()).hexdigest()),
        extent_mm=record.extent_mm * longer,
        measures=tuple(rows),
    )


def _labels(number: int) -> dict[str, str | None]:
    """A family of thirty lasts: ten sizes in three widths."""
    place = number % 30
    size, width = str(36 + place % 10), "EFG"[place // 10]
    family = f"family-{number // 30:04d}"
    return {"family": family, "size": size, "width_label": width, "parent": None}


def _scaled(measured: Measured, factor: float) -> Measured:
    value = measured.value
    return measured if value is None else replace(measured, value=value * factor)


def timed(*command: object) -> tuple[float, float]:
    """The processor seconds of a command, and its most memory in MB."""
    words = [sys.executable, "-m", "footfit", *map(str, command)]
    nothing = subprocess.DEVNULL
    process = subprocess.Popen(words, stdout=nothing, stderr=nothing, cwd=ROOT)
    _, status, usage = os.wait4(process.pid, 0)
    assert os.waitstatus_to_exitcode(status) in (0, CHECK_FAILED), words
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0


def best_of(runs: int, *command: object) -> tuple[float, float]:
    """The least processor seconds of some runs, and the most memory in MB."""
    taken = [timed(*command) for _ in range(runs)]
    return min(seconds for seconds, _ in taken), max(mb for _, mb in taken)


def growth_rows(folder: Path, lasts: Path, runs: int = 3) -> Iterator[list[str]]:
    """10^3 and 10^4 feet against 10^3 lasts."""
    first = 0.0
    for count in FEET:
        feet = write_feet(folder / f"feet-{count}.csv", count)
        seconds, mb = best_of(runs, "coverage", feet, "--catalogue", lasts, "--quiet", "--json")
        first = first or seconds
        yield [f"{count:,}", f"{LASTS:,}", f"{seconds:.1f}", f"{seconds / first:.1f}", f"{mb:.0f}"]


def check_rows(folder: Path, base: Path, runs: int = 2) -> Iterator[list[str]]:
    """``check-lasts`` on 10^3 and 10^4 lasts."""
    first = 0.0
    for count in CHECKED:
        lasts = write_lasts(folder / f"lasts-{count}", base, count)
        seconds, mb = best_of(runs, "check-lasts", "--catalogue", lasts, "--quiet", "--json")
        first = first or seconds
        yield [f"{count:,}", f"{seconds:.1f}", f"{seconds / first:.1f}", f"{mb:.0f}"]


def main() -> None:
    """Print the tables, or write them."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    tables: dict[str, str] = {}
    if options.only in ("", "closed-form"):
        draws_head = ("10^6 independent draws", "2^20 even draws")
        head = ["run", "lasts", "closed form", *draws_head, "SATRA"]
        tables["coverage-closed-form"] = markdown(head, list(closed_form_rows()))
        head = ["widths of 4 mm", "footfit", "counted", "as a normal"]
        tables["coverage-widths"] = markdown(head, list(width_rows()))
    if options.only in ("", "growth"):
        with tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as name:
            folder = Path(name)
            timed("demo", folder / "demo")
            lasts = write_lasts(folder / "lasts", folder / "demo" / "demo.footfit", LASTS)
            head = ["feet", "lasts", "processor seconds", "times the first", "memory, MB"]
            tables["coverage-growth"] = markdown(head, list(growth_rows(folder, lasts)))
    if options.only in ("", "check-lasts"):
        with tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as name:
            folder = Path(name)
            timed("demo", folder / "demo")
            head = ["lasts", "processor seconds", "times the first", "memory, MB"]
            lines = list(check_rows(folder, folder / "demo" / "demo.footfit"))
            tables["check-lasts-growth"] = markdown(head, lines)
    for name, text in tables.items():
        print(text)
        if options.write:
            put("coverage.md", name, text)


if __name__ == "__main__":
    main()
