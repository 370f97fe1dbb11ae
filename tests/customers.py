"""Customers made by code, and whether what footfit says of one of them agrees with itself.

A customer is a foot or a pair, warped from the sample feet. `contradictions` runs the commands on
it as a shop would. It holds each printed output against its result (`tests.readback`), and the
results of the commands against each other: one length, one toe room, one clearance of each measure.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from footfit.cli.answer_forms import form_of
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.write import encoded_mesh
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import Comparison, FootFit, Match, MeasuredScan
from tests import readers
from tests.conftest import SAMPLES, Footfit
from tests.distortions import mirrored, moved, random_pose
from tests.readback import (
    CSV,
    PAGE,
    TERMINAL,
    clearance_text,
    comparison_facts,
    match_facts,
    plain,
    problems,
    signed,
)
from tests.readback_sheet import SHEET, read_sheet, sheet_facts
from tests.readback_tables import align_facts, measured_facts
from tests.reading import read_scan
from tests.scans import aligned, right_shape
from tools.last_specs import LastSpec
from tools.lasts import last_mesh

FEET = ("mh007_L.stl", "mh007_R.stl", "mh008_R.stl")
PROFILES = ("walking", "dress", "sport", "walking", "safety")
ORDER = ("good", "acceptable", "poor", "reject")
WIDE = 400
SPECS = {
    "made-40": LastSpec(length_mm=266.0, ball_width_mm=92.0, heel_height_mm=20.0, fullness=1.08),
    "made-42": LastSpec(length_mm=279.5, ball_width_mm=97.0, heel_height_mm=60.0),
    "made-38": LastSpec(length_mm=252.5, ball_width_mm=90.0, heel_height_mm=0.0, flare_deg=12.0),
}
"""Generated lasts beside the sample lasts; one has a heel that the model is unproven at."""


@dataclass(frozen=True)
class Customer:
    """The files of one customer's feet, and the options that are asked for."""

    feet: tuple[Path, ...]
    options: tuple[str, ...]
    known_length: str | None = None

    @property
    def pair(self) -> tuple[str, ...]:
        """The option that makes two feet one customer."""
        return ("--pair",) * (len(self.feet) == 2)

    @property
    def scale(self) -> tuple[str, ...]:
        """How long the foot is, if that is typed."""
        return () if self.known_length is None else ("--known-length", self.known_length)


@dataclass
class Printed:
    """The verdict that each printed clearance of a zone had so far, over all customers."""

    verdicts: dict[tuple[str, str, str], str] = field(default_factory=dict)

    def problems(self, profile: str, fits: tuple[FootFit, ...]) -> Iterator[str]:
        """Where an equal number has another verdict. A reject is a poor that is sure."""
        for zone in (zone for fit in fits for zone in fit.zones if zone.verdict is not None):
            verdict = "poor" if zone.verdict == "reject" else zone.verdict
            key = (profile, zone.zone, clearance_text(zone))
            if self.verdicts.setdefault(key, verdict) != verdict:
                yield f"{key} is {verdict} and {self.verdicts[key]}"


@cache
def right_foot(name: str) -> tuple[Floats, Ints]:
    """A sample foot as a right shape, canonical mm."""
    return right_shape(aligned(read_scan(SAMPLES / "feet" / name)))


def write_customer(number: int, folder: Path) -> Customer:
    """The scans of one customer, in any pose; every third is one foot."""
    rng = np.random.default_rng(1000 + number)
    sides = ("left", "right") if number % 3 else (("left", "right")[number % 2],)
    scale = rng.uniform([0.92, 0.93, 0.93], [1.08, 1.06, 1.06])
    base = right_foot(FEET[number % len(FEET)])
    paths = []
    for side in sides:
        own = scale * (1.0 + rng.normal(0.0, [0.004, 0.01, 0.01]))
        vertices, faces = base[0] * own, base[1]
        if side == "left":
            vertices, faces = mirrored(vertices, faces)
        path = folder / f"customer{number}-{side}.stl"
        path.write_bytes(encoded_mesh(moved(vertices, random_pose(rng)), faces, "stl"))
        paths.append(path)
    options = ("--profile", PROFILES[number % len(PROFILES)])
    options += ("--size-system", "uk") if number % 4 == 1 else ()
    options += ("--as-scanned",) if number % 7 == 2 else ()
    options += ("--clearance",) if number % 5 == 3 else ()
    typed = f"{float(np.ptp(base[0][:, 0]) * scale[0]):.0f}" if number % 6 == 0 else None
    return Customer(tuple(paths), options, typed)


