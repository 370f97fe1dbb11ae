"""Which meshes a command was given: files, folders, globs, standard input."""

from __future__ import annotations

import hashlib
import os
import unicodedata
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, BinaryIO

from footfit.errors import BadOption, UnreadableFile
from footfit.results import Notice, Scan

if TYPE_CHECKING:
    from footfit.geometry.stance.cues import StanceLabels
    from footfit.results import LastLabels, Profiled

MESH_SUFFIXES = (".stl", ".obj", ".ply", ".off", ".glb", ".3mf", ".3dm")
READ_KINDS = ", ".join(suffix[1:] for suffix in MESH_SUFFIXES)
NO_SCANS = (
    *("", ".csv", ".db", ".footfit", ".htm", ".html", ".ini", ".jpeg", ".jpg", ".json", ".jsonl"),
    *(".md", ".mtl", ".npz", ".pdf", ".png", ".svg", ".toml", ".tsv", ".txt"),
)
"""What often lies beside scans and holds none: tables, pictures, textures, notes, footfit's own."""
GLOB_CHARACTERS = frozenset("*?[")
RUN_MANIFEST = "run.csv"
"""The manifest beside the files of a run: `grade-last` writes it, and it says how each stands."""
LABELLED_MM = {"heel_height_mm": (0, 200), "toe_spring_mm": (0, 80), "platform_mm": (0, 100)}
"""What labels may say of how a last stands."""


@dataclass(frozen=True, slots=True)
class Source:
    """One mesh to read: a path, or bytes that came by standard input (``path`` None).

    ``scan`` is one shape of a file that holds several: it has been read already. ``stored`` gives a
    last of the catalogue, if ``path`` is its name. ``said`` is what a manifest says of it; None if
    that was not looked up yet.
    """

    path: str | None
    data: bytes | None = None
    format: str | None = None
    scan: Scan | None = field(default=None, compare=False)
    stored: Callable[[], Profiled] | None = None
    said: Said | None = field(default=None, compare=False)


NONE_NAMED: Mapping[str, Source] = MappingProxyType({})
"""No argument is the name of a last."""


@dataclass(frozen=True, slots=True)
class ReadingOptions:
    """How to read a scan; "auto" is decided by its shape and reported.

    ``force_side`` takes a ``side`` that the shape surely contradicts. ``kind`` is "foot" or "last".
    ``heel_height_mm``, ``toe_spring_mm`` and ``platform_mm`` are what people say of how a last
    stands. ``scanner`` is the kind of scanner that made it.
    """

    units: str = "auto"
    known_length_mm: float | None = None
    side: str = "auto"
    force_side: bool = False
    kind: str = "auto"
    heel_height_mm: float | None = None
    toe_spring_mm: float | None = None
    platform_mm: float | None = None
    scanner: str | None = None

    @property
    def stance_labels(self) -> StanceLabels:
        """What people say of how a last stands."""
        from footfit.geometry.stance.cues import StanceLabels

        return StanceLabels(self.heel_height_mm, self.toe_spring_mm, self.platform_mm or 0.0)


@dataclass(frozen=True, slots=True)
class ManifestRow:
    """One line of a manifest; ``labels.name`` is the file's stem if the line has no name.

    ``sha256`` is the hash of the file that the line was written for, if the line has it.
    """

    path: str
    labels: LastLabels
    reading: ReadingOptions
    sha256: str | None = None

    @property
    def says_how_it_stands(self) -> bool:
        """Whether the line has a heel height or a toe spring."""
        return self.labels.heel_height_mm is not None or self.labels.toe_spring_mm is not None


@dataclass(frozen=True, slots=True)
class Said:
    """What a manifest says of a file.

    ``row`` is the line of the file, if it counts. Else ``doubt`` says in words why it does not; it
    is empty if there is no such line, or if the line does not say how the last stands.
    """

    row: ManifestRow | None = None
    doubt: str = ""


def mesh_sources(
    arguments: Sequence[str], named: Mapping[str, Source] = NONE_NAMED
) -> list[Source]:
    """Files, those in folders (and below) and those of globs, each once, sorted by argument.

    ``named`` has the arguments that are no paths.

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
    paths = dict.fromkeys(
        path
        for each in arguments
        for path in ([each] if each in named else _expanded(each, alone=alone))
    )
    return [named.get(path) or Source(path) for path in paths]


def source_bytes(source: Source) -> bytes:
    """The bytes of a source, behind the guards of ``meshes.read``."""
    from footfit.meshes.file_bytes import file_bytes
    from footfit.meshes.read_limits import LIMITS

    return source.data if source.data is not None else file_bytes(source.path or "", LIMITS)


def content_hash(source: Source) -> str:
    """SHA-256 of the source's bytes: what a last is known by."""
    if source.scan is not None:
        return source.scan.info.sha256
    return hashlib.sha256(source_bytes(source)).hexdigest()


