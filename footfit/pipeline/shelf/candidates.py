"""The shelf of a question: the lasts of a catalogue, by the filters given."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from footfit.catalogue.blocks.block_reading import BLOCKS_ANEW, BlockLasts
from footfit.catalogue.blocks.record_columns import LABELS
from footfit.catalogue.catalogue_reader import open_reader
from footfit.catalogue.file.opening import FIRST_STEPS
from footfit.catalogue.rows.array_blobs import definition_text
from footfit.catalogue.rows.search import rejection
from footfit.errors import BadOption, EmptyCatalogue, NoCandidate
from footfit.geometry.fit.sizes import SYSTEMS, system_named
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.numeric.arrays import Bools
from footfit.locations import Location
from footfit.pipeline.library.lasts import damaged_last, measure_definitions, reference_name
from footfit.pipeline.shelf.shelf import Shelf
from footfit.results import Notice
from footfit.results.columns.last_columns import KINDS, LastColumns
from footfit.results.values import notices_about

NONE: frozenset[int] = frozenset()
MOST_NAMES = 3
"""A notice about several lasts names so many; of the others it says how many there are."""

UPGRADE = ("; type: footfit upgrade-catalogue",) * 2
INGEST_AGAIN = (
    ", and it was stored without its mesh: ingest its file again with --replace",
    ", and they were stored without their meshes: ingest their files again with --replace",
)
"""What to do about older profiles and measures, of one last and of several."""


@dataclass(frozen=True, slots=True)
class _Read:
    """What was read of a catalogue; ``copies`` names the lasts that can be measured again."""

    path: Location
    lasts: BlockLasts
    copies: frozenset[str]
    reference: str | None
    rated: tuple[tuple[str, int], ...]


def choice(
    path: Location, style: str | None, size_system: str | None, untrusted: frozenset[int] = NONE
) -> Shelf:
    """The lasts to match against; the search blocks in ``untrusted`` are not used.

    If no last is labelled in the size system, it is only how the customer's sizes are shown: all
    lasts are ranked, with a notice. A warning names each last that is left out because it is
    damaged; another one counts those with an older profile.

    Raises
    ------
    NoCatalogue, EmptyCatalogue
        There is nothing to match against. The message says what to type.
    BadOption
        Neither footfit nor any last's label knows the size system.
    """
    read = _read(path, untrusted)
    shelf = _filtered(read, style=style, size_system=size_system)
    shelf = replace(shelf, again=lambda bad: choice(path, style, size_system, bad))
    system = system_named(size_system)
    if shelf.ranked.any() or size_system is None:
        return shelf
    if system is None:
        if style is not None and _filtered(read, size_system=size_system).ranked.any():
            return shelf
        words = f"no size system is named {size_system!r}, and no last is labelled in it"
        raise BadOption(f"{words}; there are {', '.join(SYSTEMS)}")
    everything = _filtered(read, style=style)
    if not everything.ranked.any():
        return shelf
    words = f"no last is labelled in {system.title} sizes: lasts of all systems are ranked"
    other = Notice("other_systems", words, str(path))
    return replace(everything, warnings=(*everything.warnings, other), again=shelf.again)


def _read(path: Location, untrusted: frozenset[int]) -> _Read:
    with open_reader(path) as catalogue:
        lasts = catalogue.block_lasts(untrusted)
        if not len(lasts.base) and not lasts.damaged:
            raise EmptyCatalogue(f"the catalogue holds no last; {FIRST_STEPS}", str(path))
        older = not (_with_current_profile(lasts.base) & _with_current_measures(lasts.base)).all()
        copies = frozenset(catalogue.mesh_copy_names() if older else ())
        return _Read(path, lasts, copies, reference_name(catalogue), catalogue.fit_log.counts())


def _filtered(read: _Read, **filters: str | None) -> Shelf:
    """The lasts that have these labels."""
    lasts = read.lasts.base
    passes, rejected = _passing(lasts, filters)
    current = _with_current_profile(lasts)
    outdated = sorted(lasts.taken(np.flatnonzero(passes & ~current)).names)
    ranked = passes & current
    warnings = (
        *map(damaged_last, read.lasts.damaged),
        *_bad_blocks(read.lasts),
        *_outdated([name for name in outdated if name in read.copies], UPGRADE),
        *_outdated([name for name in outdated if name not in read.copies], INGEST_AGAIN),
        *_other_measures(lasts, ranked, read.copies),
    )
    return Shelf(
        lasts=read.lasts,
        ranked=ranked,
        out_of_stock=np.zeros(len(ranked), dtype=bool),
        total=len(lasts) + len(read.lasts.damaged),
        reference=read.reference,
        rejected=tuple(sorted(rejected.items())),
        warnings=notices_about(str(read.path), warnings),
        rated=read.rated,
        file=read.path,
    )


def _passing(lasts: LastColumns, filters: Mapping[str, str | None]) -> tuple[Bools, Counter[str]]:
    """Which lasts pass the filters, and how many do not, by the first filter that they fail."""
    known = [dict(zip(LABELS, each, strict=True)) for each in _labels(lasts)]
    failed = [rejection(labels, filters) for labels in known]
    counts: Counter[str] = Counter()
    for number, count in enumerate(np.bincount(lasts.label, minlength=len(failed)).tolist()):
        name = failed[number]
        if name is not None and count:
            counts[name] += count
    return np.array([name is None for name in failed], dtype=bool)[lasts.label], counts


def _labels(lasts: LastColumns) -> list[tuple[str | None, ...]]:
    return lasts.words.labels.values


def _with_current_profile(lasts: LastColumns) -> Bools:
    """Which profiles follow this footfit's definition, parameter by parameter, in its stations."""
    definition = FlareDefinition()
    text = definition_text(definition)
    current = [profile == text for profile in lasts.words.profiles.values]
    same: Bools = np.array(current, dtype=bool)[lasts.profile]
    return np.asarray(same & (lasts.stations == definition.stations))


