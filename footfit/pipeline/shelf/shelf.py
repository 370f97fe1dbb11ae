"""A shelf of lasts: what a match ranks, from the blocks of a catalogue or from records."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from footfit.catalogue.blocks.block_reading import BadBlocks, ShownLast
from footfit.catalogue.blocks.record_columns import columns_of
from footfit.catalogue.blocks.search_file import OtherCatalogue
from footfit.catalogue.catalogue_reader import open_reader
from footfit.errors import CatalogueDamaged, UnknownLast
from footfit.locations import Location
from footfit.pipeline.library.lasts import damaged_last
from footfit.results import ShapeSections
from footfit.results.columns.last_columns import NOT_KEPT, SPOILT
from footfit.results.columns.vocabulary import Vocabulary
from footfit.results.values import notices_about

if TYPE_CHECKING:
    from footfit.catalogue.blocks.record_columns import Kept
    from footfit.catalogue.blocks.search_file import SearchFile
    from footfit.catalogue.catalogue_reader import CatalogueReader
    from footfit.geometry.numeric.arrays import Bools, Floats, Ints
    from footfit.results import LastRecord, Library, Notice
    from footfit.results.columns.last_columns import LastColumns

TWIN_LENGTH_MM = 2.0
"""Two lasts with the same labels and opposite sides are one pair if their lengths differ less."""


class Lasts(Protocol):
    """Lasts by column. ``base`` has all of them, without measures, profiles and toes."""

    @property
    def base(self) -> LastColumns:
        """What is always read."""

    @property
    def search(self) -> SearchFile | None:
        """What a large catalogue keeps for a search by flare."""

    def chunks(self, parts: Sequence[str], /) -> Iterator[tuple[int, LastColumns]]:
        """All lasts with these parts, in their order: each time the first row, and its lasts."""

    def taken(self, chosen: Ints, parts: Sequence[str], /) -> LastColumns:
        """Some lasts with these parts, in the order of ``chosen``."""

    def shown(self, chosen: Sequence[int], /) -> list[ShownLast]:
        """The records of a few lasts."""

    def with_spoilt(self, rows: Sequence[int], /) -> Lasts:
        """The lasts, where the kept sections of some are damaged."""


@dataclass(frozen=True, slots=True)
class RecordLasts:
    """Lasts of which there are records."""

    records: tuple[LastRecord, ...]
    base: LastColumns
    search: None = None

    def chunks(self, _: Sequence[str]) -> Iterator[tuple[int, LastColumns]]:
        """All lasts at once."""
        if self.records:
            yield 0, self.base

    def taken(self, chosen: Ints, _: Sequence[str]) -> LastColumns:
        """Some lasts."""
        return self.base.taken(chosen)

    def shown(self, chosen: Sequence[int]) -> list[ShownLast]:
        """The records of a few lasts."""
        return [ShownLast(self.records[row]) for row in chosen]

    def with_spoilt(self, _: Sequence[int]) -> RecordLasts:
        """The lasts; that their sections are damaged is known already."""
        return self


KeptSections = Location | Mapping[str, ShapeSections] | None
"""Where sections of lasts are kept: a catalogue, or by the lasts' names."""


def record_lasts(records: Sequence[LastRecord], sections: KeptSections = None) -> RecordLasts:
    """Lasts from records."""
    kept: list[Kept] = [NOT_KEPT] * len(records)
    if isinstance(sections, Mapping):
        kept = [sections[record.labels.name] for record in records]
    elif sections is not None and records:
        with open_reader(sections) as catalogue:
            kept = [_sections(catalogue, record.labels.name) for record in records]
    return RecordLasts(tuple(records), columns_of(records, kept, Vocabulary()))


def _sections(catalogue: CatalogueReader, name: str) -> Kept:
    try:
        return catalogue.sections(name) or NOT_KEPT
    except (CatalogueDamaged, UnknownLast):
        return SPOILT


