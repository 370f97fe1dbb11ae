"""How long a child's shoe will last, with the grounds of that."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from footfit.number_words import plain
from footfit.results.values import Part

Sex = Literal["female", "male"]


@dataclass(frozen=True, slots=True)
class GrowthQuestion:
    """That growth is asked for, and what is known of the child: age in years, and sex."""

    age_years: float | None = None
    sex: Sex | None = None


@dataclass(frozen=True, slots=True)
class Growth(Part):
    """For how many months the room of a shoe will do.

    ``room_mm`` is the toe room of the last ``last``, of which ``kept_mm`` must stay; what is worn
    and how the foot was loaded count there. ``months`` is
    the range from one standard deviation below to one above, with an open end where the foot may
    have stopped to grow; None if feet of this age hardly grow.
    ``check_months`` is when to measure again. ``age_years`` is the range of ages that was taken,
    and ``grounds`` says from what. ``rate_mm_per_month`` is the range of growth.
    """

    last: str
    room_mm: float
    kept_mm: float
    months: tuple[float, float | None] | None
    check_months: float | None
    rate_mm_per_month: tuple[float, float]
    age_years: tuple[float, float]
    sex: Sex | None
    grounds: str

    @property
    def words(self) -> str:
        """One sentence for people."""
        start = f"{self.last} has {plain(self.room_mm)} mm of room"
        stays = f"{start}, of which {plain(self.kept_mm)} mm must stay"
        if self.months is None:
            return f"{start}; feet of this age hardly grow any more"
        low, most = round(self.months[0]), self.months[1]
        high = None if most is None else round(most)
        if high is not None and high <= 0:
            return (
                f"{start}: that leaves none to grow; a child's shoe needs {plain(self.kept_mm)} mm"
            )
        many = f"{low} to {high} months" if high != low else f"about {high} months"
        if high is None:
            many = f"{low} {'month' if low == 1 else 'months'} or more"
        again = max(round(self.check_months or 0.0), 1)
        noun = "month" if again == 1 else "months"
        return f"{stays}: it will do for {many}, by {self.grounds}; measure again in {again} {noun}"
