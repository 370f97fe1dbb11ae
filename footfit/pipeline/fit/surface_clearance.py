"""The room between a customer's feet and the lasts of an answer, surface against surface.

It needs the lasts' meshes, which ranking does not read: so it is taken when it is asked for, and
of the lasts that are shown. It judges nothing.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.errors import CatalogueDamaged, NoSole, UnknownLast
from footfit.pipeline.fit.compare import LastShape, laid, stored_last
from footfit.results import Candidate, Match, Profiled, SurfaceRoom


def with_surfaces(match: Match, path: Path) -> Match:
    """The same answer with the room in each shown last, or in the nearest where none fits."""
    return replace(
        match,
        candidates=tuple(_with_room(one, match.feet, path) for one in match.candidates),
        nearest=tuple(_with_room(one, match.feet, path) for one in match.nearest),
    )


def _with_room(candidate: Candidate, feet: tuple[Profiled, ...], path: Path) -> Candidate:
    try:
        last = stored_last(path, candidate.last)
    except (CatalogueDamaged, UnknownLast) as error:
        rooms = tuple(_none(foot, str(error)) for foot in feet)
    else:
        rooms = tuple(surface_room(foot, last) for foot in feet)
    return replace(candidate, surfaces=rooms)


def surface_room(foot: Profiled, last: LastShape) -> SurfaceRoom:
    """The room by zone of one foot in one last: what ``compare`` says of the two."""
    try:
        found = laid(foot, last)
    except NoSole as error:
        return _none(foot, str(error))
    side = foot.aligned.alignment.side.side
    return SurfaceRoom(side, found.way.swing_mm, found.zones)


def _none(foot: Profiled, reason: str) -> SurfaceRoom:
    return SurfaceRoom(foot.aligned.alignment.side.side, None, (), reason)
