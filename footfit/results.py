"""What passes between the layers: frozen dataclasses of plain, picklable values.

A length ends in ``_mm``, an angle in ``_deg``; arrays are float64 unless said. Array fields
are never written to after construction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from footfit.geometry.arrays import Floats, Ints
    from footfit.geometry.clearance import ZoneClearance
    from footfit.geometry.docking import Docking
    from footfit.geometry.flare import FlareProfile

SideName = Literal["left", "right"]
Confidence = Literal["sure", "low", "undecided"]
Method = Literal["footfit", "paper", "paper-literal"]
SearchBy = Literal["fit", "flare", "shape"]
Verdict = Literal["good", "acceptable", "poor", "reject"]


@dataclass(frozen=True, slots=True)
class Measured:
    """A measured value with its standard deviation, or the reason why there is none."""

    value: float | None
    sd: float | None = None
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class Measure:
    """One row of a shape's measures: a new measure is a new row, never a new column."""

    name: str
    measured: Measured
    definition: str


@dataclass(frozen=True, slots=True)
class Notice:
    """A warning: a stable ``code`` for scripts, a ``message`` for people."""

    code: str
    message: str


# ---------------------------------------------------------------- meshes


@dataclass(frozen=True, slots=True)
class MeshInfo:
    """What the file was.

    ``vertices`` and ``faces`` count what is left after welding and cleaning, ``sha256`` is of
    the file's bytes, ``unit_scale`` takes the file's coordinates to mm, ``units`` is
    "mm", "cm", "m", "in" or "scaled" (``--known-length``), ``units_source`` is
    "declared", "detected" or "known-length".
    """

    path: str | None
    sha256: str
    format: str
    vertices: int
    faces: int
    watertight: bool
    units: str
    units_source: str
    unit_scale: float


@dataclass(frozen=True, slots=True)
class Scan:
    """A mesh ready for geometry: mm, welded, cleaned, wound outward.

    ``vertices_mm`` is (n, 3) float64 in the file's own axes, ``faces`` is (m, 3) int64.
    ``source_to_vertex`` is, for each vertex of the file, its row of ``vertices_mm``, -1 where it
    was dropped; None for a scan that no file stands behind.
    """

    info: MeshInfo
    vertices_mm: Floats
    faces: Ints
    warnings: tuple[Notice, ...]
    source_to_vertex: Ints | None = None


@dataclass(frozen=True, slots=True)
class MeshCopy:
    """A last's mesh as the catalogue keeps it: canonical mm, decimated, compressed.

    ``error_mm`` is the largest measured distance between the copy and the mesh it stands for,
    ``data`` the compressed bytes of ``meshes.copies``.
    """

    data: bytes
    faces: int
    error_mm: float


# ---------------------------------------------------------------- alignment


@dataclass(frozen=True, slots=True)
class SideVerdict:
    """Left or right, how surely, and who said so.

    ``score`` is the mirror-odd score S of the detection, + for a right shape; ``source`` is
    "given" or "detected". ``side`` is None only where it is undecided.
    """

    side: SideName | None
    confidence: Confidence
    score: float
    source: str


@dataclass(frozen=True, slots=True)
class PoseQuality:
    """How well the pose is settled; see ``docs/alignment.md``.

    ``cost`` of the fit to the reference shapes, ``margin`` to the best other pose, ``support``
    the share of the sole under the plane, ``sole`` whether there is one, ``kind`` "foot" or
    "last": the reference shape that fits best.
    """

    cost: float
    margin: float
    support: float
    sole: bool
    kind: str


@dataclass(frozen=True, slots=True)
class Eigenframe:
    """The paper's frame of one mesh (Eq. 1-5), signs and order settled by the canonical frame.

    ``centroid_mm`` (3,) in the file's axes; ``eigenvectors`` (3, 3) as rows in the file's
    axes, a rotation, each nearest to X, Y, Z in turn; ``eigenvalues_mm2`` (3,) paired with the
    rows, so not always descending. A left shape is mirrored before Eq. 1 where it is compared
    (``paper_transform``); the frame itself is of the mesh as it is.
    """

    centroid_mm: Floats
    eigenvectors: Floats
    eigenvalues_mm2: Floats


