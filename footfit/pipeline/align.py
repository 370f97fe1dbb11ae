"""Align one scan: the canonical frame, the side, the unit, and the paper's frame beside them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from footfit.errors import HalfScan, ImplausibleSize, NoReference, UnknownUnits
from footfit.geometry import wpca
from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.ends import missing_end, rims_of
from footfit.geometry.frame import canonical_frame, length_of, turned_sample
from footfit.geometry.moments import (
    principal_axes,
    printed_covariance,
    surface_centroid,
    surface_second_moment,
    vertex_mean,
)
from footfit.geometry.rotations import nearest_rotation, transform
from footfit.geometry.samples import SurfaceSample, quadrature
from footfit.geometry.side import confidence, side_score
from footfit.pipeline.prepare import Posed, Windows, posed
from footfit.results import (
    AlignedScan,
    Alignment,
    Confidence,
    Eigenframe,
    MeshInfo,
    Method,
    Notice,
    PoseQuality,
    Reference,
    Scan,
    SideName,
    SideVerdict,
)

MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}


@dataclass(frozen=True, slots=True)
class AlignSettings:
    """What the alignment takes for plausible, in mm, and how finely it integrates."""

    usual_length_mm: tuple[float, float] = (180.0, 340.0)
    possible_length_mm: tuple[float, float] = (115.0, 370.0)
    window_slack: float = 0.15  # the rough pose's length is only so good
    quadrature_edge: float = 0.03  # over L
    low_leg: float = 0.24  # of L: what ends lower is a leg cut low


ALIGN = AlignSettings()


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
        The length along X that the shape is scaled to.

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
    if method != "footfit" and reference is None:
        raise NoReference(
            f"method {method} needs a reference last; ingest one or run footfit set-reference LAST"
        )
    shape = posed(scan, length_windows(scan.info, known_length_mm))
    frame = _Framed.of(shape)
    _refuse_half(shape, frame)
    info = _info_with_unit(scan.info, frame.length, known_length_mm)
    factor = info.unit_scale / scan.info.unit_scale
    canonical_mm = factor * frame.points
    verdict = _verdict(frame, side)
    mirrored = verdict.side == "left"
    canonical = transform(frame.rotation, factor * frame.shift, info.unit_scale)
    eigenframe = _eigenframe(factor * shape.vertices, shape.faces, frame.rotation, method)
    alignment = Alignment(
        info=replace(info, vertices=len(shape.vertices), faces=len(shape.faces)),
        method=method,
        side=verdict,
        transform=_transform(method, eigenframe, canonical, info.unit_scale, reference, mirrored),
        canonical_transform=canonical,
        eigenframe=eigenframe,
        pose=frame.quality,
        reference=reference,
        length_mm=factor * frame.length,
        warnings=(
            *_read_notices(scan, info),
            *shape.notices,
            *_notices(frame, canonical_mm, factor * frame.length, verdict, info),
        ),
    )
    return AlignedScan(alignment, canonical_mm, shape.faces)


# ---------------------------------------------------------------- the unit


def length_windows(info: MeshInfo, known_length_mm: float | None) -> Windows:
    """Lengths that are plausible, in the scan's provisional mm; none where the scale is unknown."""
    if known_length_mm is not None or info.units_source == "known-length":
        return ()
    low, high = ALIGN.possible_length_mm
    scales = [info.unit_scale]
    if info.units_source == "detected":
        low, high = ALIGN.usual_length_mm
        scales = list(MM_PER_UNIT.values())
    low, high = low * (1 - ALIGN.window_slack), high * (1 + ALIGN.window_slack)
    return tuple((low * info.unit_scale / s, high * info.unit_scale / s) for s in scales)


def _info_with_unit(info: MeshInfo, length: float, known_length_mm: float | None) -> MeshInfo:
    """The info with the unit that the aligned length (provisional mm) confirms.

    Raises
    ------
    UnknownUnits, ImplausibleSize
    """
    if known_length_mm is not None:
        scale = info.unit_scale * known_length_mm / length
        return replace(info, units="scaled", units_source="known-length", unit_scale=scale)
    low, high = ALIGN.usual_length_mm
    if info.units_source == "detected":
        for name, scale in MM_PER_UNIT.items():
            if low <= length * scale / info.unit_scale <= high:
                return replace(info, units=name, unit_scale=scale)
        raise UnknownUnits(
            f"no unit makes the length ({length / info.unit_scale:.4g} in the file) {low:.0f}-"
            f"{high:.0f} mm; say --units mm|cm|m|in or --known-length MM"
        )
    least, most = ALIGN.possible_length_mm
    if info.units_source == "declared" and not least <= length <= most:
        raise ImplausibleSize(
            f"in {info.units} the length is {length:.4g} mm, which is no foot's or last's"
            f" ({least:.0f}-{most:.0f} mm); check --units, or say --known-length MM"
        )
    return info


