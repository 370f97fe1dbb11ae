"""One JSON document per answer about the catalogue; docs/json.md lists every key."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.json.lines import Json, document, json_line
from footfit.report.json.numbers import (
    MILLIMETRE_DIGITS,
    RATIO_DIGITS,
    degrees,
    millimetres,
    nested,
)
from footfit.report.json.parts import (
    eigenframe_part,
    flare_part,
    last_part,
    measures_part,
    mesh_part,
    paper_frame_angle_deg,
    pose_part,
    side_part,
    warnings_part,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from footfit.results import CatalogueFacts, LastRecord, MeshCopy, Reference, UpgradeOutcome


def list_lasts_document(records: Iterable[LastRecord], reference: str | None) -> Json:
    """``footfit.list-lasts/2``: the library, one entry per last, by name."""
    ordered = sorted(records, key=lambda record: record.labels.name)
    lasts = [last_part(record, reference=reference) for record in ordered]
    return document("list-lasts", {"reference": reference, "lasts": lasts}, version=2)


def show_last_document(record: LastRecord, reference: str | None) -> Json:
    """``footfit.show-last/2``: everything that is stored of one last but its mesh.

    `record_text` writes this document for ``export-last -o x.json``.
    """
    paper = record.paper_transform
    return document(
        "show-last",
        {
            **last_part(record, reference=reference),
            "mesh": mesh_part(record.info),
            **side_part(record.side),
            **flare_part(record.flare),
            "centre_line": nested(record.flare.centre_line, RATIO_DIGITS),
            "upgraded_from": record.upgraded_from,
            "measures": measures_part(record.measures),
            "transform": nested(record.canonical_transform, RATIO_DIGITS),
            "paper_transform": None if paper is None else nested(paper, RATIO_DIGITS),
            "paper_frame_angle_deg": degrees(paper_frame_angle_deg(record)),
            **eigenframe_part(record.eigenframe),
            "printed_frame": eigenframe_part(record.printed_frame),
            "pose": pose_part(record.pose),
            "warnings": warnings_part(record.warnings),
        },
        version=2,
    )


def record_text(record: LastRecord, reference: str | None) -> str:
    """A last's record as the text of a JSON file."""
    return json_line(show_last_document(record, reference)) + "\n"


def set_reference_document(reference: Reference, lasts: int) -> Json:
    """``footfit.set-reference/1``: the new reference, and how many frames were rewritten."""
    return document(
        "set-reference",
        {
            "last": reference.last,
            "om_e": nested(reference.om_e, RATIO_DIGITS),
            "centroid_mm": nested(reference.centroid_mm, MILLIMETRE_DIGITS),
            "rewritten": lasts,
        },
    )


def rename_last_document(old: str, new: str) -> Json:
    """``footfit.rename-last/1``."""
    return document("rename-last", {"last": new, "renamed_from": old})


def remove_last_document(last: str) -> Json:
    """``footfit.remove-last/1``."""
    return document("remove-last", {"last": last, "status": "removed"})


def export_last_document(last: str, output: str, copy: MeshCopy | None) -> Json:
    """``footfit.export-last/1``: what was written; ``copy`` is None for a record in JSON."""
    return document(
        "export-last",
        {
            "last": last,
            "output": output,
            "faces": None if copy is None else copy.faces,
            "error_mm": None if copy is None else millimetres(copy.error_mm),
        },
    )


NO_FEET = 0
"""How many feet a catalogue keeps: it has no table for any."""


def catalogue_info_document(facts: CatalogueFacts) -> Json:
    """``footfit.catalogue-info/1``: where the catalogue is, and what it keeps."""
    return document(
        "catalogue-info",
        {
            "path": facts.path,
            "bytes": facts.bytes,
            "lasts": facts.lasts,
            "reference": facts.reference,
            "schema_revision": facts.schema_revision,
            "definitions": dict(facts.definitions),
            "styles": dict(facts.styles),
            "size_systems": dict(facts.size_systems),
            "sides": dict(facts.sides),
            "mesh_copies": {
                "count": facts.mesh_copies,
                "bytes": facts.mesh_copy_bytes,
                "worst_error_mm": millimetres(facts.worst_copy_error_mm),
            },
            "kept": dict(facts.kept),
            "feet_kept": NO_FEET,
        },
    )


def upgrade_catalogue_document(outcome: UpgradeOutcome) -> Json:
    """``footfit.upgrade-catalogue/1``: what changed, and where the file as it was lies."""
    return document(
        "upgrade-catalogue",
        {
            "path": outcome.path,
            "revision_before": outcome.revision_before,
            "revision_after": outcome.revision_after,
            "definition": outcome.definition,
            "recomputed": list(outcome.recomputed),
            "backup": outcome.backup,
        },
    )


def demo_document(folder: str, lasts: int, best: str | None, outputs: Sequence[str]) -> Json:
    """``footfit.demo/1``: where everything lies; the report is the last of ``outputs``."""
    return document(
        "demo",
        {"folder": folder, "lasts": lasts, "best_last": best, "outputs": list(outputs)},
    )
