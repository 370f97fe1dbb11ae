"""A standing foot or last: its ground, its length along it, and its bottom's middle over it.

A foot stands on the contact plane of its frame. A last rests on its seat and its ball, but it
stands on its heel with its tread level. A label decides how; else the shape of the bottom does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.smoothing import local_quadratic
from footfit.geometry.stance.cues import NO_LABELS, Cue, StanceLabels, agreed, combined, doubted
from footfit.geometry.stance.middle_line import (
    FEWEST,
    SEAT,
    TOE,
    TOUCH,
    MiddleLine,
    low_points,
    middle_line,
    seat_line,
    stretch,
    turned,
)
from footfit.geometry.stance.missing_bottom import missing_for_labels

if TYPE_CHECKING:
    from footfit.geometry.stance.ground import BottomCues


@dataclass(frozen=True, slots=True)
class StanceSettings:
    """Where the ground touches and what lies over it; places over the standing length.

    Attributes
    ----------
    touch : tuple of float
        The ground touches the lowest place of the middle line between these.
    bandwidth : float
        Standard deviation of the local parabolas that the lowest place is found on.
    seat, toe : tuple of float
        The line of the seat, and the parabola of the toe, run along the middle line between these.
    pitch, pitch_spread : float
        The seat's pitch (radians) over the heel's share of the length, and its spread: from level
        seats to the pitch that wearers like best.
    pitch_sd_deg : float
        The spread of the seat's pitch under a last without a heel.
    usual_sd_deg, doubt : float
        The level of a tread is unsure by this many times what the standard deviation of its cues
        is more than the usual one.
    heel_sd_mm, spring_sd_mm : float
        How far a label may be from the true heel and toe spring.
    rounds, settled_mm, recut_deg
        Of finding the ground of a label, and when the middle line is cut anew on the way.
    range_deg : tuple of float
        A labelled ground is kept within these.
    """

    touch: tuple[float, float] = TOUCH
    bandwidth: float = 0.012
    seat: tuple[float, float] = SEAT
    toe: tuple[float, float] = TOE
    pitch: float = 0.78
    pitch_spread: float = 0.48
    pitch_sd_deg: float = 2.0
    usual_sd_deg: float = 0.5
    doubt: float = 1.5
    heel_sd_mm: float = 1.5
    spring_sd_mm: float = 1.0
    rounds: int = 8
    settled_mm: float = 0.002
    recut_deg: float = 2.0
    range_deg: tuple[float, float] = (-15.0, 55.0)


STANCE = StanceSettings()
SEAT_TO_TREAD = 0.62
"""From the seat to where the ground touches the tread, over the length, about."""


@dataclass(frozen=True, slots=True)
class Stance:
    """How a right shape stands. A foot's standing frame is its resting frame.

    Attributes
    ----------
    ground : float
        The angle of the ground from the resting plane, radians; + raises the heel.
    ground_sd : float
        Its standard deviation, radians: of where a tread may lie, not of a second scan.
    touching_mm : (2,)
        Where the ground touches the middle line, as (x, z) in the resting frame.
    rear_mm : float
        The rearmost place along the ground, counted from where the ground passes under the
        resting frame's origin.
    length_mm : float
        The extent along the ground of what lies low: without leg, shaft or cone.
    middle_mm : (k, 2)
        The middle line of the bottom in the standing frame, from heel to toe: x from the rearmost
        point along the ground, z over the ground. Empty of a foot, which stands as it lies.
    decided_by : {"contact", "shape", "label"}
        What the ground is by: a foot's contact plane, a last's shape, or its label.
    cues : tuple of Cue
        What each cue says of a last's ground; the shape's mean is among them.
    level_sd : float
        How far the ground may be from where this very tread lies level, radians; with a label, the
        standard deviation of what the label says. ``ground_sd`` also holds how lasts differ.
    by_shape : Stance or None
        How a last that stands by its label stands by its shape alone: as it would without labels.
    """

    ground: float
    ground_sd: float
    touching_mm: tuple[float, float]
    rear_mm: float
    length_mm: float
    middle_mm: Floats
    decided_by: str = "contact"
    cues: tuple[Cue, ...] = ()
    level_sd: float = 0.0
    by_shape: Stance | None = None

    @property
    def alone(self) -> Stance | None:
        """How a last stands by its shape alone, whatever a label says; None if that is not known,
        and of a foot.
        """
        return self if self.decided_by == "shape" else self.by_shape

    @property
    def standing_transform(self) -> Floats:
        """From the resting frame to the standing frame, (4, 4); never a mirror.

        There the ground is z = 0, and the rearmost point along it is at x = 0.
        """
        cosine, sine = np.cos(self.ground), np.sin(self.ground)
        result = np.eye(4)
        result[0, [0, 2]] = cosine, sine
        result[2, [0, 2]] = -sine, cosine
        x_mm, z_mm = self.touching_mm
        result[0, 3], result[2, 3] = -self.rear_mm, sine * x_mm - cosine * z_mm
        return result

    def turned(self, angle: float, height_mm: float) -> Stance:
        """The same stance beside a resting frame that is turned by an angle (radians, + lowers
        what lies in front) and then lowered by a height.
        """
        ground = self.ground - angle
        x, _, z = turned(np.array([[self.touching_mm[0], 0.0, self.touching_mm[1]]]), angle)[0]
        return replace(
            self,
            ground=ground,
            touching_mm=(float(x), float(z) - height_mm),
            rear_mm=self.rear_mm - height_mm * float(np.sin(ground)),
        )

    def level_sd_mm(self, place_mm: float) -> float:
        """The standard deviation of a height at a place along the ground, by how sure the tread's
        level is. It is 0 of a foot, which stands on the ground that it was scanned on.
        """
        return abs(place_mm - self.touching_x_mm) * self.level_sd

    @property
    def touching_x_mm(self) -> float:
        """Where the ground touches, along the ground from the rearmost point."""
        return self.along_ground_mm(*self.touching_mm)

    def along_ground_mm(self, x_mm: float, z_mm: float) -> float:
        """Where a place of the resting frame's side view lies, from the rearmost point."""
        return float(x_mm * np.cos(self.ground) + z_mm * np.sin(self.ground)) - self.rear_mm

    def over_ground_mm(self, x_mm: float, z_mm: float) -> float:
        """How high a place of the resting frame's side view lies over the ground.

        Examples
        --------
        >>> Stance(0.0, 0.0, (9.0, -2.0), 0.0, 250.0, np.empty((0, 2))).over_ground_mm(7.0, 5.0)
        7.0
        """
        across = (z_mm - self.touching_mm[1]) * np.cos(self.ground)
        return float(across - (x_mm - self.touching_mm[0]) * np.sin(self.ground))

    def shape_heel_mm(self, length_mm: float) -> float | None:
        """About how high the heel of a last of that length stands, by its shape whatever a label
        says. None of a foot.
        """
        shape = next((cue for cue in self.cues if cue.name == "shape"), None)
        return None if shape is None else SEAT_TO_TREAD * length_mm * float(np.sin(shape.ground))

    def stretch_mm(self, window: tuple[float, float]) -> Floats:
        """The points (k, 2) of the middle line between two shares of the standing length."""
        return stretch(self.middle_mm, self.length_mm, window)

    def heel_mm(self, settings: StanceSettings = STANCE) -> float | None:
        """How high the seat's line stands over the ground at the rearmost point.

        None if the bottom is open along the seat.
        """
        seat = self.seat_line(settings)
        return None if seat is None else seat[1]

    def seat_line(self, settings: StanceSettings = STANCE) -> tuple[float, float] | None:
        """The slope of the seat's line, and its height (mm) at the rearmost point.

        None if the bottom is open along the seat.
        """
        return seat_line(self.middle_mm, self.length_mm, settings.seat)

    def tip_mm(self, settings: StanceSettings = STANCE) -> float | None:
        """How high the bottom's middle, drawn on to the foremost point, lies over the ground.

        None if the bottom is open along the toes.
        """
        x, z = self.stretch_mm(settings.toe).T
        if len(x) < FEWEST:
            return None
        return float(np.polyfit(x - self.length_mm, z, 2)[2])


