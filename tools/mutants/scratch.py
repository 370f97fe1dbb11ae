"""Copies of the tree to break: the working tree itself is never changed."""

from __future__ import annotations

import compileall
import os
import shutil
from pathlib import Path

LEFT_OUT = shutil.ignore_patterns(
    *(".git", ".venv", ".mutants", ".hypothesis", "demo", "dist", "build"),
    *(".mypy_cache", ".ruff_cache", ".pytest_cache", ".import_linter_cache", "__pycache__"),
)


def template(root: Path, folder: Path) -> Path:
    """A compiled copy of the tree in ``folder``, with what stands beside the tree beside it."""
    tree = folder / "footfit"
    shutil.copytree(root, tree, ignore=LEFT_OUT, symlinks=True)
    beside = root.parent / "shared"
    if beside.exists():
        (folder / "shared").symlink_to(beside.resolve())
    compileall.compile_dir(tree / "footfit", quiet=1)
    return tree


def copied(tree: Path, folder: Path) -> Path:
    """Another copy of a template, in a folder that may hold an older one."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copytree(tree, folder / "footfit", symlinks=True)
    if (tree.parent / "shared").exists():
        (folder / "shared").symlink_to((tree.parent / "shared").resolve())
    return folder / "footfit"


def environment(tree: Path) -> dict[str, str]:
    """The environment in which ``import footfit`` opens this tree."""
    known = dict(os.environ)
    known.pop("COVERAGE_PROCESS_START", None)
    known["PYTHONPATH"] = str(tree)
    return known
