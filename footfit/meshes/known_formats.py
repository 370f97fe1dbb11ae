"""The mesh formats, and how each is recognised and read. A new format is a new row."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import PurePath
from typing import Any

from footfit.errors import BadOption, DamagedMesh, FootfitError, TooLarge, UnknownFormat
from footfit.meshes.formats.foreign import is_text, known_foreign, likeness
from footfit.meshes.formats.raw import RawMesh, checked_mesh
from footfit.meshes.read_limits import Limits
from footfit.results.values import Notice


@dataclass(frozen=True, slots=True)
class MeshFormat:
    """A way to store a mesh. Its module is opened when a file may be of this format.

    Attributes
    ----------
    name : str
        What ``MeshInfo.format`` says.
    extension : str
        How files of this format end, and what ``--format`` takes.
    module : str
        The module of `footfit.meshes` that has the two functions.
    recognises, reader : str
        The function that tells whether bytes are of this format, by their content alone; and the
        one from bytes and limits to a :class:`RawMesh`, which may raise anything on bad bytes.
    """

    name: str
    extension: str
    module: str
    recognises: str
    reader: str

    def recognised(self, data: bytes) -> bool:
        """Whether bytes are of this format."""
        return bool(self._function(self.recognises)(data))

    def read(self, data: bytes, limits: Limits) -> RawMesh:
        """The mesh in the bytes."""
        mesh: RawMesh = self._function(self.reader)(data, limits)
        return mesh

    def _function(self, name: str) -> Callable[..., Any]:
        function: Callable[..., Any] = getattr(import_module(f"footfit.meshes.{self.module}"), name)
        return function


# In this order: the surest signature first.
FORMATS: tuple[MeshFormat, ...] = (
    MeshFormat("stl-binary", "stl", "formats.stl", "is_binary_stl", "read_binary_stl"),
    MeshFormat("ply", "ply", "formats.ply", "is_ply", "read_ply"),
    MeshFormat("off", "off", "formats.off", "is_off", "read_off"),
    MeshFormat("glb", "glb", "formats.glb", "is_glb", "read_glb"),
    MeshFormat("3mf", "3mf", "formats.threemf", "is_3mf", "read_3mf"),
    MeshFormat("3dm", "3dm", "rhino.from_3dm", "is_3dm", "read_3dm"),
    MeshFormat("stl-ascii", "stl", "formats.stl", "is_ascii_stl", "read_ascii_stl"),
    MeshFormat("obj", "obj", "formats.obj", "is_obj", "read_obj"),
)
EXTENSIONS = tuple(sorted({known.extension for known in FORMATS}))
_READABLE = "STL, OBJ, PLY, OFF, GLB, 3MF or 3DM"


def raw_mesh(
    data: bytes, path: str | None, declared: str | None, limits: Limits
) -> tuple[str, RawMesh]:
    """The format's name and the mesh as the file has it, checked by :func:`checked_mesh`.

    The content decides which format it is. ``declared`` (an extension) must agree with it. Where
    the path's extension does not agree, the mesh carries the notice ``extension_mismatch``.

    Raises
    ------
    UnknownFormat
        footfit does not read the content; the message says what it looks like.
    DamagedMesh, EmptyMesh, TooLarge
        From the format's reader. Any other error of a reader becomes DamagedMesh.
    BadOption
        footfit does not read the format ``declared``.
    """
    suffix = PurePath(path or "").suffix if declared is None else declared
    wanted = suffix.lower().removeprefix(".")
    if declared is not None and wanted not in EXTENSIONS:
        raise BadOption(f"there is no format {declared!a}: use {', '.join(EXTENSIONS)}")
    actual = _format_of(data, wanted)
    if declared is not None and actual.extension != wanted:
        raise UnknownFormat(
            f"--format says {wanted}, but the content is {actual.extension}:"
            f" use --format {actual.extension}"
        )
    raw = checked_mesh(_read(actual, data, limits), limits)
    if wanted in EXTENSIONS and actual.extension != wanted:
        kind = actual.extension.upper()
        message = f"the file's name ends in .{wanted}, but it holds {kind}: it is read as {kind}"
        notice = Notice("extension_mismatch", message)
        raw = replace(raw, warnings=(notice, *raw.warnings))
    return actual.name, raw


def _format_of(data: bytes, wanted: str) -> MeshFormat:
    """The format by its content. A binary STL of a wrong size is known by its name only.

    Without a name, ``wanted`` is "": the content may be such an STL, so ask.
    """
    for known in FORMATS:
        if known.recognised(data):
            return known
    if wanted == "stl" and known_foreign(data) is None and not is_text(data):
        return FORMATS[0]
    if not wanted and known_foreign(data) is None and not is_text(data):
        raise UnknownFormat("the content does not say its format: add --format, such as stl")
    raise UnknownFormat(
        f"the content looks like {likeness(data)}, not like a mesh: use a file in {_READABLE}"
    )


def _read(known: MeshFormat, data: bytes, limits: Limits) -> RawMesh:
    """Run a reader. The bytes come from anyone, so every error becomes one of footfit's own."""
    try:
        return known.read(data, limits)
    except FootfitError:
        raise
    except MemoryError as error:
        raise TooLarge("the mesh does not fit in memory: simplify it first") from error
    except Exception as error:
        raise DamagedMesh(
            f"the {known.extension.upper()} file is damaged and cannot be read: export it again"
        ) from error
