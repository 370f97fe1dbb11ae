"""What a result says, as one list of facts: each a name, its values, and the outputs that show it.

`problems` compares the list with what a reader of ``readers.py`` found in an output. It wants every
number and word of a fact there, in order, with no other number between them; it wants every fact
of that output, and nothing with a number in it that is no fact. Words around them are free.

A new number of an output is a new line in one of the ``..._facts``, and where the output is new a
reader for it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from footfit import __version__
from footfit.geometry.fit.clearance import ZoneClearance
from footfit.geometry.fit.sizes import foot_size, foot_sizes, system_named
from footfit.geometry.flare.definition import FlareProfile
from footfit.pipeline.fit.zones import ZONES
from footfit.results import (
    Candidate,
    Comparison,
    FootFit,
    HeelChange,
    Match,
    Measured,
    Profiled,
    SurfaceClearance,
    ZoneFit,
)

PAGE, CSV, TERMINAL = "page", "csv", "terminal"
MARKS = {"good": "●", "acceptable": "▲", "poor": "■", "reject": "✕", None: "–"}
"""The shape that stands for a verdict, for whom the colours say nothing."""

UNKNOWN_HEEL = "the heel of the last is not known"

OTHER_FOOT = "shown on the last of the other foot"

SAID = "said"
"""Begins the name of a fact that stands somewhere in a sentence of its own."""

ZONE_ENDS = dict.fromkeys(ZONES, "_mm") | {"ball_line": "_percent", "flare": "_deg", "plan": ""}
FIT_NAMES = ("length", "ball_width", "ball_girth", "heel_width", "instep_girth")
SYSTEMS = ("eu", "uk", "us-men", "us-women", "mondopoint")
_NUMBER = re.compile(r"[+-]?\d")
_SQUARE = re.compile(r"(?<=[cm]m)2\b")
"""The digit of cm2, which is no number."""


@dataclass(frozen=True)
class Fact:
    """``values`` are texts as they must stand; of a CSV cell the one text is the whole cell."""

    what: str
    values: tuple[str, ...]
    where: frozenset[str]


@dataclass
class Reading:
    """What a reader found: cells by name, and the sentences that belong to no cell."""

    cells: dict[str, str] = field(default_factory=dict)
    said: list[str] = field(default_factory=list)


def fact(what: str, values: object, *where: str) -> Fact:
    """A fact; None among its values is left out."""
    listed = values if isinstance(values, list | tuple) else [values]
    texts = tuple(str(value) for value in listed if value is not None)
    return Fact(what, texts, frozenset(where))


def problems(output: str, reading: Reading, facts: Iterable[Fact]) -> list[str]:
    """Where an output and the result that it shows differ; nothing where they agree."""
    cells, said = dict(reading.cells), list(reading.said)
    found = []
    for known in facts:
        if output not in known.where:
            continue
        if known.what.startswith(SAID):
            sentence = next((text for text in said if holds(text, known.values)), None)
            if sentence is None:
                found.append(f"{known.what}: nowhere are {known.values}, but {said}")
            else:
                said.remove(sentence)
        elif known.what not in cells:
            found.append(f"{known.what}: not there, {known.values} expected")
        else:
            text = cells.pop(known.what)
            same = (text,) == known.values if output == CSV else holds(text, known.values)
            if not same:
                found.append(f"{known.what}: {text!r} shows not {known.values}")
    found += [f"{what}: {text!r} is no fact" for what, text in cells.items()]
    return found + [f"{text!r} is no fact" for text in said if _NUMBER.search(text)]


def holds(text: str, values: Sequence[str]) -> bool:
    """Whether ``text`` shows these values in this order, and no number besides."""
    text, place = _SQUARE.sub("²", text), 0
    for value in values:
        at = text.find(value, place)
        while at > 0 and _NUMBER.match(value) and text[at - 1] in "+-.0123456789":
            at = text.find(value, at + 1)
        if at < 0 or _NUMBER.search(text[place:at]):
            return False
        place = at + len(value)
        if _NUMBER.match(value) and re.match(r"[.,]?\d", text[place:]):
            return False
    return not _NUMBER.search(text[place:])


# ------------------------------------------------------------------ numbers as they are shown


def signed(value: float | None, digits: int = 1, kept: int = 3) -> str:
    """With a sign, also where it is +0.0."""
    text = plain(value, digits, kept)
    return text if text.startswith("-") else f"+{text}"


def plain(value: float | None, digits: int = 1, kept: int = 3) -> str:
    """Without a plus: the number with ``kept`` decimals that a document has, rounded half up."""
    if value is None:
        return "-"
    document, step = round(abs(float(value)) * 10**kept), 10 ** (kept - digits)
    units = (document + step // 2) // step
    sign = "-" if value < 0 and units else ""
    return f"{sign}{units // 10**digits}" + (f".{units % 10**digits:0{digits}d}" if digits else "")


def csv_number(value: float | None, digits: int) -> str:
    """The shortest text of the rounded number."""
    return "" if value is None or not np.isfinite(value) else str(_rounded(value, digits))


def _rounded(value: float, digits: int) -> float:
    return round(float(value), digits) + 0.0


def mm(value: float | None) -> str:
    """A length in a CSV."""
    return csv_number(value, 3)


# ------------------------------------------------------------------ a match


def match_facts(match: Match, comparisons: Sequence[Comparison] = ()) -> Iterator[Fact]:
    """Everything that the page, the terminal and the CSV of a match show."""
    files = [_file(foot) for foot in match.feet]
    profile = match.profile if match.by == "fit" else None
    lead = [*files, match.catalogue_lasts, match.by, profile, __version__]
    yield fact("lead", lead, PAGE)
    if match.customer:
        yield fact("customer", match.customer, PAGE)
    left_out = [
        text
        for why, count in match.rejected
        for text in (count, why.replace("_", " ") if why.startswith("too") else None)
    ]
    yield fact(f"{SAID} left out", left_out or ["No last was left out"], PAGE)
    searched = [len(match.candidates), match.catalogue_lasts, match.by, profile, *left_out]
    yield fact(f"{SAID} searched", searched, TERMINAL)
    if match.candidates and match.by == "fit":
        yield fact(f"{SAID} scale", ["distance", 0, 1], TERMINAL)
    elif match.candidates:
        yield fact(f"{SAID} scale", ["distance", 0], TERMINAL)
    for number, notice in enumerate(match.warnings, 1):
        yield fact(f"note {number}", notice.message, PAGE)
    for number, foot in enumerate(match.feet, 1):
        yield from foot_facts(match, foot, f"foot {number}")
    yield from size_facts(match)
    if len(match.feet) > 1 and not any("differ" in known.code for known in match.warnings):
        lengths = [foot.length_mm for foot in match.feet]
        yield fact(f"{SAID} pair", plain(abs(lengths[0] - lengths[1])), PAGE)
    yield from best_facts(match, comparisons)
    shown = match.candidates or match.nearest
    judged = any(candidate.verdict for candidate in shown)
    for candidate in shown:
        yield from candidate_facts(candidate, judged=judged)
    yield from zone_facts(shown, best=match.candidates[:1])
    for number, foot in enumerate(match.feet):
        for candidate in match.candidates:
            yield from match_csv_facts(match, candidate, number, foot)
        if not match.candidates:
            yield from empty_csv_facts(match, number, foot)
    yield from judged_facts(files, shown, comparisons)
    names = [candidate.last for candidate in shown[:3]]
    for name in files:
        yield fact(f"{SAID} under the flare of {name}", [name, *names], PAGE)
    yield fact("reference", match.reference, *([PAGE] * bool(match.reference)))
    yield fact("definition", match.feet[0].flare.definition.version, PAGE)
    for number, comparison in enumerate(comparisons, 1):
        yield from room_facts(comparison, f"room {number}", area=len(comparisons) == 1, where=PAGE)
        known = [_file(comparison.foot), comparison.last.labels.name]
        yield fact(f"{SAID} under the room", known, PAGE)
        yield fact(f"{SAID} under the sections", known, PAGE)
    if comparisons:
        yield fact(f"{SAID} room in", comparisons[0].last.labels.name, PAGE)
        yield fact(f"{SAID} usual red", ["2", "4"], PAGE)


def judged_facts(
    files: Sequence[str], shown: Sequence[Candidate], comparisons: Sequence[Comparison]
) -> Iterator[Fact]:
    """What is said of the zones beside their numbers, and of a surface that is far too tight."""
    judged = [candidate for candidate in shown if candidate.fits]
    if shown and shown[0].fits:
        yield fact(f"{SAID} judged in", shown[0].last, PAGE)
        for file, _ in zip(files, shown[0].fits, strict=False):
            yield fact(f"{SAID} under the judged zones", [file, shown[0].last], PAGE)
    lacking: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for candidate in judged:
        reasons: dict[str, dict[str, None]] = {}
        for zone in (zone for fit in candidate.fits for zone in fit.zones):
            if zone.clearance.value is None:
                names = reasons.setdefault(zone.clearance.reason or "not measured", {})
                names[zone_name(zone)] = None
        for reason, known in reasons.items():
            lacking.setdefault((reason, tuple(known)), []).append(candidate.last)
    for (reason, names), lasts in lacking.items():
        yield fact(f"{SAID} not judged", [*lasts, *names, reason], PAGE)
    for comparison in comparisons:
        side = comparison.foot.aligned.alignment.side.side
        fits = shown[0].fits if shown else ()
        zones = next((fit.zones for fit in fits if fit.side == side), ())
        for surface in comparison.zones:
            if surface.pressed_cm2 > 20.0:
                yield fact(f"{SAID} pressed", _pressed(surface, side, zones), PAGE)


def _pressed(surface: ZoneClearance, side: str | None, zones: Sequence[ZoneFit]) -> list[object]:
    around = {
        "medial": ("ball_girth", "ball_width"),
        "lateral": ("ball_girth", "ball_width"),
        "dorsal": ("ball_girth", "waist_girth", "instep_girth"),
        "toe": ("length", "toes", "toe_height"),
    }.get(surface.zone, ())
    judged = [zone for zone in zones if zone.zone in around and zone.verdict is not None]
    tight = [zone for zone in judged if zone.verdict != "good" and (zone.score or 0.0) < 0.0]
    said: list[object] = [side, plain(surface.pressed_cm2, 0), "5 mm"]
    for zone in tight or judged:
        said += [zone_name(zone), clearance_text(zone), zone.verdict]
    return said


def zone_name(zone: ZoneFit) -> str:
    """A zone as the page and the terminal call it."""
    return zone.label or zone.zone.replace("_", " ")


def tightest_values(
    surfaces: Sequence[tuple[str | None, Sequence[ZoneClearance]]], fits: Sequence[FootFit]
) -> list[object]:
    """The tightest place: a zone of which a tenth is tight, or a toe 2 mm through its wall."""
    places: list[tuple[float, list[object]]] = []
    for side, zones in surfaces:
        for zone in zones:
            tight = zone.p05_mm is not None and zone.tight_cm2 > 0.1 * zone.area_cm2
            if zone.zone != "bottom" and tight:
                said = [
                    PLACES[zone.zone].removesuffix(" the foot"),
                    side,
                    plain(-zone.p05_mm),
                    plain(zone.tight_cm2, 0),
                ]
                places.append((zone.p05_mm, said))
    for fit in fits:
        for toe in () if fit.toe_box is None else fit.toe_box.toes:
            value = toe.clearance.value
            if value is not None and value < -2.0:
                places.append((value, [toe.toe, fit.side, plain(-value), toe.wall]))
    return min(places, key=lambda place: place[0])[1] if places else ["where tight", "2"]


def foot_facts(match: Match, foot: Profiled, name: str) -> Iterator[Fact]:
    """A foot's card on the page, and its two lines in a terminal."""
    alignment, flare = foot.aligned.alignment, foot.flare
    side, pose = alignment.side, alignment.pose
    is_last = match.by == "shape" and pose.kind == "last"
    word, turn = side.side or "undecided", turn_values(flare)
    yield fact(f"{name} title", ["last" if is_last else "foot", _file(foot)], PAGE)
    sure = "given" if side.source == "given" else side.confidence
    yield fact(f"{name} side", [word, sure], PAGE)
    yield fact(f"{name} flare", [*turn, flare.flare_class], PAGE)
    yield fact(f"{name} scan", [f"{alignment.info.faces:,}", alignment.info.units], PAGE)
    line = [_file(foot), word, "last" if is_last else "foot", plain(foot.length_mm), *turn]
    yield fact(f"{SAID} of {name}", [*line, flare.flare_class], TERMINAL)
    if match.widths and not is_last:
        yield from width_facts(match, foot, name)
    taken = {row.name: row.measured for row in foot.measures}
    for measure in {"length": Measured(foot.length_mm)} | taken:
        measured = taken.get(measure, Measured(foot.length_mm))
        if measured.value is not None:
            yield fact(f"{name} {measure.replace('_', ' ')}", measured_values(measured), PAGE)
    lacking = {row: known.reason for row, known in taken.items() if known.value is None}
    if lacking:
        said = [text for row, why in lacking.items() for text in (_title(row), why)]
        yield fact(f"{name} lacking", said, PAGE)
    for number, notice in enumerate(alignment.warnings, 1):
        yield fact(f"{name} note {number}", notice.message, PAGE)


