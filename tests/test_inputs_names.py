"""Names from outside, literal or refused wherever they are shown; outputs only where asked."""

from __future__ import annotations

import csv
import io
import json
import os
import shutil
import subprocess
import sys
from contextlib import suppress
from html.parser import HTMLParser
from pathlib import Path

import pytest

from tests.conftest import Footfit

ROOT = Path(__file__).resolve().parents[1]
NAMES = [
    "[red]bold[/bold]",
    "[/bold]",
    "=1+1",
    "@SUM(A1)",
    "-2+3",
    "\t=1",
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "</script><b>",
    "new\nline",
    "esc\x1b[31mape",
    "back\u202ewards",
    "../../etc/passwd",
    "fuß ☃",
    "not-utf8-\udcdf",
]


class Tags(HTMLParser):
    """Every tag with its attributes' names, and every text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.handlers: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.handlers |= {name for name, _ in attrs if name.startswith("on")}


@pytest.fixture(scope="module")
def hostile(stocked: Path, tmp_path_factory) -> Path:
    """A catalogue whose lasts have the names above, as older versions of footfit stored them."""
    from footfit.catalogue import store
    from footfit.catalogue.rows.requirements import require_storable
    from footfit.catalogue.store import open_catalogue
    from footfit.errors import FootfitError

    path = Path(shutil.copy(stocked, tmp_path_factory.mktemp("hostile") / "lasts.footfit"))
    with pytest.MonkeyPatch.context() as patch, open_catalogue(path, write=True) as catalogue:
        patch.setattr(store, "require_name", require_storable)
        old = [record.labels.name for record in catalogue.lasts().records]
        for before, after in zip(old, NAMES, strict=False):
            with suppress(FootfitError):  # refused is right too
                catalogue.rename(before, after)
    return path


def copied(foot: Path, folder: Path, name: str) -> Path:
    path = folder / f"{name.replace('/', '_')}.stl"
    shutil.copy(foot, os.fsencode(str(path)))
    return path


def no_control(text: str) -> bool:
    return all(sign.isprintable() or sign == "\n" for sign in text)


@pytest.mark.parametrize("name", ["a/b", "a\\b", "new\nline", "tab\there", "back\u202ewards"])
def test_a_new_name_that_no_command_could_take_is_refused(
    footfit: Footfit, stocked: Path, tmp_path: Path, name: str
) -> None:
    catalogue = shutil.copy(stocked, tmp_path / "lasts.footfit")
    with (tmp_path / "lasts.csv").open("w", encoding="utf-8", newline="") as table:
        csv.writer(table).writerows([("path", "family"), ("last.stl", name)])
    old = _lasts(footfit, catalogue)[0]["last"]
    commands = [
        ("rename-last", old, name),
        ("ingest-last", tmp_path / "last.stl", "--name", name),
        ("ingest-last", tmp_path / "last.stl", "--family", name),
        ("edit-last", old, "--family", name),
        ("grade-last", old, "--sizes", "40", "--family", name, "-o", tmp_path / "run"),
    ]
    if name.isspace() or name.split() == [name]:  # a manifest joins what spaces part
        commands.append(("ingest-last", "--manifest", tmp_path / "lasts.csv"))
    for command in commands:
        run = footfit(*command, "--catalogue", catalogue)
        noun = "family" if "--family" in command or "--manifest" in command else "last"
        assert (run.code, run.err.count("\n")) == (2, 1), run.err
        assert f"cannot be the name of a {noun}: give one without slashes" in run.err
    assert _lasts(footfit, catalogue)[0]["last"] == old


def test_a_file_whose_name_no_last_can_have_is_refused_by_itself(
    footfit: Footfit, tmp_path: Path
) -> None:
    for sample, name in zip(("derby-38", "derby-39"), ("two\nlines", "plain"), strict=True):
        shutil.copy(ROOT / "sample_data" / "lasts" / f"{sample}.stl", tmp_path / f"{name}.stl")
    catalogue = tmp_path / "lasts.footfit"
    run = footfit("ingest-last", tmp_path, "--catalogue", catalogue)
    assert (run.code, "cannot be the name of a last" in run.err) == (2, True), run.err
    assert [each["last"] for each in _lasts(footfit, catalogue)] == ["plain"]


def test_tables_and_lines_show_names_literally(footfit: Footfit, hostile: Path, foot, tmp_path):
    listed = footfit("list-lasts", "--catalogue", hostile)
    assert (listed.code, no_control(listed.out)) == (0, True)
    for shown in ("[red]bold[/bold]", "<script>"):
        assert any(shown in last["last"] for last in _lasts(footfit, hostile))
    for name in NAMES[::2]:
        run = footfit("match", copied(foot, tmp_path, name), "--catalogue", hostile)
        assert run.code == 0, run.err
        assert no_control(run.out + run.err)
    for last in _lasts(footfit, hostile):
        assert footfit("show-last", "--catalogue", hostile, "--", last["last"]).code == 0


def _lasts(footfit: Footfit, catalogue: Path) -> list[dict]:
    return footfit("list-lasts", "--catalogue", catalogue, "--json").document["lasts"]


def test_a_missing_file_of_any_name_is_one_line(footfit: Footfit, tmp_path: Path):
    for name in NAMES:
        path = str(tmp_path / f"{name.replace('/', '_')}.stl")
        run = footfit("align", path)
        assert run.code == 3
        assert run.err.count("\n") == 1
        assert no_control(run.err)
        error = json.loads(footfit("align", path, "--json").last_error)
        assert error["code"] == "unreadable_file"


def test_json_keeps_a_name_to_its_line(footfit: Footfit, hostile: Path, foot, tmp_path):
    paths = [copied(foot, tmp_path, name) for name in NAMES[:4] + NAMES[9:12]]
    run = footfit("match", *paths, "--catalogue", hostile, "--json", "--top", 12)
    assert len(run.lines) == len(paths)
    assert [line["feet"][0]["mesh"]["path"] for line in run.lines] == [str(p) for p in paths]


def test_no_cell_of_the_csv_is_a_formula(
    footfit: Footfit, hostile: Path, foot, tmp_path, monkeypatch
):
    path = copied(foot, tmp_path, "=HYPERLINK()")
    monkeypatch.chdir(tmp_path)
    for argument in (path, path.name):  # a bare name begins the cell
        run = footfit(
            "match", argument, "--catalogue", hostile, "--csv", "-", "--top", 12, "--by", "flare"
        )
        rows = list(csv.reader(io.StringIO(run.out)))
        assert len(rows) == 1 + 12
        numbers = [cell for row in rows[1:] for cell in row]
        for cell in numbers:
            assert not cell.startswith(("=", "@", "\t", "\r")), cell
            if cell[:1] in "+-" and cell:
                float(cell)


def test_the_report_holds_no_tag_and_no_path_of_a_name(
    footfit: Footfit, hostile: Path, foot, tmp_path
):
    plain = tmp_path / "plain.html"
    assert footfit("match", foot, "--catalogue", hostile, "--html", plain, "--top", 12).code == 0
    tags = Tags(plain.read_text(encoding="utf-8")).tags
    for number, name in enumerate(NAMES[6:9]):
        report = tmp_path / f"{number}.html"
        path = copied(foot, tmp_path, name)
        run = footfit("match", path, "--catalogue", hostile, "--html", report, "--top", 12)
        assert run.code == 0, run.err
        found = Tags(report.read_text(encoding="utf-8"))
        assert found.tags <= tags
        assert not found.handlers
        text = report.read_text(encoding="utf-8")
        assert str(tmp_path) not in text
        assert str(Path.home()) not in text
        assert "alert(1)</script>" not in text


@pytest.mark.parametrize("name", ["../climbs", "a/b", "/tmp/absolute", "..", "CON"])
def test_a_lasts_name_never_names_a_file(footfit: Footfit, catalogue: Path, tmp_path, name):
    """A name may be refused; if it is taken, only ``-o`` says where an export goes."""
    old = _lasts(footfit, catalogue)[0]["last"]
    before = {*tmp_path.rglob("*"), *tmp_path.parent.iterdir()}
    if footfit("rename-last", old, name, "--catalogue", catalogue).code == 0:
        out = tmp_path / "x.stl"
        assert footfit("export-last", name, "-o", out, "--catalogue", catalogue).code == 0
        out.unlink()
    after = {*tmp_path.rglob("*"), *tmp_path.parent.iterdir()}
    assert before == after


OUTPUTS = [
    ("align", "-o", "x.stl"),
    ("align", "--plot", "x.svg"),
    ("flare", "--plot", "x.png"),
    ("flare", "--csv", "x.csv"),
    ("curvature", "-o", "x.npz"),
    ("match", "--html", "x.html"),
    ("match", "--csv", "x.csv"),
]


@pytest.mark.parametrize(("command", "option", "name"), OUTPUTS)
def test_an_output_is_never_over_a_file_a_link_or_half(
    footfit: Footfit, foot, stocked, tmp_path, command, option, name
):
    more = ["--catalogue", stocked] if command == "match" else []
    target, link = tmp_path / "mine", tmp_path / name
    target.write_text("mine")
    link.symlink_to(target)
    assert footfit(command, foot, option, link, *more).code == 2
    assert footfit(command, foot, option, link, *more, "--force").code == 0
    assert target.read_text() == "mine"  # the link was replaced, what it led to was not
    assert not link.is_symlink()
    link.unlink()
    dangling = tmp_path / f"dangling-{name}"
    dangling.symlink_to(tmp_path / "nowhere")
    assert footfit(command, foot, option, dangling, *more).code == 2
    assert not (tmp_path / "nowhere").exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"dangling-{name}", "mine"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
def test_a_full_or_special_output_is_refused_in_words(footfit: Footfit, foot, tmp_path):
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    for path in (Path("/dev/full"), pipe):
        run = footfit("flare", foot, "--csv", path)
        assert run.code == 2
        assert run.err.count("\n") == 1
    command = [sys.executable, "-m", "footfit", "flare", str(foot), "--json"]
    with Path("/dev/full").open("wb") as full:
        run = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, cwd=ROOT, text=True)
    assert run.returncode != 0
    assert "Traceback" not in run.stderr
