"""CSV: what was put in comes out, and no cell is taken for a formula."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import HalfScan
from footfit.pipeline.batch.sources import Source
from footfit.report.csv import csv_text, harmless
from footfit.results import FailedMatch, Library, Match, Profiled, WideMeasures
from tests import answers


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_a_match_has_a_row_per_candidate() -> None:
    match = answers.match()
    found = rows(csv_text(Match, [match]))
    assert [row["last"] for row in found] == [c.last for c in match.candidates]
    assert tuple(found[0]) == Match.columns
    assert float(found[0]["clearance_length_mm"]) == pytest.approx(11.5)
    assert found[0]["clearance_ball_girth_mm"] == ""
    assert float(found[0]["flare_delta_deg"]) == pytest.approx(-2.0)
    assert found[0]["mirrored"] == "false"


def test_nobody_is_lost_in_the_table_of_a_match() -> None:
    """A foot that no last fits and one that failed have a row each, with the reason."""
    empty = answers.match(candidates=(), rejected=(("too_long", 7),))
    failed = FailedMatch(("l.stl", "r.stl"), "half_scan", "the toes were not scanned")
    found = rows(csv_text(Match, [answers.match(), empty, failed]))
    statuses = [row["status"] for row in found]
    assert statuses == ["ranked"] * 5 + ["no_last_fits"] + ["failed"] * 2
    assert {tuple(row) for row in found} == {Match.columns}
    nothing, left, right = found[5:]
    assert (nothing["foot_length_mm"], nothing["foot_size"]) == ("260.0", "EU 41")
    assert "7 too_long" in nothing["why"]
    assert [row["path"] for row in (left, right)] == ["l.stl", "r.stl"]
    assert (left["error"], left["why"]) == ("half_scan", "the toes were not scanned")


def test_a_pair_has_one_size_in_all_its_rows() -> None:
    feet = (answers.foot("l.stl", left=True, length_mm=252.0), answers.foot("r.stl"))
    found = rows(csv_text(Match, [answers.match(feet, size_system="uk")]))
    assert {row["customer_size"] for row in found} == {"UK 7.5"}
    assert {row["foot_size"] for row in found} == {"UK 7", "UK 7.5"}


def test_measures_have_a_column_each_in_the_wide_table() -> None:
    scan = answers.measured_scan()
    wide = rows(
        csv_text(
            WideMeasures, [scan.wide(), WideMeasures.failed(Source("b.stl"), HalfScan("no toes"))]
        )
    )
    assert tuple(wide[0]) == WideMeasures.columns
    for row in scan.measures:
        name = row.name if row.name.endswith("_deg") else f"{row.name}_mm"
        value = row.measured.value
        assert wide[0][name] == ("" if value is None else str(round(value, 3)))
    assert [row["status"] for row in wide] == ["measured", "failed"]
    assert (wide[1]["path"], wide[1]["error"], wide[1]["why"]) == ("b.stl", "half_scan", "no toes")


def test_a_pair_has_rows_for_each_foot_and_a_stream_one_header() -> None:
    pair = answers.match((answers.foot("l.stl", left=True), answers.foot("r.stl")))
    text = csv_text(Match, [pair, answers.match()])
    found = rows(text)
    assert len(found) == 15
    assert {row["path"] for row in found} == {"l.stl", "r.stl", "feet/anna.stl"}


def test_a_profile_has_a_row_per_station() -> None:
    foot = replace(answers.foot(), flare=answers.profile(spoilt=("bottom_surface",)))
    found = rows(csv_text(Profiled, [foot]))
    assert tuple(found[0]) == Profiled.columns
    assert len(found) == len(foot.flare.stations)
    # measured 3.4e-07
    assert float(found[3]["plan"]) == pytest.approx(foot.flare.curvature["plan"][3], abs=5.1e-7)
    assert {row["bottom_surface"] for row in found} == {""}


def test_lasts_come_by_name() -> None:
    found = rows(csv_text(Library, [Library((answers.record("b"), answers.record("a")), 2, "a")]))
    assert tuple(found[0]) == Library.columns
    assert [(row["last"], row["reference"]) for row in found] == [("a", "true"), ("b", "false")]


@pytest.mark.parametrize(
    "name", ["=1+1", "+1+cmd|' /C calc'!A0", "-1+2", "@SUM(1)", "＝1", "Derby;=1"]
)
def test_formulas_are_shown_and_not_run(name: str) -> None:
    match = answers.match(names=(name,))
    cell = rows(csv_text(Match, [match]))[0]["last"]
    assert cell.replace("'", "") == name.replace("'", "")
    assert not re.search("(^|;)[=+@＝-]", cell)


@pytest.mark.parametrize("name", ["\t=1", "\r=1", "\n=1", "a\nb"])
def test_a_row_is_a_line(name: str) -> None:
    text = csv_text(Match, [answers.match(names=(name,))])
    assert len(text.splitlines()) == 2
    assert rows(text)[0]["last"] == repr(name)[1:-1]


def test_numbers_stay_numbers() -> None:
    assert [harmless(text) for text in ("-5", "+42", "-2.5", "-2,5")] == [
        "-5",
        "+42",
        "-2.5",
        "-2,5",
    ]


@given(st.text(max_size=30))
@settings(deadline=None, max_examples=300)
def test_any_name_stays_in_its_cell(name: str) -> None:
    text = csv_text(Match, [answers.match(names=(name,))])
    assert len(text.splitlines()) == 2
    found = rows(text)
    assert None not in found[0]
    cell = found[0]["last"]
    assert cell == harmless(cell)
    if cell and cell[0] in "=+-@":
        assert cell.lstrip("+-").replace(".", "").replace(",", "").isdigit()
    assert text.encode("utf-8")
