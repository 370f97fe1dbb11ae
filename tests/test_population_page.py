"""The coverage as a table, a page and files: the numbers are the document's, no foot is named."""

from __future__ import annotations

import html
import json
import re
from pathlib import Path

import numpy as np
import pytest

from footfit.api.populations import coverage
from footfit.report.page.coverage_page import coverage_page
from footfit.report.terminal.coverage_tables import coverage_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results.population.coverage_answer import Coverage
from tests.conftest import SAMPLES, Footfit
from tests.people import NAMES, answer, last_for, sizes, write_csv


@pytest.fixture(scope="module")
def found(tmp_path_factory) -> Coverage:
    rows = sizes(120)
    ids = [f"secret-{number}" for number in range(len(rows))]
    path = write_csv(tmp_path_factory.mktemp("feet") / "feet.csv", rows, ids)
    lasts = [last_for(f"l{i}", foot) for i, foot in enumerate(sizes(5))]
    return answer(path, [*lasts, last_for("<b>&", sizes(1, 9)[0])])


def test_page_and_table_have_the_numbers_of_the_document(found: Coverage) -> None:
    page, table = coverage_page(found), terminal_text(coverage_table(found), 100)
    document = found.to_dict()
    text = html.unescape(re.sub(r"<[^>]+>", " ", page))
    for shown in (text, table):
        for key in ("good", "acceptable"):
            assert f"{100 * document[key]['share']:.1f} %" in shown
        assert f"{len(document['feet'])} feet judged in 6 lasts" in shown
        for last in document["next_lasts"]:
            assert f"{last['size']} {last['width']}" in shown
    assert page.count("data:image/svg+xml") == 3  # without flare there is no plot of it
    assert page == coverage_page(found)


def test_no_foot_is_named_and_no_name_is_markup(found: Coverage) -> None:
    page = coverage_page(found)
    assert "secret-" not in page
    assert "<b>&" not in page
    assert "&lt;b&gt;&amp;" in page
    assert "secret-" not in terminal_text(coverage_table(found), 100)
    assert "secret-7" in json.dumps(found.to_dict())


def test_a_csv_gives_a_table_pages_and_files(
    stocked: Path, tmp_path: Path, footfit: Footfit
) -> None:
    feet = write_csv(tmp_path / "feet.csv", sizes(30))
    text = feet.read_text(encoding="utf-8").replace(",", ";").replace(".", ",")
    feet.write_text(text.replace("id;", "Id;"), encoding="utf-16")
    files = {name: tmp_path / name for name in ("a.html", "feet-out.csv", "lasts.csv")}
    done = footfit(
        "coverage", feet, "--catalogue", stocked, "--html", files["a.html"], "--csv",
        files["feet-out.csv"], "--lasts-csv", files["lasts.csv"], "--json",
    )  # fmt: skip
    assert done.code == 0, done.err
    document = json.loads(done.out)
    assert document["judged"] == 30
    assert len(files["feet-out.csv"].read_text().splitlines()) == 31
    assert len(files["lasts.csv"].read_text().splitlines()) == 1 + document["lasts_considered"]
    same = coverage(feet, stocked)
    assert same.to_dict() == document


@pytest.mark.parametrize(
    ("content", "code", "words"),
    [
        ("id,girth\na,230\n", 3, "no column 'length'"),
        ("id,length\na,25.2\n", 3, "line 2: length is 25.2"),
        ("id,length,ball_girth\na,252,22.8\n", 3, "is it 228 mm?"),
        ("id,length\na,wide\n", 3, "length is 'wide'"),
        ("id,length,length_mm\na,250,250\n", 3, "two columns for length"),
        ("id,length,side\na,250,up\n", 3, "line 2: side is 'up'"),
        ("id,length\n", 3, "has no foot below its head"),
    ],
)
def test_bad_tables_are_refused_in_one_line(
    content: str, code: int, words: str, stocked: Path, tmp_path: Path, footfit: Footfit
) -> None:
    feet = tmp_path / "feet.csv"
    feet.write_text(content)
    done = footfit("coverage", feet, "--catalogue", stocked)
    assert (done.code, done.out) == (code, "")
    assert words in done.err
    assert done.err.count("\n") == 1


def test_scans_go_on_from_a_cache(stocked: Path, tmp_path: Path, footfit: Footfit) -> None:
    scans = sorted((SAMPLES / "feet").glob("*.stl"))[:2]
    bad = tmp_path / "bad.stl"
    bad.write_text("no mesh")
    cache = tmp_path / "measures.jsonl"
    common = ("--catalogue", stocked, "--json", "--cache", cache)
    first = footfit("coverage", scans[0], bad, *common)
    assert first.code == 3
    document = json.loads(first.out)
    assert [each["id"] for each in document["failed"]] == [str(bad)]
    lines = cache.read_text().splitlines()
    assert len(lines) == 2
    cache.write_text("\n".join([*lines, lines[1][:90]]))  # a crash tore the last line
    whole = footfit("coverage", *scans, *common)
    assert whole.code == 0, whole.err
    again = footfit("coverage", *scans, *common)
    alone = footfit("coverage", *scans, "--catalogue", stocked, "--json")
    assert whole.out == again.out == alone.out
    text = cache.read_text()
    assert str(scans[0].name) not in text
    assert len(text.splitlines()) == 4
    other = tmp_path / "notes.txt"
    other.write_text("mine")
    refused = footfit("coverage", *scans, "--catalogue", stocked, "--cache", other)
    assert refused.code == 2
    assert other.read_text() == "mine"


def test_measures_of_measure_are_a_table_of_feet(
    stocked: Path, tmp_path: Path, footfit: Footfit
) -> None:
    """What was measured in two steps has the verdict of the scans, but for what a CSV lacks."""
    scans = sorted((SAMPLES / "feet").glob("*.stl"))[:2]
    table = tmp_path / "measures.csv"
    assert footfit("measure", *scans, "--csv", table, "--wide").code == 0
    feet = coverage(table, stocked).to_dict()["feet"]
    assert [row["id"] for row in feet] == [str(path) for path in scans]
    scanned = coverage(list(map(str, scans)), stocked).to_dict()["feet"]
    for ours, theirs in zip(feet, scanned, strict=True):
        assert {name: ours[f"{name}_mm"] for name in NAMES} == pytest.approx(
            {name: theirs[f"{name}_mm"] for name in NAMES}
        )
        assert set(ours["not_judged"].split()) >= {"toes", "flare", "plan"}
    assert np.isfinite([row["margin"] for row in feet]).all()
