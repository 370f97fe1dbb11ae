"""Align one scan: the canonical frame, the side, the unit, and the paper's frame beside them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from footfit.errors import HalfScan, NoReference
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.mesh.holes import Filled, filled
from footfit.geometry.mesh.moments import (
    moments_along,
    principal_axes,
    surface_centroid,
    surface_second_moment,
)
from footfit.geometry.mesh.samples import SurfaceSample, gathered, quadrature
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import applied, nearest_rotation, transform
from footfit.geometry.pose import paper_frame
from footfit.geometry.pose.frame import canonical_frame, length_of, turned_sample
from footfit.geometry.pose.missing_parts import doubtful_end, missing_part
from footfit.geometry.pose.side import confidence, side_score
from footfit.pipeline.scan.preparation import Posed, posed
from footfit.pipeline.scan.settled_unit import (
    info_with_unit,
    length_notices,
    length_windows,
    read_notices,
)
from footfit.results import (
    AlignedScan,
    Alignment,
    Confidence,
    Eigenframe,
    Measured,
    Method,
    Notice,
    PoseQuality,
    Reference,
    Scan,
    SideName,
    SideVerdict,
)


@dataclass(frozen=True, slots=True)
class AlignSettings:
    """How finely the alignment integrates, and what it takes for a leg cut low."""

    quadrature_edge: float = 0.03  # over L
    many_points: int = 200_000  # more are gathered: a million moved the frame by .01 mm, .001 deg
    gathered_edge: float = 0.0025  # over L
    settling_rounds: int = 2  # more of the frame from the frame: two poses agree to 1e-8 mm
    low_leg: float = 0.24  # of L: what ends lower is a leg cut low


ALIGN = AlignSettings()
_MISSING = {
    "heel": "no heel: the surface ends there in a cut; scan the whole foot",
    "toes": "no toes: the surface ends there in a cut; scan the whole foot",
    "side": "one side is cut off along the foot; scan the whole foot",
    "upper part": "only the lowest part of a foot or last; scan at least 50 mm from the floor up",
}


def aligned(
    scan: Scan,
    *,
    method: Method = "footfit",
    side: Literal["auto", "left", "right"] = "auto",
    reference: Reference | None = None,
    known_length_mm: float | None = None,
) -> AlignedScan:
    """Align one scan.

    Parameters
    ----------
    scan : Scan
        Its unit may be provisional (``units_source`` "detected"): the aligned length confirms or
        corrects it.
    method : {"footfit", "paper", "paper-literal"}
        What ``transform`` is; the canonical frame is found by footfit's method in any case.
    side : {"auto", "left", "right"}
        A side given wins; a contradiction is a warning.
    reference : Reference, optional
        Whose OM_E the paper's methods use.
    known_length_mm : float, optional
        The measured length that the shape is scaled to: a stick measures the foot, not its mesh.

    Returns
    -------
    AlignedScan
        Canonical, not mirrored.

    Raises
    ------
    NotAFoot, SeveralFeet, HalfScan
        If it is not one whole foot or last.
    UnknownUnits, ImplausibleSize
        If no unit, or not the declared one, gives it a plausible length.
    NoReference
        If a paper method is asked for without a reference.
    """
    _require_reference(method, reference)
    shape = posed(scan, length_windows(scan.info, known_length_mm))
    whole = filled(shape.vertices, shape.faces, shape.orientation.length)
    frame = _Framed.of(shape, whole)
    _refuse_half(whole, frame)
    verdict = _verdict(frame, side)
    known = known_length_mm
    info = info_with_unit(scan.info, frame.extent if known is None else frame.length, known)
    info = replace(info, vertices=len(shape.vertices), faces=len(shape.faces))
    factor = info.unit_scale / scan.info.unit_scale
    points_mm = factor * frame.points
    open_ends = _end_notices(whole, frame)
    length = _length(factor * frame.length, open_ends)
    canonical = transform(frame.rotation, factor * frame.shift, info.unit_scale)
    own, printed = _eigenframes(factor * shape.vertices, shape.faces, frame.rotation, method)
    left = verdict.side == "left"
    alignment = Alignment(
        info=info,
        method=method,
        side=verdict,
        transform=_transform(method, canonical, own, info.unit_scale, reference, left=left),
        canonical_transform=canonical,
        eigenframe=own,
        printed_frame=printed,
        pose=frame.quality,
        reference=reference,
        length=length,
        extent_mm=factor * frame.extent,
        warnings=(
            *read_notices(scan, info, length.value),
            *shape.notices,
            *_hole_notices(whole, factor),
            *open_ends,
            *_notices(frame, float(points_mm[:, 2].max()), factor * frame.extent, verdict),
            *length_notices(info, factor * frame.length),
        ),
    )
    return AlignedScan(alignment, points_mm, shape.faces)


# ---------------------------------------------------------------- the frame


@dataclass(frozen=True, slots=True)
class _Framed:
    """The canonical frame in provisional mm: points = rotation @ vertices + shift.

    ``surface`` is the whole surface as points with areas, ``extent`` how far the mesh reaches along
    X below the leg, ``length`` the measured length, whether or not its ends were scanned.
    """

    points: Floats
    surface: SurfaceSample
    rotation: Floats
    shift: Floats
    extent: float
    length: float
    quality: PoseQuality

    @classmethod
    def of(cls, shape: Posed, whole: Filled) -> _Framed:
        """Refine the rough pose of a shape, by its surface without holes."""
        rough = shape.orientation
        about = applied(transform(rough.rotation, rough.shift), whole.vertices)
        # The edge in steps of a tenth: two poses of one shape get the same points.
        step = np.round(np.log(rough.length) / np.log(1.1))
        edge = ALIGN.quadrature_edge * float(1.1**step)
        sample = quadrature(about, whole.faces, edge)
        if len(sample.areas) > ALIGN.many_points:
            sample = gathered(sample, ALIGN.gathered_edge * rough.length)
        fine = canonical_frame(sample, rough.length)
        rotation, shift = fine.rotation, fine.shift
        for _ in range(ALIGN.settling_rounds):  # until the pose it came from is forgotten
            turned = turned_sample(sample, rotation)
            surface = replace(turned, points=turned.points + shift)
            fine = canonical_frame(surface, fine.length)
            rotation, shift = fine.rotation @ rotation, fine.rotation @ shift + fine.shift
        turned = turned_sample(sample, rotation)
        surface = replace(turned, points=turned.points + shift)
        shift = rotation @ rough.shift + shift
        rotation = nearest_rotation(rotation @ rough.rotation)
        points = applied(transform(rotation, shift), whole.vertices)
        quality = PoseQuality(rough.cost, rough.margin, fine.support, fine.sole, rough.kind)
        extent = length_of(points, 0.0, fine.length)
        length = Shape(points, whole.faces, rough.kind).length_mm
        points = points[: len(shape.vertices)]
        return cls(points, surface, rotation, shift, extent, length, quality)


def _refuse_half(whole: Filled, frame: _Framed) -> None:
    """Raise HalfScan where a part was cut off, since length and flare would be another's."""
    rims = [frame.points[rim] for rim in whole.rims]
    missing = missing_part(frame.surface, rims, frame.extent)
    if missing is not None:
        raise HalfScan(_MISSING[missing])


