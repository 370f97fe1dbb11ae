"""Fit profiles: TOML files, shipped or the user's own, that say what a kind of shoe asks for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, get_args

from footfit.errors import BadOption, BadProfile
from footfit.pipeline.fit.toml_tables import (
    check_keys,
    check_schema,
    number,
    text_of,
    value_of,
    values_sha256,
    whole_number,
    words,
)
from footfit.pipeline.fit.worn_shifts import LARGEST_MM
from footfit.pipeline.fit.zones import UNIT_KEYS, ZONES
from footfit.results import FitProfile, Worn, ZoneRule
from footfit.results.fit import GRADES, Grade
from footfit.results.worn import Load, TimeOfDay

SCHEMAS = ("footfit.fit-profile/2", "footfit.fit-profile/1")
"""The newest schema, and an older one that has neither grades nor sources."""
FOLDER = Path(__file__).parent / "profiles"
TIE_SDS = 1.0
NO_SOURCE = "no source is given"
TOP_KEYS = {"schema", "name", "version", "summary", "tie_sds", "usual_length_mm", "zones", "worn"}
WORN_KEYS = {"sock_mm", "insole_mm", "heel_lift_mm", "load", "time"}
RANGES = ("good", "acceptable", "poor")


def shipped() -> tuple[str, ...]:
    """The names of the profiles that come with footfit."""
    return tuple(sorted(path.stem for path in FOLDER.iterdir() if path.suffix == ".toml"))


def fit_profile(name_or_path: str = "walking") -> FitProfile:
    """A shipped profile by its name in any case, or one of the user's by its path (``x.toml``).

    Raises
    ------
    BadOption
        There is no shipped profile of that name.
    UnreadableFile, BadProfile
        The file is not there, or is not a fit profile.
    """
    path = Path(name_or_path)
    if path.suffix != ".toml":
        names, name = shipped(), name_or_path.casefold()
        if name not in names:
            known = ", ".join(names)
            raise BadOption(
                f"no fit profile is named {name_or_path!r}; there are {known}, or give a .toml file"
            )
        path = FOLDER / f"{name}.toml"
    return profile_of(text_of(path, "fit profile"), str(path))


def profile_of(text: str, path: str | None = None) -> FitProfile:
    """The profile that a TOML text says.

    Raises
    ------
    BadProfile
        It is not TOML, lacks a key, has an unknown key, or a range is out of order. The message
        says which, and what to write.
    """
    return value_of(text, path, _profile)


def _profile(table: Mapping[str, Any]) -> FitProfile:
    """The profile of a TOML table; raises BadProfile without a path."""
    check_keys(table, TOP_KEYS, "the profile")
    check_schema(table, *SCHEMAS)
    zones = table.get("zones")
    if not isinstance(zones, dict) or not zones:
        raise BadProfile("has no [zones.NAME] table; copy a shipped profile and change it")
    if "length" not in zones:
        raise BadProfile("has no [zones.length]: the length is always judged")
    rules = {name: _rule(name, asked) for name, asked in zones.items()}
    usual = table.get("usual_length_mm")
    profile = FitProfile(
        name=words(table.get("name"), "name"),
        version=whole_number(table.get("version", 1), "version"),
        summary=words(table.get("summary", "-"), "summary"),
        tie_sds=number(table.get("tie_sds", TIE_SDS), "tie_sds", 0.0, 10.0),
        zones=tuple(rules[name] for name in ZONES if name in rules),
        sha256="",
        usual_length_mm=None if usual is None else _range(usual, "usual_length_mm"),
        worn=_worn(table.get("worn", {})),
    )
    return hashed(profile)


def hashed(profile: FitProfile) -> FitProfile:
    """A profile with the hash of what it asks; which feet it is for does not count."""
    rules_only = {key: value for key, value in asdict(profile).items() if key != "usual_length_mm"}
    return replace(profile, sha256=values_sha256(rules_only))


def _rule(name: str, asked: object) -> ZoneRule:
    """The rule of one zone's table."""
    where = f"[zones.{name}]"
    if name not in ZONES:
        raise BadProfile(f"{where} is no zone; the zones are {', '.join(ZONES)}")
    if not isinstance(asked, dict):
        raise BadProfile(f"{where} must be a table")
    keys = {key: f"{key}{UNIT_KEYS[ZONES[name].unit]}" for key in ("target", "cavity", *RANGES)}
    check_keys(asked, {*keys.values(), "weight", "required", "grade", "source"}, where)
    for key in ("target", "good", "acceptable"):
        if keys[key] not in asked:
            raise BadProfile(f"{where} lacks {keys[key]}")
    target = number(asked[keys["target"]], f"{where} {keys['target']}")
    ranges = {
        key: _range(asked[keys[key]], f"{where} {keys[key]}")
        for key in RANGES
        if keys[key] in asked
    }
    _check_nested(where, target, ranges)
    weight = number(asked.get("weight", 1.0), f"{where} weight", 0.0, 100.0)
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
        cavity=number(asked.get(keys["cavity"], 0.0), f"{where} {keys['cavity']}"),
        grade=_grade(asked.get("grade", "C"), where),
        source=words(asked.get("source", NO_SOURCE), f"{where} source"),
    )


def _worn(asked: object) -> Worn:
    """What is worn with such shoes."""
    if not isinstance(asked, dict):
        raise BadProfile("[worn] must be a table")
    check_keys(asked, WORN_KEYS, "[worn]")
    for key, choices in (("load", get_args(Load)), ("time", get_args(TimeOfDay))):
        if key in asked and asked[key] not in choices:
            raise BadProfile(f"[worn] {key} must be one of {', '.join(choices)}")
    lengths = {
        key: number(value, f"[worn] {key}", 0.0, LARGEST_MM[key])
        for key, value in asked.items()
        if key in LARGEST_MM
    }
    return Worn(**{**asked, **lengths})


def _grade(value: object, where: str) -> Grade:
    if value not in GRADES:
        kinds = ", ".join(f"{grade} ({meaning})" for grade, meaning in GRADES.items())
        raise BadProfile(f"{where} grade must be one of {kinds}")
    return value


def _check_nested(where: str, target: float, ranges: Mapping[str, tuple[float, float]]) -> None:
    """Refuse ranges that do not lie in one another."""
    inner, name = (target, target), "target"
    for key, (low, high) in ranges.items():
        if not (low <= inner[0] and inner[1] <= high):
            raise BadProfile(f"{where}: {key} [{low:g}, {high:g}] does not hold its {name}")
        inner, name = (low, high), f"{key} range"


def _range(value: object, where: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise BadProfile(f"{where} must be two numbers, such as [-5, 0]")
    low, high = (number(end, where) for end in value)
    if low >= high:
        raise BadProfile(f"{where} must rise: [{low:g}, {high:g}] does not")
    return low, high
