"""Whom a catalogue of lasts serves: the coverage of a population of feet."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from footfit import results
from footfit.api.inputs import (
    FilePath,
    HeelKeywords,
    Meshes,
    ReadingKeywords,
    WornKeywords,
    heel_options,
    known_keywords,
    reading_options,
    worn_options,
)
from footfit.api.scans import sources
from footfit.errors import EmptyCatalogue, NoCandidate
from footfit.locations import Location, location_of
from footfit.pipeline.batch.runs import HERE, Jobs
from footfit.results.population.coverage_answer import Coverage

if TYPE_CHECKING:
    from footfit.pipeline.batch.sources import Source
    from footfit.pipeline.population.feet_scans import FootOutcome
    from footfit.pipeline.shelf.shelf import Shelf

TABLES = (".csv", ".tsv", ".txt")
"""The suffixes of a table of measures."""


class CoverageKeywords(ReadingKeywords, HeelKeywords, WornKeywords, total=False):
    """What is asked of a population, and how scans are to be understood.

    ``profile`` is the name or the file of a fit profile. ``style``, ``size_system`` and ``stock``
    filter the lasts as in a match. ``group_by`` are columns of a CSV. ``next_lasts`` is how many
    lasts to plan. ``jobs`` is how many processes, or which executor, reads scans, and ``cache`` a
    file that keeps their measures.
    """

    profile: str
    style: str | None
    size_system: str | None
    stock: FilePath | None
    group_by: Sequence[str]
    next_lasts: int
    jobs: Jobs
    cache: FilePath | None


@known_keywords(CoverageKeywords)
def coverage(feet: Meshes, catalogue: FilePath, **asked: Unpack[CoverageKeywords]) -> Coverage:
    """Whom the lasts of a catalogue serve: shares of feet, the gaps, and the lasts to make next.

    Parameters
    ----------
    feet : path or list of meshes
        A CSV of measures, or scans: files, folders and globs. docs/coverage.md has the columns.
    catalogue : path
    **asked
        See `CoverageKeywords`.

    Raises
    ------
    BadManifest, BadOption
        The CSV is not understood; there is no such profile, column or size system.
    NoCatalogue, NoCandidate, CatalogueUnusable
        There is no catalogue, no last passes the filters, or the file cannot be used.
    """
    asker = coverage_asker(location_of(catalogue), asked)
    if is_table(feet):
        return asker.of_table(Path(os.fspath(feet)))  # type: ignore[arg-type]
    given = sources(feet)
    return asker.of_scans(asker.measured(given))


def is_table(feet: Any) -> bool:
    """Whether feet are given as a CSV of measures, by the suffix of its name."""
    return isinstance(feet, (str, os.PathLike)) and Path(feet).suffix.lower() in TABLES


@dataclass(frozen=True, slots=True)
class CoverageAsker:
    """A question to a catalogue: its lasts are read once, before any foot is."""

    shelf: Shelf
    asked: dict[str, Any]
    profile: results.FitProfile

    def measured(self, given: Sequence[Source]) -> Iterator[FootOutcome]:
        """The measures of scans, each as it is read."""
        from footfit.pipeline.population.feet_scans import measured_feet

        cache = self.asked.get("cache")
        jobs, reading = self.asked.get("jobs", HERE), reading_options(self.asked)
        return measured_feet(given, reading, jobs, None if cache is None else Path(cache))

    def of_scans(self, measured: Iterable[FootOutcome]) -> Coverage:
        """The coverage of feet that were measured."""
        from footfit.pipeline.population.feet_scans import feet_of_scans

        feet, failed = feet_of_scans(measured)
        return self._answer(feet, failed, ())

    def of_table(self, path: Path) -> Coverage:
        """The coverage of the feet of a CSV."""
        from footfit.pipeline.population.feet_csv import feet_of_csv

        feet, notices = feet_of_csv(path, self.asked.get("group_by", ()))
        return self._answer(feet, (), notices)

    def _answer(self, feet: Any, failed: Any, notices: tuple[results.Notice, ...]) -> Coverage:
        from footfit.pipeline.fit.worn_shifts import worn_with
        from footfit.pipeline.population import coverage_run
        from footfit.pipeline.population.judging import Asking
        from footfit.pipeline.population.tables import last_table

        (shelf, records), asked = self.shelf.with_records(), self.asked
        if self.shelf.ranked.any() and not records:
            raise NoCandidate(shelf.warnings[0].message)
        worn = worn_with(self.profile, worn_options(asked))
        people = coverage_run.Population(
            feet,
            failed,
            tuple(asked.get("group_by", ())),
            _shown_system(asked.get("size_system")),
            asked.get("next_lasts", coverage_run.NEXT_LASTS),
            (*shelf.warnings, *notices),
        )
        lasts = last_table(records, self.profile, shelf.file)
        return coverage_run.coverage(people, lasts, Asking(self.profile, heel_options(asked), worn))


def coverage_asker(path: Location, asked: Any) -> CoverageAsker:
    """A question to the lasts of a catalogue, which are read now; one without a last serves nobody.

    Raises
    ------
    NoCatalogue, NoCandidate, CatalogueUnusable, BadOption
        As `coverage`.
    """
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.pipeline.shelf.candidates import choice, in_stock
    from footfit.pipeline.shelf.shelf import shelf_of

    profile = fit_profile(asked.get("profile", "walking"))
    try:
        shelf = choice(path, asked.get("style"), asked.get("size_system"))
        if not shelf.ranked.any():
            nothing = "no last passes these filters; see footfit list-lasts"
            raise NoCandidate(next((notice.message for notice in shelf.warnings), nothing))
        stock = asked.get("stock")
        shelf = shelf if stock is None else in_stock(shelf, Path(stock))
    except EmptyCatalogue:
        shelf = shelf_of(results.Library((), 0, None))
    return CoverageAsker(shelf, dict(asked), profile)


def _shown_system(asked: str | None) -> str:
    """The size system that feet are grouped by; a maker's own system says nothing of feet."""
    from footfit.geometry.fit.sizes import system_named

    system = system_named(asked)
    return "eu" if system is None else system.name
