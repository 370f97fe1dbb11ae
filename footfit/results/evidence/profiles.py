"""Fit profiles as answers: the list of them, and one with its sources."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from footfit.results.fit import GRADES, FitProfile
from footfit.results.values import Document, Json


@dataclass(frozen=True, slots=True)
class ProfileList(Document):
    """The fit profiles that come with footfit."""

    profiles: tuple[FitProfile, ...]

    schema = "list-profiles/1"

    def _keys(self) -> Json:
        names = ("name", "version", "summary", "sha256")
        return {"profiles": [{n: getattr(p, n) for n in names} for p in self.profiles]}


@dataclass(frozen=True, slots=True)
class ShownProfile(Document):
    """One fit profile with the sources and grades of its ranges.

    ``path`` is that of a file of the user's; None for a shipped profile. ``units`` are the zones'.
    """

    profile: FitProfile
    units: Mapping[str, str]
    path: str | None = None

    schema = "show-profile/1"

    def _keys(self) -> Json:
        return {
            "path": self.path,
            "grades": dict(GRADES),
            "units": dict(self.units),
            "profile": self.profile.to_dict(),
        }


@dataclass(frozen=True, slots=True)
class CheckedProfile(Document):
    """A file that is a sound fit profile; ``without_source`` are the zones that name no source."""

    path: str
    name: str
    version: int
    sha256: str
    zones: tuple[str, ...]
    without_source: tuple[str, ...]

    schema = "check-profile/1"
