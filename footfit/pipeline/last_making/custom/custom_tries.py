"""Tries at a custom last: the base is changed, written, read again, and changed again.

A pose and a stance that are found in the finished last differ a little from those that the search
carried along. So each try begins where the last one ended, and carries what was read there.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter

import numpy as np

from footfit import results
from footfit.errors import FootfitError, OutOfReach
from footfit.geometry.deform.bending import bend_deg
from footfit.geometry.deform.chart import Chart
from footfit.geometry.deform.field import Bump
from footfit.geometry.deform.solver import Knob
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points
from footfit.geometry.search.pose_search import RoughPose
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import ANYWHERE, HEEL_GIRTH, CustomAim
from footfit.pipeline.last_making.custom.custom_field import (
    CUSTOM,
    MANNER,
    CustomShape,
    Manner,
    custom_shape,
    first_field,
    limit_words,
    missed,
    refuse_missed,
)
from footfit.pipeline.last_making.custom.custom_reading import Carried, asked_mm, gain_mm, value_mm
from footfit.pipeline.last_making.custom.custom_rooms import with_room
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.preparation import prepared_scan, right_copy
from footfit.pipeline.scan.reading import read
from footfit.pipeline.scan.standing import stance_labels
from footfit.results import LastLabels, PreparedScan, SideName

SETTLED_MM = (0.15, 0.3, 0.3, 0.3, 0.3, 0.3)
HELPS = 0.75
"""The finished last is made again if it reads so far from a target: by the tries before. A try that
leaves more than ``HELPS`` of the miss before is the last one, if there are other manners."""
OUT_MM = 0.1
"""Another try is made if a measure reads so far out of its range, which is .95 of the good one."""
BENT_DEG = 2.0, 4.0
"""A last that bends the surface by more is made otherwise, if that helps; the second one counts if
the bottom keeps its outline."""
FLATTER, SLIMMER = Manner(heights=1.0), Manner(heights=0.25)
SOFTER = Manner(heights=0.8, softer=4.0)
TURN_DEG = 2.5
"""The flare is turned in steps of at most so much; each step begins where the last one ended."""


@dataclass(frozen=True)
class Given:
    """What all tries at a custom last have: the base and its chart, the side and name of the new
    last, the turn of the flare, and whether the bottom keeps its outline.
    """

    base: BaseLast
    chart: Chart
    side: SideName
    name: str
    turn_deg: float
    bottom_kept: bool = False

    @cached_property
    def carried(self) -> Carried:
        """How the base lies and stands."""
        return Carried(self.base.shape, self.base)

    @property
    def length_mm(self) -> float:
        """What the length reads on the base."""
        return self.carried.base_length_mm


@dataclass(frozen=True)
class MadeLast:
    """A custom last as its file has it.

    ``prepared`` is the file as it was read again, ``vertices_mm`` and ``faces`` are those of the
    file; ``frame`` (4, 4) takes right vertices of the base's frame to the shape's canonical right
    frame.
    """

    base: BaseLast
    prepared: PreparedScan
    labels: LastLabels
    vertices_mm: Floats
    faces: Ints
    frame: Floats

    @property
    def shape(self) -> Shape:
        """The right shape."""
        return self.prepared.shape

    @cached_property
    def record(self) -> results.LastRecord:
        """The record, with every measure and the flare."""
        return last_record(profiled_scan(aligned_scan(self.prepared)), self.labels)

    @cached_property
    def gain_mm(self) -> float:
        """How much longer it is along its bottom than along its length."""
        return gain_mm(self.shape, self.base)

    def value_mm(self, measure: str) -> float:
        """A measure as :func:`custom_reading.value_mm` reads it."""
        return value_mm(self.shape, measure, self.base, self.gain_mm)

    @property
    def to_file(self) -> Floats:
        """From the shape's canonical right frame to the axes of the file, (4, 4)."""
        return np.asarray(mirror_of(self.prepared.side.side) @ np.linalg.inv(self.frame))

    def lying(self, vertices_mm: Floats) -> Floats:
        """Right vertices (n, 3) of the base's frame in the last's canonical frame."""
        return moved_points(self.frame, vertices_mm)

    def carried(self, given: Given, vertices_mm: Floats) -> Carried:
        """How bases that are changed a little otherwise lie and stand; ``vertices_mm`` (n, 3) are
        the right ones that it was made of, in the base's frame.
        """
        faces = self.base.shape.faces
        known = Shape(self.lying(vertices_mm), faces, "last", self.shape.labels)
        vars(known)["stance"] = self.shape.stance
        return Carried(known, self.base, self.frame, given.length_mm, self.gain_mm)


@dataclass(frozen=True)
class Attempt:
    """A changed base and the last made of it.

    ``off_mm`` (aims,) is how far the last reads from each firm target, ``room_mm`` (aims,) what
    room for single places adds to that, ``out_mm`` how far the worst measure reads out of its good
    range. ``bent_deg`` is by how much too far the surface bends.
    """

    aims: Sequence[CustomAim]
    shape: CustomShape
    made: MadeLast
    off_mm: Floats
    room_mm: Floats
    out_mm: float
    bent_deg: float

    @property
    def refused(self) -> bool:
        """Whether it goes beyond a limit of stretch, or misses a target."""
        over = limit_words(self.shape) is not None
        return over or missed(self.aims, self.off_mm) is not None

    @property
    def worth(self) -> tuple[bool, float, bool, float, float]:
        """What is least for the best try: whether it would be refused, how much too far it bends
        the surface, whether it misses a target, how far the worst measure is out of its good range,
        and the worst miss.
        """
        off_mm = float(np.abs(self.off_mm).max())
        out_mm = self.out_mm if self.out_mm > OUT_MM else 0.0
        return self.refused, self.bent_deg, off_mm > SETTLED_MM[-1], out_mm, off_mm


