"""Drawings in true size, measured on the paper: bars, the bottom's length, tiles, layers."""

from __future__ import annotations

import re
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import footfit
from footfit.number_words import plain
from footfit.report.drawing.measure_words import LENGTH_WORDS, measure_words
from footfit.report.drawing.papers import CROSS_MM, PAPERS
from footfit.report.drawing.parts import Block
from tests import paper
from tests.conftest import ROOT, SAMPLES
from tools.last_specs import LastSpec
from tools.lasts import last_mesh
from tools.resting import at_rest

ON_PAPER_MM = 0.2
"""What a drawing must keep: a bar was off by .001 mm at most, a bottom's length by .02."""
PRINTED_MM = 0.002
"""SVG and DXF hold numbers: they are rounded to .001 mm."""
FOOT = SAMPLES / "feet" / "mh007_L.stl"
LASTS2 = ROOT.parent / "shared" / "tools" / "lasts2.py"
FIXED_DAY = "2451545.0"
"""1 January 2000: a drawing has no date of its own."""
COARSE = {"rings": 110, "segments": 80}
OWN = {
    "flat": LastSpec(heel_height_mm=4.0, level_tread=True, **COARSE),
    "heel 25": LastSpec(length_mm=262.0, **COARSE),
    "heel 60": LastSpec(length_mm=245.0, heel_height_mm=60.0, toe_shape="pointed", **COARSE),
    "heel 90": LastSpec(length_mm=250.0, heel_height_mm=90.0, level_tread=True, **COARSE),
    "child, left": LastSpec(length_mm=155.0, heel_height_mm=8.0, side="left", **COARSE),
    "men's 48": LastSpec(length_mm=327.0, toe_shape="square", heel_height_mm=30.0, **COARSE),
}


@cache
def drawn(name: str):
    """A last of `OWN`, drawn."""
    return footfit.drawing(last_mesh(OWN[name]), units="mm")


def bottom_length_mm(drawing) -> float:
    """The measure, as `measure` gives it."""
    return drawing.value_of("bottom_length").measured.value


@pytest.mark.parametrize("name", OWN)
def test_a_printed_last_measures_what_it_should(name: str) -> None:
    drawing = drawn(name)
    assert drawing.missing == ()
    sheets = paper.pages(footfit.drawing_file(drawing), "bottom, laid flat")
    check_sheets(sheets)
    assert paper.outline_mm(sheets)[1] == pytest.approx(bottom_length_mm(drawing), abs=ON_PAPER_MM)


def check_sheets(sheets: list[paper.Page]) -> None:
    """Every paper has its bars, its words, its name and the size of A4."""
    for sheet in sheets:
        assert paper.bars_mm(sheet) == pytest.approx((100.0, 100.0), abs=ON_PAPER_MM)
        assert paper.WORDS in sheet.text
        assert sheet.size_mm == pytest.approx((210.0, 297.0), abs=0.001)  # of a float in points
    names = [sheet.place for sheet in sheets]
    assert names == sorted(set(names))
    grid = (1 + max(row for row, _ in names), 1 + max(column for _, column in names))
    assert {sheet.grid for sheet in sheets} == {grid}
    count = len(sheets)
    assert [sheet.number for sheet in sheets] == [(at + 1, count) for at in range(count)]
    assert not any(re.search(r"\bA[0-5]\b", sheet.text) for sheet in sheets)  # a paper's size


def test_a_large_last_crosses_borders_between_papers() -> None:
    """So the test above has measured across a border, and not only within one paper."""
    sheets = paper.pages(footfit.drawing_file(drawn("men's 48")), "bottom, laid flat")
    window_mm = 297.0 - 2 * paper.MARGIN
    assert bottom_length_mm(drawn("men's 48")) > window_mm
    assert len(sheets) > 3


@pytest.mark.parametrize("heel_mm", [15.0, 80.0])
def test_a_last_of_the_second_family_measures_what_it_should(heel_mm: float) -> None:
    if not LASTS2.is_file():
        pytest.skip("../shared/tools/lasts2.py is not here; the project's own lasts are tested")
    sys.path.insert(0, str(LASTS2.parent))
    import lasts2

    mesh = lasts2.mesh(lasts2.Last2(length=262.0, heel_height=heel_mm), n_long=120, n_round=72)
    drawing = footfit.drawing((at_rest(np.asarray(mesh.vertices))[0], mesh.faces), units="mm")
    sheets = paper.pages(footfit.drawing_file(drawing), "bottom, laid flat")
    check_sheets(sheets)
    assert paper.outline_mm(sheets)[1] == pytest.approx(bottom_length_mm(drawing), abs=ON_PAPER_MM)


def test_what_a_lid_closes_is_not_drawn() -> None:
    """A foot whose top was not scanned, and which a program closed with flat faces."""
    case = ROOT.parent / "shared" / "cases" / "nodorsum.stl"
    if not case.is_file():
        pytest.skip("../shared/cases/nodorsum.stl is not here")
    drawing = footfit.drawing(case, foot=True)
    assert set(drawing.missing) == {"arch", "instep", "waist", "ball", "toes"}
    assert drawing.has_rim
    text = " ".join(sheet.text for sheet in paper.pages(footfit.drawing_file(drawing), "plan"))
    assert "nothing was scanned there" in " ".join(text.split())
    assert not footfit.drawing(FOOT, foot=True).has_rim


