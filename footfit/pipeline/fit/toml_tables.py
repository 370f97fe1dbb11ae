"""TOML files with rules, shipped or the user's own: reading them, and checking their values."""

from __future__ import annotations

import hashlib
import json
import math
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from footfit.errors import BadProfile, UnreadableFile

T = TypeVar("T")

LARGEST_BYTES = 100_000
MOST_WORDS = 300


def text_of(path: Path, title: str) -> str:
    """The text of a file; ``title`` is what it should hold.

    Raises
    ------
    UnreadableFile, BadProfile
        It is not a file, cannot be read, is too large or is not UTF-8.
    """
    if not path.is_file():
        raise UnreadableFile(f"is not a file; give a {title} in TOML", str(path))
    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise BadProfile(f"is too large for a {title}", str(path))
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise UnreadableFile(f"cannot be read: {error.strerror}", str(path)) from error
    except UnicodeDecodeError as error:
        raise BadProfile("is not UTF-8 text; save it as UTF-8", str(path)) from error


def value_of(text: str, path: str | None, of_table: Callable[[Mapping[str, Any]], T]) -> T:
    """What ``of_table`` makes of a TOML text's table; it raises BadProfile without a path.

    Raises
    ------
    BadProfile
        The text is not TOML, or its table is wrong.
    """
    try:
        table = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        words = " ".join(str(error).split()) or "too deep"
        raise BadProfile(f"is not valid TOML: {words}", path) from error
    try:
        return of_table(table)
    except BadProfile as error:
        raise error.at(path) from error


def check_schema(table: Mapping[str, Any], *schemas: str) -> None:
    """Refuse a table of another schema; the first one is named."""
    if table.get("schema") not in schemas:
        raise BadProfile(f"schema must be {schemas[0]!r}; another version may read it")


def check_keys(table: Mapping[str, Any], keys: set[str], where: str) -> None:
    """Refuse a key that is not known, with the nearest one that is."""
    unknown = sorted(set(table) - keys)
    if not unknown:
        return
    from difflib import get_close_matches

    close = get_close_matches(unknown[0], sorted(keys), n=1)
    hint = f"did you mean {close[0]}" if close else f"it takes {', '.join(sorted(keys))}"
    raise BadProfile(f"{where} has an unknown key {unknown[0]!r}; {hint}")


def number(value: object, where: str, least: float = -math.inf, most: float = math.inf) -> float:
    """A finite number within limits."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise BadProfile(f"{where} must be a number")
    if not least <= value <= most:
        raise BadProfile(f"{where} must be between {least:g} and {most:g}")
    return float(value)


def whole_number(value: object, where: str) -> int:
    """A whole number."""
    if not isinstance(value, int) or isinstance(value, bool):
        raise BadProfile(f"{where} must be a whole number")
    return value


def words(value: object, where: str) -> str:
    """A short text."""
    if not isinstance(value, str) or not value.strip() or len(value) > MOST_WORDS:
        raise BadProfile(f"{where} must be a short text")
    return value


def values_sha256(values: Mapping[str, Any]) -> str:
    """The hash of a table's values; a comment or another order of the file does not change it."""
    known = {key: value for key, value in values.items() if key != "sha256"}
    text = json.dumps(known, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(text.encode("utf-8")).hexdigest()