def size_facts(match: Match) -> Iterator[Fact]:
    """The one size of a customer, beside the foot that it is taken from: the longest."""
    longest = max(foot.length_mm for foot in match.feet)
    system = system_named(match.size_system)
    words = {size.system: size.words for size in foot_sizes(longest)}
    shown = [words[known] for known in SYSTEMS if system is None or known != system.name]
    if match.by == "shape" and match.feet[0].aligned.alignment.pose.kind == "last":
        return
    asked = []
    if system is not None:
        size = foot_size(longest, system)
        asked = [size.words, *size.beside]
    for number, foot in enumerate(match.feet, 1):
        if foot.length_mm == longest:
            yield fact(f"foot {number} sizes", [*asked, *shown], PAGE)
    yield fact(f"{SAID} size", asked or shown, TERMINAL)


def width_facts(match: Match, foot: Profiled, name: str) -> Iterator[Fact]:
    """The width at the customer's size in each system that has one, and the shares of people."""
    width = match.widths[match.feet.index(foot)]
    longest = max(each.length_mm for each in match.feet)
    sizes = {size.system: size.words for size in foot_sizes(longest)}
    at_size = [text for known in width.fittings for text in (sizes[known.system], known.width)]
    yield fact(f"{name} width", at_size, PAGE)
    shares = []
    for share in width.shares:
        if share.percent is None:
            continue
        percent = min(max(10 * int(round(share.percent, 6) / 10 + 0.5), 5), 95)
        shares += [percent if percent >= 50 else 100 - percent, share.people]
    shares += dict.fromkeys(share.reason for share in width.shares if share.percent is None)
    yield fact(f"{name} among people", shares, PAGE)
    yield fact(f"{SAID} width of {name}", [*at_size, *shares], TERMINAL)


