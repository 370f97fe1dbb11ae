"""A comparison's document, tables, files and page: they say the same, and nothing hidden."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from footfit.report.csv import csv_text
from footfit.report.json import json_line
from footfit.report.page.compare_page import compare_page
from footfit.report.page.rendering import picture_data
from footfit.report.pictures import figures
from footfit.report.pictures.drawn_outlines import own_side
from footfit.report.pictures.figures import svg_text
from footfit.report.pictures.heat import heat_colours
from footfit.report.pictures.heat_figure import heat_bytes, heat_figure, heat_image
from footfit.report.pictures.section_figure import ACROSS, STRIP, section_figure
from footfit.report.pictures.shading import VIEWS, Frame
from footfit.report.terminal.comparison_tables import compare_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.report.wording.comparison_words import swing_words
from footfit.results import Comparison, Notice
from tests import browsing, shapes
from tests.bounds import ROUNDING
from tests.comparisons import comparison
from tests.reading import scan_from_bytes


@cache
def page_of() -> str:
    return compare_page(comparison())


@pytest.fixture
def unpictured(monkeypatch) -> None:
    """Pages without pictures, for tests of the words alone."""
    monkeypatch.setattr(figures, "svg_text", lambda _: "")


needs_browser = pytest.mark.skipif(browsing.BROWSER is None, reason=browsing.MISSING)


def test_the_terminal_says_what_the_json_says_within_80_columns():
    document, text = comparison().to_dict(), terminal_text(compare_table(comparison()))
    assert max(len(line) for line in text.splitlines()) <= 80
    for name, zone in document["zones"].items():
        line = next(line for line in text.splitlines() if line.strip().startswith(name))
        assert f"{zone['mean_mm']:+.1f}" in line
        assert f"{zone['p05_mm']:+.1f}" in line
    for section in document["sections"]:
        lines = text.split("Sections", 1)[1].splitlines()
        line = next(x for x in lines if x.strip().startswith(section["station"] + " "))
        for size in section["sizes"].values():
            value = size["difference"]["value"]
            assert (f"{value:+.1f}" if value is not None else "-") in line
    assert json_line(document)


@pytest.mark.parametrize(("delta_deg", "words"), [(0.04, "outer side"), (0.06, "more inward")])
def test_a_flare_that_reads_the_same_turns_nothing(monkeypatch, delta_deg, words):
    shown = comparison()
    swung = replace(shown, placement=replace(shown.placement, swing_mm=-0.3))
    monkeypatch.setattr(Comparison, "flare_delta_deg", delta_deg)
    assert words in swing_words(swung)


def test_the_csv_has_a_row_for_every_size_and_every_zones_figure():
    rows = list(csv.DictReader(io.StringIO(csv_text(Comparison, [comparison()]))))
    assert tuple(rows[0]) == Comparison.columns
    document = comparison().to_dict()
    sizes = sum(len(section["sizes"]) for section in document["sections"])
    heel = 2 + len(document["heel"]["changes_mm"])  # the drop, the flare, the sizes
    whole = len(document["clearance_mm"]) + heel
    assert len(rows) == sizes + 7 * len(document["zones"]) + whole
    for row in rows:
        assert (row["difference"] == "") == bool(row["reason"])


@pytest.mark.usefixtures("unpictured")
def test_a_hostile_name_stays_a_name():
    name = "=cmd|'x'!A1<script>\x1b[31m"
    last = comparison().last
    hostile = replace(comparison(), last=replace(last, labels=replace(last.labels, name=name)))
    assert "\x1b" not in terminal_text(compare_table(hostile))
    rows = csv.DictReader(io.StringIO(csv_text(Comparison, [hostile])))
    assert next(iter(rows))["last"].startswith("'=")
    page = compare_page(hostile)
    assert page.count("<script>") == 1
    assert "&lt;script&gt;" in page


def test_the_coloured_mesh_reads_back_with_its_room():
    data = heat_bytes(comparison(), "ply")
    header = data[: data.index(b"end_header")].decode()
    assert "property float room_mm" in header
    assert "property uchar red" in header
    scan = scan_from_bytes(data, path=None, format="ply", units="mm")
    assert len(scan.faces) == len(comparison().faces)


def test_a_left_foots_files_are_of_the_left():
    right, left = (own_side(comparison(side, side))[0][0] for side in (False, True))
    assert np.allclose(right * [1.0, -1.0, 1.0], left)


def test_mirrored_pairs_have_the_same_room_and_a_mirrored_last_too():
    first = comparison()
    for other in (comparison(True, True), comparison(False, True), comparison(True, False)):
        assert np.allclose(
            first.clearance_mm, other.clearance_mm, atol=ROUNDING, rtol=0, equal_nan=True
        )
        assert other.zones == pytest.approx(first.zones) or all(
            abs(a.mean_mm - b.mean_mm) < 1e-6 for a, b in zip(first.zones, other.zones, strict=True)
        )
    assert not first.mirrored
    assert comparison(False, True).mirrored


def test_the_heat_picture_has_the_colour_of_each_place():
    vertices, faces = shapes.sphere(50.0, 3)
    room = np.where(vertices[:, 0] < 0.0, -9.0, 9.0)
    frame = Frame(-60.0, 60.0, -60.0, 60.0)
    image = heat_image(vertices @ VIEWS["from_above"].T, faces, room, frame, 120)
    tight, loose = (heat_colours(np.array([value]))[0] for value in (-9.0, 9.0))
    assert (
        np.abs(image[60, 30, :3] / image[60, 30, :3].max() - tight / tight.max()).max() < ROUNDING
    )
    assert (
        np.abs(image[60, 90, :3] / image[60, 90, :3].max() - loose / loose.max()).max() < ROUNDING
    )
    assert image[0, 0, 3] == 0.0
    area = image[..., 3].mean() * 120.0**2
    assert area == pytest.approx(np.pi * 50.0**2, rel=0.0065)  # measured 0.0043


def test_the_pictures_of_the_page_have_no_titles_of_their_own():
    for picture in (heat_figure, section_figure):
        assert picture_data(picture(comparison(), titled=False)) in page_of()


def test_only_a_strip_leaves_out_what_its_numbers_are():
    wide, strip = (
        [axes.get_xlabel() for axes in section_figure(comparison(), across).axes]
        for across in (ACROSS, STRIP)
    )
    assert all(words.startswith("last minus foot: ") for words in wide)
    assert not any("last minus foot" in words for words in strip)


def test_pictures_are_the_same_twice():
    assert svg_text(section_figure(comparison())) == svg_text(section_figure(comparison()))
    assert heat_bytes(comparison(), "png") == heat_bytes(comparison(), "png")


def test_the_page_is_the_same_twice_small_and_has_no_outside_address():
    page = page_of()
    assert page == compare_page(comparison())
    assert len(page.encode()) < 1_200_000  # measured 680 kB
    assert "http://" not in page
    assert "https://" not in page
    assert len(re.findall("<img alt=", page)) == 3


@pytest.mark.usefixtures("unpictured")
def test_a_warning_is_on_the_page():
    warned = replace(comparison(), warnings=(Notice("far_size", "no shoe for it"),))
    assert "no shoe for it" in compare_page(warned)


@needs_browser
def test_the_page_is_drawn_and_prints_on_two_sheets(tmp_path):
    page = page_of()
    seen = browsing.browse(page, tmp_path / "page")
    assert seen.console == ""
    assert seen.requests == []
    assert browsing.printed_sheets(page, tmp_path / "paper") in (1, 2)
