"""What was judged of a foot in a last, in the words of the page and its pictures."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.number_words import UNITS
from footfit.report.wording.fit_words import zone_number
from footfit.report.wording.text import visible
from footfit.results import Candidate, FootFit, ZoneFit

MARKS = {"good": "●", "acceptable": "▲", "poor": "■", "reject": "✕"}
"""The shape that stands for a verdict, for whom the colours say nothing."""
NO_MARK = "–"


def mark(zone: ZoneFit) -> str:
    """The shape of a zone's verdict; a dash if it is not judged or does not count."""
    return MARKS.get(zone.verdict or "", NO_MARK) if zone.counts else NO_MARK


def zone_name(zone: ZoneFit) -> str:
    """A zone as people call it."""
    return zone.label or zone.zone.replace("_", " ")


def zone_text(zone: ZoneFit) -> str:
    """A zone with its mark, its name and its clearance; in brackets if it does not count.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> zone_text(ZoneFit("ball_girth", "mm", Measured(2.04, 0.8), 0.0, 0.5, "good", True))
    '● ball girth +2.0 mm'
    >>> zone_text(ZoneFit("length", "mm", Measured(15.3, 0.4), 13.0, 0.5, "good", False))
    '(length +15.3 mm)'
    """
    if zone.clearance.value is None:
        return f"{NO_MARK} {zone_name(zone)} not judged"
    words = f"{zone_name(zone)} {zone_number(zone)}{UNITS[zone.unit]}"
    return f"{mark(zone)} {words}" if zone.counts else f"({words})"


def uncounted_lines(fits: Sequence[FootFit]) -> list[str]:
    """Which zones of which foot do not count, and why; a line for each foot and reason."""
    lines: dict[tuple[str, str], list[str]] = {}
    for fit in fits:
        owner = f" of the {fit.side or 'other'} foot" if len(fits) > 1 else ""
        for zone in fit.zones:
            if zone.not_counted:
                lines.setdefault((owner, visible(zone.not_counted)), []).append(zone_name(zone))
    return [
        f"Does not count: {', '.join(names)}{owner} ({reason})"
        for (owner, reason), names in lines.items()
    ]


def unjudged_lines(lasts: Sequence[Candidate]) -> list[str]:
    """Which zones of which lasts are not judged, and why; a line for each reason and zones."""
    lines: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for last in lasts:
        reasons: dict[str, list[str]] = {}
        for fit in last.fits:
            for zone in fit.zones:
                if zone.clearance.value is None:
                    names = reasons.setdefault(visible(zone.clearance.reason or "not measured"), [])
                    names += [zone_name(zone)] if zone_name(zone) not in names else []
        for reason, names in reasons.items():
            lines.setdefault((reason, tuple(names)), []).append(visible(last.last))
    return [
        f"Not judged in {', '.join(owners)}: {', '.join(names)} ({reason})"
        for (reason, names), owners in lines.items()
    ]
