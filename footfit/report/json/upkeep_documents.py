"""Answers about the catalogue file as JSON documents: checked, backed up, restored."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.json.lines import Json, document

if TYPE_CHECKING:
    from footfit.results import BackupOutcome, CheckOutcome, RestoreOutcome


def check_catalogue_document(outcome: CheckOutcome) -> Json:
    """``footfit.check-catalogue/1``: everything that is not as it must be."""
    return document(
        "check-catalogue",
        {
            "path": outcome.path,
            "lasts": outcome.lasts,
            "mesh_copies": outcome.mesh_copies,
            "findings": [
                {
                    "code": finding.code,
                    "message": finding.message,
                    "last": finding.last,
                    "damage": finding.damage,
                }
                for finding in outcome.findings
            ],
        },
    )


def backup_catalogue_document(outcome: BackupOutcome) -> Json:
    """``footfit.backup-catalogue/1``: the copy, verified."""
    return document(
        "backup-catalogue",
        {
            "path": outcome.path,
            "backup": outcome.backup,
            "bytes": outcome.bytes,
            "lasts": outcome.lasts,
        },
    )


def restore_catalogue_document(outcome: RestoreOutcome) -> Json:
    """``footfit.restore-catalogue/1``: what is there now, and where the one before lies."""
    return document(
        "restore-catalogue",
        {
            "path": outcome.path,
            "backup": outcome.backup,
            "lasts": outcome.lasts,
            "kept": outcome.kept,
        },
    )
