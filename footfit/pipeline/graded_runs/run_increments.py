"""Check a run that somebody graded: the increments from size to size, and where they break."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import system_named
from footfit.geometry.grading.run_laws import Steps, likely_law, median_rate
from footfit.number_words import first_names
from footfit.pipeline.graded_runs.grading_rules import LENGTH, grading_rule
from footfit.pipeline.graded_runs.one_run import require_one_run, run_systems
from footfit.pipeline.graded_runs.run_sizes import width_numbers
from footfit.pipeline.graded_runs.run_sums import run_sums
from footfit.pipeline.last_making.tolerances import kind_of
from footfit.results import Notice
from footfit.results.last_making.grading_rule import GradingRule, LawName
from footfit.results.last_making.run_check import RunCheck, RunLast, RunLaw, RunStep, StepKind

CHECKED = (
    *("bottom_length", "ball_girth_least", "waist_girth_least", "instep_girth_least"),
    *("heel_girth_instep", "ball_width", "heel_width", "bottom_width_ball", "bottom_width_heel"),
    *("toe_height", "heel_height", "toe_spring_tip"),
)
"""The measures of a run that are checked, in this order."""
BY_SHAPE = "_by_shape"
"""The end of the name of a height as the shape alone stands. A label holds the height itself, so a
last whose shape is wrong would pass."""
HEIGHTS_BY_SHAPE = (f"heel_height{BY_SHAPE}", f"toe_spring_tip{BY_SHAPE}")
NEAR_STEPS = 5
"""A height by shape is compared with so many steps about its own: with a held bottom the tread
wanders, and the shape reads lower and lower (docs/decisions/0316)."""
MOST_NAMED = 5
"""So many lasts or files are named in a warning."""
LEAST_LASTS = 3
"""Two lasts have one increment, which nothing can be compared with."""


OF_TWINS = "name one of them, or say the sizes with --manifest"
OF_STORED_TWINS = "change the labels of one with edit-last, or remove it with remove-last"


@dataclass(frozen=True, slots=True)
class Line:
    """Lasts that differ in size alone, or in width alone, from the least to the largest.

    ``at`` says what they have in common; ``places`` (n,) are their sizes or widths as numbers.
    """

    kind: StepKind
    at: str
    lasts: tuple[RunLast, ...]
    places: tuple[float, ...]

    def label(self, at: int) -> str:
        """The size, or the width, of one of its lasts."""
        last = self.lasts[at]
        return last.size if self.kind == "size" else last.width or ""

    def having(self, measure: str) -> Line:
        """The line without the lasts that lack a measure."""
        kept = [at for at, last in enumerate(self.lasts) if measure in last.measures_mm]
        lasts = tuple(self.lasts[at] for at in kept)
        return replace(self, lasts=lasts, places=tuple(self.places[at] for at in kept))

    def steps(self, measure: str) -> Steps:
        """The steps of a measure that all its lasts have."""
        values = [last.measures_mm[measure] for last in self.lasts]
        return Steps(np.array(self.places), np.array(values))


def run_check(
    lasts: Sequence[RunLast],
    tolerance_mm: Mapping[str, float],
    rule: GradingRule | None = None,
    family: str | None = None,
) -> RunCheck:
    """The increments of a run, each beside what it should be by the run itself or by a rule.

    Raises
    ------
    BadOption
        There are too few lasts to compare an increment with anything, or two of one size, width and
        side. They are of several styles, families or size systems, or the rule is for other ones.
    """
    if len(lasts) < (2 if rule else LEAST_LASTS):
        count = "is 1 last" if len(lasts) == 1 else f"are {len(lasts)} lasts"
        words = f"a run needs {LEAST_LASTS} sizes or more, and there {count}"
        raise BadOption(f"{words}: name more, or compare two with --rule")
    require_one_run(lasts, rule)
    _refuse_twins(lasts)
    lasts, by_shape = _with_heights_by_shape(lasts)
    step = _least_step(lasts) if rule is None else rule.size_step
    lines = [*_size_lines(lasts, step)]
    widths, warnings = _widths(lasts, rule)
    lines += _width_lines(lasts, rule, widths)
    if not any(len(line.lasts) > 1 for line in lines):
        raise BadOption("no two lasts differ in size alone, or in width alone: name the whole run")
    known = [
        (part, name)
        for line in lines
        for name in (*CHECKED, *HEIGHTS_BY_SHAPE)
        if len((part := line.having(name)).lasts) > 1
    ]
    law = rule.law if rule else likely_law(_scaled_sizes(known))
    laws = tuple(_laws(known, law, rule))
    by_kind = {(each.measure, each.kind): each for each in laws}
    steps = tuple(_steps(known, by_kind, tolerance_mm))
    if not any(each.judged for each in steps):
        words = "each measure has one increment alone, and nothing to compare it with"
        raise BadOption(f"{words}: name more sizes, or compare with a --rule")
    checked = RunCheck(
        family=family,
        law=law,
        size_step=step,
        rule=None if rule is None else rule.name,
        tolerance_mm=dict(tolerance_mm),
        lasts=tuple(sorted(lasts, key=lambda last: (last.size_number, last.width or ""))),
        laws=laws,
        steps=steps,
        warnings=(*warnings, *by_shape, *_lacking(lasts), *_alone(lasts, lines)),
    )
    if rule is None:
        notes = (*checked.warnings, *_not_judged(laws), *_beside_its_system(checked, widths))
        return replace(checked, warnings=notes)
    wrong = {(off.last, off.measure) for off in checked.off_lasts}
    sums = tuple(run_sums(lasts, rule, tolerance_mm, widths, wrong))
    return replace(checked, sums=sums, warnings=(*checked.warnings, *_not_judged(laws)))


def _not_judged(laws: Sequence[RunLaw]) -> Iterator[Notice]:
    """A warning for measures that have one increment alone, which the run itself cannot judge."""
    for kind in ("size", "width"):
        names = [
            each.measure.replace("_", " ") for each in laws if each.kind == kind and each.alone
        ]
        if names:
            words = f"from {kind} to {kind} there is one increment alone, so it is not judged"
            hint = f"name more {kind}s, or compare with a --rule that has it"
            yield Notice(
                "increment_not_judged", f"{words}: {first_names(names, MOST_NAMED)}; {hint}"
            )


def _beside_its_system(checked: RunCheck, widths: Mapping[str, float]) -> Iterator[Notice]:
    """A warning if the sizes of a run are not as far apart as those of its size system are.

    A run that is compared with itself may grow by any increment. A maker chooses that of the
    girths, but not that of the length: the size system has it.
    """
    systems = run_systems(checked.lasts)
    if len(systems) != 1:
        return
    rule = grading_rule(None, system_named(systems[0]))
    rule = replace(rule, size={LENGTH: rule.size[LENGTH]}, width={})
    for each in run_sums(checked.lasts, rule, checked.tolerance_mm, widths):
        if each.broken:
            words = f"its sizes are not as far apart as those of {systems[0]}: {each.words}"
            yield Notice("other_size_step", f"{words}; check it with --rule {rule.name}")


def _with_heights_by_shape(
    lasts: Sequence[RunLast],
) -> tuple[list[RunLast], tuple[Notice, ...]]:
    """The lasts of a run in which some stand by their labels; a warning if others do not.

    Heel height and toe spring of those others are by shape, and are compared by shape alone.
    """
    if not any(name in last.measures_mm for last in lasts for name in HEIGHTS_BY_SHAPE):
        return list(lasts), ()
    result, unlabelled = [], []
    for last in lasts:
        measures = dict(last.measures_mm)
        if last.stands_by != "label":
            unlabelled.append(last.last)
            for name in HEIGHTS_BY_SHAPE:
                if (height_mm := measures.pop(name.removesuffix(BY_SHAPE), None)) is not None:
                    measures[name] = height_mm
        result.append(replace(last, measures_mm=measures))
    words = "no label says how they stand: their heel and toe spring are compared by shape alone"
    named = first_names(unlabelled, MOST_NAMED)
    return result, (Notice("stance_by_shape", f"{named}: {words}"),) if unlabelled else ()


def _least_step(lasts: Sequence[RunLast]) -> float:
    """The least difference between two sizes of a run; 1 if there is one size alone."""
    sizes = np.unique([last.size_number for last in lasts])
    return float(np.diff(sizes).min(initial=np.inf)) if len(sizes) > 1 else 1.0


def _scaled_sizes(known: Sequence[tuple[Line, str]]) -> Iterator[Steps]:
    """The steps from size to size of what no run holds: lengths and girths."""
    for line, name in known:
        if line.kind == "size" and kind_of(name) in ("length", "girth"):
            yield line.steps(name)


def _refuse_twins(lasts: Sequence[RunLast]) -> None:
    seen: dict[tuple[float, str | None, str | None], RunLast] = {}
    for last in lasts:
        twin = seen.setdefault((last.size_number, last.width, last.side), last)
        if twin is not last:
            width = f", width {last.width}" if last.width else ""
            words = f"both {twin.last!r} and {last.last!r} have the size {last.size}{width}"
            stored = {twin.size_from, last.size_from} == {"catalogue"}
            raise BadOption(f"{words}: {OF_STORED_TWINS if stored else OF_TWINS}")


def _size_lines(lasts: Sequence[RunLast], step: float) -> Iterator[Line]:
    """The lasts of each width and side, by size."""
    groups: dict[tuple[str, str], list[RunLast]] = defaultdict(list)
    for last, side in zip(lasts, _sides(lasts), strict=True):
        groups[last.width or "", side].append(last)
    for key, group in sorted(groups.items()):
        group.sort(key=lambda last: last.size_number)
        yield _line("size", key, group, [last.size_number / step for last in group])


def _widths(
    lasts: Sequence[RunLast], rule: GradingRule | None
) -> tuple[dict[str, float], tuple[Notice, ...]]:
    """The widths of a run as numbers; none, and a warning, if they have no order."""
    widths = sorted({last.width for last in lasts if last.width})
    if len(widths) < 2:
        return {}, ()
    try:
        return width_numbers(widths, rule.widths if rule else ()), ()
    except BadOption as error:
        return {}, (Notice("widths_without_order", f"{error.message}; they are not compared"),)


def _width_lines(
    lasts: Sequence[RunLast], rule: GradingRule | None, number: Mapping[str, float]
) -> Iterator[Line]:
    """The lasts of each size and side, by width."""
    step = rule.width_step if rule else 1.0
    groups: dict[tuple[float, str], list[RunLast]] = defaultdict(list)
    for last, side in zip(lasts, _sides(lasts), strict=True):
        if last.width in number:
            groups[last.size_number, side].append(last)
    for key, group in sorted(groups.items()):
        group.sort(key=lambda last: number[last.width or ""])
        if len(group) > 1:
            common = (group[0].size, key[1])
            places = [number[last.width or ""] / step for last in group]
            yield _line("width", common, group, places)


def _line(
    kind: StepKind, common: tuple[str, str], group: Sequence[RunLast], places: Sequence[float]
) -> Line:
    return Line(kind, " ".join(filter(None, common)), tuple(group), tuple(places))


def _sides(lasts: Sequence[RunLast]) -> list[str]:
    """The side of each last, if the run has both sides; else nothing."""
    both = len({last.side for last in lasts}) > 1
    return [(last.side or "") if both else "" for last in lasts]


def _laws(
    known: Sequence[tuple[Line, str]], law: LawName, rule: GradingRule | None
) -> Iterator[RunLaw]:
    """What each measure grows by in a size and in a width. A height may be held, so it is in mm."""
    for kind in ("size", "width"):
        for measure in (*CHECKED, *HEIGHTS_BY_SHAPE):
            runs = [
                line.steps(name) for line, name in known if (line.kind, name) == (kind, measure)
            ]
            if not runs:
                continue
            stated = None if rule is None else getattr(rule, kind).get(measure)
            own: LawName = "arithmetic" if kind_of(measure) == "height" else law
            yield RunLaw(
                measure=measure,
                kind=kind,
                law=own,
                unit="mm" if own == "arithmetic" else "percent",
                per_step=_per_step(runs, own) if stated is None else stated.by,
                steps=sum(len(run.place) - 1 for run in runs),
                by="run" if stated is None or rule is None else rule.name,
            )


def _per_step(runs: Sequence[Steps], law: LawName) -> float:
    """The run's own increment, in mm or in percent."""
    if law == "arithmetic":
        return median_rate(runs)
    logs = median_rate([Steps(run.place, np.log(run.value_mm)) for run in runs])
    return float(100.0 * np.expm1(logs))


