"""Answers about the fit log as rich renderables."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit import results
from footfit.number_words import plain
from footfit.report.terminal.scan_tables import cell, lined_table
from footfit.report.wording.text import visible


def record_fit_line(outcome: results.RecordOutcome) -> RenderableType:
    """The entry that was stored, and how it is removed."""
    entry = outcome.entry
    who = f" of {entry.wearer}" if entry.wearer else ""
    return Text(
        f"{visible(entry.last)}: recorded as {entry.id}{who}: {ratings_words(entry)}."
        f" To remove it: footfit forget-fits {entry.id}"
    )


def ratings_words(entry: results.FitEntry) -> str:
    """What the wearer said, in one line."""
    words = [
        f"{place} {rating:+d}" if rating else f"{place} 0"
        for place, rating in entry.ratings.items()
    ]
    words += [f"comfort {plain(entry.comfort, 0)} of 100"] if entry.comfort is not None else []
    words += [entry.outcome] if entry.outcome else []
    return ", ".join(words)


def list_fits_table(fits: results.FitList) -> RenderableType:
    """One line for each entry, oldest first."""
    table = lined_table("id", "recorded", "wearer", "last", "profile", "what was said")
    for entry in fits.entries:
        table.add_row(
            cell(entry.id),
            entry.recorded[:10],
            cell(entry.wearer),
            cell(entry.last, "bold"),
            cell(entry.profile),
            ratings_words(entry),
        )
    count = len(fits.entries)
    wearers = len({entry.wearer_key for entry in fits.entries})
    nouns = "entry" if count == 1 else "entries", "wearer" if wearers == 1 else "wearers"
    closing = f"{count} {nouns[0]} of {wearers} {nouns[1]}; -2 is much too tight, +2 much too loose"
    return Group(table, Text(closing if count else "the fit log is empty", "dim"))


def forget_fits_line(outcome: results.ForgetOutcome) -> RenderableType:
    """What was removed, and where it may still be."""
    noun = "entry" if outcome.entries == 1 else "entries"
    return Text(
        f"{outcome.entries} {noun} of {visible(outcome.asked)} removed for good."
        " Earlier backups and copies still hold what they held: delete those too."
    )
