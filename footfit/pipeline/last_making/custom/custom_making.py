"""Making a custom last: from a base to a last with the allowances of a fit profile for a foot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field, replace

import numpy as np

from footfit import results
from footfit.errors import OutOfReach
from footfit.geometry.deform.field import Field
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.surface import face_normals, vertex_normals
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots
from footfit.geometry.search.pose_search import RoughPose
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit.zones import TOE_BOX
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import (
    FOLLOWING,
    LENGTH,
    CustomAim,
    CustomQuestion,
    custom_aims,
    fit_in,
)
from footfit.pipeline.last_making.custom.custom_field import (
    CUSTOM,
    CustomShape,
    custom_shape,
    first_field,
    missed,
    room_bumps,
    with_room,
)
from footfit.pipeline.last_making.custom.custom_reading import aims_read, tape_plane, value_mm
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.preparation import prepared_scan, right_copy
from footfit.pipeline.scan.reading import read
from footfit.pipeline.scan.standing import stance_labels
from footfit.results import LastLabels, Parentage, Profiled, SideName, Target
from footfit.results.last_making.custom_last import CustomLast

SETTLED_MM = (0.1, CUSTOM.met_mm, CUSTOM.met_mm, CUSTOM.met_mm)
"""The finished last is made again if it reads so far from a target: by the tries before."""
TOE_FROM = 0.93
BACK_TO, BACK_WIDTH_MM = 0.10, 6.0
"""The back curve runs along the middle of what lies behind this share of the arc."""


@dataclass(frozen=True, slots=True)
class Making:
    """How a custom last is made, beside the fit that is asked for.

    ``rooms_mm`` is the room that single places get, ``name`` that of the new last.
    """

    question: CustomQuestion
    rooms_mm: Mapping[str, float] = field(default_factory=dict)
    name: str = "custom"


@dataclass(frozen=True)
class MadeLast:
    """A custom last as its file has it: the record, the right shape, and the file's vertices.

    ``to_file`` (4, 4) takes the shape's canonical right frame to the axes of the file.
    """

    record: results.LastRecord
    shape: Shape
    vertices_mm: Floats
    faces: Ints
    to_file: Floats


@dataclass(frozen=True)
class Attempt:
    """A changed base and the last made of it, with ``room_mm`` (aims,) that single places add."""

    aims: Sequence[CustomAim]
    shape: CustomShape
    made: MadeLast
    room_mm: Floats
    turn_deg: float
    mirrored: bool


def customised(
    foot: Profiled, base: BaseLast, making: Making, side: SideName | None = None
) -> CustomLast:
    """The base, changed to fit a foot; on the other ``side`` if one is given.

    Raises
    ------
    OutOfReach
        A target is out of reach of the base; the message names the measure.
    BadOption
        A place for room is not known, or its room is too large.
    """
    aims = custom_aims(foot, base, making.question)
    if not aims:
        raise OutOfReach("no measure of the foot can be compared with the base: scan it again")
    made = _made_to(foot, base, making, aims, side)
    zones = {zone.name: (zone.base_verdict, zone.custom_verdict) for zone in made.judged}
    worse = [name for name in sorted(TOE_BOX) if name in zones and zones[name][0] == "good"]
    worse = [name for name in worse if zones[name][1] != "good"]
    if not worse or zones[LENGTH][0] != "good":
        return made
    # The toe box moves with the length. The base's toe room is good too, so it is kept.
    aims = tuple(replace(a, target=a.base) if a.measure == LENGTH else a for a in aims)
    kept = _made_to(foot, base, making, aims, side)
    words = "the toe room stays as it is in the base: at the profile's target the toe box would fit"
    notice = results.Notice("toe_room_kept", f"{words} worse")
    return replace(kept, warnings=(*kept.warnings, notice))


def _made_to(
    foot: Profiled,
    base: BaseLast,
    making: Making,
    aims: Sequence[CustomAim],
    side: SideName | None,
) -> CustomLast:
    """The base, changed to these aims."""
    own: SideName = foot.aligned.alignment.side.side or "right"
    turn_deg = _flare_turn_deg(foot, base, making)
    start = first_field(base, turn_deg, bottom_kept=making.question.bottom_kept)
    bumps = room_bumps(base.shape, start.chart, making.rooms_mm)
    shifts = room = np.zeros(len(aims))
    made_side = side or own
    firm = np.array([aim.firm for aim in aims])
    tries: list[tuple[float, CustomShape, MadeLast, Floats]] = []
    for settled_mm in SETTLED_MM:
        with suppress(OutOfReach) if tries else nullcontext():
            shape = custom_shape(base, aims, start, shifts)
            made = made_last(base, shape.vertices_mm, made_side, making.name)
            reached = aims_read(made.shape, aims, base)
            off = np.where(firm, reached - _asked(base, aims, shape), 0.0)
            tries.append((float(np.abs(off).max()), shape, made, reached))
            shifts = shifts - off
        if tries[-1][0] <= settled_mm:
            break
    _, shape, made, reached = min(tries, key=lambda each: each[0])
    if bumps:  # room is given on top of the targets, which are met without it
        shape = with_room(base, aims, shape, bumps)
        made = made_last(base, shape.vertices_mm, made_side, making.name)
        room = np.where(firm, aims_read(made.shape, aims, base) - reached, 0.0)
    attempt = Attempt(aims, shape, made, room, turn_deg, made_side != own)
    return _answer(foot, base, making, attempt)


def _asked(base: BaseLast, aims: Sequence[CustomAim], shape: CustomShape) -> Floats:
    """What each aim should read; one that only follows, what it came to."""
    own = aims_read(base.shape, aims, base)
    firm = np.array([aim.target - aim.base for aim in aims]) + own
    return np.where([aim.firm for aim in aims], firm, shape.solved.values_mm)


def _flare_turn_deg(foot: Profiled, base: BaseLast, making: Making) -> float:
    """By how much the plan is turned towards the foot's flare; limited."""
    follow = making.question.flare_follow
    if follow == 0.0:
        return 0.0
    zones = fit_in(foot, base.record, base, making.question).zones
    known = next((zone for zone in zones if zone.zone == "flare"), None)
    if known is None or known.clearance.value is None:
        return 0.0
    turn_deg = follow * (known.target - known.clearance.value)
    return float(np.clip(turn_deg, -CUSTOM.flare_deg, CUSTOM.flare_deg))


