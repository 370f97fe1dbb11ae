"""One customer's answer: the lasts ranked, each with its reasons."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING

from footfit.geometry.fit.sizes import SYSTEMS, foot_size, foot_sizes, system_named
from footfit.results.fit import ZONE_ENDS
from footfit.results.heel import AS_SCANNED, FLARE, HeelChange, HeelQuestion
from footfit.results.profile import flare_part
from footfit.results.values import (
    FIT_NAMES,
    LABELS,
    NOT_YET,
    VERDICTS,
    Document,
    Json,
    Part,
    fields,
    measured_part,
    measures_part,
    part,
    rows,
)
from footfit.results.worn import BAREFOOT, Worn

if TYPE_CHECKING:
    from footfit.results.compare import SurfaceClearance, TightPlace
    from footfit.results.evidence.child_growth import Growth
    from footfit.results.fit import FitProfile, FootFit
    from footfit.results.last_record import LastRecord
    from footfit.results.profile import Profiled
    from footfit.results.values import Measured, Notice, SearchBy, SideName, Verdict
    from footfit.results.width import FootWidth

CANDIDATE_COLUMNS = (
    *("rank", "last", *LABELS),
    *("side", "mirrored", "distance", "distance_sd"),
)
HEEL_COLUMNS = (
    *("drop_mm", "scanned_at_drop_mm", "heel_model"),
    *(f"heel_change_{name}_mm" for name in FIT_NAMES),
    "heel_change_flare_deg",
)

FOOT_COLUMNS = ("status", "foot_length_mm", "foot_size", "customer_size", "error", "customer")
DEFAULT_SYSTEM = "eu"


def _zone_columns(name: str) -> tuple[str, ...]:
    """The columns of one zone; clearances of FIT_NAMES have theirs already."""
    end = ZONE_ENDS[name]
    ends = () if name in FIT_NAMES else (end, f"_sd{end}", f"_total_sd{end}")
    taken = (f"clearance_{name}{each}" for each in ends)
    return *taken, f"verdict_{name}", f"not_counted_{name}"


ZONE_COLUMNS = tuple(column for name in ZONE_ENDS for column in _zone_columns(name))


@dataclass(frozen=True, slots=True)
class FlareDifference(Part):
    """The profile distance D and the flare angle's difference, last minus foot."""

    distance: float
    delta_deg: float
    parts: tuple[tuple[str, float], ...]

    def _keys(self) -> Json:
        return fields(self) | {"parts": part(dict(self.parts))}


@dataclass(frozen=True, slots=True)
class Candidate(Part):
    """One last of the answer. ``surfaces`` has an entry for each foot, or none if nobody asked.

    ``size_asked`` is its label in the size system that was asked for, None if it is in that system.
    """

    rank: int
    last: str
    style: str | None
    size: str | None
    size_system: str | None
    width_label: str | None
    side: SideName | None
    mirrored: bool
    distance: float
    flare: FlareDifference
    clearance_mm: tuple[tuple[str, Measured], ...]
    verdict: str | None
    why: str
    tied_with: tuple[str, ...]
    record: LastRecord
    distance_sd: float | None = None
    fits: tuple[FootFit, ...] = ()
    not_judged: tuple[str, ...] = ()
    surfaces: tuple[SurfaceClearance, ...] = ()
    size_asked: str | None = None

    @property
    def tightest(self) -> TightPlace | None:
        """The tightest place of the feet, if their surfaces were compared with the last's."""
        if not self.surfaces:
            return None
        from footfit.results.compare import tightest_place

        return tightest_place(
            [(surface.side, surface.zones) for surface in self.surfaces],
            [(fit.side, fit.toe_box) for fit in self.fits],
        )

    def _keys(self) -> Json:
        keys = fields(self, "record", "surfaces")
        clearance, room = measured_part(self.clearance_mm), self.surfaces or None
        return keys | {
            "clearance_mm": clearance,
            "surface_clearance": room,
            "tightest": self.tightest,
        }


FOUNDED = {
    "A": "its range was measured with wearers who judged comfort",
    "M": "its range was measured on feet or lasts",
    "B": "its range is a trade rule",
    "C": "its range is an opinion",
}
"""How well a range is founded, as a sentence says it."""


