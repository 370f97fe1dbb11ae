"""The outcomes of checking, backing up and restoring a catalogue."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.results.values import Document, Part


@dataclass(frozen=True, slots=True)
class Finding(Part):
    """One fault in a catalogue.

    ``last`` names the last it is about, if any. ``damage`` is False if nothing is lost and a
    command repairs it, such as an older profile; the message names the command.
    """

    code: str
    message: str
    last: str | None = None
    damage: bool = True


@dataclass(frozen=True, slots=True)
class CheckOutcome(Document):
    """What ``check-catalogue`` looked at, and its findings; an intact catalogue has none."""

    path: str
    lasts: int
    mesh_copies: int
    findings: tuple[Finding, ...]

    schema = "check-catalogue/1"


@dataclass(frozen=True, slots=True)
class BackupOutcome(Document):
    """A checked copy: where it is, its size, and how many lasts it holds."""

    path: str
    backup: str
    bytes: int
    lasts: int

    schema = "backup-catalogue/1"


@dataclass(frozen=True, slots=True)
class RestoreOutcome(Document):
    """A restored catalogue; ``kept`` is where the old file is, if there was one."""

    path: str
    backup: str
    lasts: int
    kept: str | None

    schema = "restore-catalogue/1"