def best_facts(match: Match, comparisons: Sequence[Comparison]) -> Iterator[Fact]:
    """The headline: the first candidate, or that nothing fits."""
    if not match.candidates:
        yield fact("best last", "No last fits.", PAGE)
        yield fact("best", "No last fits.", PAGE)
        yield fact(f"{SAID} that nothing fits", "No last fits.", TERMINAL)
        return
    best = match.candidates[0]
    yield fact("best last", best.last, PAGE)
    verdict = [MARKS[best.verdict], best.verdict] if best.verdict else []
    surfaces = [(each.foot.aligned.alignment.side.side, each.zones) for each in comparisons]
    tight = tightest_values(surfaces, best.fits) if comparisons else []
    said = [*verdict, best.last, *_labels(best), best.why, *tight, *_ties(best, named=3)]
    yield fact("best", said, PAGE)


def candidate_facts(candidate: Candidate, *, judged: bool) -> Iterator[Fact]:
    """A last's row, and in a terminal the sentence under it."""
    name, both = f"last {candidate.rank}", (PAGE, TERMINAL)
    room = dict(candidate.clearance_mm).get("length", Measured(None))
    yield fact(f"{name} rank", candidate.rank, *both)
    yield fact(f"{name} name", [candidate.last, *_labels(candidate)], PAGE)
    yield fact(f"{name} name", candidate.last, TERMINAL)
    yield fact(f"{name} labels", ", ".join(_labels(candidate)[:2]) or "-", TERMINAL)
    if judged:
        verdict = candidate.verdict
        mark = [MARKS[verdict], verdict] if verdict else ["not judged"]
        yield fact(f"{name} verdict", mark, PAGE)
        yield fact(f"{name} verdict", verdict or "-", TERMINAL)
    spread = None if room.sd is None else plain(room.sd)
    yield fact(f"{name} room", [_room(candidate, room), spread], PAGE)
    yield fact(f"{name} room", _room(candidate, room), TERMINAL)
    yield fact(f"{name} flare", signed(candidate.flare.delta_deg), *both)
    yield fact(f"{name} distance", plain(candidate.distance, 2, 6), *both)
    yield fact(f"{name} why", [candidate.why, *_ties(candidate, named=1)], PAGE)
    mirrored = OTHER_FOOT if candidate.mirrored else None
    sentence = [candidate.why, mirrored, *_ties(candidate, named=3)]
    yield fact(f"{name} why", sentence, TERMINAL)
    if candidate.surfaces:
        surfaces = [(room_there.side, room_there.zones) for room_there in candidate.surfaces]
        yield fact(f"{name} surface 1", tightest_values(surfaces, candidate.fits), TERMINAL)
    for number, room_there in enumerate(candidate.surfaces, 1):
        side = room_there.side if len(candidate.surfaces) > 1 else None
        words = [side, *_surface(room_there)]
        yield fact(f"{name} surface {number}", words, PAGE)
        yield fact(f"{name} surface {number + 1}", words, TERMINAL)


