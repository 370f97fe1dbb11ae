"""Whether a last that is there already fits a foot better than the custom last that was made."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from footfit.catalogue.blocks.block_bytes import MEASURES
from footfit.catalogue.blocks.block_reading import BadBlocks
from footfit.catalogue.blocks.search_file import OtherCatalogue
from footfit.catalogue.catalogue_reader import open_reader
from footfit.errors import FootfitError
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.locations import Location
from footfit.pipeline.fit.judging.judged_lasts import asked_of
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.fit.ranking import ranking
from footfit.pipeline.fit.worn_shifts import worn_with
from footfit.pipeline.last_making.custom.custom_aims import CustomQuestion
from footfit.pipeline.shelf.candidates import choice
from footfit.pipeline.shelf.shelf import record_lasts
from footfit.results import BetterInStock, Notice, Profiled
from footfit.results.last_making.custom_last import CustomLast
from footfit.results.values import VERDICTS

HEEL_MM = 6.0
"""Lasts whose heels differ by less have the same heel."""
OWN_NAME = "/"
"""The custom last is ranked by this name, which no last of a catalogue has."""
LOOKED_AT = 20
"""The custom last is ranked among so many of the best lasts of its catalogue."""


def with_stock_looked_at(
    custom: CustomLast, foot: Profiled, path: Location, question: CustomQuestion
) -> CustomLast:
    """The custom last, with a warning if a last of the catalogue fits the foot better.

    A last of the catalogue lacks the room that was asked for at single places, and a match does
    not count that room. So with such room no last is named.

    It is ranked as ``match`` would rank it, among the lasts with its heel. Lasts that were made for
    a customer do not count. One that is tied with it is no better.
    """
    if custom.rooms:
        return custom
    better = None
    with suppress(FootfitError, BadBlocks, OtherCatalogue):  # `match` says what is damaged
        better = _better(custom, foot, path, question)
    if better is None:
        return custom
    notice = Notice("better_in_stock", _words(custom, better))
    return replace(custom, better_in_stock=better, warnings=(*custom.warnings, notice))


def _better(
    custom: CustomLast, foot: Profiled, path: Location, question: CustomQuestion
) -> BetterInStock | None:
    """The best of the lasts that stand before the custom last; None if it is first or tied."""
    shelf = choice(path, None, None)
    labels = replace(custom.record.labels, name=OWN_NAME)
    own = replace(custom.record, labels=labels)
    drops_mm = [chunk.drop_mm for _, chunk in shelf.lasts.chunks((MEASURES,))]
    same_heel = _same_heel(np.concatenate(drops_mm), own.drop_mm)
    shelf = replace(shelf, ranked=shelf.ranked & same_heel)
    profile, worn = question.profile, question.worn
    asked = Question(top=LOOKED_AT, profile=profile, heel=question.heel, worn=worn)
    found = [candidate.record for candidate in matched([foot], shelf, asked).candidates]
    kept = {OWN_NAME: custom.sections}
    with open_reader(path) as catalogue:
        for record in found:
            parentage = catalogue.parentage(record.labels.name)
            sections = catalogue.sections(record.labels.name)
            if sections is not None and (parentage is None or parentage.made_by != "customise"):
                kept[record.labels.name] = sections
    records = [record for record in found if record.labels.name in kept]
    lasts = record_lasts([own, *records], kept)
    columns = asked_of([foot], profile, "fit", question.heel, worn_with(profile, worn))
    ranked = ranking(columns, lasts, np.ones(len(lasts.records), dtype=bool), 0, 1)
    places = dict(zip(ranked.names, ranked.tier, strict=True))
    if ranked.nearest or not places or places.get(OWN_NAME) == 0:
        return None
    first = int(ranked.judged.level[0])
    return BetterInStock(ranked.names[0], VERDICTS[first], custom.verdict)


def _same_heel(drop_mm: Floats, own_mm: float | None) -> Bools:
    """Which lasts have the heel of the custom one, (n,); if one is not known, neither must be."""
    if own_mm is None:
        return np.asarray(np.isnan(drop_mm))
    return np.asarray(np.abs(drop_mm - own_mm) < HEEL_MM)


def _words(custom: CustomLast, better: BetterInStock) -> str:
    """Which last fits better, and what to type."""
    words = (
        f"{better.last} of the catalogue ({better.verdict}) fits this foot better than this custom"
        f" last ({better.custom_verdict})"
    )
    if better.last == custom.base:
        return f"{words}: use {better.last} as it is"
    return (
        f"{words}: use it as it is, or make the custom last from it with --base {better.last},"
        " or from the best last without --base"
    )