def stance_of(
    vertices_mm: Floats, faces: Ints, kind: str, labels: StanceLabels = NO_LABELS
) -> Stance | None:
    """How a right shape stands.

    Parameters
    ----------
    vertices_mm : (n, 3)
        Canonical: x from heel to toe, z up from the resting plane.
    faces : (m, 3)
        Wound outward.
    kind : {"foot", "last"}
    labels : StanceLabels
        What people say of a last; a foot stands flat whatever they say.

    Returns
    -------
    Stance or None
        None if a last's bottom is open or has no tread, and no label helps. A foot always stands.
    """
    if kind == "foot":
        low_mm = vertices_mm[low_points(vertices_mm)]
        return Stance(0.0, 0.0, (0.0, 0.0), 0.0, float(np.ptp(low_mm[:, 0])), np.empty((0, 2)))
    from footfit.geometry.stance.ground import bottom_cues

    bottom = bottom_cues(vertices_mm, faces)
    if bottom is None:
        return _by_label_alone(vertices_mm, faces, labels)
    last = _StandingLast(vertices_mm, faces, bottom.line)
    cues = _shape_cues(last, bottom)
    level_sd = _doubted_level(bottom.level_sd, cues[-1].sd, last.settings)
    labelled = replace(last)  # cut anew for the grounds of labels, without a trace here
    alone = replace(last.on(cues[-1], "shape", cues), level_sd=level_sd)
    said = _label_cues(labelled, labels, cues[-1].ground)
    return replace(_by_label(labelled, cues, said), by_shape=alone) if said else alone