def write_lasts(folder: Path) -> Path:
    """The generated lasts and their manifest."""
    rows = ["path,name,style,size,size_system,heel_height_mm"]
    for name, spec in SPECS.items():
        vertices, faces = last_mesh(spec)
        (folder / f"{name}.stl").write_bytes(encoded_mesh(vertices, faces, "stl"))
        rows.append(f"{name}.stl,{name},made,{name[-2:]},eu,{spec.heel_height_mm:g}")
    manifest = folder / "made.csv"
    manifest.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return manifest


def contradictions(
    customer: Customer,
    footfit: Footfit,
    told: list[Any],
    catalogue: Path,
    folder: Path,
    seen: Printed,
) -> Iterator[str]:
    """Everything in which the outputs about one customer differ; ``told`` gets each result."""
    at = ("--catalogue", catalogue)

    def results(*command: object) -> tuple[Any, list[Any]]:
        told.clear()
        run = footfit(*command)
        assert run.code == 0, run.err
        return run, list(told)

    page, sheet, rows = (folder / name for name in ("page.html", "sheet.html", "rows.csv"))
    words = (*customer.feet, *customer.pair, *customer.scale)
    written = ("--html", page, "--sheet", sheet, "--csv", rows, "--force")
    run, shown = results("match", *words, *customer.options, *at, *written)
    (match,) = (value for value in shown if isinstance(value, Match))
    rooms = [value for value in shown if isinstance(value, Comparison)]
    facts = list(match_facts(match, rooms))
    yield from problems(PAGE, readers.read_match_page(page.read_text("utf-8")), facts)
    yield from problems(CSV, readers.read_match_csv(rows.read_text("utf-8")), facts)
    text = wide_text(match, run.out)
    yield from problems(TERMINAL, readers.read_match_terminal(text), facts)
    reading = read_sheet(sheet.read_text("utf-8"))
    document, day = match.to_dict(), reading.cells["head"]
    yield from problems(SHEET, reading, sheet_facts(document, *_sheet_heads(reading), day))
    yield from match_problems(match, text, rows, customer.known_length)
    for candidate in match.candidates:
        yield from seen.problems(match.profile, candidate.fits)

    _, taken = results("measure", *customer.feet, *customer.scale, "--csv", rows, "--force")
    facts = [known for scan in taken for known in measured_facts(scan)]
    cells = readers.read_keyed_csv(rows.read_text("utf-8"), "path", "measure")
    yield from problems(CSV, cells, facts)
    yield from same_measures(match, taken)
    for foot, path in zip(match.feet, customer.feet, strict=True):
        run, (found,) = results("align", path, *customer.scale)
        facts = list(align_facts(found.alignment))
        text = wide_text(found, run.out)
        yield from problems(TERMINAL, readers.read_terms(text), facts)
        if found.alignment.length_mm != foot.length_mm:
            yield f"align: {found.alignment.length_mm} mm, match: {foot.length_mm} mm"
    best = (match.candidates or match.nearest)[0]
    heel = [word for word in customer.options if word == "--as-scanned"]
    for number, path in enumerate(customer.feet):
        asked = ("compare", path, best.last, *customer.scale, *heel, *at)
        run, (*_, known) = results(*asked, "--csv", rows, "--force")
        facts = list(comparison_facts(known))
        cells = readers.read_keyed_csv(rows.read_text("utf-8"), "part", "place", "quantity")
        text = wide_text(known, run.out)
        yield from problems(TERMINAL, readers.read_compare_terminal(text), facts)
        yield from problems(CSV, cells, facts)
        yield from comparison_problems(match, number, known)
        if rooms and rooms[number].zones != known.zones:
            yield f"the clearance of {path.name} on the page is not that of compare"


def wide_text(value: Any, printed: str) -> str:
    """What a command printed, in a terminal that is wide enough for every line."""
    table = form_of(value).table
    assert printed == terminal_text(table(value))
    return terminal_text(table(value), WIDE)


