"""Match: a foot against every last of a catalogue, ranked, with reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from footfit.errors import BadOption, NoCandidate
from footfit.geometry.flare import profile_distances
from footfit.pipeline.batch import Outcome, outcomes
from footfit.pipeline.fit import (
    WALKING,
    LengthRule,
    flare_words,
    length_refusal,
    length_words,
    tiers,
)
from footfit.pipeline.reading import profiled_source
from footfit.pipeline.sources import ReadingOptions, Source
from footfit.results import (
    Candidate,
    FlareDifference,
    LastRecord,
    Match,
    Measured,
    Notice,
    Profiled,
    SearchBy,
)

LENGTH_SD_MM = 0.5
"""Repeatability of an aligned length between two scans of one shape (docs/alignment.md)."""
TWIN_LENGTH_MM = 2.0
"""Two lasts with the same labels and opposite sides are one pair if their lengths differ less."""
NEAREST_NAMED = 3


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked of the catalogue; ``top`` 0 is all."""

    by: SearchBy = "fit"
    top: int = 5
    rule: LengthRule = WALKING


@dataclass(frozen=True, slots=True)
class Library:
    """The lasts to choose from, and what the catalogue says of itself."""

    lasts: tuple[LastRecord, ...]
    total: int
    reference: str | None
    rejected: tuple[tuple[str, int], ...] = ()
    warnings: tuple[Notice, ...] = ()


@dataclass(frozen=True, slots=True)
class _Row:
    """One last with what was found of it; ``delta_deg`` and ``clearance_mm`` are last - foot."""

    last: LastRecord
    distance: float
    flare: FlareDifference
    clearance_mm: float
    mirrored: bool


def matched(feet: Sequence[Profiled], library: Library, question: Question = Question()) -> Match:
    """Rank the library for one customer: one foot, or two whose larger governs the length.

    Raises
    ------
    NoCandidate
        No last passes the filters that were given.
    """
    if not library.lasts:
        raise NoCandidate(_nothing_left(library))
    foot = max(feet, key=lambda one: one.aligned.alignment.length_mm)
    rows = _own_side(_rows(feet, foot, library.lasts, question.by))
    kept, rejected = _gated(rows, question)
    ordered, tier = _ordered(kept, question)
    top = ordered[: question.top or None]
    return Match(
        feet=tuple(feet),
        by=question.by,
        profile=question.rule.name,
        catalogue_lasts=library.total,
        reference=library.reference,
        candidates=tuple(
            _candidate(
                i + 1,
                row,
                [o.last.labels.name for o, t in zip(ordered, tier, strict=True) if t == tier[i]],
                foot,
                question,
            )
            for i, row in enumerate(top)
        ),
        rejected=tuple(sorted((*library.rejected, *rejected.items()))),
        warnings=library.warnings + _notices(feet, rows, kept, question),
    )


def customers(
    sources: Sequence[Source],
    reading: ReadingOptions,
    library: Library,
    question: Question,
    *,
    pair: bool = False,
    jobs: int = 1,
) -> Iterator[Outcome[Source, Match]]:
    """Each customer's answer, in order: one per scan, or one for a ``pair`` of scans.

    Raises
    ------
    BadOption
        A pair of other than two scans.
    """
    if pair and len(sources) != 2:
        raise BadOption(f"--pair takes the two scans of one customer, not {len(sources)}")
    feet = outcomes(partial(profiled_source, reading=reading), sources, jobs)
    if not pair:
        for foot in feet:
            yield _answered(foot.item, [foot], library, question)
        return
    both = list(feet)
    yield _answered(sources[0], both, library, question)


def _answered(
    source: Source,
    feet: Sequence[Outcome[Source, Profiled]],
    library: Library,
    question: Question,
) -> Outcome[Source, Match]:
    """One customer's outcome; the first foot that failed is the customer's failure."""
    errors = [foot.error for foot in feet if foot.error is not None]
    if errors:
        return Outcome(source, None, errors[0])
    shapes = [foot.value for foot in feet if foot.value is not None]
    return Outcome(source, matched(shapes, library, question), None)


def _nothing_left(library: Library) -> str:
    """Why there is no last to rank, and what to do."""
    if library.warnings:
        return library.warnings[0].message
    return "no last passes these filters; see footfit list-lasts"


