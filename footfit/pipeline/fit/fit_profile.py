"""Fit profiles: TOML files, shipped or the user's own, that say what a kind of shoe asks for."""

from __future__ import annotations

import hashlib
import json
import math
import tomllib
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from footfit.errors import BadOption, BadProfile, UnreadableFile
from footfit.pipeline.fit.zones import UNIT_KEYS, ZONES
from footfit.results import FitProfile, ZoneRule

SCHEMA = "footfit.fit-profile/1"
FOLDER = Path(__file__).parent / "profiles"
LARGEST_BYTES = 100_000
TIE_SDS = 1.0
TOP_KEYS = {"schema", "name", "version", "summary", "tie_sds", "zones"}
RANGES = ("good", "acceptable", "poor")


def shipped() -> tuple[str, ...]:
    """The names of the profiles that come with footfit."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.toml")))


def fit_profile(name_or_path: str = "walking") -> FitProfile:
    """A shipped profile by its name, or one of the user's by its path (``x.toml``).

    Raises
    ------
    BadOption
        There is no shipped profile of that name.
    UnreadableFile, BadProfile
        The file is not there, or is not a fit profile.
    """
    path = Path(name_or_path)
    if path.suffix != ".toml":
        names = shipped()
        if name_or_path not in names:
            known = ", ".join(names)
            raise BadOption(
                f"no fit profile is named {name_or_path!r}; there are {known}, or give a .toml file"
            )
        path = FOLDER / f"{name_or_path}.toml"
    return profile_of(_text(path), str(path))


def _text(path: Path) -> str:
    if not path.is_file():
        raise UnreadableFile("is not a file; give a fit profile in TOML", str(path))
    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise BadProfile("is too large for a fit profile", str(path))
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise UnreadableFile(f"cannot be read: {error.strerror}", str(path)) from error
    except UnicodeDecodeError as error:
        raise BadProfile("is not UTF-8 text", str(path)) from error


def profile_of(text: str, path: str | None = None) -> FitProfile:
    """The profile that a TOML text says.

    Raises
    ------
    BadProfile
        It is not TOML, lacks a key, has an unknown key, or a range is out of order. The message
        says which, and what to write.
    """
    try:
        table = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        words = " ".join(str(error).split()) or "too deep"
        raise BadProfile(f"is not valid TOML: {words}", path) from error
    try:
        return _profile(table)
    except BadProfile as error:
        raise error.at(path) from error


def _profile(table: Mapping[str, Any]) -> FitProfile:
    """The profile of a TOML table; raises BadProfile without a path."""
    _check_keys(table, TOP_KEYS, "the profile")
    if table.get("schema") != SCHEMA:
        raise BadProfile(f"schema must be {SCHEMA!r}; another version may read it")
    zones = table.get("zones")
    if not isinstance(zones, dict) or not zones:
        raise BadProfile("has no [zones.NAME] table; copy a shipped profile and change it")
    if "length" not in zones:
        raise BadProfile("has no [zones.length]: the length is always judged")
    rules = {name: _rule(name, asked) for name, asked in zones.items()}
    version = table.get("version", 1)
    if not isinstance(version, int) or isinstance(version, bool):
        raise BadProfile("version must be a whole number")
    return _hashed(
        FitProfile(
            name=_words(table.get("name"), "name"),
            version=version,
            summary=_words(table.get("summary", "-"), "summary"),
            tie_sds=_number(table.get("tie_sds", TIE_SDS), "tie_sds", 0.0, 10.0),
            zones=tuple(rules[name] for name in ZONES if name in rules),
            sha256="",
        )
    )


def _rule(name: str, asked: object) -> ZoneRule:
    """The rule of one zone's table."""
    where = f"[zones.{name}]"
    if name not in ZONES:
        raise BadProfile(f"{where} is no zone; the zones are {', '.join(ZONES)}")
    if not isinstance(asked, dict):
        raise BadProfile(f"{where} must be a table")
    keys = {key: f"{key}{UNIT_KEYS[ZONES[name].unit]}" for key in ("target", "cavity", *RANGES)}
    _check_keys(asked, {*keys.values(), "weight", "required"}, where)
    for key in ("target", "good", "acceptable"):
        if keys[key] not in asked:
            raise BadProfile(f"{where} lacks {keys[key]}")
    target = _number(asked[keys["target"]], f"{where} {keys['target']}")
    ranges = {
        key: _range(asked[keys[key]], f"{where} {keys[key]}")
        for key in RANGES
        if keys[key] in asked
    }
    _check_nested(where, target, ranges)
    weight = _number(asked.get("weight", 1.0), f"{where} weight", 0.0, 100.0)
    if not isinstance(required := asked.get("required", False), bool):
        raise BadProfile(f"{where} required must be true or false")
    if name == "length":  # the gate: a profile cannot switch it off
        ranges = {"poor": ranges["acceptable"]} | ranges
        if weight == 0.0:
            raise BadProfile(f"{where} weight must be over 0: the length is always judged")
    return ZoneRule(
        zone=name,
        target=target,
        good=ranges["good"],
        acceptable=ranges["acceptable"],
        poor=ranges.get("poor"),
        weight=weight,
        required=required,
        cavity=_number(asked.get(keys["cavity"], 0.0), f"{where} {keys['cavity']}"),
    )


def _check_nested(where: str, target: float, ranges: Mapping[str, tuple[float, float]]) -> None:
    """Refuse ranges that do not lie in one another."""
    inner, name = (target, target), "target"
    for key, (low, high) in ranges.items():
        if not (low <= inner[0] and inner[1] <= high):
            raise BadProfile(f"{where}: {key} [{low:g}, {high:g}] does not hold its {name}")
        inner, name = (low, high), f"{key} range"


def _check_keys(table: Mapping[str, Any], keys: set[str], where: str) -> None:
    """Refuse a key that is not known, with the nearest one that is."""
    unknown = sorted(set(table) - keys)
    if not unknown:
        return
    from difflib import get_close_matches

    close = get_close_matches(unknown[0], sorted(keys), n=1)
    hint = f"did you mean {close[0]}" if close else f"it takes {', '.join(sorted(keys))}"
    raise BadProfile(f"{where} has an unknown key {unknown[0]!r}; {hint}")


def _number(value: object, where: str, least: float = -math.inf, most: float = math.inf) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise BadProfile(f"{where} must be a number")
    if not least <= value <= most:
        raise BadProfile(f"{where} must be between {least:g} and {most:g}")
    return float(value)


def _range(value: object, where: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise BadProfile(f"{where} must be two numbers, such as [-5, 0]")
    low, high = (_number(end, where) for end in value)
    if low >= high:
        raise BadProfile(f"{where} must rise: [{low:g}, {high:g}] does not")
    return low, high


def _words(value: object, where: str) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > 300:
        raise BadProfile(f"{where} must be a short text")
    return value


def _hashed(profile: FitProfile) -> FitProfile:
    """The profile with the hash of its values."""
    values = {key: value for key, value in asdict(profile).items() if key != "sha256"}
    text = json.dumps(values, sort_keys=True, ensure_ascii=False)
    return replace(profile, sha256=hashlib.sha256(text.encode("utf-8")).hexdigest())
