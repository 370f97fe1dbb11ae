"""Match: a foot, or a pair, against every last of a catalogue, ranked, with reasons."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from footfit.errors import BadOption, HalfScan, NoCandidate
from footfit.geometry.numeric.arrays import Bools
from footfit.pipeline.batch.runs import Outcome, outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit import reasons
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.ranking import (
    Field,
    Placing,
    field,
    foot_fits,
    governing,
    nearest,
    placed,
    refusals,
)
from footfit.pipeline.fit.scoring import VERDICTS
from footfit.pipeline.scan.measure import suspects
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import (
    Candidate,
    FitProfile,
    FootFit,
    Library,
    Match,
    Measured,
    Notice,
    Profiled,
    SearchBy,
    Verdict,
    ZoneFit,
)

NEAREST_NAMED = 3


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked of the catalogue; ``top`` 0 is all, no ``profile`` is walking. ``surfaces_in``
    is the catalogue whose meshes the feet are laid into; None: that is not asked.
    """

    by: SearchBy = "fit"
    top: int = 5
    profile: FitProfile | None = None
    size_system: str | None = None
    surfaces_in: Path | None = None


@dataclass(frozen=True, slots=True)
class _Answer:
    """What candidates are made from."""

    feet: Sequence[Profiled]
    found: Field
    profile: FitProfile
    by: SearchBy