def made_last(base: BaseLast, vertices_mm: Floats, side: SideName, name: str) -> MadeLast:
    """The right vertices (n, 3) of a changed base as a last of one side, read again from its file.

    The pose is known, so it is not searched for. The labels of how the base stands stay.
    """
    vertices_mm, faces = right_copy(vertices_mm, base.shape.faces, side)
    data = encoded_mesh(vertices_mm, faces, "stl")
    scan = read(Source(None, data), ReadingOptions(units="mm"))
    quality = base.record.pose
    length_mm = base.shape.length_mm
    pose = RoughPose(
        np.eye(3), np.zeros(3), length_mm, quality.cost, quality.margin, "last", accepted=True
    )
    old = base.record.labels
    labels = LastLabels(
        name,
        style=old.style,
        family=old.family,
        heel_height_mm=old.heel_height_mm,
        toe_spring_mm=old.toe_spring_mm,
        platform_mm=old.platform_mm,
    )
    prepared = prepared_scan(replace(scan, pose=pose), side, labels=stance_labels(labels))
    record = last_record(profiled_scan(aligned_scan(prepared)), labels)
    mirror = np.diag([1.0, -1.0 if side == "left" else 1.0, 1.0, 1.0])
    to_file = np.linalg.inv(mirror @ prepared.canonical_transform)
    return MadeLast(record, prepared.shape, vertices_mm, faces, np.asarray(to_file, np.float64))


def _answer(foot: Profiled, base: BaseLast, making: Making, attempt: Attempt) -> CustomLast:
    """The result of what was made."""
    question, profile = making.question, making.question.profile
    made, shape = attempt.made, attempt.shape
    sections = kept_sections(made.shape)
    before = fit_in(foot, base.record, base, question)
    kept_base = replace(base, sections=sections)
    after = fit_in(foot, made.record, kept_base, question)
    zones = _zones(base, attempt)
    side = made.record.side.side or "right"
    mirror = np.array([1.0, -1.0 if side == "left" else 1.0, 1.0])
    base_vertices_mm = base.shape.vertices_mm * mirror
    shift = made.vertices_mm - base_vertices_mm
    outward = vertex_normals(base_vertices_mm, made.faces)
    info = foot.aligned.alignment.info
    heel = before.heel
    kept, toe_shift_mm = _kept(shape.solved.field, base.shape, shape.vertices_mm)
    return CustomLast(
        base=base.name,
        base_sha256=base.record.info.sha256,
        base_mesh=base.mesh,
        foot=info.path,
        foot_sha256=info.sha256,
        side=side,
        mirrored=attempt.mirrored,
        profile=profile.name,
        profile_version=profile.version,
        profile_sha256=profile.sha256,
        heel=heel,
        zones=zones,
        judged=_judged(before, after),
        kept=kept,
        toe_shift_mm=toe_shift_mm,
        flare_turn_deg=attempt.turn_deg,
        largest_move_mm=float(np.linalg.norm(shift, axis=1).max()),
        least_determinant=shape.least_determinant,
        warnings=(*missed(zones), *_notices(base, after, bottom_kept=question.bottom_kept)),
        record=made.record,
        sections=sections,
        parentage=_parentage(foot, base, making, zones),
        vertices_mm=made.vertices_mm,
        base_vertices_mm=base_vertices_mm,
        faces=made.faces,
        moved_mm=row_dots(shift, outward),
    )


