"""Which mutants to try: drawn by a seed over all modules, weighted by their lines of code."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tools.mutants.operators import Mutation, changes, code_lines, mutations


@dataclass(frozen=True, slots=True)
class Mutant:
    """One mutation of the module at ``path``, relative to the tree."""

    path: str
    mutation: Mutation

    @property
    def name(self) -> str:
        """Where it is and what it changes, on one line."""
        return f"{self.path}:{self.mutation.line} {self.mutation.scope}: {self.mutation.words}"


def drawn(root: Path, paths: Sequence[Path], seed: int, count: int) -> list[Mutant]:
    """``count`` mutants of the modules at ``paths``, fewer only where there are no more.

    A module is drawn by its share of the lines of code, then one of its lines that can be changed,
    then one change of that line; none is drawn twice.
    """
    sources = {path: path.read_text(encoding="utf-8") for path in sorted(paths)}
    lines = {path: _by_line(source) for path, source in sources.items()}
    weights = {path: code_lines(source) for path, source in sources.items() if lines[path]}
    generator = random.Random(seed)
    mutants: list[Mutant] = []
    while weights and len(mutants) < count:
        (path,) = generator.choices(list(weights), list(weights.values()))
        line = generator.choice(list(lines[path]))
        left = lines[path][line]
        mutation = left.pop(generator.randrange(len(left)))
        if changes(mutation, sources[path]):
            mutants.append(Mutant(str(path.relative_to(root)), mutation))
        if not left:
            del lines[path][line]
        if not lines[path]:
            del weights[path]
    return mutants


def _by_line(source: str) -> dict[int, list[Mutation]]:
    """The mutations of each line that has any."""
    lines: dict[int, list[Mutation]] = {}
    for mutation in mutations(source):
        lines.setdefault(mutation.line, []).append(mutation)
    return lines
