"""The clearance between a customer's feet and the lasts of an answer, surface against surface.

It needs the lasts' meshes, which ranking does not read. So it is taken only if it is asked for, and
only of the lasts that are shown. It judges nothing.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.errors import CatalogueDamaged, NoSole, UnknownLast
from footfit.pipeline.fit.compare import LastShape, placed_foot, stored_last
from footfit.results import Candidate, Match, Profiled, SurfaceClearance


def with_surface_clearance(match: Match, path: Path) -> Match:
    """The same answer with the clearance in each last that it shows."""
    return replace(
        match,
        candidates=tuple(_with_clearance(last, match.feet, path) for last in match.candidates),
        nearest=tuple(_with_clearance(last, match.feet, path) for last in match.nearest),
    )


def _with_clearance(candidate: Candidate, feet: tuple[Profiled, ...], path: Path) -> Candidate:
    try:
        last = stored_last(path, candidate.last)
    except (CatalogueDamaged, UnknownLast) as error:
        surfaces = tuple(_unknown(foot, str(error)) for foot in feet)
    else:
        surfaces = tuple(surface_clearance(foot, last) for foot in feet)
    return replace(candidate, surfaces=surfaces)


def surface_clearance(foot: Profiled, last: LastShape) -> SurfaceClearance:
    """The clearance by zone of one foot in one last, as ``compare`` says it."""
    try:
        inside = placed_foot(foot, last)
    except NoSole as error:
        return _unknown(foot, str(error))
    side = foot.aligned.alignment.side.side
    return SurfaceClearance(side, inside.placement.swing_mm, inside.zones)


def _unknown(foot: Profiled, reason: str) -> SurfaceClearance:
    return SurfaceClearance(foot.aligned.alignment.side.side, None, (), reason)
