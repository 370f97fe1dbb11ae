"""Tries at a custom last: the base is changed, written, read again, and changed again.

A pose and a stance that are found in the finished last differ a little from those that the search
carried along. So each try begins where the last one ended, and carries what was read there. Most
tries are made on a light copy of the base: the last try there leads to within some tenths of a mm.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter

import numpy as np

from footfit.errors import FootfitError, OutOfReach
from footfit.geometry.deform.bending import bend_deg
from footfit.geometry.deform.chart import Chart, Places
from footfit.geometry.deform.field import Bump, Field
from footfit.geometry.deform.hump import Hump
from footfit.geometry.deform.solver import Solution
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats
from footfit.meshes.copies.lighter import lighter_mesh
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import (
    ANYWHERE,
    HEEL_GIRTH,
    LENGTH,
    CustomAim,
)
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
from footfit.pipeline.last_making.custom.custom_reading import Carried, asked_mm
from footfit.pipeline.last_making.custom.custom_rooms import with_room
from footfit.pipeline.last_making.custom.made_last import MadeLast, made_last
from footfit.results import SideName

SETTLED_MM = (0.15, 0.3, 0.3, 0.3, 0.3, 0.3)
LIGHT_MM = 0.2
HELPS = 0.75
"""The finished last is made again if it reads so far from a target: by the tries before; a light
copy may be off by ``LIGHT_MM`` more. A try that leaves more than ``HELPS`` of the miss before is
the last one, if there are other manners; so is one whose search arrived beyond a limit."""
OUT_MM, SOUND_MM = 0.1, 0.15
"""Another try is made if a measure reads so far out of its range, which is .95 of the good one. A
try with another toe box may read so far out: its zones are still good."""
BENT_DEG, LIGHT_DEG = (2.0, 4.0), 0.06
"""A last that bends the surface by more is made otherwise, if that helps; the second one counts if
the bottom keeps its outline. On a light copy so much less is asked for."""
FREE_HEEL, UNZONED = Manner(heel=False), Manner(zones=False)
FLATTER, SLIMMER = Manner(heights=1.0), Manner(heights=0.25)
SOFTER, SOFTEST = Manner(heights=0.8, softer=4.0), Manner(heights=0.8, softer=16.0)
LIGHT_FACES, LIGHT_SHARE = 5000, 0.6
"""Of the light copy on which most tries are made; a base with not many more faces needs none."""
TURN_DEG = 2.5
"""The flare is turned in steps of at most so much; each step begins where the last one ended."""


@dataclass(frozen=True)
class Given:
    """What all tries at a custom last have: the base and its chart, the side and name of the new
    last, the turn of the flare, and whether the bottom keeps its outline.

    ``whole`` is the base's own shape, if ``base`` has a light copy of it: how much a surface bends
    depends on its faces. ``humps`` change the toe box before a search begins.
    """

    base: BaseLast
    chart: Chart
    side: SideName
    name: str
    turn_deg: float
    bottom_kept: bool = False
    whole: Shape | None = None
    humps: tuple[Hump, ...] = ()

    @cached_property
    def carried(self) -> Carried:
        """How the base lies and stands."""
        return Carried(self.base.shape, self.base)

    @property
    def length_mm(self) -> float:
        """What the length reads on the base."""
        return self.carried.base_length_mm

    @cached_property
    def _places(self) -> Places:
        """The vertices of the whole base in the chart."""
        assert self.whole is not None
        return self.chart.places(self.chart.standing(self.whole.vertices_mm))

    def bent_more_deg(self, field: Field, after_mm: Floats | None = None) -> float:
        """By how much farther than it may a field bends the surface of the base; - is less.

        ``after_mm`` is where it moves the vertices of ``base``, if that is known.
        """
        whole, most_deg = self.base.shape, BENT_DEG[self.bottom_kept]
        if self.whole is not None:
            whole, most_deg = self.whole, most_deg - LIGHT_DEG
            after_mm = field.moved_points(whole.vertices_mm, self._places)
        elif after_mm is None:
            after_mm = field.moved_points(whole.vertices_mm)
        return bend_deg(whole.vertices_mm, after_mm, whole.faces) - most_deg

    def bent_deg(self, shape: CustomShape) -> float:
        """By how much too far a change bends the surface of the base."""
        return max(self.bent_more_deg(shape.solved.field, shape.vertices_mm), 0.0)


def on_light_copy(given: Given, aims: Sequence[CustomAim]) -> tuple[Given, Sequence[CustomAim]]:
    """The same on a light copy of the base, for which the aims are moved by what it reads more or
    less; itself if the base has few faces.
    """
    whole = given.base.shape
    vertices_mm, faces = lighter_mesh(whole.vertices_mm, whole.faces, LIGHT_FACES)
    if len(faces) > LIGHT_SHARE * len(whole.faces):
        return given, aims
    shape = Shape(vertices_mm, faces, "last", whole.labels)
    vars(shape)["stance"] = whole.stance
    light = replace(given.base, shape=shape)
    carried = Carried(light.shape, light)
    names = [aim for aim in aims if aim.measure != LENGTH]
    more_mm = dict(
        zip(
            (aim.measure for aim in names),
            (carried.values_mm(vertices_mm, names) - [aim.base for aim in names]).tolist(),
            strict=True,
        )
    )
    moved = [aim.shifted(more_mm.get(aim.measure, 0.0)) for aim in aims]
    return replace(given, base=light, whole=whole), moved


@dataclass(frozen=True)
class Attempt:
    """A changed base and the last made of it, in some manner.

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
    manner: Manner = MANNER

    @property
    def beyond(self) -> bool:
        """Whether it goes beyond a limit of stretch, or bends the surface too far."""
        return limit_words(self.shape) is not None or bool(self.bent_deg)

    @property
    def worth(self) -> tuple[bool, float, bool, float, float]:
        """What is least for the best try: whether it would be refused, how much too far it bends
        the surface, whether it misses a target, how far the worst measure is out of its good range,
        and the worst miss.
        """
        off_mm = float(np.abs(self.off_mm).max())
        out_mm = self.out_mm if self.out_mm > OUT_MM else 0.0
        over = limit_words(self.shape) is not None
        refused = over or missed(self.aims, self.off_mm) is not None
        return refused, self.bent_deg, off_mm > SETTLED_MM[-1], out_mm, off_mm

    @property
    def humps(self) -> tuple[Hump, ...]:
        """How its toe box is changed."""
        return self.shape.solved.field.humps

    def sound_as(self, other: Attempt) -> bool:
        """Whether it bends the surface no farther than another try, and zones are as good."""
        return self.bent_deg <= other.bent_deg and self.out_mm <= max(other.out_mm, SOUND_MM)

    def carried(self, given: Given) -> Carried:
        """How a base that is changed a little otherwise lies and stands."""
        base, vertices_mm = given.base, self.shape.vertices_mm
        if base is not self.made.base:  # this was made of the light copy
            vertices_mm = self.shape.solved.field.moved_points(base.shape.vertices_mm)
        known = Shape(self.made.lying(vertices_mm), base.shape.faces, "last", base.shape.labels)
        vars(known)["stance"] = self.made.shape.stance
        return Carried(known, base, self.made.frame, given.length_mm, self.made.gain_mm)


