"""Reading blocks: the lasts of a catalogue by column, and the rows of the few that are shown.

Rows are the truth. A block is used only if its layout is this footfit's and its hash is right;
the lasts of any other block are read from their rows.
"""

from __future__ import annotations

import struct
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace

import numpy as np

from footfit.catalogue.blocks.block_bytes import (
    BOTTOM,
    LASTS,
    LAYOUTS,
    MEASURES,
    PARTS,
    PLAN,
    READERS,
    TOES,
    block_of,
    checksum,
    lasts_of,
)
from footfit.catalogue.blocks.record_columns import columns_of
from footfit.catalogue.blocks.row_columns import columns_of_rows, last_of_rows
from footfit.catalogue.blocks.same_lasts import same_lasts
from footfit.catalogue.blocks.search_file import (
    LEAST_LASTS,
    OtherCatalogue,
    SearchFile,
    mark_of,
    open_search_file,
    write_search_file,
)
from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.rows.verified_rows import LastRows, stored_lasts
from footfit.catalogue.server.any_location import open_location_for_reading, stamp_of
from footfit.geometry.numeric.arrays import Bools, Ints, distinct
from footfit.locations import Location
from footfit.results import LastRecord
from footfit.results.columns.last_columns import SPOILT, LastColumns, joined
from footfit.results.columns.vocabulary import Vocabulary

CHUNK_BLOCKS = 16
"""So many blocks are looked at together: 4,096 lasts take some MB."""
BLOCKS_ANEW = "type: footfit upgrade-catalogue, which makes it anew"
KEPT_BYTES = 4_000_000
"""What is read of blocks stays in memory up to this size for each part; if it is asked for again,
as for the next customer, whatever its size.
"""


class BadBlocks(Exception):
    """Blocks that are not what was stored: their lasts must be read from their rows."""

    def __init__(self, blocks: Iterable[int]) -> None:
        self.blocks = frozenset(blocks)
        numbers = ", ".join(map(str, sorted(self.blocks)))
        super().__init__(f"these search blocks are not what was stored: {numbers}")


@dataclass(frozen=True, slots=True)
class ShownLast:
    """A last of an answer: its record, or None if its rows are damaged.

    ``spoilt`` says that its kept sections are damaged, and that its block does not know it.
    """

    record: LastRecord | None
    spoilt: bool = False