def attempt_at(given: Given, aims: Sequence[CustomAim], first: Attempt | None = None) -> Attempt:
    """The best try at a custom last with these aims; it begins where ``first`` ended.

    If it would be refused, it is tried with less change of heights, or of widths. If it bends the
    surface, zones may be a little less good. At last they are left as they are.

    Raises
    ------
    OutOfReach
        A target is missed, or lies beyond the limits of stretch.
    """
    best = _best(given, aims, first, MANNER)
    for manner in (_other_manner(best), Manner(zones=False)):
        if not any(best.worth[:3]):
            break
        with suppress(OutOfReach):
            first = best if manner.zones else None
            best = min(best, _best(given, aims, first, manner), key=attrgetter("worth"))
    refuse_missed(best.aims, best.off_mm, best.shape, given.turn_deg)
    return best


def _other_manner(attempt: Attempt) -> Manner:
    """How to try again what is refused, or bends the surface."""
    if attempt.bent_deg:
        return SOFTER
    return SLIMMER if attempt.shape.scales[0] > CUSTOM.wider else FLATTER


def _best(
    given: Given, aims: Sequence[CustomAim], first: Attempt | None, manner: Manner
) -> Attempt:
    """The best of some tries; each begins where the last one ended.

    In another manner than the usual one it begins at the base, which lies as ``first`` does.
    """
    knobs = first.shape.solved.knobs if first and manner == MANNER else ()
    carried = first.made.carried(given, first.shape.vertices_mm) if first else given.carried
    steps = 1 if first else max(1, int(np.ceil(abs(given.turn_deg) / TURN_DEG)))
    for step in range(1, steps):
        turned = _tried(given, aims, step / steps, carried, knobs, manner)
        carried = turned.made.carried(given, turned.shape.vertices_mm)
        knobs, aims = turned.shape.solved.knobs, turned.aims
    tries: list[Attempt] = []
    for settled_mm in SETTLED_MM:
        try:
            tried = _tried(given, aims, 1.0, carried, knobs, manner)
        except FootfitError:
            if not tries:
                raise
            break
        carried = tried.made.carried(given, tried.shape.vertices_mm)
        knobs, aims = tried.shape.solved.knobs, tried.aims
        tries.append(tried)
        _, _, _, out_mm, off_mm = tried.worth
        met = off_mm <= settled_mm and (not out_mm or len(tries) > 1)
        stuck = len(tries) > 1 and off_mm > HELPS * tries[-2].worth[-1]
        if met or (stuck and manner.zones):
            break  # a limit of stretch that is passed with all targets met stays passed
    return min(tries, key=attrgetter("worth"))


def _tried(
    given: Given,
    aims: Sequence[CustomAim],
    share: float,
    carried: Carried,
    knobs: Sequence[Knob],
    manner: Manner,
) -> Attempt:
    """One try, with a share of the turn."""
    start = first_field(given.chart, share * given.turn_deg, bottom_kept=given.bottom_kept)
    shape = custom_shape(given.base, aims, start, carried, knobs, manner)
    made = made_last(given.base, shape.vertices_mm, given.side, given.name)
    before = given.base.shape
    bent_deg = bend_deg(before.vertices_mm, shape.vertices_mm, before.faces)
    return Attempt(
        aims=shape.aims,
        shape=shape,
        made=made,
        off_mm=_off_mm(given, shape.aims, made),
        room_mm=np.zeros(len(aims)),
        out_mm=_out_mm(shape.aims, made),
        bent_deg=max(bent_deg - BENT_DEG[given.bottom_kept], 0.0),
    )


def _off_mm(given: Given, aims: Sequence[CustomAim], made: MadeLast) -> Floats:
    """How far a finished last reads from each firm target, (aims,)."""
    off = [
        made.value_mm(aim.measure) - asked_mm(aim, given.length_mm) if aim.firm else 0.0
        for aim in aims
    ]
    return np.where(np.isnan(off), np.inf, off)


def _out_mm(aims: Sequence[CustomAim], made: MadeLast) -> float:
    """How far the worst measure of a finished last reads out of its good range; without the heel's
    girth, which the kept parts nearly set.
    """
    ranged = [aim for aim in aims if aim.good_mm != ANYWHERE and aim.measure != HEEL_GIRTH]
    values = np.array([made.value_mm(aim.measure) for aim in ranged])
    low, high = np.array([aim.good_mm for aim in ranged]).reshape(-1, 2).T
    return float(np.nan_to_num(np.maximum(low - values, values - high)).max(initial=0.0))


def with_bumps(given: Given, attempt: Attempt, bumps: Sequence[Bump]) -> Attempt:
    """A try with room for single places on top.

    Raises
    ------
    OutOfReach
        The last would fold.
    """
    shape = with_room(given.base, attempt.shape, bumps)
    made = made_last(given.base, shape.vertices_mm, given.side, given.name)
    room_mm = _off_mm(given, attempt.aims, made) - attempt.off_mm
    return replace(attempt, shape=shape, made=made, room_mm=room_mm)


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
    mirror = mirror_of(side)
    frame = mirror @ prepared.canonical_transform @ mirror
    return MadeLast(base, prepared, labels, vertices_mm, faces, np.asarray(frame, np.float64))


def mirror_of(side: SideName | None) -> Floats:
    """What takes a right shape to one of a side, and back, (4, 4)."""
    return np.diag([1.0, -1.0 if side == "left" else 1.0, 1.0, 1.0])
