"""Making a custom last: from a base to a last with the allowances of a fit profile for a foot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np

from footfit import results
from footfit.errors import OutOfReach
from footfit.geometry.deform.chart import chart_of
from footfit.geometry.deform.field import Field
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.surface import face_normals, vertex_normals
from footfit.geometry.numeric.arrays import Floats, row_dots
from footfit.pipeline.batch.run_manifest import OF_CONTENT, said_notices
from footfit.pipeline.fit.judging.judged_lasts import JudgedLasts
from footfit.pipeline.fit.ranking import foot_fits
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.bent_surface import bent_notices
from footfit.pipeline.last_making.custom.custom_aims import (
    FOLLOWING,
    LENGTH,
    CustomAim,
    CustomQuestion,
    custom_aims,
    fit_in,
    judged_in,
)
from footfit.pipeline.last_making.custom.custom_field import (
    CUSTOM,
    refuse_far,
)
from footfit.pipeline.last_making.custom.custom_reading import file_plane, value_mm
from footfit.pipeline.last_making.custom.custom_rooms import (
    change_notices,
    joint_notices,
    reached_rooms,
    refuse_unknown,
    room_bumps,
)
from footfit.pipeline.last_making.custom.custom_toe_box import (
    TOE_FROM,
    toe_box_change,
    toe_box_plans,
)
from footfit.pipeline.last_making.custom.custom_tries import (
    Attempt,
    Given,
    attempt_after,
    attempt_at,
    attempt_beside,
    on_light_copy,
    with_bumps,
)
from footfit.pipeline.last_making.custom.good_zones import (
    not_good,
    toe_box_notice,
    with_reasons,
    zone_notices,
)
from footfit.pipeline.last_making.custom.made_last import heel_notices
from footfit.pipeline.scan.preparation import mirror_of
from footfit.results import Parentage, Profiled, SideName, Target
from footfit.results.last_making.custom_last import CustomLast

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
    question = making.question
    given, aims = begun(foot, base, making, side)
    judged_base = judged_in(foot, base.record, base, question)
    (before,) = foot_fits(judged_base, 0, base.record)

    def answer(attempt: Attempt) -> CustomLast:
        return _answer(foot, given, making, attempt, before)

    attempt = _tried(foot, given, aims, question, judged_base)
    made, notices, lost = answer(attempt), list[results.Notice](), set[str]()
    last = attempt.made
    if making.rooms_mm:  # room is given on top of the targets, which are met without it
        lying_mm = attempt.made.lying(attempt.shape.vertices_mm)
        bumps = room_bumps(base.shape, given.chart, making.rooms_mm, attempt.made.shape, lying_mm)
        swollen = with_bumps(given, attempt, bumps)
        notices += joint_notices(attempt.made.shape, swollen.made.shape)
        notices += change_notices(swollen.aims, swollen.room_mm)
        ends_mm = attempt.shape.vertices_mm, swollen.shape.vertices_mm
        rooms = reached_rooms(base.shape, given.chart, making.rooms_mm, bumps, ends_mm)
        roomy = replace(answer(swollen), rooms=rooms)
        lost = {z.name for z in not_good(roomy.judged)} - {z.name for z in not_good(made.judged)}
        made, last = roomy, swollen.made
    if foot.aligned.alignment.pose.kind == "last":
        words = "the foot has a shape like a last's: give the scan of a foot"
        notices.append(results.Notice("looks_like_a_last", words))
    judged = with_reasons(made.judged, question, lost)
    bent = bent_notices(made, bottom_kept=question.bottom_kept)
    notices = [*toe_box_notice(made.toe_box), *bent, *notices]
    said = (*_notices(base), *heel_notices(last), *zone_notices(judged, attempt.aims), *notices)
    return replace(made, judged=judged, warnings=said)


def begun(
    foot: Profiled, base: BaseLast, making: Making, side: SideName | None = None
) -> tuple[Given, tuple[CustomAim, ...]]:
    """What a search begins with: what is given, and the aims.

    Raises
    ------
    OutOfReach
        There is nothing to aim at, or an aim is too far from the base.
    BadOption
        A place for room is not known, or its room is too large.
    """
    question = making.question
    refuse_unknown(making.rooms_mm)
    aims = custom_aims(foot, base, question)
    if not aims:
        raise OutOfReach("no measure of the foot can be compared with the base: scan it again")
    refuse_far(aims, base)
    own: SideName = foot.aligned.alignment.side.side or "right"
    turn_deg = _flare_turn_deg(foot, base, making)
    given = Given(base, chart_of(base.shape), side or own, making.name, turn_deg)
    return replace(given, bottom_kept=question.bottom_kept), aims


def _tried(
    foot: Profiled,
    given: Given,
    aims: Sequence[CustomAim],
    question: CustomQuestion,
    before: JudgedLasts,
) -> Attempt:
    """The best try at a custom last. The toe room and the toe box give way if the toes need that.

    The search is made on a light copy of the base; the base itself only follows.

    Raises
    ------
    OutOfReach
        A target is out of reach of the base.
    """
    light, own = on_light_copy(given, aims)
    try:
        best = attempt_at(light, own)
    except OutOfReach:  # the base itself has the last word
        return attempt_at(given, aims)
    for plan in toe_box_plans(foot, light, best, question, before):
        with suppress(OutOfReach):
            other = attempt_beside(replace(light, humps=plan.humps), plan.aims(best.aims), best)
            if other.sound_as(best):
                best = other
                break
    if light is given:
        return best
    return attempt_after(replace(given, humps=best.humps), aims, best)


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


def _answer(
    foot: Profiled, given: Given, making: Making, attempt: Attempt, before: results.FootFit
) -> CustomLast:
    """The result of what was made, without its warnings; ``before`` is the fit of the base."""
    question, profile, base = making.question, making.question.profile, given.base
    made, shape = attempt.made, attempt.shape
    after = fit_in(foot, made.record, made.with_sections, question)
    judged, zones = _judged(before, after), _zones(foot, base, attempt)
    side = made.record.side.side or "right"
    base_vertices_mm = base.shape.vertices_mm * mirror_of(side)
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
        mirrored=side != (foot.aligned.alignment.side.side or "right"),
        profile=profile.name,
        profile_version=profile.version,
        profile_sha256=profile.sha256,
        heel=heel,
        zones=zones,
        judged=judged,
        kept=kept,
        toe_shift_mm=toe_shift_mm,
        flare_turn_deg=given.turn_deg,
        largest_move_mm=float(np.linalg.norm(shift, axis=1).max()),
        least_determinant=shape.least_determinant,
        warnings=(),
        record=made.record,
        sections=made.with_sections.sections,
        parentage=_parentage(foot, base, making, zones),
        vertices_mm=made.vertices_mm,
        base_vertices_mm=base_vertices_mm,
        faces=made.faces,
        moved_mm=row_dots(shift, outward),
        toe_box=toe_box_change(shape.solved.field),
    )


def _zones(foot: Profiled, base: BaseLast, attempt: Attempt) -> tuple[results.CustomZone, ...]:
    """Each aim with what was reached, without the girths that are only pulled along."""
    aims, made = attempt.aims, attempt.made
    foot_sd, base_sd, reached_sd = (
        {row.name: row.measured.sd for row in measures}
        for measures in (foot.measures, base.record.measures, made.record.measures)
    )
    zones = []
    for aim, room in zip(aims, attempt.room_mm.tolist(), strict=True):
        if not aim.firm and aim.measure not in FOLLOWING:
            continue
        value = made.value_mm(aim.measure)
        grown = value - value_mm(base.shape, aim.measure, base)
        reached = made.shape.length_mm if aim.measure == LENGTH else value
        zones.append(
            results.CustomZone(
                name=aim.measure,
                zone=aim.zone,
                unit="mm",
                foot=aim.foot,
                allowance=aim.allowance,
                base=aim.base,
                target=reached - grown + aim.target - aim.base + room if aim.firm else reached,
                reached=reached,
                room=room if aim.firm else 0.0,
                follows=not aim.firm,
                plane=file_plane(made.shape, aim.measure, made.to_file),
                foot_sd=None if aim.foot is None else foot_sd.get(aim.measure),
                base_sd=base_sd.get(aim.measure),
                reached_sd=reached_sd.get(aim.measure),
            )
        )
    return tuple(zones)


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
            base_sd=old.clearance.sd,
            custom_sd=new.clearance.sd,
        )
        for old, new in zip(before.zones, after.zones, strict=True)
    )


def _kept(
    field: Field, base: Shape, vertices_mm: Floats
) -> tuple[tuple[results.KeptPlace, ...], float]:
    """How far the parts that stay moved, and how far the toe moved ahead as a whole.

    The room for single places counts too: it may be given to what else stays.
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


def _notices(base: BaseLast) -> tuple[results.Notice, ...]:
    """What should be known of how the base stands, and of its mesh."""
    said = said_notices(base.record.warnings, base.record.info.path)
    if base.mesh.kind != "light copy":
        of_file = base.mesh.kind == "file"
        return tuple(each for each in said if of_file or each.code == OF_CONTENT)
    words = (
        f"the base is a light copy, up to {base.mesh.error_mm:.2f} mm from its file: ingest it"
        " with --keep-mesh full, or run footfit where the file lies"
    )
    return (results.Notice("light_copy", words),)


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
