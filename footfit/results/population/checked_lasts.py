"""What is wrong among the lasts of a catalogue: twins, labels, runs that break."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from footfit.results.values import Document, Json, Notice, Part, count_notice, part, rows

LastCode = Literal[
    "twin",
    "near_twin",
    "size_contradicted",
    "width_contradicted",
    "heel_contradicted",
    "side_contradicted",
    "side_doubtful",
    "looks_like_a_foot",
    "off_in_family",
    "jump_in_family",
]
NO_FAULT = frozenset({"near_twin", "side_doubtful"})
"""Codes that are worth a look, and no fault."""


@dataclass(frozen=True, slots=True)
class LastFinding(Part):
    """One thing about a last, with the reason in words.

    ``other`` is the last that it is compared with, ``family`` the group that it is in. The measure
    in which the two differ most, or that breaks, is off by ``off_mm``; ``tolerance_mm`` is allowed.
    """

    code: LastCode
    last: str
    message: str
    other: str | None = None
    family: str | None = None
    measure: str | None = None
    off_mm: float | None = None
    tolerance_mm: float | None = None

    @property
    def fault(self) -> bool:
        """Whether something is wrong, and not only worth a look."""
        return self.code not in NO_FAULT

    def _keys(self) -> Json:
        names = ("code", "last", "message", "other", "family", "measure", "off_mm", "tolerance_mm")
        return {name: getattr(self, name) for name in names} | {"fault": self.fault}


@dataclass(frozen=True, slots=True)
class LastsCheck(Document):
    """The findings of ``check-lasts`` about all lasts of a catalogue.

    ``families`` counts the families and styles whose runs were checked; ``not_checked`` are the
    others, each with the reason. ``not_compared`` lasts lack a measure that twins are found by.
    """

    path: str
    lasts: int
    families: int
    findings: tuple[LastFinding, ...]
    tolerance_mm: Mapping[str, float]
    not_checked: tuple[tuple[str, str], ...] = ()
    not_compared: int = 0
    warnings: tuple[Notice, ...] = ()

    schema = "check-lasts/1"
    columns = (
        *("code", "last", "message", "other", "family"),
        *("measure", "off_mm", "tolerance_mm", "fault"),
    )

    @property
    def faults(self) -> tuple[LastFinding, ...]:
        """The findings that are faults."""
        return tuple(finding for finding in self.findings if finding.fault)

    @property
    def notices(self) -> tuple[Notice, ...]:
        """What should be known beside the findings."""
        words = "lasts lack a length, a ball girth or a width: they are compared with no other last"
        return (*self.warnings, *count_notice("not_compared", self.not_compared, words))

    def _keys(self) -> Json:
        return {
            "path": self.path,
            "lasts": self.lasts,
            "families": self.families,
            "findings": [finding.to_dict() for finding in self.findings],
            "tolerance_mm": part(self.tolerance_mm),
            "not_checked": dict(self.not_checked),
            "not_compared": self.not_compared,
            "warnings": self.notices,
        }

    def rows(self) -> list[Json]:
        """A table: a row for each finding."""
        parts = [finding.to_dict() for finding in self.findings]
        return rows(self.columns, [[each[name] for name in self.columns] for each in parts])
