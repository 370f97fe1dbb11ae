"""What a run adds up to by a grading rule: the two lasts that are farthest apart from its plan."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from itertools import combinations

from footfit.pipeline.graded_runs.grading_rules import LENGTH
from footfit.pipeline.last_making.tolerances import kind_of
from footfit.results.last_making.grading_rule import GradingRule
from footfit.results.last_making.run_check import RunLast, RunStep


def run_sums(
    lasts: Sequence[RunLast],
    rule: GradingRule,
    tolerance_mm: Mapping[str, float],
    widths: Mapping[str, float],
    wrong: Set[tuple[str, str]] = frozenset(),
) -> Iterator[RunStep]:
    """For each measure of a rule, and each side, the two lasts that differ most from its plan.

    Small misses of the same sign add up from size to size, though each step is inside its
    tolerance. So any two lasts of a run are compared, over all sizes and widths between them.

    Parameters
    ----------
    lasts : sequence of RunLast
    rule : GradingRule
    tolerance_mm : mapping
        By kind of measure.
    widths : mapping
        Each width as a number that rises; empty if they have no order. Then lasts of other widths
        are not compared.
    wrong : set of (last, measure)
        Lasts that are wrong by themselves: they are left out, because they are named.
    """
    both = len({last.side for last in lasts}) > 1
    groups: dict[str, list[RunLast]] = defaultdict(list)
    for last in sorted(lasts, key=lambda each: (each.size_number, widths.get(each.width or "", 0))):
        groups[(last.side or "") if both else ""].append(last)
    for measure in dict.fromkeys((*rule.size, *rule.width)):
        for side, group in sorted(groups.items()):
            known = [last for last in group if measure in last.measures_mm]
            known = [last for last in known if (last.last, measure) not in wrong]
            sums = [
                _sum(measure, side, pair, planned, tolerance_mm[kind_of(measure)])
                for pair in combinations(known, 2)
                if (planned := _planned_mm(measure, *pair, rule, widths)) is not None
            ]
            if sums:
                yield max(sums, key=lambda each: abs(each.off_mm or 0.0))


def _planned_mm(
    measure: str, first: RunLast, second: RunLast, rule: GradingRule, widths: Mapping[str, float]
) -> float | None:
    """What the second last should have by the rule, from the first; None if it does not say."""
    sizes = (second.size_number - first.size_number) / rule.size_step
    steps = 0.0
    if first.width != second.width:
        numbers = [widths.get(last.width or "", math.nan) for last in (first, second)]
        steps = (numbers[1] - numbers[0]) / rule.width_step
        if math.isnan(steps):
            return None
    if sizes and measure not in rule.size:
        return None
    if steps and measure not in rule.width and measure != LENGTH:  # which no width changes
        return None
    return rule.planned(measure, first.measures_mm[measure], sizes, steps)


def _sum(
    measure: str, side: str, pair: tuple[RunLast, RunLast], planned_mm: float, tolerance_mm: float
) -> RunStep:
    """The step from one last to another, which may be many sizes and widths larger."""
    first, second = pair
    start_mm, end_mm = (last.measures_mm[measure] for last in pair)
    same = first.width == second.width
    labels = [last.size if same else f"{last.size} {last.width or ''}".strip() for last in pair]
    at = " ".join(filter(None, ((first.width or "") if same else "", side)))
    return RunStep(
        measure=measure,
        kind="run",
        at=at,
        start=labels[0],
        end=labels[1],
        first=first.last,
        second=second.last,
        increment_mm=end_mm - start_mm,
        expected_mm=planned_mm - start_mm,
        tolerance_mm=tolerance_mm,
        sd_mm=math.hypot(*(last.sd_mm.get(measure, 0.0) for last in pair)),
    )