def test_a_printed_foot_is_as_long_as_its_mesh() -> None:
    drawing = footfit.drawing(FOOT, foot=True)
    sheets = paper.pages(footfit.drawing_file(drawing), "plan")
    check_sheets(sheets)
    extent_mm = drawing.alignment.extent_mm
    assert paper.outline_mm(sheets)[1] == pytest.approx(extent_mm, abs=ON_PAPER_MM)


def test_the_svg_and_the_dxf_say_the_same_as_the_paper() -> None:
    for name in ("heel 60", "men's 48", "child, left"):
        drawing = drawn(name)
        length_mm = bottom_length_mm(drawing)
        for read, kind in ((paper.svg, "svg"), (paper.dxf, "dxf")):
            vectors = read(footfit.drawing_file(drawing, kind))
            assert np.ptp(vectors.outlines[0][:, 1]) == pytest.approx(length_mm, abs=PRINTED_MM)
            assert sorted(vectors.bars_mm) == [(0.0, pytest.approx(100)), (pytest.approx(100), 0.0)]
            assert any(paper.WORDS in words for words in vectors.words)
            assert len(vectors.outlines) == len(drawing.views) == 9


def test_the_svg_is_in_mm() -> None:
    root = paper.svg(footfit.drawing_file(drawn("heel 25"), "svg")).about
    width, height = (root.get(name).removesuffix("mm") for name in ("width", "height"))
    assert root.get("viewBox") == f"0 0 {width} {height}"
    assert root.get("width").endswith("mm")
    assert root.get("height").endswith("mm")
    lines = root.iter(paper.SPACE + "polygon")
    assert {(line.get("stroke-width"), line.get("id")) for line in lines} == {("0.25", None)}
    names = [line.get("class") for line in root.iter(paper.SPACE + "polygon")]
    assert names == [view.name for view in drawn("heel 25").views]


def test_the_dxf_is_plain_and_in_mm_on_the_layers_of_shoe_cad() -> None:
    read = paper.dxf(footfit.drawing_file(drawn("heel 25"), "dxf"))
    document = read.about
    assert document.header["$INSUNITS"] == 4
    assert "units: mm, scale 1:1" in read.words
    space = document.modelspace()
    layers = {
        kind: {entity.dxf.layer for entity in space.query(kind)} for kind in ("LWPOLYLINE", "TEXT")
    }
    assert layers == {"LWPOLYLINE": {"1", "8"}, "TEXT": {"15"}}
    assert all(line.closed for line in space.query('LWPOLYLINE[layer=="1"]'))
    assert not space.query("INSERT")


def test_a_drawing_says_every_measure_its_uncertainty_the_file_and_the_pair() -> None:
    drawing = drawn("heel 60")
    words = paper.svg(footfit.drawing_file(drawing, "svg")).words
    text = " ".join(words)
    for measure in drawing.measures:
        assert measure.definition in words
        assert measure_words(measure.name, "last") in words
    assert re.sub(r"\s", "", drawing.alignment.info.sha256) in re.sub(r"\s", "", text)
    assert "total ±" in words
    spring, resting = (
        drawing.value_of(name).measured.value for name in ("toe_spring_tip", "toe_spring")
    )
    assert f"toe spring at the tip {plain(spring)} mm are a pair" in text
    assert plain(resting) != plain(spring)
    assert LENGTH_WORDS in text
    assert "girth 2, length 1.5, width 1" in text
    assert "right last" in text


def test_a_millimetre_of_heel_takes_from_the_spring_at_the_tip_what_the_sheet_says() -> None:
    mesh = last_mesh(OWN["heel 60"])
    both = [footfit.drawing(mesh, units="mm", heel_height_mm=mm) for mm in (59.0, 61.0)]
    texts = [" ".join(paper.svg(footfit.drawing_file(each, "svg")).words) for each in both]
    words = r"1 mm more of heel is ([\d.]+) mm less of spring there"
    said = np.mean([float(re.search(words, text)[1]) for text in texts])
    names = ("heel_height", "toe_spring_tip")
    heels, springs = ([each.value_of(name).measured.value for each in both] for name in names)
    less = (springs[0] - springs[1]) / (heels[1] - heels[0])
    assert less == pytest.approx(said, abs=0.02)  # measured .013: the tread is round


def test_the_same_shape_gives_the_same_bytes() -> None:
    for kind in ("pdf", "svg", "dxf"):
        first, second = (footfit.drawing_file(drawn("heel 25"), kind) for _ in range(2))
        assert first == second
        assert not re.search(rb"CreationDate|ModDate|Producer", first)
    words = footfit.drawing_file(drawn("heel 25"), "dxf").decode("cp1252").splitlines()
    dates = [
        words[row + 2] for row, word in enumerate(words) if re.fullmatch(r"\$TDU?\w+ATE", word)
    ]
    assert dates == [FIXED_DAY] * 4


