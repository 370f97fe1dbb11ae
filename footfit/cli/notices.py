"""What a command says of its files on stderr: the rules for notices, each written once.

- A notice begins with the path that it speaks of.
- Plain files in millimetres are not announced. Another unit is; in a batch the files are counted,
  and one line at the end names those in another unit.
- What the table on stdout says itself is not said on stderr too.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from footfit.cli.console import say, say_notices
from footfit.meshes.units import UNIT_NAMES
from footfit.number_words import first_names
from footfit.results.values import notices_about

if TYPE_CHECKING:
    from footfit.cli.options import OutputMode
    from footfit.results import MeshInfo

PLAIN_UNIT = "mm"
NAMED_FILES = 10
"""So many files of one unit are named at the end of a batch."""


@dataclass(slots=True)
class UnitCount:
    """The files of a batch by the unit that footfit took them in; what was declared is left out."""

    paths: dict[str, list[str]] = field(default_factory=dict)

    def add(self, infos: Iterable[MeshInfo]) -> None:
        """Count files."""
        for info in infos:
            if info.units_source == "detected":
                self.paths.setdefault(info.units, []).append(info.path or "-")

    def words(self) -> str | None:
        """One line about the files in an unusual unit; None if there are none.

        Examples
        --------
        >>> UnitCount({"mm": ["a.stl"], "in": ["b.stl", "c.stl"]}).words()
        '1 of 3 taken as millimetres; 2 as inches: b.stl, c.stl (--units changes this)'
        >>> UnitCount({"m": ["a.stl", "b.stl"]}).words()
        '2 of 2 taken as metres (--units changes this)'
        >>> UnitCount({"mm": ["a.stl"]}).words()
        """
        if not self.paths.keys() - {PLAIN_UNIT}:
            return None
        units = sorted(self.paths, key=lambda unit: (unit != PLAIN_UNIT, -len(self.paths[unit])))
        total = sum(map(len, self.paths.values()))
        parts = [f"{len(self.paths[unit])} as {UNIT_NAMES[unit]}" for unit in units]
        parts[0] = parts[0].replace(" as ", f" of {total} taken as ", 1)
        if len(units) > 1:
            parts = [
                part
                if unit == PLAIN_UNIT
                else f"{part}: {first_names(self.paths[unit], NAMED_FILES)}"
                for unit, part in zip(units, parts, strict=True)
            ]
        return f"{'; '.join(parts)} (--units changes this)"


@dataclass(slots=True)
class Notices:
    """Says the notices of a command's results."""

    mode: OutputMode
    units: UnitCount = field(default_factory=UnitCount)
    said: set[tuple[str | None, str]] = field(default_factory=set)

    def say(self, value: Any) -> None:
        """Write the notices of a result to stderr; in a batch, none twice."""
        from footfit.cli.answer_forms import form_of

        form, mode = form_of(value), self.mode
        path, notices = form.notices(value)
        skipped = form.in_table if mode.answers and not mode.json else frozenset()
        if mode.total > 1:
            self.units.add(form.infos(value))
            skipped |= {"units_detected"}
        for notice in notices_about(path, notices):
            line = (notice.path, notice.message)
            if notice.code not in skipped and line not in self.said:
                self.said.add(line)
                say_notices((notice,), path, quiet=mode.quiet)

    def close(self) -> None:
        """Say what was counted in a batch."""
        words = self.units.words()
        if words is not None:
            say(words, quiet=self.mode.quiet)
