"""PLY, ASCII and binary: a header that declares elements, then the rows of each."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.polygons import polygon_triangles, whole
from footfit.meshes.formats.raw import RawMesh, check_counts, doubles
from footfit.meshes.formats.tokens import floats, unix_text, word_offsets
from footfit.meshes.read_limits import Limits

_NAMES = "char uchar short ushort int uint float double float32 float64"
_CODES = "i1 u1 i2 u2 i4 u4 f4 f8 f4 f8"
_TYPES = dict(zip(_NAMES.split(), _CODES.split(), strict=True)) | {
    f"{name}{8 * size}": f"{name[0]}{size}" for name in ("int", "uint") for size in (1, 2, 4, 8)
}
_ORDERS = {b"ascii": "", b"binary_little_endian": "<", b"binary_big_endian": ">"}
_INDEX_LISTS = ("vertex_indices", "vertex_index")
_MOST_CORNERS_DECLARED = 2**32


@dataclass(frozen=True, slots=True)
class _Property:
    """A value in each row, or a list of values; the types have the file's byte order."""

    name: str
    type: np.dtype[np.generic]
    count_type: np.dtype[np.generic] | None = None


@dataclass(frozen=True, slots=True)
class _Element:
    """A table of the file."""

    name: str
    count: int
    properties: tuple[_Property, ...]

    @property
    def smallest(self) -> int:
        """The fewest bytes that a row can have."""
        return sum((p.count_type or p.type).itemsize for p in self.properties)


@dataclass(frozen=True, slots=True)
class _Column:
    """A property in all rows: its values end to end, and each row's count if it is a list."""

    values: NDArray[np.generic]
    counts: Ints | None


def is_ply(data: bytes) -> bool:
    """Whether the file begins with PLY's first line."""
    return data[:4] in (b"ply\n", b"ply\r")


