"""A match as rich renderables: the feet, the lasts, and the best last zone by zone.

It fits 80 columns. A last has a row of numbers, and under it a sentence over the whole width.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from footfit.geometry.fit.sizes import foot_size, foot_sizes, system_named
from footfit.number_words import RATIO_KEPT, UNITS, plain, signed
from footfit.report.terminal.scan_tables import cell, flare_words, lined_table
from footfit.report.wording.fit_words import (
    OTHER_FOOT,
    left_out_words,
    toe_room_text,
    zone_label,
    zone_number,
)
from footfit.report.wording.text import (
    SHOWN_SYSTEMS,
    file_name,
    is_scanned_last,
    shown_size_text,
    side_doubts,
    tie_words,
    visible,
)
from footfit.report.wording.width_words import fittings_words, shares_words
from footfit.results import Candidate, FootWidth, Match, Profiled, ZoneFit
from footfit.results.values import VERDICTS

LIKENESS = {
    "fit": "order: the verdict, then the toe room, then the distance: how far the zones are "
    "from what the profile asks (0 = the target, 1 = the edge of good); lasts that are tied are "
    "not told apart by the measures",
    "flare": "distance: how far the flare profile is from the foot's (0 = the same), at any size",
    "shape": "length: the last's minus the mesh's, along the bottom of both; distance: how far "
    "measures and flare profile are from the mesh's (0 = the same)",
}
VERDICT_STYLES = {"good": "green", "acceptable": "yellow", "poor": "red", "reject": "bold red"}
COLUMNS = {"": 2, "last": 20, "style, size": 16, "verdict": 10}
COLUMNS |= {"toe room\nmm": 8, "flare\ndeg": 6, "dist.\n": 5}
"""The columns of the lasts, with their largest widths; the last three hold numbers."""
VERDICT, NUMBERS, COLUMN_GAP = 3, 3, 2


def match_table(match: Match) -> RenderableType:
    """The feet, the ranked lasts with reasons, and why others were left out."""
    parts: list[RenderableType] = [Text(words, "bold red") for words in side_doubts(match)]
    parts += [cell(match.customer, "bold underline")] if match.customer else []
    of_last = is_scanned_last(match.feet[0], match)
    for foot, width in zip_longest(match.feet, match.widths):
        parts.append(_foot_line(foot, match))
        if width is not None and not of_last:
            parts.append(_width_line(width, match.customer_length_mm))
    if match.customer_length_mm is not None and not of_last:
        parts.append(_size_line(match.customer_length_mm, match.size_system))
    parts.append(Text())
    if match.candidates:
        parts += [*_candidates(match.candidates), Text(), *_zones(match)]
    else:
        parts.append(Text("No last fits.", "bold"))
        if match.nearest:
            parts += [Text("The nearest, and what they miss by:"), *_candidates(match.nearest)]
    likeness = [Text(LIKENESS[match.by], "dim")] if match.candidates else []
    return Group(*parts, *likeness, Text(_closing(match), "dim"))


def _foot_line(foot: Profiled, match: Match) -> Text:
    alignment = foot.aligned.alignment
    side = alignment.side.side or "undecided"
    line = cell(file_name(alignment.info.path), "bold")
    mm = foot.length_mm
    length = "length not measured" if mm is None else f"{plain(mm)} mm long"
    kind = "last" if is_scanned_last(foot, match) else "foot"
    return line.append(f"  {side} {kind}, {length}, flare {flare_words(foot)}", "not bold")


def _width_line(width: FootWidth, size_mm: float | None) -> RenderableType:
    """The width fitting at the customer's size, and how wide the foot is among people."""
    parts = (fittings_words(width, size_mm), shares_words(width))
    return Padding(Text("width: " + "; ".join(part for part in parts if part)), (0, 0, 0, 2))


def _size_line(length_mm: float, asked: str | None) -> RenderableType:
    """The customer's size: in the system asked for with the next ones, or in the usual systems."""
    system = system_named(asked)
    if system is not None:
        size = foot_size(length_mm, system)
        words = f"size {size.words}; beside it {size.beside[0]} and {size.beside[1]}"
    else:
        sizes = {size.system: size.words for size in foot_sizes(length_mm)}
        words = "sizes: " + ", ".join(sizes[name] for name in SHOWN_SYSTEMS)
    return Padding(Text(words), (0, 0, 0, 2))


def _candidates(candidates: Sequence[Candidate]) -> list[RenderableType]:
    """The lasts, each a row of numbers and a sentence."""
    judged = any(candidate.verdict for candidate in candidates)
    shown = [place for place in range(len(COLUMNS)) if place != VERDICT or judged]
    heads = [head if judged else head.replace("toe room", "length") for head in COLUMNS]
    table = [[Text(head, "bold") for head in heads], *(_cells(last) for last in candidates)]
    widths = list(COLUMNS.values())
    longest = [max(row[place].cell_len for row in table) for place in (1, 2)]
    widths[1] = min(widths[1], longest[0])  # names and labels are short, most often
    widths[2] = min(COLUMNS["last"] + widths[2] - widths[1], longest[1])
    widths = [widths[place] for place in shown]
    head, *rows = (_row(widths, [row[place] for place in shown]) for row in table)
    line = Text("─" * (sum(widths) + COLUMN_GAP * (len(widths) - 1)), "dim")
    parts: list[RenderableType] = [head, line]
    for candidate, row in zip(candidates, rows, strict=True):
        parts += [row, _sentence(candidate)]
    return parts


