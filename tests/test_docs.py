"""The docs say what is true: README's commands run, pages exist, keys and codes agree."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typer.main import get_command

from footfit.cli.app import COMMANDS, application
from tests.conftest import ROOT, SAMPLES

README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", README, re.M | re.S)
PAGES = (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), SAMPLES / "README.md")
WIDEST = 120
NOT_HERE = {
    "footfit/_migrations",
    "footfit/_sample_data",
    "migrations/versions/NNNN_title.py",
}
"""Folders that only the wheel has, and a name to fill in."""
OF_TOOLS = {"--count", "--fit", "--only", "--scale", "--script", "--seed", "--sizes", "--write"}
"""Options of benchmarks, ``tests.torture`` and ``tools.fuzz``."""
OF_DASK = {"--nthreads", "--port", "--protocol", "--tls-ca-file", "--tls-cert", "--tls-key"}
"""Options of Dask's own programs."""
SCRIPTS = {
    title: "\n".join(re.findall(r"```sh\n(.*?)```", text, re.S))
    for title, text in BLOCKS
    if "```sh" in text
}


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    """A folder as README's readers have it: their lasts, their feet, a foot of each side."""
    shutil.copytree(SAMPLES, tmp_path / "lasts", ignore=shutil.ignore_patterns("feet", "*.md"))
    shutil.copytree(SAMPLES / "feet", tmp_path / "feet")
    for side, end in (("left", "_L.stl"), ("right", "_R.stl")):
        shutil.copy(sorted((SAMPLES / "feet").glob(f"*{end}"))[0], tmp_path / f"{side}.stl")
    shutil.copy(sorted(SAMPLES.rglob("derby*.stl"))[0], tmp_path / "last.stl")
    return tmp_path


@pytest.mark.parametrize("title", SCRIPTS)
def test_the_commands_of_readme_run(title: str, shop: Path, stocked: Path) -> None:
    catalogue = shop / "home.footfit"
    if "ingest-last" not in SCRIPTS[title]:
        shutil.copy(stocked, catalogue)
    environment = {
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "HOME": str(shop),
        "FOOTFIT_CATALOGUE": str(catalogue),
    }
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", SCRIPTS[title]],
        cwd=shop,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr


def test_the_python_of_readme_runs(shop: Path, stocked: Path, monkeypatch, capsys) -> None:
    shutil.copy(stocked, shop / "home.footfit")
    monkeypatch.chdir(shop)
    (block,) = re.findall(r"```python\n(.*?)```", README, re.S)
    exec(block, {})
    assert re.fullmatch(r"\d+ [\w-]+ .* toe room .*\n", capsys.readouterr().out)


def test_readme_names_every_command() -> None:
    table = README.split("## The commands", 1)[1]
    assert set(re.findall(r"`([a-z]+(?:-[a-z]+)?)`", table)) >= set(COMMANDS)


def test_every_link_leads_somewhere() -> None:
    for page in PAGES:
        for target in re.findall(r"\]\((?!https?:)([^)#]+)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_no_line_of_a_page_is_wider_than_a_screen() -> None:
    """A row of a table cannot be wrapped, and may be longer."""
    for page in PAGES:
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), start=1):
            assert len(line) <= WIDEST or line.startswith("|"), f"{page.name}:{number}"


def test_every_file_and_folder_that_a_page_names_is_there() -> None:
    named = re.compile(
        r"`((?:footfit|tests|tools|benchmarks|docs|migrations|sample_data)/[\w./-]+)`"
    )
    paths = [(page, path) for page in PAGES for path in named.findall(page.read_text("utf-8"))]
    assert len(paths) > 50
    missing = {(page.name, path) for page, path in paths if not (ROOT / path).exists()}
    assert {path for _, path in missing} == NOT_HERE, missing


def test_every_option_that_a_page_names_is_one_of_a_command() -> None:
    known = {*OF_TOOLS, *OF_DASK, "--version"}
    group = get_command(application())
    for name in COMMANDS:
        known.update(o for p in group.get_command(None, name).params for o in p.opts)
    for page in PAGES:
        named = re.findall(r"(?<![\w-])--[a-z][a-z-]+", page.read_text(encoding="utf-8"))
        assert set(named) <= known, f"{page.name}: {sorted(set(named) - known)}"


def test_the_page_of_the_cluster_names_the_commands_that_work_on_one() -> None:
    group = get_command(application())
    able = {
        name
        for name in COMMANDS
        if any("--scheduler" in p.opts for p in group.get_command(None, name).params)
    }
    page = (ROOT / "docs/cluster.md").read_text(encoding="utf-8")
    assert set(re.findall(r"`([\w-]+)`", page.split("can work on a cluster")[0])) == able


def test_every_cited_source_is_listed() -> None:
    listed = set(re.findall(r"^- \[(\w+)\]", (ROOT / "docs/references.md").read_text(), re.M))
    for path in ROOT.glob("footfit/**/*.py"):
        for key in re.findall(r"\[([a-z]+\d{4}|paper|iso\d+)\]", path.read_text(encoding="utf-8")):
            assert key in listed, f"{path.name}: {key}"


def test_nothing_names_the_machine_it_was_written_on() -> None:
    tracked = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False
    ).stdout.split()
    if not tracked:
        pytest.skip("not a git checkout")
    for name in tracked:
        path = ROOT / name
        if path.suffix in {".py", ".md", ".toml", ".csv", ".txt", ""} and path.is_file():
            text = path.read_text(encoding="utf-8", errors="replace")
            assert not re.search(r"/(root|wo" + r"rk)/(?!\.)", text), name
