"""The customer's sheet: its words, its picture, one A4, and the options that write it."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest

import footfit as library
from footfit.api.files import MOST_LETTERS
from footfit.errors import BadOption
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.zones import ZONES
from footfit.pipeline.width.foot_width import foot_widths, survey_words
from footfit.report.page import sheet_page
from footfit.report.pictures.feet_figure import DrawnFoot, feet_figure
from footfit.report.wording import sheet_words
from footfit.results import FootFit, Measured, ZoneFit
from footfit.results.values import VERDICTS
from tests import answers, browsing
from tests.conftest import SAMPLES, Footfit
from tests.readers import tree
from tests.test_readback import CASES

DAY = date(2026, 11, 28)
HOSTILE = "<script>alert(1)</script>\" onload='x' & \x1b\n"
FEET = (SAMPLES / "feet" / "mh007_L.stl", SAMPLES / "feet" / "mh007_R.stl")


def sheet_of(match, usual_mm=None, **head):
    match = replace(match, widths=foot_widths(match.feet, usual_mm))
    meshes = [answers.tube(foot.length_mm, left=i == 0) for i, foot in enumerate(match.feet)]
    return sheet_page.sheet_page(match, meshes, day=DAY, survey=survey_words(), **head)


def text_of(page: str) -> str:
    return tree(page).one("body").text


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sheet without its picture."""
    monkeypatch.setattr(sheet_page, "feet_figure", lambda _: None)
    monkeypatch.setattr(sheet_page, "picture_data", lambda _: "")


# ------------------------------------------------------------------ words


def fit_of(side=None, **verdicts) -> FootFit:
    """A fit with these verdicts by zone, each with a score whose sign says tight or loose."""
    zones = tuple(
        ZoneFit(name, ZONES[name].unit, Measured(score), 0.0, score, verdict, True)
        for name, (verdict, score) in verdicts.items()
    )
    return FootFit(side, "good", zones)


def words_of(*fits: FootFit) -> str:
    candidate = answers.match().candidates[0]
    room = (("length", Measured(12.34)),)
    return sheet_words.fit_words(replace(candidate, fits=fits, clearance_mm=room))


def test_every_zone_of_a_profile_has_a_place() -> None:
    assert set(sheet_words.PLACES) >= set(ZONES)


def test_the_sentence_names_the_worst_of_each_place() -> None:
    fit = fit_of(
        length=("good", 0.2),
        ball_girth=("acceptable", 1.4),
        ball_width=("poor", -2.5),
        heel_width=("acceptable", 1.2),
        instep_girth=("good", 0.9),
    )
    room = "about 12.3 mm of room in front of the toes"
    assert words_of(fit) == f"{room}; too narrow at the ball; a little wide at the heel"
    assert words_of(fit_of(length=("good", 0.1))) == f"{room}; good everywhere else"


def test_the_sentence_says_which_foot_if_only_one_has_the_fault() -> None:
    left = fit_of("left", length=("good", 0.1), ball_girth=("poor", -2.0))
    right = fit_of("right", length=("good", 0.1), ball_girth=("good", -0.5))
    assert words_of(left, right).endswith("too tight at the ball (left foot)")
    both = fit_of("right", length=("good", 0.1), ball_girth=("poor", -2.1))
    assert words_of(left, both).endswith("too tight at the ball")


def test_the_sentence_agrees_with_the_verdict() -> None:
    """The worst degree of the sentence and the worst mark of the picture are the verdict."""
    for number, match in enumerate(CASES.values()):
        for candidate in match.candidates:
            if not candidate.fits:
                continue
            marks = {v for fit in candidate.fits for v in sheet_words.place_verdicts(fit).values()}
            worst = max(marks, key=sheet_words.rank)
            words = sheet_words.fit_words(candidate)
            if worst == "good":
                assert "a little" not in words, number
                assert "too " not in words, number
            else:
                assert sheet_words.DEGREES[worst] in words, (number, words)


def test_what_was_not_judged_is_said_where_no_fault_is_known() -> None:
    candidate = answers.match().candidates[0]
    fit = fit_of(length=("good", 0.1), ball_width=("good", 0.2), heel_width=("poor", 3.0))
    unknown = ("ball_girth", "short_heel_girth")
    words = sheet_words.fit_words(replace(candidate, fits=(fit,), not_judged=unknown))
    assert words.endswith("too wide at the heel; not fully judged: the ball")


