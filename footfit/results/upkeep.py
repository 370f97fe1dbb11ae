"""What checking, backing up and restoring a catalogue found and did."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.results.values import Document, Part


@dataclass(frozen=True, slots=True)
class Finding(Part):
    """One thing in a catalogue that is not as it must be.

    ``last`` names the last it is about, if any. ``damage`` False: nothing is lost and a command
    mends it (an older profile); the message names the command.
    """

    code: str
    message: str
    last: str | None = None
    damage: bool = True


@dataclass(frozen=True, slots=True)
class CheckOutcome(Document):
    """What ``check-catalogue`` looked at, and what it found; nothing in a sound catalogue."""

    path: str
    lasts: int
    mesh_copies: int
    findings: tuple[Finding, ...]

    schema = "check-catalogue/1"


@dataclass(frozen=True, slots=True)
class BackupOutcome(Document):
    """A verified copy: where it lies, its size and how many lasts it holds."""

    path: str
    backup: str
    bytes: int
    lasts: int

    schema = "backup-catalogue/1"


@dataclass(frozen=True, slots=True)
class RestoreOutcome(Document):
    """A catalogue as its backup had it; ``kept`` is where the one before lies, if there was one."""

    path: str
    backup: str
    lasts: int
    kept: str | None

    schema = "restore-catalogue/1"