def _zones(base: BaseLast, attempt: Attempt) -> tuple[results.CustomZone, ...]:
    """Each aim with what was reached, without the girths that are only pulled along."""
    aims, made = attempt.aims, attempt.made
    asked = _asked(base, aims, attempt.shape) + attempt.room_mm
    zones = []
    for aim, wanted, room in zip(aims, asked.tolist(), attempt.room_mm.tolist(), strict=True):
        if not aim.firm and aim.measure not in FOLLOWING:
            continue
        value = value_mm(made.shape, aim.measure, base)
        reached = made.shape.length_mm if aim.measure == LENGTH else value
        wanted = wanted if aim.firm else value
        zones.append(
            results.CustomZone(
                name=aim.measure,
                zone=aim.zone,
                unit="mm",
                foot=aim.foot,
                allowance=aim.allowance,
                base=aim.base,
                target=reached - (value - wanted),
                reached=reached,
                room=room if aim.firm else 0.0,
                follows=not aim.firm,
                plane=_plane(made, aim.measure),
            )
        )
    return tuple(zones)


def _plane(made: MadeLast, measure: str) -> results.GirthPlane | None:
    """The plane of a girth in the axes of the written file."""
    plane = tape_plane(made.shape, measure)
    if plane is None:
        return None
    point = made.to_file[:3, :3] @ plane.origin + made.to_file[:3, 3]
    normal = made.to_file[:3, :3] @ plane.normal
    x, y, z = point.tolist()
    a, b, c = (normal / np.linalg.norm(normal)).tolist()
    return results.GirthPlane((x, y, z), (a, b, c))


def _judged(before: results.FootFit, after: results.FootFit) -> tuple[results.JudgedZone, ...]:
    """Each zone of the profile in the base and in the custom last."""
    return tuple(
        results.JudgedZone(
            name=old.zone,
            label=old.label,
            unit=old.unit,
            target=old.target,
            base=old.clearance.value,
            base_verdict=old.verdict,
            custom=new.clearance.value,
            custom_verdict=new.verdict,
        )
        for old, new in zip(before.zones, after.zones, strict=True)
    )


def _kept(
    field: Field, base: Shape, vertices_mm: Floats
) -> tuple[tuple[results.KeptPlace, ...], float]:
    """How far the parts that stay moved, and how far the toe moved ahead as a whole.

    Without the room for single places, which is no part of ``field``.
    """
    chart = field.chart
    before, after = chart.standing(base.vertices_mm), chart.standing(vertices_mm)
    shift = after - before
    along, _ = chart.arc.shares(base.vertices_mm)
    places = chart.places(before)
    bottom = np.zeros(len(before), dtype=bool)
    bottom[base.faces[face_normals(before, base.faces)[:, 2] < -0.5].ravel()] = True
    bottom &= places.risen == 0.0
    toe = along > TOE_FROM
    heights = np.abs(shift[:, 2])
    back = (along < BACK_TO) & (np.abs(places.across_mm) < BACK_WIDTH_MM)
    top = places.free == 0.0
    parts = {
        "bottom heights": heights[bottom],
        "heel height": heights[bottom & (along < 0.15)],
        "toe spring": heights[bottom & toe],
        "toe shape": _not_rigid(before[toe], after[toe]),
        "back curve": np.abs(shift[back, 0]),
        "top plane": np.linalg.norm(shift[top], axis=1),
    }
    kept = tuple(
        results.KeptPlace(name, float(moved.max())) for name, moved in parts.items() if len(moved)
    )
    return kept, float(np.median(shift[toe, 0])) if toe.any() else 0.0


def _not_rigid(before: Floats, after: Floats) -> Floats:
    """How far points (n, 3) moved besides their common shift and turn, (n,)."""
    if len(before) < 3:
        return np.zeros(0)
    start, end = before - before.mean(axis=0), after - after.mean(axis=0)
    left, _, right = np.linalg.svd(start.T @ end)
    return np.asarray(np.linalg.norm(start @ left @ right - end, axis=1))


def _notices(
    base: BaseLast, after: results.FootFit, *, bottom_kept: bool
) -> tuple[results.Notice, ...]:
    """What should be known of a custom last: its base's mesh, and zones that are not good."""
    notices = []
    if base.mesh.kind == "light copy":
        words = (
            f"the base is a light copy, up to {base.mesh.error_mm:.2f} mm from its file: ingest it"
            " with --keep-mesh full, or run footfit where the file lies"
        )
        notices.append(results.Notice("light_copy", words))
    poor = [z.label for z in after.zones if z.verdict is not None and z.verdict != "good"]
    if poor:
        kept = "toe, flare, top and bottom outline" if bottom_kept else "toe, flare and top"
        words = f"not good in {', '.join(poor)}: a custom last keeps its base's {kept}"
        notices.append(results.Notice("not_good", words))
    return tuple(notices)


def _parentage(
    foot: Profiled, base: BaseLast, making: Making, zones: Sequence[results.CustomZone]
) -> Parentage:
    """How the last was made, for the catalogue."""
    profile = making.question.profile
    return Parentage(
        base=base.name,
        base_sha256=base.record.info.sha256,
        made_by="customise",
        targets=tuple(Target(z.name, z.unit, z.base, z.target, z.reached) for z in zones),
        figures={
            "flare_follow": making.question.flare_follow,
            "keep_bottom": making.question.bottom_kept,
            "room_mm": dict(making.rooms_mm),
        },
        foot_sha256=foot.aligned.alignment.info.sha256,
        profile=profile.name,
        profile_version=profile.version,
        profile_sha256=profile.sha256,
    )