def test_the_degrees_rise_with_the_verdict() -> None:
    assert list(sheet_words.DEGREES) == list(VERDICTS)


@pytest.mark.usefixtures("undrawn")
def test_no_zone_table_no_plan_and_no_spread_is_on_the_sheet() -> None:
    for match in CASES.values():
        if match.by == "fit":
            text = text_of(sheet_of(match))
            assert "±" not in text
            assert "plan" not in text.lower()
            assert "profile" not in text.lower()


@pytest.mark.usefixtures("undrawn")
def test_the_shops_size_system_comes_first() -> None:
    page = tree(sheet_of(replace(CASES["one foot"], size_system="uk"))).one("body")
    sizes = next(part for part in page.every("div") if part.one("h2").text == "Your size")
    assert sizes.one("p").text.startswith("UK ")
    assert "EU " in sizes.every("p")[-1].text


@pytest.mark.usefixtures("undrawn")
def test_a_child_is_told_that_there_is_no_survey_of_children() -> None:
    text = text_of(sheet_of(CASES["one foot"], fit_profile("child").usual_length_mm))
    assert text.count("the survey has no children") == 2
    assert "wider than" not in text


@pytest.mark.usefixtures("undrawn")
def test_nothing_fits_is_an_answer() -> None:
    text = text_of(sheet_of(CASES["nothing fits"]))
    assert "No shoe here fits." in text
    assert f"The nearest is {CASES['nothing fits'].nearest[0].last}" in text
    assert "No shoe here could be judged." in text_of(sheet_of(CASES["nothing is near"]))


@pytest.mark.usefixtures("undrawn")
def test_feet_within_a_millimetre_are_equally_long() -> None:
    feet = (answers.foot("l.stl", left=True, length_mm=259.2), answers.foot("r.stl"))
    assert "Both feet are equally long." in text_of(sheet_of(replace(CASES["a pair"], feet=feet)))
    feet = (answers.foot("l.stl", left=True, length_mm=258.9), answers.foot("r.stl"))
    text = text_of(sheet_of(replace(CASES["a pair"], feet=feet)))
    assert "The right foot is 1.1 mm longer." in text


# ------------------------------------------------------------------ the page


@pytest.mark.usefixtures("undrawn")
def test_every_outside_string_is_escaped_and_no_script_runs() -> None:
    match = CASES["a pair"]
    spoilt = [replace(one, last=HOSTILE, style=HOSTILE, size=HOSTILE) for one in match.candidates]
    page = sheet_of(replace(match, candidates=tuple(spoilt)), title=HOSTILE, customer=HOSTILE)
    assert "<script" not in page
    assert "\x1b" not in page
    nodes = list(tree(page).walk())
    assert not [node for node in nodes if any(name.startswith("on") for name in node.shown)]
    assert text_of(page).count("<script>alert(1)</script>") >= 6  # measured 8
    policy = next(n.shown["content"] for n in nodes if n.shown.get("http-equiv"))
    assert "default-src 'none'" in policy
    assert "script-src" not in policy
    assert not re.search(r"https?://", page)


def test_the_sheet_is_the_same_twice() -> None:
    first = sheet_of(CASES["a pair"])
    assert sheet_of(CASES["a pair"]) == first
    assert len(first.encode()) < 400_000  # measured 170 kB for a scanned pair


def test_the_picture_shows_each_foot_on_its_own_side_and_marks_the_verdicts() -> None:
    feet = [
        DrawnFoot(answers.tube(250.0, left=side == "left"), side, 250.0, verdicts)
        for side, verdicts in (("left", {"ball": "poor"}), ("right", {"heel": "good"}))
    ]
    figure = feet_figure(feet)
    marks = [len(axes.collections) for axes in figure.axes]
    assert marks == [1, 0, 1, 0]
    spans = [axes.get_ylim()[1] - axes.get_ylim()[0] for axes in figure.axes]
    assert spans[0] == pytest.approx(2 * spans[1])  # two side views stand beside one from above


needs_browser = pytest.mark.skipif(browsing.BROWSER is None, reason=browsing.MISSING)


