"""One foot in one last: the clearance by zone, and the differences by section."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.geometry.fit.clearance import CLEARANCE
from footfit.results.heel import FLARE, HeelChange
from footfit.results.values import (
    Document,
    Json,
    Measured,
    Part,
    fields,
    json_number,
    measured_part,
    part,
    rows,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from footfit.geometry.fit.clearance import ZoneClearance
    from footfit.geometry.fit.placement import Placement
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.fit import ToeBox
    from footfit.results.last_record import LastRecord
    from footfit.results.profile import Profiled
    from footfit.results.values import Notice, SideName


SPREADS = ("value", "sd", "total_sd", "reason")
"""What a row says of a measured value."""


def comparison_nouns(foot: Profiled) -> tuple[str, str]:
    """What the two shapes of a comparison are called: a foot and a last, or two lasts."""
    return ("first last", "second last") if foot.is_last else ("foot", "last")


def zone_part(zone: ZoneClearance) -> Json:
    """The clearance in one zone; null if no part of it is compared."""
    return part(fields(zone, "zone"))


def zones_part(zones: Iterable[ZoneClearance]) -> Json:
    """The clearance in each zone, by its name."""
    return {zone.zone: zone_part(zone) for zone in zones}


@dataclass(frozen=True, slots=True)
class SizeDifference(Part):
    """One size of one section in mm: of the foot, of the last, and their difference."""

    name: str
    foot: Measured
    last: Measured
    difference: Measured

    not_written = ("name",)


@dataclass(frozen=True, slots=True)
class SectionComparison(Part):
    """Foot and last cut by one plane at a named ``station``, ``x_mm`` from the foot's heel.

    The outlines are closed loops (k, 2), across (+ is medial) and up, mm.
    """

    station: str
    x_mm: float
    foot_outline: tuple[Floats, ...]
    last_outline: tuple[Floats, ...]
    sizes: tuple[SizeDifference, ...]

    def _keys(self) -> Json:
        sizes = part({size.name: size for size in self.sizes})
        return {"station": self.station, "x_mm": self.x_mm, "sizes": sizes}


@dataclass(frozen=True, slots=True)
class SurfaceClearance(Part):
    """One foot of a customer in one last: the clearance between the surfaces, zone by zone.

    ``swing_mm`` is how far the foot's tread moves to medial to lie on the last's. ``reason`` says
    why the foot could not be placed; there are no zones then.
    """

    side: SideName | None
    swing_mm: float | None
    zones: tuple[ZoneClearance, ...]
    reason: str | None = None

    def _keys(self) -> Json:
        return fields(self) | {"zones": zones_part(self.zones)}


@dataclass(frozen=True, slots=True)
class TightPlace(Part):
    """The tightest place of a customer's feet in a last.

    ``place`` is a zone of the surface, whose ``clearance_mm`` is the 5 % quantile and ``tight_cm2``
    the area that is tight; or a toe and its wall, without an area.
    """

    side: SideName | None
    place: str
    clearance_mm: float
    tight_cm2: float | None = None


def tightest_place(
    surfaces: Iterable[tuple[SideName | None, Iterable[ZoneClearance]]],
    toes: Iterable[tuple[SideName | None, ToeBox | None]],
) -> TightPlace | None:
    """The tightest place of feet by their side: of their surfaces' zones, and of their toes.

    None if no zone is tight on a tenth of its area, and no toe stands so far through its wall. The
    bottom is left out: a foot stands on it.
    """
    places = [
        TightPlace(side, zone.zone, zone.p05_mm, zone.tight_cm2)
        for side, zones in surfaces
        for zone in zones
        if zone.zone != "bottom" and zone.is_tight and zone.p05_mm is not None
    ]
    for side, box in toes:
        value_mm = None if box is None else box.tightest.clearance.value
        if box is not None and value_mm is not None and value_mm < CLEARANCE.tight_mm:
            places.append(TightPlace(side, box.tightest.place, value_mm))
    return min(places, key=lambda place: place.clearance_mm, default=None)


@dataclass(frozen=True, slots=True)
class Comparison(Document):
    """A foot, or another last, in a last, both as right shapes in the last's frame, mm.

    ``heel`` is what the last's heel changes of the foot; None for a foot that is taken as scanned.
    The surfaces and sections are of the foot as it is in the heel. ``toe_room`` and
    ``measured_clearance``, by measure, are those of a match.
    ``vertices_mm`` (n, 3) and ``faces`` (m, 3) are the foot in its place, ``clearance_mm`` (n,) its
    clearance at each vertex, NaN where no shoe covers the foot; ``last_vertices_mm`` and
    ``last_faces`` are the last. ``mirrored``: the last is of the other side. ``step_mm`` is that
    of the colours. ``is_difference``: two lasts are laid on each other, and nothing is tight.
    """

    foot: Profiled
    last: LastRecord
    mirrored: bool
    placement: Placement
    vertices_mm: Floats
    faces: Ints
    last_vertices_mm: Floats
    last_faces: Ints
    clearance_mm: Floats
    zones: tuple[ZoneClearance, ...]
    sections: tuple[SectionComparison, ...]
    warnings: tuple[Notice, ...]
    toe_room: Measured
    measured_clearance: tuple[tuple[str, Measured], ...] = ()
    heel: HeelChange | None = None
    step_mm: float = 2.0
    is_difference: bool = False

    columns = (
        *("path", "last", "part", "place", "quantity", "unit"),
        *("foot", "last_value", "difference", "sd", "total_sd", "reason"),
    )

    @property
    def nouns(self) -> tuple[str, str]:
        """What the two shapes are called."""
        return comparison_nouns(self.foot)

    @property
    def flare_delta_deg(self) -> float:
        """The flare angles' difference: the last minus the foot as it is in the heel."""
        turn = None if self.heel is None else self.heel.change_of(FLARE)
        turn_deg = 0.0 if turn is None or turn.value is None else turn.value
        return self.last.flare.angle_deg - self.foot.flare.angle_deg - turn_deg

    schema = "compare/3"

    def _keys(self) -> Json:
        alignment = self.foot.aligned.alignment
        return {
            "mesh": alignment.info,
            "kind": "last" if self.foot.is_last else "foot",
            **alignment.side.to_dict(),
            "last": self.last.labels.name,
            "last_side": self.last.side.side,
            "mirrored": self.mirrored,
            "length_mm": _lengths_part(alignment.length_mm, self.last.length_mm),
            "extent_mm": _lengths_part(alignment.extent_mm, self.last.extent_mm),
            "toe_room_mm": self.toe_room,
            "clearance_mm": measured_part((("length", self.toe_room), *self.measured_clearance)),
            "flare_delta_deg": self.flare_delta_deg,
            "heel": self.heel,
            "docking": part(fields(self.placement, "hinge_mm", "hinge_length_mm")),
            "zones": zones_part(self.zones),
            "sections": self.sections,
            "warnings": self.warnings,
        }

    def rows(self) -> list[Json]:
        """A table: a row for the toe room, for the clearance of each measure and each change in the
        heel, for each size of each section, and for each figure of each zone.
        """
        start = (self.foot.aligned.alignment.info.path, self.last.labels.name)
        values: list[tuple[object, ...]] = [
            (*start, *head, None, None, *(known[name] for name in SPREADS))
            for head, known in self._whole()
        ]
        for section in self.sections:
            for size in section.sizes:
                place = (*start, "section", section.station, size.name, "mm")
                foot, last, longer = (m.to_dict() for m in (size.foot, size.last, size.difference))
                spreads = (longer["sd"], longer["total_sd"], size.difference.reason)
                values.append((*place, foot["value"], last["value"], longer["value"], *spreads))
        for zone in self.zones:
            for name, value in zone_part(zone).items():
                quantity, unit = name.rsplit("_", 1)
                place = (*start, "zone", zone.zone, quantity, unit)
                values.append((*place, None, None, value, *[None] * 3))
        return rows(self.columns, values)

    def _whole(self) -> list[tuple[tuple[str, str, str, str], Json]]:
        """What rows say of the whole foot: where they stand, and what they say."""
        heads = [(("whole", "length", "toe_room", "mm"), self.toe_room)]
        for name, clearance in self.measured_clearance:
            heads.append((("whole", name, "clearance", "mm"), clearance))
        if self.heel is not None:
            drop = Measured(self.heel.drop_mm, reason="the heel of the last is not known")
            heads.append((("heel", "last", "drop", "mm"), drop))
            for name, change in self.heel.changes:
                unit = "deg" if name == FLARE else "mm"
                heads.append((("heel", name, "change", unit), change))
        return [(head, known.to_dict()) for head, known in heads]


def _longer_mm(foot_mm: float | None, last_mm: float | None) -> float | None:
    return None if foot_mm is None or last_mm is None else last_mm - foot_mm


def _lengths_part(foot_mm: float | None, last_mm: float | None) -> Json:
    lengths = {"foot": foot_mm, "last": last_mm, "difference": _longer_mm(foot_mm, last_mm)}
    return {name: json_number(value) for name, value in lengths.items()}
