"""The page of one match: what a customer reads first, what a fitter checks, what prints on A4.

It names no outside address and no folder of the machine, and every name is escaped; see
``html_page`` for the policy that a browser holds it to.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from footfit import __version__
from footfit.geometry.fit.sizes import foot_sizes, system_named
from footfit.report.page.compare_page import (
    heat_picture,
    room_part,
    section_picture,
    wide_scene,
)
from footfit.report.page.page import (
    Cell,
    facts,
    light,
    page,
    picture,
    shape_of,
    table,
    text,
    together,
    warning,
)
from footfit.report.wording.comparison_words import surfaces_words
from footfit.report.wording.text import (
    SHOWN_SYSTEMS,
    file_name,
    is_scanned_last,
    measured_text,
    plain,
    signed,
    size_text,
    tie_words,
    visible,
)
from footfit.results.values import NOT_YET

if TYPE_CHECKING:
    from footfit.report.pictures.match_figure import Shapes
    from footfit.results import Candidate, Comparison, Match, Profiled, ZoneFit

HOW = {
    "fit": "Lasts whose length fits, each with its verdict. Good toe room comes before "
    "toe room that is only acceptable; then the better verdict comes first, then the nearer last.",
    "flare": "All lasts, nearest flare profile first. This search is scale-free: it compares "
    "shapes and cannot tell one size from another, so look at the length.",
    "shape": "All lasts, nearest in length and flare profile first: which last is this?",
}
UNITS = {"mm": " mm", "deg": "°", "percent": " %", "ratio": ""}
PAIR_NOTICES = {"pair_difference", "feet_differ_by_a_size"}
ONLY_FEW_FEET = 2
"""A customer has at most two feet; a pair's pictures stand side by side on paper."""


def match_report(
    match: Match, shapes: Shapes | None = None, comparisons: Sequence[Comparison] = ()
) -> str:
    """One customer's answer as a whole HTML page; the same bytes for the same match.

    Parameters
    ----------
    match : Match
    shapes : mapping of str to (vertices_mm, faces), optional
        The candidates' meshes by name, canonical mm, each on its own side; the flare plot draws
        the outlines of those that are there.
    comparisons : sequence of Comparison
        The feet in the best last, as ``pipeline.shapes.best_comparisons`` gives them; without any
        the page has no surface to show.
    """
    scene = wide_scene(comparisons)
    body = [
        "<h1>Which last fits?</h1>",
        f'<p class="lead">{text(_lead(match))}</p>',
        _best(match),
        *(warning(notice) for notice in match.warnings),
        _feet(match),
        _pair(match),
        *_lasts(match),
        *_surface(comparisons, scene),
        together(
            "Flare: the foot against the lasts",
            _side_by_side([_flare(match, index, shapes) for index in range(len(match.feet))]),
        ),
        _legend(match),
    ]
    return page(f"footfit: {_names(match)}", body, scene=bool(scene))


def _names(match: Match) -> str:
    return ", ".join(file_name(foot.aligned.alignment.info.path) for foot in match.feet)


def _lead(match: Match) -> str:
    noun = "last" if match.catalogue_lasts == 1 else "lasts"
    profile = f", fit profile {match.profile}" if match.by == "fit" else ""
    by = f"by {match.by}{profile}. footfit {__version__}"
    return f"{_names(match)} against {match.catalogue_lasts} {noun}, {by}"


def _best(match: Match) -> str:
    if not match.candidates:
        return '<div class="best poor"><p><b>No last fits.</b></p></div>'
    best = match.candidates[0]
    labels = _labels(best)
    aside = f" <span>{text(labels)}</span>" if labels else ""
    tie = f"<p>{text(tie_words(best.tied_with))}</p>" if best.tied_with else ""
    verdict = light(best.verdict) if best.verdict else ""
    return (
        f'<div class="best {best.verdict or ""}">{verdict}<p><b>{text(best.last)}</b>{aside}</p>'
        f"<p>{text(best.why)}.</p>{tie}</div>"
    )


def _labels(candidate: Candidate) -> str:
    size = size_text(candidate.size, candidate.size_system, candidate.width_label)
    side = f"{candidate.side} last, mirrored" if candidate.mirrored else ""
    return ", ".join(part for part in (candidate.style, size, side) if part)


def _side_by_side(figures: Sequence[str]) -> str:
    """Figures as they are; two of a pair share a row on paper."""
    if len(figures) < ONLY_FEW_FEET:
        return "".join(figures)
    return f'<div class="two">{"".join(figures)}</div>'


# ---------------------------------------------------------------- the feet


def _feet(match: Match) -> str:
    kind = "feet pair" if len(match.feet) > 1 else "feet"
    return f'<div class="{kind}">{"".join(_foot(match, foot) for foot in match.feet)}</div>'


