"""Which lasts a question is asked of: the filters, and what they mean where nothing has them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import SYSTEMS, system_named
from footfit.pipeline.library.lasts import library
from footfit.results import Library, Notice


def choice(path: Path, style: str | None, size_system: str | None) -> Library:
    """The lasts to match against. A size system that no last is labelled in is the customer's
    own: all lasts are then ranked, and that is said.

    Raises
    ------
    NoCatalogue, EmptyCatalogue
        There is nothing to match against; the message says what to type.
    BadOption
        Neither footfit nor any last's label knows the size system.
    """
    found = library(path, style, size_system)
    system = system_named(size_system)
    if found.lasts or size_system is None:
        return found
    if system is None:
        if style is not None and library(path, None, size_system).lasts:
            return found
        known = ", ".join(SYSTEMS)
        words = f"no size system is named {size_system!r}, nor is a last labelled in it"
        raise BadOption(f"{words}; there are {known}")
    everything = library(path, style, None)
    if not everything.lasts:
        return found
    words = f"no last is labelled in {SYSTEMS[system.name].title} sizes: all systems are ranked"
    return replace(everything, warnings=(*everything.warnings, Notice("other_systems", words)))
