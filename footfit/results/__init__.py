"""What passes between the layers: frozen dataclasses of plain, picklable values.

A length ends in ``_mm``, an angle in ``_deg``; arrays are float64 unless a docstring
says otherwise. Nobody writes to the array of a result.

Each name is imported when it is asked for: a command opens only the modules of its own results.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.results.alignment import AlignedScan as AlignedScan
    from footfit.results.alignment import Alignment as Alignment
    from footfit.results.alignment import Eigenframe as Eigenframe
    from footfit.results.alignment import PoseQuality as PoseQuality
    from footfit.results.alignment import PreparedScan as PreparedScan
    from footfit.results.alignment import Reference as Reference
    from footfit.results.alignment import SideVerdict as SideVerdict
    from footfit.results.compare import Comparison as Comparison
    from footfit.results.compare import SectionComparison as SectionComparison
    from footfit.results.compare import SizeDifference as SizeDifference
    from footfit.results.compare import SurfaceClearance as SurfaceClearance
    from footfit.results.compare import TightPlace as TightPlace
    from footfit.results.compare import tightest_place as tightest_place
    from footfit.results.evidence.child_growth import Growth as Growth
    from footfit.results.evidence.child_growth import GrowthQuestion as GrowthQuestion
    from footfit.results.evidence.fit_entries import FitEntry as FitEntry
    from footfit.results.evidence.fit_entries import FitList as FitList
    from footfit.results.evidence.fit_entries import ForgetOutcome as ForgetOutcome
    from footfit.results.evidence.fit_entries import RatedZone as RatedZone
    from footfit.results.evidence.fit_entries import RecordOutcome as RecordOutcome
    from footfit.results.evidence.fit_evidence import Calibration as Calibration
    from footfit.results.evidence.fit_evidence import RatedClearances as RatedClearances
    from footfit.results.evidence.fit_evidence import ZoneEvidence as ZoneEvidence
    from footfit.results.evidence.profiles import CheckedProfile as CheckedProfile
    from footfit.results.evidence.profiles import ProfileList as ProfileList
    from footfit.results.evidence.profiles import ShownProfile as ShownProfile
    from footfit.results.fit import FitProfile as FitProfile
    from footfit.results.fit import FootFit as FootFit
    from footfit.results.fit import ToeBox as ToeBox
    from footfit.results.fit import ToeFit as ToeFit
    from footfit.results.fit import ZoneFit as ZoneFit
    from footfit.results.fit import ZoneRule as ZoneRule
    from footfit.results.heel import HeelChange as HeelChange
    from footfit.results.heel import HeelModel as HeelModel
    from footfit.results.heel import HeelQuestion as HeelQuestion
    from footfit.results.heel import HeelRule as HeelRule
    from footfit.results.last_making.custom_last import BaseMesh as BaseMesh
    from footfit.results.last_making.custom_last import BetterInStock as BetterInStock
    from footfit.results.last_making.custom_last import CustomLast as CustomLast
    from footfit.results.last_making.custom_last import CustomZone as CustomZone
    from footfit.results.last_making.custom_last import GirthPlane as GirthPlane
    from footfit.results.last_making.custom_last import JudgedZone as JudgedZone
    from footfit.results.last_making.custom_last import KeptPlace as KeptPlace
    from footfit.results.last_making.custom_last import RoomPlace as RoomPlace
    from footfit.results.last_making.custom_last import ToeBoxChange as ToeBoxChange
    from footfit.results.last_making.drawing import Drawing as Drawing
    from footfit.results.last_making.graded_run import GradedLast as GradedLast
    from footfit.results.last_making.graded_run import GradedMeasure as GradedMeasure
    from footfit.results.last_making.graded_run import GradedRun as GradedRun
    from footfit.results.last_making.grading_rule import GradingRule as GradingRule
    from footfit.results.last_making.last_difference import LastDifference as LastDifference
    from footfit.results.last_making.run_check import RunCheck as RunCheck
    from footfit.results.last_making.run_check import RunLast as RunLast
    from footfit.results.last_making.run_check import RunLaw as RunLaw
    from footfit.results.last_making.run_check import RunStep as RunStep
    from footfit.results.last_record import LastLabels as LastLabels
    from footfit.results.last_record import LastRecord as LastRecord
    from footfit.results.last_record import Parentage as Parentage
    from footfit.results.last_record import StoredLast as StoredLast
    from footfit.results.last_record import Target as Target
    from footfit.results.last_stance import GroundCue as GroundCue
    from footfit.results.last_stance import LastStance as LastStance
    from footfit.results.library import BackupOutcome as BackupOutcome
    from footfit.results.library import CatalogueFacts as CatalogueFacts
    from footfit.results.library import CheckOutcome as CheckOutcome
    from footfit.results.library import CopyOutcome as CopyOutcome
    from footfit.results.library import DemoOutcome as DemoOutcome
    from footfit.results.library import EditOutcome as EditOutcome
    from footfit.results.library import ExportOutcome as ExportOutcome
    from footfit.results.library import Finding as Finding
    from footfit.results.library import IngestOutcome as IngestOutcome
    from footfit.results.library import Library as Library
    from footfit.results.library import ReferenceOutcome as ReferenceOutcome
    from footfit.results.library import RemoveOutcome as RemoveOutcome
    from footfit.results.library import RenameOutcome as RenameOutcome
    from footfit.results.library import RestoreOutcome as RestoreOutcome
    from footfit.results.library import UpgradeOutcome as UpgradeOutcome
    from footfit.results.match import Candidate as Candidate
    from footfit.results.match import FailedMatch as FailedMatch
    from footfit.results.match import FlareDifference as FlareDifference
    from footfit.results.match import Match as Match
    from footfit.results.match import NotInStock as NotInStock
    from footfit.results.meshes import MeshCopy as MeshCopy
    from footfit.results.meshes import MeshInfo as MeshInfo
    from footfit.results.meshes import Scan as Scan
    from footfit.results.meshes import ShapeSections as ShapeSections
    from footfit.results.profile import MeasuredScan as MeasuredScan
    from footfit.results.profile import Profiled as Profiled
    from footfit.results.profile import SurfaceCurvature as SurfaceCurvature
    from footfit.results.profile import WideMeasures as WideMeasures
    from footfit.results.values import Confidence as Confidence
    from footfit.results.values import KindName as KindName
    from footfit.results.values import KindWord as KindWord
    from footfit.results.values import Measure as Measure
    from footfit.results.values import Measured as Measured
    from footfit.results.values import Method as Method
    from footfit.results.values import Notice as Notice
    from footfit.results.values import SearchBy as SearchBy
    from footfit.results.values import SideName as SideName
    from footfit.results.values import Verdict as Verdict
    from footfit.results.width import FootWidth as FootWidth
    from footfit.results.width import WidthShare as WidthShare
    from footfit.results.worn import Worn as Worn

_NAMES = {
    "alignment": "AlignedScan Alignment Eigenframe PoseQuality PreparedScan Reference SideVerdict",
    "compare": (
        "Comparison SectionComparison SizeDifference SurfaceClearance TightPlace tightest_place"
    ),
    "evidence.child_growth": "Growth GrowthQuestion",
    "evidence.fit_entries": "FitEntry FitList ForgetOutcome RatedZone RecordOutcome",
    "evidence.fit_evidence": "Calibration RatedClearances ZoneEvidence",
    "evidence.profiles": "CheckedProfile ProfileList ShownProfile",
    "fit": "FitProfile FootFit ToeBox ToeFit ZoneFit ZoneRule",
    "heel": "HeelChange HeelModel HeelQuestion HeelRule",
    "last_making.custom_last": (
        "BaseMesh BetterInStock CustomLast CustomZone GirthPlane JudgedZone KeptPlace RoomPlace "
        "ToeBoxChange"
    ),
    "last_making.drawing": "Drawing",
    "last_making.graded_run": "GradedLast GradedMeasure GradedRun",
    "last_making.grading_rule": "GradingRule",
    "last_making.last_difference": "LastDifference",
    "last_making.run_check": "RunCheck RunLast RunLaw RunStep",
    "last_record": "LastLabels LastRecord Parentage StoredLast Target",
    "last_stance": "GroundCue LastStance",
    "library": (
        "BackupOutcome CatalogueFacts CheckOutcome CopyOutcome DemoOutcome EditOutcome"
        " ExportOutcome Finding IngestOutcome Library ReferenceOutcome RemoveOutcome"
        " RenameOutcome RestoreOutcome UpgradeOutcome"
    ),
    "match": "Candidate FailedMatch FlareDifference Match NotInStock",
    "meshes": "MeshCopy MeshInfo Scan ShapeSections",
    "profile": "MeasuredScan Profiled SurfaceCurvature WideMeasures",
    "values": (
        "Confidence KindName KindWord Measure Measured Method Notice SearchBy SideName Verdict"
    ),
    "width": "FootWidth WidthShare",
    "worn": "Worn",
}
"""The module of each name: as above, where a type checker reads it."""
_HOMES = {name: home for home, names in _NAMES.items() for name in names.split()}


def __getattr__(name: str) -> object:
    """Import a name from its module, the first time that it is asked for."""
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(f"{__name__}.{home}"), name)
    return value


def __dir__() -> list[str]:
    """Every name, as an editor lists it."""
    return sorted(_HOMES)