@dataclass
class BlockLasts:
    """The lasts of a catalogue file, by their blocks.

    ``base`` are all of them without measures, profiles and toes, block by block: ``blocks`` (b,)
    and ``starts`` (b + 1,) say where each begins. ``from_rows`` are the lasts whose blocks are not
    used, with all columns; in ``base`` they come last. ``damaged`` names the lasts that are left
    out because their rows are damaged, and ``bad`` the blocks that are not what was stored.
    ``search`` is the catalogue's search file, if it has one; then every last has a block.
    """

    path: Location
    stamp: bytes
    base: LastColumns
    blocks: Ints
    starts: Ints
    from_rows: LastColumns
    damaged: tuple[str, ...]
    bad: frozenset[int]
    search: SearchFile | None = None
    spoilt: frozenset[int] = frozenset()
    _kept: dict[tuple[str, int], bytes] = field(default_factory=dict)
    _asked: Counter[str] = field(default_factory=Counter)

    def chunks(self, parts: Sequence[str]) -> Iterator[tuple[int, LastColumns]]:
        """All lasts with these parts, some thousand at a time, each time with the first's row.

        Raises
        ------
        OtherCatalogue, BadBlocks
            The catalogue was changed meanwhile; a part is not what was stored.
        """
        with self._snapshot(parts) as connection:
            yield from self.block_chunks(connection, parts)
        if len(self.from_rows):
            yield int(self.starts[-1]), _only(self.from_rows, parts)

    def block_chunks(
        self, connection: Driver, parts: Sequence[str]
    ) -> Iterator[tuple[int, LastColumns]]:
        """The lasts that are read from blocks, as `chunks` gives them."""
        for first in range(0, len(self.blocks), CHUNK_BLOCKS):
            last = min(first + CHUNK_BLOCKS, len(self.blocks))
            yield int(self.starts[first]), self._read(connection, first, last, parts)

    def taken(self, chosen: Ints, parts: Sequence[str]) -> LastColumns:
        """Some lasts with these parts, in the order of ``chosen``; raises as `chunks`."""
        with self._snapshot(parts) as connection:
            return self._taken(connection, chosen, parts)

    def _taken(self, connection: Driver, chosen: Ints, parts: Sequence[str]) -> LastColumns:
        order = np.argsort(chosen, kind="stable")
        wanted = chosen[order]
        of_block = np.searchsorted(self.starts, wanted, side="right") - 1
        picked, apart = [], _only(self.from_rows, parts)
        for at in distinct(of_block).tolist():
            rows_there = wanted[of_block == at] - self.starts[at]
            there = at < len(self.blocks)
            lasts = self._read(connection, at, at + 1, parts) if there else apart
            picked.append(lasts.taken(rows_there))
        lasts = joined(picked or [apart.taken(chosen)]).taken(np.argsort(order))
        return _spoilt(lasts, np.isin(chosen, list(self.spoilt))) if self.spoilt else lasts

    def with_spoilt(self, chosen: Sequence[int]) -> BlockLasts:
        """The lasts, where the kept sections of some are damaged."""
        return replace(self, spoilt=self.spoilt | set(chosen))

    def shown(self, chosen: Sequence[int]) -> list[ShownLast]:
        """The records of a few lasts, from their rows, which are verified.

        Raises
        ------
        OtherCatalogue, BadBlocks
            The catalogue was changed meanwhile; a block does not say what the rows say.
        """
        parts = PARTS[1:]
        with self._snapshot(parts) as connection:
            mine = self._taken(connection, np.array(chosen, dtype=np.int64), parts)
            return [
                self._shown(connection, row, mine.taken(slice(at, at + 1)))
                for at, row in enumerate(chosen)
            ]

    # ------------------------------------------------------------ reading

    def _read(self, connection: Driver, first: int, last: int, parts: Sequence[str]) -> LastColumns:
        """The lasts of some neighbouring blocks."""
        ordered = [part for part in PARTS if part in parts]
        of_parts = [self._data(connection, part, first, last) for part in ordered]
        found = []
        for at in range(first, last):
            rows_there = slice(int(self.starts[at]), int(self.starts[at + 1]))
            lasts = replace(self.base.taken(rows_there), names=())
            for part, data in zip(ordered, of_parts, strict=True):
                try:
                    lasts = READERS[part](lasts, data[at - first])
                except (ValueError, IndexError, struct.error) as error:
                    raise BadBlocks([int(self.blocks[at])]) from error
            found.append(lasts)
        names = self.base.names[int(self.starts[first]) : int(self.starts[last])]
        return replace(joined(found), names=names)

    def _data(self, connection: Driver, part: str, first: int, last: int) -> list[bytes]:
        """One part of some neighbouring blocks, verified."""
        blocks = self.blocks[first:last].tolist()
        if all((part, block) in self._kept for block in blocks):
            return [self._kept[part, block] for block in blocks]
        select = f"SELECT {STORED} FROM search_block WHERE part = ? AND block BETWEEN ? AND ?"
        stored = connection.execute(select, (part, blocks[0], blocks[-1]))
        found = {
            block: data for block, layout, data, digest in stored if is_sound(layout, data, digest)
        }
        bad = frozenset(blocks) - found.keys()
        if bad:
            raise BadBlocks(bad)
        often = self._asked[part] > 1
        if often or len(self.blocks) * len(found[blocks[0]]) < KEPT_BYTES:
            self._kept |= {(part, block): found[block] for block in blocks}
        return [found[block] for block in blocks]

    def _shown(self, connection: Driver, row: int, mine: LastColumns) -> ShownLast:
        """The record of a last; ``mine`` is what its block says of it."""
        (key,) = mine.keys.tolist()
        stored = stored_lasts(connection, key)
        if not stored:
            raise BadBlocks([block_of(key)])
        if not stored[0].intact:
            return ShownLast(None)
        record, kept = last_of_rows(connection, stored[0])
        rows_say = columns_of(
            [record], [kept], self.base.words, keys=[key], profiles=[stored[0].definition]
        )
        if kept == SPOILT:
            rows_say = replace(rows_say, toes=None)
        if row < self.starts[-1] and not same_lasts(mine, rows_say):
            if self.search is not None:
                self.search.refuse()
            raise BadBlocks([block_of(key)])
        known = row in self.spoilt or row >= self.starts[-1]
        return ShownLast(record, spoilt=kept == SPOILT and not known)

    @contextmanager
    def _snapshot(self, parts: Sequence[str]) -> Iterator[Driver]:
        """The catalogue as it was when the lasts were read."""
        for part in parts:
            self._asked[part] += 1
        file, _ = open_location_for_reading(self.path, Schema(), SETTINGS.busy_timeout_s)
        try:
            with file.reading() as connection:
                if stamp_of(connection, self.path) != self.stamp:
                    raise OtherCatalogue
                yield connection
        finally:
            file.close()


