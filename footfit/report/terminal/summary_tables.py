"""The customers of a batch as one table: what came out for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.errors import FootfitError
from footfit.geometry.fit.sizes import foot_size, system_named
from footfit.report.terminal.match_tables import VERDICT_STYLES
from footfit.report.terminal.scan_tables import cell, lined_table
from footfit.results import Match

SIZE_SYSTEM = "eu"
"""The system of the sizes, if nobody asks for another."""


class CustomerLine(NamedTuple):
    """One customer: the size, the first last and its verdict, or what went wrong."""

    customer: str
    size: str | None
    last: str | None
    verdict: str | None
    problem: str | None


def customer_line(customer: str, answer: Match | FootfitError | None) -> CustomerLine:
    """The line of a customer whose match was answered, or failed."""
    if not isinstance(answer, Match):
        return CustomerLine(customer, None, None, None, answer.message if answer else None)
    best = answer.candidates[0] if answer.candidates else None
    if best is not None:
        return CustomerLine(customer, _size(answer), best.last, best.verdict, None)
    near = f"no last fits; the nearest is {answer.nearest[0].last}" if answer.nearest else None
    return CustomerLine(customer, _size(answer), None, None, near or "no last fits")


def customers_table(lines: Sequence[CustomerLine]) -> RenderableType:
    """A row for each customer."""
    table = lined_table("customer", "size", "best last", "verdict", "what went wrong")
    for line in lines:
        verdict = cell(line.verdict, VERDICT_STYLES.get(line.verdict or "", ""))
        problem = cell(line.problem) if line.problem else Text("")
        table.add_row(
            cell(line.customer, "bold"), cell(line.size), cell(line.last), verdict, problem
        )
    return Group(Text(f"{len(lines)} customers", "bold"), table)


def _size(match: Match) -> str | None:
    """The customer's size: that of the longer foot."""
    known = [foot.length_mm for foot in match.feet if foot.length_mm is not None]
    system = system_named(match.size_system) or system_named(SIZE_SYSTEM)
    return foot_size(max(known), system).words if known and system else None