def _foot(match: Match, foot: Profiled) -> str:
    alignment, flare = foot.aligned.alignment, foot.flare
    side = alignment.side
    word = side.side or "side undecided"
    angle = f"{signed(flare.angle_deg)} ± {plain(flare.angle_sd_deg)} degrees"
    rows = [
        ("Side", f"{word} ({'given' if side.source == 'given' else side.confidence})"),
        ("Flare", f"{angle}: {flare.flare_class}"),
        *_measures(foot),
        ("Scan", f"{alignment.info.faces:,} faces, read in {alignment.info.units}"),
    ]
    notes = "".join(warning(notice) for notice in alignment.warnings)
    is_last = is_scanned_last(foot, match)
    kind = "last" if is_last else "foot"
    title = f"<h3>{word.capitalize()} {kind}: {text(file_name(alignment.info.path))}</h3>"
    known = foot.length_mm
    sizes = "" if is_last or known is None else _sizes(known, match.size_system)
    return f'<section class="foot">{title}{sizes}{facts(rows)}{_unmeasured(foot)}{notes}</section>'


def _sizes(length_mm: float, asked: str | None) -> str:
    """The foot's sizes; the system that was asked for comes first, with the sizes beside it."""
    system = system_named(asked)
    sizes = {size.system: size for size in foot_sizes(length_mm)}
    first = [system.name] if system else []
    names = [*first, *(name for name in SHOWN_SYSTEMS if name not in first)]
    chips = []
    for name in names:
        beside = f" <small>between {' and '.join(sizes[name].beside)}</small>"
        more = beside if name in first else ""
        kind = ' class="asked"' if name in first else ""
        chips.append(f"<li{kind}>{text(sizes[name].words)}{more}</li>")
    return f'<ul class="sizes">{"".join(chips)}</ul>'


def _measures(foot: Profiled) -> Iterable[tuple[str, str]]:
    """The foot's measures that have a value."""
    for measure in foot.measures:
        if measure.measured.value is not None:
            yield _title(measure.name), measured_text(measure.measured, "mm")


def _unmeasured(foot: Profiled) -> str:
    """What could not be measured, each with its reason."""
    lines = [
        f"{_title(measure.name)} {measured_text(measure.measured, 'mm')}"
        for measure in foot.measures
        if measure.measured.value is None
    ]
    return f'<p class="lacking">{text("; ".join(lines))}.</p>' if lines else ""