def _room(candidate: Candidate, room: Measured) -> str:
    """The toe room with the decimals that its verdict needs."""
    zones = [zone for fit in candidate.fits for zone in fit.zones]
    digits = [zone.digits for zone in zones if zone.zone == "length" and zone.counts]
    return signed(room.value, digits[0] if digits else 1)


def zone_facts(shown: Sequence[Candidate], best: Sequence[Candidate]) -> Iterator[Fact]:
    """The zones of every last shown on the page; of the best one in a terminal."""
    judged = [candidate for candidate in shown if candidate.fits]
    for index, zone in enumerate(judged[0].fits[0].zones if judged else ()):
        same = " (0 = the same)" if zone.unit == "ratio" else ""
        name = f"zone {zone.label or zone.zone.replace('_', ' ')}{same}"
        yield fact(f"{name} asked", signed(zone.target), PAGE)
        for candidate in judged:
            feet = [fit.zones[index] for fit in candidate.fits]
            yield fact(f"{name} {candidate.last}", _page_zones(feet), PAGE)
        if not (best and best[0].fits):
            continue
        feet = [fit.zones[index] for fit in best[0].fits]
        yield fact(f"{name} asked", signed(zone.target), TERMINAL)
        for number, foot in enumerate(feet, 1):
            yield fact(f"{name} foot {number}", clearance_text(foot), TERMINAL)
        yield fact(f"{name} verdict", _worst(feet), TERMINAL)
    if best and best[0].fits:
        yield fact(f"{SAID} zones of", best[0].last, TERMINAL)