def _end_notices(whole: Filled, frame: _Framed) -> list[Notice]:
    """The end, if any, that may be longer than it was scanned."""
    end = doubtful_end(frame.surface, [frame.points[rim] for rim in whole.rims], frame.extent)
    if end is None:
        return []
    return [Notice("open_end", f"the surface is open at the {end}: its length may be short")]


def _length(length_mm: float, open_ends: Sequence[Notice]) -> Measured:
    """The measured length; no value, with the reason, where an end was not scanned."""
    if open_ends:
        return Measured(None, reason=open_ends[0].message)
    return Measured(length_mm, measure_named("length").sd)


def _verdict(frame: _Framed, side: str) -> SideVerdict:
    """The side detected, or the one given with what the shape says of it."""
    score = side_score(frame.surface.points, frame.extent).score
    word: Confidence = confidence(score)
    detected: SideName = "right" if score >= 0 else "left"
    if side == "auto":
        return SideVerdict(None if word == "undecided" else detected, word, score, "detected")
    given: SideName = "left" if side == "left" else "right"
    contradicted = word != "undecided" and detected != given
    return SideVerdict(given, "low" if contradicted else "sure", score, "given")


def _hole_notices(whole: Filled, factor: float) -> list[Notice]:
    """What was closed, if anything."""
    if not whole.extents:
        return []
    count, widest_mm = len(whole.extents), factor * whole.extents[0]
    holes = "a hole" if count == 1 else f"{count} holes"
    return [Notice("holes_filled", f"{holes} of up to {widest_mm:.0f} mm bridged")]


