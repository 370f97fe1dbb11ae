"""One length: every command reports the measured length of one shape, to the same digit."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import RenderableType

from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.measure import measured_scan
from footfit.pipeline.scan.reading import aligned_source
from footfit.report.terminal.catalogue_tables import list_lasts_table, show_last_table
from footfit.report.terminal.match_tables import match_table
from footfit.report.terminal.scan_tables import align_table, terminal_text
from footfit.results import Library, Measure, Measured, StoredLast
from footfit.results.values import MILLIMETRE_DIGITS
from tests import answers
from tests.bounds import printed
from tests.comparisons import comparison
from tests.conftest import SAMPLES, Footfit

FOOT, LAST = SAMPLES / "feet" / "mh008_R.stl", SAMPLES / "lasts" / "derby-41.stl"


@pytest.fixture(scope="module")
def lengths_mm() -> dict[str, float]:
    """The measure ``length`` of the two shapes."""
    scans = [
        measured_scan(aligned_source(Source(str(path)), ReadingOptions())) for path in (FOOT, LAST)
    ]
    lengths = [m.measured.value or 0.0 for scan in scans for m in scan.measures[:1]]
    return dict(zip(("foot", "last"), lengths, strict=True))


def test_every_document_says_the_measured_length(
    lengths_mm: dict[str, float], stocked: Path, footfit: Footfit
) -> None:
    foot, last = (round(mm, 3) for mm in lengths_mm.values())
    align = footfit("align", FOOT, "--json").document
    flare = footfit("flare", FOOT, "--json").document
    for document in (align, flare):
        assert document["length_mm"] == foot
        # the outermost vertex lies beyond the steadied end; measured: 0.33 mm
        assert foot + 0.17 < document["extent_mm"] < foot + 0.66
    compare = footfit("compare", FOOT, "derby-41", "--catalogue", stocked, "--json").document
    difference = pytest.approx(last - foot, abs=3 * printed(MILLIMETRE_DIGITS))
    assert compare["length_mm"] == {"foot": foot, "last": last, "difference": difference}
    shown = footfit("show-last", "derby-41", "--catalogue", stocked, "--json").document
    assert shown["length_mm"] == shown["measures"]["length"]["value"] == last
    listed = footfit("list-lasts", "--catalogue", stocked, "--json").document["lasts"]
    assert [one["length_mm"] for one in listed if one["last"] == "derby-41"] == [last]
    match = footfit("match", FOOT, "--catalogue", stocked, "--json").document
    assert match["feet"][0]["measures"]["length"]["value"] == foot
    rows = csv.DictReader(
        io.StringIO(footfit("list-lasts", "--catalogue", stocked, "--csv", "-").out)
    )
    assert [float(row["length_mm"]) for row in rows if row["last"] == "derby-41"] == [last]


def test_every_table_says_the_measured_length(
    lengths_mm: dict[str, float], stocked: Path, footfit: Footfit
) -> None:
    foot, last = (f"{lengths_mm[name]:.1f}" for name in ("foot", "last"))
    for command in ("align", "flare"):
        assert re.search(rf"length +{re.escape(foot)} mm", footfit(command, FOOT).out)
    assert f"{foot} mm long" in footfit("match", FOOT, "--catalogue", stocked).out
    compare = footfit("compare", FOOT, "derby-41", "--catalogue", stocked).out
    assert f"foot {foot} mm, last {last} mm" in compare
    shown = footfit("show-last", "derby-41", "--catalogue", stocked).out
    assert re.search(rf"length +{re.escape(last)} mm", shown)
    listed = footfit("list-lasts", "--catalogue", stocked).out
    assert re.search(rf"derby-41 .* {re.escape(last)} ", listed)


OPEN = Measured(None, reason="the surface is open at the toes")


def test_a_lasts_length_that_is_not_known_is_no_number_anywhere() -> None:
    rows = (Measure("length", OPEN, "length/2"),)
    cut = replace(answers.record("cut"), measures=rows)
    library = Library((cut,), 1, None)
    (entry,) = library.to_dict()["lasts"]
    assert (entry["length_mm"], entry["label_check"]) == (None, None)
    assert entry["extent_mm"] == round(cut.extent_mm, 3)
    (row,) = library.rows()
    assert (row["length_mm"], row["size_by_length"], row["label_flagged"]) == (None, None, None)
    (line,) = [line for line in text_of(list_lasts_table(library)) if line.startswith(" cut ")]
    assert f"{cut.extent_mm:.1f}" not in line
    assert re.search(r"right +- ", line)
    shown = text_of(show_last_table(StoredLast(cut, None)))
    assert any(re.match(r"length +not measured \(the surface is open", line) for line in shown)


def test_a_foots_length_that_is_not_known_gives_no_size_and_no_difference() -> None:
    foot = answers.foot()
    alignment = replace(foot.aligned.alignment, length=OPEN)
    cut = replace(foot, aligned=replace(foot.aligned, alignment=alignment))
    answer = answers.match((cut,), by="flare")
    assert set(answer.to_dict()["feet"][0]["sizes"].values()) == {None}
    words = "\n".join(text_of(match_table(answer)))
    assert "right foot, length not measured, flare" in words
    assert "sizes:" not in words
    document = replace(comparison(), foot=cut).to_dict()
    assert document["length_mm"] == {"foot": None, "last": 272.0, "difference": None}
    assert alignment.to_dict()["length_mm"] is None
    assert "not measured (the surface is open at the toes)" in "\n".join(
        text_of(align_table(alignment))
    )


def text_of(table: RenderableType) -> list[str]:
    """The lines of a table on a terminal of 120 columns."""
    return terminal_text(table, 120).splitlines()
