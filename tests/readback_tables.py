"""The facts of the smaller results: one mesh, the library, the catalogue. See `tests.readback`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from footfit.geometry.fit.sizes import label_check
from footfit.results import (
    Alignment,
    CatalogueFacts,
    LastRecord,
    Measured,
    MeasuredScan,
    Profiled,
    StoredLast,
    SurfaceCurvature,
)
from tests.readback import (
    CSV,
    SAID,
    TERMINAL,
    Fact,
    csv_number,
    fact,
    measured_values,
    mm,
    plain,
    signed,
    turn_values,
)

SPREADS = "the spread of a second scan of the same shape"
"""What the tables of measures say of ±."""


def measured_facts(scan: MeasuredScan) -> Iterator[Fact]:
    """Everything that ``footfit measure`` shows of one mesh."""
    alignment = scan.alignment
    side, path = alignment.side, alignment.info.path
    said = [side.side or "undecided", *side_values(alignment), alignment.pose.kind]
    yield fact("title", path, TERMINAL)
    yield fact("side", said, TERMINAL)
    yield fact("±", SPREADS, TERMINAL)
    for row in scan.measures:
        known, name = row.measured, row.name.removesuffix("_deg").replace("_", " ")
        words = [known.reason] if known.value is None else measured_values(known)
        yield fact(name, words, TERMINAL)
        is_angle = row.name.endswith("_deg")
        cells = {
            "side": side.side or "",
            "kind": alignment.pose.kind,
            **{name: "" if is_angle else text for name, text in spreads("mm", known)},
            "reason": known.reason or "",
            "definition": row.definition,
            **{name: text if is_angle else "" for name, text in spreads("deg", known)},
        }
        for column, text in cells.items():
            yield fact(f"{path} {row.name} {column}", text, CSV)


def spreads(unit: str, known: Measured) -> list[tuple[str, str]]:
    """The cells of a measured value in one unit."""
    values = {"value": known.value, "sd": known.sd, "total_sd": known.total_sd, "bias": known.bias}
    return [(f"{name}_{unit}", mm(value)) for name, value in values.items()]


def flare_facts(shape: Profiled) -> Iterator[Fact]:
    """Everything that ``footfit flare`` shows of one mesh."""
    alignment, flare = shape.aligned.alignment, shape.flare
    yield fact("title", alignment.info.path, TERMINAL)
    yield fact("side", [alignment.side.side, *side_values(alignment)], TERMINAL)
    yield fact("flare", [*turn_values(flare), flare.flare_class], TERMINAL)
    yield fact("±", SPREADS, TERMINAL)
    yield fact("length", plain(shape.length_mm), TERMINAL)
    yield fact("definition", flare.definition.version, TERMINAL)
    for channel, values in flare.curvature.items():
        known = np.array([]) if values is None else values[np.isfinite(values)]
        texts = [signed(known.min()), signed(known.max())] if len(known) else ["not measurable"]
        yield fact(channel, texts, TERMINAL)
    for index, station in enumerate(flare.stations):
        cells = {
            "path": alignment.info.path,
            "side": alignment.side.side or "",
            "flare_angle_deg": csv_number(flare.angle_deg, 3),
            "flare_angle_sd_deg": csv_number(flare.angle_sd_deg, 3),
            "flare_angle_total_sd_deg": csv_number(flare.angle_total_sd_deg, 3),
            "class": flare.flare_class,
            "definition": flare.definition.version,
            "station": csv_number(station, 6),
            "heading_deg": csv_number(flare.heading_deg[index], 3),
        }
        for channel, values in flare.curvature.items():
            cells[channel] = "" if values is None else csv_number(values[index], 6)
        for column, text in cells.items():
            yield fact(f"station {index + 1} {column}", text, CSV)


MARKED = {
    "side_contradicted": "S",
    "low_side_confidence": "U",
    "looks_like_a_foot": "F",
    "size_contradicted": "L",
    "suspect_flare": "O",
    "stance_label_contradicted": "H",
}
"""The letter that ``footfit list-lasts`` shows for a warning; any other is W."""


def library_facts(records: Sequence[LastRecord], reference: str | None) -> Iterator[Fact]:
    """Everything that ``footfit list-lasts`` shows."""
    marked: dict[str, list[str]] = {}
    for record in records:
        labels, flare, name = record.labels, record.flare, record.labels.name
        system = labels.size_system.upper() if labels.size_system else None
        size = " ".join(part for part in (system, labels.size, labels.width_label) if part)
        star = "*" if name == reference else None
        yield fact(f"{name} last", [name, star], TERMINAL)
        yield fact(f"{name} style", labels.style or "-", TERMINAL)
        yield fact(f"{name} size", size or "-", TERMINAL)
        yield fact(f"{name} side", record.side.side or "undecided", TERMINAL)
        yield fact(f"{name} length", plain(record.length_mm), TERMINAL)
        yield fact(f"{name} flare", signed(flare.angle_deg), TERMINAL)
        yield fact(f"{name} class", flare.flare_class, TERMINAL)
        measured = {row.name: row.measured.value for row in record.measures}
        ball, heel = measured.get("ball_girth"), labels.heel_height_mm
        heel = measured.get("heel_height") if heel is None else heel
        yield fact(f"{name} ball", "-" if ball is None else plain(ball, 0), TERMINAL)
        yield fact(f"{name} heel", "-" if heel is None else plain(heel, 0), TERMINAL)
        cells = {
            "style": labels.style,
            "size": labels.size,
            "size_system": labels.size_system,
            "width_label": labels.width_label,
            "heel_height_mm": mm(labels.heel_height_mm),
            "family": labels.family,
            "parent": labels.parent,
            "side": record.side.side,
            "length_mm": mm(record.length_mm),
            "flare_angle_deg": csv_number(flare.angle_deg, 3),
            "class": flare.flare_class,
            "reference": str(name == reference).lower(),
            "ball_girth_mm": mm(ball),
        }
        check = label_check(labels.size, labels.size_system, record.length_mm)
        cells["size_by_length"] = "" if check is None else csv_number(check.by_length, 6)
        cells["label_flagged"] = "" if check is None else str(check.flagged).lower()
        flagged = check is not None and check.flagged
        codes = [notice.code for notice in record.warnings] + ["size_contradicted"] * flagged
        cells["warnings"] = " ".join(codes)
        marks = {MARKED.get(code, "W") for code in codes}
        letters = "".join(letter for letter in (*MARKED.values(), "W") if letter in marks)
        yield fact(f"{name} marks", letters or "-", TERMINAL)
        for letter in marks:
            marked.setdefault(letter, []).append(name)
        for column, text in cells.items():
            yield fact(f"{name} {column}", text or "", CSV)
    for letter, names in marked.items():
        yield fact(f"{SAID} mark {letter}", [letter, *names[:3]], TERMINAL)
    for record in records:
        labels = record.labels
        if labels.parent is not None:
            words = ["made from", labels.parent, labels.name]
            yield fact(f"{SAID} made {labels.name}", words, TERMINAL)
    yield fact(f"{SAID} count", [len(records), reference], TERMINAL)


def align_facts(alignment: Alignment) -> Iterator[Fact]:
    """Everything that ``footfit align`` shows of one mesh."""
    info, pose, frame = alignment.info, alignment.pose, alignment.eigenframe
    rows = {
        "title": [info.path],
        "mesh": [f"{info.faces:,}", "closed" if info.watertight else "open"],
        "units": [info.units, info.units_source],
        "kind": [pose.kind],
        "side": [alignment.side.side, *side_values(alignment)],
        "method": [alignment.method],
        "length": [plain(alignment.length_mm)],
        "eigenvalues": named_values(frame.eigenvalues_mm2),
        "centroid": [plain(value) for value in frame.centroid_mm],
        "pose": [
            plain(pose.cost, 2, 6),
            plain(pose.margin, 2, 6),
            "sole" if pose.sole else "no sole",
        ],
    }
    if alignment.reference is not None:
        rows["reference"] = [alignment.reference.last]
    for name, values in rows.items():
        yield fact(name, values, TERMINAL)


def curvature_facts(curvature: SurfaceCurvature) -> Iterator[Fact]:
    """Everything that ``footfit curvature`` shows of one mesh."""
    yield fact("title", curvature.info.path, TERMINAL)
    radius = plain(curvature.radius_mm) if curvature.radius_mm else "one ring"
    yield fact("scale", radius, TERMINAL)
    for name, power in {"k1": "", "k2": "", "mean": "", "gaussian": "mm²"}.items():
        known = getattr(curvature, name)
        known = known[np.isfinite(known)]
        texts = [f"{np.quantile(known, q):+.5f}" for q in (0.05, 0.5, 0.95)] if len(known) else []
        unit = ["1", power] if power else ["1"]
        quantiles = ["5 %", "95 %"]
        yield fact(name, [*texts, *unit, *quantiles], TERMINAL)


def last_facts(last: StoredLast) -> Iterator[Fact]:
    """Everything that ``footfit show-last`` shows."""
    record = last.record
    labels, flare, info = record.labels, record.flare, record.info
    system = labels.size_system.upper() if labels.size_system else None
    size = " ".join(part for part in (system, labels.size, labels.width_label) if part)
    heel = labels.heel_height_mm
    angle = last.paper_frame_angle_deg
    check = label_check(labels.size, labels.size_system, record.length_mm)
    off = []
    if check is not None and check.flagged:
        off = [plain(abs(check.off)), f"{system} {round(check.by_length)}"]
    turn = [*turn_values(flare), flare.flare_class]
    rows: dict[str, list[object]] = {
        "title": [labels.name],
        "style": [labels.style or "-"],
        "size": [size or "-", *off],
        "family, parent": [labels.family, labels.parent],
        "heel": [plain(heel)],
        "side": [record.side.side, *side_values(record)],
        "length": [plain(record.length_mm)],
        "flare": [*turn, flare.definition.version, record.upgraded_from],
        "reference": ["this is" if last.reference == labels.name else "no"],
        "paper's frame": ["none" if angle is None else plain(angle)],
        "eigenvalues": named_values(record.eigenframe.eigenvalues_mm2),
        "mesh": [f"{info.vertices:,}", f"{info.faces:,}", info.units],
        "content": ["sha256", info.sha256],
    }
    for row in record.measures:
        if row.name != "length":
            known = row.measured
            words = [known.reason] if known.value is None else measured_values(known)
            rows[row.name.replace("_", " ")] = words
    rows["±"] = [SPREADS]
    if last.parentage is not None:
        made = last.parentage
        rows["made from"] = [made.base, made.rule, made.profile]
        for target in made.targets:
            asked, reached, base = (
                "-" if value is None else plain(value)
                for value in (target.target, target.reached, target.base)
            )
            rows[f"target {target.name.replace('_', ' ')}"] = [asked, "reached", reached, base]
    for notice in record.warnings:
        rows["warning"] = [notice.message]
    for name, values in rows.items():
        yield fact(name, values, TERMINAL)


def catalogue_facts(info: CatalogueFacts) -> Iterator[Fact]:
    """Everything that ``footfit catalogue-info`` shows."""
    worst = info.worst_copy_error_mm
    rows: dict[str, list[object]] = {
        "catalogue": [info.path],
        "size": [plain(info.bytes / 1e6), info.schema_revision],
        "lasts": [info.lasts, *count_values((count, name) for name, count in info.sides)],
        "reference": [info.reference or "-"],
        "styles": count_values(info.styles),
        "size systems": count_values(info.size_systems),
        "definitions": count_values(info.definitions),
        "mesh copies": [info.mesh_copies, plain(info.mesh_copy_bytes / 1e6)],
        "rows kept": count_values(info.kept),
        "feet": ["no scan"],
    }
    rows["mesh copies"] += [] if worst is None else [plain(worst, 2)]
    for name, values in rows.items():
        yield fact(name, values, TERMINAL)


def named_values(values: Sequence[float]) -> list[str]:
    """Values under the names e1, e2, e3."""
    return [text for row, value in enumerate(values, 1) for text in (f"e{row}", plain(value))]


def count_values(counts: Iterable[tuple[object, object]]) -> list[object]:
    return [part or "none" for pair in counts for part in pair]


def side_values(alignment: object) -> list[str | None]:
    side = alignment.side
    if side.side is not None and side.source == "given":
        return ["given"]
    said = None if side.side is None else side.source
    return [said, side.confidence if said else None, signed(side.score)]
