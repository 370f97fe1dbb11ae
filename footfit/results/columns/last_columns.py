"""Lasts by column: numbers as arrays, words as numbers of a vocabulary."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeVar

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.results.columns.packed_names import PackedNames
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary
from footfit.results.values import SideName

SIDES: tuple[SideName | None, ...] = (None, "left", "right")
KINDS = ("foot", "last")
KEPT, NOT_KEPT, SPOILT = range(3)
"""Whether the sections of a last are kept, were not stored, or are damaged."""
Names = tuple[str, ...] | PackedNames
Rows = TypeVar("Rows", "ProfileColumns", "ToesColumns")


@dataclass(frozen=True, slots=True)
class MeasureColumn:
    """One measure of n lasts, (n,) each: ``value`` is NaN where there is none, ``sd`` then 0.

    ``word`` is the number of its definition and its reason; NO_WORD where a last lacks the measure.
    """

    value: Floats
    sd: Floats
    word: Ints


@dataclass(frozen=True, slots=True)
class MeasureColumns:
    """The measures of n lasts: ``names`` (m,), and (m, n) arrays as in `MeasureColumn`."""

    names: tuple[str, ...]
    value: Floats
    sd: Floats
    word: Ints

    def column(self, name: str) -> MeasureColumn:
        """One measure; of one that no last has, nothing."""
        if name in self.names:
            at = self.names.index(name)
            return MeasureColumn(self.value[at], self.sd[at], self.word[at])
        count = self.value.shape[1]
        nothing = np.full(count, np.nan)
        return MeasureColumn(nothing, np.zeros(count), np.full(count, NO_WORD))

    def only(self, names: Sequence[str]) -> MeasureColumns:
        """Some of the measures; of one that no last has, nothing."""
        columns = [self.column(name) for name in sorted(names)]
        arrays = ([getattr(c, name) for c in columns] for name in ("value", "sd", "word"))
        return MeasureColumns(tuple(sorted(names)), *map(np.array, arrays))

    def used(self) -> MeasureColumns:
        """Those that any of the lasts has."""
        there = np.flatnonzero((self.word != NO_WORD).any(axis=1))
        names = tuple(self.names[at] for at in there.tolist())
        return MeasureColumns(names, self.value[there], self.sd[there], self.word[there])

    def taken(self, rows: Ints | slice) -> MeasureColumns:
        """Those of some lasts."""
        return MeasureColumns(self.names, self.value[:, rows], self.sd[:, rows], self.word[:, rows])


@dataclass(frozen=True, slots=True)
class ProfileColumns:
    """Flare profiles of n lasts of up to s stations; NaN where there is none.

    ``plan`` (n, s) and ``bottom`` (n, 4, s) are the curvatures of the channels in their order, and
    ``known`` (n, 5) says which channels there are. Either array is None if it was not read.
    """

    known: Bools
    plan: Floats | None
    bottom: Floats | None


@dataclass(frozen=True, slots=True)
class ToesColumns:
    """The toes of n lasts, as `geometry.fit.toe_walls.ToesPlan` has them, at even stations.

    ``state`` (n,) is KEPT, NOT_KEPT or SPOILT. ``behind_mm`` (n,) is the height of the section at
    the toes. ``ends_mm`` (n, 2) are where the outline begins and ends along the bottom; both are
    NaN where it is not whole. ``edges_mm`` (n, 2, k) are its lateral and its medial edge, and
    ``seat_mm`` (n, 2) is the middle of the seat.
    """

    state: Ints
    behind_mm: Floats
    ends_mm: Floats
    seat_mm: Floats
    edges_mm: Floats

    @property
    def whole(self) -> Bools:
        """Which outlines reach to the tip, (n,)."""
        return np.isfinite(self.ends_mm[:, 1])


@dataclass(frozen=True, slots=True)
class LastColumns:
    """n lasts; (n,) arrays where nothing else is said.

    ``keys`` are those of the catalogue. ``label``, ``profile`` and ``method`` are numbers of the
    vocabulary. ``side`` and ``kind`` index SIDES and KINDS. ``heel_label_mm`` and ``platform_mm``
    are NaN without a label. ``stations`` says how long a flare profile is. The last three are None
    if they were not read.
    """

    words: Vocabulary
    keys: Ints
    names: Names
    label: Ints
    profile: Ints
    method: Ints
    side: Ints
    kind: Ints
    stations: Ints
    extent_mm: Floats
    angle_deg: Floats
    angle_sd_deg: Floats
    heel_label_mm: Floats
    platform_mm: Floats
    measures: MeasureColumns | None = None
    flare: ProfileColumns | None = None
    toes: ToesColumns | None = None

    def __len__(self) -> int:
        return len(self.keys)

    def measure(self, name: str) -> MeasureColumn:
        """One measure of the lasts."""
        assert self.measures is not None
        return self.measures.column(name)

    @property
    def heel_height_mm(self) -> Floats:
        """The heel height as measured, else as labelled."""
        measured_mm = self.measure("heel_height").value
        return np.where(np.isnan(measured_mm), self.heel_label_mm, measured_mm)

    @property
    def drop_mm(self) -> Floats:
        """How much higher the heel stands than the forepart: as labelled, else as measured."""
        labelled_mm = self.heel_label_mm - np.nan_to_num(self.platform_mm)
        measured_mm = self.measure("heel_height").value
        return np.where(np.isnan(self.heel_label_mm), measured_mm, labelled_mm)

    def taken(self, rows: Ints | slice) -> LastColumns:
        """Some of the lasts, in the order of ``rows``."""
        return LastColumns(
            words=self.words,
            names=_taken_names(self.names, rows),
            **{name: getattr(self, name)[rows] for name in ARRAYS},
            measures=None if self.measures is None else self.measures.taken(rows),
            flare=_taken(self.flare, rows),
            toes=_taken(self.toes, rows),
        )


ARRAYS = tuple(
    field.name
    for field in fields(LastColumns)
    if field.name not in ("words", "names", "measures", "flare", "toes")
)
"""The columns that are single arrays."""


def _taken_names(names: Names, rows: Ints | slice) -> Names:
    if isinstance(rows, slice):
        return names[rows]
    if isinstance(names, PackedNames):
        return names.taken(rows)
    return tuple(names[row] for row in rows.tolist())


def _taken(columns: Rows | None, rows: Ints | slice) -> Rows | None:
    """Some rows of arrays that have one for each last."""
    if columns is None:
        return None
    arrays: list[Any] = [getattr(columns, field.name) for field in fields(columns)]
    arrays = [None if array is None else array[rows] for array in arrays]
    return type(columns)(*arrays)


def joined(parts: Sequence[LastColumns]) -> LastColumns:
    """Lasts one after the other; all parts share one vocabulary, and have the same columns."""
    if len(parts) == 1:
        return parts[0]
    return LastColumns(
        words=parts[0].words,
        names=tuple(name for part in parts for name in part.names),
        **{name: np.concatenate([getattr(part, name) for part in parts]) for name in ARRAYS},
        measures=joined_measures([part.measures for part in parts if part.measures is not None]),
        flare=_joined([part.flare for part in parts if part.flare is not None]),
        toes=_joined([part.toes for part in parts if part.toes is not None]),
    )


def joined_measures(parts: Sequence[MeasureColumns]) -> MeasureColumns | None:
    """The measures of several parts, in the order of their names."""
    if not parts:
        return None
    names = tuple(sorted({name for part in parts for name in part.names}))
    if all(part.names == names for part in parts):
        arrays = ([getattr(part, name) for part in parts] for name in ("value", "sd", "word"))
        return MeasureColumns(names, *(np.concatenate(each, axis=1) for each in arrays))
    columns = [[part.column(name) for part in parts] for name in names]
    value, sd, word = (
        np.array([np.concatenate([getattr(part, name) for part in row]) for row in columns])
        for name in ("value", "sd", "word")
    )
    return MeasureColumns(names, value, sd, word)


def _joined(parts: Sequence[Rows]) -> Rows | None:
    """Arrays that have a row for each last; shorter profiles get NaN at their end."""
    if not parts:
        return None
    arrays: list[Any] = []
    for field in fields(parts[0]):
        each = [getattr(part, field.name) for part in parts]
        if each[0] is not None:
            longest = max(array.shape[-1] for array in each) if each[0].ndim > 1 else 0
            each = [_lengthened(array, longest) for array in each]
        arrays.append(None if each[0] is None else np.concatenate(each))
    return type(parts[0])(*arrays)


def _lengthened(array: Any, length: int) -> Any:
    """An array whose last axis is so long; NaN fills it up."""
    if array.ndim < 2 or array.shape[-1] == length:
        return array
    more = np.full((*array.shape[:-1], length - array.shape[-1]), np.nan)
    return np.concatenate([array, more], axis=-1)
