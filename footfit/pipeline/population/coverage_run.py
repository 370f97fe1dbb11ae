"""Coverage: from feet and lasts to shares, gaps, and the lasts to make or to leave out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.sizes import SYSTEMS, size_words
from footfit.geometry.numeric.arrays import Bools, Bytes, Floats
from footfit.pipeline.fit.scoring import NOT_JUDGED, REJECT
from footfit.pipeline.fit.zones import ZONES
from footfit.pipeline.population import cover
from footfit.pipeline.population.groups import (
    FootGroups,
    column_groups,
    letter_words,
    usual_groups,
)
from footfit.pipeline.population.judging import SERVED, Asking, Judged, asked_of, judged_feet
from footfit.pipeline.population.next_lasts import next_cover
from footfit.pipeline.population.shape_columns import ROOM
from footfit.pipeline.population.tables import FootTable, LastTable, lacking_zones
from footfit.results import LastLabels, Notice
from footfit.results.population.coverage_answer import (
    FEET_FOR_A_SHARE,
    Coverage,
    CoverStep,
    FailedFoot,
    LastBox,
    spread,
)
from footfit.results.population.served_feet import FootColumns, FootStatus, LastServes, NextLast
from footfit.results.population.shares import (
    Distribution,
    Served,
    ServedBy,
    ServedGroup,
    ServedZone,
    Share,
)

PERCENTILES = (5, 10, 25, 50, 75, 90, 95)
NEXT_LASTS = 10


@dataclass(frozen=True, slots=True)
class Population:
    """What a coverage is asked of: feet, those that failed, and how the answer is grouped."""

    feet: FootTable
    failed: tuple[FailedFoot, ...] = ()
    by: tuple[str, ...] = ()
    system: str = "eu"
    most_next: int = NEXT_LASTS
    warnings: tuple[Notice, ...] = ()


def coverage(people: Population, lasts: LastTable, asking: Asking) -> Coverage:
    """Whom the lasts serve, whom they do not, and what would change that."""
    feet = people.feet
    judged = judged_feet(feet, lasts, asking)
    reasons = _reasons(feet, asking)
    counted = np.array([reason is None for reason in reasons], dtype=bool)
    mask = np.packbits(counted)
    served: Bytes = judged.served & mask
    have = np.stack([cover.served_by_any(bits, len(feet)) for bits in served], axis=-1)
    groups = usual_groups(feet, people.system)
    groups += [column_groups(name, feet.columns[name]) for name in people.by]
    spare = cover.spare_rows(served[1])
    good_left = cover.served_by_any(served[0][~spare], len(feet))
    found = _foot_columns(feet, lasts, judged, asking, reasons, groups, served)
    return Coverage(
        feet=found,
        failed=people.failed,
        judged=int(counted.sum()),
        not_judged=_counts([reason for reason in reasons if reason is not None]),
        lasts=len(lasts),
        served=_served(have, counted),
        zones=_zones(judged, asking, counted),
        groups=tuple(_by_group(each, have, counted) for each in groups),
        library=tuple(_library(feet, lasts, judged, served, spare, counted)),
        cover=_cover_steps(served[1], lasts, int(counted.sum())),
        next_lasts=_next_lasts(people, asking, counted & ~have[:, 1], int(counted.sum())),
        good_if_gone=int(good_left.sum()),
        distributions=_distributions(feet),
        fit_profile=asking.profile,
        heel=asking.heel,
        worn=asking.worn,
        size_system=people.system,
        boxes=_boxes(lasts, asking),
        warnings=(*people.warnings, *_warnings(int(counted.sum()), reasons)),
    )


def _reasons(feet: FootTable, asking: Asking) -> list[str | None]:
    """Why a foot cannot be judged: it lacks what a required zone reads; None if it can."""
    reasons: list[str | None] = [None] * len(feet)
    for zone, lacks in lacking_zones(feet, asking.profile).items():
        name = "length" if zone == "length" else ZONES[zone].label
        for row in np.flatnonzero(lacks):
            reasons[row] = reasons[row] or f"no {name}"
    return reasons


def _warnings(judged: int, reasons: Sequence[str | None]) -> Iterator[Notice]:
    """What the reader must know beside the shares."""
    lacking = [reason for reason in reasons if reason is not None]
    if lacking:
        why = ", ".join(f"{count:,} have {reason}" for reason, count in _counts(lacking))
        words = f"{len(lacking):,} of {len(reasons):,} feet are not judged and in no share: {why}"
        yield Notice("feet_not_judged", words)
    if judged < FEET_FOR_A_SHARE:
        feet = "1 foot" if judged == 1 else f"{judged} feet"
        words = f"only {feet} could be judged: the shares are unsure, so look at their intervals"
        yield Notice("few_feet", f"{words}; {FEET_FOR_A_SHARE} or more say more")


def _counts(names: Sequence[str]) -> tuple[tuple[str, int], ...]:
    different = sorted(set(names))
    return tuple((name, names.count(name)) for name in different)


# ---------------------------------------------------------------- shares


def _served(have: Bools, counted: Bools) -> Served:
    """How many of the counted feet have a last, by (n, 2)."""
    count, total = (have & counted[:, None]).sum(axis=0), int(counted.sum())
    good, acceptable = (Share(int(each), total) for each in count)
    return Served(good, acceptable)


def _by_group(groups: FootGroups, have: Bools, counted: Bools) -> ServedBy:
    names = enumerate(groups.names)
    each = ((name, counted & (groups.group == place)) for place, name in names)
    return ServedBy(
        groups.by,
        tuple(ServedGroup(name, _served(have, member)) for name, member in each if member.any()),
    )


def _zones(judged: Judged, asking: Asking, counted: Bools) -> tuple[ServedZone, ...]:
    """Each criterion by itself, with the length, and in the best last."""
    zones = []
    for place, rule in enumerate(asking.profile.zones):
        level = judged.zone_level[:, place]
        best = np.stack([(level != NOT_JUDGED) & (level <= least) for least in SERVED], axis=-1)
        known = counted & judged.known[:, place]
        zones.append(
            ServedZone(
                zone=rule.zone,
                label=ZONES[rule.zone].label,
                counts=rule.weight > 0,
                required=rule.required,
                judged=int(known.sum()),
                alone=_served(judged.alone[:, place], known),
                with_length=_served(judged.with_length[:, place], known),
                best_last=_served(best, known),
            )
        )
    return tuple(zones)


def _distributions(feet: FootTable) -> tuple[Distribution, ...]:
    """Every measure that a foot has, and the flare."""
    columns = {name: ("mm", column.value) for name, column in feet.shapes.measures.items()}
    columns["flare"] = ("deg", feet.shapes.flare_deg)
    known = (  # sorted, so that no sum depends on the order of the feet
        (name, unit, np.sort(values[np.isfinite(values)]))
        for name, (unit, values) in columns.items()
    )
    return tuple(
        Distribution(
            measure=name,
            unit=unit,
            feet=len(values),
            mean=float(values.mean()),
            sd=float(values.std(ddof=1)) if len(values) > 1 else None,
            percentiles=tuple(
                zip(PERCENTILES, np.percentile(values, PERCENTILES).tolist(), strict=True)
            ),
        )
        for name, unit, values in known
        if len(values)
    )


# ---------------------------------------------------------------- feet and lasts


def _foot_columns(
    feet: FootTable,
    lasts: LastTable,
    judged: Judged,
    asking: Asking,
    reasons: Sequence[str | None],
    groups: Sequence[FootGroups],
    served: Bytes,
) -> FootColumns:
    """Each foot with its best last."""
    by = {each.by: each for each in groups[:2]}
    names = {name: [by[name].names[place] for place in by[name].group] for name in by}
    servers = [
        sum((np.unpackbits(row)[: len(feet)].astype(np.int64) for row in bits), np.zeros(len(feet)))
        for bits in served
    ]
    return FootColumns(
        ids=feet.ids,
        sides=feet.sides,
        sizes=tuple(names["size"]),
        widths=tuple(names["width"]),
        values={name: column.value for name, column in feet.shapes.measures.items()},
        flare_deg=feet.shapes.flare_deg,
        texts=feet.columns,
        status=tuple(
            _status(level, reason) for level, reason in zip(judged.level, reasons, strict=True)
        ),
        reasons=tuple(reasons),
        lasts=lasts.names,
        last=judged.last,
        margin=judged.margin,
        margin_zone=judged.margin_zone,
        zones=asking.zones,
        zone_level=judged.zone_level,
        counts=tuple(asking.counts.tolist()),
        clearances=judged.clearance,
        servers=np.stack(servers, axis=-1).astype(np.int64),
    )


def _status(level: int, reason: str | None) -> FootStatus:
    if level == NOT_JUDGED or reason is not None:
        return "not_judged"
    statuses: tuple[FootStatus, ...] = ("good", "acceptable", "poor", "no_last_fits")
    return statuses[level]


def _library(
    feet: FootTable,
    lasts: LastTable,
    judged: Judged,
    served: Bytes,
    spare: Bools,
    counted: Bools,
) -> Iterator[LastServes]:
    """Each last with the feet that it serves."""
    once = np.packbits(cover.served_once(served[1], len(feet)))
    fits = counted & (judged.level != REJECT) & (judged.level != NOT_JUDGED)
    best = np.bincount(judged.last[fits], minlength=len(lasts))
    good, acceptable = (cover.counts(bits) for bits in served)
    girth_mm = feet.shapes.value_of("ball_girth")
    for place, name in enumerate(lasts.names):
        labels = lasts.records[place].labels if lasts.records else LastLabels(name)
        own = np.flatnonzero(np.unpackbits(served[1][place])[: len(feet)])
        only = np.flatnonzero(np.unpackbits(served[1][place] & once)[: len(feet)])
        yield LastServes(
            last=name,
            style=labels.style,
            size=labels.size,
            size_system=labels.size_system,
            width_label=labels.width_label,
            good=int(good[place]),
            acceptable=int(acceptable[place]),
            best_for=int(best[place]),
            only=len(only),
            only_feet=tuple(feet.ids[row] for row in only),
            length_mm=spread(feet.length_mm[own]),
            ball_girth_mm=spread(girth_mm[own]),
            could_go=bool(spare[place]),
        )


def _cover_steps(bits: Bytes, lasts: LastTable, total: int) -> tuple[CoverStep, ...]:
    """The lasts one after another, those first that serve most feet more."""
    if not len(lasts):
        return ()
    steps = cover.greedy_cover(bits, np.bitwise_or.reduce(bits, axis=0))
    running = np.cumsum(steps.gains) / max(total, 1)
    return tuple(
        CoverStep(number, lasts.names[row], int(gain), float(share))
        for number, (row, gain, share) in enumerate(
            zip(steps.rows, steps.gains, running, strict=True), start=1
        )
    )


def _next_lasts(
    people: Population, asking: Asking, uncovered: Bools, total: int
) -> tuple[NextLast, ...]:
    """The lasts to make first for the feet that no last serves."""
    rows = np.flatnonzero(uncovered)
    if not len(rows) or people.most_next < 1:
        return ()
    feet = people.feet.chosen(rows)
    planned, steps = next_cover(feet, asking, people.system, people.most_next)
    before = total - len(rows)
    running = before + np.cumsum(steps.gains)
    shapes, system = planned.table.shapes, SYSTEMS[people.system]
    return tuple(
        NextLast(
            rank=rank,
            size=size_words(float(planned.size[row]), system),
            width=None if np.isnan(planned.letter[row]) else letter_words(planned.letter[row]),
            foot_length_mm=float(planned.foot_mm[row]),
            measures=_known_measures(shapes.measures, int(row)),
            flare_deg=_known_number(shapes.flare_deg[row]),
            gain=int(steps.gains[rank - 1]),
            covered=Share(int(running[rank - 1]), total),
            covered_at_most=float(before + steps.most[rank - 1]) / total,
        )
        for rank, row in enumerate(steps.rows, start=1)
    )


def _known_measures(measures: Mapping[str, object], row: int) -> tuple[tuple[str, float], ...]:
    values = ((name, float(column.value[row])) for name, column in measures.items())  # type: ignore[attr-defined]
    return tuple((name, value) for name, value in values if np.isfinite(value))


def _known_number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _boxes(lasts: LastTable, asking: Asking) -> tuple[LastBox, ...]:
    """Which feet each last is acceptable for in length and ball girth, as scanned."""
    if not len(lasts):
        return ()
    nobody = FootTable(("",), (None,), lasts.shapes.part(slice(0, 1)))
    rules = asked_of(nobody, asking)
    ends: dict[str, tuple[Floats, Floats]] = {}
    room = lasts.shapes.value_of(ROOM)
    room = np.where(np.isnan(room), lasts.shapes.value_of("length"), room) + lasts.shapes.gain_mm
    for zone, value in (("length", room), ("ball_girth", lasts.shapes.value_of("ball_girth"))):
        if zone in asking.zones:
            at = asking.zones.index(zone)
            low, high = (end[0, 0, at] for end in rules.acceptable)
            cavity = asking.profile.zones[at].cavity
            ends[zone] = value - cavity - high, value - cavity - low
    nothing = np.full(len(lasts), np.nan), np.full(len(lasts), np.nan)
    long, wide = ends.get("length", nothing), ends.get("ball_girth", nothing)
    return tuple(
        LastBox(
            name,
            (float(long[0][row]), float(long[1][row])),
            (float(wide[0][row]), float(wide[1][row])),
            _known_number(lasts.shapes.flare_deg[row]),
        )
        for row, name in enumerate(lasts.names)
    )