def _bad_blocks(lasts: BlockLasts) -> list[Notice]:
    """A notice of the search blocks that are not what was stored; nothing is lost with them."""
    if not lasts.bad:
        return []
    what = "1 search block is" if len(lasts.bad) == 1 else f"{len(lasts.bad)} search blocks are"
    words = f"{what} damaged, so lasts were read one by one; {BLOCKS_ANEW}"
    return [Notice("damaged_blocks", words)]


def _outdated(names: Sequence[str], cures: tuple[str, str]) -> list[Notice]:
    """A notice of the lasts with older profiles, with the cure of one or of several."""
    if not names:
        return []
    if len(names) == 1:
        words = f"{names[0]} was left out: its profile is older{cures[0]}"
        return [Notice("outdated_last", words)]
    listed, more = ", ".join(names[:MOST_NAMES]), len(names) - MOST_NAMES
    listed += f" and {more} more" if more > 0 else ""
    words = f"{len(names)} lasts were left out ({listed}): their profiles are older{cures[1]}"
    return [Notice("outdated_last", words)]


def _with_current_measures(lasts: LastColumns) -> Bools:
    """Which lasts were measured by this footfit's definitions."""
    methods = [frozenset(method) for method in lasts.words.methods.values]
    same = np.array([[method == measure_definitions(kind) for method in methods] for kind in KINDS])
    return np.asarray(same[lasts.kind, lasts.method], dtype=bool)


def _other_measures(lasts: LastColumns, ranked: Bools, copies: frozenset[str]) -> list[Notice]:
    """Warnings of the lasts that were measured by other definitions; they say what to do."""
    rows = np.flatnonzero(ranked & ~_with_current_measures(lasts)).tolist()
    names = [lasts.names[row] for row in rows]
    notices = []
    for stored, cures in ((True, UPGRADE), (False, INGEST_AGAIN)):
        if other := [name for name in names if (name in copies) == stored]:
            many = len(other) > 1
            start = f"{len(other)} of {np.count_nonzero(ranked)} lasts were"
            words = f"{start if many else f'{other[0]} was'} measured by other definitions"
            words += f": zones whose definition changed are not judged{cures[many]}"
            notices.append(Notice("other_measures", words))
    return notices


def in_stock(shelf: Shelf, file: Path) -> Shelf:
    """The lasts that a stock file has; the others are counted, and kept beside them.

    Raises
    ------
    BadManifest
        The stock file is not understood.
    NoCandidate
        It has none of the lasts.
    """
    from footfit.pipeline.library.stock import stock

    lasts, rows = shelf.lasts.base, np.flatnonzero(shelf.ranked)
    labels = _labels(lasts)
    known = sorted((lasts.names[row], labels[lasts.label[row]]) for row in rows.tolist())
    there = stock(file, known)
    stocked = np.zeros(len(lasts), dtype=bool)
    stocked[[row for row in rows.tolist() if lasts.names[row] in there.names]] = True
    if len(rows) and not stocked.any():
        raise NoCandidate("has none of these lasts in stock; see footfit list-lasts", str(file))
    unknown: tuple[Notice, ...] = ()
    if there.unknown:
        many = len(there.unknown)
        words = f"{'1 row names' if many == 1 else f'{many} rows name'} no last of the catalogue"
        unknown = (Notice("unknown_stock", f"{words}, first {there.unknown[0]}", str(file)),)
    out = shelf.ranked & ~stocked
    again, missing = shelf.again, int(np.count_nonzero(out))
    return replace(
        shelf,
        ranked=stocked,
        out_of_stock=out,
        rejected=(*shelf.rejected, *((("not_in_stock", missing),) if missing else ())),
        warnings=(*shelf.warnings, *unknown),
        again=None if again is None else lambda bad: in_stock(again(bad), file),
    )
