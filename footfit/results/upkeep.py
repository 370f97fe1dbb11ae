"""What checking, backing up and restoring a catalogue found and did."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.results.documents import Json, document, fields, part


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing in a catalogue that is not as it must be.

    ``last`` names the last it is about, if any. ``damage`` False: nothing is lost and a command
    mends it (an older profile); the message names the command.
    """

    code: str
    message: str
    last: str | None = None
    damage: bool = True

    def to_dict(self) -> Json:
        """Its fields."""
        return part(fields(self))


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What ``check-catalogue`` looked at, and what it found; nothing in a sound catalogue."""

    path: str
    lasts: int
    mesh_copies: int
    findings: tuple[Finding, ...]

    def to_dict(self) -> Json:
        """``footfit.check-catalogue/1``: everything that is not as it must be."""
        return document("check-catalogue", fields(self))


@dataclass(frozen=True, slots=True)
class BackupOutcome:
    """A verified copy: where it lies, its size and how many lasts it holds."""

    path: str
    backup: str
    bytes: int
    lasts: int

    def to_dict(self) -> Json:
        """``footfit.backup-catalogue/1``."""
        return document("backup-catalogue", fields(self))


@dataclass(frozen=True, slots=True)
class RestoreOutcome:
    """A catalogue as its backup had it; ``kept`` is where the one before lies, if there was one."""

    path: str
    backup: str
    lasts: int
    kept: str | None

    def to_dict(self) -> Json:
        """``footfit.restore-catalogue/1``."""
        return document("restore-catalogue", fields(self))
