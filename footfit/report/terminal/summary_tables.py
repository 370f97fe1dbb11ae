"""The customers of a batch as one table: what came out for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.errors import FootfitError
from footfit.report.terminal.match_tables import VERDICT_STYLES
from footfit.report.terminal.scan_tables import cell, lined_table
from footfit.results import Match


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
        return CustomerLine(customer, answer.customer_size, best.last, best.verdict, None)
    near = f"no last fits; the nearest is {answer.nearest[0].last}" if answer.nearest else None
    return CustomerLine(customer, answer.customer_size, None, None, near or "no last fits")


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
