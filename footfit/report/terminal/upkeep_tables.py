"""Answers about the catalogue file for a terminal: checked, backed up, restored."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from footfit.report.terminal.scan_tables import cell, facts, lined_table
from footfit.report.wording.text import plain, visible

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import BackupOutcome, CheckOutcome, RestoreOutcome

MEGABYTE = 1_000_000


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


def backup_catalogue_line(outcome: BackupOutcome) -> Text:
    """Where the copy lies and what is in it."""
    line = Text("backed up  ").append(visible(outcome.path), "bold")
    size = plain(outcome.bytes / MEGABYTE)
    return line.append(
        f" to {visible(outcome.backup)}  {outcome.lasts} lasts, {size} MB, checked", "not bold"
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
