"""Check all lasts of a catalogue against each other, and against their labels."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from footfit.errors import BadOption
from footfit.locations import Location
from footfit.number_words import plain
from footfit.pipeline.graded_runs.run_increments import LEAST_LASTS, run_check
from footfit.pipeline.graded_runs.run_lasts import stored_last
from footfit.pipeline.last_checks.label_checks import label_findings
from footfit.pipeline.last_checks.twin_lasts import comparable, last_measures, twin_findings
from footfit.pipeline.last_making.tolerances import tolerances
from footfit.pipeline.library.lasts import list_lasts
from footfit.results import LastRecord
from footfit.results.last_making.run_check import OffLast, RunCheck, RunLast, RunStep
from footfit.results.population.checked_lasts import LastFinding, LastsCheck


def check_lasts(path: Location, tolerance: str | None = None) -> LastsCheck:
    """The lasts of a catalogue: twins, labels that shapes contradict, runs that break.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    BadOption
        The tolerance is not written as KIND=MM.
    """
    allowed = tolerances(tolerance)
    library = list_lasts(path)
    records = sorted(library.lasts, key=lambda record: record.labels.name)
    measures = last_measures(records)
    runs, alone = _families(records)
    findings = [*twin_findings(records, measures, allowed), *label_findings(records)]
    not_checked = list(alone)
    for name, lasts in runs:
        try:
            findings += _run_findings(name, run_check(lasts, allowed, family=name))
        except BadOption as error:
            not_checked.append((name, error.message))
    return LastsCheck(
        path=str(path),
        lasts=len(records),
        families=len(runs) + len(alone) - len(not_checked),
        findings=tuple(sorted(findings, key=lambda each: (not each.fault, each.last, each.code))),
        tolerance_mm=allowed,
        not_checked=tuple(sorted(not_checked)),
        not_compared=int((~comparable(measures)).sum()) if records else 0,
        warnings=library.warnings,
    )


def _families(
    records: Sequence[LastRecord],
) -> tuple[list[tuple[str, list[RunLast]]], list[tuple[str, str]]]:
    """The runs of each family, else of each style, by side and size system; and the families that
    have too few sizes, with the reason.
    """
    groups: dict[tuple[str, str, str], list[RunLast]] = defaultdict(list)
    few: dict[str, str] = {}
    for record in records:
        labels = record.labels
        name = labels.family or labels.style
        if name is None:
            continue
        try:
            run = stored_last(record)
        except BadOption as error:
            few[name] = error.message
            continue
        groups[name, labels.size_system or "", record.side.side or ""].append(run)
    runs, alone = [], []
    for (name, system, side), lasts in sorted(groups.items()):
        title = " ".join(filter(None, (name, system, side)))
        if len(lasts) >= LEAST_LASTS:
            runs.append((title, lasts))
        else:
            alone.append(
                (title, f"a run needs {LEAST_LASTS} lasts or more, and it has {len(lasts)}")
            )
    alone += few.items()
    return runs, alone


def _run_findings(name: str, checked: RunCheck) -> Iterator[LastFinding]:
    """What breaks a run: a finding for each last that is off by itself, and for each step that
    jumps, with the measure that is farthest off in its tolerance.
    """
    allowed = {(step.first, step.measure): step.tolerance_mm for step in checked.steps}
    off_lasts: dict[str, dict[str, OffLast]] = defaultdict(dict)
    for off in checked.off_lasts:
        off_lasts[off.last][off.measure] = off
    for last, by_measure in off_lasts.items():
        worst = max(
            by_measure.values(), key=lambda off: _times(off.off_mm, allowed[off.last, off.measure])
        )
        size = "large" if worst.off_mm > 0.0 else "small"
        amount = f"{worst.measure.replace('_', ' ')} {plain(abs(worst.off_mm))} mm too {size}"
        words = f"is off in its run: {amount} beside its neighbours"
        yield LastFinding(
            "off_in_family", last, words + _more(set(by_measure) - {worst.measure}), family=name,
            measure=worst.measure, off_mm=worst.off_mm, tolerance_mm=allowed[last, worst.measure],
        )  # fmt: skip
    jumps: dict[tuple[str, str], dict[str, RunStep]] = defaultdict(dict)
    for step in checked.jumps:
        jumps[step.first, step.second][step.measure] = step
    for (first, second), steps in jumps.items():
        step = max(steps.values(), key=lambda each: _times(each.off_mm, each.tolerance_mm))
        words = f"the run jumps: {step.words}{_more(set(steps) - {step.measure})}"
        yield LastFinding(
            "jump_in_family", second, words, first, name,
            step.measure, step.off_mm, step.tolerance_mm,
        )  # fmt: skip


def _times(off_mm: float, tolerance_mm: float) -> float:
    """How many times its tolerance a measure is off."""
    return abs(off_mm) / max(tolerance_mm, 1e-3)


def _more(measures: set[str]) -> str:
    """The other measures that are off.

    Examples
    --------
    >>> _more({"heel_width", "ball_width"}), _more(set())
    ('; also off: ball width, heel width', '')
    """
    names = ", ".join(sorted(measure.replace("_", " ") for measure in measures))
    return f"; also off: {names}" if names else ""