def _steps(
    known: Sequence[tuple[Line, str]],
    laws: Mapping[tuple[str, StepKind], RunLaw],
    tolerance_mm: Mapping[str, float],
) -> Iterator[RunStep]:
    """Every step of every measure, with what it should be."""
    for line, measure in known:
        law, steps = laws[measure, line.kind], line.steps(measure)
        by = law.per_step if law.law == "arithmetic" else float(np.log1p(law.per_step / 100.0))
        expected = steps.expected_mm(law.law, by)
        if measure.endswith(BY_SHAPE) and line.kind == "size":
            expected = steps.near_mm(NEAR_STEPS)
        for at, (first, second) in enumerate(pairwise(line.lasts)):
            yield RunStep(
                measure=measure,
                kind=line.kind,
                at=line.at,
                start=line.label(at),
                end=line.label(at + 1),
                first=first.last,
                second=second.last,
                increment_mm=float(steps.increment_mm[at]),
                expected_mm=None if law.alone else float(expected[at]),
                tolerance_mm=tolerance_mm[kind_of(measure)],
                sd_mm=math.hypot(*(_sd_mm(last, measure) for last in (first, second))),
            )


def _sd_mm(last: RunLast, measure: str) -> float:
    """The spread of a second scan of a measure; a height by shape has that of the height."""
    return last.sd_mm.get(measure.removesuffix(BY_SHAPE), 0.0)


