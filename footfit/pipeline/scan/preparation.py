"""From a scan to a prepared scan: what every method takes, made once per file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np

from footfit.errors import HalfScan, SideContradicted
from footfit.geometry.flare.levelled_bottom import low_length
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.mesh.holes import ClosedMesh, closed_mesh
from footfit.geometry.mesh.samples import SurfaceSample, gathered_sample, quadrature
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points, nearest_rotation, transform
from footfit.geometry.pose.frame import (
    FRAME,
    canonical_frame,
    length_of,
    origin_shift,
    toe_beyond,
    turned_sample,
)
from footfit.geometry.pose.missing_parts import doubtful_end, missing_part
from footfit.geometry.pose.side import confidence, side_score
from footfit.geometry.stance.cues import NO_LABELS, StanceLabels
from footfit.meshes.resolution import check_resolution, resolution_notices
from footfit.pipeline.scan import settled_unit
from footfit.pipeline.scan.one_shape import PosedShape, shape_in
from footfit.pipeline.scan.standing import last_stance, stance_notices
from footfit.pipeline.scan.trueness import measured
from footfit.results import (
    Confidence,
    Measured,
    MeshInfo,
    Notice,
    PoseQuality,
    PreparedScan,
    Scan,
    SideName,
    SideVerdict,
)


@dataclass(frozen=True, slots=True)
class FramingSettings:
    """How finely the frame is integrated, and when a leg counts as cut low."""

    quadrature_edge: float = 0.03  # over L
    many_points: int = 200_000  # more are gathered: it moved a million's frame by .01 mm, .001 deg
    gathered_edge: float = 0.0025  # over L
    rounds: int = 3  # of the frame from the frame: two poses then agree to 1e-8 mm
    low_leg: float = 0.24  # of L: a scan that ends lower has its leg cut low
    level_deg: float = 0.2  # a stored last that is level across to this is not turned


FRAMING = FramingSettings()
STORED_SHAPES = 32
"""How many stored lasts are kept ready for the next comparison; each takes 0.7 MB."""
_MISSING = {
    "heel": "the shape ends flat or open at the heel, as if cut off there: scan the whole foot",
    "toes": "the shape ends flat or open at the toes, as if cut off there: scan the whole foot",
    "side": "one side is cut off along the foot: scan the whole foot",
    "upper part": "the scan shows only the sole: scan at least 50 mm from the floor up",
}


_OPEN_END = "the surface is open at the {end}, so its length is not known"


def prepared_scan(
    scan: Scan,
    side: Literal["auto", "left", "right"] = "auto",
    known_length_mm: float | None = None,
    labels: StanceLabels = NO_LABELS,
    *,
    force_side: bool = False,
    kind: Literal["auto", "foot", "last"] = "auto",
) -> PreparedScan:
    """The one foot or last of a scan, as every method takes it.

    Parameters
    ----------
    scan : Scan
        Its unit may be provisional (``units_source`` "detected"): the length found confirms or
        corrects it.
    side : {"auto", "left", "right"}
        A side given wins over a doubtful detection, with a notice.
    known_length_mm : float, optional
        The measured length that the shape is scaled to: a stick measures the foot, not its mesh.
    labels : StanceLabels
        What people say of how a last stands.
    force_side : bool
        A side given wins over a sure detection too.
    kind : {"auto", "foot", "last"}
        A kind given wins over the detection.

    Raises
    ------
    SideContradicted
        If the shape surely has another side than the one given.
    NotAFoot, SeveralFeet, HalfScan
        If it is not one whole foot or last.
    UnknownUnits, ImplausibleSize
        If no unit, or not the declared one, gives it a plausible length.
    TooCoarse
        If its file keeps coordinates in steps that are too coarse.
    """
    check_resolution(scan.info.resolution_mm)
    windows = settled_unit.length_windows(scan.info, known_length_mm)
    posed, word = shape_in(scan, windows).with_kind(kind)
    frame = _Frame.of(posed)
    info = settled_unit.info_with_unit(scan.info, frame.extent, frame.length, known_length_mm)
    info = replace(info, vertices=len(posed.vertices), faces=len(posed.faces))
    factor = info.unit_scale / scan.info.unit_scale
    verdict = _verdict(frame, side, forced=force_side)
    right = right_copy(factor * frame.points, frame.closed.faces, verdict.side)
    shape = Shape(*right, frame.quality.kind, labels)
    prepared = PreparedScan(
        info=info,
        side=verdict,
        pose=replace(frame.quality, kind_confidence=word),
        canonical_transform=transform(frame.rotation, factor * frame.shift, info.unit_scale),
        length=_length(frame, factor, shape, info),
        extent_mm=factor * frame.extent,
        stance=last_stance(shape, info),
        standing_transform=shape.standing_transform,
        file_vertices_mm=factor * posed.vertices,
        shape=shape,
        warnings=(),
        kind_margin=posed.pose.kind_margin,
    )
    return replace(prepared, warnings=_notices(scan, posed, frame, prepared))


def on_side(prepared: PreparedScan, side: SideVerdict, notice: Notice) -> PreparedScan:
    """A prepared scan, taken as one of a side that the shape alone did not decide; ``notice`` says
    why.
    """
    mirrored = (side.side == "left") != (prepared.side.side == "left")
    mesh = prepared.vertices_mm, prepared.faces
    shape = Shape(*(right_copy(*mesh, "left") if mirrored else mesh), prepared.pose.kind)
    kept = (each for each in prepared.warnings if each.code != "low_side_confidence")
    return replace(
        prepared,
        side=side,
        shape=shape,
        stance=last_stance(shape, prepared.info),
        standing_transform=shape.standing_transform,
        warnings=(*kept, notice),
    )


def mirror_of(side: SideName | None) -> Floats:
    """The factors (3,) that take points of a right shape to one of a side, and back."""
    return np.array([1.0, -1.0 if side == "left" else 1.0, 1.0])


def right_copy(vertices_mm: Floats, faces: Ints, side: SideName | None) -> tuple[Floats, Ints]:
    """A canonical mesh as a right one: a left mesh is mirrored, its faces turned over.

    It is its own inverse: it takes a right mesh to one of that side, too.
    """
    if side != "left":
        return vertices_mm, faces
    return vertices_mm * mirror_of(side), faces[:, ::-1]


@lru_cache(maxsize=STORED_SHAPES)
def stored_shape(data: bytes, side: SideName | None) -> tuple[Floats, Ints]:
    """A stored last's mesh copy as a right shape, its small holes closed.

    Parameters
    ----------
    data : bytes
        The mesh copy as the catalogue keeps it.
    side : {"left", "right"} or None
        The last's.

    Raises
    ------
    CatalogueDamaged
        The copy is not sound.
    """
    from footfit.meshes.copies.compact_copy import expanded_mesh

    shape = closed_shape(*right_copy(*expanded_mesh(data), side))
    for array in shape:
        array.flags.writeable = False  # the next comparison gets the same arrays
    return shape


def level_turn(vertices_mm: Floats, faces: Ints) -> Floats:
    """What turns a stored last level across its tread, and puts it on z = 0 again, (4, 4).

    Older versions left a last rolled by up to 4 degrees
    ([decision 0213](docs/decisions/0213-a-last-is-level-across-its-tread.md)). A degree moves the
    heel height by .5 mm.
    """
    length = low_length(vertices_mm, FRAME.length_height)[1]
    sample = quadrature(vertices_mm, faces, FRAMING.quadrature_edge * length)
    rotation = np.eye(3)
    for number in range(FRAMING.rounds):
        level = number == FRAMING.rounds - 1
        fine = canonical_frame(turned_sample(sample, rotation), length, last=True, level=level)
        rotation = fine.rotation @ rotation
    roll = float(np.arctan2(rotation[2, 1], rotation[2, 2]))
    if not fine.sole or abs(roll) < np.radians(FRAMING.level_deg):
        return np.eye(4)
    cosine, sine = np.cos(roll), np.sin(roll)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    level_sample = turned_sample(sample, turn)
    ground = float(level_sample.points[:, 2].min())
    return transform(
        turn, np.array([0.0, 0.0, origin_shift(level_sample, ground, length, True)[2]])
    )


def closed_shape(vertices_mm: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """A canonical shape with its small holes closed; the vertices of the caps come last."""
    closed = closed_mesh(vertices_mm, faces, low_length(vertices_mm, FRAME.length_height)[1])
    return closed.vertices, closed.faces


# ---------------------------------------------------------------- the frame


@dataclass(frozen=True, slots=True)
class _Frame:
    """The canonical frame in provisional mm: points = rotation @ vertices + shift, caps included.

    ``closed`` is the shape with its holes closed, ``rims`` where it was open, ``surface`` the whole
    surface as points with areas, ``extent`` how far the mesh reaches along X below the leg, its
    heel below ``back_height`` over the extent and a last's toe at any height, ``length`` the
    measured length, whether or not its ends were scanned, ``open_end`` the end that was not,
    ``top`` the height of the highest scanned point.
    """

    closed: ClosedMesh
    points: Floats
    rims: list[Floats]
    surface: SurfaceSample
    rotation: Floats
    shift: Floats
    extent: float
    length: float
    open_end: str | None
    top: float
    back_height: float
    quality: PoseQuality

    @classmethod
    def of(cls, shape: PosedShape) -> _Frame:
        """Refine the rough pose of a shape, by its surface with its holes closed.

        Raises
        ------
        HalfScan
            A part of it is missing: its length and flare would be another's.
        """
        rough = shape.pose
        closed = closed_mesh(shape.vertices, shape.faces, rough.length)
        about = moved_points(transform(rough.rotation, rough.shift), closed.vertices)
        # The edge in steps of a tenth: two poses of one shape get the same points.
        step = np.round(np.log(rough.length) / np.log(1.1))
        sample = quadrature(about, closed.faces, FRAMING.quadrature_edge * float(1.1**step))
        if len(sample.areas) > FRAMING.many_points:
            sample = gathered_sample(sample, FRAMING.gathered_edge * rough.length)
        rotation, shift, surface, length = np.eye(3), np.zeros(3), sample, rough.length
        is_last = rough.kind == "last"
        for number in range(FRAMING.rounds):  # until the pose that it came from is forgotten
            level = number == FRAMING.rounds - 1
            fine = canonical_frame(surface, length, last=is_last, level=level)
            rotation, shift = fine.rotation @ rotation, fine.rotation @ shift + fine.shift
            turned = turned_sample(sample, rotation)
            surface, length = replace(turned, points=turned.points + shift), fine.length
        shift = rotation @ rough.shift + shift
        rotation = nearest_rotation(rotation @ rough.rotation)
        points = moved_points(transform(rotation, shift), closed.vertices)
        rims = [points[rim] for rim in closed.rims]
        extent = length_of(points, 0.0, fine.length, fine.back_height)
        if is_last:
            extent += toe_beyond(points, fine.length)
        missing = missing_part(surface, rims, extent, fine.back_height)
        if missing is not None:
            raise HalfScan(_MISSING[missing])
        return cls(
            closed=closed,
            points=points,
            rims=rims,
            surface=surface,
            rotation=rotation,
            shift=shift,
            extent=extent,
            length=Shape(points, closed.faces, rough.kind).length_mm,
            open_end=doubtful_end(surface, points, rims, extent, fine.back_height),
            top=float(points[: len(shape.vertices), 2].max()),
            back_height=fine.back_height,
            quality=PoseQuality(rough.cost, rough.margin, fine.support, fine.sole, rough.kind),
        )


def _verdict(frame: _Frame, side: str, *, forced: bool) -> SideVerdict:
    """The side detected, or the one given with what the shape says of it.

    Raises
    ------
    SideContradicted
        The shape surely has another side than the one given, which is not ``forced``.
    """
    score = side_score(frame.surface.points, frame.extent)
    word: Confidence = confidence(score)
    detected: SideName = "right" if score >= 0 else "left"
    if side == "auto":
        return SideVerdict(None if word == "undecided" else detected, word, score, "detected")
    given: SideName = "left" if side == "left" else "right"
    contradicted = word != "undecided" and detected != given
    if contradicted and word == "sure" and not forced:
        raise SideContradicted(
            f"the side is given as {given}, but the shape is surely a {detected} one"
            f" (score {score:+.1f}): check the file and the side, or add --force-side"
        )
    return SideVerdict(given, "low" if contradicted else "sure", score, "given")


# ---------------------------------------------------------------- notices


def _length(frame: _Frame, factor: float, shape: Shape, info: MeshInfo) -> Measured:
    """The measured length; what was not scanned is not known."""
    if frame.open_end is not None:
        return Measured(None, reason=_OPEN_END.format(end=frame.open_end))
    value = MeasureValue(factor * frame.length)
    return measured(measure_named("length"), value, shape.kind, shape.shape_heel_mm, info)


def _notices(
    scan: Scan, posed: PosedShape, frame: _Frame, prepared: PreparedScan
) -> tuple[Notice, ...]:
    """All that should be known of a scan, each once."""
    info, factor = prepared.info, prepared.info.unit_scale / scan.info.unit_scale
    notices = (
        *settled_unit.read_notices(scan, info, prepared.length.value),
        *resolution_notices(info.resolution_mm),
        *posed.notices,
        *_frame_notices(frame, factor, prepared.shape.kind),
        *_kind_notices(prepared.pose),
        *_side_notices(prepared.side),
        *stance_notices(prepared.shape),
        *settled_unit.length_notices(factor * frame.length),
    )
    return tuple(dict.fromkeys(notices))


def _frame_notices(frame: _Frame, factor: float, kind: str) -> Iterator[Notice]:
    """What was closed, and what the frame may suffer from: an open end, no sole, a low leg."""
    extents = frame.closed.extents
    if extents:
        holes = "a hole of" if len(extents) == 1 else f"{len(extents)} holes of up to"
        were = "was" if len(extents) == 1 else "were"
        yield Notice("holes_filled", f"{holes} {factor * extents[0]:.0f} mm {were} bridged")
    if frame.open_end is not None:
        yield Notice("open_end", _OPEN_END.format(end=frame.open_end))
    if not frame.quality.sole:
        yield Notice("no_sole", "there is no sole: the frame rests on the lowest rim")
    if kind == "foot" and frame.top < FRAMING.low_leg * frame.extent:
        yield Notice("leg_cut_low", f"the leg is cut {factor * frame.top:.0f} mm above the floor")


def _kind_notices(pose: PoseQuality) -> tuple[Notice, ...]:
    """A last that may be a foot. What is read as a foot is expected, and hardly ever a last."""
    if pose.kind == "foot" or pose.kind_confidence != "low":
        return ()
    words = "it is taken for a last, but that is not sure: if it is a foot, add --kind foot"
    return (Notice("kind_doubtful", words),)


def _side_notices(verdict: SideVerdict) -> tuple[Notice, ...]:
    """A side that is not sure, or that the shape contradicts."""
    if verdict.confidence == "sure":
        return ()
    score = f"(score {verdict.score:+.1f})"
    if verdict.source == "given":
        surely = "is surely" if confidence(verdict.score) == "sure" else "looks like"
        shape = f"the shape {surely} a {verdict.shown} one {score}"
        words = f"the side is given as {verdict.side}, but {shape}: check the file and the side"
        return (Notice("side_contradicted", words),)
    doubt = "undecided" if verdict.side is None else "not sure"
    words = f"the side is {doubt} {score}: give --side left or --side right"
    return (Notice("low_side_confidence", words),)
