"""The sides of a pair: a left and a right foot, and a doubtful one gives way to the other."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from footfit.errors import SameSide
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.preparation import on_side
from footfit.results import AlignedScan, Notice, Profiled, SideName, SideVerdict

OTHER: dict[SideName, SideName] = {"left": "right", "right": "left"}
Foot = AlignedScan | Profiled
"""A foot; it is not profiled yet if its side is undecided."""


def pair_of_feet(feet: Sequence[Foot]) -> tuple[Profiled, ...]:
    """One foot, or the two of a customer on two sides, profiled.

    If both seem to be of one side, the foot that is less surely so is taken as the other one.

    Raises
    ------
    SameSide
        Both feet are surely, or by what was given, of one side.
    SideUndecided
        Neither foot shows which side it is.
    """
    if len(feet) == 2:
        feet = _on_two_sides(*feet)
    return tuple(foot if isinstance(foot, Profiled) else profiled_scan(foot) for foot in feet)


def _on_two_sides(first: Foot, second: Foot) -> tuple[Foot, Foot]:
    sides = _side(first), _side(second)
    known = {verdict.side for verdict in sides} - {None}
    if known in ({"left", "right"}, set()):
        return first, second
    weaker, stronger = sorted(sides, key=_firmness)
    assert stronger.side is not None
    paths = [_aligned(foot).alignment.info.path or "-" for foot in (first, second)]
    if _firmness(weaker)[0]:
        raise SameSide(
            f"this foot and {paths[1]} are both {stronger.side} feet, and a pair has a left and a"
            " right one: check the two files, or give each foot alone",
            paths[0],
        )
    if weaker is sides[0]:
        return _given_way(first, stronger.side, paths[1]), second
    return first, _given_way(second, stronger.side, paths[0])


def _given_way(foot: Foot, other: SideName, path: str) -> AlignedScan:
    reason = f"{Path(path).name} is the {other} foot of the pair"
    return _taken_as(foot, OTHER[other], "pair", reason)


def _firmness(verdict: SideVerdict) -> tuple[bool, float]:
    """Whether a side does not give way; if both do, the higher score stays."""
    firm = verdict.source == "given" or verdict.confidence == "sure"
    return firm, abs(verdict.score) if verdict.side else 0.0


def with_named_side(foot: AlignedScan, named: SideName) -> AlignedScan:
    """A foot whose name says its side: a doubtful detection gives way to the name."""
    side = foot.alignment.side
    if side.source != "detected" or side.confidence == "sure" or side.side == named:
        return foot
    return _taken_as(foot, named, "name", "its name says so")


def _taken_as(foot: Foot, side: SideName, source: str, reason: str) -> AlignedScan:
    """A foot whose detection is doubtful on the side that ``source`` gives it."""
    prepared = _aligned(foot).prepared
    verdict = SideVerdict(side, "low", prepared.side.score, source)
    doubt = f"the side is not sure (score {verdict.score:+.1f})"
    notice = Notice(f"side_from_{source}", f"{doubt}: it is taken as {side}, because {reason}")
    return aligned_scan(on_side(prepared, verdict, notice))


def _side(foot: Foot) -> SideVerdict:
    return _aligned(foot).alignment.side


def _aligned(foot: Foot) -> AlignedScan:
    return foot.aligned if isinstance(foot, Profiled) else foot
