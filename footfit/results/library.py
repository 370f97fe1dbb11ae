"""The lasts of a catalogue, and the outcomes of the commands that change, check or copy it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from footfit.errors import FootfitError
from footfit.geometry.fit.sizes import label_number
from footfit.locations import Location
from footfit.results.alignment import Reference
from footfit.results.last_record import LastRecord
from footfit.results.meshes import MeshInfo
from footfit.results.values import LABELS, Document, Json, Notice, Part, SideName, fields, part

NO_FEET = 0
"""How many feet a catalogue keeps: it has no table for any."""


@dataclass(frozen=True, slots=True)
class IngestOutcome(Document):
    """The outcome of one file: ``status`` is added, unchanged, replaced or refused.

    ``path`` is None for standard input. ``failure`` says why a file was refused. ``info``
    is the file's, if it was read. ``dry_run``: this would be the outcome; nothing was stored.
    ``new_catalogue`` is the path of the catalogue, if this ingest made it and this is its first
    outcome.
    """

    path: str | None
    status: str
    last: str | None = None
    side: SideName | None = None
    flare_angle_deg: float | None = None
    failure: FootfitError | None = None
    warnings: tuple[Notice, ...] = ()
    reference: bool = False
    info: MeshInfo | None = None
    dry_run: bool = False
    new_catalogue: str | None = None

    schema = "ingest-last/1"

    def _keys(self) -> Json:
        failure = self.failure
        failed = {
            "error": None if failure is None else failure.message,
            "code": None if failure is None else failure.code,
            "exit": 0 if failure is None else int(failure.exit),
        }
        return fields(self, "failure", "info") | failed


@dataclass(frozen=True, slots=True)
class CatalogueFacts(Document):
    """What ``catalogue-info`` says: where the file is and what it holds.

    ``kept`` is every table of the file with its number of rows. None is for feet or customers.
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

    schema = "catalogue-info/1"

    def _keys(self) -> Json:
        counts = ("definitions", "styles", "size_systems", "sides", "kept")
        copies = {
            "count": self.mesh_copies,
            "bytes": self.mesh_copy_bytes,
            "worst_error_mm": self.worst_copy_error_mm,
        }
        return {
            **fields(self, "mesh_copies", "mesh_copy_bytes", "worst_copy_error_mm"),
            **{name: dict(getattr(self, name)) for name in counts},
            "mesh_copies": part(copies),
            "feet_kept": NO_FEET,
        }


@dataclass(frozen=True, slots=True)
class UpgradeOutcome(Document):
    """What ``upgrade-catalogue`` did: the schema's revisions, and the lasts measured again.

    ``left`` names the lasts that could not be measured; ``warnings`` say why.
    """

    path: str
    revision_before: str
    revision_after: str
    definition: str
    recomputed: tuple[str, ...]
    backup: str | None
    left: tuple[str, ...] = ()
    warnings: tuple[Notice, ...] = ()

    schema = "upgrade-catalogue/1"


@dataclass(frozen=True, slots=True)
class DemoOutcome(Document):
    """Where the files of the demo are; the page is the last of ``outputs``."""

    folder: str
    lasts: int
    best: str | None
    outputs: tuple[str, ...]

    schema = "demo/1"

    def _keys(self) -> Json:
        return fields(self, "best") | {"best_last": self.best}


@dataclass(frozen=True, slots=True)
class ReferenceOutcome(Document):
    """The new reference last, and how many stored frames were rewritten for it."""

    reference: Reference
    rewritten: int

    schema = "set-reference/1"

    def _keys(self) -> Json:
        return fields(self.reference) | {"rewritten": self.rewritten}


@dataclass(frozen=True, slots=True)
class RenameOutcome(Document):
    """A last under its new name."""

    last: str
    renamed_from: str

    schema = "rename-last/1"


@dataclass(frozen=True, slots=True)
class RemoveOutcome(Document):
    """A last that was removed from the catalogue, and how many lasts are left in it."""

    last: str
    left: int = 0

    schema = "remove-last/1"

    def _keys(self) -> Json:
        return {"last": self.last, "status": "removed", "left": self.left}