def matched(feet: Sequence[Profiled], library: Library, question: Question = Question()) -> Match:
    """Rank the library for one customer: one foot, or two whose larger governs the length.

    Raises
    ------
    NoCandidate
        No last passes the filters that were given.
    HalfScan
        By fit: a foot's length is not known, as where its toes were not scanned.
    """
    if not library.lasts:
        raise NoCandidate(_nothing_left(library))
    if question.by == "fit":
        _refuse_unknown_length(feet)
    profile = question.profile or fit_profile()
    found = field(feet, library.lasts, profile, question.by)
    answer = _Answer(feet, found, profile, question.by)
    placing = placed(found, profile, question.by)
    shown = range(len(placing.order))[: question.top or None]
    near = [] if placing.order else nearest(found, NEAREST_NAMED)
    missed = tuple(_near(answer, rank, row) for rank, row in enumerate(near, start=1))
    rejected = refusals(found) if question.by == "fit" else {}
    return Match(
        feet=tuple(feet),
        by=question.by,
        profile=profile.name,
        catalogue_lasts=library.total,
        reference=library.reference,
        candidates=tuple(_placed_candidate(answer, placing, place) for place in shown),
        rejected=tuple(sorted((*library.rejected, *rejected.items()))),
        warnings=library.warnings + _notices(answer, missed, question),
        fit_profile=profile,
        nearest=missed,
        size_system=question.size_system,
        best_verdict=_best_verdict(found, placing, question.by),
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
        raise BadOption(f"--pair takes two different scans of one customer, not {len(sources)}")
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
    try:
        answer = matched(shapes, library, question)
    except HalfScan as error:
        return Outcome(source, None, error)
    if question.surfaces_in is not None:
        from footfit.pipeline.fit.surface_clearance import with_surfaces

        answer = with_surfaces(answer, question.surfaces_in)
    return Outcome(source, answer, None)


def _refuse_unknown_length(feet: Sequence[Profiled]) -> None:
    """Raise HalfScan for a foot that was measured and whose length was not to be had: the length
    is the gate, and a short one would open it to lasts that are too small.
    """
    for foot in feet:
        length = next((row.measured for row in foot.measures if row.name == "length"), None)
        if length is not None and length.value is None:
            path = foot.aligned.alignment.info.path
            raise HalfScan(f"{length.reason}; no last is judged without it: scan again", path)


def _best_verdict(found: Field, placing: Placing, by: SearchBy) -> Verdict | None:
    """The best verdict of the ranked lasts, which need not be the first's: length comes first.

    A last that a required zone could not be judged in is left out: what is not known is no pass.
    """
    if by == "shape":
        return None
    required = [i for i, one in enumerate(found.columns) if one.counts and one.rule.required]
    known = np.isfinite(found.judged.score[:, required])
    sound = set(np.flatnonzero(np.atleast_1d(known.all(axis=1))).tolist())
    levels = [int(found.level[i]) for i in placing.order if i in sound]
    return VERDICTS[min(levels)] if levels else None


def meets(match: Match, least: Verdict) -> bool:
    """Is there a last at least as good as ``least``?"""
    best = match.best_verdict
    return best is not None and VERDICTS.index(best) <= VERDICTS.index(least)


def _nothing_left(library: Library) -> str:
    """Why there is no last to rank, and what to do."""
    if library.warnings:
        return library.warnings[0].message
    return "no last passes these filters; see footfit list-lasts"


# ---------------------------------------------------------------- candidates


def _placed_candidate(answer: _Answer, placing: Placing, place: int) -> Candidate:
    row = placing.order[place]
    fits = foot_fits(answer.found, row, answer.feet)
    tied = tuple(answer.found.lasts[i].labels.name for i in placing.tied(place))
    return _candidate(answer, row, place + 1, fits, tied, _why(answer, placing, place, fits))


def _near(answer: _Answer, rank: int, row: int) -> Candidate:
    """One of the lasts that come nearest where none fits."""
    fits = foot_fits(answer.found, row, answer.feet)
    zones, rules = _flat(fits), [column.rule for column in answer.found.columns]
    return _candidate(answer, row, rank, fits, (), reasons.missed_sentence(zones, rules))


def _candidate(
    answer: _Answer,
    row: int,
    rank: int,
    fits: tuple[FootFit, ...],
    tied: tuple[str, ...],
    why: str,
) -> Candidate:
    found, last = answer.found, answer.found.lasts[row]
    labels = last.labels
    by_shape, by_fit = answer.by == "shape", answer.by == "fit"
    known = np.isfinite(found.judged.score[row]).tolist()
    return Candidate(
        rank=rank,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        mirrored=found.mirrored[row],
        distance=float(found.distance[row]),
        flare=found.flare[row],
        clearance_mm=_clearance_mm(fits[governing(answer.feet)]),
        verdict=None if by_shape else VERDICTS[found.level[row]],
        why=why,
        tied_with=tied,
        record=last,
        distance_sd=float(found.spread.alone()[row]) if by_fit else None,
        fits=() if by_shape else fits,
        not_judged=() if by_shape else reasons.not_judged(found.columns, known),
    )


def _clearance_mm(fit: FootFit) -> tuple[tuple[str, Measured], ...]:
    """The governing foot's clearances in mm, by zone."""
    return tuple((zone.zone, zone.clearance) for zone in fit.zones if zone.unit == "mm")


def _flat(fits: Sequence[FootFit]) -> list[ZoneFit]:
    """The zones of all feet, in the columns' order."""
    return [zone for fit in fits for zone in fit.zones]


def _why(answer: _Answer, placing: Placing, place: int, fits: tuple[FootFit, ...]) -> str:
    found, row = answer.found, placing.order[place]
    zones = _counting(fits)
    if answer.by == "flare":
        flare = next((z for z in zones if z.zone == "flare"), None)
        sd = 0.0 if flare is None else flare.clearance.sd or 0.0
        return reasons.flare_words(found.flare[row].delta_deg, sd)
    if answer.by == "shape":
        ours, theirs = answer.feet[governing(answer.feet)].length_mm, found.lasts[row].length_mm
        delta = found.flare[row].delta_deg
        if ours is None or theirs is None:
            return f"flare differs by {delta:+.1f} deg; one of the lengths is not known"
        return f"length differs by {theirs - ours:+.1f} mm, flare by {delta:+.1f} deg"
    unknown = reasons.unknown_words(found.columns, np.isfinite(found.judged.score[row]).tolist())
    if placing.tier[place] == placing.tier[0]:
        return reasons.best_sentence(zones) + unknown
    first = placing.order[0]
    cost = _cost(found, row, first)
    return reasons.behind_sentence(zones, cost, found.lasts[first].labels.name) + unknown


def _counting(fits: Sequence[FootFit]) -> list[ZoneFit]:
    """The zones that count, of all feet."""
    return [zone for zone in _flat(fits) if zone.counts]


def _cost(found: Field, row: int, first: int) -> list[float]:
    """How much more each counting zone adds to a last's distance than to the first's; a zone of a
    worse verdict comes before all others.
    """
    counts = [i for i, column in enumerate(found.columns) if column.counts]
    score = np.nan_to_num(found.judged.score[:, counts], nan=1.0)
    more = found.judged.weight[counts] * (np.square(score[row]) - np.square(score[first]))
    worse = np.maximum(found.judged.level[row, counts], 0) > np.maximum(
        found.judged.level[first, counts], 0
    )
    behind = found.level[row] > found.level[first]
    return [float(m) + (1e6 if behind and w else 0.0) for m, w in zip(more, worse, strict=True)]


# ---------------------------------------------------------------- notices


def _notices(
    answer: _Answer, missed: Sequence[Candidate], question: Question
) -> tuple[Notice, ...]:
    """What the reader must know beside the table."""
    feet = answer.feet
    notices = [
        notice
        for one in feet
        for notice in (*one.suspects, *suspects(one.measures, one.aligned.alignment.pose.kind))
    ]
    if question.by == "flare":
        notices.append(
            Notice("scale_free", "a search by flare alone cannot tell sizes apart; look at length")
        )
    if question.by != "shape" and any(one.aligned.alignment.pose.kind == "last" for one in feet):
        notices.append(
            Notice("looks_like_a_last", "its shape is nearer to a last's; --by shape finds a last")
        )
    sides = {one.aligned.alignment.side.side for one in feet}
    if len(feet) == 2 and len(sides) == 1:
        notices.append(Notice("same_side", f"both feet of the pair are {sides.pop()} feet"))
    differ = reasons.pair_notice(feet, question.size_system)
    if differ is not None:
        notices.append(differ)
    if missed:
        named = "; ".join(f"{one.last}: {one.why}" for one in missed)
        notices.append(Notice("nothing_fits", f"no last fits; the nearest are {named}"))
    unknown = _unknown_to_all(answer)
    if unknown and question.by == "fit":
        zones = reasons.zone_list(unknown)
        notices.append(Notice("not_judged", f"not judged, for lack of a measure: {zones}"))
    return tuple(notices)


def _unknown_to_all(answer: _Answer) -> tuple[str, ...]:
    """The zones that no last could be judged in."""
    seen: Bools = np.atleast_1d(np.isfinite(answer.found.judged.score).any(axis=0))
    known = [bool(one) for one in seen]
    return reasons.not_judged(answer.found.columns, known)
