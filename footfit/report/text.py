"""Numbers and outside strings as people read them."""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from footfit.results import Measured

_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
_CONTROL_PICTURES = 0x2400
_DELETE = 0x7F


def visible(text: str) -> str:
    r"""``text`` with every character that hides, moves or breaks shown as a sign.

    Control characters become their Unicode pictures; format characters (direction overrides,
    zero-width ones), line separators and bytes that were no text become ``<U+...>``.

    Examples
    --------
    >>> visible("a\nb\x1b[31m")
    'a␊b␛[31m'
    >>> visible("left\u202efoot")
    'left<U+202E>foot'
    """
    return "".join(_sign(character) for character in text)


def _sign(character: str) -> str:
    if unicodedata.category(character) not in _HIDDEN:
        return character
    code = ord(character)
    if code < ord(" "):
        return chr(_CONTROL_PICTURES + code)
    return "␡" if code == _DELETE else f"<U+{code:04X}>"


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


def signed(value: float, digits: int = 1) -> str:
    """A number with its sign, and never a negative zero.

    Examples
    --------
    >>> signed(3.24), signed(-3.24), signed(-0.01)
    ('+3.2', '-3.2', '+0.0')
    """
    return f"{round(value, digits) + 0.0:+.{digits}f}"


def plain(value: float, digits: int = 1) -> str:
    """A number without a plus sign, and never a negative zero.

    Examples
    --------
    >>> plain(3.24), plain(-0.01)
    ('3.2', '0.0')
    """
    return f"{round(value, digits) + 0.0:.{digits}f}"


def measured_text(measured: Measured, unit: str, *, sign: bool = False) -> str:
    """A measured value with its uncertainty and unit, or the reason why there is none.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> measured_text(Measured(262.31, 0.42), "mm")
    '262.3 ± 0.4 mm'
    >>> measured_text(Measured(12.0), "mm", sign=True)
    '+12.0 mm'
    >>> measured_text(Measured(None, reason="the sole is missing"), "mm")
    'not measured (the sole is missing)'
    """
    if measured.value is None:
        return f"not measured ({measured.reason})" if measured.reason else "not measured"
    number = signed(measured.value) if sign else plain(measured.value)
    spread = f" ± {plain(measured.sd)}" if measured.sd is not None else ""
    return f"{number}{spread} {unit}"


def size_text(size: str | None, system: str | None, width: str | None = None) -> str:
    """A size label with its system and width, as given; empty where there is none.

    Examples
    --------
    >>> size_text("42", "eu", "G"), size_text(None, None)
    ('EU 42 G', '')
    """
    parts = (system.upper() if system else None, size, width)
    return visible(" ".join(part for part in parts if part))
