"""How each command says a value: as a JSON document, as a table, with which warnings.

One constant per command, so that a new command adds one line here. Command bodies import this
module when they run: ``-h`` opens none of the report layer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from footfit.pipeline.scan.settled_unit import unit_notes
from footfit.report.json import documents, last_documents, measure_documents, upkeep_documents
from footfit.report.terminal import (
    comparison_tables,
    last_tables,
    match_tables,
    measure_tables,
    scan_tables,
    upkeep_tables,
)
from footfit.results import (
    AlignedScan,
    Alignment,
    BackupOutcome,
    CatalogueFacts,
    CheckOutcome,
    Comparison,
    DemoOutcome,
    IngestOutcome,
    LastRecord,
    Library,
    Match,
    MeasuredScan,
    MeshCopy,
    Notice,
    Profiled,
    Reference,
    RestoreOutcome,
    SurfaceCurvature,
    UpgradeOutcome,
)

if TYPE_CHECKING:
    from rich.console import RenderableType

T = TypeVar("T")
Warned = tuple[str | None, Iterable[Notice]]


def _nothing(_value: object) -> Warned:
    return None, ()


def _said(alignment: Alignment) -> list[Notice]:
    """A guess at mm, which is no warning, and the warnings."""
    return [*unit_notes(alignment.info, alignment.length_mm), *alignment.warnings]


@dataclass(frozen=True, slots=True)
class Answer(Generic[T]):
    """One command's way to say a value of type ``T``."""

    document: Callable[[T], dict[str, Any]]
    table: Callable[[T], RenderableType]
    warnings: Callable[[T], Warned] = _nothing


ALIGN: Answer[AlignedScan] = Answer(
    lambda scan: documents.align_document(scan.alignment),
    lambda scan: scan_tables.align_table(scan.alignment),
    lambda scan: (scan.alignment.info.path, _said(scan.alignment)),
)
FLARE: Answer[Profiled] = Answer(
    documents.flare_document,
    scan_tables.flare_table,
    lambda shape: (
        shape.aligned.alignment.info.path,
        (*_said(shape.aligned.alignment), *shape.suspects),
    ),
)
MEASURE: Answer[MeasuredScan] = Answer(
    measure_documents.measure_document,
    measure_tables.measure_table,
    lambda scan: (scan.alignment.info.path, (*_said(scan.alignment), *scan.suspects)),
)
MATCH: Answer[Match] = Answer(
    documents.match_document,
    match_tables.match_table,
    lambda match: (None, _match_notices(match)),
)
COMPARE: Answer[Comparison] = Answer(
    comparison_tables.compare_document,
    comparison_tables.compare_table,
    lambda compared: _comparison_said(compared),
)
INGEST_LAST: Answer[IngestOutcome] = Answer(
    documents.ingest_document,
    scan_tables.ingest_line,
    lambda outcome: (outcome.path, (*outcome.notes, *outcome.warnings)),
)
SET_REFERENCE: Answer[tuple[Reference, int]] = Answer(
    lambda changed: last_documents.set_reference_document(*changed),
    lambda changed: last_tables.set_reference_line(*changed),
)
LIST_LASTS: Answer[Library] = Answer(
    lambda found: last_documents.list_lasts_document(found.lasts, found.reference),
    lambda found: last_tables.list_lasts_table(found.lasts, found.reference),
    lambda found: (None, found.warnings),
)
SHOW_LAST: Answer[tuple[LastRecord, str | None]] = Answer(
    lambda found: last_documents.show_last_document(*found),
    lambda found: last_tables.show_last_table(*found),
)
RENAME_LAST: Answer[tuple[str, str]] = Answer(
    lambda names: last_documents.rename_last_document(*names),
    lambda names: last_tables.rename_last_line(*names),
)
REMOVE_LAST: Answer[str] = Answer(
    last_documents.remove_last_document,
    last_tables.remove_last_line,
)
EXPORT_LAST: Answer[tuple[str, str, MeshCopy | None]] = Answer(
    lambda written: last_documents.export_last_document(*written),
    lambda written: last_tables.export_last_line(*written),
)
CATALOGUE_INFO: Answer[CatalogueFacts] = Answer(
    last_documents.catalogue_info_document,
    last_tables.catalogue_info_table,
)
UPGRADE_CATALOGUE: Answer[UpgradeOutcome] = Answer(
    last_documents.upgrade_catalogue_document,
    last_tables.upgrade_catalogue_line,
)
CHECK_CATALOGUE: Answer[CheckOutcome] = Answer(
    upkeep_documents.check_catalogue_document,
    upkeep_tables.check_catalogue_table,
)
BACKUP_CATALOGUE: Answer[BackupOutcome] = Answer(
    upkeep_documents.backup_catalogue_document,
    upkeep_tables.backup_catalogue_line,
)
RESTORE_CATALOGUE: Answer[RestoreOutcome] = Answer(
    upkeep_documents.restore_catalogue_document,
    upkeep_tables.restore_catalogue_table,
)
DEMO: Answer[DemoOutcome] = Answer(
    lambda demo: last_documents.demo_document(demo.folder, demo.lasts, demo.best, demo.outputs),
    last_tables.demo_table,
)


def curvature_answer(output: str | None) -> Answer[SurfaceCurvature]:
    """The answer of ``curvature``, which names the file it writes."""
    return Answer(
        lambda values: documents.curvature_document(values, output=output),
        scan_tables.curvature_table,
        lambda values: (values.info.path, (*unit_notes(values.info), *values.warnings)),
    )


def _comparison_said(comparison: Comparison) -> Warned:
    alignment = comparison.foot.aligned.alignment
    notes = unit_notes(alignment.info, alignment.length_mm)
    return alignment.info.path, (*notes, *comparison.warnings)


def _match_notices(match: Match) -> list[Notice]:
    """A match's warnings, those of each foot first and naming its file."""
    feet = [
        Notice(notice.code, f"{foot.aligned.alignment.info.path or '-'}: {notice.message}")
        for foot in match.feet
        for notice in _said(foot.aligned.alignment)
    ]
    return [*feet, *match.warnings]
