"""Which meshes a command was given: files, folders, globs, standard input."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from footfit.errors import UnreadableFile

MESH_SUFFIXES = (".stl", ".obj", ".ply", ".off", ".glb", ".3mf")
GLOB_CHARACTERS = frozenset("*?[")


@dataclass(frozen=True, slots=True)
class Source:
    """One mesh to read: a path, or bytes that came by standard input (``path`` None)."""

    path: str | None
    data: bytes | None = None
    format: str | None = None


@dataclass(frozen=True, slots=True)
class ReadingOptions:
    """How a scan is to be understood; "auto" is decided by its shape and reported."""

    units: str = "auto"
    known_length_mm: float | None = None
    side: str = "auto"


def mesh_sources(arguments: Sequence[str]) -> list[Source]:
    """Expand files, folders (with what is below them) and globs; each file once, in sorted order
    within its argument.

    Raises
    ------
    UnreadableFile
        A folder or a glob that holds no mesh. A missing *file* is kept: its own line says so.

    Examples
    --------
    >>> [source.path for source in mesh_sources(["b.stl", "a.stl", "b.stl"])]
    ['b.stl', 'a.stl']
    """
    paths = dict.fromkeys(path for argument in arguments for path in _expanded(argument))
    return [Source(path) for path in paths]


def stdin_source(stream: BinaryIO, mesh_format: str) -> Source:
    """One mesh from an open stream, behind the same size guard as a file.

    Raises
    ------
    TooLarge, EmptyMesh
        Past the limit, or nothing came.
    """
    from footfit.meshes.read import read_stream

    return Source(None, read_stream(stream), mesh_format)


def _expanded(argument: str) -> list[str]:
    path = Path(argument)
    if path.is_dir():
        found = _mesh_files(path.rglob("*"))
    elif GLOB_CHARACTERS & set(argument) and not path.exists():
        anchor, pattern = _anchored(path)
        found = _mesh_files(anchor.glob(pattern))
    else:
        return [argument]
    if not found:
        kinds = ", ".join(suffix[1:] for suffix in MESH_SUFFIXES)
        raise UnreadableFile(f"holds no mesh file ({kinds}); name a file or folder", argument)
    return found


def _anchored(path: Path) -> tuple[Path, str]:
    """A glob as its root and the pattern below it."""
    if path.is_absolute():
        return Path(path.anchor), str(path.relative_to(path.anchor))
    return Path(), str(path)


def _mesh_files(paths: Iterable[Path]) -> list[str]:
    """The regular mesh files among ``paths``, sorted, hidden ones left out."""
    return sorted(
        str(p)
        for p in paths
        if p.suffix.lower() in MESH_SUFFIXES and not p.name.startswith(".") and p.is_file()
    )
