"""A block of lasts as bytes: one part for each purpose, so that a search reads what it needs.

A part is a count of sections, their lengths, and the sections: arrays as little-endian numbers,
and texts as JSON. Every section begins at a multiple of eight bytes.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.numeric.arrays import Ints, distinct
from footfit.results.columns.last_columns import (
    LastColumns,
    MeasureColumns,
    ProfileColumns,
    ToesColumns,
)
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary, Words

LAYOUT, OTHER_HASH = LAYOUTS = ("blocks/2", "blocks/1")
"""What a block of this footfit is, and one with the same parts and another hash, which is read too.
Lasts of a block with any other layout are read from their rows. Change it if a part, or what is
computed for it (`toe_walls.last_plan`), changes.
"""
BLOCK_LASTS = 256
"""How many keys of lasts a block is for."""
LASTS, MEASURES, PLAN, BOTTOM, TOES = PARTS = ("lasts", "measures", "plan", "bottom", "toes")
CODES = ("label", "profile", "method", "side", "kind", "stations")
NUMBERS = ("extent_mm", "angle_deg", "angle_sd_deg", "heel_label_mm", "platform_mm")
LACKING = 0xFFFF
"""In a part: this last lacks the measure."""
HASH_SEED = 20261128


def block_of(key: int) -> int:
    """The block that a last belongs to."""
    return key // BLOCK_LASTS


def checksum(data: bytes | memoryview, layout: str = LAYOUT) -> str:
    """The hash of a part: its words of 64 bits, each times an odd number of its own, added up.

    A change inside one word always changes it; any other change is missed once in 2^64. It is ten
    times as fast as SHA-256, which would be most of the time of a search in 10^6 lasts. The rows
    have SHA-256, and ``check-catalogue`` compares the blocks with them.

    Examples
    --------
    >>> checksum(b"derby") == checksum(b"derbz"), checksum(b"a") == checksum(b"a" + bytes(7))
    (False, False)
    """
    whole = len(data) // 8
    words = np.frombuffer(data, dtype="<u8", count=whole)
    rest = int.from_bytes(data[8 * whole :], "little")
    factors = odd_factors(1 << max(whole + 2, 1 << 10).bit_length(), layout)
    total = int(np.dot(words, factors[2 : whole + 2]))
    total += rest * int(factors[0]) + len(data) * int(factors[1])
    return f"{total % (1 << 64):016x}"


@lru_cache(maxsize=4)
def odd_factors(count: int, layout: str = LAYOUT) -> NDArray[np.uint64]:
    """Odd numbers; those of a larger count begin with those of a smaller one.

    They are those of the generator SplitMix64 (Steele, Lea and Flood, 2014), which needs no module
    of its own: loading ``numpy.random``, as for the other hash, takes 5 ms.
    """
    if layout == OTHER_HASH:
        return np.random.PCG64(HASH_SEED).random_raw(count) | np.uint64(1)
    mixed = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    mixed += np.uint64(HASH_SEED)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
    return mixed ^ (mixed >> np.uint64(31)) | np.uint64(1)


# ---------------------------------------------------------------- sections


def _packed(sections: Sequence[bytes]) -> bytes:
    lengths = struct.pack(f"<{len(sections) + 1}Q", len(sections), *map(len, sections))
    return lengths + b"".join(section + bytes(-len(section) % 8) for section in sections)


def _sections(data: bytes) -> list[memoryview]:
    (count,) = struct.unpack_from("<Q", data)
    lengths = struct.unpack_from(f"<{count}Q", data, 8)
    view, at, sections = memoryview(data), 8 * (count + 1), []
    for length in lengths:
        sections.append(view[at : at + length])
        at += length + -length % 8
    return sections


def _text(value: object) -> bytes:
    return json.dumps(value, separators=(",", ":"), ensure_ascii=True).encode("ascii")


def _local(words: Words, numbers: Ints) -> tuple[Ints, bytes]:
    """Numbers of a vocabulary as places in a list of their own, and that list.

    The list is sorted, so that a block has the same bytes whatever was read before.
    """
    used = sorted({int(number) for number in distinct(numbers) if number != NO_WORD})
    texts = sorted((json.dumps(words.values[number]), number) for number in used)
    place = np.full(len(words) + 1, LACKING)  # NO_WORD is the last place
    place[[number for _, number in texts]] = np.arange(len(texts))
    return place[numbers], f"[{','.join(text for text, _ in texts)}]".encode("ascii")


def _shared(words: Words, text: memoryview, places: NDArray[Any]) -> Ints:
    """Places in a block's list as numbers of the vocabulary."""
    numbers = np.append(words.numbers_of(str(text, "ascii")), NO_WORD)
    found: Ints = numbers[np.minimum(places, len(numbers) - 1)]
    return found


# ---------------------------------------------------------------- parts


