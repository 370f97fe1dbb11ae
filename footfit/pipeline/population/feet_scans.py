"""Feet from scans: each is read, measured and forgotten; only its measures stay in memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TypeAlias

from footfit.errors import FootfitError
from footfit.geometry.measures.measure_table import of_kind
from footfit.pipeline.batch.runs import Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.population.foot_measures import (
    FootMeasures,
    foot_table,
    part_mark,
    read_foot,
)
from footfit.pipeline.population.measure_cache import measure_cache
from footfit.pipeline.population.tables import FootTable
from footfit.pipeline.scan.reading import content_hash
from footfit.results.population.coverage_answer import FailedFoot

FootOutcome: TypeAlias = Outcome[Source, FootMeasures]


def measured_feet(
    sources: Sequence[Source], reading: ReadingOptions, jobs: int, cache: Path | None = None
) -> Iterator[FootOutcome]:
    """The outcome of each scan; first those that the cache has, then the others in their order.

    Raises
    ------
    BadOption
        The cache is another kind of file, or cannot be written.
    """
    if cache is None:
        yield from outcomes(partial(read_foot, reading=reading), sources, jobs)
        return
    with measure_cache(cache, reading) as (kept, add):
        to_read: list[Source] = []
        for source in sources:
            foot = _kept_foot(source, kept)
            if foot is None:
                to_read.append(source)
            else:
                yield Outcome(source, foot, None)
        for outcome in outcomes(partial(read_foot, reading=reading), to_read, jobs):
            if outcome.value is not None:
                add(outcome.value)
            yield outcome


def _kept_foot(source: Source, kept: Mapping[str, FootMeasures]) -> FootMeasures | None:
    """The measures of a file that the cache has; a file that cannot be read has none."""
    try:
        return kept.get(content_hash(source) + part_mark(source)) if kept else None
    except FootfitError:
        return None


def feet_of_scans(
    measured: Iterable[FootOutcome], sources: Sequence[Source]
) -> tuple[FootTable, tuple[FailedFoot, ...]]:
    """The feet of outcomes in the order of their sources, and those that failed."""
    places = {id(source): place for place, source in enumerate(sources)}
    ordered = sorted(measured, key=lambda outcome: places.get(id(outcome.item), 0))
    ids, feet, failed = [], [], []
    for outcome in ordered:
        name = outcome.item.path or "standard input"
        if outcome.value is not None:
            ids.append(name)
            feet.append(outcome.value)
        elif outcome.error is not None:
            failed.append(FailedFoot(name, outcome.error.code, outcome.error.message))
    names = [entry.name for entry in of_kind("foot")]
    return foot_table(ids, feet, names), tuple(failed)