def attempt_after(given: Given, aims: Sequence[CustomAim], rough: Attempt) -> Attempt:
    """The best try that begins where ``rough`` ended on a light copy, with the same aims.

    Raises
    ------
    OutOfReach
        As :func:`attempt_at`.
    """
    pairs = zip(aims, rough.aims, strict=True)
    return attempt_at(given, [there.shifted(own.base - there.base) for own, there in pairs], rough)


def attempt_at(given: Given, aims: Sequence[CustomAim], first: Attempt | None = None) -> Attempt:
    """The best try at a custom last with these aims; it begins where ``first`` ended.

    If it would be refused, it is tried with less change of heights, or of widths. If it bends the
    surface, zones may be a little less good. At last they are left as they are.

    Raises
    ------
    OutOfReach
        A target is missed, or lies beyond the limits of stretch.
    """
    best = _best(given, aims, first, first.manner if first else MANNER)
    faults = 2 if first or given.whole else 3  # a miss that is left on a light copy does not matter
    for manner in _other_manners(best):
        if any(best.worth[:faults]):
            best = _better(given, aims, best, manner)
    for manner in _other_manners(best):
        if best.worth[0]:  # targets that gave way may help
            best = _better(given, best.aims, best, manner)
    refuse_missed(best.aims, best.off_mm, best.shape, given.turn_deg)
    return best


def attempt_in(given: Given, aims: Sequence[CustomAim], manner: Manner) -> Attempt:
    """The best try in one manner, though it may miss a target or go beyond a limit."""
    return _best(given, aims, None, manner)