@dataclass(frozen=True, slots=True)
class Reference:
    """The reference last: its name, OM_E (Eq. 6) and its P_c (Eq. 1) in its canonical frame.

    ``om_e`` (3, 3) has the eigenvectors as columns in the canonical frame. Both come from the
    last's printed frame: only so does Eq. 8 put the reference on itself.
    """

    last: str
    om_e: Floats
    centroid_mm: Floats


@dataclass(frozen=True, slots=True)
class Alignment:
    """One mesh, aligned.

    ``transform`` (4, 4) takes the file's coordinates to aligned mm (rotation, translation and
    the unit's scale, never a mirror). ``canonical_transform`` (4, 4) is the same for method
    "footfit"; for the paper's methods it is still footfit's. ``eigenframe`` is the method's own:
    of the exact moments for "footfit", by Eq. 1-4 as printed for the paper's; "paper-literal"
    orders its rows by eigenvalue and makes the largest entry of each positive.
    ``printed_frame`` is by Eq. 1-4 as printed and settled, whatever the method. ``reference`` is
    the last whose OM_E was used, None for method "footfit" without one.
    """

    info: MeshInfo
    method: Method
    side: SideVerdict
    transform: Floats
    canonical_transform: Floats
    eigenframe: Eigenframe
    printed_frame: Eigenframe
    pose: PoseQuality
    reference: Reference | None
    length_mm: float
    warnings: tuple[Notice, ...]


@dataclass(frozen=True, slots=True)
class AlignedScan:
    """An alignment with its mesh in the canonical frame.

    ``vertices_mm`` (n, 3) canonical and not mirrored, ``faces`` (m, 3) wound outward.
    """

    alignment: Alignment
    vertices_mm: Floats
    faces: Ints


# ---------------------------------------------------------------- profile


@dataclass(frozen=True, slots=True)
class Profiled:
    """A mesh aligned, measured and profiled: what ingest stores and match ranks."""

    aligned: AlignedScan
    flare: FlareProfile
    measures: tuple[Measure, ...]


@dataclass(frozen=True, slots=True)
class MeasuredScan:
    """A mesh aligned and measured; ``suspects`` are values that are hardly a foot's."""

    alignment: Alignment
    measures: tuple[Measure, ...]
    suspects: tuple[Notice, ...]


@dataclass(frozen=True, slots=True)
class SurfaceCurvature:
    """Per-vertex curvature of a surface in 1/mm, (n,) each; NaN where it is undefined.

    ``k1`` <= ``k2``; convex is positive; ``radius_mm`` 0 is the paper's one ring.
    """

    info: MeshInfo
    radius_mm: float
    vertices_mm: Floats
    faces: Ints
    k1: Floats
    k2: Floats
    mean: Floats
    gaussian: Floats
    source_to_vertex: Ints
    warnings: tuple[Notice, ...]


# ---------------------------------------------------------------- catalogue


@dataclass(frozen=True, slots=True)
class LastLabels:
    """What people say of a last; kept as given and never trusted over its geometry."""

    name: str
    style: str | None = None
    size: str | None = None
    size_system: str | None = None
    width_label: str | None = None
    heel_height_mm: float | None = None
    family: str | None = None
    parent: str | None = None


@dataclass(frozen=True, slots=True)
class LastRecord:
    """A last as the catalogue holds it, without its mesh.

    ``eigenframe`` is of the exact moments, ``printed_frame`` by Eq. 1-4 as printed.
    ``paper_transform`` (4, 4) takes the file's coordinates (mirrored in its first axis for a
    left last) to the reference's frame by the paper's Eq. 8, from the printed frames; None while
    there is no reference.
    ``upgraded_from`` names the older flare definition that this profile replaces.
    """

    labels: LastLabels
    info: MeshInfo
    side: SideVerdict
    pose: PoseQuality
    eigenframe: Eigenframe
    printed_frame: Eigenframe
    canonical_transform: Floats
    paper_transform: Floats | None
    length_mm: float
    flare: FlareProfile
    measures: tuple[Measure, ...]
    warnings: tuple[Notice, ...]
    upgraded_from: str | None = None