def _read_notices(scan: Scan, info: MeshInfo) -> list[Notice]:
    """What the reader said, with the unit put right where the aligned length tells another."""
    if info.units_source != "detected" or info.units == scan.info.units:
        return list(scan.warnings)
    kept = [notice for notice in scan.warnings if notice.code != "units_detected"]
    return [*kept, Notice("units_detected", f"unit taken as {info.units}, by the length")]


# ---------------------------------------------------------------- the frame


@dataclass(frozen=True, slots=True)
class _Framed:
    """The canonical frame in provisional mm: points = rotation @ vertices + shift.

    ``surface`` is the whole surface as points with areas.
    """

    points: Floats
    surface: SurfaceSample
    rotation: Floats
    shift: Floats
    length: float
    quality: PoseQuality

    @classmethod
    def of(cls, shape: Posed) -> _Framed:
        """Refine the rough pose of a shape."""
        rough = shape.orientation
        about = shape.vertices @ rough.rotation.T + rough.shift
        edge = ALIGN.quadrature_edge * rough.length
        sample = quadrature(about, shape.faces, edge)
        fine = canonical_frame(sample, rough.length)
        turned = turned_sample(sample, fine.rotation)
        surface = replace(turned, points=turned.points + fine.shift)
        rotation = nearest_rotation(fine.rotation @ rough.rotation)
        shift = fine.rotation @ rough.shift + fine.shift
        points = shape.vertices @ rotation.T + shift
        quality = PoseQuality(rough.cost, rough.margin, fine.support, fine.sole, rough.kind)
        length = length_of(points, 0.0, fine.length)
        return cls(points, surface, rotation, shift, length, quality)


def _refuse_half(shape: Posed, frame: _Framed) -> None:
    """Raise HalfScan where an end was cut off, since length and flare would be another's."""
    rims = rims_of(frame.points, shape.faces)
    missing = missing_end(frame.surface, rims, frame.length)
    if missing is not None:
        raise HalfScan(f"no {missing}: the surface ends there in a cut; scan the whole foot")


def _verdict(frame: _Framed, side: str) -> SideVerdict:
    """The side detected, or the one given with what the shape says of it."""
    score = side_score(frame.surface.points, frame.length).score
    word: Confidence = confidence(score)
    detected: SideName = "right" if score >= 0 else "left"
    if side == "auto":
        return SideVerdict(None if word == "undecided" else detected, word, score, "detected")
    given: SideName = "left" if side == "left" else "right"
    contradicted = word != "undecided" and detected != given
    return SideVerdict(given, "low" if contradicted else "sure", score, "given")


def _notices(
    frame: _Framed, points_mm: Floats, length_mm: float, verdict: SideVerdict, info: MeshInfo
) -> list[Notice]:
    """What the alignment found that a person should know."""
    found = []
    top = float(points_mm[:, 2].max())
    low, high = ALIGN.usual_length_mm
    if not frame.quality.sole:
        found.append(Notice("no_sole", "there is no sole: the frame rests on the lowest rim"))
    if frame.quality.kind == "foot" and top < ALIGN.low_leg * length_mm:
        found.append(Notice("leg_cut_low", f"the scan ends {top:.0f} mm above the floor"))
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
    if info.units_source != "detected" and not low <= length_mm <= high:
        found.append(
            Notice(
                "length_unusual", f"the length is {length_mm:.1f} mm, outside {low:.0f}-{high:.0f}"
            )
        )
    return found


# ---------------------------------------------------------------- the paper's frame


def _eigenframe(vertices_mm: Floats, faces: Ints, rotation: Floats, method: Method) -> Eigenframe:
    """Centroid and axes: exact for "footfit", by Eq. 1-4 as printed for the paper's methods."""
    exact = method == "footfit"
    moment = surface_second_moment if exact else printed_covariance
    values, rows = principal_axes(moment(vertices_mm, faces))
    if method == "paper-literal":
        axes = wpca.largest_positive(rows)
    else:
        axes = wpca.settled(rows, rotation)
    centroid = surface_centroid(vertices_mm, faces) if exact else vertex_mean(vertices_mm)
    return Eigenframe(centroid, axes, values)


def _transform(
    method: Method,
    eigenframe: Eigenframe,
    canonical: Floats,
    unit_scale: float,
    reference: Reference | None,
    mirrored: bool,
) -> Floats:
    """The transform of the method; never a mirror."""
    if method == "footfit" or reference is None:
        return canonical
    target = reference.om_e, reference.centroid_mm
    if method == "paper":
        of_mirrored = wpca.paper_transform(
            eigenframe.centroid_mm, eigenframe.eigenvectors, unit_scale, *target, mirrored=mirrored
        )
    else:
        of_mirrored = wpca.literal_transform(
            eigenframe.centroid_mm, unit_scale, *target, mirrored=mirrored
        )
    return wpca.unmirrored(of_mirrored, mirrored=mirrored)