def lies_beside_a_manifest(source: Source) -> bool:
    """Whether the file of a source lies in the folder of a run's manifest."""
    if source.path is None or source.data is not None or source.stored is not None:
        return False
    try:
        return (Path(source.path).parent / RUN_MANIFEST).is_file()
    except (OSError, ValueError):  # a folder that is closed to us; a name with a NUL in it
        return False


def is_no_path(argument: str) -> bool:
    """Whether there is no file and no folder of that name."""
    try:
        return bool(argument) and not os.path.lexists(stored_path(argument))
    except ValueError:  # a name with a NUL in it
        return False


def stdin_source(stream: BinaryIO | None, mesh_format: str | None) -> Source:
    """One mesh from standard input, None if that is closed, with the limit of size of a file.

    Raises
    ------
    UnreadableFile
        It is closed, or it is a folder.
    TooLarge, EmptyMesh
        Past the limit, or nothing came.
    """
    from footfit.meshes.file_bytes import stream_bytes
    from footfit.meshes.read_limits import LIMITS

    if stream is None:
        raise UnreadableFile("standard input is closed: pipe a mesh into it, or name a file")
    try:
        return Source(None, stream_bytes(stream, LIMITS), mesh_format)
    except OSError as error:
        words = f"standard input cannot be read ({error.strerror}): pipe a mesh into it"
        raise UnreadableFile(words) from error


def stored_path(path: str) -> str:
    """A path as the folders spell it, if it differs only in form; else the path as it is.

    A letter with an accent may be one character or two (NFC, NFD). A path that was written on
    Windows has backslashes.
    """
    spellings = dict.fromkeys((path, path.replace("\\", "/")))
    for spelling in spellings:
        with suppress(OSError, ValueError):  # no such folder; a name with a NUL in it
            if os.path.lexists(spelling) or not spelling:
                return spelling
            if (stored := _spelt(Path(spelling))) is not None:
                return str(stored)
    return path


def _spelt(path: Path) -> Path | None:
    """The file or folder that has the name of ``path`` in another Unicode form, if there is one."""
    if path.exists() or path == path.parent:
        return path if path.exists() else None
    folder = _spelt(path.parent)
    if folder is None:
        return None
    wanted = unicodedata.normalize("NFC", path.name)
    names = (each.name for each in folder.iterdir())
    same = sorted(name for name in names if unicodedata.normalize("NFC", name) == wanted)
    return folder / same[0] if same else None


def left_out(argument: str) -> tuple[Notice, ...]:
    """A notice if a folder or a glob holds files that may be scans, of kinds that are not read."""
    kinds = Counter(path.suffix[1:].lower() for path in _files_below(argument) or ())
    for suffix in (*MESH_SUFFIXES, *NO_SCANS):
        del kinds[suffix[1:]]
    if not kinds:
        return ()
    counts = ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))
    files = "1 file was" if kinds.total() == 1 else f"{kinds.total()} files were"
    words = f"{files} left out ({counts}); footfit reads {READ_KINDS}"
    return (Notice("files_left_out", words),)


def _expanded(argument: str, *, alone: bool) -> list[str]:
    """The paths that one argument stands for; itself if it cannot be looked up."""
    if not argument:
        raise BadOption("an empty path was given (an unset variable?); name a file or folder")
    argument = stored_path(argument)
    files = _files_below(argument)
    if files is None:
        return [argument]
    paths = sorted(str(path) for path in files if path.suffix.lower() in MESH_SUFFIXES)
    if not paths and alone:
        others = "".join(notice.message for notice in left_out(argument))
        others = others or f"name a file or folder with {READ_KINDS}"
        raise UnreadableFile(f"holds no mesh file; {others}", argument)
    return paths or [argument]


def _is_hidden(part: str) -> bool:
    """Whether a part of a path is hidden; the folder above, .., is not."""
    return part.startswith(".") and part != ".."


def _files_below(argument: str) -> list[Path] | None:
    """The regular files of a folder or a glob, no hidden ones; None for anything else."""
    path = Path(argument)
    try:
        if path.is_dir():
            folder, paths = path, path.rglob("*")
        elif GLOB_CHARACTERS & set(argument) and not path.exists():
            folder = Path(path.anchor)
            paths = folder.glob(str(path.relative_to(folder)))
        else:
            return None
        return [
            each
            for each in paths
            if not any(map(_is_hidden, each.relative_to(folder).parts)) and each.is_file()
        ]
    except (OSError, ValueError):  # the name is too long, the folder is closed to us, or "**x"
        return None