def _sheet_heads(reading: Any) -> tuple[str, str]:
    """The title of a sheet, and its customer: nobody gave one."""
    return reading.cells["title"], ""


def match_problems(match: Match, text: str, rows: Path, known_length: str | None) -> Iterator[str]:
    """Where an answer contradicts itself: order, verdicts, sizes, lengths, sentences."""
    verdicts = [ORDER.index(candidate.verdict or "") for candidate in match.candidates]
    if verdicts != sorted(verdicts):
        yield f"the verdicts are not in order: {verdicts}"
    if match.candidates and match.best_verdict not in (None, match.candidates[0].verdict):
        yield f"the best verdict is {match.best_verdict}, the first {match.candidates[0].verdict}"
    longest = max(foot.length_mm or 0.0 for foot in match.feet)
    if known_length is not None and plain(longest) != f"{known_length}.0":
        yield f"{known_length} was typed, and the foot is {plain(longest)} mm long"
    table = list(csv.DictReader(rows.read_text("utf-8").splitlines()))
    sizes = {row["customer_size"] for row in table}
    if len(sizes) != 1 or next(iter(sizes)) not in text:
        yield f"more than one size: {sizes}"
    if {row["path"] for row in table} != {foot.aligned.alignment.info.path for foot in match.feet}:
        yield "a foot has no row in the CSV"
    for candidate in match.candidates or match.nearest:
        zones = [zone for fit in candidate.fits for zone in fit.zones]
        (room,) = (zone for zone in zones if zone.zone == "length" and zone.counts)
        value = room.clearance.value
        if match.candidates and value is not None and value >= 0.0:
            said = plain(value, max(room.digits, 1))
            if not candidate.why.startswith(f"{said} mm toe room"):
                yield f"the toe room is {said} mm, and the sentence is {candidate.why!r}"
        for zone in zones:
            if zone.counts == (zone.not_counted is not None):
                yield f"{zone.zone} counts and does not count"
    if re.search(r"[-+]0\.0+ (mm|deg|%)", text.replace("+0.0", "0.0")):
        yield "a negative zero is printed"


def same_measures(match: Match, taken: list[MeasuredScan]) -> Iterator[str]:
    """Where ``measure`` and ``match`` measured another value."""
    for foot, scan in zip(match.feet, taken, strict=True):
        ours = {row.name: row.measured for row in foot.measures}
        theirs = {row.name: row.measured for row in scan.measures}
        for name in ours.keys() & theirs.keys():
            if ours[name].value != theirs[name].value:
                yield f"{name}: {ours[name].value} in match, {theirs[name].value} in measure"
        if scan.alignment.length_mm != foot.length_mm:
            yield f"length: {foot.length_mm} in match, {scan.alignment.length_mm} in measure"


def comparison_problems(match: Match, number: int, known: Comparison) -> Iterator[str]:
    """Where ``compare`` says another number than ``match`` of the foot in the best last."""
    best = (match.candidates or match.nearest)[0]
    zones = {zone.zone: zone for zone in best.fits[number].zones}
    named = {"length": known.toe_room, **dict(known.measured_clearance)}
    for name, measured in named.items():
        zone = zones.get(name)
        if zone is not None and zone.clearance.to_dict() != measured.to_dict():
            yield f"{name}: {zone.clearance} in match, {measured} in compare"
    if signed(zones["flare"].clearance.value) != signed(known.flare_delta_deg):
        yield f"flare: {zones['flare'].clearance.value} in match, {known.flare_delta_deg}"
    if known.foot.length_mm != match.feet[number].length_mm:
        yield f"length: {match.feet[number].length_mm} in match, {known.foot.length_mm} in compare"


def recorder(told: list[Any], function: Callable[..., Any]) -> Callable[..., Any]:
    """A function that also puts its first argument into ``told``."""

    def recorded(value: Any, *more: Any, **named: Any) -> Any:
        told.append(value)
        return function(value, *more, **named)

    return recorded


def result_recorder(told: list[Any], function: Callable[..., Any]) -> Callable[..., Any]:
    """A function that also puts its result into ``told``."""

    def recorded(*given: Any, **named: Any) -> Any:
        result = function(*given, **named)
        told.append(result)
        return result

    return recorded