def match_csv_facts(
    match: Match, candidate: Candidate, number: int, foot: Profiled
) -> Iterator[Fact]:
    """One row of the CSV: this last for this foot, with the foot's own zones."""
    fit = candidate.fits[number] if candidate.fits else None
    clearances = dict(candidate.clearance_mm)
    if fit is not None:
        clearances = {row.zone: row.clearance for row in fit.zones if row.unit == "mm"}
    cells: dict[str, object] = {
        "path": foot.aligned.alignment.info.path,
        "customer": match.customer,
        "foot_side": foot.aligned.alignment.side.side,
        "by": match.by,
        "rank": candidate.rank,
        "last": candidate.last,
        "style": candidate.style,
        "size": candidate.size,
        "size_system": candidate.size_system,
        "width_label": candidate.width_label,
        "side": candidate.side,
        "mirrored": str(candidate.mirrored).lower(),
        "distance": csv_number(candidate.distance, 6),
        "distance_sd": csv_number(candidate.distance_sd, 6),
        "flare_distance": csv_number(candidate.flare.distance, 6),
        "flare_delta_deg": csv_number(candidate.flare.delta_deg, 3),
        "foot_verdict": None if fit is None else fit.verdict,
        "verdict": candidate.verdict,
        "why": candidate.why,
        "size_asked": candidate.size_asked,
        "tied_with": " ".join(candidate.tied_with),
        "not_judged": " ".join(candidate.not_judged),
        "profile": match.profile,
        "profile_sha256": None if match.fit_profile is None else match.fit_profile.sha256,
    }
    for name in FIT_NAMES:
        measured = clearances.get(name, Measured(None))
        cells[f"clearance_{name}_mm"] = mm(measured.value)
        cells[f"clearance_{name}_sd_mm"] = mm(measured.sd)
        cells[f"clearance_{name}_total_sd_mm"] = mm(measured.total_sd)
    cells |= heel_cells(None if fit is None else fit.heel) | foot_cells(match, foot, "ranked")
    zones = {} if fit is None else {row.zone: row for row in fit.zones}
    for name, end in ZONE_ENDS.items():
        row = zones.get(name)
        known = Measured(None) if row is None else row.clearance
        if name not in FIT_NAMES:
            cells[f"clearance_{name}{end}"] = mm(known.value)
            cells[f"clearance_{name}_sd{end}"] = mm(known.sd)
            cells[f"clearance_{name}_total_sd{end}"] = mm(known.total_sd)
        cells[f"verdict_{name}"] = None if row is None else row.verdict
        cells[f"not_counted_{name}"] = None if row is None else row.not_counted or known.reason
    for column, value in cells.items():
        text = "" if value is None else value
        yield fact(f"foot {number + 1} last {candidate.rank} {column}", text, CSV)


