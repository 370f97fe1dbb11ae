"""The answers of many customers, each with one foot or two, in order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from footfit import results
from footfit.errors import BadOption, GeometryRefused, SameSide
from footfit.pipeline.batch.phases import begin
from footfit.pipeline.batch.runs import HERE, Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.customers.pair_sides import Foot, pair_of_feet
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.reading import aligned_source, profiled_source


def customers(
    sources: Sequence[Source],
    reading: ReadingOptions,
    library: results.Library,
    question: Question,
    *,
    pair: bool = False,
    jobs: int = 1,
) -> Iterator[Outcome[Source, results.Match]]:
    """Each customer's answer, in order: one per scan, or one for a ``pair`` of scans.

    Raises
    ------
    BadOption
        A pair of other than two scans, or one side for both.
    """
    if pair and len(sources) != 2:
        raise BadOption(f"--pair takes two different scans of one customer, not {len(sources)}")
    if pair and reading.side != "auto":
        raise BadOption("--side gives both feet of a pair one side: leave it out")
    read = foot_of_a_pair if pair else profiled_source
    jobs = HERE if pair and jobs == 1 else jobs  # another process only costs its start
    feet: Iterator[Outcome[Source, Foot]] = outcomes(partial(read, reading=reading), sources, jobs)
    for group in [list(feet)] if pair else ([foot] for foot in feet):
        yield _answered(group, library, question)


def foot_of_a_pair(source: Source, reading: ReadingOptions) -> Foot:
    """A foot, profiled if its side is known: the other foot may decide it."""
    aligned = aligned_source(source, reading)
    return aligned if aligned.alignment.side.side is None else profiled_scan(aligned)


def _answered(
    feet: Sequence[Outcome[Source, Foot]], library: results.Library, question: Question
) -> Outcome[Source, results.Match]:
    """One customer's outcome; the first foot that failed is the customer's failure."""
    source = feet[0].item
    errors = [foot.error for foot in feet if foot.error is not None]
    if errors:
        return Outcome(source, None, errors[0])
    try:
        shapes = pair_of_feet([foot.value for foot in feet if foot.value is not None])
        begin("match")
        answer = matched(shapes, library, question)
    except (BadOption, GeometryRefused, SameSide) as error:
        return Outcome(source, None, error.at(source.path))
    if question.surfaces_in is not None:
        from footfit.pipeline.fit.compare import with_surface_clearance

        answer = with_surface_clearance(answer, question.surfaces_in)
    return Outcome(source, answer, None)
