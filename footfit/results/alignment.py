"""One mesh in the canonical frame: its pose, its side, the paper's eigenframe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from footfit.results.values import Document, Json, Part, fields, part

if TYPE_CHECKING:
    from footfit.geometry.measures.landmarks import Shape
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.last_stance import LastStance
    from footfit.results.meshes import MeshInfo
    from footfit.results.values import (
        Confidence,
        KindWord,
        Measured,
        Method,
        Notice,
        SideName,
    )


@dataclass(frozen=True, slots=True)
class SideVerdict:
    """Left or right, how sure it is, and where it comes from.

    ``score`` is the mirror-odd score S of the detection, + for a right shape; ``source`` is
    "given" or "detected". ``side`` is None only if it is undecided.
    """

    side: SideName | None
    confidence: Confidence
    score: float
    source: str

    @property
    def shown(self) -> SideName:
        """The side that the shape shows, however doubtful it is."""
        return "right" if self.score >= 0 else "left"

    def to_dict(self) -> Json:
        """Three keys, which a document has at its top level."""
        score = part({"word": self.confidence, "score": self.score})
        return {"side": self.side, "side_confidence": score, "side_source": self.source}


@dataclass(frozen=True, slots=True)
class PoseQuality(Part):
    """How well the pose is settled; see ``docs/alignment.md``.

    ``cost`` of the fit to the reference shapes, ``margin`` to the best other pose, ``support``
    the share of the sole under the plane, ``sole`` whether there is one, ``kind`` "foot" or
    "last". ``kind_confidence`` says how sure the kind is, or that it was given; None of a stored
    last.
    """

    cost: float
    margin: float
    support: float
    sole: bool
    kind: str
    kind_confidence: KindWord | None = None

    not_written = ("kind", "kind_confidence")


@dataclass(frozen=True, slots=True)
class Eigenframe(Part):
    """The paper's frame of one mesh (Eq. 1-5), with signs and order of the canonical frame.

    ``centroid_mm`` (3,) in the file's axes; ``eigenvectors`` (3, 3) as rows in the file's
    axes, a rotation, each nearest to X, Y, Z in turn; ``eigenvalues_mm2`` (3,) paired with the
    rows, so not always descending. A left shape is mirrored before Eq. 1 if it is compared
    (``paper_transform``); this frame is of the mesh as it is.
    """

    centroid_mm: Floats
    eigenvectors: Floats
    eigenvalues_mm2: Floats

    def _keys(self) -> Json:
        values = self.eigenvalues_mm2
        paired = {"eigenvalues_mm2": np.sort(values)[::-1], "row_eigenvalues_mm2": values}
        return fields(self) | paired


@dataclass(frozen=True, slots=True)
class Reference(Part):
    """The reference last: its name, OM_E (Eq. 6) and its P_c (Eq. 1) in its canonical frame.

    ``om_e`` (3, 3) has the eigenvectors as columns in the canonical frame. Both come from the
    last's printed frame. With another frame Eq. 8 would not put the reference on itself.
    """

    last: str
    om_e: Floats
    centroid_mm: Floats

    not_written = ("centroid_mm",)


@dataclass(frozen=True, slots=True)
class SettledShape:
    """One foot or last whose unit, side and pose are settled; its mesh is not in it.

    Attributes
    ----------
    info : MeshInfo
        With the settled unit; ``vertices`` and ``faces`` count what was scanned, without caps.
    side : SideVerdict
    pose : PoseQuality
    canonical_transform : (4, 4) float64
        From the file's coordinates to the canonical frame in mm; never a mirror.
    length : Measured
        The measure of that name: the length that people read. It has no value if an end was not
        scanned.
    extent_mm : float
        How far the mesh reaches along X below the leg, vertex to vertex: definitions are scaled
        by it.
    stance : LastStance or None
        How a last stands; None of a foot, and if the last's ground is not known.
    standing_transform : (4, 4) float64 or None
        From the canonical frame to the frame in which the shape stands on its ground, in mm: z = 0
        is the ground, x = 0 the rearmost point along it. Of a foot the identity.
    warnings : tuple of Notice
        What was done, and what should be known.
    """

    info: MeshInfo
    side: SideVerdict
    pose: PoseQuality
    canonical_transform: Floats
    length: Measured
    extent_mm: float
    stance: LastStance | None
    standing_transform: Floats | None
    warnings: tuple[Notice, ...]

    @property
    def length_mm(self) -> float | None:
        """The measured length; None if an end was not scanned."""
        return self.length.value


@dataclass(frozen=True, slots=True)
class PreparedScan(SettledShape):
    """One foot or last, as every method takes it: made once per file.

    Cleaned, freed of loose pieces and of the floor plate, its faces outward, its small holes
    closed, its unit settled.

    Attributes
    ----------
    file_vertices_mm : (k, 3) float64
        The scanned vertices in the file's own axes.
    shape : Shape
        The right-side copy in the canonical frame: a left shape is mirrored. What was scanned
        comes first, the caps that close its holes come last. All methods read this one shape.
    kind_margin : float
        How much worse it fits the templates of the other kind, as `PoseQuality` counts.
    """

    file_vertices_mm: Floats
    shape: Shape
    kind_margin: float = 0.0

    @property
    def vertices_mm(self) -> Floats:
        """The vertices (n, 3) of the shape."""
        return self.shape.vertices_mm

    @property
    def faces(self) -> Ints:
        """The faces (m, 3) of the shape."""
        return self.shape.faces

    @property
    def scanned(self) -> tuple[Floats, Ints]:
        """The canonical mesh as it was scanned: on its own side, without caps."""
        vertices_mm = self.vertices_mm[: self.info.vertices]
        faces = self.faces[: self.info.faces]
        if self.side.side != "left":
            return vertices_mm, faces
        return vertices_mm * (1.0, -1.0, 1.0), faces[:, ::-1]


@dataclass(frozen=True, slots=True)
class Alignment(SettledShape, Document):
    """One mesh, aligned.

    ``transform`` (4, 4) takes the file's coordinates to aligned mm (rotation, translation and
    the unit's scale, never a mirror). For method "footfit" it is the ``canonical_transform``.
    ``eigenframe`` is the method's own: of the exact moments for "footfit", by Eq. 1-4 as printed
    for the paper's; "paper-literal" orders its rows by eigenvalue and makes the largest entry of
    each positive. ``printed_frame`` is by Eq. 1-4 as printed and settled, whatever the method.
    ``reference`` is the last whose OM_E was used, None for method "footfit" without one.
    """

    method: Method
    transform: Floats
    eigenframe: Eigenframe
    printed_frame: Eigenframe
    reference: Reference | None

    def scan_keys(self) -> Json:
        """What the document of every scan says: its mesh, its kind, its side, its warnings."""
        about = {"mesh": self.info, **self.kind_keys(), "warnings": self.warnings}
        return about | self.side.to_dict()

    def kind_keys(self) -> Json:
        """Foot or last, and how sure that is."""
        return {"kind": self.pose.kind, "kind_confidence": self.pose.kind_confidence}

    schema = "align/2"

    def _keys(self) -> Json:
        return {
            "mesh": self.info,
            **self.kind_keys(),
            **self.side.to_dict(),
            "method": self.method,
            "transform": self.transform,
            **self.eigenframe.to_dict(),
            "reference": self.reference,
            "pose": self.pose,
            "length_mm": self.length_mm,
            "extent_mm": self.extent_mm,
            "stance": self.stance,
            "standing_transform": self.standing_transform,
            "warnings": self.warnings,
        }


@dataclass(frozen=True, slots=True)
class AlignedScan:
    """An alignment with the prepared scan that it is of."""

    alignment: Alignment
    prepared: PreparedScan

    @property
    def vertices_mm(self) -> Floats:
        """The scanned vertices (n, 3), canonical and not mirrored."""
        return self.prepared.scanned[0]

    @property
    def faces(self) -> Ints:
        """The scanned faces (m, 3), wound outward."""
        return self.prepared.scanned[1]

    def to_dict(self) -> Json:
        """``footfit.align/2``: the alignment; the mesh is in no document."""
        return self.alignment.to_dict()
