"""The results of a run: the survivors, the share caught, and two files with all outcomes."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tools.mutants.draw import Mutant
from tools.mutants.trial import Outcome


@dataclass(frozen=True, slots=True)
class Equivalent:
    """A mutant that no test can notice, and why."""

    file: str
    function: str
    change: str
    reason: str

    def means(self, mutant: Mutant) -> bool:
        """Whether this is that mutant."""
        own = (mutant.path, mutant.mutation.scope, mutant.mutation.words)
        return own == (self.file, self.function, self.change)


def equivalents(path: Path) -> list[Equivalent]:
    """The listed mutants; a key too many or too few is an error."""
    with path.open("rb") as file:
        return [Equivalent(**known) for known in tomllib.load(file).get("mutant", [])]


def diff(root: Path, mutant: Mutant) -> str:
    """The changed lines as they were and as they became."""
    source = (root / mutant.path).read_text(encoding="utf-8")
    before, after = source.splitlines(), mutant.mutation.applied(source).splitlines()
    first = mutant.mutation.line - 1
    same = 0
    while same < min(len(before), len(after)) - first and before[-1 - same] == after[-1 - same]:
        same += 1
    old, new = before[first : len(before) - same], after[first : len(after) - same]
    return "\n".join([*(f"-{line}" for line in old), *(f"+{line}" for line in new)])


def line_of(outcome: Outcome) -> str:
    """One mutant on one line."""
    by = f" by {outcome.test}" if outcome.test else f" ({outcome.tests} tests)"
    return f"{outcome.word:<11} {outcome.mutant.name}{by}, {outcome.seconds:.0f} s"


def counts(outcomes: Sequence[Outcome]) -> str:
    """The result in a sentence."""
    caught = sum(outcome.word == "caught" for outcome in outcomes)
    share = 100.0 * caught / max(1, len(outcomes))
    return f"{caught} of {len(outcomes)} mutants caught ({share:.1f} %)"


def write(path: Path, root: Path, title: str, outcomes: Iterable[Outcome]) -> None:
    """``path``.json with every mutant, ``path``.md with the survivors."""
    every = list(outcomes)
    document = [
        {
            "file": outcome.mutant.path,
            "line": outcome.mutant.mutation.line,
            "function": outcome.mutant.mutation.scope,
            "operator": outcome.mutant.mutation.operator,
            "change": outcome.mutant.mutation.words,
            "outcome": outcome.word,
            "test": outcome.test,
            "tests": outcome.tests,
            "seconds": round(outcome.seconds, 1),
        }
        for outcome in every
    ]
    path.with_suffix(".json").write_text(json.dumps(document, indent=1), encoding="utf-8")
    lines = [f"# {title}", "", f"{counts(every)}.", ""]
    for outcome in every:
        if outcome.word != "caught":
            mutant, change = outcome.mutant, outcome.mutant.mutation
            lines += [f"## {mutant.path}:{change.line} {change.scope}", ""]
            lines += [f"{outcome.word}, {outcome.tests} tests: {change.words}", ""]
            lines += ["```diff", diff(root, mutant), "```", ""]
    path.with_suffix(".md").write_text("\n".join(lines), encoding="utf-8")
