"""The answer of ``footfit measure`` as JSON; docs/json.md lists every key."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.json.lines import Json, document
from footfit.report.json.parts import measures_part, mesh_part, side_part, warnings_part

if TYPE_CHECKING:
    from footfit.results import MeasuredScan


def measure_document(scan: MeasuredScan) -> Json:
    """``footfit.measure/1``."""
    alignment = scan.alignment
    return document(
        "measure",
        {
            "mesh": mesh_part(alignment.info),
            **side_part(alignment.side),
            "kind": alignment.pose.kind,
            "measures": measures_part(scan.measures),
            "definitions": {measure.name: measure.definition for measure in scan.measures},
            "warnings": warnings_part((*alignment.warnings, *scan.suspects)),
        },
    )
