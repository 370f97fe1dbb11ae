"""The answers of many customers, each with one foot or two, in order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

from footfit import results
from footfit.errors import BadOption, GeometryRefused, SameSide
from footfit.pipeline.batch.phases import begin
from footfit.pipeline.batch.runs import HERE, Jobs, Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.pipeline.customers.customer import Customer, CustomerFoot
from footfit.pipeline.customers.pair_sides import Foot, pair_of_feet, with_named_side
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.reading import aligned_source
from footfit.pipeline.shelf.shelf import Shelf


def matches(
    customers: Sequence[Customer],
    reading: ReadingOptions,
    library: results.Library | Shelf,
    question: Question,
    *,
    jobs: Jobs = 1,
) -> Iterator[Outcome[Customer, results.Match]]:
    """Each customer's answer, in order.

    Raises
    ------
    BadOption
        One side is given for both feet of a pair.
    """
    if reading.side != "auto" and any(len(customer.feet) > 1 for customer in customers):
        raise BadOption("--side gives both feet of a pair one side: leave it out")
    jobs = HERE if len(customers) == 1 and jobs == 1 else jobs  # a process costs its start
    scans = [foot for customer in customers for foot in customer.feet]
    feet = outcomes(partial(read_foot, reading=reading), scans, jobs)
    for customer in customers:
        yield _answered(customer, list(islice(feet, len(customer.feet))), library, question)


def read_foot(foot: CustomerFoot, reading: ReadingOptions) -> Foot:
    """A foot, profiled if its side is known: the other foot of the customer may decide it."""
    aligned = aligned_source(foot.source, replace(reading, side=foot.given or reading.side))
    if foot.named is not None:
        aligned = with_named_side(aligned, foot.named)
    return aligned if aligned.alignment.side.side is None else profiled_scan(aligned)


def _answered(
    customer: Customer,
    feet: Sequence[Outcome[CustomerFoot, Foot]],
    library: results.Library | Shelf,
    question: Question,
) -> Outcome[Customer, results.Match]:
    """One customer's outcome; the first foot that failed is the customer's failure."""
    errors = [foot.error for foot in feet if foot.error is not None]
    if errors:
        return Outcome(customer, None, errors[0])
    try:
        shapes = pair_of_feet([foot.value for foot in feet if foot.value is not None])
        begin("match")
        answer = replace(answered(shapes, library, question), customer=customer.name)
    except (BadOption, GeometryRefused, SameSide) as error:
        return Outcome(customer, None, error.at(customer.path))
    return Outcome(customer, answer, None)


def answered(
    feet: Sequence[results.Profiled], library: results.Library | Shelf, question: Question
) -> results.Match:
    """All that is asked of one customer's feet: the match, a child's growth, the surfaces.

    Raises
    ------
    FootfitError
        As `matched`.
    """
    answer = matched(feet, library, question)
    if question.growth is not None:
        from footfit.pipeline.customers.growth_forecast import with_growth

        answer = with_growth(answer, question.growth)
    if question.surfaces_in is None:
        return answer
    from footfit.pipeline.fit.compare import with_surface_clearance

    return with_surface_clearance(answer, question.surfaces_in)
