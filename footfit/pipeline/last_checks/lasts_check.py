"""Check all lasts of a catalogue against each other, and against their labels."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from footfit.errors import BadOption
from footfit.locations import Location
from footfit.number_words import plain
from footfit.pipeline.last_checks.label_checks import label_findings
from footfit.pipeline.last_checks.twin_lasts import comparable, last_measures, twin_findings
from footfit.pipeline.last_making.run_increments import LEAST_LASTS, run_check
from footfit.pipeline.last_making.run_lasts import stored_last
from footfit.pipeline.last_making.tolerances import tolerances
from footfit.pipeline.library.lasts import list_lasts
from footfit.results import LastRecord
from footfit.results.last_making.run_check import RunCheck, RunLast
from footfit.results.population.checked_lasts import LastFinding, LastsCheck

ORDER = ("twin", "near_twin")


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
    """What breaks a run: lasts that are off by themselves, and steps that jump."""
    allowed: Mapping[tuple[str, str], float] = {
        (step.first, step.measure): step.tolerance_mm for step in checked.steps
    }
    told = set()
    for off in checked.off_lasts:
        told.add((off.last, off.measure))
        size = "large" if off.off_mm > 0.0 else "small"
        amount = f"{off.measure.replace('_', ' ')} {plain(abs(off.off_mm))} mm too {size}"
        yield LastFinding(
            "off_in_family", off.last, f"is off in its run: {amount} beside its neighbours",
            family=name, measure=off.measure, off_mm=off.off_mm,
            tolerance_mm=allowed.get((off.last, off.measure)),
        )  # fmt: skip
    for step in checked.broken:
        if {(step.first, step.measure), (step.second, step.measure)} & told:
            continue
        yield LastFinding(
            "jump_in_family", step.second, f"the run jumps: {step.words}", step.first, name,
            step.measure, step.off_mm, step.tolerance_mm,
        )  # fmt: skip
