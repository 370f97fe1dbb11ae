"""Each of many customers is told on the page, in the CSV and in the terminal as was answered."""

from __future__ import annotations

import csv
import io
import shutil
from pathlib import Path

import footfit as library
from footfit.pipeline.drawables import best_comparisons
from footfit.report.terminal.match_tables import match_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.report.terminal.summary_tables import customer_line, customers_table
from tests import readers
from tests.conftest import SAMPLES, Footfit
from tests.readback import CSV, PAGE, match_facts, problems


def rows_of(text: str, customer: str) -> str:
    """The rows of one customer of a CSV, under its header."""
    header, *rows = csv.reader(io.StringIO(text))
    place = header.index("customer")
    out = io.StringIO()
    csv.writer(out).writerows([header, *(row for row in rows if row[place] == customer)])
    return out.getvalue()


def test_many_customers_are_told_as_the_search_answered(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    scans, pages, table = tmp_path / "scans", tmp_path / "pages", tmp_path / "rows.csv"
    scans.mkdir()
    names = {"Ann_left": "mh007_L", "ann-RIGHT": "mh007_R", "bob_R": "mh008_R"}
    for name, foot in names.items():
        shutil.copy(SAMPLES / "feet" / f"{foot}.stl", scans / f"{name}.stl")
    customers = library.customers(str(scans))
    with library.open_catalogue(stocked) as lasts:
        outcomes = list(lasts.match_each(customers, clearance=True))
    matches = [outcome.value for outcome in outcomes if outcome.value is not None]
    assert [match.customer for match in matches] == ["Ann", "bob"]
    run = footfit(
        *("match", scans, "--pairs", "auto", "--clearance", "-o", pages, "--csv", table),
        *("--catalogue", stocked),
    )
    assert run.code == 0
    shown = [terminal_text(match_table(match)) for match in matches]
    lines = [
        customer_line(each.title, match) for each, match in zip(customers, matches, strict=True)
    ]
    assert run.out == "".join([*shown, terminal_text(customers_table(lines))])
    for match, line in zip(matches, lines, strict=True):
        best = match.candidates[0]
        assert line[1:] == (match.customer_size, best.last, best.verdict, None)
        facts = list(match_facts(match, best_comparisons(stocked, match)))
        page = (pages / f"{match.customer}.html").read_text("utf-8")
        assert problems(PAGE, readers.read_match_page(page), facts) == []
        cells = rows_of(table.read_text("utf-8"), match.customer or "")
        assert problems(CSV, readers.read_match_csv(cells), facts) == []
