"""Which last a name means: its own spelling first, then any other case.

"é" may be one sign or two (Unicode's NFC and NFD): both are the same name.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.verified_rows import key_where, last_names
from footfit.errors import NameTaken, UnknownLast


def composed(name: str) -> str:
    r"""A name with each accent in the sign that it belongs to (NFC).

    Examples
    --------
    >>> composed("Rene\u0301") == "Ren\u00e9"
    True
    """
    return name if name.isascii() else unicodedata.normalize("NFC", name)


def caseless(name: str) -> str:
    r"""A name without regard to case and to how accents are written.

    Examples
    --------
    >>> caseless("DERBY-40"), caseless("RENE\u0301") == caseless("ren\u00e9")
    ('derby-40', True)
    """
    if name.isascii():
        return name.lower()
    return composed(unicodedata.normalize("NFD", name).casefold())


def meant_name(names: Iterable[str], name: str) -> str | None:
    """The name among ``names`` that a typed name means; None if there is none.

    Raises
    ------
    UnknownLast
        Several names differ from it only in case.
    """
    alike = [each for each in names if caseless(each) == caseless(name)]
    same = [each for each in alike if composed(each) == composed(name)]
    if name in same:
        return name
    meant = same or alike
    if len(meant) > 1:
        listed = ", ".join(map(repr, sorted(meant)))
        raise UnknownLast(f"{name!r} may be {listed}: type the name as it is stored")
    return meant[0] if meant else None


def nearest_name(names: Iterable[str], name: str) -> str | None:
    """The name that is most like a mistyped one, whatever the case; None if none is like it.

    Examples
    --------
    >>> nearest_name(["derby-40", "loafer-39"], "DERBI-40"), nearest_name(["derby-40"], "boot")
    ('derby-40', None)
    """
    from difflib import get_close_matches

    spelled = {caseless(each): each for each in names}
    close = get_close_matches(caseless(name), spelled, n=1)
    return spelled[close[0]] if close else None


def last_id(connection: Driver, name: str) -> int:
    """The key of the last that a name means.

    Raises
    ------
    UnknownLast
        There is none, or there are several; the message gives the nearest name.
    """
    key = key_where(connection, "name", name)
    if key is not None:
        return key
    keys = {stored: key for key, stored in last_names(connection).items()}
    meant = meant_name(keys, name)
    if meant is not None:
        return keys[meant]
    close = nearest_name(keys, name)
    nearest = "" if close is None else f" (the nearest is {close!r})"
    raise UnknownLast(f"no last is named {name!r}{nearest}; see footfit list-lasts")


def id_of_same_name(connection: Driver, name: str) -> int | None:
    """The key of the last of that name, also if its accents are written otherwise; None for none.

    Raises
    ------
    NameTaken
        Another last's name differs only in case.
    """
    key = key_where(connection, "name", name)
    if key is not None:
        return key
    keys = {stored: stored_key for stored_key, stored in last_names(connection).items()}
    alike = [stored for stored in keys if caseless(stored) == caseless(name)]
    same = [stored for stored in alike if composed(stored) == composed(name)]
    if alike and not same:
        raise differs_in_case(alike[0])
    return keys[same[0]] if same else None


def differs_in_case(stored: str) -> NameTaken:
    """The refusal of a name that differs from a stored one only in case."""
    words = f"the catalogue has {stored!r}, a name that differs only in case: choose another name"
    return NameTaken(words)
