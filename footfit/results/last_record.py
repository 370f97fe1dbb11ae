"""A last as the catalogue holds it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import fields as dataclass_fields
from typing import TYPE_CHECKING, Literal

from footfit.geometry.fit import sizes
from footfit.geometry.fit.along_the_bottom import ALONG_BOTTOM, LastLengths, length_along_bottom
from footfit.results.profile import flare_part
from footfit.results.values import (
    Document,
    Json,
    Measured,
    Notice,
    Part,
    fields,
    in_mm,
    measures_part,
    part,
)

if TYPE_CHECKING:
    from footfit.geometry.flare.definition import FlareProfile
    from footfit.geometry.numeric.arrays import Floats
    from footfit.results.alignment import Eigenframe, PoseQuality, SideVerdict
    from footfit.results.meshes import MeshInfo
    from footfit.results.values import Measure


ALONG_BOTTOM_NAME = "length along the bottom"
"""What the length is called that a label of a last with a heel is compared with."""


@dataclass(frozen=True, slots=True)
class LastLabels:
    """What people say of a last. It is kept as given; the geometry has the last word.

    ``heel_height_mm`` is over the ground, ``platform_mm`` the height of the forepart over it.
    """

    name: str
    style: str | None = None
    size: str | None = None
    size_system: str | None = None
    width_label: str | None = None
    heel_height_mm: float | None = None
    family: str | None = None
    parent: str | None = None
    toe_spring_mm: float | None = None
    platform_mm: float | None = None


@dataclass(frozen=True, slots=True)
class LastRecord:
    """A last as the catalogue holds it, without its mesh.

    ``eigenframe`` is of the exact moments, ``printed_frame`` by Eq. 1-4 as printed.
    ``paper_transform`` (4, 4) takes the file's coordinates (mirrored in its first axis for a
    left last) to the reference's frame by the paper's Eq. 8, from the printed frames; None if
    there is no reference.
    ``extent_mm`` is how far the mesh reaches along X; definitions are scaled by it.
    ``standing_transform`` (4, 4) takes the canonical right frame to the standing one, whose ground
    is sure to ``ground_sd_deg``; ``stance_by`` is "label" or "shape". They are None if it is not
    known how the last stands.
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
    extent_mm: float
    flare: FlareProfile
    measures: tuple[Measure, ...]
    warnings: tuple[Notice, ...]
    upgraded_from: str | None = None
    standing_transform: Floats | None = None
    ground_sd_deg: float | None = None
    stance_by: str | None = None

    @property
    def length(self) -> Measured:
        """The measured length, which people read; it has no value if an end was not scanned."""
        rows = (row.measured for row in self.measures if row.name == "length")
        return next(rows, Measured(None, reason="the catalogue holds no length of this last"))

    @property
    def length_mm(self) -> float | None:
        """The value of ``length``."""
        return self.length.value

    def value_of(self, measure: str) -> float | None:
        """The value of a measure; None if it has none."""
        return next((row.measured.value for row in self.measures if row.name == measure), None)

    @property
    def heel_height_mm(self) -> float | None:
        """The heel height over the ground: as labelled, else as measured."""
        labelled = self.labels.heel_height_mm
        return self.value_of("heel_height") if labelled is None else labelled

    @property
    def drop_mm(self) -> float | None:
        """How much higher the heel stands than the forepart: as labelled, else as measured."""
        if self.labels.heel_height_mm is not None:
            return self.labels.heel_height_mm - (self.labels.platform_mm or 0.0)
        return self.value_of("heel_height")

    @property
    def label_check(self) -> sizes.LabelCheck | None:
        """The label compared with the length; None if the label gives no number.

        The length is that along the bottom, which depends neither on the heel nor on the cone. Of a
        level last, and of one whose bottom is not measured, it is the length at rest.
        """
        if self.labels.size is None:
            return None
        return sizes.label_check(
            self.labels.size, self.labels.size_system, *self._length_of_a_size()
        )

    def _length_of_a_size(self) -> tuple[float | None, str]:
        """The length that a size label goes with, in mm, and what it is called."""
        at_rest_mm = self.length_mm
        values = [self.value_of(known.name) for known in dataclass_fields(LastLengths)]
        known = [value for value in values if value is not None]
        if at_rest_mm is None or len(known) < len(values):
            return at_rest_mm, sizes.LENGTH_NAME
        lengths = LastLengths(*known)
        if lengths.heel_height <= ALONG_BOTTOM.level_mm:
            return at_rest_mm, sizes.LENGTH_NAME
        along_mm = float(length_along_bottom(at_rest_mm, lengths)[0])
        raised = lengths.heel_height >= ALONG_BOTTOM.raised_mm
        return along_mm, ALONG_BOTTOM_NAME if raised else sizes.LENGTH_NAME

    @property
    def label_notices(self) -> tuple[Notice, ...]:
        """A notice if the size on the label is more than a size from the length."""
        check = self.label_check
        if check is None or not check.flagged:
            return ()
        return (Notice("size_contradicted", sizes.label_words(check)),)

    @property
    def notices(self) -> tuple[Notice, ...]:
        """All that should be known of it: the stored warnings, and what the labels contradict."""
        return (*self.warnings, *self.label_notices)

    def entry(self, reference: str | None) -> Json:
        """One line of the library: labels as given, geometry as measured."""
        labels = fields(self.labels)
        return part(
            {
                "last": labels.pop("name"),
                **labels,
                "side": self.side.side,
                "length_mm": self.length_mm,
                "extent_mm": self.extent_mm,
                "label_check": _label_part(self.label_check),
                "flare_angle_deg": self.flare.angle_deg,
                "class": self.flare.flare_class,
                "reference": self.labels.name == reference,
            }
        )


