"""The candidate lasts of a question, by the filters given."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.errors import BadOption, NoCandidate
from footfit.geometry.fit.sizes import SYSTEMS, system_named
from footfit.pipeline.library.lasts import library
from footfit.pipeline.library.stock import stock
from footfit.results import Library, Notice


def choice(path: Path, style: str | None, size_system: str | None) -> Library:
    """The lasts to match against.

    If no last is labelled in the size system, it is only how the customer's sizes are shown: all
    lasts are ranked, with a notice.

    Raises
    ------
    NoCatalogue, EmptyCatalogue
        There is nothing to match against. The message says what to type.
    BadOption
        Neither footfit nor any last's label knows the size system.
    """
    chosen = library(path, style, size_system)
    system = system_named(size_system)
    if chosen.lasts or size_system is None:
        return chosen
    if system is None:
        if style is not None and library(path, None, size_system).lasts:
            return chosen
        words = f"no size system is named {size_system!r}, and no last is labelled in it"
        raise BadOption(f"{words}; there are {', '.join(SYSTEMS)}")
    everything = library(path, style, None)
    if not everything.lasts:
        return chosen
    words = f"no last is labelled in {system.title} sizes: lasts of all systems are ranked"
    other = Notice("other_systems", words, str(path))
    return replace(everything, warnings=(*everything.warnings, other))


def in_stock(chosen: Library, file: Path) -> Library:
    """The lasts that a stock file has; the others are counted, and kept beside them.

    Raises
    ------
    BadManifest
        The stock file is not understood.
    NoCandidate
        It has none of the lasts.
    """
    there = stock(file, chosen.lasts)
    lasts = tuple(r for r in chosen.lasts if r.labels.name in there.names)
    if chosen.lasts and not lasts:
        raise NoCandidate("has none of these lasts in stock; see footfit list-lasts", str(file))
    out = tuple(r for r in chosen.lasts if r.labels.name not in there.names)
    unknown: tuple[Notice, ...] = ()
    if there.unknown:
        many = len(there.unknown)
        rows = "1 row names" if many == 1 else f"{many} rows name"
        words = f"{rows} no last of the catalogue, first {there.unknown[0]}"
        unknown = (Notice("unknown_stock", words, str(file)),)
    return replace(
        chosen,
        lasts=lasts,
        out_of_stock=out,
        rejected=(*chosen.rejected, *((("not_in_stock", len(out)),) if out else ())),
        warnings=(*chosen.warnings, *unknown),
    )