def read_ply(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of a PLY file; polygons become triangles, other elements are ignored.

    Raises
    ------
    DamagedMesh
        The header is not valid, or declares more than the file holds.
    TooLarge
        A count is over ``limits``.
    """
    order, elements, begin = _header(data, limits)
    counts = {element.name: element.count for element in elements}
    check_counts(counts.get("vertex", 0), counts.get("face", 0), limits)
    body = data[begin:]
    if order == "":
        body = _numbers_as_doubles(body)
    columns: dict[str, dict[str, _Column]] = {"vertex": {}, "face": {}}
    offset, missing = 0, columns.keys() & counts.keys()
    for element in elements:
        if not missing:
            break
        rows, offset = _rows(body, offset, element)
        columns[element.name] = rows
        missing = missing - {element.name}
    vertices = _vertices(columns["vertex"])
    corners, sizes = _polygons(columns["face"])
    return RawMesh(vertices, *polygon_triangles(vertices, corners, sizes, limits))


def _numbers_as_doubles(text: bytes) -> bytes:
    """An ASCII body as a binary body in which every number is a double."""
    text = unix_text(text)
    words = word_offsets(np.frombuffer(text, dtype=np.uint8)) if text else ()
    return floats(text, len(words)).astype("<f8").tobytes()


# ---------------------------------------------------------------- header


def _header(data: bytes, limits: Limits) -> tuple[str, tuple[_Element, ...], int]:
    """The byte order ("" for ASCII), the elements, and where the body begins."""
    newline = b"\r\n" if data[3:5] == b"\r\n" else data[3:4]
    mark = newline + b"end_header"
    at = data.find(mark, 0, limits.header_bytes)
    begin = data.find(newline, at + len(mark)) + len(newline)
    if at < 0 or begin < len(newline) or data[at + len(mark) : begin].strip():
        raise DamagedMesh("the PLY file's header does not end: it is damaged, export it again")
    lines = [line.split() for line in data[:at].split(newline)[1:]]
    lines = [words for words in lines if words and words[0] not in (b"comment", b"obj_info")]
    if not lines or lines[0][0] != b"format" or lines[0][1:2] == [] or lines[0][1] not in _ORDERS:
        raise DamagedMesh("the PLY file does not say its format: export it again")
    order = _ORDERS[lines[0][1]]
    return order, _elements(lines[1:], order), begin


def _elements(lines: list[list[bytes]], order: str) -> tuple[_Element, ...]:
    elements: list[_Element] = []
    for words in lines:
        if words[0] == b"element" and len(words) == 3 and words[2].isdigit() and len(words[2]) < 16:
            elements.append(_Element(_text(words[1]), int(words[2]), ()))
        elif words[0] == b"property" and elements:
            last = elements.pop()
            properties = (*last.properties, _property(words[1:], order))
            elements.append(_Element(last.name, last.count, properties))
        else:
            raise DamagedMesh("a line of the PLY file's header is not valid: export it again")
    names = [element.name for element in elements]
    if len(set(names)) < len(names):
        raise DamagedMesh("the PLY file declares an element twice: export it again")
    return tuple(elements)


def _property(words: list[bytes], order: str) -> _Property:
    if len(words) == 2:
        return _Property(_text(words[1]), _type(words[0], order))
    if len(words) == 4 and words[0] == b"list":
        return _Property(_text(words[3]), _type(words[2], order), _type(words[1], order))
    raise DamagedMesh("a property of the PLY file's header is not valid: export it again")


def _type(word: bytes, order: str) -> np.dtype[np.generic]:
    code = _TYPES.get(_text(word))
    if code is None:
        raise DamagedMesh("the PLY file uses a number type that does not exist: export it again")
    return np.dtype(order + code) if order else np.dtype("<f8")


def _text(word: bytes) -> str:
    return word.decode("latin-1")


# ---------------------------------------------------------------- rows


def _rows(body: bytes, offset: int, element: _Element) -> tuple[dict[str, _Column], int]:
    """All rows of an element and where the next one begins."""
    if element.count * element.smallest > len(body) - offset:
        raise DamagedMesh(
            f"the PLY file declares {element.count:,} rows of {ascii(element.name)[:40]} but ends"
            " before them: it is cut off, copy or export it again"
        )
    if element.count == 0:
        return {}, offset
    lengths = [column.counts for column in _walked(body, offset, element, 1)[0].values()]
    table = _table(body, offset, element, [None if n is None else int(n[0]) for n in lengths])
    if table is not None:
        return _columns(table, element), offset + table.nbytes
    return _walked(body, offset, element, element.count)


def _table(
    body: bytes, offset: int, element: _Element, lengths: list[int | None]
) -> NDArray[np.void] | None:
    """The rows as a structured array; None unless every list is as long as in the first row."""
    fields: list[tuple[str, np.dtype[np.generic], tuple[int, ...]]] = []
    for place, (declared, length) in enumerate(zip(element.properties, lengths, strict=True)):
        if declared.count_type is not None:
            fields.append((f"n{place}", declared.count_type, ()))
        fields.append((f"v{place}", declared.type, () if length is None else (length,)))
    layout = np.dtype(fields)
    if element.count * layout.itemsize > len(body) - offset:
        return None
    table = np.frombuffer(body, dtype=layout, count=element.count, offset=offset)
    same = all(
        length is None or bool((table[f"n{place}"] == length).all())
        for place, length in enumerate(lengths)
    )
    return table if same else None


def _columns(table: NDArray[np.void], element: _Element) -> dict[str, _Column]:
    columns = {}
    for place, declared in enumerate(element.properties):
        counts = None if declared.count_type is None else table[f"n{place}"].astype(np.int64)
        columns[declared.name] = _Column(table[f"v{place}"].reshape(-1), counts)
    return columns


def _walked(
    body: bytes, offset: int, element: _Element, count: int
) -> tuple[dict[str, _Column], int]:
    """The first ``count`` rows, read row by row, since lists differ in length."""
    pieces = [bytearray() for _ in element.properties]
    counts: list[list[int]] = [[] for _ in element.properties]
    for _ in range(count):
        for place, declared in enumerate(element.properties):
            length = 1
            if declared.count_type is not None:
                length = _list_length(body, offset, declared.count_type)
                offset += declared.count_type.itemsize
                counts[place].append(length)
            end = offset + length * declared.type.itemsize
            if end > len(body):
                raise DamagedMesh("the PLY file ends within a row: it is cut off, copy it again")
            pieces[place] += body[offset:end]
            offset = end
    columns = {}
    for declared, piece, lengths in zip(element.properties, pieces, counts, strict=True):
        values = np.frombuffer(bytes(piece), dtype=declared.type)
        is_list = declared.count_type is not None
        columns[declared.name] = _Column(values, np.array(lengths, np.int64) if is_list else None)
    return columns, offset


def _list_length(body: bytes, offset: int, count_type: np.dtype[np.generic]) -> int:
    if offset + count_type.itemsize > len(body):
        raise DamagedMesh("the PLY file ends within a row: it is cut off, copy it again")
    order = ">" if count_type.str[0] == ">" else "<"
    (length,) = struct.unpack_from(order + count_type.char, body, offset)
    if not 0 <= length < _MOST_CORNERS_DECLARED or length != int(length):
        raise DamagedMesh("a list of the PLY file has an impossible length: export it again")
    return int(length)


# ---------------------------------------------------------------- mesh


def _vertices(columns: dict[str, _Column]) -> Floats:
    if not columns:
        return np.empty((0, 3))
    axes = [columns[name] for name in ("x", "y", "z") if name in columns]
    if len(axes) < 3 or any(axis.counts is not None for axis in axes):
        raise DamagedMesh("the vertices of the PLY file lack x, y or z: export it again")
    return np.stack([doubles(axis.values) for axis in axes], axis=1)


def _polygons(columns: dict[str, _Column]) -> tuple[Ints, Ints]:
    """The corners of all faces, end to end, and how many each face has."""
    if not columns:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    corners = next((columns[name] for name in _INDEX_LISTS if name in columns), None)
    if corners is None or corners.counts is None:
        raise DamagedMesh("the faces of the PLY file name no vertices: export it again")
    return whole(corners.values), corners.counts