def foot_cells(match: Match, foot: Profiled, status: str) -> dict[str, object]:
    """What every row of a foot says of it."""
    system = system_named(match.size_system) or system_named("eu")
    longest = max(each.length_mm for each in match.feet)
    return {
        "status": status,
        "foot_length_mm": mm(foot.length_mm),
        "foot_size": foot_size(foot.length_mm, system).words,
        "customer_size": foot_size(longest, system).words,
        "error": None,
        "customer": match.customer,
    }


def empty_csv_facts(match: Match, number: int, foot: Profiled) -> Iterator[Fact]:
    """The row of a foot that no last fits."""
    cells: dict[str, object] = {
        "path": foot.aligned.alignment.info.path,
        "customer": match.customer,
        "foot_side": foot.aligned.alignment.side.side,
        "by": match.by,
        "profile": match.profile,
        "profile_sha256": None if match.fit_profile is None else match.fit_profile.sha256,
        **foot_cells(match, foot, "no_last_fits"),
    }
    for column in Match.columns:
        value = cells.get(column)
        if column == "why":
            counts = ", ".join(f"{n} {why}" for why, n in match.rejected) or "none"
            value = f"no last fits: left out are {counts}"
        yield fact(f"foot {number + 1} last  {column}", "" if value is None else value, CSV)


def heel_cells(heel: HeelChange | None) -> dict[str, object]:
    """What the heel of a last changes of a foot, as a row of a CSV."""
    changes = {} if heel is None else dict(heel.changes)
    cells: dict[str, object] = {
        "drop_mm": mm(None if heel is None else heel.drop_mm),
        "scanned_at_drop_mm": mm(None if heel is None else heel.scanned_at_drop_mm),
        "heel_model": None if heel is None else heel.model,
    }
    for name in FIT_NAMES:
        cells[f"heel_change_{name}_mm"] = mm(changes.get(name, Measured(None)).value)
    turn_deg = changes.get("flare_angle", Measured(None)).value
    return cells | {"heel_change_flare_deg": csv_number(turn_deg, 3)}


def _labels(candidate: Candidate) -> list[str]:
    system = candidate.size_system.upper() if candidate.size_system else None
    size = " ".join(part for part in (system, candidate.size, candidate.width_label) if part)
    size += f" ({candidate.size_asked})" if candidate.size_asked else ""
    side = f"{candidate.side} last" if candidate.mirrored else ""
    return [part for part in (candidate.style or "", size, side) if part]


def _ties(candidate: Candidate, named: int) -> list[object]:
    names: list[object] = list(candidate.tied_with[:named])
    more = len(candidate.tied_with) - named
    return [*names, more] if more > 0 else names


def _page_zones(feet: Sequence[ZoneFit]) -> list[str]:
    texts = []
    for zone in feet:
        if zone.clearance.value is None:
            texts.append(f"{MARKS[None]} (not judged) ({zone.clearance.reason})")
        elif not zone.counts:
            texts.append(f"({clearance_text(zone)})")
        else:
            place = [f"({zone.place})"] if zone.place else []
            texts += [clearance_text(zone), *place, f"{MARKS[zone.verdict]} ({zone.verdict})"]
    return texts


def clearance_text(zone: ZoneFit) -> str:
    """A clearance with the decimals that its verdict needs."""
    return signed(zone.clearance.value, max(zone.digits, 2 if zone.unit == "ratio" else 1))


def _worst(feet: Sequence[ZoneFit]) -> str:
    order = ["good", "acceptable", "poor", "reject"]
    verdicts = [zone.verdict for zone in feet if zone.counts and zone.verdict is not None]
    if verdicts:
        return max(verdicts, key=order.index)
    reasons = [zone.clearance.reason for zone in feet if zone.clearance.reason]
    return reasons[0] if reasons else "counts nothing"


