"""How a person sees each result: its table, and the notices beside it.

A command that returns a new type of result adds a line to `FORMS`. Command bodies import this
module when they run, so that ``-h`` imports nothing of the report layer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from footfit import results
from footfit.pipeline.scan.settled_unit import unit_notes
from footfit.report.terminal import (
    catalogue_tables,
    comparison_tables,
    match_tables,
    scan_tables,
)
from footfit.results import Alignment, IngestOutcome, Match, Notice

if TYPE_CHECKING:
    from rich.console import RenderableType

Notices = tuple[str | None, Iterable[Notice]]
"""The file that notices are about, and the notices."""


def _of_scan(alignment: Alignment, more: Iterable[Notice] = ()) -> Notices:
    """The notes on the unit, which are no warnings, and the warnings."""
    return _with_notes(alignment, (*alignment.warnings, *more))


def _with_notes(alignment: Alignment, warnings: Iterable[Notice]) -> Notices:
    notes = unit_notes(alignment.info, alignment.length_mm)
    return alignment.info.path, (*notes, *warnings)


def _of_match(match: Match) -> Notices:
    """The notices of each foot, with the name of its file, and the warnings of the match."""
    feet = [
        Notice(notice.code, f"{path or '-'}: {notice.message}")
        for path, notices in (_of_scan(foot.aligned.alignment) for foot in match.feet)
        for notice in notices
    ]
    return None, (*feet, *match.warnings)


def _of_ingest(outcome: IngestOutcome) -> Notices:
    """The path of a new catalogue, then the notes and the warnings of the file."""
    made = outcome.new_catalogue
    new = [Notice("new_catalogue", f"new catalogue: {made}")] if made else []
    where = f"{outcome.path or '-'}: "
    of_file = [
        Notice(notice.code, where + notice.message)
        for notice in (*outcome.notes, *outcome.warnings)
    ]
    return None, (*new, *of_file)


class Form(NamedTuple):
    """The table and the notices of one type of result."""

    table: Callable[[Any], RenderableType]
    notices: Callable[[Any], Notices] = lambda _: (None, ())


FORMS: dict[type, Form] = {
    results.AlignedScan: Form(
        lambda scan: scan_tables.align_table(scan.alignment), lambda scan: _of_scan(scan.alignment)
    ),
    results.Profiled: Form(
        scan_tables.flare_table, lambda shape: _of_scan(shape.aligned.alignment, shape.unusual)
    ),
    results.MeasuredScan: Form(
        scan_tables.measure_table, lambda scan: _of_scan(scan.alignment, scan.unusual)
    ),
    results.SurfaceCurvature: Form(
        scan_tables.curvature_table,
        lambda values: (values.info.path, (*unit_notes(values.info), *values.warnings)),
    ),
    results.Match: Form(match_tables.match_table, _of_match),
    results.Comparison: Form(
        comparison_tables.compare_table,
        lambda comparison: _with_notes(comparison.foot.aligned.alignment, comparison.warnings),
    ),
    results.IngestOutcome: Form(scan_tables.ingest_line, _of_ingest),
    results.Library: Form(
        catalogue_tables.list_lasts_table, lambda library: (None, library.warnings)
    ),
    results.StoredLast: Form(catalogue_tables.show_last_table),
    results.ReferenceOutcome: Form(catalogue_tables.set_reference_line),
    results.RenameOutcome: Form(catalogue_tables.rename_last_line),
    results.RemoveOutcome: Form(catalogue_tables.remove_last_line),
    results.ExportOutcome: Form(catalogue_tables.export_last_line),
    results.CatalogueFacts: Form(catalogue_tables.catalogue_info_table),
    results.UpgradeOutcome: Form(catalogue_tables.upgrade_catalogue_line),
    results.CheckOutcome: Form(catalogue_tables.check_catalogue_table),
    results.BackupOutcome: Form(catalogue_tables.backup_catalogue_line),
    results.RestoreOutcome: Form(catalogue_tables.restore_catalogue_table),
    results.DemoOutcome: Form(catalogue_tables.demo_table),
}