def test_a_left_last_is_the_mirror_image_of_a_right_one() -> None:
    spec = OWN["heel 25"]
    vertices, faces = last_mesh(spec)
    left = footfit.drawing((vertices * (1.0, -1.0, 1.0), faces[:, ::-1]), units="mm")
    assert left.alignment.side.side == "left"
    for ours, other in zip(drawn("heel 25").views, left.views, strict=True):
        sign = (1.0, 1.0) if ours.name == "side" else (-1.0, 1.0)
        low, high = np.sort(np.array(other.bounds_mm) * sign, axis=0)
        # The pose search has passed on some rounding; the file of a mesh is read in float64.
        assert low == pytest.approx(ours.bounds_mm[0], abs=0.01)
        assert high == pytest.approx(ours.bounds_mm[1], abs=0.01)


@pytest.mark.parametrize("name", ["a3", "letter", "roll"])
def test_other_papers(name: str) -> None:
    data = footfit.drawing_file(drawn("men's 48"), "pdf", name)
    sheets = paper.pages(data, "bottom, laid flat")
    for sheet in sheets:
        assert paper.bars_mm(sheet) == pytest.approx((100.0, 100.0), abs=ON_PAPER_MM)
    if name == "roll":
        assert len(sheets) == 1
        return
    assert sheets[0].size_mm == pytest.approx(
        (PAPERS[name].width_mm, PAPERS[name].height_mm), abs=0.001
    )


def test_no_block_covers_another() -> None:
    from footfit.report.drawing.layout import layout

    for name in OWN:
        for kind in ("a4", "roll"):
            laid = layout(drawn(name), PAPERS[kind])
            boxes = [np.concatenate(block.bounds) for block in laid.blocks]
            for one, box in enumerate(boxes):
                for other in boxes[one + 1 :]:
                    apart = (box[2:] <= other[:2]) | (other[2:] <= box[:2])
                    assert apart.any(), (name, kind)


def test_a_block_is_whole_on_the_papers_that_show_it() -> None:
    from footfit.report.drawing.layout import layout

    laid = layout(drawn("men's 48"), PAPERS["a4"])
    width, height = PAPERS["a4"].window_mm
    for block, tiles in zip(laid.blocks, laid.shown, strict=True):
        low, high = Block(block.lines, block.words).bounds
        corners = np.array([tile.top_left_mm(PAPERS["a4"]) for tile in tiles])
        assert corners[:, 0].min() <= low[0]
        assert corners[:, 0].max() + width >= high[0]
        assert corners[:, 1].max() >= high[1]
        assert corners[:, 1].min() - height <= low[1]


def test_no_cross_lies_on_words() -> None:
    from footfit.report.drawing.layout import layout

    drawings = [drawn(name) for name in OWN] + [footfit.drawing(FOOT, foot=True)]
    for paper_name in ("a4", "a3", "letter"):
        for drawing in drawings:
            laid = layout(drawing, PAPERS[paper_name])
            for tile in laid.tiles:
                body, furniture = laid.sheet(tile)
                sizes = [np.ptp(line.points, axis=0).max() for line in furniture.lines]
                ends = np.array([line.points for line in furniture.lines])
                ends = ends[np.isclose(sizes, 2.0 * CROSS_MM)]
                assert len(ends) == 8
                low, high = ends.min(axis=1), ends.max(axis=1)
                for words in (*body.words, *furniture.words):
                    start, end = words.corners
                    over = (low < end).all(axis=1) & (high > start).all(axis=1)
                    assert not over.any(), (words.text, paper_name, tile)


def test_a_sheet_says_its_number_and_where_it_lies() -> None:
    """A name such as A3 would read like the size of a paper."""
    sheets = paper.pages(footfit.drawing_file(drawn("men's 48")), "plan")
    assert len(sheets) > 3
    assert sheets[1].number == (2, len(sheets))
    assert "lay the crosses of the sheets" in " ".join(sheet.text for sheet in sheets)
    (roll,) = paper.pages(footfit.drawing_file(drawn("flat"), "pdf", "roll"), "plan")
    assert roll.number == (1, 1)
    assert "row 1" not in roll.text


def test_what_cannot_be_drawn_is_refused(tmp_path: Path) -> None:
    from footfit.errors import BadOption, OtherKind

    with pytest.raises(OtherKind, match="add --foot"):
        footfit.draw_last(FOOT)
    with pytest.raises(OtherKind, match="leave --foot out"):
        footfit.draw_last(last_mesh(OWN["flat"]), foot=True, units="mm")
    with pytest.raises(BadOption, match="pdf or svg or dxf"):
        footfit.drawing_file(drawn("flat"), "png")
    with pytest.raises(BadOption, match="one sheet"):
        footfit.drawing_file(drawn("flat"), "svg", "a3")
    with pytest.raises(BadOption, match="no paper"):
        footfit.drawing_file(drawn("flat"), "pdf", "a5")