def _label_part(check: sizes.LabelCheck | None) -> Json | None:
    if check is None:
        return None
    return part(
        {
            "size_by_length": check.by_length,
            "off_sizes": check.off,
            "flagged": check.flagged,
            "words": sizes.label_words(check) if check.flagged else None,
        }
    )


MadeBy = Literal["customise", "grade"]


@dataclass(frozen=True, slots=True)
class Target(Part):
    """A measure that a made last should have: the base's, what was asked for, what was reached.

    ``unit`` is "mm" or "deg"; ``base`` and ``reached`` are None if they could not be measured.
    """

    name: str
    unit: str
    base: float | None
    target: float
    reached: float | None

    def _keys(self) -> Json:
        return in_mm(fields(self))


@dataclass(frozen=True, slots=True)
class Parentage(Part):
    """How a last was made from another one.

    ``base`` and ``base_sha256`` are the name of the base and the hash of its file. A custom last
    has the hash of the foot's file, and the fit profile with its version and its hash. A graded
    last has the name of its rule. ``figures`` are plain values: what it was made with.
    """

    base: str
    base_sha256: str
    made_by: MadeBy
    targets: tuple[Target, ...]
    figures: Mapping[str, object]
    foot_sha256: str | None = None
    profile: str | None = None
    profile_version: int | None = None
    profile_sha256: str | None = None
    rule: str | None = None


@dataclass(frozen=True, slots=True)
class StoredLast(Document):
    """One last of a catalogue, and which last is the catalogue's reference, if any.

    ``paper_frame_angle_deg`` is how far the paper's frame is turned from footfit's; it needs a
    reference. ``parentage`` is None unless the last was made from another one.
    """

    record: LastRecord
    reference: str | None
    paper_frame_angle_deg: float | None = None
    parentage: Parentage | None = None

    schema = "show-last/2"

    def _keys(self) -> Json:
        record = self.record
        return {
            **record.entry(self.reference),
            "parentage": self.parentage,
            "mesh": record.info,
            **record.side.to_dict(),
            **flare_part(record.flare),
            "centre_line": record.flare.centre_line,
            "upgraded_from": record.upgraded_from,
            "measures": measures_part(record.measures),
            "transform": record.canonical_transform,
            "standing_transform": record.standing_transform,
            "ground_sd_deg": record.ground_sd_deg,
            "stance_by": record.stance_by,
            "paper_transform": record.paper_transform,
            "paper_frame_angle_deg": self.paper_frame_angle_deg,
            **record.eigenframe.to_dict(),
            "printed_frame": record.printed_frame,
            "pose": record.pose,
            "warnings": record.notices,
        }
