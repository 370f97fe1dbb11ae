"""How wide a customer's foot is, beside its size and among other people."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.results.values import Json, Part, fields, part

if TYPE_CHECKING:
    from footfit.geometry.fit.width_fitting import Fitting


@dataclass(frozen=True, slots=True)
class WidthShare(Part):
    """The ``percent`` of a survey's ``people`` who, with feet of the same length, have a smaller
    ball girth.

    ``percent_sd`` is what the standard deviation of the foot's girth makes of it. Without a percent
    there is a ``reason``.
    """

    people: str
    percent: float | None
    percent_sd: float | None
    reason: str | None = None

    not_written = ("people",)


@dataclass(frozen=True, slots=True)
class FootWidth(Part):
    """The width of one foot: ``fittings`` at the customer's size, ``shares`` among people."""

    fittings: tuple[Fitting, ...]
    shares: tuple[WidthShare, ...]

    def fitting(self, system: str) -> Fitting | None:
        """The fitting in a system; None where there is none."""
        return next((known for known in self.fittings if known.system == system), None)

    def to_dict(self) -> Json:
        """Fittings by system, and shares by people."""
        return {
            "fittings": {known.system: part(fields(known, "system")) for known in self.fittings},
            "wider_than": part({share.people: share for share in self.shares}),
        }
