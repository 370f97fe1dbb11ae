"""One customer's answer: the lasts ranked, each with its reasons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.results.compare import SurfaceRoom
    from footfit.results.fit import FitProfile, FootFit
    from footfit.results.last_record import LastRecord
    from footfit.results.profile import Profiled
    from footfit.results.values import Measured, Notice, SearchBy, SideName, Verdict


@dataclass(frozen=True, slots=True)
class FlareDifference:
    """The profile distance D and the flare angle's difference, last minus foot."""

    distance: float
    delta_deg: float
    parts: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Candidate:
    """One last of the answer. ``surfaces`` is of each foot, and empty where nobody asked."""

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
    surfaces: tuple[SurfaceRoom, ...] = ()


@dataclass(frozen=True, slots=True)
class Match:
    """One customer's answer: one foot, or two with ``--pair``.

    ``nearest`` are the lasts that come nearest where none fits. ``size_system`` is the one that
    was asked for. ``best_verdict`` is over every ranked last, shown or not, that was judged in
    every required zone; None by shape, and where there is none.
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