def _lacking(lasts: Sequence[RunLast]) -> tuple[Notice, ...]:
    """A warning for each measure that some lasts lack, and some have."""
    names = [*CHECKED, *HEIGHTS_BY_SHAPE]
    known = [{*last.measures_mm, *_known_by_shape(last)} for last in lasts]
    counts = {name: sum(name in measures for measures in known) for name in names}
    return tuple(
        Notice(
            "measure_missing",
            f"{name.replace('_', ' ')} is measured on {count} of {len(lasts)} lasts: the"
            " others are left out of its check",
        )
        for name, count in counts.items()
        if 0 < count < len(lasts)
    )


def _known_by_shape(last: RunLast) -> Iterator[str]:
    """The heights of a last that are compared by shape alone."""
    for name in HEIGHTS_BY_SHAPE:
        if name in last.measures_mm:
            yield name.removesuffix(BY_SHAPE)


def _alone(lasts: Sequence[RunLast], lines: Sequence[Line]) -> tuple[Notice, ...]:
    """A warning for each last that is compared with no other one."""
    compared = {last.last for line in lines if len(line.lasts) > 1 for last in line.lasts}
    return tuple(
        Notice(
            "last_not_compared",
            f"{last.last!r} ({last.side or 'of no known side'}, size {last.size}) is not checked:"
            " no other last has its side and its width, or its side and its size",
        )
        for last in lasts
        if last.last not in compared
    )
