"""The heel model: a TOML file that says how a foot that was scanned flat changes in a heel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import cache
from pathlib import Path
from typing import Any

from footfit.errors import BadOption, BadProfile
from footfit.geometry.measures.measure_table import MEASURES
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
from footfit.results import HeelModel, HeelQuestion, HeelRule
from footfit.results.heel import AS_SCANNED, FLARE

SCHEMA = "footfit.heel-model/1"
FILE = Path(__file__).parent / "heel_model.toml"
DROPS = ("full_drop_mm", "unproven_from_mm", "largest_drop_mm")
TOP_KEYS = {"schema", "name", "version", "source", *DROPS, "measures"}
LARGEST_DROP_MM = 120.0
"""No foot is scanned at a larger drop, and no last that footfit reads has one."""
MOST_PERCENT, MOST_DEG = 20.0, 20.0


@cache
def heel_model() -> HeelModel:
    """The model that comes with footfit."""
    return heel_model_of(text_of(FILE, "heel model"), str(FILE))


def heel_model_of(text: str, path: str | None = None) -> HeelModel:
    """The model that a TOML text says.

    Raises
    ------
    BadProfile
        It is not TOML, lacks a key, has an unknown key, or a number is out of range. The message
        says which.
    """
    return value_of(text, path, _model)


def heel_question(
    *, as_scanned: bool = False, scanned_at_drop_mm: float | None = None
) -> HeelQuestion:
    """How feet are compared with heeled lasts.

    Raises
    ------
    BadOption
        Both are given, or the drop is none that a foot is scanned at.
    """
    if as_scanned:
        if scanned_at_drop_mm is not None:
            raise BadOption("--scanned-at-drop does not go with --as-scanned; leave out one")
        return AS_SCANNED
    drop_mm = 0.0 if scanned_at_drop_mm is None else scanned_at_drop_mm
    if not 0.0 <= drop_mm <= LARGEST_DROP_MM:
        raise BadOption(f"--scanned-at-drop takes 0 to {LARGEST_DROP_MM:g} mm, not {drop_mm:g}")
    return HeelQuestion(heel_model(), drop_mm)


def _model(table: Mapping[str, Any]) -> HeelModel:
    """The model of a TOML table; raises BadProfile without a path."""
    check_keys(table, TOP_KEYS, "the heel model")
    check_schema(table, SCHEMA)
    measures = table.get("measures")
    if not isinstance(measures, dict) or "length" not in measures:
        raise BadProfile("has no [measures.length]: the toe room changes with the heel")
    full_mm, unproven_mm, largest_mm = (
        number(table.get(key), key, 1.0, LARGEST_DROP_MM) for key in DROPS
    )
    if not unproven_mm <= full_mm <= largest_mm:
        raise BadProfile(f"{DROPS[1]}, {DROPS[0]} and {DROPS[2]} must not fall")
    model = HeelModel(
        name=words(table.get("name"), "name"),
        version=whole_number(table.get("version"), "version"),
        source=words(table.get("source"), "source"),
        full_drop_mm=full_mm,
        unproven_from_mm=unproven_mm,
        largest_drop_mm=largest_mm,
        rules=tuple(_rule(name, asked) for name, asked in measures.items()),
        sha256="",
    )
    return replace(model, sha256=values_sha256(asdict(model)))


def _rule(name: str, asked: object) -> HeelRule:
    """The rule of one measure's table."""
    where = f"[measures.{name}]"
    if name != FLARE and name not in {entry.name for entry in MEASURES}:
        raise BadProfile(f"{where} is no measure of footfit; footfit measure lists them")
    if not isinstance(asked, dict):
        raise BadProfile(f"{where} must be a table")
    unit, most, scale = ("deg", MOST_DEG, 1.0) if name == FLARE else ("percent", MOST_PERCENT, 0.01)
    change, sd = f"change_{unit}", f"sd_{unit}"
    check_keys(asked, {change, sd, "grade", "why"}, where)
    return HeelRule(
        measure=name,
        change=scale * number(asked.get(change), f"{where} {change}", -most, most),
        sd=scale * number(asked.get(sd), f"{where} {sd}", 0.0, most),
        grade=words(asked.get("grade"), f"{where} grade"),
        why=words(asked.get("why"), f"{where} why"),
    )
