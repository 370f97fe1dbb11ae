"""The search file of a large catalogue: what a search by flare reads, mapped into memory.

It lies beside the catalogue and is made from the search blocks. It is only used if it was made of
the catalogue as it is now, and what is read of it is verified. Without it the answers are the same.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, BinaryIO, NoReturn

import numpy as np
from numpy.typing import NDArray

from footfit.catalogue.blocks.block_bytes import checksum, odd_factors
from footfit.catalogue.file.descriptors import DESCRIPTORS
from footfit.catalogue.file.dialect import Driver
from footfit.geometry.flare.bottom_curves import extended_stations
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition
from footfit.geometry.flare.profile_distance import DISTANCE, inside
from footfit.geometry.flare.profile_sketch import SKETCH, Sketches, sketches
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.locations import Location
from footfit.results.columns.last_columns import ARRAYS, LastColumns
from footfit.results.columns.packed_names import PackedNames, packed
from footfit.results.columns.vocabulary import Vocabulary
from footfit.whole_files import partial_beside

SUFFIX = ".search"
LEAST_LASTS = 4_096
"""A smaller catalogue has no search file: its blocks are read in some hundredths of a second."""
LAYOUT = f"search/3 {SKETCH} {DISTANCE}"
"""What a search file of this footfit is."""
MAGIC = b"footfit search\0\0"
START, ALIGNED = len(MAGIC) + 32, 64
PIECE_BYTES = 1 << 19
"""A hash takes so many bytes at a time: they stay in the processor's cache."""
WAL = b"\x02\x02"
"""In the header of a catalogue whose last changes lie in another file."""
LATER = ("sketches", "profiles")
"""What is verified when it is read."""
NOT_TRUSTED: set[str] = set()
"""The marks of search files that this process found damaged."""


class OtherCatalogue(Exception):
    """The catalogue was changed since its lasts were read; they must be read again."""


class BadSearchFile(OtherCatalogue):
    """The search file is not what was written: it is not used again by this process."""


@dataclass(frozen=True, slots=True)
class SearchFile:
    """The columns of an open search file. ``mark`` is that of the catalogue it was made of.

    ``base``, ``blocks`` and ``starts`` are those of `BlockLasts`. ``by_label`` are the rows in the
    order of their labels' numbers, then of their extents.
    """

    mark: str
    base: LastColumns
    blocks: Ints
    starts: Ints
    by_label: Ints
    _sketches: Sketches
    _sketch_hash: str
    _profiles: NDArray[np.uint64]
    _verified: set[str] = field(default_factory=set)

    def sketches(self) -> Sketches:
        """The sketch of each last; raises BadSearchFile."""
        if not self._verified:
            self._require(_hash(self._sketches) == self._sketch_hash)
            self._verified.add("sketches")
        return self._sketches

    def curves(self, rows: Ints) -> Floats:
        """The flare profiles of some lasts (k, channels, stations), of the stations that count;
        NaN where there is none. Raises BadSearchFile.
        """
        there = self._profiles[rows]
        self._require(bool((there[:, -1] == _row_hashes(there, rows)).all()))
        return _curves(there)

    def _require(self, sound: bool) -> None:
        if not sound:
            self.refuse()

    def refuse(self) -> NoReturn:
        """Use this file no more in this process."""
        NOT_TRUSTED.add(self.mark)
        raise BadSearchFile


def mark_of(connection: Driver, location: Location) -> str | None:
    """A mark of the catalogue as it is, inside a transaction; None if it can have no search file.

    It is made of the header of the file, which every commit changes, of its size and time, and of
    the hashes of its newest lasts.
    """
    if not isinstance(location, Path):
        return None
    header, status = DESCRIPTORS.first_bytes(location, 100), location.stat()
    if header[18:20] == WAL:
        return None
    select = "SELECT id, record_sha256 FROM last NOT INDEXED ORDER BY id DESC LIMIT 3"
    newest = connection.execute(select).fetchall()
    words = (header.hex(), status.st_size, status.st_mtime_ns, newest, LAYOUT)
    return hashlib.sha256(repr(words).encode()).hexdigest()


def search_path(catalogue: Path) -> Path:
    """Where the search file of a catalogue lies."""
    return catalogue.with_name(catalogue.name + SUFFIX)


def drop_search_file(location: Location) -> None:
    """Remove the search file of a catalogue that was changed: it must not keep what was removed."""
    if isinstance(location, Path):
        with suppress(OSError):
            search_path(location).unlink(missing_ok=True)


# ---------------------------------------------------------------- reading


def open_search_file(location: Location, mark: str | None) -> SearchFile | None:
    """The search file that was made of a catalogue with this mark; None if there is none."""
    if mark is None or mark in NOT_TRUSTED or not isinstance(location, Path):
        return None
    try:
        if not search_path(location).is_file():  # a pipe would be waited for
            return None
        whole = np.memmap(search_path(location), dtype=np.uint8, mode="r")
        return _opened(whole, mark)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _opened(whole: NDArray[np.uint8], mark: str) -> SearchFile | None:
    """The columns of a mapped file; None if it is another catalogue's, or damaged.

    Raises
    ------
    ValueError, KeyError, TypeError
        It is no search file.
    """
    lengths = whole[len(MAGIC) : START].tobytes()
    size, digest = int(lengths[:16], 16), lengths[16:].decode("ascii")
    text = whole[START : START + size].tobytes()
    if whole[: len(MAGIC)].tobytes() != MAGIC or checksum(text) != digest:
        return None
    header = json.loads(text)
    if header["mark"] != mark or header["bytes"] != len(whole):
        return None
    arrays: dict[str, Any] = {}
    for name, row in header["arrays"].items():
        kind, shape, at, digest = row
        arrays[name] = np.asarray(whole[at : at + _bytes(row)]).view(kind).reshape(shape)
        if name not in LATER and _hash(arrays[name]) != digest:
            return None
    words = Vocabulary()
    for part in fields(Vocabulary):
        getattr(words, part.name).numbers_of(json.dumps(header["words"][part.name]))
    ends = arrays["name_ends"]
    base = LastColumns(
        words=words,
        names=PackedNames(arrays["names"], ends, np.arange(len(ends))),
        **{name: arrays[name] for name in ARRAYS},
    )
    return SearchFile(
        mark,
        base,
        arrays["blocks"],
        arrays["starts"],
        arrays["by_label"],
        arrays["sketches"],
        header["arrays"]["sketches"][3],
        arrays["profiles"],
    )


