"""The mesh formats, each with how it is recognised and read: a new format is a new row."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import PurePath

from footfit.errors import BadOption, DamagedMesh, FootfitError, TooLarge, UnknownFormat
from footfit.meshes.formats.foreign import is_text, known_foreign, likeness
from footfit.meshes.formats.glb import is_glb, read_glb
from footfit.meshes.formats.obj import is_obj, read_obj
from footfit.meshes.formats.off import is_off, read_off
from footfit.meshes.formats.ply import is_ply, read_ply
from footfit.meshes.formats.raw import RawMesh, sound
from footfit.meshes.formats.stl import is_binary_stl, read_ascii_stl, read_binary_stl
from footfit.meshes.formats.threemf import is_3mf, read_3mf
from footfit.meshes.read_limits import Limits
from footfit.results import Notice


@dataclass(frozen=True, slots=True)
class MeshFormat:
    """One way to store a mesh.

    Attributes
    ----------
    name : str
        What ``MeshInfo.format`` says.
    extension : str
        What files of this format are called, and what ``--format`` takes.
    recognised : callable
        Whether bytes are of this format, by their content alone.
    read : callable
        Bytes and limits to a :class:`RawMesh`; may raise anything on bad bytes.
    """

    name: str
    extension: str
    recognised: Callable[[bytes], bool]
    read: Callable[[bytes, Limits], RawMesh]


def _is_ascii_stl(data: bytes) -> bool:
    begins = data[:4096].removeprefix(b"\xef\xbb\xbf").lstrip().lower().startswith(b"solid")
    return begins and is_text(data)


def _is_obj_text(data: bytes) -> bool:
    return is_text(data) and known_foreign(data) is None and is_obj(data)


# In this order: the surest mark first.
FORMATS: tuple[MeshFormat, ...] = (
    MeshFormat("stl-binary", "stl", is_binary_stl, read_binary_stl),
    MeshFormat("ply", "ply", is_ply, read_ply),
    MeshFormat("off", "off", is_off, read_off),
    MeshFormat("glb", "glb", is_glb, read_glb),
    MeshFormat("3mf", "3mf", is_3mf, read_3mf),
    MeshFormat("stl-ascii", "stl", _is_ascii_stl, read_ascii_stl),
    MeshFormat("obj", "obj", _is_obj_text, read_obj),
)
EXTENSIONS = tuple(sorted({known.extension for known in FORMATS}))
_READABLE = "STL, OBJ, PLY, OFF, GLB or 3MF"


def raw_mesh(
    data: bytes, path: str | None, declared: str | None, limits: Limits
) -> tuple[str, RawMesh]:
    """The format's name and the mesh as the file has it, checked by :func:`sound`.

    The content decides. ``declared`` (an extension) must agree with it; where the path's extension
    does not, the mesh carries the notice ``extension_mismatch``.

    Raises
    ------
    UnknownFormat
        The content is of no format that footfit reads; the message says what it looks like.
    DamagedMesh, EmptyMesh, TooLarge
        From the format's reader. Whatever else a reader raises on bad bytes becomes DamagedMesh.
    BadOption
        ``declared`` is none that footfit reads.
    """
    wanted = _extension(path) if declared is None else declared.lower().removeprefix(".")
    if declared is not None and wanted not in EXTENSIONS:
        raise BadOption(f"no format is called {declared!a}: use {', '.join(EXTENSIONS)}")
    found = _format_of(data, wanted)
    if declared is not None and found.extension != wanted:
        raise UnknownFormat(
            f"--format says {wanted} and the content is {found.extension}:"
            f" use --format {found.extension}"
        )
    raw = sound(_read(found, data, limits), limits)
    if wanted in EXTENSIONS and found.extension != wanted:
        message = f"the file is called .{wanted} and holds {found.extension.upper()}: read as that"
        notice = Notice("extension_mismatch", message)
        raw = replace(raw, warnings=(notice, *raw.warnings))
    return found.name, raw


def _extension(path: str | None) -> str | None:
    return PurePath(path).suffix.lower().removeprefix(".") if path is not None else None


def _format_of(data: bytes, wanted: str | None) -> MeshFormat:
    """The format by content; a damaged file is still taken for what it is said to be."""
    found = next((known for known in FORMATS if known.recognised(data)), None)
    if found is not None:
        return found
    if known_foreign(data) is None and wanted is not None:
        text = is_text(data)
        for known in FORMATS:
            if known.extension == wanted and _may_be_damaged(known, text):
                return known
    raise UnknownFormat(
        f"the content looks like {likeness(data)}, not like a mesh: give {_READABLE}"
    )


def _may_be_damaged(known: MeshFormat, text: bool) -> bool:
    """A binary STL with a wrong size has no other mark than its name."""
    return known.name == "stl-binary" and not text


def _read(found: MeshFormat, data: bytes, limits: Limits) -> RawMesh:
    """Run a reader; its bytes come from anyone, so no exception of it may pass as it is."""
    try:
        return found.read(data, limits)
    except FootfitError:
        raise
    except MemoryError as error:
        raise TooLarge("the mesh does not fit in memory: decimate it first") from error
    except Exception as error:
        raise DamagedMesh(
            f"the {found.extension.upper()} file cannot be understood: export it again"
        ) from error
