"""What passes between the layers: frozen dataclasses of plain, picklable values.

A length ends in ``_mm``, an angle in ``_deg``; arrays are float64 unless said. Array fields
are never written to after construction.
"""

from footfit.results.alignment import (
    AlignedScan,
    Alignment,
    Eigenframe,
    PoseQuality,
    PreparedScan,
    Reference,
    SideVerdict,
)
from footfit.results.compare import (
    Comparison,
    SectionComparison,
    SizeDifference,
    SurfaceClearance,
)
from footfit.results.fit import FitProfile, FootFit, ZoneFit, ZoneRule
from footfit.results.last_record import LastLabels, LastRecord, StoredLast
from footfit.results.library import (
    CatalogueFacts,
    DemoOutcome,
    ExportOutcome,
    IngestOutcome,
    Library,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    UpgradeOutcome,
)
from footfit.results.match import Candidate, FlareDifference, Match
from footfit.results.meshes import MeshCopy, MeshInfo, Scan
from footfit.results.profile import MeasuredScan, Profiled, SurfaceCurvature
from footfit.results.upkeep import BackupOutcome, CheckOutcome, Finding, RestoreOutcome
from footfit.results.values import (
    Confidence,
    Measure,
    Measured,
    Method,
    Notice,
    SearchBy,
    SideName,
    Verdict,
)

__all__ = [
    "AlignedScan",
    "Alignment",
    "BackupOutcome",
    "Candidate",
    "CatalogueFacts",
    "CheckOutcome",
    "Comparison",
    "Confidence",
    "DemoOutcome",
    "Eigenframe",
    "ExportOutcome",
    "Finding",
    "FitProfile",
    "FlareDifference",
    "FootFit",
    "IngestOutcome",
    "LastLabels",
    "LastRecord",
    "Library",
    "Match",
    "Measure",
    "Measured",
    "MeasuredScan",
    "MeshCopy",
    "MeshInfo",
    "Method",
    "Notice",
    "PoseQuality",
    "PreparedScan",
    "Profiled",
    "Reference",
    "ReferenceOutcome",
    "RemoveOutcome",
    "RenameOutcome",
    "RestoreOutcome",
    "Scan",
    "SearchBy",
    "SectionComparison",
    "SideName",
    "SideVerdict",
    "SizeDifference",
    "StoredLast",
    "SurfaceClearance",
    "SurfaceCurvature",
    "UpgradeOutcome",
    "Verdict",
    "ZoneFit",
    "ZoneRule",
]