PLACES = {
    "bottom": "under the foot",
    "medial": "on the inner side",
    "lateral": "on the outer side",
    "dorsal": "on top of the foot",
    "toe": "at the toes",
}


def _surface(room: SurfaceClearance) -> list[str]:
    """Where more than a tenth of a zone is tight, and where it is loose: the two largest each."""
    if room.reason is not None:
        return [room.reason]
    texts = []
    named = (("presses most", "tight_cm2", "p05_mm"), ("loosest", "loose_cm2", "p95_mm"))
    for word, area, edge in named:
        zones = [
            zone
            for zone in room.zones
            if getattr(zone, edge) is not None and getattr(zone, area) > 0.1 * zone.area_cm2
        ]
        zones.sort(key=lambda zone: -abs(getattr(zone, edge)))
        if zones:
            size = plain(abs(getattr(zones[0], edge)))
            texts += [word, PLACES[zones[0].zone], size, *(PLACES[z.zone] for z in zones[1:2])]
    return texts or ["nowhere tight", "2", "8"]


def measured_values(measured: Measured) -> list[str | None]:
    return [
        plain(measured.value),
        *(None if spread is None else plain(spread) for spread in (measured.sd, measured.total_sd)),
    ]


def turn_values(flare: FlareProfile) -> list[str]:
    spreads = flare.angle_sd_deg, flare.angle_total_sd_deg
    return [signed(flare.angle_deg), *(plain(spread) for spread in spreads)]


