"""One length: every command reports the measured length of one shape, to the same digit."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import pytest

from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.measure import measured_source
from tests.conftest import SAMPLES, Footfit

FOOT, LAST = SAMPLES / "feet" / "mh008_R.stl", SAMPLES / "lasts" / "derby-41.stl"


@pytest.fixture(scope="module")
def lengths_mm() -> dict[str, float]:
    """The measure ``length`` of the two shapes."""
    scans = [measured_source(Source(str(path)), ReadingOptions()) for path in (FOOT, LAST)]
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
        assert foot + 0.05 < document["extent_mm"] < foot + 0.8
    compare = footfit("compare", FOOT, "derby-41", "--catalogue", stocked, "--json").document
    difference = pytest.approx(last - foot, abs=0.0011)
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
