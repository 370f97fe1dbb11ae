"""The page of a match: one file, a strict policy, every name escaped; in a browser and on paper."""

from __future__ import annotations

import base64
import hashlib
import re
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser

import numpy as np
import pytest
from jinja2 import UndefinedError
from markupsafe import Markup

from footfit.pipeline.fit.match import matched
from footfit.report.page.match_page import match_page
from footfit.report.page.rendering import templates
from footfit.report.pictures import figures
from footfit.results import LastRecord, Library, Measured, Notice
from tests import answers, browsing
from tests.comparisons import comparison

HOSTILE = "<script>alert(1)</script>\" onload='x' & \x1b\n"
NAMES = ("derby-42", "oxford-42", "trainer-42", "boot-42", "derby-43")


class Page(HTMLParser):
    """Tags with their attributes, and the text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.words.append(data)

    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def pair(**more):
    feet = (answers.foot("/home/someone/l.stl", left=True), answers.foot("C:\\feet\\r.stl"))
    return answers.match(feet, **more)


def lasts() -> tuple[LastRecord, ...]:
    return tuple(answers.record(name, 8.0 + i, 271.5 + i) for i, name in enumerate(NAMES))


def judged_match(feet=None):
    """An answer that the pipeline judged zone by zone."""
    feet = (answers.foot(),) if feet is None else feet
    return matched(feet, Library(lasts(), 12, "derby-42", (("too_long", 3), ("too_short", 4))))


@cache
def drawn(feet: int = 1, roomy: bool = False) -> str:
    """The page of one foot, or of two, with its pictures; ``roomy``: laid into every last."""
    sides = ((False, True),) if feet == 1 else ((True, True), (False, True))
    rooms = [comparison(*side, path=("r.stl", "l.stl")[side[0]]) for side in sides]
    match = judged_match() if feet == 1 else judged_match(pair().feet)
    if roomy:
        surfaces = answers.roomy_candidate().surfaces * feet
        lasts = tuple(replace(one, surfaces=surfaces) for one in match.candidates)
        match = replace(match, candidates=lasts)
    return match_page(match, {"derby-42": answers.tube(271.5)}, rooms)


@pytest.fixture
def unpictured(monkeypatch) -> None:
    """Pages without pictures, for tests of the words alone."""
    monkeypatch.setattr(figures, "svg_text", lambda _: "")


def test_the_page_is_the_same_twice() -> None:
    first = drawn()
    assert drawn.__wrapped__() == first
    assert len(first.encode()) < 1_200_000  # measured 670 kB


def test_the_policy_allows_the_pages_own_style_and_script_and_nothing_else() -> None:
    page = drawn()
    policy = next(
        a["content"]
        for tag, a in Page(page).tags
        if tag == "meta" and a.get("http-equiv") == "Content-Security-Policy"
    )
    for name in ("style", "script"):
        inside = re.search(f"<{name}>(.*?)</{name}>", page, re.DOTALL)[1]
        digest = base64.b64encode(hashlib.sha256(inside.encode()).digest()).decode()
        assert f"{name}-src 'sha256-{digest}'" in policy
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert "http" not in policy


def test_a_page_without_a_view_runs_nothing() -> None:
    page = match_page(answers.match())
    assert "<script" not in page
    assert "script-src" not in page
    assert "<canvas" not in page


def test_nothing_comes_from_outside_and_one_script_runs() -> None:
    page = drawn(2)
    tags = Page(page).tags
    assert [tag for tag, _ in tags].count("script") == 1
    assert [tag for tag, _ in tags].count("canvas") == 1
    for tag, attributes in tags:
        assert tag not in {"iframe", "link", "object", "embed", "form", "a"}
        assert not {name for name in attributes if name.startswith("on") or name == "style"}
        assert attributes.get("src", "data:").startswith("data:image/svg+xml;base64,") or not (
            attributes.get("src")
        )
    assert "http://" not in page
    assert "https://" not in page


def test_the_page_names_no_folder_of_the_machine() -> None:
    page = drawn(2)
    pictures = [
        base64.b64decode(found).decode("utf-8") for found in re.findall(r'base64,([^"]+)', page)
    ]
    assert len(pictures) == 8
    for text in (page, *pictures):
        assert "someone" not in text
        assert "C:" not in text
    assert "l.stl" in page
    assert "r.stl" in page


def test_every_outside_string_is_escaped() -> None:
    match = answers.match((answers.foot(HOSTILE.replace("/", "_")),), names=(HOSTILE,))
    spoilt = replace(match.candidates[0], why=HOSTILE, style=HOSTILE, tied_with=(HOSTILE,))
    match = replace(
        match,
        candidates=(spoilt,),
        rejected=((HOSTILE, 1),),
        reference=HOSTILE,
        profile=HOSTILE,
        warnings=(Notice("x", HOSTILE),),
    )
    last = comparison().last
    named = replace(last, labels=replace(last.labels, name=HOSTILE))
    page = Page(match_page(match, None, [replace(comparison(), last=named)]))
    assert [tag for tag, _ in page.tags].count("script") == 1
    assert not [a for _, attributes in page.tags for a in attributes if a.startswith("on")]
    assert page.text().count("<script>alert(1)</script>") >= 9  # measured 16
    assert "\x1b" not in page.text()


def test_a_template_shows_what_hides_and_refuses_what_is_not_there() -> None:
    template = templates().from_string("<b>{{ name }}</b>")
    assert template.render(name="<i>\u202e\n&") == "<b>&lt;i&gt;\\u202e\\n&amp;</b>"
    assert template.render(name=Markup("<i>\n</i>")) == "<b><i>\n</i></b>"
    with pytest.raises(UndefinedError):
        template.render()


def test_every_string_of_a_template_is_escaped() -> None:
    """No template switches the escaping off; markup comes from the templates alone."""
    environment = templates()
    names = environment.list_templates()
    assert len(names) > 10
    for name in names:
        source = environment.loader.get_source(environment, name)[0]
        assert not re.search(r"\|\s*safe\b|autoescape|Markup", source), name


def test_the_page_says_what_the_json_says() -> None:
    match = judged_match()
    text = Page(drawn()).text()
    for candidate in match.to_dict()["candidates"]:
        assert candidate["last"] in text
        assert f"{candidate['distance']:.2f}" in text
        assert f"{candidate['flare']['delta_deg']:+.1f}" in text
        room = candidate["clearance_mm"]["length"]
        assert f"{room['value']:+.1f} ± {room['sd']:.1f}" in text
        assert candidate["why"] in text
        for zone in candidate["fits"][0]["zones"].values():
            value = zone["clearance"]["value"]
            digits = 2 if zone["unit"] == "ratio" else 1
            assert value is None or f"{value:+.{digits}f}" in text
    assert "260.0 ± 0.4 mm" in text
    assert "+10.0 ± 0.2 degrees" in text
    assert "3 too long; 4 too short." in text
    for zone in comparison().zones:
        assert f"{zone.mean_mm:+.1f}" in text


@pytest.mark.usefixtures("unpictured")
def test_every_verdict_is_a_word_and_a_shape_beside_its_colour() -> None:
    lights = {"good": "●", "acceptable": "▲", "poor": "■", "reject": "✕"}
    match = judged_match()
    for verdict, shape in lights.items():
        shown = [replace(one, verdict=verdict) for one in match.candidates]
        page = match_page(replace(match, candidates=tuple(shown)))
        assert page.count(f"<i>{shape}</i> {verdict}") == len(shown) + 1  # the best one twice
    zones = [zone for fit in match.candidates[0].fits for zone in fit.zones]
    page = match_page(match)
    for zone in zones:
        mark = lights.get(zone.verdict or "", "–")
        assert f'title="{zone.verdict or "not judged"}">{mark}</i>' in page


@pytest.mark.usefixtures("unpictured")
def test_the_customers_sizes_come_first_and_the_asked_one_with_its_neighbours() -> None:
    text = Page(match_page(judged_match())).text()
    assert text.index("EU 41") < text.index("The lasts")
    asked = replace(judged_match(), size_system="uk")
    words = Page(match_page(asked)).text()
    assert "UK 7.5 between UK 7 and UK 8" in words
    assert words.index("UK 7.5") < words.index("EU 41")


@pytest.mark.usefixtures("unpictured")
def test_a_pair_says_how_the_feet_differ() -> None:
    feet = (answers.foot("l.stl", left=True, length_mm=258.0), answers.foot("r.stl"))
    text = Page(match_page(answers.match(feet))).text()
    assert "The feet differ by 2.0 mm in length" in text
    assert "differ" not in Page(match_page(answers.match())).text()


@pytest.mark.usefixtures("unpictured")
def test_nothing_fits_is_an_answer() -> None:
    nothing = answers.match(
        candidates=(), warnings=(Notice("nothing_fits", "no last has the length"),)
    )
    text = Page(match_page(nothing)).text()
    assert "No last fits." in text
    near = replace(nothing, nearest=answers.match().candidates[:3])
    words = Page(match_page(near)).text()
    assert "what they miss by" in words
    assert "anna.stl with the nearest lasts: derby-42, oxford-42, trainer-42." in words
    assert "no last has the length" in text


@pytest.mark.usefixtures("unpictured")
def test_a_search_by_flare_says_that_it_is_scale_free() -> None:
    assert "scale-free" in Page(match_page(answers.match(by="flare"))).text()


@pytest.mark.usefixtures("unpictured")
def test_what_is_not_measured_says_why() -> None:
    foot = answers.foot()
    reason = "the leg is cut at the instep"
    unknown = replace(foot.measures[0], name="instep_girth", measured=Measured(None, None, reason))
    foot = replace(foot, measures=(*foot.measures, unknown))
    text = Page(match_page(answers.match((foot,)))).text()
    assert f"Instep girth not measured ({reason})" in text


def test_every_picture_says_what_it_shows() -> None:
    images = [a for tag, a in Page(drawn(2)).tags if tag == "img"]
    assert len(images) == 8
    assert all(len(image["alt"]) > 50 for image in images)  # measured 99


needs_browser = pytest.mark.skipif(browsing.BROWSER is None, reason=browsing.MISSING)


@needs_browser
def test_a_browser_draws_the_page_and_complains_of_nothing(tmp_path) -> None:
    good = browsing.browse(drawn(2), tmp_path / "good")
    assert good.console == ""
    assert good.requests == []
    coloured = np.abs(good.picture[..., 0] - good.picture[..., 2]) > 0.15
    assert coloured.mean() > 0.018, "the pictures are not drawn"  # measured 0.029
    spoilt = drawn().replace("<h1>", "<h1 style='color:red' onclick='alert(1)'>")
    bad = browsing.browse(spoilt, tmp_path / "bad")
    assert "Content Security Policy" in bad.console


@needs_browser
def test_a_customer_prints_on_two_sheets(tmp_path) -> None:
    assert browsing.printed_sheets(drawn(), tmp_path / "one") in (1, 2)
    assert browsing.printed_sheets(drawn(2), tmp_path / "two") in (1, 2)
    assert browsing.printed_sheets(drawn(2, roomy=True), tmp_path / "roomy") in (1, 2)


@needs_browser
def test_a_telephone_shows_the_page_in_its_width(tmp_path) -> None:
    shown = browsing.browse(drawn(2, roomy=True), tmp_path / "narrow", size=(390, 5000)).picture
    assert shown.shape[1] == 390
    assert np.all(shown[:, :6] == 1.0)
    assert np.all(shown[:, -6:] == 1.0)  # what is wider scrolls in a box of its own


def test_the_room_in_every_last_is_on_the_page_where_it_was_asked_for():
    roomy = answers.roomy_candidate()
    asked = match_page(replace(answers.match(), candidates=(roomy,)))
    assert (
        "presses most on the inner side: up to 6.2 mm; loosest at the toes: up to 12.3 mm" in asked
    )
    assert "tight or loose on the foot" not in match_page(answers.match())