STORED = "block, layout, data, hash"


def is_sound(layout: object, data: object, digest: object) -> bool:
    """Whether a part is what this footfit stored."""
    if layout not in LAYOUTS or not isinstance(data, bytes):
        return False
    return digest == checksum(data, str(layout))


def block_lasts(
    connection: Driver, path: Location, untrusted: frozenset[int] = frozenset()
) -> BlockLasts:
    """The lasts of a catalogue, inside a transaction; blocks in ``untrusted`` are not used.

    A large catalogue gets a search file, if all its lasts are in blocks; it is used the next time.
    """
    stamp, mark = stamp_of(connection, path), None if untrusted else mark_of(connection, path)
    search = open_search_file(path, mark)
    if search is not None:
        nothing = columns_of_rows(connection, [], search.base.words)
        columns = (search.base, search.blocks, search.starts, nothing)
        return BlockLasts(path, stamp, *columns, (), frozenset(), search)
    lasts = _of_blocks(connection, path, stamp, untrusted)
    whole = not lasts.bad and not lasts.damaged and not len(lasts.from_rows)
    if mark is not None and whole and len(lasts.base) >= LEAST_LASTS:
        chunks = lasts.block_chunks(connection, (PLAN, BOTTOM))
        with suppress(BadBlocks):
            write_search_file(path, mark, (lasts.base, lasts.blocks, lasts.starts), chunks)
    return lasts


def _of_blocks(
    connection: Driver, path: Location, stamp: bytes, untrusted: frozenset[int]
) -> BlockLasts:
    """The lasts of a catalogue by their blocks alone."""
    words, found, bad = Vocabulary(), {}, set(untrusted)
    select = f"SELECT {STORED} FROM search_block WHERE part = ? ORDER BY block"
    for block, layout, data, digest in connection.execute(select, (LASTS,)):
        if block in untrusted:
            continue
        lasts = lasts_of(data, words) if is_sound(layout, data, digest) else None
        if lasts is None or any(block_of(int(key)) != block for key in lasts.keys[[0, -1]]):
            bad.add(block)
        else:
            found[block] = lasts
    (total,) = connection.execute("SELECT count(*) FROM last").fetchone()
    apart: list[LastRows] = []
    if total != sum(map(len, found.values())) or bad:
        apart = _beside_blocks(connection, found, bad)
    intact = [stored for stored in apart if stored.intact]
    bad |= {block_of(stored.id) for stored in intact}  # a block lacks them, or is missing itself
    from_rows = columns_of_rows(connection, intact, words)
    parts = list(found.values())
    starts = np.cumsum([0, *map(len, parts)])
    return BlockLasts(
        path=path,
        stamp=stamp,
        base=joined([*map(_bare, parts), _bare(from_rows)]),
        blocks=np.array(list(found), dtype=np.int64),
        starts=starts,
        from_rows=from_rows,
        damaged=tuple(sorted(stored.name for stored in apart if not stored.intact)),
        bad=frozenset(bad),
    )


def _beside_blocks(
    connection: Driver, found: dict[int, LastColumns], bad: set[int]
) -> list[LastRows]:
    """The rows of the lasts that no block has. A block that has other lasts than there are rows
    is taken from ``found``.
    """
    keys = {key for (key,) in connection.execute("SELECT id FROM last NOT INDEXED")}
    for block, lasts in list(found.items()):
        if not keys.issuperset(lasts.keys.tolist()):
            del found[block]
            bad.add(block)
    known = {key for lasts in found.values() for key in lasts.keys.tolist()}
    return [stored for key in sorted(keys - known) for stored in stored_lasts(connection, key)]


def _bare(lasts: LastColumns) -> LastColumns:
    return _only(lasts, ())


def _only(lasts: LastColumns, parts: Sequence[str]) -> LastColumns:
    """Lasts with no more than these parts."""
    flare = lasts.flare if PLAN in parts else None
    if flare is not None and BOTTOM not in parts:
        flare = replace(flare, bottom=None)
    return replace(
        lasts,
        measures=lasts.measures if MEASURES in parts else None,
        flare=flare,
        toes=lasts.toes if TOES in parts else None,
    )


def _spoilt(lasts: LastColumns, rows: Bools) -> LastColumns:
    """Lasts where the kept sections of some are damaged."""
    if lasts.toes is None:
        return lasts
    return replace(lasts, toes=replace(lasts.toes, state=np.where(rows, SPOILT, lasts.toes.state)))