def _title(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _pair(match: Match) -> str:
    """How two feet differ, where no notice says it."""
    lengths = [foot.length_mm for foot in match.feet if foot.length_mm is not None]
    told = {notice.code for notice in match.warnings} & PAIR_NOTICES
    if told or len(lengths) != ONLY_FEW_FEET:
        return ""
    difference = plain(abs(lengths[0] - lengths[1]))
    return f"<p>The feet differ by {difference} mm in length; the longer one governs.</p>"


# ---------------------------------------------------------------- the lasts


def _lasts(match: Match) -> list[str]:
    """The candidates and their zones; where none fits, what comes nearest."""
    left_out = f"<p>{text(_left_out(match))}</p>"
    if match.candidates:
        title = "<h2>The lasts, best first</h2>"
        how = f"<p>{text(HOW[match.by])}</p>"
        shown = match.candidates
        return [title, how, _table(shown), left_out, _zones(shown), _rooms(shown)]
    if match.nearest:
        title = "<h2>The nearest lasts, and what they miss by</h2>"
        shown = match.nearest
        return [title, _table(shown), left_out, _zones(shown), _rooms(shown)]
    return [left_out]


def _judged(candidates: Sequence[Candidate]) -> bool:
    return any(candidate.verdict for candidate in candidates)


def _table(candidates: Sequence[Candidate]) -> str:
    judged = _judged(candidates)
    heads = [("", "n"), ("Last", ""), *[("Verdict", "")] * judged]
    heads += [("Toe room, mm", "n"), ("Flare, degrees", "n"), ("Distance", "n"), ("Why", "")]
    return table(heads, (_row(one, judged=judged) for one in candidates), kind="first")


def _row(candidate: Candidate, *, judged: bool) -> list[Cell]:
    length = dict(candidate.clearance_mm).get("length", NOT_YET)
    spread = "" if length.sd is None else f" ± {plain(length.sd)}"
    room = "-" if length.value is None else f"{signed(length.value)}{spread}"
    tie = f"; {tie_words(candidate.tied_with, named=1)}" if candidate.tied_with else ""
    return [
        (str(candidate.rank), "n"),
        (f"{text(candidate.last)} <small>{text(_labels(candidate))}</small>", "name"),
        *[(light(candidate.verdict), "verdict")] * judged,
        (room, "n"),
        (signed(candidate.flare.delta_deg), "n"),
        (plain(candidate.distance, 2), "n"),
        (text(candidate.why + tie), "why"),
    ]


def _zones(candidates: Sequence[Candidate]) -> str:
    """Zone by zone: what is asked, and the clearance of every last with a verdict's shape."""
    shown = [candidate for candidate in candidates if candidate.fits]
    if not shown:
        return ""
    sides = [fit.side or "foot" for fit in shown[0].fits]
    feet = f", {' then '.join(sides)}" if len(sides) > 1 else ", last minus foot"
    heads = [(f"Zone by zone{feet}", ""), ("Asked", "n")]
    heads += [(candidate.last, "n") for candidate in shown]
    rows = [
        [
            (text(zone.zone.replace("_", " ")), "name"),
            (f"{signed(zone.target)}{UNITS[zone.unit]}", "n"),
            *((" ".join(_zone(fit.zones[index]) for fit in one.fits), "n") for one in shown),
        ]
        for index, zone in enumerate(shown[0].fits[0].zones)
    ]
    return table(heads, rows, kind="zones")


def _rooms(candidates: Sequence[Candidate]) -> str:
    """Where the surfaces are tight or loose in every last, for those that asked."""
    rows: list[list[Cell]] = [
        [
            (text(candidate.last), "name"),
            ("<br>".join(text(line).replace("cm2", "cm²") for line in lines), ""),
        ]
        for candidate in candidates
        if (lines := surfaces_words(candidate.surfaces))
    ]
    heads = [("Last", ""), ("Where its surface is tight or loose on the foot", "")]
    return table(heads, rows, kind="zones rooms") if rows else ""


def _zone(zone: ZoneFit) -> str:
    if zone.clearance.value is None:
        return shape_of(None)
    return f"{signed(zone.clearance.value)} {shape_of(zone.verdict)}"


def _left_out(match: Match) -> str:
    if not match.rejected:
        return "No last was left out."
    reasons = "; ".join(f"{count} {reason.replace('_', ' ')}" for reason, count in match.rejected)
    return f"Left out: {reasons}."


# ---------------------------------------------------------------- the pictures


def _surface(comparisons: Sequence[Comparison], scene: str) -> list[str]:
    """The feet in the best last: the 3D view, the room by zone, the pictures."""
    if not comparisons:
        return []
    several = len(comparisons) > 1
    rooms = [room_part(one, named=several) for one in comparisons]
    longer = max(comparisons, key=lambda one: one.foot.length_or_extent_mm)
    strips = [
        (section_picture(one, strip=True), "" if one is longer else ' class="screen"')
        for one in comparisons
    ]
    return [
        f"<h2>The room in {text(comparisons[0].last.labels.name)}</h2>",
        scene,
        _side_by_side([f"<div>{room}</div>" for room in rooms]),
        _side_by_side([heat_picture(one) for one in comparisons]),
        *(f"<div{kind}>{strip}</div>" for strip, kind in strips),
    ]


def _flare(match: Match, index: int, shapes: Shapes | None) -> str:
    from footfit.report.pictures.match_figure import SHOWN, match_figure

    foot = match.feet[index]
    name = file_name(foot.aligned.alignment.info.path)
    shown = (match.candidates or match.nearest)[:SHOWN]
    lasts = ", ".join(visible(candidate.last) for candidate in shown)
    which = "best" if match.candidates else "nearest"
    against = f"{name} with the {which} lasts: {lasts}" if lasts else name
    words = (
        f"{against}. Sole from above, profile from the side, heading and plan curvature along the "
        "centre line."
    )
    return picture(match_figure(match, shapes, index), words, kind="flare")


def _legend(match: Match) -> str:
    judged = _judged(match.candidates or match.nearest)
    reference = f" The reference last is {match.reference}." if match.reference else ""
    definition = match.feet[0].flare.definition.version
    lights = (
        "● good: within what the profile asks; ▲ acceptable; ■ poor: look at the zone; ✕ reject; "
        "– not measured, so not judged. A last's verdict is that of its worst zone that counts. "
    )
    lines = (
        f"{lights if judged else ''}Toe room is the last's length minus the foot's, along the "
        "bottom; ± is one standard deviation.",
        "Flare is the turn of the forefoot against the rearfoot, seen from above: + is inflare "
        "(towards the big toe's side). In the table it is the last's flare minus the foot's.",
        f"Distance says how far a last is from what is asked (0 is the same; flare profiles by "
        f"definition {definition}); lasts that are tied are not told apart by it.",
        "The room is the distance from the foot's surface to the last's, the foot laid heel on "
        "heel and tread on tread; what stands over a shoe's topline is not compared. It shows "
        "where to look and judges nothing: a bare foot stands wider than a foot in a shoe, so "
        "that the colours may say tight where the girths, which are judged, fit.",
        f"Lasts of the other side are mirrored for comparing.{reference}",
    )
    inside = "".join(f"<p>{text(line)}</p>" for line in lines)
    return f'<div class="read"><h2>How to read it</h2>{inside}</div>'