def attempt_beside(given: Given, aims: Sequence[CustomAim], first: Attempt) -> Attempt:
    """The best try in the manner of ``first``, which had nearly these aims; it begins there.

    Raises
    ------
    OutOfReach
        As :func:`attempt_at`.
    """
    best = _best(given, aims, first, first.manner)
    refuse_missed(best.aims, best.off_mm, best.shape, given.turn_deg)
    return best


def _better(given: Given, aims: Sequence[CustomAim], best: Attempt, manner: Manner) -> Attempt:
    """The better one of a try and the best one in another manner."""
    try:
        other = _best(given, aims, best if manner.zones else None, manner)
    except OutOfReach:
        return best
    return min(best, other, key=attrgetter("worth"))


def _other_manners(attempt: Attempt) -> tuple[Manner, ...]:
    """How to try again what is refused, or bends the surface: at first without the heel's zone, if
    the base is not good there.
    """
    slim = attempt.shape.scales[0] > CUSTOM.wider
    other = SOFTER if attempt.bent_deg else SLIMMER if slim else FLATTER
    heel = next((aim for aim in attempt.aims if aim.measure == HEEL_GIRTH), None)
    last = (SOFTEST, UNZONED) if attempt.bent_deg else (UNZONED,)
    if heel is None or heel.good_mm[0] <= heel.base <= heel.good_mm[1]:
        return other, *last
    return FREE_HEEL, *(replace(each, heel=False) for each in (other, *last))


def _best(
    given: Given,
    aims: Sequence[CustomAim],
    first: Attempt | None,
    manner: Manner,
) -> Attempt:
    """The best of some tries; each begins where the last one ended.

    In another manner than that of ``first`` it begins at the base, which lies as ``first`` does.
    """
    alike = first is not None and first.manner == manner
    known = first.shape.solved if first and alike else None
    carried = first.carried(given) if first else given.carried
    steps = 1 if first else max(1, int(np.ceil(abs(given.turn_deg) / TURN_DEG)))
    for step in range(1, steps):
        turned = _tried(given, aims, step / steps, carried, known, manner)
        carried, known, aims = turned.carried(given), turned.shape.solved, turned.aims
    begun = first and alike and first.made.base is given.base and first.humps == given.humps
    tries = [first] if first and begun and tuple(first.aims) == tuple(aims) else []
    before = int(first is not None and not tries)
    more_mm = 0.0 if given.whole is None else LIGHT_MM
    while not (tries and _enough(tries, before, more_mm)):
        try:
            tried = _tried(given, aims, 1.0, carried, known, manner)
        except FootfitError:
            if not tries:
                raise
            break
        carried, known, aims = tried.carried(given), tried.shape.solved, tried.aims
        tries.append(tried)
    return min(tries, key=attrgetter("worth"))


def _enough(tries: Sequence[Attempt], before: int, more_mm: float) -> bool:
    """Whether the last of some tries needs no other one in its manner; ``before`` them were some
    others. It may be off by ``more_mm`` more.
    """
    last, count = tries[-1], min(before + len(tries), len(SETTLED_MM))
    _, _, _, out_mm, off_mm = last.worth
    if off_mm <= SETTLED_MM[count - 1] + more_mm and (not out_mm or count > 1):
        return True
    stuck = len(tries) > 1 and off_mm > HELPS * tries[-2].worth[-1]
    stuck = stuck or (last.beyond and last.shape.solved.met)
    lost = len(tries) > 1 and off_mm >= tries[-2].worth[-1]
    return len(tries) == len(SETTLED_MM) or lost or (stuck and last.manner.zones)


def _tried(
    given: Given,
    aims: Sequence[CustomAim],
    share: float,
    carried: Carried,
    first: Solution | None,
    manner: Manner,
) -> Attempt:
    """One try, with a share of the turn."""
    start = first_field(given.chart, share * given.turn_deg, bottom_kept=given.bottom_kept)
    start = replace(start, humps=given.humps)
    shape = custom_shape(given.base, aims, start, carried, first, manner)
    made = made_last(given.base, shape.vertices_mm, given.side, given.name)
    return Attempt(
        aims=shape.aims,
        shape=shape,
        made=made,
        off_mm=_off_mm(given, shape.aims, made),
        room_mm=np.zeros(len(aims)),
        out_mm=_out_mm(shape.aims, made),
        bent_deg=given.bent_deg(shape),
        manner=manner,
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
