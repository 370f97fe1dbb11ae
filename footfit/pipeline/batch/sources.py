"""Which meshes a command was given: files, folders, globs, standard input."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from footfit.errors import BadOption, UnreadableFile
from footfit.results import Scan

if TYPE_CHECKING:
    from footfit.geometry.stance.cues import StanceLabels

MESH_SUFFIXES = (".stl", ".obj", ".ply", ".off", ".glb", ".3mf")
GLOB_CHARACTERS = frozenset("*?[")


@dataclass(frozen=True, slots=True)
class Source:
    """One mesh to read: a path, or bytes that came by standard input (``path`` None).

    ``scan`` is one shape of a file that holds several: it has been read already.
    """

    path: str | None
    data: bytes | None = None
    format: str | None = None
    scan: Scan | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class ReadingOptions:
    """How to read a scan; "auto" is decided by its shape and reported.

    ``heel_height_mm``, ``toe_spring_mm`` and ``platform_mm`` are what people say of how a last
    stands. ``scanner`` is the kind of scanner that made it.
    """

    units: str = "auto"
    known_length_mm: float | None = None
    side: str = "auto"
    heel_height_mm: float | None = None
    toe_spring_mm: float | None = None
    platform_mm: float | None = None
    scanner: str | None = None

    @property
    def stance_labels(self) -> StanceLabels:
        """What people say of how a last stands."""
        from footfit.geometry.stance.cues import StanceLabels

        return StanceLabels(self.heel_height_mm, self.toe_spring_mm, self.platform_mm or 0.0)


def mesh_sources(arguments: Sequence[str]) -> list[Source]:
    """Files, those in folders (and below) and those of globs, each once, sorted by argument.

    Raises
    ------
    BadOption
        An empty argument.
    UnreadableFile
        The only argument is a folder or a glob that holds no mesh. Beside others it is kept, and so
        is a missing file: its own line in the answer says what is wrong.

    Examples
    --------
    >>> [source.path for source in mesh_sources(["b.stl", "a.stl", "b.stl"])]
    ['b.stl', 'a.stl']
    """
    alone = len(arguments) == 1
    paths = dict.fromkeys(path for each in arguments for path in _expanded(each, alone=alone))
    return [Source(path) for path in paths]


def stdin_source(stream: BinaryIO, mesh_format: str) -> Source:
    """One mesh from an open stream, with the same limit of size as a file.

    Raises
    ------
    TooLarge, EmptyMesh
        Past the limit, or nothing came.
    """
    from footfit.meshes.file_bytes import stream_bytes
    from footfit.meshes.read_limits import LIMITS

    return Source(None, stream_bytes(stream, LIMITS), mesh_format)


def _expanded(argument: str, *, alone: bool) -> list[str]:
    """The paths that one argument stands for; itself if it cannot be looked up."""
    if not argument:
        raise BadOption("an empty path was given (an unset variable?); name a file or folder")
    path = Path(argument)
    try:
        if path.is_dir():
            paths = _mesh_files(path.rglob("*"), path)
        elif GLOB_CHARACTERS & set(argument) and not path.exists():
            anchor = Path(path.anchor)
            paths = _mesh_files(anchor.glob(str(path.relative_to(anchor))), anchor)
        else:
            return [argument]
    except (OSError, ValueError):  # the name is too long, the folder is closed to us, or "**x"
        return [argument]
    if not paths and alone:
        kinds = ", ".join(suffix[1:] for suffix in MESH_SUFFIXES)
        raise UnreadableFile(f"holds no mesh file ({kinds}); name a file or folder", argument)
    return paths or [argument]


def _mesh_files(paths: Iterable[Path], folder: Path) -> list[str]:
    """The regular mesh files among ``paths``, sorted; no hidden ones below ``folder``."""
    return sorted(
        str(path)
        for path in paths
        if path.suffix.lower() in MESH_SUFFIXES
        and not any(part.startswith(".") for part in path.relative_to(folder).parts)
        and path.is_file()
    )