@dataclass(frozen=True, slots=True)
class IngestOutcome:
    """What became of one file: ``status`` is added, unchanged, replaced or refused.

    ``path`` is None for standard input. ``notes`` are told to people, and warn of nothing.
    """

    path: str | None
    status: str
    last: str | None
    side: SideName | None
    flare_angle_deg: float | None
    error: str | None
    exit: int
    code: str | None
    warnings: tuple[Notice, ...] = ()
    reference: bool = False
    notes: tuple[Notice, ...] = ()


@dataclass(frozen=True, slots=True)
class CatalogueFacts:
    """What ``catalogue-info`` says: where the file is, what it holds, what it keeps of whom."""

    path: str
    bytes: int
    lasts: int
    reference: str | None
    schema_revision: str
    definitions: tuple[tuple[str, int], ...]
    styles: tuple[tuple[str, int], ...]
    size_systems: tuple[tuple[str, int], ...]
    sides: tuple[tuple[str, int], ...]
    mesh_copies: int
    mesh_copy_bytes: int
    worst_copy_error_mm: float | None


# ---------------------------------------------------------------- fit


@dataclass(frozen=True, slots=True)
class ZoneRule:
    """What a fit profile asks of one zone, in the zone's unit; a clearance is last minus foot.

    ``good`` holds ``target``, ``acceptable`` holds ``good``, ``poor`` holds ``acceptable``; what is
    outside of ``poor`` is a reject, None never is one. ``weight`` counts in the distance; 0 shows
    the zone and judges nothing by it. Without a ``required`` zone no last is good. ``cavity`` is
    what lining, insole and counter take from the last, and is taken off first.
    """

    zone: str
    target: float
    good: tuple[float, float]
    acceptable: tuple[float, float]
    poor: tuple[float, float] | None
    weight: float
    required: bool
    cavity: float


@dataclass(frozen=True, slots=True)
class FitProfile:
    """What kind of shoe is fitted: a rule for each zone, in the order in which they are judged.

    ``sha256`` is of the values, not of the file: a comment changes nothing. Two distances that
    differ by at most ``tie_sds`` standard deviations of their difference are a tie.
    """

    name: str
    version: int
    summary: str
    tie_sds: float
    zones: tuple[ZoneRule, ...]
    sha256: str


@dataclass(frozen=True, slots=True)
class ZoneFit:
    """One foot in one zone of a last.

    ``clearance`` is in ``unit``, ``target`` what the profile asks, ``score`` 0 at the target and
    1 at the edge of good, - tight and + loose. ``verdict`` and ``score`` are None where the
    clearance is not measured. ``counts`` False: another foot of the pair governs this zone, or
    its weight is 0.
    """

    zone: str
    unit: str
    clearance: Measured
    target: float
    score: float | None
    verdict: Verdict | None
    counts: bool


@dataclass(frozen=True, slots=True)
class FootFit:
    """One foot of the customer in one last; ``verdict`` is the worst of the zones that count."""

    side: SideName | None
    verdict: Verdict
    zones: tuple[ZoneFit, ...]


# ---------------------------------------------------------------- match