@dataclass(frozen=True, slots=True)
class NotInStock(Part):
    """The best last that the shop does not have, its verdict, and whether it would stand before
    the first one that the shop has.
    """

    last: str
    verdict: Verdict
    better: bool

    @property
    def words(self) -> str:
        """The same in a sentence."""
        than = "better than" if self.better else "no better than"
        last = f"{self.last} ({self.verdict})"
        return f"the best last that is not in stock is {last}: {than} what is in stock"


@dataclass(frozen=True, slots=True)
class Match(Document):
    """One customer's answer: one foot, or two with ``--pair``.

    ``nearest`` are the lasts that come nearest if none fits. ``size_system`` is the one that was
    asked for. ``best_verdict`` is the verdict of the first last; None if that was not judged in
    every required zone, if there is none, or by shape. ``customer`` is the customer's name, if
    somebody gives it.
    """

    feet: tuple[Profiled, ...]
    by: SearchBy
    profile: str
    catalogue_lasts: int
    reference: str | None
    candidates: tuple[Candidate, ...]
    rejected: tuple[tuple[str, int], ...]
    warnings: tuple[Notice, ...]
    fit_profile: FitProfile | None = None
    nearest: tuple[Candidate, ...] = ()
    size_system: str | None = None
    best_verdict: Verdict | None = None
    heel: HeelQuestion = AS_SCANNED
    widths: tuple[FootWidth, ...] = ()
    customer: str | None = None
    worn: Worn = BAREFOOT
    not_in_stock: NotInStock | None = None
    growth: Growth | None = None
    rated: int = 0

    @property
    def founded(self) -> str | None:
        """How well founded the verdict of the first last is, in one sentence; None by shape."""
        if not self.candidates or not self.candidates[0].fits:
            return None
        judged = [
            zone
            for fit in self.candidates[0].fits
            for zone in fit.zones
            if zone.counts and zone.verdict is not None and zone.score is not None
        ]
        if not judged:
            return None
        decided = max(
            judged, key=lambda z: (VERDICTS.index(z.verdict or "good"), abs(z.score or 0.0))
        )
        words = f"The verdict rests most on the {decided.label}: {FOUNDED[decided.grade]}"
        if not self.rated:
            return words
        shoes = "1 shoe" if self.rated == 1 else f"{self.rated} shoes"
        return f"{words}; wearers here rated {shoes} of this profile"

    @property
    def customer_length_mm(self) -> float | None:
        """The length that the customer's one size is taken from: of two feet the longer's."""
        lengths = [foot.length_mm for foot in self.feet]
        known = [mm for mm in lengths if mm is not None]
        return max(known) if len(known) == len(lengths) else None

    @property
    def customer_size(self) -> str | None:
        """The customer's one size in words, in the system that was asked for."""
        return self._size_of(self.customer_length_mm)

    def _size_of(self, length_mm: float | None) -> str | None:
        system = system_named(self.size_system) or SYSTEMS[DEFAULT_SYSTEM]
        return None if length_mm is None else foot_size(length_mm, system).words

    columns = (
        *("path", "foot_side", "by", *CANDIDATE_COLUMNS, "flare_distance", "flare_delta_deg"),
        *(
            f"clearance_{name}_{end}"
            for name in FIT_NAMES
            for end in ("mm", "sd_mm", "total_sd_mm")
        ),
        *("foot_verdict", "verdict", "why", "tied_with", "not_judged"),
        *("profile", "profile_sha256", *HEEL_COLUMNS, *FOOT_COLUMNS, "size_asked", *ZONE_COLUMNS),
    )

    schema = "match/2"

    def _keys(self) -> Json:
        count = sum(count for _, count in self.rejected)
        return {
            **fields(self, "catalogue_lasts", "reference", "heel", "widths"),
            "heel_model": self.heel.model,
            "feet": [
                foot_part(foot) | {"width": width.to_dict() if width else None}
                for foot, width in zip_longest(self.feet, self.widths)
            ],
            "sizes": _sizes_part(self.customer_length_mm),
            "founded": self.founded,
            "catalogue": {"lasts": self.catalogue_lasts, "reference": self.reference},
            "rejected": {"count": count, "by_reason": dict(self.rejected)},
        }

    def rows(self) -> list[Json]:
        """A table: a row for each candidate and foot; one for each foot if no last fits."""
        feet = range(len(self.feet))
        if not self.candidates:
            return rows(self.columns, [self._empty_row(foot) for foot in feet])
        return rows(self.columns, [self._row(foot, c) for foot in feet for c in self.candidates])

    def _foot_cells(self, foot: int, status: str) -> tuple[object, ...]:
        """What is said of a foot in each of its rows, as `FOOT_COLUMNS` name it."""
        own = self.feet[foot].length_mm
        return status, own, self._size_of(own), self.customer_size, None, self.customer

    def _empty_row(self, foot: int) -> tuple[object, ...]:
        """The row of a foot that no last fits."""
        alignment, left_out = self.feet[foot].aligned.alignment, dict(self.rejected)
        counts = (f"{count} {reason}" for reason, count in left_out.items())
        known = {
            "path": alignment.info.path,
            "foot_side": alignment.side.side,
            "by": self.by,
            "why": f"no last fits: left out are {', '.join(counts) or 'none'}",
            "profile": self.profile,
            "profile_sha256": None if self.fit_profile is None else self.fit_profile.sha256,
            **dict(zip(FOOT_COLUMNS, self._foot_cells(foot, "no_last_fits"), strict=True)),
        }
        return tuple(known.get(column) for column in self.columns)

    def _row(self, foot: int, candidate: Candidate) -> tuple[object, ...]:
        alignment = self.feet[foot].aligned.alignment
        fit = candidate.fits[foot] if candidate.fits else None
        clearance = dict(candidate.clearance_mm)
        if fit is not None:
            clearance = {zone.zone: zone.clearance for zone in fit.zones if zone.unit == "mm"}
        room = [clearance.get(name, NOT_YET) for name in FIT_NAMES]
        return (
            alignment.info.path,
            alignment.side.side,
            self.by,
            *(getattr(candidate, name) for name in CANDIDATE_COLUMNS),
            candidate.flare.distance,
            candidate.flare.delta_deg,
            *(end for each in room for end in (each.value, each.sd, each.total_sd)),
            None if fit is None else fit.verdict,
            candidate.verdict,
            candidate.why,
            " ".join(candidate.tied_with),
            " ".join(candidate.not_judged),
            self.profile,
            None if self.fit_profile is None else self.fit_profile.sha256,
            *heel_cells(None if fit is None else fit.heel),
            *self._foot_cells(foot, "ranked"),
            candidate.size_asked,
            *(cell for name in ZONE_ENDS for cell in zone_cells(fit, name)),
        )


