"""A custom last as a table for a terminal."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.number_words import plain, signed
from footfit.report.terminal.scan_tables import lined_table
from footfit.report.wording.custom_words import (
    CUSTOM_SPREADS,
    GIRTH_WORDS,
    UPRIGHT,
    advice_words,
    custom_verdict_words,
    has_room,
    judged_words,
    room_words,
    with_spread,
    zone_words,
)
from footfit.report.wording.text import file_name, visible
from footfit.results import CustomLast, CustomZone, JudgedZone


def custom_table(custom: CustomLast) -> RenderableType:
    """The targets and what was reached, the zones of the profile, and what was kept."""
    return Group(
        _headline(custom),
        Text(custom_verdict_words(custom), "bold"),
        *(Text(words) for words in [advice_words(custom)] if words is not None),
        Text(_made_words(custom)),
        Text(),
        _zones_table(custom),
        Text(CUSTOM_SPREADS, "dim"),
        Text(
            f"allow: what the profile allows; the target is foot + allow{_room_term(custom)}."
            " follows: the parts that are kept nearly set this girth, so it has no own target.",
            "dim",
        ),
        *(Text(words) for words in room_words(custom)),
        Text(),
        Text(f"The zones of profile {custom.profile}: last minus foot"),
        _judged_table(custom),
        Text(GIRTH_WORDS, "dim"),
        Text(),
        Text(_kept_words(custom)),
        *([] if custom.stored_as is None else [Text(f"stored as {visible(custom.stored_as)}")]),
    )


def _headline(custom: CustomLast) -> Text:
    line = Text(visible(custom.record.labels.name), "bold")
    line.append(f", {custom.side} last from ", "not bold").append(visible(custom.base), "bold")
    line.append(f" for {file_name(custom.foot)}", "not bold")
    return line.append(" (mirror image)" if custom.mirrored else "", "not bold")


def _made_words(custom: CustomLast) -> str:
    """What moved, and how far the change is from a fold."""
    words = f"the toe moved {signed(custom.toe_shift_mm)} mm, the surface up to"
    words += f" {plain(custom.largest_move_mm)} mm"
    if custom.flare_turn_deg:
        words += f"; the flare was turned by {signed(custom.flare_turn_deg)} deg"
    return f"{words}; the smallest volume left is {plain(custom.least_determinant, 2)} of 1"


def _zones_table(custom: CustomLast) -> RenderableType:
    columns = ("foot", "allow", "base", "target", "reached", "change")
    notes = ("",) if any(map(_note, custom.zones)) else ()
    table = lined_table("in mm", *columns, *notes, right=frozenset(columns))
    table.columns[0].no_wrap = True
    for zone in custom.zones:
        values = (
            "-" if zone.foot is None else plain(zone.foot),
            "-" if zone.allowance is None else signed(zone.allowance),
            plain(zone.base),
            "follows" if zone.follows else with_spread(plain(zone.target), zone.foot_sd),
            with_spread(plain(zone.reached), zone.reached_sd),
            signed(zone.reached - zone.base),
        )
        table.add_row(zone.words, *values, *(_note(zone) for _ in notes))
    return table


def _room_term(custom: CustomLast) -> str:
    """What room for single places adds to a target, if there is some."""
    return " + what --room adds" if any(map(has_room, custom.zones)) else ""


def _note(zone: CustomZone) -> str:
    """What should be known of a target."""
    return f"{signed(zone.room)} by --room" if has_room(zone) else ""


def _judged_table(custom: CustomLast) -> RenderableType:
    columns = ("target", "base", "custom")
    table = lined_table("zone", *columns, "base is", "custom is", right=frozenset(columns))
    for zone in custom.judged:
        pairs = ((zone.base, zone.base_sd), (zone.custom, zone.custom_sd))
        values = (judged_words(*pair, zone.unit) for pair in pairs)
        verdicts = (zone.base_verdict or "-", zone.custom_verdict or "-")
        words = zone_words(zone).removesuffix(" girth") if zone.name in UPRIGHT else zone.label
        table.add_row(words, _target(zone), *values, *verdicts)
    return table


def _target(zone: JudgedZone) -> str:
    unit = {"percent": " %", "ratio": ""}.get(zone.unit, f" {zone.unit}")
    return f"{signed(zone.target)}{unit}"


def _kept_words(custom: CustomLast) -> str:
    """What a last maker keeps, and by how much it moved."""
    parts = (f"{part.name} {plain(part.moved_mm, 2)}" for part in custom.kept)
    return f"Kept, and moved by at most so many mm: {', '.join(parts)}"
