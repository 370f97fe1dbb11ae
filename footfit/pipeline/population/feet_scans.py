"""Feet from scans: each is read, measured and forgotten; only its measures stay in memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TypeAlias

from footfit.geometry.measures.measure_table import of_kind
from footfit.pipeline.batch.runs import Jobs, Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source, content_hash
from footfit.pipeline.population.foot_measures import (
    FootMeasures,
    foot_table,
    part_mark,
    read_foot,
)
from footfit.pipeline.population.measure_cache import measure_cache
from footfit.pipeline.population.tables import FootTable
from footfit.results.population.coverage_answer import FailedFoot

FootOutcome: TypeAlias = Outcome[Source, FootMeasures]


def measured_feet(
    sources: Sequence[Source], reading: ReadingOptions, jobs: Jobs, cache: Path | None = None
) -> Iterator[FootOutcome]:
    """The outcome of each scan in order; what the cache has is not read again.

    Raises
    ------
    BadOption
        The cache is another kind of file, or cannot be written.
    """
    work = partial(read_foot, reading=reading)
    if cache is None:
        yield from outcomes(work, sources, jobs)
        return
    with measure_cache(cache, reading) as (kept, add):
        known = partial(_kept_foot, kept) if kept else _nothing
        for outcome in outcomes(work, sources, jobs, known=known):
            foot = outcome.value
            if foot is not None and kept.get(foot.key) is not foot:
                add(foot)
            yield outcome


def _kept_foot(kept: Mapping[str, FootMeasures], source: Source) -> FootMeasures | None:
    """The measures of a scan that the cache has."""
    return kept.get(content_hash(source) + part_mark(source))


def _nothing(_: Source) -> None:
    """An empty cache knows no scan."""


def feet_of_scans(measured: Iterable[FootOutcome]) -> tuple[FootTable, tuple[FailedFoot, ...]]:
    """The feet of outcomes, and those that failed."""
    ids, feet, failed = [], [], []
    for outcome in measured:
        name = outcome.item.path or "standard input"
        if outcome.value is not None:
            ids.append(name)
            feet.append(outcome.value)
        elif outcome.error is not None:
            failed.append(FailedFoot(name, outcome.error.code, outcome.error.message))
    names = [entry.name for entry in of_kind("foot")]
    return foot_table(ids, feet, names), tuple(failed)
