"""The docs say what is true: README's commands run, pages exist, keys and codes agree."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from footfit.cli.app import COMMANDS
from tests.conftest import ROOT, SAMPLES

README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", README, re.M | re.S)
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
    assert set(re.findall(r"`([a-z]+(?:-[a-z]+)?)`", table)) >= {name for name, _, _ in COMMANDS}


def test_every_link_leads_somewhere() -> None:
    for page in (ROOT / "README.md", *ROOT.glob("docs/**/*.md"), SAMPLES / "README.md"):
        for target in re.findall(r"\]\((?!https?:)([^)#]+)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


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