def _rows(
    feet: Sequence[Profiled], foot: Profiled, lasts: Sequence[LastRecord], by: SearchBy
) -> list[_Row]:
    """Every last with its distances; two feet count by their root mean square."""
    found = [profile_distances(one.flare, [last.flare for last in lasts]) for one in feet]
    rows = []
    for i, last in enumerate(lasts):
        squares = [float(d.total[i]) ** 2 for d in found]
        flare = (sum(squares) / len(squares)) ** 0.5
        length = foot.aligned.alignment.length_mm
        clearance = last.length_mm - length
        parts = tuple((name, float(values[i])) for name, values in found[0].parts.items())
        difference = FlareDifference(flare, last.flare.angle_deg - _angle(feet), parts)
        distance = flare if by != "shape" else (flare**2 + (clearance / LENGTH_SD_MM) ** 2) ** 0.5
        mirrored = last.side.side != foot.aligned.alignment.side.side
        rows.append(_Row(last, distance, difference, clearance, mirrored))
    return rows


def _angle(feet: Sequence[Profiled]) -> float:
    return sum(one.flare.angle_deg for one in feet) / len(feet)


def _own_side(rows: Sequence[_Row]) -> list[_Row]:
    """Where both sides of one last are stored, the one of the foot's own side."""
    own = [row for row in rows if not row.mirrored]
    return own + [row for row in rows if row.mirrored and not any(_twins(row, o) for o in own)]


def _twins(one: _Row, other: _Row) -> bool:
    """Is one the other side's last of the same model and size?"""
    a, b = one.last.labels, other.last.labels
    same = (a.style, a.size, a.size_system, a.width_label) == (
        b.style,
        b.size,
        b.size_system,
        b.width_label,
    )
    named = a.style is not None and a.size is not None
    return named and same and abs(one.last.length_mm - other.last.length_mm) < TWIN_LENGTH_MM


def _gated(rows: Sequence[_Row], question: Question) -> tuple[list[_Row], Counter[str]]:
    """The rows whose length passes, and how many do not, by reason."""
    if question.by != "fit":
        return list(rows), Counter()
    reasons = [length_refusal(row.clearance_mm, question.rule) for row in rows]
    kept = [row for row, reason in zip(rows, reasons, strict=True) if reason is None]
    return kept, Counter(reason for reason in reasons if reason is not None)


def _ordered(rows: Sequence[_Row], question: Question) -> tuple[list[_Row], list[int]]:
    """Best first, with each row's tier. By fit a tie is settled by the length, then the name."""
    tier = tiers([row.distance for row in rows])

    def key(i: int) -> tuple[float, float, str]:
        row, name = rows[i], rows[i].last.labels.name
        if question.by == "fit":
            return tier[i], round(abs(row.clearance_mm - question.rule.target_mm), 3), name
        return round(row.distance, 6), 0.0, name

    order = sorted(range(len(rows)), key=key)
    return [rows[i] for i in order], [tier[i] for i in order]


def _candidate(
    rank: int, row: _Row, tier: Sequence[str], foot: Profiled, question: Question
) -> Candidate:
    labels = row.last.labels
    return Candidate(
        rank=rank,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=row.last.side.side,
        mirrored=row.mirrored,
        distance=row.distance,
        flare=row.flare,
        clearance_mm=(("length", Measured(row.clearance_mm, LENGTH_SD_MM * 2.0**0.5)),),
        verdict=None,
        why=_why(row, foot, question),
        tied_with=tuple(name for name in tier if name != labels.name),
        record=row.last,
    )


def _why(row: _Row, foot: Profiled, question: Question) -> str:
    sd = (foot.flare.angle_sd_deg**2 + row.last.flare.angle_sd_deg**2) ** 0.5
    flare = flare_words(row.flare.delta_deg, sd)
    if question.by == "flare":
        return flare
    if question.by == "shape":
        return (
            f"length differs by {row.clearance_mm:+.1f} mm, flare by {row.flare.delta_deg:+.1f} deg"
        )
    return f"{length_words(row.clearance_mm, question.rule)}; {flare}"


def _notices(
    feet: Sequence[Profiled], rows: Sequence[_Row], kept: Sequence[_Row], question: Question
) -> tuple[Notice, ...]:
    """What the reader must know beside the table."""
    notices = []
    if question.by == "flare":
        notices.append(
            Notice("scale_free", "a search by flare alone cannot tell sizes apart; look at length")
        )
    sides = {one.aligned.alignment.side.side for one in feet}
    if len(feet) == 2 and len(sides) == 1:
        notices.append(Notice("same_side", f"both feet of the pair are {sides.pop()} feet"))
    if not kept:
        asked = question.rule.target_mm
        near = sorted(rows, key=lambda r: (abs(r.clearance_mm - asked), r.last.labels.name))
        named = "; ".join(
            f"{r.last.labels.name}: {length_words(r.clearance_mm, question.rule)}"
            for r in near[:NEAREST_NAMED]
        )
        notices.append(Notice("nothing_fits", f"no last has the length; the nearest are {named}"))
    return tuple(notices)