@dataclass(frozen=True, slots=True)
class FlareDifference:
    """The profile distance D and the flare angle's difference, last minus foot."""

    distance: float
    delta_deg: float
    parts: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Candidate:
    """One last of the answer; None where a later version will measure it."""

    rank: int
    last: str
    style: str | None
    size: str | None
    size_system: str | None
    width_label: str | None
    side: SideName | None
    mirrored: bool
    distance: float
    flare: FlareDifference
    clearance_mm: tuple[tuple[str, Measured], ...]
    verdict: str | None
    why: str
    tied_with: tuple[str, ...]
    record: LastRecord
    distance_sd: float | None = None
    fits: tuple[FootFit, ...] = ()
    not_judged: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Match:
    """One customer's answer: one foot, or two with ``--pair``.

    ``nearest`` are the lasts that come nearest where none fits. ``size_system`` is the one that
    was asked for. ``best_verdict`` is over every ranked last, shown or not; None by shape, and
    where none is ranked.
    """

    feet: tuple[Profiled, ...]
    by: SearchBy
    profile: str
    catalogue_lasts: int
    reference: str | None
    candidates: tuple[Candidate, ...]
    rejected: tuple[tuple[str, int], ...]
    warnings: tuple[Notice, ...]
    fit_profile: FitProfile | None = None
    nearest: tuple[Candidate, ...] = ()
    size_system: str | None = None
    best_verdict: Verdict | None = None


# ---------------------------------------------------------------- compare


@dataclass(frozen=True, slots=True)
class SizeDifference:
    """One size of one section in mm: of the foot, of the last, and last minus foot."""

    name: str
    foot: Measured
    last: Measured
    difference: Measured


@dataclass(frozen=True, slots=True)
class SectionComparison:
    """Foot and last cut by one plane at a named ``station``, ``x_mm`` from the foot's heel.

    The outlines are closed loops (k, 2), across (+ is medial) and up, mm.
    """

    station: str
    x_mm: float
    foot_outline: tuple[Floats, ...]
    last_outline: tuple[Floats, ...]
    sizes: tuple[SizeDifference, ...]


@dataclass(frozen=True, slots=True)
class Comparison:
    """A foot in a last, both as right shapes in the last's frame, mm.

    ``vertices_mm`` (n, 3) and ``faces`` (m, 3) are the foot as it is docked, ``room_mm`` (n,) its
    clearance at each vertex, NaN where the shoe does not reach; ``last_vertices_mm`` and
    ``last_faces`` are the last. ``mirrored``: the last is of the other side than the foot.
    """

    foot: Profiled
    last: LastRecord
    mirrored: bool
    docking: Docking
    vertices_mm: Floats
    faces: Ints
    last_vertices_mm: Floats
    last_faces: Ints
    room_mm: Floats
    zones: tuple[ZoneClearance, ...]
    sections: tuple[SectionComparison, ...]
    warnings: tuple[Notice, ...]


# ---------------------------------------------------------------- library


@dataclass(frozen=True, slots=True)
class UpgradeOutcome:
    """What ``upgrade-catalogue`` did: the schema's revisions and the profiles re-computed."""

    path: str
    revision_before: str
    revision_after: str
    definition: str
    recomputed: tuple[str, ...]
    backup: str | None


@dataclass(frozen=True, slots=True)
class DemoOutcome:
    """Where the demo's files lie; the report is the last of ``outputs``."""

    folder: str
    lasts: int
    best: str | None
    outputs: tuple[str, ...]


# ---------------------------------------------------------------- upkeep


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing in a catalogue that is not as it must be.

    ``last`` names the last it is about, if any. ``damage`` False: nothing is lost and a command
    mends it (an older profile); the message names the command.
    """

    code: str
    message: str
    last: str | None = None
    damage: bool = True


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What ``check-catalogue`` looked at, and what it found; nothing in a sound catalogue."""

    path: str
    lasts: int
    mesh_copies: int
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True)
class BackupOutcome:
    """A verified copy: where it lies, its size and how many lasts it holds."""

    path: str
    backup: str
    bytes: int
    lasts: int


@dataclass(frozen=True, slots=True)
class RestoreOutcome:
    """A catalogue as its backup had it; ``kept`` is where the one before lies, if there was one."""

    path: str
    backup: str
    lasts: int
    kept: str | None