def _by_label(last: _StandingLast, cues: tuple[Cue, ...], said: list[Cue]) -> Stance:
    """The stance that labels decide."""
    label = agreed("label", said)
    cues = (*cues, *(said if len(said) > 1 else ()), label)
    return replace(last.on(label, "label", cues), level_sd=label.sd)


def _by_label_alone(vertices_mm: Floats, faces: Ints, labels: StanceLabels) -> Stance | None:
    """The stance of a last whose shape shows no tread, by its labels, if enough is left of it."""
    if labels.drop_mm is None and labels.toe_spring_mm is None:
        return None
    line = middle_line(vertices_mm, faces, 0.0)
    if line is None or missing_for_labels(line, labels):
        return None
    last = _StandingLast(vertices_mm, faces, line)
    said = _label_cues(last, labels, 0.0)
    return _by_label(last, (), said) if said else None


@dataclass
class _StandingLast:
    """A last on any ground; its middle line is cut anew for a ground far from the last cut."""

    vertices_mm: Floats
    faces: Ints
    line: MiddleLine
    settings: StanceSettings = STANCE

    def on(self, cue: Cue, decided_by: str = "", cues: tuple[Cue, ...] = ()) -> Stance:
        """The last as it stands on the ground of a cue."""
        if abs(cue.ground - self.line.ground) > np.radians(self.settings.recut_deg):
            cut = middle_line(self.vertices_mm, self.faces, cue.ground)
            self.line = self.line if cut is None else cut
        line = self.line.on(cue.ground, self.vertices_mm)
        x, z = line.points_mm.T
        place = (x - line.ends_mm[0]) / line.length_mm
        start, end = self.settings.touch
        near = np.linspace(start, end, 1 + round((end - start) / 0.005))
        heights = local_quadratic(near, place, self.settings.bandwidth)[0] @ z
        lowest = int(np.argmin(heights))
        low_x, low_z = line.ends_mm[0] + near[lowest] * line.length_mm, heights[lowest]
        cosine, sine = np.cos(line.ground), np.sin(line.ground)
        touching = low_x * cosine - low_z * sine, low_x * sine + low_z * cosine
        return Stance(
            ground=cue.ground,
            ground_sd=cue.sd,
            touching_mm=(float(touching[0]), float(touching[1])),
            rear_mm=line.ends_mm[0],
            length_mm=line.length_mm,
            middle_mm=line.points_mm - [line.ends_mm[0], low_z],
            decided_by=decided_by,
            cues=cues,
        )


