"""How two lasts differ, in words that the terminal and the page share."""

from __future__ import annotations

from footfit.number_words import plain, signed
from footfit.report.wording.text import difference_text, file_name
from footfit.results import LastDifference
from footfit.results.last_making.last_difference import ValueDifference

ZONE_WORDS = {
    "bottom": "under the bottom",
    "medial": "on the inner side",
    "lateral": "on the outer side",
    "dorsal": "on the upper side",
    "toe": "at the toe",
}
"""Where each zone of the surface is."""
ZONE_NAMES = {"medial": "inner side", "lateral": "outer side", "dorsal": "upper side"}
"""What a zone is called in a table, if its name is not plain."""

SECTION_GIRTHS = (
    "A section stands upright. The girths among the measures are of other planes: those named least"
    " are of the plane in which the tape is shortest."
)
"""Why the girth of a section is not the measure of that place."""


def last_names(difference: LastDifference) -> tuple[str, str]:
    """What the two lasts are called."""
    first, second = (file_name(name) for name in difference.names)
    return first, second


def verdict_words(difference: LastDifference) -> str:
    """Whether the lasts agree within the tolerances."""
    judged, outside = difference.judged, difference.outside
    limits = ", ".join(f"{kind} {plain(mm)}" for kind, mm in difference.tolerance_mm.items())
    if not judged:
        return "no measure can be judged"
    words = "all" if not outside else f"{len(judged) - len(outside)} of"
    return f"{words} {len(judged)} judged measures are within the tolerance (mm: {limits})"


def laid_words(difference: LastDifference) -> str:
    """How the second last was laid on the first."""
    mirrored = ", as its mirror image" if difference.mirrored else ""
    return (
        f"the second last is laid on the bottom of the first{mirrored}, heel on heel; the bottoms"
        f" are {plain(difference.laid.rms_mm, 2)} mm apart (root mean square)"
    )


def surface_difference_words(difference: LastDifference) -> str:
    """How far the surfaces differ, and where most."""
    surface, largest = difference.surface, difference.surface.largest
    if largest is None or surface.p95_mm is None or surface.mean_mm is None:
        return "the surfaces cannot be compared"
    where = f"{ZONE_WORDS[largest.zone]}, {place_words(largest.station)}"
    words = (
        f"surfaces, second minus first: mean {signed(surface.mean_mm, 2)} mm; 95 % of the area"
        f" differs by {plain(surface.p95_mm, 2)} mm at most; the most is"
        f" {signed(largest.value_mm, 2)} mm {where}"
    )
    step = plain(difference.resolution_mm, 2)
    return words if step == plain(0.0, 2) else f"{words}; less than {step} mm says nothing"


def place_words(station: float) -> str:
    """Where along the bottom a place is; the edges of a last reach beyond both ends of it.

    Examples
    --------
    >>> place_words(0.5), place_words(1.01)
    ("at .50 of the bottom's length", 'in front of the end of the bottom')
    """
    if station > 1.0:
        return "in front of the end of the bottom"
    if station < 0.0:
        return "behind the start of the bottom"
    return f"at {plain(station, 2).removeprefix('0')} of the bottom's length"


def value_cells(row: ValueDifference) -> tuple[str, str, str, str, str]:
    """First, second, difference, tolerance and verdict of a row of the table."""
    first, second = (
        "-" if known.value is None else plain(known.value) for known in (row.first, row.second)
    )
    tolerance = "" if row.tolerance is None else plain(row.tolerance)
    verdict = {True: "inside", False: "outside", None: ""}[row.inside]
    doubt = " (not sure)" if row.sure is False else ""
    return first, second, difference_text(row.difference), tolerance, verdict + doubt


def value_name(row: ValueDifference) -> str:
    """The name of a measure with its unit, if that is not mm.

    Examples
    --------
    >>> from footfit.results.values import NOT_YET
    >>> value_name(ValueDifference("flare_angle", "deg", NOT_YET, NOT_YET, NOT_YET))
    'flare angle, deg'
    """
    words = row.name.removesuffix("_deg").replace("_", " ")
    return words if row.unit == "mm" else f"{words}, {row.unit}"