def _row(widths: Sequence[int], cells: Sequence[Text]) -> Table:
    """One row of a table whose columns have these widths; the last three hold numbers."""
    grid = Table.grid(padding=(0, COLUMN_GAP, 0, 0))
    first_number = len(widths) - NUMBERS
    for place, width in enumerate(widths):
        right = place >= first_number or place == 0
        grid.add_column(width=width, justify="right" if right else "left", overflow="fold")
    grid.add_row(*cells)
    return grid


def _labels(candidate: Candidate) -> str:
    parts = (candidate.style, shown_size_text(candidate))
    return ", ".join(visible(part) for part in parts if part)


def _cells(candidate: Candidate) -> list[Text]:
    verdict = cell(candidate.verdict, VERDICT_STYLES.get(candidate.verdict or "", ""))
    return [
        Text(str(candidate.rank)),
        cell(candidate.last, "bold"),
        cell(_labels(candidate)),
        verdict,
        Text(toe_room_text(candidate, spread=False)),
        Text(signed(candidate.flare.delta_deg)),
        Text(plain(candidate.distance, 2, RATIO_KEPT)),
    ]


def _sentence(candidate: Candidate) -> RenderableType:
    """The reason, the ties, and where the last is tight or loose: the lines under the row."""
    words = cell(candidate.why)
    if candidate.mirrored:
        words.append(f"; {OTHER_FOOT}")
    if candidate.tied_with:
        words.append(f"; {tie_words(candidate.tied_with)}")
    return Padding(Group(words, *_rooms(candidate)), (0, 0, 0, 4))


def _rooms(candidate: Candidate) -> list[Text]:
    """Where the last is tight or loose, if the surfaces were compared."""
    if not candidate.surfaces:
        return []
    from footfit.report.wording.comparison_words import surfaces_words, tightest_words

    lines = (tightest_words(candidate.tightest), *surfaces_words(candidate.surfaces))
    return [Text(line, "dim") for line in lines]


# ---------------------------------------------------------------- zone by zone


def _zones(match: Match) -> list[RenderableType]:
    """The best last zone by zone; nothing if the match has no zones."""
    best = match.candidates[0]
    if not best.fits:
        return []
    title = Text("Zone by zone, the last minus the foot: ").append(visible(best.last), "bold")
    feet = [fit.side or "foot" for fit in best.fits] if len(best.fits) > 1 else ["clearance"]
    table = lined_table("zone", *feet, "wanted", "verdict", right=frozenset({*feet, "wanted"}))
    for zones in zip(*(fit.zones for fit in best.fits), strict=True):
        table.add_row(
            zone_label(zones[0]),
            *(_clearance(zone) for zone in zones),
            f"{signed(zones[0].target)}{UNITS[zones[0].unit]}",
            _zone_verdict(zones, feet),
        )
    return [title, table]


def _clearance(zone: ZoneFit) -> Text:
    """A clearance; grey if it does not count."""
    if zone.clearance.value is None:
        return Text("-", "dim")
    number = f"{zone_number(zone)}{UNITS[zone.unit]}"
    return Text(number) if zone.counts else Text(f"({number})", "dim")


def _zone_verdict(zones: Sequence[ZoneFit], feet: Sequence[str]) -> Text:
    """The worst verdict of the feet that the zone counts for, and why the others do not count."""
    known = [zone.verdict for zone in zones if zone.counts and zone.verdict is not None]
    if not known:
        reasons = [zone.clearance.reason or zone.not_counted for zone in zones]
        reason = next((text for text in reasons if text), "counts nothing")
        return Text("not judged: ", "dim").append(visible(reason))
    worst = max(known, key=VERDICTS.index)
    words = Text(worst, VERDICT_STYLES[worst])
    places = {zone.place for zone in zones if zone.counts and zone.verdict == worst and zone.place}
    words.append(f": {'; '.join(sorted(places))}" if places else "", "default")
    for foot, zone in zip(feet, zones, strict=True):
        if zone.not_counted and zone.clearance.value is not None:
            words.append(f"; {foot} not judged: {visible(zone.not_counted)}", "dim")
    return words


def _closing(match: Match) -> str:
    noun = "last" if match.catalogue_lasts == 1 else "lasts"
    words = f"{len(match.candidates)} of {match.catalogue_lasts} {noun}, by {match.by}"
    words += f", profile {visible(match.profile)}" if match.by == "fit" else ""
    left_out = visible(left_out_words(match.rejected))
    return f"{words}. Left out: {left_out}." if left_out else f"{words}."