def longest_sheet() -> str:
    """A pair with everything wrong, not all of it judged, and long names everywhere."""
    match = CASES["a pair"]
    worst = [
        fit_of(side, **{name: ("poor", sign * (1.0 + i)) for i, name in enumerate(ZONES)})
        for side, sign in (("left", -1.0), ("right", 1.0))
    ]
    lasts = tuple(
        replace(
            one,
            last=f"{one.last}-" + "long-name-" * 4,
            style="a style with a long name",
            verdict="poor",
            fits=tuple(worst),
            not_judged=("ball_girth", "instep_girth", "heel_width", "length"),
        )
        for one in match.candidates
    )
    names = {"title": "W" * MOST_LETTERS, "customer": "M" * MOST_LETTERS}
    return sheet_of(replace(match, candidates=lasts), **names)


@needs_browser
def test_the_sheet_prints_on_one_page(tmp_path: Path) -> None:
    sheets = {
        "one": sheet_of(CASES["one foot"]),
        "two": sheet_of(CASES["a pair"], title="Shoes", customer="Ana"),
        "none": sheet_of(CASES["nothing fits a pair"]),
        "long": longest_sheet(),
    }
    printed = {
        name: browsing.printed_sheets(page, tmp_path / name) for name, page in sheets.items()
    }
    assert printed == dict.fromkeys(sheets, 1)


@needs_browser
def test_a_browser_shows_the_sheet_in_any_width_and_complains_of_nothing(tmp_path: Path) -> None:
    for name, width in (("screen", 1280), ("telephone", 390)):
        shown = browsing.browse(longest_sheet(), tmp_path / name, size=(width, 2600))
        assert shown.console == ""
        assert shown.requests == []
        assert shown.picture.shape[1] == width
        assert np.all(shown.picture[:, -6:] == 1.0)  # nothing runs out of the page


# ------------------------------------------------------------------ options


def test_the_options_write_page_and_sheet_and_keep_nothing(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    sheet, page = tmp_path / "sheet.html", tmp_path / "page.html"
    before = stocked.read_bytes()
    command = ("match", *FEET, "--pair", "--catalogue", stocked, "--sheet", sheet, "--html", page)
    run = footfit(*command, "--title", "Shoes", "--customer", "Ana Silva", "--json")
    assert run.code == 0
    for path in (sheet, page):
        assert "Ana Silva" in text_of(path.read_text(encoding="utf-8"))
        assert tree(path.read_text(encoding="utf-8")).one("h1").text == "Shoes"
    assert "Ana Silva" not in run.out + run.err
    assert stocked.read_bytes() == before
    again = footfit(*command)
    assert again.code == 2
    assert "--force" in again.last_error
    page.unlink()
    assert footfit(*command).code == 2  # the sheet is in the way, so the page is not written
    assert not page.exists()
    assert footfit(*command, "--force").code == 0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--sheet", "s.html", "--by", "flare"), "--sheet goes with --by fit"),
        (("--title", "Shoes"), "go with --html or --sheet"),
        (("--sheet", "s.html", "--title", "x" * (MOST_LETTERS + 1)), "at most 80 letters, not 81"),
        (("--sheet", "s.html", "--html", "./s.html"), "is named for two outputs"),
        (("--sheet", "s.html", "--csv", "s.html"), "is named for two outputs"),
        (("--sheet", "s.pdf"), "html"),
    ],
)
def test_what_does_not_go_together_is_refused_before_any_work(
    footfit: Footfit, stocked: Path, tmp_path: Path, monkeypatch, options, words: str
) -> None:
    monkeypatch.chdir(tmp_path)
    run = footfit("match", FEET[0], "--catalogue", stocked, *options)
    assert run.code == 2
    assert words in run.last_error
    assert not list(tmp_path.glob("s.*"))


def test_a_foot_without_its_toes_has_no_sheet(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    scan = library.align(FEET[1])
    x = scan.vertices_mm[scan.faces, 0].max(axis=1)
    cut = tmp_path / "cut.stl"
    cut.write_bytes(encoded_mesh(scan.vertices_mm, scan.faces[x < 0.85 * x.max()], "stl"))
    sheet = tmp_path / "sheet.html"
    run = footfit("match", cut, "--catalogue", stocked, "--sheet", sheet)
    assert run.code == 5
    assert not sheet.exists()


def test_the_library_makes_the_sheet_of_a_match_by_fit_alone() -> None:
    match = CASES["by flare"]
    with pytest.raises(BadOption, match="goes with --by fit, not flare"):
        library.sheet(match)
    with pytest.raises(BadOption, match="--customer takes at most"):
        library.sheet(CASES["one foot"], customer="x" * 200)
