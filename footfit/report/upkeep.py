"""Answers about the catalogue file: checked, backed up, restored; as documents and renderables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from footfit.report.lines import Json, document
from footfit.report.tables import cell, facts, lined_table
from footfit.report.text import plain, visible

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import BackupOutcome, CheckOutcome, RestoreOutcome

MEGABYTE = 1_000_000


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


def check_catalogue_table(outcome: CheckOutcome) -> RenderableType:
    """One line per finding under what was checked."""
    line = Text("checked  ").append(visible(outcome.path), "bold")
    line.append(f"  {outcome.lasts} lasts, {outcome.mesh_copies} mesh copies", "not bold")
    if not outcome.findings:
        return line.append("  sound", "green")
    table = lined_table("found", "last", "what")
    for finding in outcome.findings:
        table.add_row(cell(finding.code), cell(finding.last, "bold"), cell(finding.message))
    return Group(line, table)


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


def backup_catalogue_line(outcome: BackupOutcome) -> Text:
    """Where the copy lies and what is in it."""
    line = Text("backed up  ").append(visible(outcome.path), "bold")
    size = plain(outcome.bytes / MEGABYTE)
    return line.append(
        f" to {visible(outcome.backup)}  {outcome.lasts} lasts, {size} MB, checked", "not bold"
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


def restore_catalogue_table(outcome: RestoreOutcome) -> RenderableType:
    """What is there now, and where the one before lies."""
    return facts(
        [
            ("catalogue", cell(outcome.path)),
            ("from", cell(outcome.backup)),
            ("lasts", str(outcome.lasts)),
            ("the one before", cell(outcome.kept)),
        ]
    )