def _notices(frame: _Framed, top_mm: float, extent_mm: float, verdict: SideVerdict) -> list[Notice]:
    """What the alignment found that a person should know."""
    found = []
    if not frame.quality.sole:
        found.append(Notice("no_sole", "there is no sole: the frame rests on the lowest rim"))
    if top_mm < ALIGN.low_leg * extent_mm:
        found.append(Notice("leg_cut_low", f"the scan ends {top_mm:.0f} mm above the floor"))
    if verdict.source == "detected" and verdict.confidence != "sure":
        found.append(
            Notice(
                "low_side_confidence",
                f"left or right is {verdict.confidence}"
                f" (score {verdict.score:.2f}); say --side left|right",
            )
        )
    if verdict.source == "given" and verdict.confidence == "low":
        found.append(
            Notice(
                "side_contradicted",
                f"given as {verdict.side}, but the shape looks like the other"
                f" (score {verdict.score:.2f})",
            )
        )
    return found


# ---------------------------------------------------------------- the paper's frame


def _eigenframes(
    vertices_mm: Floats, faces: Ints, rotation: Floats, method: Method
) -> tuple[Eigenframe, Eigenframe]:
    """The method's own frame, and the one by Eq. 1-4 as printed, settled."""
    P_c, C_M, R = paper_frame.printed_axes(vertices_mm, faces)
    printed = _paired(P_c, paper_frame.settled(R, rotation), C_M)
    if method == "paper":
        return printed, printed
    if method == "paper-literal":
        return _paired(P_c, paper_frame.largest_positive(R), C_M), printed
    moment = surface_second_moment(vertices_mm, faces)
    rows = paper_frame.settled(principal_axes(moment)[1], rotation)
    return _paired(surface_centroid(vertices_mm, faces), rows, moment), printed


def _paired(centroid_mm: Floats, rows: Floats, moment_mm2: Floats) -> Eigenframe:
    return Eigenframe(centroid_mm, rows, moments_along(moment_mm2, rows))


def _require_reference(method: Method, reference: Reference | None) -> None:
    if method != "footfit" and reference is None:
        raise NoReference(
            f"method {method} needs a reference last; ingest one or run footfit set-reference LAST"
        )


def _transform(
    method: Method,
    canonical: Floats,
    frame: Eigenframe,
    unit_scale: float,
    reference: Reference | None,
    *,
    left: bool,
) -> Floats:
    """The transform of the method, never a mirror, though Eq. 1-8 see a left shape mirrored."""
    if method == "footfit" or reference is None:
        return canonical
    P_c, R = frame.centroid_mm, frame.eigenvectors
    if left:
        P_c, R = paper_frame.mirrored_frame(P_c, R)
    literal, onto = method == "paper-literal", (reference.om_e, reference.centroid_mm)
    moved = paper_frame.paper_transform(P_c, R, *onto, unit_scale, literal=literal)
    return paper_frame.unmirrored(moved, mirrored=left)
