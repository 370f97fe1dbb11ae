"""What passes between the layers: frozen dataclasses of plain, picklable values.

A length ends in ``_mm``, an angle in ``_deg``; arrays are float64 unless a docstring
says otherwise. Nobody writes to the array of a result.
"""

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
from footfit.results.fit import FitProfile as FitProfile
from footfit.results.fit import FootFit as FootFit
from footfit.results.fit import ToeBox as ToeBox
from footfit.results.fit import ToeFit as ToeFit
from footfit.results.fit import ZoneFit as ZoneFit
from footfit.results.fit import ZoneRule as ZoneRule
from footfit.results.fit_entries import FitEntry as FitEntry
from footfit.results.fit_entries import FitList as FitList
from footfit.results.fit_entries import ForgetOutcome as ForgetOutcome
from footfit.results.fit_entries import RatedZone as RatedZone
from footfit.results.heel import HeelChange as HeelChange
from footfit.results.heel import HeelModel as HeelModel
from footfit.results.heel import HeelQuestion as HeelQuestion
from footfit.results.heel import HeelRule as HeelRule
from footfit.results.last_record import LastLabels as LastLabels
from footfit.results.last_record import LastRecord as LastRecord
from footfit.results.last_record import StoredLast as StoredLast
from footfit.results.last_stance import GroundCue as GroundCue
from footfit.results.last_stance import LastStance as LastStance
from footfit.results.library import BackupOutcome as BackupOutcome
from footfit.results.library import CatalogueFacts as CatalogueFacts
from footfit.results.library import CheckOutcome as CheckOutcome
from footfit.results.library import DemoOutcome as DemoOutcome
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
from footfit.results.match import FlareDifference as FlareDifference
from footfit.results.match import Match as Match
from footfit.results.meshes import MeshCopy as MeshCopy
from footfit.results.meshes import MeshInfo as MeshInfo
from footfit.results.meshes import Scan as Scan
from footfit.results.meshes import ShapeSections as ShapeSections
from footfit.results.profile import MeasuredScan as MeasuredScan
from footfit.results.profile import Profiled as Profiled
from footfit.results.profile import SurfaceCurvature as SurfaceCurvature
from footfit.results.values import Confidence as Confidence
from footfit.results.values import Measure as Measure
from footfit.results.values import Measured as Measured
from footfit.results.values import Method as Method
from footfit.results.values import Notice as Notice
from footfit.results.values import SearchBy as SearchBy
from footfit.results.values import SideName as SideName
from footfit.results.values import Verdict as Verdict
