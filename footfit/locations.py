"""Where a catalogue is: a file, or the address of a PostgreSQL server."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote, urlsplit

from footfit.errors import BadOption

SCHEME = "postgresql+psycopg"
FORM = f"{SCHEME}://USER@HOST:PORT/DATABASE"
_ADDRESS = re.compile(r"\s*(postgres[\w+.-]*:|[\w+]+://)", re.IGNORECASE)
"""How an address begins, also one that lacks a slash: a password in it must not become a path."""
_BARE_PERCENT = re.compile("%(?![0-9A-Fa-f]{2})")


@dataclass(frozen=True, slots=True)
class ServerUrl:
    """The address of a shared catalogue. What people see of it has no password and no settings.

    Attributes
    ----------
    shown : str
        The address for messages, documents and pages.
    secret : str
        The address for the server. It may hold a password, so it is shown nowhere.
    """

    shown: str
    secret: str = field(repr=False)

    def __str__(self) -> str:
        return self.shown

    @property
    def name(self) -> str:
        """The name of the database."""
        return self.shown.rpartition("/")[2]


Location = Path | ServerUrl
LocationName = str | os.PathLike[str] | ServerUrl
"""A location as somebody types it."""


def location_of(name: LocationName) -> Location:
    """The location that a path or an address means.

    Raises
    ------
    BadOption
        It is an address of another kind of database, it lacks the name of the database, or it has
        a character that must be written as % and two digits. The message repeats none of it.

    Examples
    --------
    >>> str(location_of("postgresql+psycopg://ann:secret@db.example/lasts?sslmode=require"))
    'postgresql+psycopg://ann@db.example/lasts'
    """
    if isinstance(name, ServerUrl):
        return name
    text = os.fspath(name)
    if not _ADDRESS.match(text):
        return Path(text)
    scheme, slashes, rest = text.partition("://")
    if not slashes:
        raise BadOption(f"the address of the catalogue lacks :// after its scheme; write {FORM}")
    if scheme != SCHEME:
        raise BadOption(f"a shared catalogue has an address like {FORM}, not {scheme}://")
    if _BARE_PERCENT.search(rest):
        words = "the address of the catalogue has a % that is not followed by two hex digits"
        raise BadOption(f"{words}: write %25 for a %")
    before, _, path = rest.partition("?")[0].partition("/")
    if before.count("@") > 1 or "@" in path:
        words = "the user or the password in the address of the catalogue has a @ or a /"
        raise BadOption(f"{words}: write %40 for a @, and %2F for a /")
    try:
        parts = urlsplit(f"//{rest}")
        user, host, port = parts.username, parts.hostname, parts.port
    except ValueError as error:
        raise BadOption(f"the address of the catalogue is not valid; write {FORM}") from error
    database = parts.path.strip("/")
    if not database:
        raise BadOption(f"the address of the catalogue names no database; write {FORM}")
    where = f"{user + '@' if user else ''}{host or ''}{f':{port}' if port else ''}"
    shown = f"{SCHEME}://{unquote(where)}/{unquote(database)}"
    return ServerUrl(shown, f"postgresql://{rest}")