@dataclass(frozen=True, slots=True)
class FailedMatch:
    """The feet of a customer whose match failed, in the table of the matches."""

    paths: tuple[str | None, ...]
    code: str
    message: str
    customer: str | None = None

    columns = Match.columns

    def rows(self) -> list[Json]:
        """A row for each foot, with the code of the error and its sentence."""
        known: Json = {"status": "failed", "error": self.code, "why": self.message}
        known["customer"] = self.customer
        cells = [known | {"path": path} for path in self.paths]
        return rows(self.columns, [tuple(row.get(c) for c in self.columns) for row in cells])


def zone_cells(fit: FootFit | None, name: str) -> tuple[object, ...]:
    """What is said of one foot in one zone, as `ZONE_COLUMNS` name it."""
    zone = None if fit is None else next((z for z in fit.zones if z.zone == name), None)
    if zone is None:
        return (None,) * len(_zone_columns(name))
    known = zone.clearance.to_dict()  # with the decimals that JSON has
    taken = () if name in FIT_NAMES else (known["value"], known["sd"], known["total_sd"])
    return *taken, zone.verdict, zone.not_counted or zone.clearance.reason


def heel_cells(heel: HeelChange | None) -> tuple[object, ...]:
    """What the heel of a last changes of a foot, as `HEEL_COLUMNS` name it."""
    if heel is None:
        return (None,) * len(HEEL_COLUMNS)
    changes = [heel.change_of(name) for name in (*FIT_NAMES, FLARE)]
    values = (None if known is None else known.value for known in changes)
    return heel.drop_mm, heel.scanned_at_drop_mm, heel.model, *values


def foot_part(foot: Profiled) -> Json:
    """One foot of a match."""
    alignment = foot.aligned.alignment
    return part(
        {
            **alignment.scan_keys(),
            "measures": measures_part(foot.measures),
            "sizes": _sizes_part(foot.length_mm),
            "flare": flare_part(foot.flare),
        }
    )


def _sizes_part(length_mm: float | None) -> Json:
    """A foot's size in every system, null if its length is not known."""
    if length_mm is None:
        return dict.fromkeys(SYSTEMS)
    return {size.system: part(fields(size, "system")) for size in foot_sizes(length_mm)}
