"""How a foot lies in a last, in words that the terminal, the page and the pictures share."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from footfit.geometry.fit.clearance import CLEARANCE, ZoneClearance
from footfit.number_words import UNITS, plain, signed
from footfit.report.wording.fit_words import zone_number
from footfit.report.wording.text import difference_text, file_name, length_text, visible
from footfit.report.wording.zone_words import zone_name
from footfit.results import Comparison, FootFit, SurfaceClearance, TightPlace, ZoneFit
from footfit.results.fit import ZONE_LABELS
from footfit.results.heel import FLARE, heel_words

SIZE_HEADS = {
    "width": "width",
    "medial": "medial edge",
    "lateral": "lateral edge",
    "height": "height",
}
"""The sizes of a section by name, as the head of a column says them."""
MOST_ZONES = 2
ZONE_PLACES = {
    "bottom": "under the foot",
    "medial": "on the inner side",
    "lateral": "on the outer side",
    "dorsal": "on top of the foot",
    "toe": "at the toes",
}
"""Where each zone of the surface is."""
JUDGED_BY = {
    "bottom": (),
    "medial": ("ball_girth", "ball_width"),
    "lateral": ("ball_girth", "ball_width"),
    "dorsal": ("ball_girth", "waist_girth", "instep_girth"),
    "toe": ("length", "toes", "toe_height"),
}
"""The judged zones that go around a zone of the surface."""


def comparison_names(comparison: Comparison) -> tuple[str, str]:
    """What the foot and the last are called."""
    foot = file_name(comparison.foot.aligned.alignment.info.path)
    return foot, visible(comparison.last.labels.name)


def lengths_words(comparison: Comparison) -> str:
    """The two lengths, the toe room, and the difference in flare.

    Two lasts have no toe room: the same figure is how much longer the second one is.
    """
    foot, last = comparison.foot.aligned.alignment.length, comparison.last.length
    room, (first, second) = comparison.toe_room, comparison.nouns
    words = "not known" if room.value is None else f"{difference_text(room)} mm"
    head = "difference in length along the bottom" if comparison.foot.is_last else "toe room"
    return (
        f"{first} {length_text(foot)}, {second} {length_text(last)}; {head} {words}; "
        f"flare {signed(comparison.flare_delta_deg)} deg"
    )


def measures_words(comparison: Comparison) -> str:
    """The clearance of each measure that both have, as a match gives it."""
    first, second = comparison.nouns
    known = [
        f"{ZONE_LABELS[name]} {difference_text(clearance)}"
        for name, clearance in comparison.measured_clearance
        if clearance.value is not None
    ]
    only_length = comparison.heel is not None and comparison.heel.length_only
    none = "none is judged at so high a drop" if only_length else "none that both have"
    return f"Measures, {second} minus {first} in mm: {', '.join(known) or none}"


def change_words(comparison: Comparison) -> str:
    """What the heel of the last changes of the foot; empty if that is not worth a word."""
    return heel_words(comparison.heel, ("length", "ball_girth", FLARE))


def swing_words(comparison: Comparison) -> str:
    """How far apart the balls of foot and last lie, heel on heel; how the last turns, if the flare
    says the same.

    A shape that turns less inward has its ball further to the inner side of its axis.
    """
    swing, turn = comparison.placement.swing_mm, comparison.flare_delta_deg
    first, second = comparison.nouns
    size = f"{plain(abs(swing))} mm at the ball"
    if swing * turn < 0.0 and plain(abs(turn)) != plain(0.0):
        return (
            f"the {second} turns {'less' if swing > 0 else 'more'} inward than the {first}: {size}"
        )
    side = "inner" if swing > 0 else "outer"
    return f"heel on heel, the {second} lies further to the {side} side than the {first}: {size}"


def surfaces_words(rooms: Sequence[SurfaceClearance]) -> list[str]:
    """Where each foot is tight and where it is loose in one last, a line a foot."""
    named = len(rooms) > 1
    return [
        f"{room.side or 'the'} foot: {surface_words(room)}" if named else surface_words(room)
        for room in rooms
    ]


def surface_words(room: SurfaceClearance) -> str:
    """Where a last presses on a foot and where it is loose.

    A zone is named if it is tight, or loose, on enough of its area. "Up to" is the 5 or the 95 %
    quantile of its clearance; the zone where that is largest comes first.

    Examples
    --------
    >>> from footfit.geometry.fit.clearance import ZoneClearance
    >>> from footfit.results import SurfaceClearance
    >>> inner = ZoneClearance("medial", 0.6, -20.94, 9.2, 91.0, 74.4, 5.2)
    >>> top = ZoneClearance("dorsal", 0.6, -3.1, 5.2, 91.0, 26.4, 5.2)
    >>> surface_words(SurfaceClearance("right", 2.9, (top, inner)))
    'the surface presses most on the inner side: up to 20.9 mm; and on top of the foot'
    >>> surface_words(SurfaceClearance("right", None, (), "the sole is open"))
    'no clearance between the surfaces: the sole is open'
    """
    if room.reason is not None:
        return f"no clearance between the surfaces: {visible(room.reason)}"
    zones = room.zones
    tight = _zones_words((z.zone, z.p05_mm, z.tight_cm2, z.area_cm2) for z in zones)
    loose = _zones_words((z.zone, z.p95_mm, z.loose_cm2, z.area_cm2) for z in zones)
    named = (("the surface presses most", tight), ("loosest", loose))
    parts = [f"{word} {words}" for word, words in named if words]
    nowhere = (
        f"no zone is tight by {plain(-CLEARANCE.tight_mm, 0)} mm or loose by "
        f"{plain(CLEARANCE.loose_mm, 0)} mm on a tenth of its area"
    )
    return "; ".join(parts) or nowhere


def _zones_words(zones: Iterable[tuple[str, float | None, float, float]]) -> str:
    """The zones that are worth a word; each is (name, quantile mm, this area, whole area cm2)."""
    known = sorted(
        (-abs(mm), ZONE_PLACES[name])
        for name, mm, area, whole in zones
        if mm is not None and area > CLEARANCE.worth_saying * whole
    )
    if not known:
        return ""
    (most, place), *others = known[:MOST_ZONES]
    return "; and ".join([f"{place}: up to {plain(-most)} mm", *(words for _, words in others)])


def tightest_words(place: TightPlace | None) -> str:
    """The tightest place of a customer's feet in a last.

    Examples
    --------
    >>> from footfit.results import TightPlace
    >>> tightest_words(TightPlace("right", "medial", -7.21, 26.4))
    'tightest on the inner side of the right foot: up to 7.2 mm (26 cm2)'
    >>> tightest_words(TightPlace("left", "big toe, inner wall", -3.04))
    'tightest at the big toe of the left foot: 3.0 mm through the inner wall'
    """
    if place is None:
        return f"nowhere tight by {plain(-CLEARANCE.tight_mm, 0)} mm"
    foot = f" of the {place.side} foot" if place.side else ""
    depth = plain(-place.clearance_mm)
    if place.tight_cm2 is None:
        toe, _, wall = place.place.partition(", ")
        return f"tightest at the {toe}{foot}: {depth} mm through the {wall}"
    area = plain(place.tight_cm2, 0)
    return f"tightest {_place_of(place.place, place.side)}: up to {depth} mm ({area} cm2)"


def _place_of(zone: str, side: str | None) -> str:
    """Where a zone of the surface of one foot is: "on top of the right foot"."""
    place = ZONE_PLACES[zone]
    if side is None or "the foot" in place:
        return place.replace("the foot", f"the {side} foot" if side else "the foot")
    return f"{place} of the {side} foot"


def pressed_words(
    side: str | None, zones: Iterable[ZoneClearance], fit: FootFit | None
) -> list[str]:
    """Where the surface is far too tight on a large area, and what the verdict says of it.

    A sentence for each such zone of one foot in a last. ``fit`` is None where nothing was judged.
    """
    limit = f"{plain(-CLEARANCE.pressed_mm, 0)} mm"
    sentences = []
    for zone in zones:
        if zone.pressed_cm2 <= CLEARANCE.pressed_cm2:
            continue
        judged = [
            each
            for each in (() if fit is None else fit.zones)
            if each.zone in JUDGED_BY[zone.zone] and each.verdict is not None
        ]
        tight = [each for each in judged if each.verdict != "good" and (each.score or 0.0) < 0.0]
        where = _place_of(zone.zone, side)
        start = (
            f"{where[0].upper()}{where[1:]} {plain(zone.pressed_cm2, 0)} cm2 lie more than {limit} "
            "outside of the last."
        )
        if tight:
            end = f"That is judged: {_verdicts(tight)}."
        elif judged:
            end = (
                f"What is judged there fits, so it counts for nothing: {_verdicts(judged)}. "
                "A bare foot is wider and flatter than it is in a shoe, and gives way."
            )
        else:
            end = "No zone that is judged lies there."
        sentences.append(f"{start} {end}")
    return sentences


def _verdicts(zones: Sequence[ZoneFit]) -> str:
    """Zones with their clearance and verdict in words."""
    return ", ".join(
        f"{zone_name(zone)} {zone_number(zone)}{UNITS[zone.unit]} ({zone.verdict})"
        for zone in zones
    )
