"""The drawing in docs/architecture.md against the folders, their docstrings and the contracts."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "footfit"
PAGE = ROOT / "docs" / "architecture.md"
BEGIN, END = "<!-- drawing: begin -->\n", "<!-- drawing: end -->"
MOST_FILES = 14
MOST_LINES = 400
BESIDE = {"__main__", "data"}
"""Modules that stand in no layer, as the contract says in ``exhaustive_ignores``."""


def contracts() -> dict[str, list[list[str]]]:
    """The layers of each container, top floor first; a floor is a list of names."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    layered = [
        contract
        for contract in tomllib.loads(text)["tool"]["importlinter"]["contracts"]
        if contract["type"] == "layers"
    ]
    return {
        container: [[name.strip() for name in re.split(r"[|:]", floor)] for floor in c["layers"]]
        for c in layered
        for container in c["containers"]
    }


def first_line(path: Path) -> str:
    """The first line of a module's docstring."""
    doc = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))
    assert doc, f"{path} has no docstring"
    return doc.splitlines()[0]


def drawing() -> str:
    """The house as the folders and the contracts have it."""
    layers = contracts()
    lines = ["footfit/"]

    def draw(container: str, folder: Path, depth: int) -> None:
        for floor in layers[container]:
            for name in floor:
                room = folder / name
                is_room = (room / "__init__.py").exists()
                if is_room:
                    label, words = f"{name}/", first_line(room / "__init__.py")
                else:
                    label, words = f"{name}.py", first_line(folder / f"{name}.py")
                same = " |" if name != floor[-1] else ""
                lines.append(f"{'  ' * depth}{label + same:<22} {words}".rstrip())
                if is_room and f"{container}.{name}" in layers:
                    draw(f"{container}.{name}", room, depth + 1)

    draw("footfit", PACKAGE, 1)
    return "```\n" + "\n".join(lines) + "\n```\n"


def folders() -> list[Path]:
    """Every folder of the package that holds modules."""
    return sorted({path.parent for path in PACKAGE.rglob("*.py")})


def test_the_drawing_is_the_house():
    text = PAGE.read_text(encoding="utf-8")
    drawn = text[text.index(BEGIN) + len(BEGIN) : text.index(END)]
    assert drawn == drawing(), "make it anew: python -m tests.test_architecture"


def test_every_room_is_in_the_drawing():
    """A container whose layers are listed lists all that is in it, so no room is left out."""
    layers = contracts()
    named = {
        f"{container}.{name}"
        for container in layers
        for floor in layers[container]
        for name in floor
    }
    rooms = {".".join(path.relative_to(ROOT).parts) for path in folders() if path != PACKAGE}
    assert rooms <= named


@pytest.mark.parametrize("container", sorted(contracts()))
def test_a_contract_names_what_is_there(container):
    folder = ROOT / Path(*container.split("."))
    there = {path.stem for path in folder.glob("*.py")} - {"__init__"} - BESIDE
    there |= {path.name for path in folder.iterdir() if (path / "__init__.py").exists()}
    named = {name for floor in contracts()[container] for name in floor}
    assert named == there


@pytest.mark.parametrize("folder", folders(), ids=lambda path: str(path.relative_to(ROOT)))
def test_a_room_is_small(folder):
    files = list(folder.glob("*.py"))
    if folder != PACKAGE / "cli" / "commands":
        assert len(files) <= MOST_FILES
    for path in files:
        assert len(path.read_text(encoding="utf-8").splitlines()) <= MOST_LINES, path


def test_no_file_name_stands_for_two_ideas():
    """A verb may recur, once a layer; a noun stands once in the house."""
    verbs = {"align", "flare", "curvature", "measure", "match", "compare", "demo"}
    places: dict[str, list[str]] = {}
    for path in PACKAGE.rglob("*.py"):
        if path.stem not in {"__init__", "__main__"}:
            places.setdefault(path.stem, []).append(path.relative_to(PACKAGE).parts[0])
    for stem, packages in places.items():
        if stem in verbs:
            assert len(set(packages)) == len(packages), (stem, packages)
        else:
            assert len(packages) == 1, (stem, packages)


if __name__ == "__main__":
    page = PAGE.read_text(encoding="utf-8")
    head, tail = page[: page.index(BEGIN) + len(BEGIN)], page[page.index(END) :]
    PAGE.write_text(head + drawing() + tail, encoding="utf-8")
