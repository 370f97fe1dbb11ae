"""Writing blocks, in the transaction that changes the lasts."""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterable

import numpy as np

from footfit.catalogue.blocks.block_bytes import (
    BLOCK_LASTS,
    LASTS,
    LAYOUT,
    PARTS,
    READERS,
    block_of,
    checksum,
    lasts_of,
    parts_of,
)
from footfit.catalogue.blocks.block_reading import is_sound
from footfit.catalogue.blocks.row_columns import columns_of_rows
from footfit.catalogue.blocks.same_lasts import same_lasts
from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.verified_rows import stored_lasts
from footfit.results.columns.last_columns import SPOILT, LastColumns, joined
from footfit.results.columns.vocabulary import Vocabulary


def refresh_blocks(
    connection: Driver, keys: Iterable[int], fresh: LastColumns | None = None
) -> None:
    """Write the blocks of lasts that were added, changed or removed, from their rows.

    The other lasts of a block stay as they are in it; if the block is not what was stored, all of
    it is made from rows. A damaged last is in no block. ``fresh`` are lasts whose rows were written
    in this transaction: they are not read again.
    """
    changed = sorted(set(keys))
    for block in sorted({block_of(key) for key in changed}):
        _write(connection, block, _renewed(connection, block, changed, fresh))


def fill_blocks(connection: Driver) -> int:
    """Write every block that is missing or not what was stored; return how many."""
    wrong = wrong_blocks(connection)
    for block in wrong:
        _write(connection, block, _of_rows(connection, _keys(connection, block), Vocabulary()))
    return len(wrong)


def wrong_blocks(connection: Driver) -> list[int]:
    """The blocks that are missing, or do not say what their rows say."""
    keys = [key for (key,) in connection.execute("SELECT id FROM last NOT INDEXED")]
    stored = {block for (block,) in connection.execute("SELECT DISTINCT block FROM search_block")}
    blocks = sorted({block_of(key) for key in keys} | stored, key=repr)
    return [block for block in blocks if not agrees(connection, block)]


def agrees(connection: Driver, block: int) -> bool:
    """Whether a block is what its rows say; of toes within rounding, which differs by machine.

    A last whose rows are damaged may be in it or not. Damaged sections are a finding of their own.
    """
    words, keys = Vocabulary(), _keys(connection, block)
    stored = _whole(_sound_parts(connection, block), words)
    rows_say = _of_rows(connection, keys, words)
    if stored is None:
        there = connection.execute("SELECT 1 FROM search_block WHERE block = ?", (block,))
        return not len(rows_say) and there.fetchone() is None
    if not set(stored.keys.tolist()) <= set(keys):
        return False
    if rows_say.toes is not None:
        rows_say = rows_say.taken(np.flatnonzero(rows_say.toes.state != SPOILT))
    intact = np.flatnonzero(np.isin(stored.keys, rows_say.keys))
    return same_lasts(stored.taken(intact), rows_say)


def _sound_parts(connection: Driver, block: int) -> dict[str, bytes]:
    """The parts of a block that are what was stored, by name."""
    select = "SELECT part, layout, data, hash FROM search_block WHERE block = ?"
    return {
        part: data
        for part, layout, data, digest in connection.execute(select, (block,))
        if is_sound(layout, data, digest)
    }


def _keys(connection: Driver, block: int) -> list[int]:
    """The keys of the lasts of a block, in order."""
    first = block * BLOCK_LASTS
    select = "SELECT id FROM last NOT INDEXED WHERE id BETWEEN ? AND ? ORDER BY id"
    return [key for (key,) in connection.execute(select, (first, first + BLOCK_LASTS - 1))]


def _renewed(
    connection: Driver, block: int, changed: Collection[int], fresh: LastColumns | None
) -> LastColumns:
    """The lasts of a block, with those that changed from their rows."""
    words, keys = Vocabulary() if fresh is None else fresh.words, _keys(connection, block)
    parts = [] if fresh is None else [fresh.taken(np.flatnonzero(np.isin(fresh.keys, keys)))]
    if parts and len(parts[0]) == len(keys):
        return parts[0]
    parts.append(_kept(connection, block, keys, changed, words))
    there = {key for part in parts for key in part.keys.tolist()}
    parts.append(_of_rows(connection, [key for key in keys if key not in there], words))
    together = joined(parts)
    return together.taken(np.argsort(together.keys))


def _kept(
    connection: Driver,
    block: int,
    keys: Collection[int],
    changed: Collection[int],
    words: Vocabulary,
) -> LastColumns:
    """The lasts of a stored block that are still there and did not change; none of a wrong one."""
    old = _whole(_sound_parts(connection, block), words)
    if old is None:
        return columns_of_rows(connection, [], words)
    kept = np.isin(old.keys, list(keys)) & ~np.isin(old.keys, list(changed))
    return old.taken(np.flatnonzero(kept))


def _whole(parts: dict[str, bytes], words: Vocabulary) -> LastColumns | None:
    """A block with all its parts; None if it lacks one."""
    if set(parts) != set(PARTS):
        return None
    try:
        lasts = lasts_of(parts[LASTS], words)
        for part in PARTS[1:]:
            lasts = READERS[part](lasts, parts[part])
    except (ValueError, IndexError, struct.error):
        return None
    return lasts


def _of_rows(connection: Driver, keys: Iterable[int], words: Vocabulary) -> LastColumns:
    """Lasts from their rows, without those whose rows are damaged."""
    lasts = [stored for key in keys for stored in stored_lasts(connection, key)]
    return columns_of_rows(connection, [stored for stored in lasts if stored.intact], words)


def _write(connection: Driver, block: int, lasts: LastColumns) -> None:
    connection.execute("DELETE FROM search_block WHERE block = ?", (block,))
    if not len(lasts):
        return
    parts = parts_of(lasts)
    connection.executemany(
        "INSERT INTO search_block (block, part, layout, data, hash) VALUES (?, ?, ?, ?, ?)",
        [(block, part, LAYOUT, parts[part], checksum(parts[part])) for part in PARTS],
    )