def _bytes(row: Sequence[Any]) -> int:
    """The size of an array of the header's table: its kind, its shape, where it is, its hash."""
    return int(math.prod(row[1]) * np.dtype(row[0]).itemsize)


def _curves(profiles: NDArray[np.uint64]) -> Floats:
    """The curves (k, channels, stations) of rows of profiles; a view."""
    return profiles[:, :-1].view(np.float64).reshape(len(profiles), len(CHANNELS), -1)


def _hash(array: NDArray[Any]) -> str:
    """The hash of an array: that of the hashes of its pieces."""
    data = np.ascontiguousarray(array).reshape(-1).view(np.uint8).data
    pieces = range(0, len(data), PIECE_BYTES)
    return checksum("".join(checksum(data[at : at + PIECE_BYTES]) for at in pieces).encode())


def _row_hashes(profiles: NDArray[np.uint64], rows: Ints) -> NDArray[np.uint64]:
    """The hash of each row of profiles, without its last number: it knows its place."""
    factors = odd_factors(profiles.shape[1])
    hashes: NDArray[np.uint64] = np.einsum("ij,j->i", profiles[:, :-1], factors[:-1])
    hashes += (rows.astype(np.uint64) + np.uint64(1)) * factors[-1]
    return hashes


# ---------------------------------------------------------------- writing


def write_search_file(
    location: Location,
    mark: str,
    lasts: tuple[LastColumns, Ints, Ints],
    chunks: Iterable[tuple[int, LastColumns]],
) -> None:
    """Write the search file of a catalogue; what cannot be written is left out.

    ``lasts`` are the base columns, the blocks and their starts. ``chunks`` are the lasts with their
    flare profiles, each time with the row of the first.
    """
    assert isinstance(location, Path)
    final = search_path(location)
    with suppress(OSError), partial_beside(final) as partial:
        with partial.open("r+b") as file:
            _write(file, mark, lasts, chunks)
        partial.chmod(location.stat().st_mode & 0o666)
        partial.replace(final)


def _write(
    file: BinaryIO,
    mark: str,
    lasts: tuple[LastColumns, Ints, Ints],
    chunks: Iterable[tuple[int, LastColumns]],
) -> None:
    base, blocks, starts = lasts
    part = inside(extended_stations(FlareDefinition())[1:-1])
    drawn = np.empty((len(base), SKETCH.width), dtype=np.float32)
    profile = (len(base), len(CHANNELS) * (part.stop - part.start) + 1)
    text, ends = packed(base.names)
    arrays: dict[str, NDArray[Any]] = {name: getattr(base, name) for name in ARRAYS}
    arrays |= {"blocks": blocks, "starts": starts, "names": text, "name_ends": ends}
    arrays |= {"sketches": drawn, "by_label": np.lexsort((base.extent_mm, base.label))}
    words = {part.name: getattr(base.words, part.name).values for part in fields(Vocabulary)}
    header: dict[str, Any] = {"mark": mark, "words": words, "bytes": 1 << 60}
    table: dict[str, Any] = {
        name: [each.dtype.str, each.shape, 1 << 60, "0" * 16] for name, each in arrays.items()
    }
    table["profiles"] = ["<u8", profile, 1 << 60, ""]
    at = START + len(json.dumps({**header, "arrays": table}))
    for row in table.values():
        row[2] = at = at + -at % ALIGNED
        at += _bytes(row)
    file.seek(table["profiles"][2])
    for first, chunk in chunks:
        rows = _profile_rows(chunk, part, np.arange(first, first + len(chunk)), profile[1])
        drawn[first : first + len(chunk)] = sketches(_curves(rows))
        file.write(rows.data)
    for name, array in arrays.items():
        file.seek(table[name][2])
        file.write(np.ascontiguousarray(array).data)
        table[name][3] = _hash(array)
    written = json.dumps({**header, "bytes": at, "arrays": table}).encode("ascii")
    file.seek(0)
    file.write(MAGIC + f"{len(written):016x}{checksum(written)}".encode() + written)
    file.truncate(at)


def _profile_rows(chunk: LastColumns, part: slice, places: Ints, width: int) -> NDArray[np.uint64]:
    """Profiles as rows of words: the curves at the stations that count, and a hash.

    Lasts with other stations than this footfit's are not ranked: they have no curves.
    """
    assert chunk.flare is not None
    assert chunk.flare.plan is not None
    assert chunk.flare.bottom is not None
    rows = np.empty((len(chunk), width), dtype=np.uint64)
    curves = _curves(rows)
    curves[:] = np.nan
    current = chunk.stations == FlareDefinition().stations
    curves[current, 0] = chunk.flare.plan[current, part]
    curves[current, 1:] = chunk.flare.bottom[current, :, part]
    rows[:, -1] = _row_hashes(rows, places)
    return rows
