"""The width of a foot: its fitting at the customer's size, and its place among people."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from footfit.geometry.fit.width_fitting import fittings
from footfit.pipeline.scan.measure import CHILD_MM
from footfit.results import FootWidth, Measured, Profiled, WidthShare

FILE = Path(__file__).parent / "survey.toml"
NO_CHILDREN = "the survey has no children"


@dataclass(frozen=True, slots=True)
class SurveyGroup:
    """The women or the men of a survey: their ball girth by length, in mm.

    The mean rises by ``girth_per_length`` from ``mean_girth_mm`` at ``mean_length_mm``;
    ``girth_sd_mm`` is the spread around it. It holds from ``shortest_mm`` to ``longest_mm``.
    """

    people: int
    shortest_mm: float
    longest_mm: float
    mean_length_mm: float
    mean_girth_mm: float
    girth_per_length: float
    girth_sd_mm: float


@dataclass(frozen=True, slots=True)
class Survey:
    """Where the survey comes from, in words, and its groups by name."""

    source: str
    licence: str
    groups: dict[str, SurveyGroup]


@cache
def survey() -> Survey:
    """The survey that comes with footfit, which ``tools/make_survey.py`` summed up."""
    table = tomllib.loads(FILE.read_text(encoding="utf-8"))
    groups = {name: SurveyGroup(**group) for name, group in table["groups"].items()}
    return Survey(table["source"], table["licence"], groups)


def survey_words() -> str:
    """Where the shares come from, in words.

    Examples
    --------
    >>> survey_words()
    '1,986 women, 4,082 men; ANSUR II, US Army 2012, soldiers of 17 to 58 years (US public domain)'
    """
    known = survey()
    counts = ", ".join(f"{group.people:,} {name}" for name, group in known.groups.items())
    return f"{counts}; {known.source} ({known.licence})"


def foot_widths(
    feet: Sequence[Profiled], usual_mm: tuple[float, float] | None = None
) -> tuple[FootWidth, ...]:
    """The width of each foot of a customer, at the size of the longer one.

    ``usual_mm`` are the usual lengths of the fit profile's feet, None for adults. A child is not
    compared with adults.
    """
    known = [foot.length_mm for foot in feet if foot.length_mm is not None]
    size_mm = max(known) if len(known) == len(feet) else None
    child = usual_mm is not None and usual_mm[0] < CHILD_MM
    return tuple(_foot_width(foot, size_mm, child=child) for foot in feet)


def _foot_width(foot: Profiled, size_mm: float | None, *, child: bool) -> FootWidth:
    known = {row.name: row.measured for row in foot.measures}
    girth = known.get("ball_girth", Measured(None))
    width = known.get("ball_width", Measured(None))
    shares = tuple(
        WidthShare(name, None, None, NO_CHILDREN)
        if child
        else width_share(name, group, foot.length_mm, girth)
        for name, group in survey().groups.items()
    )
    at_size = fittings(size_mm, girth.value, width.value) if size_mm else ()
    return FootWidth(at_size, shares)


def width_share(
    name: str, group: SurveyGroup, length_mm: float | None, girth: Measured
) -> WidthShare:
    """How many people of a group have a smaller ball girth, at the same length.

    Examples
    --------
    >>> women = survey().groups["women"]
    >>> share = width_share("women", women, 246.3, Measured(237.47, 1.0))
    >>> round(share.percent, 1), round(share.percent_sd, 1)
    (84.1, 2.6)
    >>> width_share("women", women, 290.0, Measured(237.0)).reason
    'the survey has no women with feet this long'
    """
    if length_mm is None or girth.value is None:
        lacking = "length" if length_mm is None else "ball girth"
        return WidthShare(name, None, None, f"the {lacking} of the foot is not known")
    if not group.shortest_mm <= length_mm <= group.longest_mm:
        word = "short" if length_mm < group.shortest_mm else "long"
        return WidthShare(name, None, None, f"the survey has no {name} with feet this {word}")
    mean_mm = group.mean_girth_mm + group.girth_per_length * (length_mm - group.mean_length_mm)
    z = (girth.value - mean_mm) / group.girth_sd_mm
    percent = 50.0 * (1.0 + math.erf(z / math.sqrt(2.0)))
    density = math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)
    sd_mm = girth.total_sd if girth.total_sd is not None else girth.sd
    percent_sd = None if sd_mm is None else 100.0 * density * sd_mm / group.girth_sd_mm
    return WidthShare(name, percent, percent_sd)