@dataclass(frozen=True, slots=True)
class Shelf:
    """The lasts of a catalogue that a match ranks, and what is to be said of the others.

    ``ranked`` (n,) says which of the lasts are ranked, and ``out_of_stock`` (n,) which ones the
    shop does not have. ``again`` makes the shelf anew from the catalogue, without trust in some of
    its search blocks; it is None if there is no catalogue. The other fields are a `Library`'s.
    """

    lasts: Lasts
    ranked: Bools
    out_of_stock: Bools
    total: int
    reference: str | None
    rejected: tuple[tuple[str, int], ...] = ()
    warnings: tuple[Notice, ...] = ()
    rated: tuple[tuple[str, int], ...] = ()
    file: Location | None = None
    again: Callable[[frozenset[int]], Shelf] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the lasts that are ranked, sorted."""
        return tuple(sorted(self.lasts.base.taken(np.flatnonzero(self.ranked)).names))

    def with_records(self) -> tuple[Shelf, tuple[LastRecord, ...]]:
        """The shelf without damaged lasts, and the records of those that are ranked, by name.

        Records are read from rows. If a search block is not what was stored, or somebody changed
        the catalogue meanwhile, the shelf is made anew.
        """
        shelf, bad = self, frozenset[int]()
        while True:
            rows = np.flatnonzero(shelf.ranked).tolist()
            try:
                shown = shelf.lasts.shown(rows)
                break
            except OtherCatalogue:
                shelf = shelf.anew(bad)
            except BadBlocks as error:
                bad |= error.blocks
                shelf = shelf.anew(bad)
        damaged = [row for row, last in zip(rows, shown, strict=True) if last.record is None]
        records = (last.record for last in shown if last.record is not None)
        by_name = tuple(sorted(records, key=lambda record: record.labels.name))
        return shelf.without(damaged), by_name

    def without(self, rows: Sequence[int]) -> Shelf:
        """The shelf without some lasts, because their rows are damaged; warnings name them."""
        if not rows:
            return self
        there = np.ones(len(self.ranked), dtype=bool)
        there[list(rows)] = False
        names = sorted(self.lasts.base.names[row] for row in rows)
        path = None if self.file is None else str(self.file)
        return replace(
            self,
            ranked=self.ranked & there,
            out_of_stock=self.out_of_stock & there,
            warnings=(*notices_about(path, map(damaged_last, names)), *self.warnings),
        )

    def with_spoilt(self, rows: Sequence[int]) -> Shelf:
        """The shelf, where the kept sections of some lasts are damaged."""
        return replace(self, lasts=self.lasts.with_spoilt(rows)) if rows else self

    def anew(self, bad: frozenset[int]) -> Shelf:
        """The shelf, read again from the catalogue without trust in some search blocks."""
        assert self.again is not None
        return self.again(bad)

    def swapped(self) -> Shelf:
        """The lasts that are not in stock in the place of those that are."""
        again = self.again
        return replace(
            self,
            ranked=self.out_of_stock,
            out_of_stock=self.ranked,
            again=None if again is None else lambda bad: again(bad).swapped(),
        )


def shelf_of(library: Library) -> Shelf:
    """The shelf of a library."""
    records = (*library.lasts, *library.out_of_stock)
    first = np.arange(len(records)) < len(library.lasts)
    return Shelf(
        lasts=record_lasts(records, library.file),
        ranked=first,
        out_of_stock=~first,
        total=library.total,
        reference=library.reference,
        rejected=library.rejected,
        warnings=library.warnings,
        rated=library.rated,
        file=library.file,
    )


def of_own_side(shelf_lasts: Lasts, among: Bools, side: int) -> Bools:
    """Which lasts ``among`` (n,) the given ones are ranked: all but those of the other side whose
    twin of the foot's own side (an index of SIDES) is there.
    """
    lasts = shelf_lasts.base
    chosen = among.copy()
    own = among & (lasts.side == side)
    others = np.flatnonzero(among & ~own)
    named = [
        style is not None and size is not None for style, size, *_ in lasts.words.labels.values
    ]
    twinned = np.zeros(len(named), dtype=bool)
    twinned[lasts.label[own]] = True
    twinned &= np.array(named, dtype=bool)
    others = others[twinned[lasts.label[others]]]
    if not len(others):
        return chosen
    search = shelf_lasts.search
    order = search.by_label if search else np.lexsort((lasts.extent_mm, lasts.label))
    chosen[others[_nearest_mm(lasts, order, own, others) < TWIN_LENGTH_MM]] = False
    return chosen


def _nearest_mm(lasts: LastColumns, order: Ints, own: Bools, others: Ints) -> Floats:
    """How much longer or shorter each of the others is than the nearest own one with its labels;
    each has one. ``order`` is that of all rows, by labels, then by lengths.
    """
    own_there = own[order]
    before = np.empty(len(order), dtype=np.int64)  # how many own ones come before each row
    before[order] = np.cumsum(own_there)
    own_rows, at = order[own_there], before[others]
    beside = own_rows[np.clip([at - 1, at], 0, len(own_rows) - 1)]
    apart_mm = np.abs(lasts.extent_mm[beside] - lasts.extent_mm[others])
    same = lasts.label[beside] == lasts.label[others]
    return np.asarray(np.where(same, apart_mm, np.inf).min(axis=0))
