"""3MF: the objects of its build, in the unit that the model declares.

The model is XML in a ZIP archive. The standard library's expat parses it piece by piece. A document
type is refused, and with it every entity; no file that the XML names is opened.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NoReturn
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, EmptyMesh, TooLarge, UnknownFormat
from footfit.geometry.numeric.arrays import Floats
from footfit.meshes.formats.archive import archive, pieces
from footfit.meshes.formats.placed_parts import Part, joined_parts, placed_nodes
from footfit.meshes.formats.raw import RawMesh, check_counts
from footfit.meshes.formats.tokens import floats, integers
from footfit.meshes.read_limits import Limits

if TYPE_CHECKING:
    from zipfile import ZipFile, ZipInfo

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
"""The XML namespace of a 3MF's model."""
_CORE = f"{CORE} "
_SUFFIX, _USUAL = ".model", "3d/3dmodel.model"
_LOOKED_AT_BYTES = 65_536
_UNITS = {  # the unit that footfit reports, and how many of it each unit of the format has
    "micron": ("mm", 0.001),
    "millimeter": ("mm", 1.0),
    "centimeter": ("cm", 1.0),
    "meter": ("m", 1.0),
    "inch": ("in", 1.0),
    "foot": ("in", 12.0),
}
_TRANSFORM = 12

Attributes = dict[str, str]
Step = tuple[str, str | None]  # an object's id and the transform it is used with


def is_3mf(data: bytes) -> bool:
    """Whether the content is a ZIP archive that has a model in it."""
    mark = _SUFFIX.encode()
    return data.startswith(b"PK\3\4") and (
        mark in data[:_LOOKED_AT_BYTES].lower() or mark in data[-_LOOKED_AT_BYTES:].lower()
    )


