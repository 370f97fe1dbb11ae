"""Answers about fit profiles as rich renderables."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit import results
from footfit.number_words import UNITS, signed
from footfit.report.terminal.scan_tables import cell, lined_table
from footfit.report.wording.text import visible
from footfit.results.fit import GRADES, ZONE_LABELS

TENTH_MM = 0.1  # a profile is written in tenths


def list_profiles_table(listed: results.ProfileList) -> RenderableType:
    """One line for each profile."""
    table = lined_table("profile", "version", "for", right=frozenset({"version"}))
    for profile in listed.profiles:
        table.add_row(cell(profile.name, "bold"), str(profile.version), cell(profile.summary))
    return Group(table, Text("footfit show-profile NAME shows one with its sources", "dim"))


def show_profile_table(shown: results.ShownProfile) -> RenderableType:
    """What a profile asks of each zone, last minus foot, and how well that is founded."""
    profile = shown.profile
    heads = ("zone", "target", "good", "acceptable", "weight", "grade", "source")
    table = lined_table(*heads, right=frozenset({"target", "weight"}))
    for rule in profile.zones:
        table.add_row(
            cell(ZONE_LABELS[rule.zone], "bold"),
            f"{rule.target:g}{UNITS[shown.units[rule.zone]]}",
            range_words(rule.good),
            range_words(rule.acceptable),
            f"{rule.weight:g}",
            rule.grade,
            cell(rule.source),
        )
    title = f"{visible(profile.name)}, version {profile.version}: {visible(profile.summary)}"
    used = sorted({rule.grade for rule in profile.zones})
    grades = "; ".join(f"{grade} {GRADES[grade]}" for grade in used)
    notes = [f"last minus foot; grades: {grades}"]
    zones = {rule.zone: ZONE_LABELS[rule.zone] for rule in profile.zones}
    keys = [
        f"{label} is {zone}" for zone, label in zones.items() if zone != label.replace(" ", "_")
    ]
    if keys:
        notes.append(f"in a profile's file {', '.join(keys)}")
    return Group(Text(title, "bold"), table, *(Text(note, "dim") for note in notes))


def calibration_table(learned: results.Calibration) -> RenderableType:
    """What the ratings say of each zone, and what became of its rule."""
    heads = ("zone", "wearers", "ratings", "target", "learned, 95 %", "good", "outcome")
    table = lined_table(*heads, right=frozenset({"wearers", "ratings", "target"}))
    for zone in learned.zones:
        learnt = "-"
        if zone.target_mm is not None and zone.target_interval_mm is not None:
            low, high = (signed(end) for end in zone.target_interval_mm)
            learnt = f"{signed(zone.target_mm)} ({low} to {high})"
        good = range_words(zone.before.good)
        changed = zone.status == "applied"
        table.add_row(
            cell(ZONE_LABELS[zone.zone], "bold"),
            str(zone.wearers),
            str(zone.ratings),
            signed(zone.before.target),
            learnt,
            f"{good}, now {range_words(zone.after.good)}" if changed else good,
            f"{_move_words(zone) if changed else f'kept: {zone.reason}'}{loss_words(zone.losses)}",
        )
    notes = [f"{count} entries {why} are left out" for why, count in learned.left_out.items()]
    closing = "all in mm, last minus foot; the interval holds the target with 95 %"
    return Group(table, *(Text(note, "yellow") for note in notes), Text(closing, "dim"))


def _move_words(zone: results.ZoneEvidence) -> str:
    """The new target; and that it may not move further, where the ratings ask for more."""
    words = f"target is now {signed(zone.after.target)}"
    held = zone.target_mm is not None and abs(zone.target_mm - zone.after.target) > TENTH_MM
    return f"{words}, as far as it may move at once" if held else words


def loss_words(losses: tuple[float, float] | None) -> str:
    """The mean log loss of ratings that were held out, less is better.

    Examples
    --------
    >>> loss_words((1.404, 1.25)), loss_words(None)
    ('; log loss of held-out ratings 1.250, by the profile 1.404', '')
    """
    if losses is None:
        return ""
    before, after = losses
    return f"; log loss of held-out ratings {after:.3f}, by the profile {before:.3f}"


def range_words(ends: tuple[float, float]) -> str:
    """A range in words.

    Examples
    --------
    >>> range_words((-4.0, 5.5))
    '-4 to 5.5'
    """
    return f"{ends[0]:g} to {ends[1]:g}"


def check_profile_line(checked: results.CheckedProfile) -> RenderableType:
    """The profile is sound, and which zones name no source."""
    count = len(checked.zones)
    zones = f"{count} zone" if count == 1 else f"{count} zones"
    words = f"{visible(checked.path)}: a sound fit profile {visible(checked.name)!r}, {zones}"
    lacking = ", ".join(ZONE_LABELS[zone] for zone in checked.without_source)
    return Text(f"{words}; no source is given for {lacking}" if lacking else words)