def parts_of(lasts: LastColumns) -> dict[str, bytes]:
    """The parts of a block, by name; the lasts have all columns."""
    assert lasts.measures is not None
    assert lasts.flare is not None
    assert lasts.toes is not None
    assert lasts.flare.plan is not None
    assert lasts.flare.bottom is not None
    words, measures = lasts.words, lasts.measures.used()
    local = [_local(getattr(words, f"{name}s"), getattr(lasts, name)) for name in CODES[:3]]
    codes = [places for places, _ in local] + [getattr(lasts, name) for name in CODES[3:]]
    measure_places, measure_words = _local(words.measures, measures.word)
    toes = lasts.toes
    plan = np.concatenate(
        [
            toes.behind_mm[:, None],
            toes.ends_mm,
            toes.seat_mm,
            toes.edges_mm.reshape(len(lasts), -1),
        ],
        axis=1,
    )
    return {
        LASTS: _packed(
            [
                _bytes(lasts.keys, "<i8"),
                _bytes(np.array([getattr(lasts, name) for name in NUMBERS]), "<f8"),
                _bytes(np.array(codes), "<u2"),
                *(text for _, text in local),
                _text(lasts.names),
            ]
        ),
        MEASURES: _packed(
            [
                _text(measures.names),
                measure_words,
                _bytes(measures.value, "<f8"),
                _bytes(measures.sd, "<f8"),
                _bytes(measure_places, "<u2"),
            ]
        ),
        PLAN: _packed([_bytes(lasts.flare.known, "u1"), _bytes(lasts.flare.plan, "<f8")]),
        BOTTOM: _packed([_bytes(lasts.flare.bottom, "<f8")]),
        TOES: _packed([_bytes(toes.state, "u1"), _bytes(plan, "<f8")]),
    }


def _bytes(array: NDArray[Any], kind: str) -> bytes:
    return np.ascontiguousarray(array, dtype=kind).tobytes()


def lasts_of(data: bytes, words: Vocabulary) -> LastColumns:
    """The lasts of their first part, without measures, profiles and toes."""
    keys, numbers, codes, *texts, names = _sections(data)
    key = np.frombuffer(keys, "<i8").astype(np.int64)
    number = np.frombuffer(numbers, "<f8").reshape(len(NUMBERS), len(key))
    code = np.frombuffer(codes, "<u2").reshape(len(CODES), len(key))
    shared: dict[str, Any] = {
        name: _shared(getattr(words, f"{name}s"), text, code[at])
        for at, (name, text) in enumerate(zip(CODES, texts, strict=False))
    }
    plain: dict[str, Any] = dict(zip(NUMBERS, number, strict=True))
    own = set(CODES) - set(shared)
    plain |= {name: code[CODES.index(name)].astype(np.int64) for name in own}
    return LastColumns(
        words=words,
        keys=key,
        names=tuple(json.loads(str(names, "ascii"))),
        **shared,
        **plain,
    )


def _with_measures(lasts: LastColumns, data: bytes) -> LastColumns:
    names, texts, value, sd, places = _sections(data)
    shape = (-1, len(lasts))
    word = _shared(lasts.words.measures, texts, np.frombuffer(places, "<u2").reshape(shape))
    columns = MeasureColumns(
        tuple(json.loads(str(names, "ascii"))),
        np.frombuffer(value, "<f8").reshape(shape),
        np.frombuffer(sd, "<f8").reshape(shape),
        word,
    )
    return replace(lasts, measures=columns)


def _with_plan(lasts: LastColumns, data: bytes) -> LastColumns:
    known, plan = _sections(data)
    count = len(lasts)
    flare = ProfileColumns(
        np.frombuffer(known, "u1").reshape(count, -1).astype(bool),
        np.frombuffer(plan, "<f8").reshape(count, -1),
        None,
    )
    return replace(lasts, flare=flare)


def _with_bottom(lasts: LastColumns, data: bytes) -> LastColumns:
    assert lasts.flare is not None
    (bottom,) = _sections(data)
    channels = lasts.flare.known.shape[1] - 1
    curves = np.frombuffer(bottom, "<f8").reshape(len(lasts), channels, -1)
    return replace(lasts, flare=replace(lasts.flare, bottom=curves))


def _with_toes(lasts: LastColumns, data: bytes) -> LastColumns:
    state, numbers = _sections(data)
    plan = np.frombuffer(numbers, "<f8").reshape(len(lasts), -1)
    toes = ToesColumns(
        state=np.frombuffer(state, "u1").astype(np.int64),
        behind_mm=plan[:, 0],
        ends_mm=plan[:, 1:3],
        seat_mm=plan[:, 3:5],
        edges_mm=plan[:, 5:].reshape(len(lasts), 2, -1),
    )
    return replace(lasts, toes=toes)


READERS: Mapping[str, Callable[[LastColumns, bytes], LastColumns]] = {
    MEASURES: _with_measures,
    PLAN: _with_plan,
    BOTTOM: _with_bottom,
    TOES: _with_toes,
}
"""How each further part is added to the lasts; the bottom's comes after the plan's."""