def _shape_cues(last: _StandingLast, bottom: BottomCues) -> tuple[Cue, ...]:
    """The cues of a last's shape, and their mean."""
    cues: tuple[Cue, ...] = (bottom.tread, bottom.bottom)
    seat = _seat_cue(last.on(combined("shape", cues)), last.settings)
    cues = cues if seat is None else (*cues, seat)
    return (*cues, doubted("shape", cues))


def _doubted_level(of_tread: float, of_shape: float, settings: StanceSettings) -> float:
    """How sure the level of a tread is, with what the cues leave open beyond the usual, radians."""
    usual = np.radians(settings.usual_sd_deg)
    return float(np.hypot(of_tread, settings.doubt * np.sqrt(max(of_shape**2 - usual**2, 0.0))))


def _seat_cue(stance: Stance, settings: StanceSettings) -> Cue | None:
    """The ground on which the seat has the pitch that seats have under such a heel.

    A ground that is higher by a radian raises the heel by ``arm``, and so the pitch that seats
    have.
    """
    seat = stance.seat_line(settings)
    if seat is None:
        return None
    slope, heel_mm = seat
    pitch = -float(np.arctan(slope))
    share, arm = max(heel_mm, 0.0) / stance.length_mm, stance.touching_x_mm / stance.length_mm
    gain = 1.0 - settings.pitch * arm
    sd = float(np.hypot(np.radians(settings.pitch_sd_deg), settings.pitch_spread * share))
    return Cue("seat", stance.ground + (settings.pitch * share - pitch) / gain, sd / gain)


def _label_cues(last: _StandingLast, labels: StanceLabels, start: float) -> list[Cue]:
    """The ground by each label, from a ``start`` near to it; none of a label that says nothing."""
    settings = last.settings
    says = (
        ("heel_label", labels.drop_mm, Stance.heel_mm, settings.heel_sd_mm, 0.0),
        ("spring_label", labels.toe_spring_mm, Stance.tip_mm, settings.spring_sd_mm, 1.0),
    )
    cues = (
        _solved(last, name, target_mm, height_of, sd_mm, place, start)
        for name, target_mm, height_of, sd_mm, place in says
        if target_mm is not None
    )
    return [cue for cue in cues if cue is not None]


def _solved(
    last: _StandingLast,
    name: str,
    target_mm: float,
    height_of: Callable[[Stance], float | None],
    sd_mm: float,
    place: float,
    start: float,
) -> Cue | None:
    """The ground over which a place (0 rear, 1 tip) has a height; None if it has none.

    If no ground in the range gives the height, what is missing is in the standard deviation.
    """
    least, most = np.radians(last.settings.range_deg)
    ground, arm_mm, miss_mm = start, 1.0, 0.0
    for _ in range(last.settings.rounds):
        stance = last.on(Cue("label", ground, 0.0))
        height_mm = height_of(stance)
        if height_mm is None:
            return None
        arm_mm = stance.touching_x_mm - place * stance.length_mm
        miss_mm = target_mm - height_mm
        ground = float(np.clip(ground + miss_mm / arm_mm, least, most))
        if abs(miss_mm) < last.settings.settled_mm:
            break
    missing_mm = max(abs(miss_mm) - sd_mm, 0.0)
    return Cue(name, ground, float(np.hypot(sd_mm, missing_mm)) / abs(arm_mm))
