"""Lasts that are one shape, or nearly: a second scan of one last, a copy, a revision."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.measure_table import of_kind
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.number_words import plain
from footfit.pipeline.last_making.tolerances import kind_of
from footfit.results import LastRecord
from footfit.results.population.checked_lasts import LastFinding

NEAR_BY = ("length", "ball_girth", "ball_width", "heel_width")
"""Measures that nearly every last has: near lasts are found by these."""
UNSURE = frozenset({"tread_from", "tread_to"})
"""Where a bottom begins to rise is read to some mm only."""
NEIGHBOURS = 4
"""So many lasts are looked at beside each: more twins of one last are found by the others."""
SURE_SDS = 2.0
NEAR_FLARE_DEG = 1.0


@dataclass(frozen=True, slots=True)
class LastMeasures:
    """The measures (n, m) of lasts in mm, with their standard deviations, and the flare angles."""

    names: tuple[str, ...]
    value: Floats
    sd: Floats
    flare_deg: Floats
    flare_sd_deg: Floats


def last_measures(records: Sequence[LastRecord]) -> LastMeasures:
    """The measures of lasts that a comparison reads, NaN where there is none."""
    entries = [entry for entry in of_kind("last") if entry.name not in UNSURE]
    names = tuple(entry.name for entry in entries if not entry.name.endswith("_deg"))
    place = {name: at for at, name in enumerate(names)}
    value = np.full((len(records), len(names)), np.nan)
    sd = np.zeros_like(value)
    for row, record in enumerate(records):
        for measure in record.measures:
            at = place.get(measure.name)
            if at is not None and measure.measured.value is not None:
                value[row, at], sd[row, at] = measure.measured.value, measure.measured.sd or 0.0
    flare = [record.flare for record in records]
    return LastMeasures(
        names,
        value,
        sd,
        np.array([each.angle_deg for each in flare]),
        np.array([each.angle_sd_deg for each in flare]),
    )


def twin_findings(
    records: Sequence[LastRecord], measures: LastMeasures, tolerance_mm: Mapping[str, float]
) -> Iterator[LastFinding]:
    """A finding for each last that has a twin, or a near twin, of its side before it by name."""
    allowed = np.array([tolerance_mm[kind_of(name)] for name in measures.names])
    places = [measures.names.index(name) for name in NEAR_BY]
    core = measures.value[:, places] / np.maximum(allowed[places], 1e-9)
    found: dict[int, list[tuple[int, bool, int]]] = {}
    sides = np.array([record.side.side or "" for record in records])
    for side in sorted(set(sides.tolist())):
        rows = np.flatnonzero((sides == side) & np.isfinite(core).all(axis=1))
        for first, second in near_pairs(core, rows):
            off = np.abs(measures.value[first] - measures.value[second])
            if (off > allowed).any() or not _near_flare(measures, first, second):
                continue
            same = _same_shape(measures, off, first, second)
            worst = int(np.nanargmax(off / np.maximum(allowed, 1e-9)))
            found.setdefault(second, []).append((first, same, worst))
    for second in sorted(found):
        first, same, worst = min(found[second], key=lambda pair: (not pair[1], pair[0]))
        off_mm = float(abs(measures.value[first, worst] - measures.value[second, worst]))
        yield _finding(records[first], records[second], measures.names[worst], off_mm,
                       float(allowed[worst]), same=same)  # fmt: skip


def comparable(measures: LastMeasures) -> Bools:
    """Which lasts (n,) have the measures that near lasts are found by."""
    places = [measures.names.index(name) for name in NEAR_BY]
    return np.asarray(np.isfinite(measures.value[:, places]).all(axis=1))


def near_pairs(points: Floats, rows: Ints) -> list[tuple[int, int]]:
    """The pairs of rows of points (n, d) that are nearer than 1 in every coordinate."""
    if len(rows) < 2:
        return []
    from scipy.spatial import cKDTree

    tree = cKDTree(points[rows])
    count = min(NEIGHBOURS + 1, len(rows))
    _, near = tree.query(points[rows], k=count, p=np.inf, distance_upper_bound=1.0 + 1e-9)
    pairs = {
        (min(rows[at], rows[other]), max(rows[at], rows[other]))
        for at, others in enumerate(near)
        for other in others
        if other < len(rows) and other != at
    }
    return sorted((int(first), int(second)) for first, second in pairs)


def _near_flare(measures: LastMeasures, first: int, second: int) -> bool:
    return bool(abs(measures.flare_deg[first] - measures.flare_deg[second]) <= NEAR_FLARE_DEG)


def _same_shape(measures: LastMeasures, off: Floats, first: int, second: int) -> bool:
    """Could the two be scans of one last: no measure, and no flare, tells them apart?"""
    sd = np.hypot(measures.sd[first], measures.sd[second])
    turned = abs(measures.flare_deg[first] - measures.flare_deg[second])
    turn_sd = np.hypot(measures.flare_sd_deg[first], measures.flare_sd_deg[second])
    apart = bool((off > SURE_SDS * sd).any()) or bool(turned > SURE_SDS * turn_sd)
    return not apart


def _finding(
    first: LastRecord,
    second: LastRecord,
    measure: str,
    off_mm: float,
    allowed: float,
    *,
    same: bool,
) -> LastFinding:
    name, other = second.labels.name, first.labels.name
    if first.info.sha256 == second.info.sha256:
        words = f"has the same file as {other!r}: remove one of them"
    else:
        most = f"they differ most in {measure.replace('_', ' ')}, by {plain(off_mm)} mm"
        words = (
            f"a second scan would not tell it from {other!r}: {most}"
            if same
            else f"it is nearly {other!r}: {most}"
        )
        words += _label_words(first, second)
    return LastFinding(
        "twin" if same else "near_twin", name, words, other,
        measure=measure, off_mm=off_mm, tolerance_mm=allowed,
    )  # fmt: skip


def _label_words(first: LastRecord, second: LastRecord) -> str:
    """How the labels of two lasts of one shape differ."""
    ours, theirs = first.labels, second.labels
    for name in ("style", "size", "width_label"):
        said = [getattr(labels, name) or "not labelled" for labels in (theirs, ours)]
        if said[0] != said[1]:
            word = name.removesuffix("_label")
            return f"; its {word} is {said[0]}, that of {ours.name!r} is {said[1]}"
    return ""
