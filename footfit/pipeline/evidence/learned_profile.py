"""A fit profile that ratings have changed, and its text as a TOML file."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, replace
from pathlib import Path

from footfit.errors import BadManifest
from footfit.pipeline.batch.csv_rows import CsvRow, csv_rows
from footfit.pipeline.evidence.calibration import zone_evidence
from footfit.pipeline.evidence.ratings_model import RATINGS
from footfit.pipeline.evidence.recording import definitions
from footfit.pipeline.evidence.zone_ratings import log_ratings
from footfit.pipeline.fit.fit_profile import SCHEMAS, hashed
from footfit.pipeline.fit.zones import UNIT_KEYS, ZONES
from footfit.results import (
    Calibration,
    FitEntry,
    FitList,
    FitProfile,
    RatedZone,
    ZoneEvidence,
    ZoneRule,
)
from footfit.results.evidence.fit_entries import OF_ENTRY

NEEDED = ("id", "profile", "place", "rating", "zone", "clearance", "sd", "definition")


def calibration(profile: FitProfile, entries: Iterable[FitEntry]) -> Calibration:
    """What the entries of the fit log make of a profile; itself if no zone may change."""
    known = tuple(entries)
    log = log_ratings(known, profile.name, definitions())
    zones = zone_evidence({rule.zone: rule for rule in profile.zones}, log.zones)
    after = learned_profile(profile, zones)
    return Calibration(profile, after, zones, len(known), log.left_out)


def learned_profile(profile: FitProfile, zones: Iterable[ZoneEvidence]) -> FitProfile:
    """The profile with the rules that were applied, as its next version."""
    applied = {zone.zone: zone for zone in zones if zone.status == "applied"}
    if not applied:
        return profile
    rules = tuple(
        _sourced(applied[rule.zone]) if rule.zone in applied else rule for rule in profile.zones
    )
    return hashed(replace(profile, version=profile.version + 1, zones=rules))


def _sourced(zone: ZoneEvidence) -> ZoneRule:
    words = f"{zone.ratings} ratings of {zone.wearers} wearers; before: {zone.before.target:g}"
    return replace(zone.after, grade="A", source=words)


def profile_text(profile: FitProfile) -> str:
    """A profile as a TOML file that `fit_profile` reads as the same values."""
    lines = [
        "# Fit profile: what a clearance (last minus foot) should be, by zone.",
        f'schema = "{SCHEMAS[0]}"',
        f"name = {_quoted(profile.name)}",
        f"version = {profile.version}",
        f"summary = {_quoted(profile.summary)}",
        f"tie_sds = {profile.tie_sds}",
    ]
    if profile.usual_length_mm is not None:
        low, high = profile.usual_length_mm
        lines.append(f"usual_length_mm = [{low}, {high}]")
    worn = {key: value for key, value in asdict(profile.worn).items() if value is not None}
    if worn:
        lines += ["", "[worn]", *(f"{key} = {_value(value)}" for key, value in worn.items())]
    for rule in profile.zones:
        end = UNIT_KEYS[ZONES[rule.zone].unit]
        lines += ["", f"[zones.{rule.zone}]", f"target{end} = {rule.target}"]
        for name in ("good", "acceptable", "poor"):
            ends = getattr(rule, name)
            if ends is not None:
                lines.append(f"{name}{end} = [{ends[0]}, {ends[1]}]")
        lines += [f"weight = {rule.weight}"]
        lines += ["required = true"] if rule.required else []
        lines += [f"cavity{end} = {rule.cavity}"] if rule.cavity else []
        lines += [f'grade = "{rule.grade}"', f"source = {_quoted(rule.source)}"]
    return "\n".join(lines) + "\n"


def _value(value: object) -> str:
    return _quoted(value) if isinstance(value, str) else str(value)


def _quoted(text: str) -> str:
    """A text as a basic string of TOML; JSON escapes what TOML escapes."""
    return json.dumps(text, ensure_ascii=False)


def entries_of_csv(path: Path) -> tuple[FitEntry, ...]:
    """The entries of a CSV file as ``list-fits --csv`` writes it, or a spreadsheet after it.

    Raises
    ------
    BadManifest
        The file cannot be read, lacks a column, or has a value that is not possible.
    """
    rows = csv_rows(path, FitList.columns, NEEDED)
    by_id: dict[str, list[CsvRow]] = {}
    for row in rows:
        if "id" not in row.values:
            raise BadManifest("has no id; list-fits writes one for each entry", row.where)
        by_id.setdefault(row.values["id"], []).append(row)
    return tuple(_entry(of_entry) for of_entry in by_id.values())


def _entry(rows: list[CsvRow]) -> FitEntry:
    first = rows[0].values
    said = {name: first.get(name) for name in OF_ENTRY}
    zones = [_rated_zone(row) for row in rows if "zone" in row.values]
    ratings = {
        row.values["place"]: _rating(row)
        for row in rows
        if {"place", "rating"} <= row.values.keys()
    }
    return FitEntry(
        id=first["id"],
        recorded=said["recorded"] or "",
        last=said["last"] or "",
        last_sha256=said["last_sha256"] or "",
        foot_sha256=said["foot_sha256"] or first["id"],
        side=None,
        wearer=said["wearer"],
        profile=said["profile"] or "",
        profile_version=0,
        profile_sha256=said["profile_sha256"] or "",
        worn={},
        zones=tuple(zones),
        ratings=ratings,
    )


def _rated_zone(row: CsvRow) -> RatedZone:
    values = row.values
    return RatedZone(
        zone=values["zone"],
        unit=values.get("unit", "mm"),
        clearance=row.number("clearance"),
        sd=row.number("sd"),
        definition=values.get("definition", ""),
        asked_more=row.number("asked_more", "0"),
    )


def _rating(row: CsvRow) -> int:
    rating = row.number("rating")
    if rating not in RATINGS:
        words = f"rating is {row.values['rating']!r}; it must be a whole number from -2 to 2"
        raise BadManifest(words, row.where)
    return int(rating)
