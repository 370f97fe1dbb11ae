"""What a row of trials found."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Tally:
    """Trials of one promise: how many, in how many the fault struck, and every breach in words.

    ``struck`` counts the trials in which the fault met unfinished work, so that a row of trials
    that shows nothing is seen to show nothing. ``facts`` are said beside the figure.
    """

    promise: str
    trials: int = 0
    struck: int = 0
    bad: list[str] = field(default_factory=list)
    facts: dict[str, float | int | str] = field(default_factory=dict)

    def breach(self, words: str) -> None:
        """Note a broken promise."""
        self.bad.append(words)

    def row(self) -> str:
        """One line of the table."""
        said = ", ".join(f"{name} {value}" for name, value in self.facts.items())
        return f"| {self.promise} | {self.trials} | {self.struck} | {len(self.bad)} | {said} |"


def memory() -> Path | None:
    """A folder in memory: no trial here needs a disk to be slow. None where there is none."""
    place = Path("/dev/shm")
    return place if place.is_dir() and os.access(place, os.W_OK) else None
