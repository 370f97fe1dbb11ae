"""Whom a library of lasts serves: the answer of ``footfit coverage``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from footfit.results.population.served_feet import FootColumns, LastServes, NextLast
from footfit.results.values import Document, Json, Part, fields, rows

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats
    from footfit.results.fit import FitProfile
    from footfit.results.heel import HeelQuestion
    from footfit.results.population.shares import Distribution, Served, ServedBy, ServedZone
    from footfit.results.values import Notice
    from footfit.results.worn import Worn

FEET_FOR_A_SHARE = 100
"""With fewer feet an interval is so wide that a warning says it."""


@dataclass(frozen=True, slots=True)
class FailedFoot(Part):
    """A scan that could not be read or measured, with the code of the error."""

    id: str
    code: str
    message: str


@dataclass(frozen=True, slots=True)
class CoverStep(Part):
    """The existing lasts taken one after another, those first that serve most feet more.

    ``covered`` is the share of the judged feet that have an acceptable last then.
    """

    lasts: int
    last: str
    gain: int
    covered: float


@dataclass(frozen=True, slots=True)
class LastBox(Part):
    """Which feet a last is acceptable for in length and ball girth; for a picture.

    The ends are of the foot, in mm, NaN where the last has no such measure.
    """

    last: str
    length_mm: tuple[float, float]
    ball_girth_mm: tuple[float, float]
    flare_deg: float | None


@dataclass(frozen=True, slots=True)
class Coverage(Document):
    """The shares of feet that have a good or an acceptable last, and where they come from.

    ``judged`` feet count in every share. ``not_judged`` counts the others by the reason; a foot
    that lacks a measure which the profile requires is never passed. ``good_if_gone`` is how many
    feet would have a good last without the lasts that could go.
    """

    feet: FootColumns
    failed: tuple[FailedFoot, ...]
    judged: int
    not_judged: tuple[tuple[str, int], ...]
    lasts: int
    served: Served
    zones: tuple[ServedZone, ...]
    groups: tuple[ServedBy, ...]
    library: tuple[LastServes, ...]
    cover: tuple[CoverStep, ...]
    next_lasts: tuple[NextLast, ...]
    good_if_gone: int
    distributions: tuple[Distribution, ...]
    fit_profile: FitProfile
    heel: HeelQuestion
    worn: Worn
    size_system: str
    boxes: tuple[LastBox, ...]
    warnings: tuple[Notice, ...] = ()

    schema = "coverage/1"

    @property
    def count(self) -> int:
        """All feet that were given."""
        return len(self.feet.ids) + len(self.failed)

    @property
    def could_go(self) -> tuple[str, ...]:
        """The lasts that could all go together."""
        return tuple(last.last for last in self.library if last.could_go)

    def _keys(self) -> Json:
        skipped = ("feet", "served", "library", "not_judged", "boxes", "heel", "failed", "lasts")
        gone = {"lasts": list(self.could_go), "good_left": self.good_if_gone}
        model = self.heel.model
        return {
            "feet_given": self.count,
            "judged": self.judged,
            "not_judged": dict(self.not_judged),
            "failed": [each.to_dict() for each in self.failed],
            "lasts_considered": self.lasts,
            **self.served.to_dict(),
            **fields(self, *skipped, "judged", "good_if_gone"),
            "heel_model": None if model is None else model.model_id,
            "could_go": gone,
            "lasts": [last.to_dict() for last in self.library],
            "feet": self.feet.rows(),
        }

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the table of feet."""
        return self.feet.columns

    def rows(self) -> list[Json]:
        """The table of feet: a row for each, also for those that failed."""
        nothing = dict.fromkeys(self.feet.columns)
        failed = [
            nothing | {"id": foot.id, "status": "failed", "reason": f"{foot.code}: {foot.message}"}
            for foot in self.failed
        ]
        return [*self.feet.rows(), *failed]

    @property
    def of_lasts(self) -> LastsTable:
        """The table of lasts."""
        return LastsTable(self.library)


@dataclass(frozen=True, slots=True)
class LastsTable:
    """The lasts of a coverage as a table."""

    lasts: tuple[LastServes, ...]

    columns: ClassVar[tuple[str, ...]] = LastServes.columns

    def rows(self) -> list[Json]:
        """A row for each last."""
        return rows(
            self.columns, [tuple(row.values()) for last in self.lasts for row in last.rows()]
        )


def spread(values: Floats) -> tuple[float, float] | None:
    """The 5 and the 95 % of values; None without any."""
    import numpy as np

    known = values[np.isfinite(values)]
    if not len(known):
        return None
    low, high = np.percentile(known, (5.0, 95.0))
    return round(float(low), 3), round(float(high), 3)
