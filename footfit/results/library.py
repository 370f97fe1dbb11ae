"""What became of the catalogue as a whole: ingest, facts, upgrade, demo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.results.last_record import LastRecord
    from footfit.results.values import Notice, SideName


@dataclass(frozen=True, slots=True)
class IngestOutcome:
    """What became of one file: ``status`` is added, unchanged, replaced or refused.

    ``path`` is None for standard input. ``notes`` are told to people, and warn of nothing.
    ``dry_run``: it is what would become of it, nothing was stored.
    """

    path: str | None
    status: str
    last: str | None
    side: SideName | None
    flare_angle_deg: float | None
    error: str | None
    exit: int
    code: str | None
    warnings: tuple[Notice, ...] = ()
    reference: bool = False
    notes: tuple[Notice, ...] = ()
    dry_run: bool = False


@dataclass(frozen=True, slots=True)
class CatalogueFacts:
    """What ``catalogue-info`` says: where the file is, what it holds, what it keeps of whom.

    ``kept`` is every table of the file with its rows: there is none for feet or customers.
    """

    path: str
    bytes: int
    lasts: int
    reference: str | None
    schema_revision: str
    definitions: tuple[tuple[str, int], ...]
    styles: tuple[tuple[str, int], ...]
    size_systems: tuple[tuple[str, int], ...]
    sides: tuple[tuple[str, int], ...]
    mesh_copies: int
    mesh_copy_bytes: int
    worst_copy_error_mm: float | None
    kept: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class UpgradeOutcome:
    """What ``upgrade-catalogue`` did: the schema's revisions and the profiles re-computed."""

    path: str
    revision_before: str
    revision_after: str
    definition: str
    recomputed: tuple[str, ...]
    backup: str | None


@dataclass(frozen=True, slots=True)
class DemoOutcome:
    """Where the demo's files lie; the report is the last of ``outputs``."""

    folder: str
    lasts: int
    best: str | None
    outputs: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Library:
    """The lasts to choose from, and what the catalogue says of itself."""

    lasts: tuple[LastRecord, ...]
    total: int
    reference: str | None
    rejected: tuple[tuple[str, int], ...] = ()
    warnings: tuple[Notice, ...] = ()
