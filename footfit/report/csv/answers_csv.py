"""The answers as CSV for spreadsheets; no cell of it is taken for a formula."""

from __future__ import annotations

import csv
import io
import re
from typing import TYPE_CHECKING

from footfit.geometry.flare.flare_profile import CHANNELS
from footfit.report.json.lines import Json
from footfit.report.json.numbers import degrees, millimetres, ratio
from footfit.report.json.parts import FIT_NAMES, NOT_YET, label_part, last_part
from footfit.report.wording.text import visible

if TYPE_CHECKING:
    from collections.abc import Iterable

    from footfit.results import Candidate, LastRecord, Match, Profiled

Cell = str | int | float | bool | None

MATCH_COLUMNS = (
    "path",
    "foot_side",
    "by",
    "rank",
    "last",
    "style",
    "size",
    "size_system",
    "width_label",
    "side",
    "mirrored",
    "distance",
    "distance_sd",
    "flare_distance",
    "flare_delta_deg",
    *(f"clearance_{name}_{end}" for name in FIT_NAMES for end in ("mm", "sd_mm")),
    "foot_verdict",
    "verdict",
    "why",
    "tied_with",
    "not_judged",
    "profile",
    "profile_sha256",
)
FLARE_COLUMNS = (
    "path",
    "side",
    "flare_angle_deg",
    "flare_angle_sd_deg",
    "class",
    "definition",
    "station",
    "heading_deg",
    *CHANNELS,
)
LAST_COLUMNS = (
    "last",
    "style",
    "size",
    "size_system",
    "width_label",
    "heel_height_mm",
    "family",
    "parent",
    "side",
    "length_mm",
    "flare_angle_deg",
    "class",
    "reference",
    "size_by_length",
    "label_flagged",
)

# A spreadsheet runs a cell that starts so; a semicolon inside a cell starts another one where a
# country's settings split there.
_FORMULA = re.compile(r"(^|;)(?=[=+\-@＝＋－＠])")
_NUMBER = re.compile(r"[+-]?\d+([.,]\d+)?")


def harmless(text: str) -> str:
    """``text`` as a spreadsheet shows it and never runs it; what is a number stays one.

    Examples
    --------
    >>> harmless("=HYPERLINK(1)"), harmless("-1+cmd"), harmless("-5"), harmless("Derby;=1")
    ("'=HYPERLINK(1)", "'-1+cmd", '-5', "Derby;'=1")
    """
    return text if _NUMBER.fullmatch(text) else _FORMULA.sub(r"\1'", text)


def csv_text(columns: tuple[str, ...], rows: Iterable[Iterable[Cell]], *, header: bool) -> str:
    """Rows as CSV: a comma between, quotes where needed, one line a row.

    Control characters in a text, line ends among them, are shown as their escapes.
    """
    target = io.StringIO()
    writer = csv.writer(target, lineterminator="\n")
    if header:
        writer.writerow(columns)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return target.getvalue()


def _cell(value: Cell) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return harmless(visible(value))
    return "" if value is None else str(value)


def match_csv(matches: Iterable[Match], *, header: bool = True) -> str:
    """One row per candidate and foot; ``header`` False for the second customer of a stream."""
    rows = (
        _match_row(match, index, candidate)
        for match in matches
        for index in range(len(match.feet))
        for candidate in match.candidates
    )
    return csv_text(MATCH_COLUMNS, rows, header=header)


def _match_row(match: Match, foot: int, candidate: Candidate) -> list[Cell]:
    alignment = match.feet[foot].aligned.alignment
    fit = candidate.fits[foot] if candidate.fits else None
    clearance = dict(candidate.clearance_mm)
    if fit is not None:
        clearance = {zone.zone: zone.clearance for zone in fit.zones if zone.unit == "mm"}
    row: list[Cell] = [
        alignment.info.path,
        alignment.side.side,
        match.by,
        candidate.rank,
        candidate.last,
        candidate.style,
        candidate.size,
        candidate.size_system,
        candidate.width_label,
        candidate.side,
        candidate.mirrored,
        ratio(candidate.distance),
        ratio(candidate.distance_sd),
        ratio(candidate.flare.distance),
        degrees(candidate.flare.delta_deg),
    ]
    for name in FIT_NAMES:
        measured = clearance.get(name, NOT_YET)
        row += [millimetres(measured.value), millimetres(measured.sd)]
    profile = match.fit_profile
    return [
        *row,
        None if fit is None else fit.verdict,
        candidate.verdict,
        candidate.why,
        " ".join(candidate.tied_with),
        " ".join(candidate.not_judged),
        match.profile,
        None if profile is None else profile.sha256,
    ]


def flare_csv(profiles: Iterable[Profiled], *, header: bool = True) -> str:
    """One row per station of each profile."""
    rows = (row for profiled in profiles for row in _flare_rows(profiled))
    return csv_text(FLARE_COLUMNS, rows, header=header)


def _flare_rows(profiled: Profiled) -> Iterable[list[Cell]]:
    alignment, flare = profiled.aligned.alignment, profiled.flare
    start: list[Cell] = [
        alignment.info.path,
        alignment.side.side,
        degrees(flare.angle_deg),
        degrees(flare.angle_sd_deg),
        flare.flare_class,
        flare.definition.version,
    ]
    channels = [flare.curvature.get(channel) for channel in CHANNELS]
    for index, station in enumerate(flare.stations):
        values = [None if curve is None else ratio(float(curve[index])) for curve in channels]
        heading = degrees(float(flare.heading_deg[index]))
        yield [*start, ratio(float(station)), heading, *values]


def lasts_csv(records: Iterable[LastRecord], reference: str | None) -> str:
    """One row per last, by name."""
    ordered = sorted(records, key=lambda record: record.labels.name)
    parts = [_last_cells(record, reference) for record in ordered]
    rows = [[_known(part[column]) for column in LAST_COLUMNS] for part in parts]
    return csv_text(LAST_COLUMNS, rows, header=True)


def _last_cells(record: LastRecord, reference: str | None) -> Json:
    """The keys of a last, with its label's check beside them."""
    part = last_part(record, reference=reference)
    check = label_part(record) or {}
    part["size_by_length"], part["label_flagged"] = (
        check.get("size_by_length"),
        check.get("flagged"),
    )
    return part


def _known(value: object) -> Cell:
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)
