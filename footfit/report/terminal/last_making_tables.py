"""Answers about lasts that are made from lasts as rich renderables."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit import results
from footfit.number_words import plain, signed
from footfit.report.terminal.scan_tables import cell, lined_table
from footfit.report.wording.run_words import break_words
from footfit.report.wording.text import visible

IN_FULL = 4
"""A run of more lasts has one table, with a row for each last."""
OFF, UNSURE = "!", "?"
"""Stand beside an increment that is out of tolerance, and beside one that may be."""


def graded_run_table(run: results.GradedRun) -> RenderableType:
    """What was planned of each measure and what each last has, and what was held."""
    width = "" if run.base_width is None else f", width {visible(run.base_width)}"
    size = f"size {visible(run.base_size)} of {run.size_system}"
    base = f"{visible(run.base)} ({size}{width})"
    held = ", ".join(run.held) or "nothing"
    sources = f"by the rule {visible(run.rule.name)}, {run.rule.law}; held: {held}"
    parts: list[RenderableType] = [Text(f"{base} graded {sources}", "bold")]
    if len(run.lasts) > IN_FULL:
        parts.append(_run_table(run))
    else:
        parts += [_graded_table(last) for last in run.lasts]
    worst = max(
        (each for last in run.lasts if (each := last.worst) is not None),
        key=lambda each: abs(each.difference or 0.0),
        default=None,
    )
    if worst is not None and worst.difference is not None:
        words = f"farthest from its plan: {worst.name.replace('_', ' ')}"
        flare = _farthest_flare(run)
        turned = "" if flare is None else f"; flare {signed(flare, 3)} degrees"
        parts.append(Text(f"{words}, {signed(worst.difference, 3)} mm{turned}", "dim"))
    parts.append(Text("± is the spread of a second scan of the last", "dim"))
    if run.mesh.error_mm >= 0.005:  # what the line can show
        error = plain(run.mesh.error_mm, 2)
        words = f"made from the {run.mesh.kind} of the base, at most {error} mm from its scan"
        parts.append(Text(words, "yellow"))
    return Group(*parts, *map(Text, _stored_words(run)))


def _stored_words(run: results.GradedRun) -> list[str]:
    """The names that lasts of a run are stored as, and why others of it are not stored."""
    names = [visible(last.last) for last in run.lasts if last.stored]
    lines = [f"stored as {', '.join(names)}"] if names else []
    return lines + [
        f"not stored: {visible(last.last)}, because {visible(last.not_stored)}"
        for last in run.lasts
        if last.not_stored is not None
    ]


def _farthest_flare(run: results.GradedRun) -> float | None:
    """By how many degrees the flare of a last is off most; None if no bottom shows it."""
    off = [last.flare.difference for last in run.lasts if last.flare is not None]
    return max((each for each in off if each is not None), key=abs, default=None)


def _run_table(run: results.GradedRun) -> RenderableType:
    """A row for each last: what it has of each planned measure, and what is farthest off. What is
    held has a line of its own.
    """
    first = run.lasts[0].shown
    names = [each.name for each in first if each.by not in ("follows", "held")]
    heads = [_words(name).replace(" ", "\n") for name in names]
    table = lined_table("size", *heads, "off\nmost", right=frozenset((*heads, "off\nmost")))
    for last in run.lasts:
        own = {each.name: each for each in last.shown}
        reached = (own[name].reached if name in own else None for name in names)
        table.add_row(
            cell(last.size if last.width is None else f"{last.size} {last.width}"),
            *("-" if value is None else plain(value) for value in reached),
            "-" if last.worst is None else signed(last.worst.difference or 0.0, 3),
        )
    held = ", ".join(_held_words(run, each.name) for each in first if each.by == "held")
    lines = [f"Held, in mm: {held}"] * bool(held)
    lines.append("Reached, in mm; the flare in degrees. --csv FILE has every measure, and its plan")
    return Group(table, *(Text(words, "dim") for words in lines))


def _held_words(run: results.GradedRun, name: str) -> str:
    """What the lasts of a run have of a held measure: one number, or the least and the most."""
    rows = (each for last in run.lasts for each in last.measures if each.name == name)
    values = [each.reached for each in rows if each.reached is not None]
    span = dict.fromkeys(map(plain, (min(values), max(values)))) if values else ["-"]
    return f"{_words(name)} {' to '.join(span)}"


def _words(name: str) -> str:
    """The name of a measure in words."""
    return {"flare_angle": "flare"}.get(name, name.replace("_", " "))


def _graded_table(last: results.GradedLast) -> RenderableType:
    """One last: a row for each measure."""
    numbers = ("base", "planned", "reached", "off", "±")
    table = lined_table("mm", *numbers, "by", right=frozenset(numbers))
    for each in last.shown:
        table.add_row(
            cell(_words(each.name) if each.unit == "mm" else f"{_words(each.name)}, {each.unit}"),
            plain(each.base, 2),
            *("-" if value is None else plain(value, 2) for value in (each.planned, each.reached)),
            "-" if each.difference is None else signed(each.difference, 2),
            "-" if each.sd is None else plain(each.sd, 2),
            each.by,
        )
    width = "" if last.width is None else f" {visible(last.width)}"
    stored = ", stored" if last.stored else ""
    return Group(Text(f"{visible(last.last)}: size {visible(last.size)}{width}{stored}"), table)


def check_run_table(checked: results.RunCheck) -> RenderableType:
    """What each measure grows by, each increment between neighbours, and what is out of tolerance.

    Lasts that differ in size, and lasts that differ in width, have a table for each line of them.
    """
    parts: list[RenderableType] = [_lasts_words(checked)]
    for kind, at in dict.fromkeys((step.kind, step.at) for step in checked.steps):
        parts.append(_steps_table(checked, kind, at))
    if checked.sums:
        parts.append(_sums_table(checked))
    parts += [Text(f"{OFF} {visible(words)}", "bold red") for words in break_words(checked)]
    limits = ", ".join(f"{kind} {plain(mm)} mm" for kind, mm in checked.tolerance_mm.items())
    state = f"{len(checked.broken)} of {len(checked.judged)} increments are out of tolerance"
    if checked.sums:
        state += f", and {len(checked.broken_sums)} of {len(checked.sums)} sums over the run"
    spreads = "± is the spread of an increment if both lasts are scanned again"
    unsure = len(checked.unsure) + sum(not each.sure for each in checked.sums)
    if unsure:
        verb = "is" if unsure == 1 else "are"
        spreads += f"; {unsure} {verb} so near to the tolerance that it is not sure ({UNSURE})"
    return Group(*parts, Text(f"{state} ({limits})", "dim"), Text(spreads, "dim"))


def _lasts_words(checked: results.RunCheck) -> Text:
    """How many lasts there are, and by what they are judged."""
    name = f"{visible(checked.family)}: " if checked.family else ""
    sizes = list(dict.fromkeys(last.size for last in checked.lasts))
    by = f"the rule {visible(checked.rule)}" if checked.rule else "the run itself"
    words = f"{name}{len(checked.lasts)} lasts, sizes {visible(sizes[0])} to {visible(sizes[-1])}"
    words += f" by {' and '.join(sorted({last.size_from for last in checked.lasts}))}"
    return Text(f"{words}, {checked.law}, compared with {by}", "bold")


def _steps_table(checked: results.RunCheck, kind: str, at: str) -> RenderableType:
    """A row for each measure: what it grows by, and its increments."""
    steps = [step for step in checked.steps if (step.kind, step.at) == (kind, at)]
    order = list(dict.fromkeys(label for step in steps for label in (step.start, step.end)))
    pairs = sorted({(s.start, s.end) for s in steps}, key=lambda pair: [*map(order.index, pair)])
    heads = [f"{visible(start)}\nto {visible(end)}" for start, end in pairs]
    per = "per\nstep"
    by = ("by",) if checked.rule else ()
    table = lined_table("mm", per, *by, "±", *heads, right=frozenset((per, "±", *heads)))
    for law in (law for law in checked.laws if law.kind == kind):
        own = {(s.start, s.end): s for s in steps if s.measure == law.measure}
        if not own:
            continue
        unit = " %" if law.unit == "percent" else ""
        table.add_row(
            cell(law.measure.replace("_", " ")),
            "-" if law.alone else f"{signed(law.per_step)}{unit}",
            *(visible(law.by) for _ in by),
            plain(max(step.sd_mm for step in own.values())),
            *(_increment(own.get(pair)) for pair in pairs),
        )
    title = {"size": "from size to size", "width": "from width to width"}[kind]
    return Group(Text(f"{title}{', ' if at else ''}{visible(at)}"), table)


def _sums_table(checked: results.RunCheck) -> RenderableType:
    """A row for each measure of the rule: between which lasts it misses most over the run."""
    numbers = ("sum", "rule", "off", "±")
    table = lined_table("mm", "from", *numbers, right=frozenset(numbers))
    for each in checked.sums:
        mark = f"{OFF if each.broken else ''}{'' if each.sure else UNSURE}"
        off = f"{signed(each.off_mm)}{mark}"
        at = f" {visible(each.at)}" if each.at else ""
        table.add_row(
            cell(each.measure.replace("_", " ")),
            f"{visible(each.start)} to {visible(each.end)}{at}",
            signed(each.increment_mm),
            signed(each.expected_mm or 0.0),
            Text(off, "bold red") if each.broken else Text(off),
            plain(each.sd_mm),
        )
    words = "over the run, between the two lasts that are farthest from the rule"
    return Group(Text(words), table)


def _increment(step: results.RunStep | None) -> Text:
    if step is None:
        return Text("-", "dim")
    doubt = "" if step.sure else UNSURE
    words = signed(step.increment_mm)
    if not step.judged:
        return Text(words, "dim")
    return Text(f"{words}{OFF}{doubt}", "bold red") if step.broken else Text(f"{words}{doubt}")
