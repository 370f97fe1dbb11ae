"""Numbers and outside strings as people read them."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from footfit.number_words import first_names, plain, signed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from footfit.geometry.flare.definition import FlareProfile
    from footfit.results import Alignment, Candidate, LastLabels, Match, Measured, Profiled

SHOWN_SYSTEMS = ("eu", "uk", "us-men", "us-women", "mondopoint")
"""The size systems that a foot's size is shown in, in this order."""


def visible(text: str) -> str:
    r"""``text`` with every character that hides, moves or breaks shown as its escape.

    Control characters, direction overrides, zero-width ones, line separators and bytes that
    were no text; stderr's lines show them the same way.

    Examples
    --------
    >>> visible("a\nb\x1b[31m")
    'a\\nb\\x1b[31m'
    >>> visible("left\u202efoot")
    'left\\u202efoot'
    """
    if text.isprintable():
        return text
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)


def tie_words(names: Sequence[str], named: int = 3) -> str:
    """The lasts that the distance does not tell from this one, the first few by name.

    Examples
    --------
    >>> tie_words(("a", "b")), tie_words(("a", "b", "c", "d", "e"))
    ('tied with a, b', 'tied with a, b, c and 2 more')
    """
    return f"tied with {first_names([visible(name) for name in names], named)}"


def file_name(path: str | None) -> str:
    r"""The last part of a path, without the folders, which say where a machine keeps things.

    Examples
    --------
    >>> file_name("/home/someone/feet/anna.stl"), file_name("C:\\feet\\anna.stl"), file_name(None)
    ('anna.stl', 'anna.stl', 'standard input')
    """
    if path is None:
        return "standard input"
    return visible(re.split(r"[/\\]", path.rstrip("/\\"))[-1])


OF_RIM = (
    "a program closed a hole of the scan; nothing was scanned there, so bottom, plan and side"
    " end at its rim"
)
SPREADS = (
    "± is the spread of a second scan of the same shape; total ± also holds what is known of the"
    " trueness."
)


def measured_text(measured: Measured, unit: str) -> str:
    """A measured value with its uncertainty and unit, or the reason why there is none.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> measured_text(Measured(262.31, 0.42), "mm")
    '262.3 ± 0.4 mm'
    >>> measured_text(Measured(262.31, 0.42, None, 0.71, -0.2), "mm")
    '262.3 ± 0.4 mm, total ± 0.7'
    >>> measured_text(Measured(None, reason="the sole is missing"), "mm")
    'not measured (the sole is missing)'
    """
    if measured.value is None:
        return f"not measured ({measured.reason})" if measured.reason else "not measured"
    spread = f" ± {plain(measured.sd)}" if measured.sd is not None else ""
    total = "" if measured.total_sd is None else f", total ± {plain(measured.total_sd)}"
    return f"{plain(measured.value)}{spread} {unit}{total}"


def length_text(length: Measured) -> str:
    """A length without its spread, or the reason why it is not known.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> length_text(Measured(262.31, 0.25)), length_text(Measured(None, reason="open"))
    ('262.3 mm', 'not measured (open)')
    """
    return measured_text(replace(length, sd=None, total_sd=None), "mm")


def difference_text(measured: Measured) -> str:
    """A difference with its sign and uncertainty, or a dash where there is none.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> difference_text(Measured(3.24, 0.71)), difference_text(Measured(None, reason="cut"))
    ('+3.2 ± 0.7', '-')
    """
    if measured.value is None:
        return "-"
    spread = f" ± {plain(measured.sd)}" if measured.sd is not None else ""
    return f"{signed(measured.value)}{spread}"


def turn_words(flare: FlareProfile, unit: str) -> str:
    """The flare angle with both its uncertainties."""
    turned = f"{signed(flare.angle_deg)} ± {plain(flare.angle_sd_deg)} {unit}"
    return f"{turned}, total ± {plain(flare.angle_total_sd_deg)}"


def angle_text(flare: FlareProfile) -> str:
    """The flare angle with its uncertainty."""
    return f"{signed(flare.angle_deg)}° ± {plain(flare.angle_sd_deg)}°"


def class_words(flare: FlareProfile) -> str:
    """The name of a last's flare in brackets, after a blank; nothing for a foot."""
    return "" if flare.flare_class is None else f" ({flare.flare_class})"


def shape_words(alignment: Alignment) -> str:
    """The file's name, the side, and whether it is a foot or a last."""
    side = alignment.side.side or "side undecided,"
    return f"{file_name(alignment.info.path)}   {side} {alignment.pose.kind}"


def size_text(labels: LastLabels | Candidate) -> str:
    """A size label with its system and width, as given; empty where there is none.

    Examples
    --------
    >>> from footfit.results import LastLabels
    >>> size_text(LastLabels("derby", None, "42", "eu", "G")), size_text(LastLabels("derby"))
    ('EU 42 G', '')
    """
    parts = ((labels.size_system or "").upper(), labels.size, labels.width_label)
    return visible(" ".join(part for part in parts if part))


def shown_size_text(candidate: Candidate) -> str:
    """A last's size label as given, and in the size system that was asked for."""
    size = size_text(candidate)
    return f"{size} ({candidate.size_asked})" if candidate.size_asked else size


def is_scanned_last(shape: Profiled, match: Match) -> bool:
    """Whether a search by shape was made with a last: then it is spoken of as one."""
    return match.by == "shape" and shape.aligned.alignment.pose.kind == "last"


def side_doubts(match: Match) -> list[str]:
    """What the reader of a match must know first: each given side that the shape contradicts."""
    return [
        f"{file_name(foot.aligned.alignment.info.path)}: {notice.message}"
        for foot in match.feet
        for notice in foot.aligned.alignment.warnings
        if notice.code == "side_contradicted"
    ]