def read_3mf(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of all objects that a 3MF builds, in their places.

    Raises
    ------
    UnknownFormat
        The archive has several models, or needs an extension that changes the shape.
    DamagedMesh
        The archive or its XML is damaged, or the XML has a document type.
    EmptyMesh, TooLarge
        There is nothing to build, or more than ``limits`` allow.
    """
    zipped = archive(data, limits)
    model = _parsed(pieces(zipped, _model_part(zipped), limits), limits)
    if model.unit not in _UNITS:
        raise DamagedMesh(f"the 3MF has no valid unit ({model.unit[:20]!a}): export it again")
    unit, scale = _UNITS[model.unit]
    built = list(_built(model, limits))
    if not built:
        raise EmptyMesh("the 3MF builds no object: export a triangle mesh")
    check_counts(
        sum(shape.points.count for shape, _ in built),
        sum(shape.corners.count for shape, _ in built),
        limits,
    )
    scaled = np.diag([scale, scale, scale, 1.0])
    parts = [
        Part(shape.points.rows(), shape.corners.rows(), scaled @ placing)
        for shape, placing in built
    ]
    return joined_parts(parts, len(parts), unit)


def _model_part(zipped: ZipFile) -> ZipInfo:
    """The part that holds the model: the usual one, or the only one."""
    models = [part for part in zipped.filelist if part.filename.lower().endswith(_SUFFIX)]
    usual = [part for part in models if part.filename.lower().lstrip("/") == _USUAL]
    if len(usual) == 1:
        return usual[0]
    if len(models) != 1:
        raise UnknownFormat(f"the 3MF archive has {len(models)} models: export the foot alone")
    return models[0]


@dataclass(slots=True)
class _Triples:
    """Words that come in threes, and what turns them into numbers."""

    numbers: Callable[[bytes, int], NDArray[Any]]
    text: bytearray = field(default_factory=bytearray)
    count: int = 0

    def add(self, first: str, second: str, third: str) -> None:
        self.text += f"{first} {second} {third}\n".encode()
        self.count += 1

    def rows(self) -> NDArray[Any]:
        """All numbers, (count, 3)."""
        return self.numbers(bytes(self.text), 3 * self.count).reshape(-1, 3)


@dataclass(slots=True)
class _Shape:
    """An object: a mesh, or other objects that it puts together."""

    points: _Triples = field(default_factory=lambda: _Triples(floats))
    corners: _Triples = field(default_factory=lambda: _Triples(integers))
    components: list[Step] = field(default_factory=list)


@dataclass(slots=True)
class _Model:
    """The parts of the XML that have been read."""

    limits: Limits
    unit: str = "millimeter"
    shapes: dict[str, _Shape] = field(default_factory=dict)
    items: list[Step] = field(default_factory=list)
    current: _Shape = field(default_factory=_Shape)
    others: int = 0

    def element(self, name: str, attributes: Attributes) -> None:
        """Take the beginning of any element."""
        if name == _CORE + "vertex":
            self.current.points.add(attributes["x"], attributes["y"], attributes["z"])
        elif name == _CORE + "triangle":
            self.current.corners.add(attributes["v1"], attributes["v2"], attributes["v3"])
        else:
            self.others += 1
            if self.others > self.limits.elements:
                raise TooLarge(
                    "the 3MF's XML has far more parts than a mesh has: export the foot as STL"
                )
            self._take_other(name, attributes)

    def _take_other(self, name: str, attributes: Attributes) -> None:
        """Take the beginning of an element that is no part of a mesh."""
        if name == _CORE + "model":
            self.unit = attributes.get("unit", self.unit)
            needed = attributes.get("requiredextensions", "").split()
            if needed:
                raise UnknownFormat(
                    f"the 3MF needs the extension {needed[0][:20]!a}, which footfit does not read:"
                    " export a plain 3MF, or STL"
                )
        elif name == _CORE + "object":
            if attributes["id"] in self.shapes:
                raise DamagedMesh("two objects of the 3MF have the same id: export it again")
            self.current = self.shapes[attributes["id"]] = _Shape()
        elif name == _CORE + "component":
            self.current.components.append(_step(attributes))
        elif name == _CORE + "item":
            self.items.append(_step(attributes))


def _step(attributes: Attributes) -> Step:
    if any(name.endswith(" path") for name in attributes):
        raise UnknownFormat("the 3MF keeps its mesh in another part: export a plain 3MF, or STL")
    return attributes["objectid"], attributes.get("transform")


def _parsed(chunks: Iterator[bytes], limits: Limits) -> _Model:
    """The model that the XML in ``chunks`` describes."""
    model = _Model(limits)
    parser = expat.ParserCreate(namespace_separator=" ")
    parser.StartDoctypeDeclHandler = _no_doctype
    parser.StartElementHandler = model.element
    fed = 0
    try:
        for chunk in chunks:
            parser.Parse(chunk, False)
            fed += len(chunk)
            shapes = model.shapes.values()
            check_counts(
                sum(shape.points.count for shape in shapes),
                sum(shape.corners.count for shape in shapes),
                limits,
            )
            if fed - parser.CurrentByteIndex > limits.document_bytes:  # parsing turns quadratic
                raise TooLarge(
                    "the 3MF's XML has a tag of several megabytes: export the foot as STL"
                )
        parser.Parse(b"", True)
    except (expat.ExpatError, KeyError) as error:
        raise DamagedMesh(
            "the 3MF's XML is not valid: the file is damaged, export it again"
        ) from error
    return model


def _no_doctype(*_: object) -> NoReturn:
    raise DamagedMesh(
        "the 3MF's XML has a document type, which a 3MF must not have: export it again"
    )


def _built(model: _Model, limits: Limits) -> Iterator[tuple[_Shape, Floats]]:
    """Each mesh that the build shows, with the (4, 4) transform to the build's frame."""

    def node(step: Step) -> tuple[Floats, list[Step]]:
        name, transform = step
        if name not in model.shapes:
            raise DamagedMesh("the 3MF builds an object that it does not have: export it again")
        return _transform(transform), model.shapes[name].components

    for (name, _), placing in placed_nodes(model.items, node, limits):
        if not model.shapes[name].components:
            yield model.shapes[name], placing


def _transform(words: str | None) -> Floats:
    """The (4, 4) matrix of a transform's 12 numbers: three columns, then the shift."""
    matrix = np.eye(4)
    if words is not None:
        matrix[:3] = floats(words.encode(), _TRANSFORM).reshape(4, 3).T
    return matrix
