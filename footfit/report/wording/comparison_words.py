"""How a foot lies in a last, in words that the terminal, the page and the pictures share."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from footfit.geometry.fit.clearance import CLEARANCE
from footfit.report.wording.text import (
    difference_text,
    file_name,
    length_text,
    plain,
    signed,
    visible,
)
from footfit.results import Comparison, SurfaceClearance
from footfit.results.heel import FLARE, heel_words

SIZE_HEADS = {
    "width": "width",
    "medial": "medial edge",
    "lateral": "lateral edge",
    "height": "height",
    "girth": "girth",
}
"""The sizes of a section by name, as the head of a column says them."""
WORTH_SAYING = 0.10
"""The share of a zone that must be tight, or loose, to be worth a word."""
MOST_ZONES = 2


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
    head = "difference in functional length" if comparison.foot.is_last else "toe room"
    return (
        f"{first} {length_text(foot)}, {second} {length_text(last)}; {head} {words}; "
        f"flare {signed(comparison.flare_delta_deg)} deg"
    )


def change_words(comparison: Comparison) -> str:
    """What the heel of the last changes of the foot; empty if that is not worth a word."""
    return heel_words(comparison.heel, ("length", "ball_girth", FLARE))


def swing_words(comparison: Comparison) -> str:
    """How far the foot's tread was moved sideways to lie on the last's."""
    swing, (first, second) = comparison.placement.swing_mm, comparison.nouns
    side = "medial" if swing > 0 else "lateral"
    return (
        f"heel on heel, the {first}'s tread was moved {plain(abs(swing))} mm to {side} to lie on "
        f"the {second}'s"
    )


def surfaces_words(rooms: Sequence[SurfaceClearance]) -> list[str]:
    """Where each foot is tight and where it is loose in one last, a line a foot."""
    named = len(rooms) > 1
    return [
        f"{room.side or 'the'} foot: {surface_words(room)}" if named else surface_words(room)
        for room in rooms
    ]


def surface_words(room: SurfaceClearance) -> str:
    """Where a foot is tight in a last and where it is loose.

    The zone with the largest such area comes first, with the 5 or 95 % quantile of its clearance.

    Examples
    --------
    >>> from footfit.geometry.fit.clearance import ZoneClearance
    >>> from footfit.results import SurfaceClearance
    >>> tight = ZoneClearance("medial", 0.6, -6.15, 9.2, 91.0, 26.4, 5.2)
    >>> loose = ZoneClearance("toe", 5.6, -1.1, 12.31, 47.0, 1.5, 17.6)
    >>> surface_words(SurfaceClearance("right", 2.9, (tight, loose)))
    'tight: medial -6.2 mm (26 cm2); loose: toe +12.3 mm (18 cm2)'
    >>> surface_words(SurfaceClearance("right", None, (), "the sole is open"))
    'no clearance between the surfaces: the sole is open'
    """
    if room.reason is not None:
        return f"no clearance between the surfaces: {visible(room.reason)}"
    zones = room.zones
    tight = _zones_words((z.zone, z.p05_mm, z.tight_cm2, z.area_cm2) for z in zones)
    loose = _zones_words((z.zone, z.p95_mm, z.loose_cm2, z.area_cm2) for z in zones)
    parts = [f"{word}: {words}" for word, words in (("tight", tight), ("loose", loose)) if words]
    nowhere = (
        f"nowhere tight by {plain(-CLEARANCE.tight_mm, 0)} mm, "
        f"nowhere loose by {plain(CLEARANCE.loose_mm, 0)} mm"
    )
    return "; ".join(parts) or nowhere


def _zones_words(zones: Iterable[tuple[str, float | None, float, float]]) -> str:
    """The zones with the largest areas; each is (name, quantile mm, this area, whole area cm2)."""
    known = [
        (area, f"{name} {signed(mm)} mm ({plain(area, 0)} cm2)")
        for name, mm, area, whole in zones
        if mm is not None and area > WORTH_SAYING * whole
    ]
    largest = sorted(known, key=lambda zone: -zone[0])[:MOST_ZONES]
    return ", ".join(words for _, words in largest)
