"""Whether lasts can be one run: one style, one family, and sizes of one system."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import system_named
from footfit.number_words import first_names
from footfit.results.last_making.grading_rule import GradingRule
from footfit.results.last_making.run_check import RunLast

MOST_NAMED = 5
BY_NAME = "file name"


def require_one_run(lasts: Sequence[RunLast], rule: GradingRule | None = None) -> None:
    """Refuse lasts that are not one last in its sizes and widths, or that a rule does not count.

    Raises
    ------
    BadOption
        They are of several families, styles or size systems, or the rule is for other systems. The
        message says what to do.
    """
    families = _names(last.family for last in lasts)
    if len(families) > 1:
        raise BadOption(_words("families", families))
    if len(families) == 0 or any(last.family is None for last in lasts):
        for by_name in (False, True):
            styles = _names(last.style for last in lasts if (last.size_from == BY_NAME) == by_name)
            if len(styles) > 1:
                raise BadOption(_words("styles", styles))
    systems = run_systems(lasts)
    if len(systems) > 1:
        words = f"the sizes are of several systems ({', '.join(systems)})"
        raise BadOption(f"{words}: check the lasts of each system by themselves")
    if rule is not None and rule.systems and systems and systems[0] not in rule.systems:
        words = f"the rule {rule.name!r} counts sizes of {', '.join(rule.systems)}"
        raise BadOption(f"{words}, not of {systems[0]}: change --rule, or the labels of the lasts")


def run_systems(lasts: Iterable[RunLast]) -> list[str]:
    """The names of the size systems that labels of lasts say, each once."""
    systems = (system_named(last.size_system) for last in lasts)
    return sorted({system.name for system in systems if system is not None})


def _names(names: Iterable[str | None]) -> list[str]:
    """Names that differ in more than their case, each once."""
    return sorted({name.casefold(): name for name in names if name}.values())


def _words(what: str, names: Sequence[str]) -> str:
    """What is wrong with lasts of several families or styles, and what to do."""
    words = f"the lasts are of {len(names)} {what} ({first_names(list(names), MOST_NAMED)})"
    hint = "name the lasts of one, or give all the same in --manifest"
    return f"{words}, and a run is one last in its sizes and widths: {hint}"
