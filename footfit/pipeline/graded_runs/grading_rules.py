"""Grading rules: TOML files, shipped or the user's own, with a source for each increment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, cast

from footfit.errors import BadOption, BadProfile
from footfit.geometry.fit.sizes import SYSTEMS, SizeSystem, system_named
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
from footfit.results.fit import GRADES
from footfit.results.last_making.grading_rule import GradingRule, Increment, LawName

SCHEMA = "footfit.grading-rule/1"
FOLDER = Path(__file__).parent / "rules"
TOP_KEYS = {
    *("schema", "name", "version", "summary", "law", "systems"),
    *("size_step", "width_step", "widths", "size", "width"),
}
UNITS: Mapping[LawName, str] = {"arithmetic": "mm", "geometric": "percent"}
MOST = {"mm": 30.0, "percent": 15.0}
"""A whole size or a width changes no measure by more."""
LENGTH = "bottom_length"
"""What a size is longer by."""
PLANNED = (
    LENGTH,
    *("ball_girth_least", "waist_girth_least", "instep_girth_least", "heel_girth_instep"),
    *("ball_width", "bottom_width_ball", "heel_width", "bottom_width_heel"),
)
"""The measures that a rule can plan. The others follow, or are held."""
TOGETHER = (("ball_width", "bottom_width_ball"), ("heel_width", "bottom_width_heel"))
"""Widths of one place, which change together: a rule plans one of each pair."""
BY_SYSTEM = {
    "eu": "eu",
    "uk": "uk",
    "us-men": "us",
    "us-women": "us",
    "us-women-fia": "us",
    "mondopoint": "mondopoint",
}
"""The rule of each size system, if none is named."""
COUNTED_BY = {
    **dict.fromkeys(("jis", "jp", "japan", "kr", "korea"), "jis"),
    **dict.fromkeys(("cn", "china"), "china"),
}
"""The rules of countries whose sizes have no system of their own."""


def shipped_rules() -> tuple[str, ...]:
    """The names of the rules that come with footfit."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.toml")))


def known_system(name: str) -> SizeSystem:
    """The size system of that name.

    Raises
    ------
    BadOption
        There is none.
    """
    system = system_named(name)
    if system is None:
        if rule := COUNTED_BY.get(name.casefold()):
            words = f"sizes of {name!r} are counted in mm of Mondopoint"
            raise BadOption(f"{words}: take --size-system mondopoint --rule {rule}")
        known = ", ".join(SYSTEMS)
        raise BadOption(f"no size system is named {name!r}: take one of {known}")
    return system


def grading_rule(name_or_path: str | None, system: SizeSystem | None = None) -> GradingRule:
    """A shipped rule by its name, the user's by its path (``x.toml``), or that of the system.

    Raises
    ------
    BadOption
        There is no shipped rule of that name, or the rule is for other size systems.
    UnreadableFile, BadProfile
        The file is not there, or is not a grading rule.
    """
    name = name_or_path or BY_SYSTEM["eu" if system is None else system.name]
    path = Path(name)
    if path.suffix != ".toml":
        if name.casefold() not in shipped_rules():
            known = ", ".join(shipped_rules())
            words = f"no grading rule is named {name!r}: there are {known}, or give a .toml file"
            raise BadOption(words)
        path = FOLDER / f"{name.casefold()}.toml"
    rule = rule_of(text_of(path, "grading rule"), str(path))
    if system is not None and rule.systems and system.name not in rule.systems:
        theirs = ", ".join(rule.systems)
        words = f"the rule {rule.name!r} counts sizes of {theirs}, not of {system.name}"
        raise BadOption(f"{words}: change --size-system or --rule")
    return rule


def rule_of(text: str, path: str | None = None) -> GradingRule:
    """The rule that a TOML text says.

    Raises
    ------
    BadProfile
        It is not TOML, lacks a key or has an unknown one, names no measure of a last, or gives a
        width step to a length. The message says which, and what to write.
    """
    return value_of(text, path, _rule)


def _rule(table: Mapping[str, Any]) -> GradingRule:
    """The rule of a TOML table; raises BadProfile without a path."""
    check_keys(table, TOP_KEYS, "the rule")
    check_schema(table, SCHEMA)
    law = table.get("law", "arithmetic")
    if law not in UNITS:
        raise BadProfile(f"law must be one of {', '.join(UNITS)}, not {law!r}")
    law = cast(LawName, law)
    size = _increments(table.get("size"), law, "size")
    if LENGTH not in size or size[LENGTH].by <= 0.0:
        raise BadProfile(f"[size.{LENGTH}] must say by how much a size is longer")
    width = _increments(table.get("width", {}), law, "width")
    if LENGTH in width:
        raise BadProfile(f"[width.{LENGTH}] must go: a width step changes no length")
    widths = _texts(table.get("widths", []), "widths")
    if len({width.casefold() for width in widths}) < len(widths):
        raise BadProfile("widths names a width twice")
    rule = GradingRule(
        name=words(table.get("name"), "name"),
        version=whole_number(table.get("version", 1), "version"),
        summary=words(table.get("summary", "-"), "summary"),
        law=law,
        systems=_systems(table.get("systems", [])),
        size=size,
        width=width,
        size_step=number(table.get("size_step", 1.0), "size_step", 0.1, 100.0),
        width_step=number(table.get("width_step", 1.0), "width_step", 0.1, 100.0),
        widths=widths,
    )
    return replace(rule, sha256=values_sha256(asdict(rule)))


def _increments(tables: object, law: LawName, kind: str) -> dict[str, Increment]:
    if not isinstance(tables, dict):
        raise BadProfile(f"has no [{kind}.MEASURE] table; copy a shipped rule and change it")
    for name in tables:
        if name not in PLANNED:
            raise BadProfile(
                f"[{kind}.{name}] cannot be planned; a rule plans {', '.join(PLANNED)}"
            )
    for first, second in TOGETHER:
        if first in tables and second in tables:
            pair = f"[{kind}.{first}] and [{kind}.{second}]"
            raise BadProfile(f"{pair} are one change: keep one of them")
    return {name: _increment(name, asked, law, kind) for name, asked in tables.items()}


def _increment(name: str, asked: object, law: LawName, kind: str) -> Increment:
    where, unit = f"[{kind}.{name}]", UNITS[law]
    if not isinstance(asked, dict):
        raise BadProfile(f"{where} must be a table")
    check_keys(asked, {unit, "grade", "source"}, where)
    if unit not in asked:
        raise BadProfile(f"{where} lacks {unit}")
    if asked.get("grade") not in GRADES:
        raise BadProfile(f"{where} grade must be one of {', '.join(GRADES)}")
    most = MOST[unit]
    by = number(asked[unit], f"{where} {unit}", -most, most)
    return Increment(by, asked["grade"], words(asked.get("source"), f"{where} source"))


def _systems(value: object) -> tuple[str, ...]:
    names = _texts(value, "systems")
    for name in names:
        if name not in SYSTEMS:
            raise BadProfile(f"systems names {name!r}; the size systems are {', '.join(SYSTEMS)}")
    return names


def _texts(value: object, where: str) -> tuple[str, ...]:
    if not isinstance(value, list):
        raise BadProfile(f"{where} must be a list of texts")
    return tuple(words(each, where) for each in value)
