"""What breaks a graded run, in few lines: one for each wrong last, and one for each wrong step."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from footfit.number_words import signed
from footfit.results import RunCheck


def break_words(checked: RunCheck) -> Iterator[str]:
    """A line for each last that is wrong by itself, then for each step that jumps, and then for
    what adds up over the run.

    A line has the measures of its last or its step that are out of tolerance, the worst first.
    """
    off_by: dict[str, list[tuple[float, str]]] = defaultdict(list)
    for off in checked.off_lasts:
        head = f"{off.last!r} (size {off.size}) is wrong by itself, beside its neighbours"
        off_by[head].append((off.off_mm, off.measure))
    for step in checked.jumps:
        common = f" ({step.at})" if step.at else ""
        head = f"from {step.kind} {step.start} to {step.end}{common}, beside what is expected"
        off_by[head].append((step.off_mm, step.measure))
    seen = {(step.first, step.second, step.measure) for step in checked.broken}
    for each in checked.broken_sums:
        if (each.first, each.second, each.measure) not in seen:
            common = f" ({each.at})" if each.at else ""
            head = f"from size {each.start} to {each.end}{common}, over the run beside the rule"
            off_by[head].append((each.off_mm, each.measure))
    for head, measures in off_by.items():
        # A last of two lines, of sizes and of widths, is off in both: once is enough.
        worst: dict[str, float] = {}
        for off_mm, measure in sorted(measures, key=lambda each: -abs(each[0])):
            worst.setdefault(measure, off_mm)
        listed = (f"{name.replace('_', ' ')} {signed(mm)} mm" for name, mm in worst.items())
        yield f"{head}: {', '.join(listed)}"