def _title(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _file(foot: Profiled) -> str:
    return re.split(r"[/\\]", foot.aligned.alignment.info.path)[-1]


# ------------------------------------------------------------------ one foot in one last


def comparison_facts(comparison: Comparison) -> Iterator[Fact]:
    """Everything that the page, the terminal and the CSV of a comparison show."""
    foot, last = comparison.foot.aligned.alignment, comparison.last
    delta = last.flare.angle_deg - comparison.foot.flare.angle_deg
    mirrored = OTHER_FOOT if comparison.mirrored else None
    lengths = [plain(foot.length_mm), plain(last.length_mm)]
    room, heel = comparison.toe_room, comparison.heel
    turn = {} if heel is None else dict(heel.changes)
    delta -= turn.get("flare_angle", Measured(0.0)).value
    spread = None if room.sd is None else plain(room.sd)
    known = [signed(room.value), spread] if room.value is not None else ["not known"]
    lengths += [*known, signed(delta)]
    names = [_file(comparison.foot), last.labels.name]
    side = foot.side.side
    yield fact("title", names, PAGE)
    yield fact("lead", [side, mirrored, *lengths], PAGE)
    yield fact(f"{SAID} title", [names[0], side, names[1], mirrored], TERMINAL)
    yield fact(f"{SAID} lengths", lengths, TERMINAL)
    yield from heel_facts(heel)
    numbers = [mm(room.value), mm(room.sd), mm(room.total_sd), room.reason or ""]
    yield from _compare_csv(comparison, ("whole", "length", "toe_room"), ["mm", "", "", *numbers])
    known_measures = []
    for name, clearance in comparison.measured_clearance:
        spreads = [mm(clearance.value), mm(clearance.sd), mm(clearance.total_sd)]
        cells = ["mm", "", "", *spreads, clearance.reason or ""]
        yield from _compare_csv(comparison, ("whole", name, "clearance"), cells)
        if clearance.value is not None:
            words = name.replace("_", " ")
            known_measures += [words, signed(clearance.value), plain(clearance.sd)]
    yield fact(
        f"{SAID} measures", ["last minus foot in mm", *(known_measures or ["none"])], TERMINAL, PAGE
    )
    if heel is not None:
        cells = [
            "mm",
            "",
            "",
            mm(heel.drop_mm),
            "",
            "",
            UNKNOWN_HEEL if heel.drop_mm is None else "",
        ]
        yield from _compare_csv(comparison, ("heel", "last", "drop"), cells)
        for name, change in heel.changes:
            unit = "deg" if name == "flare_angle" else "mm"
            cells = [unit, "", "", mm(change.value), mm(change.sd), mm(change.total_sd), ""]
            yield from _compare_csv(comparison, ("heel", name, "change"), cells)
    for number, notice in enumerate(comparison.warnings, 1):
        yield fact(f"note {number}", notice.message, PAGE)
    yield from room_facts(comparison, "room 1", area=True, where=PAGE)
    yield from room_facts(comparison, "room 1", area=True, where=TERMINAL)
    for picture in ("room", "sections", "flare"):
        yield fact(f"{SAID} under the {picture}", names, PAGE)
    for section in comparison.sections:
        name = f"section {section.station}"
        yield fact(f"{name} at", plain(section.x_mm, 0), PAGE, TERMINAL)
        for size in section.sizes:
            room = size.difference
            texts = ["-"] if room.value is None else [signed(room.value), plain(room.sd)]
            yield fact(f"{name} {size.name}", texts, PAGE, TERMINAL)
            numbers = [size.foot.value, size.last.value, room.value, room.sd, room.total_sd]
            cells = ["mm", *(mm(value) for value in numbers), room.reason or ""]
            yield from _compare_csv(comparison, ("section", section.station, size.name), cells)
    for zone in comparison.zones:
        lengths_there = {name: mm(getattr(zone, f"{name}_mm")) for name in ("mean", "p05", "p95")}
        names = ("area", "tight", "loose", "pressed")
        areas = {name: getattr(zone, f"{name}_cm2") for name in names}
        for name, text in lengths_there.items():
            cells = ["mm", "", "", text, "", "", ""]
            yield from _compare_csv(comparison, ("zone", zone.zone, name), cells)
        for name, value in areas.items():
            cells = ["cm2", "", "", csv_number(value, 1), "", "", ""]
            yield from _compare_csv(comparison, ("zone", zone.zone, name), cells)


def heel_facts(heel: HeelChange | None) -> Iterator[Fact]:
    """The sentence of what the heel changes; only for a change of 1 mm of length, or unproven."""
    changes = {} if heel is None else dict(heel.changes)
    length_mm = changes["length"].value if "length" in changes else 0.0
    if heel is None or heel.drop_mm is None:
        return
    if abs(length_mm) < 1.0 and not heel.unproven and not heel.length_only:
        return
    said: list[object] = [f"{heel.drop_mm:.0f}"]
    for name in ("length", "ball_girth", "flare_angle"):
        value = changes[name].value if name in changes else 0.0
        if abs(value) >= 0.5 and (name == "length" or not heel.length_only):
            said.append(plain(abs(value)))
    said += ["unproven model"] if heel.unproven else []
    said += ["only the length is judged"] if heel.length_only else []
    yield fact(f"{SAID} in the heel", said, PAGE, TERMINAL)


def _compare_csv(
    comparison: Comparison, key: tuple[str, str, str], cells: Sequence[str]
) -> Iterator[Fact]:
    columns = ("unit", "foot", "last_value", "difference", "sd", "total_sd", "reason")
    place = " ".join(key)
    path = comparison.foot.aligned.alignment.info.path
    yield fact(f"{place} path", path, CSV)
    yield fact(f"{place} last", comparison.last.labels.name, CSV)
    for column, text in zip(columns, cells, strict=True):
        yield fact(f"{place} {column}", text, CSV)


def room_facts(comparison: Comparison, name: str, *, area: bool, where: str) -> Iterator[Fact]:
    """The room by zone as a table; the area only where there is place for it."""
    swing, turn = comparison.placement.swing_mm, comparison.flare_delta_deg
    way = "inner side" if swing > 0 else "outer side"
    if plain(abs(turn)) != plain(0.0) and (swing > 0) == (turn < 0):
        way = f"turns {'less' if swing > 0 else 'more'} inward"
    yield fact(f"{SAID} swing of {name}", [way, plain(abs(swing))], where)
    for zone in comparison.zones:
        place = f"{name} {zone.zone}"
        known = zone.mean_mm is not None
        tight, loose = (plain(value, 0, 1) for value in (zone.tight_cm2, zone.loose_cm2))
        whole = plain(zone.area_cm2, 0, 1)
        yield fact(f"{place} mean", signed(zone.mean_mm), where)
        edges = [signed(zone.p05_mm), signed(zone.p95_mm)]
        if where == PAGE:
            yield fact(f"{place} from 5 to 95 %", edges if known else "-", where)
        else:
            yield fact(f"{place} 5 %", edges[0], where)
            yield fact(f"{place} 95 %", edges[1], where)
        yield fact(f"{place} tight", tight if known else "-", where)
        yield fact(f"{place} loose", loose if known else "-", where)
        if area:
            yield fact(f"{place} area", whole if known else "-", where)
