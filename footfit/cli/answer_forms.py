"""How a person sees each result: its table, and the notices beside it.

A command that returns a new type of result adds a line to `FORMS`. A form names its result and its
table, so that a command opens the modules of its own result alone, and ``-h`` none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

from footfit.results.values import Notice, notices_about

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import Alignment, IngestOutcome, Match, MeshInfo

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

    ``maker`` is the module of `footfit.report.terminal` and the function that makes the table;
    ``infos`` are of the files that it was made of. Notices whose codes are ``in_table`` are said by
    the table too.
    """

    maker: str
    notices: Callable[[Any], Notices] = lambda _: (None, ())
    infos: Callable[[Any], Iterable[MeshInfo]] = lambda _: ()
    in_table: frozenset[str] = frozenset()

    def table(self, value: Any) -> RenderableType:
        """The table of a result."""
        module, name = self.maker.split(".")
        make: Callable[[Any], RenderableType]
        make = getattr(import_module(f"footfit.report.terminal.{module}"), name)
        return make(value)


FORMS: dict[str, Form] = {
    "AlignedScan": Form(
        "scan_tables.aligned_scan_table",
        lambda scan: _of_scan(scan.alignment),
        lambda scan: (scan.alignment.info,),
    ),
    "Profiled": Form(
        "scan_tables.flare_table",
        lambda shape: _of_scan(shape.aligned.alignment, shape.unusual),
        lambda shape: (shape.aligned.alignment.info,),
    ),
    "MeasuredScan": Form(
        "scan_tables.measure_table",
        lambda scan: _of_scan(scan.alignment, scan.unusual),
        lambda scan: (scan.alignment.info,),
    ),
    "SurfaceCurvature": Form(
        "scan_tables.curvature_table",
        lambda values: (values.info.path or STDIN, values.warnings),
        lambda values: (values.info,),
    ),
    "Match": Form(
        "match_tables.match_table",
        _of_match,
        lambda match: [foot.aligned.alignment.info for foot in match.feet],
        frozenset({"nothing_fits", "side_contradicted"}),
    ),
    "Comparison": Form(
        "comparison_tables.compare_table",
        lambda comparison: (
            comparison.foot.aligned.alignment.info.path or STDIN,
            comparison.warnings,
        ),
    ),
    "LastDifference": Form(
        "difference_tables.compare_lasts_table", lambda difference: (None, difference.warnings)
    ),
    "CustomLast": Form(
        "custom_tables.custom_table", lambda custom: (custom.foot or STDIN, custom.warnings)
    ),
    "IngestOutcome": Form(
        "scan_tables.ingest_line",
        _of_ingest,
        lambda outcome: () if outcome.info is None else (outcome.info,),
    ),
    "Library": Form("catalogue_tables.list_lasts_table", lambda library: (None, library.warnings)),
    "GradedRun": Form("last_making_tables.graded_run_table", lambda run: (run.base, run.warnings)),
    "RunCheck": Form(
        "last_making_tables.check_run_table", lambda checked: (None, checked.warnings)
    ),
    "StoredLast": Form("catalogue_tables.show_last_table"),
    "ReferenceOutcome": Form("catalogue_tables.set_reference_line"),
    "EditOutcome": Form(
        "catalogue_tables.edit_last_table", lambda outcome: (outcome.last, outcome.warnings)
    ),
    "RenameOutcome": Form("catalogue_tables.rename_last_line"),
    "RemoveOutcome": Form("catalogue_tables.remove_last_line"),
    "ExportOutcome": Form("catalogue_tables.export_last_line"),
    "CatalogueFacts": Form("catalogue_tables.catalogue_info_table"),
    "UpgradeOutcome": Form(
        "catalogue_tables.upgrade_catalogue_line",
        lambda outcome: (outcome.path, outcome.warnings),
    ),
    "CheckOutcome": Form("catalogue_tables.check_catalogue_table"),
    "BackupOutcome": Form("catalogue_tables.backup_catalogue_line"),
    "CopyOutcome": Form("catalogue_tables.copy_catalogue_line"),
    "RestoreOutcome": Form("catalogue_tables.restore_catalogue_table"),
    "RecordOutcome": Form("evidence_tables.record_fit_line"),
    "FitList": Form("evidence_tables.list_fits_table"),
    "ForgetOutcome": Form("evidence_tables.forget_fits_line"),
    "Calibration": Form("profile_tables.calibration_table"),
    "Drawing": Form(
        "scan_tables.draw_last_table",
        lambda drawing: _of_scan(drawing.alignment),
        lambda drawing: (drawing.alignment.info,),
    ),
    "ProfileList": Form("profile_tables.list_profiles_table"),
    "ShownProfile": Form("profile_tables.show_profile_table"),
    "CheckedProfile": Form("profile_tables.check_profile_line"),
    "LastsCheck": Form("coverage_tables.lasts_check_table", lambda check: (None, check.notices)),
    "Coverage": Form("coverage_tables.coverage_table", lambda answer: (None, answer.warnings)),
    "DemoOutcome": Form("catalogue_tables.demo_table"),
}
"""The form of each result, by the name of its class."""


def form_of(value: object) -> Form:
    """The form of a result."""
    return FORMS[type(value).__name__]
