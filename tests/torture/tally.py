"""What a row of trials found."""

from __future__ import annotations

from dataclasses import dataclass, field


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
