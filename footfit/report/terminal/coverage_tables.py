"""The coverage of a population, and the check of all lasts, as tables for a terminal."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.number_words import RATIO_KEPT, plain
from footfit.report.terminal.scan_tables import cell, facts, lined_table
from footfit.report.wording.coverage_words import (
    GREEDY_WORDS,
    PRIVACY_WORDS,
    coverage_sentence,
    feet_words,
    go_words,
    next_words,
    percent_words,
    share_words,
)
from footfit.report.wording.text import visible
from footfit.results.population.checked_lasts import LastsCheck
from footfit.results.population.coverage_answer import Coverage
from footfit.results.population.shares import ServedBy

SHOWN_LASTS = 15
MOST_GROUPS = 30


def coverage_table(answer: Coverage) -> RenderableType:
    """Shares, criteria, groups, lasts, the lasts to make, and how the feet are distributed."""
    head = facts(
        ("have a good last", share_words(answer.served.good)),
        ("have an acceptable last", share_words(answer.served.acceptable)),
        title=coverage_sentence(answer),
    )
    parts: list[RenderableType] = [head, Text("Intervals are 95 % (Wilson).", "dim")]
    parts += [*_zones(answer)]
    for groups in answer.groups:
        parts.append(_groups(groups))
    parts += [*_lasts(answer), Text(""), *_next(answer), _feet(answer)]
    return Group(*parts, Text(PRIVACY_WORDS, "dim"))


def _zones(answer: Coverage) -> list[RenderableType]:
    """Each criterion by itself: feet that any last serves there."""
    shares = ("alone", "with toe room", "in the best last")
    table = lined_table(
        "acceptable, by criterion", "feet", *shares, right=frozenset({"feet", *shares})
    )
    for zone in answer.zones:
        name = cell(zone.label, "" if zone.counts else "dim")
        if not zone.judged:
            table.add_row(name, "0", *["not judged"] * 3)
            continue
        known = (zone.alone, zone.with_length, zone.best_last)
        values = [percent_words(each.acceptable.value) for each in known]
        table.add_row(name, f"{zone.judged:,}", *values)
    words = "Each share is of the feet that could be judged there. Together they are lower."
    return [table, Text(words, "dim")]


def _groups(served: ServedBy) -> RenderableType:
    """The feet in groups by one thing."""
    numbers = ("feet", "good", "acceptable")
    table = lined_table(f"by {served.by.replace('_', ' ')}", *numbers, right=frozenset(numbers))
    for each in served.groups[:MOST_GROUPS]:
        good, acceptable = each.served.good, each.served.acceptable
        words = share_words(acceptable)
        table.add_row(cell(each.group), f"{good.of:,}", percent_words(good.value), words)
    more = len(served.groups) - MOST_GROUPS
    return Group(table, Text(f"{more} more groups: see --json", "dim")) if more > 0 else table


def _lasts(answer: Coverage) -> list[RenderableType]:
    """The lasts that serve most feet, and which could go."""
    numbers = ("good", "acceptable", "best for", "only it")
    table = lined_table("last", *numbers, right=frozenset(numbers))
    order = sorted(answer.library, key=lambda last: (-last.acceptable, last.last))
    for last in order[:SHOWN_LASTS]:
        counts = (last.good, last.acceptable, last.best_for, last.only)
        table.add_row(cell(last.last, "bold"), *(f"{count:,}" for count in counts))
    more = len(order) - SHOWN_LASTS
    rest = [Text(f"{more:,} more lasts: see --lasts-csv", "dim")] if more > 0 else []
    return [table, *rest, Text(go_words(answer))] if order else [Text("There is no last.")]


def _next(answer: Coverage) -> list[RenderableType]:
    """The lasts to make next."""
    missing = answer.served.acceptable.of - answer.served.acceptable.count
    if not answer.next_lasts:
        words = "No last is planned." if missing else "No last is missing."
        return [Text(words)]
    numbers = ("feet more", "covered", "at most")
    table = lined_table("make next", *numbers, "measures, mm", right=frozenset(numbers))
    for last in answer.next_lasts:
        name = f"{last.size} {last.width}" if last.width else last.size
        most = percent_words(last.covered_at_most)
        table.add_row(
            cell(name, "bold"), f"{last.gain:,}", percent_words(last.covered.value), most,
            cell(next_words(last)),
        )  # fmt: skip
    head = Text(f"{feet_words(missing)} without an acceptable last:")
    return [head, table, Text(GREEDY_WORDS, "dim")]


def _feet(answer: Coverage) -> RenderableType:
    """How each measure of the feet is distributed."""
    numbers = ("n", "mean", "sd", "5 %", "50 %", "95 %")
    table = lined_table("the feet", "unit", *numbers, right=frozenset(numbers))
    for known in answer.distributions:
        percent = dict(known.percentiles)
        values = (known.mean, known.sd, *(percent[at] for at in (5, 50, 95)))
        shown = ["-" if v is None else plain(v, 1, RATIO_KEPT) for v in values]
        table.add_row(known.measure.replace("_", " "), known.unit, f"{known.feet:,}", *shown)
    return table


def lasts_check_table(check: LastsCheck) -> RenderableType:
    """The findings about all lasts, faults first."""
    lasts = "1 last" if check.lasts == 1 else f"{check.lasts:,} lasts"
    families = "1 run" if check.families == 1 else f"{check.families:,} runs"
    head = Text(f"{lasts} and {families} checked in {visible(check.path)}", "bold")
    parts: list[RenderableType] = [head]
    if check.findings:
        table = lined_table("last", "finding", "reason")
        for finding in check.findings:
            style = "red" if finding.fault else "dim"
            code = Text(finding.code.replace("_", " "), style)
            table.add_row(cell(finding.last, "bold"), code, cell(finding.message))
        parts.append(table)
    else:
        parts.append(Text("Nothing was found."))
    parts += [
        Text(f"Not checked as a run: {visible(name)}: {visible(why)}", "dim")
        for name, why in check.not_checked[:SHOWN_LASTS]
    ]
    more = len(check.not_checked) - SHOWN_LASTS
    parts += [Text(f"{more:,} more are not checked: see --json", "dim")] if more > 0 else []
    return Group(*parts)
