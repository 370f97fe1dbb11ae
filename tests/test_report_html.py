"""The page: one file, a strict policy, every name escaped, the same bytes; and in a browser."""

from __future__ import annotations

import base64
import hashlib
import re
import shutil
import subprocess
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import pytest

from footfit.report import documents, html
from footfit.report.html import match_report
from footfit.results import Measured, Notice
from tests import answers

HOSTILE = "<script>alert(1)</script>\" onload='x' & \x1b\n"
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")


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


@cache
def drawn(feet: int = 1) -> str:
    """The page of one foot, or of two, with its pictures."""
    return match_report(answers.match() if feet == 1 else pair(), {"derby-42": answers.tube(271.5)})


@pytest.fixture
def unpictured(monkeypatch) -> None:
    """Pages without pictures, for tests of the words alone."""
    monkeypatch.setattr(html, "_pictures", lambda *_: "")


def test_the_page_is_the_same_twice() -> None:
    again = match_report(answers.match(), {"derby-42": answers.tube(271.5)})
    assert drawn() == again


def test_the_policy_allows_the_pages_own_style_and_nothing_else() -> None:
    page = drawn()
    policy = next(
        a["content"]
        for tag, a in Page(page).tags
        if tag == "meta" and a.get("http-equiv") == "Content-Security-Policy"
    )
    style = re.search("<style>(.*?)</style>", page, re.DOTALL)[1]
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert f"style-src 'sha256-{digest}'" in policy
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy


def test_nothing_comes_from_outside_and_nothing_runs() -> None:
    page = drawn(2)
    for tag, attributes in Page(page).tags:
        assert tag not in {"script", "iframe", "link", "object", "embed", "form", "a"}
        assert not {name for name in attributes if name.startswith("on") or name == "style"}
        assert attributes.get("src", "data:").startswith("data:image/svg+xml;base64,") or not (
            attributes.get("src")
        )
    assert "http://" not in page
    assert "https://" not in page


def test_the_page_names_no_folder_of_the_machine() -> None:
    page = drawn(2)
    pictures = [
        base64.b64decode(found).decode("utf-8") for found in re.findall(r"base64,([^\"]+)", page)
    ]
    assert len(pictures) == 4
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
    page = Page(match_report(match))
    assert "script" not in {tag for tag, _ in page.tags}
    assert not [a for _, attributes in page.tags for a in attributes if a.startswith("on")]
    assert page.text().count("<script>alert(1)</script>") >= 6
    assert "\x1b" not in page.text()


def test_the_page_says_what_the_json_says() -> None:
    match = answers.match()
    text = Page(drawn()).text()
    for candidate in documents.match_document(match)["candidates"]:
        assert candidate["last"] in text
        assert f"{candidate['distance']:.2f}" in text
        assert f"{candidate['flare']['delta_deg']:+.1f}" in text
        room = candidate["clearance_mm"]["length"]
        assert f"{room['value']:+.1f} ± {room['sd']:.1f}" in text
        assert candidate["why"] in text
    assert "260.0 ± 0.4 mm" in text
    assert "+10.0 ± 0.2 degrees: straight" in text
    assert "Left out: 3 too long; 4 too short." in text


@pytest.mark.usefixtures("unpictured")
def test_a_pair_says_how_the_feet_differ() -> None:
    feet = (answers.foot("l.stl", left=True, length_mm=258.0), answers.foot("r.stl"))
    text = Page(match_report(answers.match(feet))).text()
    assert "The feet differ by 2.0 mm in length" in text
    assert "differ" not in Page(match_report(answers.match())).text()


@pytest.mark.usefixtures("unpictured")
def test_nothing_fits_is_an_answer() -> None:
    nothing = answers.match(
        candidates=(), warnings=(Notice("nothing_fits", "no last has the length"),)
    )
    text = Page(match_report(nothing)).text()
    assert "No last fits." in text
    assert "no last has the length" in text


@pytest.mark.usefixtures("unpictured")
def test_a_search_by_flare_says_that_it_is_scale_free() -> None:
    assert "scale-free" in Page(match_report(answers.match(by="flare"))).text()


@pytest.mark.usefixtures("unpictured")
def test_what_is_not_measured_says_why() -> None:
    foot = answers.foot()
    reason = "the leg is cut at the instep"
    unknown = replace(foot.measures[0], name="instep_girth", measured=Measured(None, None, reason))
    foot = replace(foot, measures=(*foot.measures, unknown))
    text = Page(match_report(answers.match((foot,)))).text()
    assert f"Instep girth not measured ({reason})" in text


def test_every_picture_says_what_it_shows() -> None:
    images = [a for tag, a in Page(drawn(2)).tags if tag == "img"]
    assert len(images) == 4
    assert all(len(image["alt"]) > 40 for image in images)


def browse(page: str, folder: Path) -> str:
    """Show a page in a headless browser, with a picture of it; return what it complained of."""
    folder.mkdir()
    (folder / "page.html").write_text(page, encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"]
    run = subprocess.run(
        [
            BROWSER,
            *options,
            f"--user-data-dir={folder / 'profile'}",
            "--window-size=1100,3600",
            f"--screenshot={folder / 'page.png'}",
            f"file://{folder / 'page.html'}",
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    return "\n".join(line for line in run.stderr.splitlines() if "CONSOLE" in line)


@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a_browser_draws_the_page_and_complains_of_nothing(tmp_path) -> None:
    from matplotlib.image import imread

    assert browse(drawn(2), tmp_path / "good") == ""
    picture = imread(tmp_path / "good" / "page.png")[..., :3]
    blue = (picture[..., 2] - picture[..., 0] > 0.08) & (picture[..., 2] > 0.85)
    orange = (picture[..., 0] - picture[..., 2] > 0.1) & (picture[..., 0] > 0.9)
    assert blue.mean() > 0.01, "the rear windows of the plots are not drawn"
    assert orange.mean() > 0.01, "the fore windows of the plots are not drawn"
    spoilt = drawn().replace("<h1>", "<h1 style='color:red' onclick='alert(1)'>")
    assert "Content Security Policy" in browse(spoilt, tmp_path / "bad")
