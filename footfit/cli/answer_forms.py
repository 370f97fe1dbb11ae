"""How a person sees each result: its table, and the notices beside it.

A command that returns a new type of result adds a line to `FORMS`. Command bodies import this
module when they run, so that ``-h`` imports nothing of the report layer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from footfit import results
from footfit.report.terminal import (
    catalogue_tables,
    comparison_tables,
    coverage_tables,
    custom_tables,
    difference_tables,
    evidence_tables,
    last_making_tables,
    match_tables,
    profile_tables,
    scan_tables,
)
from footfit.results import Alignment, IngestOutcome, Match, MeshInfo, Notice
from footfit.results.population.checked_lasts import LastsCheck
from footfit.results.population.coverage_answer import Coverage
from footfit.results.values import notices_about

if TYPE_CHECKING:
    from rich.console import RenderableType

STDIN = "-"
"""What stands for the path of standard input."""
Notices = tuple[str | None, Iterable[Notice]]
"""The file that notices are about, and the notices."""


def _of_scan(alignment: Alignment, more: Iterable[Notice] = ()) -> Notices:
    """The warnings about a scan."""
    return alignment.info.path or STDIN, (*alignment.warnings, *more)


def _of_match(match: Match) -> Notices:
    """The warnings about each foot, and those about the customer."""
    paths = [foot.aligned.alignment.info.path or STDIN for foot in match.feet]
    feet = [
        notice
        for foot, path in zip(match.feet, paths, strict=True)
        for notice in notices_about(path, foot.aligned.alignment.warnings)
    ]
    return ", ".join(paths), (*feet, *match.warnings)


def _of_ingest(outcome: IngestOutcome) -> Notices:
    """The path of a new catalogue, then the warnings about the file."""
    made = outcome.new_catalogue
    new = [Notice("new_catalogue", f"new catalogue: {made}")] if made else []
    return None, (*new, *notices_about(outcome.path or STDIN, outcome.warnings))


class Form(NamedTuple):
    """The table and the notices of one type of result.

    ``infos`` are of the files that it was made of. Notices whose codes are ``in_table`` are said by
    the table too.
    """

    table: Callable[[Any], RenderableType]
    notices: Callable[[Any], Notices] = lambda _: (None, ())
    infos: Callable[[Any], Iterable[MeshInfo]] = lambda _: ()
    in_table: frozenset[str] = frozenset()


FORMS: dict[type, Form] = {
    results.AlignedScan: Form(
        lambda scan: scan_tables.align_table(scan.alignment),
        lambda scan: _of_scan(scan.alignment),
        lambda scan: (scan.alignment.info,),
    ),
    results.Profiled: Form(
        scan_tables.flare_table,
        lambda shape: _of_scan(shape.aligned.alignment, shape.unusual),
        lambda shape: (shape.aligned.alignment.info,),
    ),
    results.MeasuredScan: Form(
        scan_tables.measure_table,
        lambda scan: _of_scan(scan.alignment, scan.unusual),
        lambda scan: (scan.alignment.info,),
    ),
    results.SurfaceCurvature: Form(
        scan_tables.curvature_table,
        lambda values: (values.info.path or STDIN, values.warnings),
        lambda values: (values.info,),
    ),
    results.Match: Form(
        match_tables.match_table,
        _of_match,
        lambda match: [foot.aligned.alignment.info for foot in match.feet],
        frozenset({"nothing_fits", "side_contradicted"}),
    ),
    results.Comparison: Form(
        comparison_tables.compare_table,
        lambda comparison: (
            comparison.foot.aligned.alignment.info.path or STDIN,
            comparison.warnings,
        ),
    ),
    results.LastDifference: Form(
        difference_tables.compare_lasts_table, lambda difference: (None, difference.warnings)
    ),
    results.CustomLast: Form(
        custom_tables.custom_table, lambda custom: (custom.foot or STDIN, custom.warnings)
    ),
    results.IngestOutcome: Form(
        scan_tables.ingest_line,
        _of_ingest,
        lambda outcome: () if outcome.info is None else (outcome.info,),
    ),
    results.Library: Form(
        catalogue_tables.list_lasts_table, lambda library: (None, library.warnings)
    ),
    results.GradedRun: Form(
        last_making_tables.graded_run_table, lambda run: (run.base, run.warnings)
    ),
    results.RunCheck: Form(
        last_making_tables.check_run_table, lambda checked: (None, checked.warnings)
    ),
    results.StoredLast: Form(catalogue_tables.show_last_table),
    results.ReferenceOutcome: Form(catalogue_tables.set_reference_line),
    results.EditOutcome: Form(
        catalogue_tables.edit_last_table, lambda outcome: (outcome.last, outcome.warnings)
    ),
    results.RenameOutcome: Form(catalogue_tables.rename_last_line),
    results.RemoveOutcome: Form(catalogue_tables.remove_last_line),
    results.ExportOutcome: Form(catalogue_tables.export_last_line),
    results.CatalogueFacts: Form(catalogue_tables.catalogue_info_table),
    results.UpgradeOutcome: Form(
        catalogue_tables.upgrade_catalogue_line,
        lambda outcome: (outcome.path, outcome.warnings),
    ),
    results.CheckOutcome: Form(catalogue_tables.check_catalogue_table),
    results.BackupOutcome: Form(catalogue_tables.backup_catalogue_line),
    results.CopyOutcome: Form(catalogue_tables.copy_catalogue_line),
    results.RestoreOutcome: Form(catalogue_tables.restore_catalogue_table),
    results.RecordOutcome: Form(evidence_tables.record_fit_line),
    results.FitList: Form(evidence_tables.list_fits_table),
    results.ForgetOutcome: Form(evidence_tables.forget_fits_line),
    results.Calibration: Form(profile_tables.calibration_table),
    results.Drawing: Form(
        scan_tables.draw_last_table,
        lambda drawing: _of_scan(drawing.alignment),
        lambda drawing: (drawing.alignment.info,),
    ),
    results.ProfileList: Form(profile_tables.list_profiles_table),
    results.ShownProfile: Form(profile_tables.show_profile_table),
    results.CheckedProfile: Form(profile_tables.check_profile_line),
    LastsCheck: Form(coverage_tables.lasts_check_table, lambda check: (None, check.notices)),
    Coverage: Form(coverage_tables.coverage_table, lambda answer: (None, answer.warnings)),
    results.DemoOutcome: Form(catalogue_tables.demo_table),
}