@dataclass(frozen=True, slots=True)
class EditOutcome(Document):
    """A last with other labels: each that changed, with its value before and after.

    ``measured_again`` names the measures that its new stance changed. ``warnings`` say which labels
    the geometry contradicts.
    """

    last: str
    changes: tuple[tuple[str, str | float | None, str | float | None], ...]
    measured_again: tuple[str, ...]
    flare_angle_deg: float
    warnings: tuple[Notice, ...] = ()

    schema = "edit-last/1"

    @property
    def status(self) -> str:
        """Whether anything changed."""
        return "edited" if self.changes else "unchanged"

    def _keys(self) -> Json:
        changes = {name: {"before": old, "after": new} for name, old, new in self.changes}
        return fields(self) | {"status": self.status, "changes": changes}


@dataclass(frozen=True, slots=True)
class ExportOutcome(Document):
    """The file of a last; ``faces`` and ``error_mm`` are None for a record in JSON.

    ``error_mm`` is how far the written mesh lies from that of the file at most. ``sections`` and
    ``outlines`` are the files of its sections, if there are any.
    """

    last: str
    output: str
    faces: int | None = None
    error_mm: float | None = None
    sections: str | None = None
    outlines: str | None = None

    schema = "export-last/1"


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


@dataclass(frozen=True, slots=True)
class CopyOutcome(Document):
    """A catalogue copied into another one: how many lasts and entries of the fit log it holds."""

    path: str
    copy: str
    lasts: int
    fits: int

    schema = "copy-catalogue/1"


SORTS: Mapping[str, Callable[[LastRecord], float | str | None]] = {
    "name": lambda record: record.labels.name.casefold(),
    "size": lambda record: (label_number(record.labels.size) or (None,))[0],
    "length": lambda record: record.length_mm,
    "ball-girth": lambda record: record.value_of("ball_girth"),
    "flare": lambda record: record.flare.angle_deg,
    "heel": lambda record: record.heel_height_mm,
}
"""What a list of lasts is sorted by: the least comes first."""


def _none_last(value: float | str | None) -> tuple[bool, Any]:
    unknown = value is None or value != value  # a NaN is unknown too
    return unknown, 0.0 if unknown else value


@dataclass(frozen=True, slots=True)
class Library(Document):
    """The lasts to choose from, and the state of their catalogue.

    ``sort`` names the order in which they are listed, one of `SORTS`. ``filters`` are the labels
    that they were chosen by. ``file`` is the catalogue that their sections are read from, None if
    there is none. ``out_of_stock`` are lasts that a shop does not have; they are not in ``lasts``.
    ``rated`` counts the shoes that wearers rated, by the name of the fit profile.
    """

    lasts: tuple[LastRecord, ...]
    total: int
    reference: str | None
    rejected: tuple[tuple[str, int], ...] = ()
    warnings: tuple[Notice, ...] = ()
    file: Location | None = None
    sort: str = "name"
    filters: tuple[tuple[str, str], ...] = ()
    out_of_stock: tuple[LastRecord, ...] = ()
    rated: tuple[tuple[str, int], ...] = ()

    columns = (
        *("last", *LABELS, "heel_height_mm", "family", "parent", "side"),
        *("length_mm", "flare_angle_deg", "class", "reference"),
        *("size_by_length", "label_flagged", "ball_girth_mm", "warnings"),
    )

    def ordered(self) -> list[LastRecord]:
        """The lasts in the order that is asked for; those without the value come last."""
        by_name = sorted(self.lasts, key=lambda record: record.labels.name)
        value = SORTS[self.sort]
        return sorted(by_name, key=lambda record: _none_last(value(record)))

    schema = "list-lasts/2"

    def _keys(self) -> Json:
        return {"reference": self.reference, "lasts": self._entries()}

    def _entries(self) -> list[Json]:
        """A line for each last: what it is, and what should be known of it."""
        return [
            record.entry(self.reference)
            | part({"ball_girth_mm": record.value_of("ball_girth"), "warnings": record.notices})
            for record in self.ordered()
        ]

    def rows(self) -> list[Json]:
        """A table: a row for each last, with its label's check and the codes of its warnings."""
        entries = self._entries()
        for entry in entries:
            entry["warnings"] = " ".join(notice["code"] for notice in entry["warnings"]) or None
            check = entry["label_check"] or {}
            entry["size_by_length"] = check.get("size_by_length")
            entry["label_flagged"] = check.get("flagged")
        return [{column: entry[column] for column in self.columns} for entry in entries]
