"""Match: a foot, or a pair, against every last of a catalogue, ranked, with reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from footfit import results
from footfit.errors import BadOption, HalfScan, NoCandidate
from footfit.geometry.fit.sizes import label_in
from footfit.geometry.numeric.arrays import Bools
from footfit.number_words import signed
from footfit.pipeline.fit import ranking, reasons
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.scoring import UNKNOWN_SCORE, VERDICTS
from footfit.pipeline.fit.toe_box import NOT_STORED
from footfit.pipeline.fit.worn_shifts import worn_with
from footfit.pipeline.fit.zones import NOT_READ, TOE_BOX
from footfit.pipeline.scan.measure import unusual_measures, usual_alignment
from footfit.pipeline.width.foot_width import foot_widths
from footfit.results.heel import FLARE, heel_words
from footfit.results.values import notices_about
from footfit.results.worn import BAREFOOT

NEAREST_NAMED = 3
"""How many lasts are shown if none fits."""
HEEL_WORDS: dict[results.SearchBy, tuple[str, ...]] = {
    "fit": ("length", "ball_girth"),
    "flare": (FLARE,),
    "shape": (),
}
"""The changes of the foot in the heel that the sentence of a last names."""
WORSE_VERDICT = 1e6
"""More than any zone can add to a distance."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked of the catalogue. ``top`` 0 asks for all lasts; the default ``profile`` is
    walking. ``surfaces_in`` is the catalogue whose meshes the feet are placed in, if that is asked.
    ``heel`` says how the feet are compared with lasts that have a heel, and ``worn`` what is worn
    with the shoes, beyond what the profile has. ``growth`` asks how long a child's shoe will do.
    """

    by: results.SearchBy = "fit"
    top: int = 5
    profile: results.FitProfile | None = None
    size_system: str | None = None
    surfaces_in: Path | None = None
    heel: results.HeelQuestion = field(default_factory=heel_question)
    worn: results.Worn = BAREFOOT
    growth: results.GrowthQuestion | None = None


def matched(
    feet: Sequence[results.Profiled], library: results.Library, question: Question | None = None
) -> results.Match:
    """Rank the library for one customer: one foot, or two whose larger governs the length.

    Raises
    ------
    NoCandidate
        No last passes the filters that were given.
    HalfScan
        By fit: a foot's length is not known, for example if its toes were not scanned.
    BadOption
        By fit or flare: a foot is a last of the catalogue.
    """
    question = question or Question()
    if question.by != "shape":
        _refuse_stored_lasts(feet)
    if not library.lasts:
        nothing = "no last passes these filters; see footfit list-lasts"
        raise NoCandidate(next((notice.message for notice in library.warnings), nothing))
    if question.by == "fit":
        _refuse_unknown_length(feet)
    profile = question.profile or fit_profile()
    usual_mm = profile.usual_length_mm
    feet = feet if usual_mm is None else [_usual_foot(foot, usual_mm) for foot in feet]
    worn = worn_with(profile, question.worn)
    judged = ranking.judged_lasts(
        feet, library.lasts, profile, question.by, question.heel, library.file, worn
    )
    ranked = ranking.ranking(judged, profile.tie_sds)
    missing = _best_out_of_stock(feet, library, profile, question, worn)
    shown = range(len(ranked.rows))[: question.top or None]
    best = (_ranked(judged, ranked, place) for place in shown)
    near = [] if ranked.rows else ranking.nearest(judged, NEAREST_NAMED)
    missed = tuple(_missed(judged, rank, row) for rank, row in enumerate(near, start=1))
    rejected = ranking.refusals(judged) if question.by == "fit" else {}
    return results.Match(
        feet=tuple(feet),
        by=question.by,
        profile=profile.name,
        catalogue_lasts=library.total,
        reference=library.reference,
        candidates=tuple(_with_size(candidate, question) for candidate in best),
        rejected=tuple(sorted((*library.rejected, *rejected.items()))),
        warnings=(
            *library.warnings,
            *_worn_notice(worn),
            *_stock_notice(missing),
            *_notices(judged, missed, question.size_system, usual_mm),
        ),
        fit_profile=profile,
        nearest=tuple(_with_size(candidate, question) for candidate in missed),
        size_system=question.size_system,
        best_verdict=_best_verdict(judged, ranked),
        heel=judged.heels.question,
        widths=foot_widths(feet, profile.usual_length_mm),
        worn=worn,
        not_in_stock=missing,
        rated=dict(library.rated).get(profile.name, 0),
    )


def _usual_foot(foot: results.Profiled, usual_mm: tuple[float, float]) -> results.Profiled:
    """A foot without a warning of its length, if that is usual for the profile."""
    aligned = foot.aligned
    usual = replace(aligned, alignment=usual_alignment(aligned.alignment, usual_mm))
    return replace(foot, aligned=usual)


def _refuse_stored_lasts(feet: Sequence[results.Profiled]) -> None:
    """Raise BadOption for a last of the catalogue in place of a foot."""
    for foot in feet:
        info = foot.aligned.alignment.info
        if info.is_stored_last:
            words = (
                "is a last of the catalogue, not a foot: give a scan of a foot; --by shape finds"
                " lasts like this one, and footfit compare puts it into another"
            )
            raise BadOption(words, info.path)


def _refuse_unknown_length(feet: Sequence[results.Profiled]) -> None:
    """Raise HalfScan for a foot without a known length: the length is the gate, and lasts that are
    too small would pass.
    """
    for foot in feet:
        alignment = foot.aligned.alignment
        if alignment.length.value is None:
            words = f"{alignment.length.reason}; no last is judged without it: scan again"
            raise HalfScan(words, alignment.info.path)


def _best_verdict(judged: ranking.JudgedLasts, ranked: ranking.Ranking) -> results.Verdict | None:
    """The verdict of the first last, if it was judged in every required zone.

    What is not known is not a pass. By fit no other last has a better verdict.
    """
    if judged.by == "shape" or not ranked.rows:
        return None
    first = ranked.rows[0]
    return VERDICTS[judged.level[first]] if judged.sound[first] else None


def meets(match: results.Match, least: results.Verdict) -> bool:
    """Is the first last at least as good as ``least``?"""
    best = match.best_verdict
    return best is not None and VERDICTS.index(best) <= VERDICTS.index(least)


# ---------------------------------------------------------------- candidates


def _ranked(judged: ranking.JudgedLasts, ranked: ranking.Ranking, place: int) -> results.Candidate:
    """The last at a place of the ranking."""
    row = ranked.rows[place]
    fits = ranking.foot_fits(judged, row)
    tied = tuple(judged.lasts[i].labels.name for i in ranked.tied(place))
    return _candidate(judged, row, place + 1, fits, _why(judged, ranked, place, _flat(fits)), tied)


def _missed(judged: ranking.JudgedLasts, rank: int, row: int) -> results.Candidate:
    """One of the lasts that come nearest if none fits."""
    fits = ranking.foot_fits(judged, row)
    rules = [column.rule for column in judged.columns]
    return _candidate(judged, row, rank, fits, reasons.missed_sentence(_flat(fits), rules))


def _candidate(
    judged: ranking.JudgedLasts,
    row: int,
    rank: int,
    fits: tuple[results.FootFit, ...],
    why: str,
    tied: tuple[str, ...] = (),
) -> results.Candidate:
    last, by_shape = judged.lasts[row], judged.by == "shape"
    labels, governed = last.labels, fits[judged.longer]
    heel = heel_words(governed.heel, HEEL_WORDS[judged.by])
    return results.Candidate(
        rank=rank,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        mirrored=judged.mirrored(row),
        distance=float(judged.distance[row]),
        flare=judged.flare[row],
        clearance_mm=tuple((z.zone, z.clearance) for z in governed.zones if z.unit == "mm"),
        verdict=None if by_shape else VERDICTS[judged.level[row]],
        why="; ".join(words for words in (why, heel) if words),
        tied_with=tied,
        record=last,
        distance_sd=float(judged.spread.alone()[row]) if judged.by == "fit" else None,
        fits=() if by_shape else fits,
        not_judged=() if by_shape else reasons.not_judged(_flat(fits)),
    )


def _with_size(candidate: results.Candidate, question: Question) -> results.Candidate:
    """The same last with its label in the size system that was asked for."""
    asked = label_in(candidate.size, candidate.size_system, question.size_system)
    return replace(candidate, size_asked=asked)


def _flat(fits: Sequence[results.FootFit]) -> list[results.ZoneFit]:
    """The zones of all feet, in the columns' order."""
    return [zone for fit in fits for zone in fit.zones]


def _why(
    judged: ranking.JudgedLasts,
    ranked: ranking.Ranking,
    place: int,
    zones: Sequence[results.ZoneFit],
) -> str:
    """Why a last stands at its place."""
    row, first = ranked.rows[place], ranked.rows[0]
    delta_deg = judged.flare[row].delta_deg
    if judged.by == "flare":
        sds = [z.clearance.sd or 0.0 for z in zones if z.zone == "flare" and z.counts]
        return reasons.flare_words(delta_deg, sds[0] if sds else 0.0)
    if judged.by == "shape":
        more = next((z.clearance.value for z in zones if z.zone == "length"), None)
        if more is None:
            return f"flare differs by {signed(delta_deg)} deg; one of the lengths is not known"
        return f"length differs by {signed(more)} mm, flare by {signed(delta_deg)} deg"
    required = [column.rule.required for column in judged.columns]
    unknown = reasons.unknown_words(zones, required)
    if ranked.tier[place] == ranked.tier[0]:
        return reasons.best_sentence(zones) + unknown
    name = judged.lasts[first].labels.name
    costs = _costs(judged, row, first)
    if not judged.sound[row] and judged.sound[first] and max(costs) < WORSE_VERDICT:
        return reasons.toe_room_words(zones) + unknown
    return reasons.behind_sentence(zones, costs, name) + unknown


def _costs(judged: ranking.JudgedLasts, row: int, first: int) -> list[float]:
    """How much more each column adds to a last's distance than to the first's; 0 if it does not
    count. Zones that make the last's verdict worse than the first's, or else its toe room, come
    before all others.
    """
    score = np.square(np.nan_to_num(judged.scores.score[[row, first]], nan=UNKNOWN_SCORE))
    level = judged.scores.level[row]
    worse = np.zeros(len(judged.columns), dtype=bool)
    if judged.level[row] > judged.level[first]:
        worse = level == judged.level[row]
    elif judged.toe_room_level[row] > judged.toe_room_level[first]:
        worse[judged.length_column] = True
    counts = np.array([column.counts for column in judged.columns])
    cost = judged.scores.weight * (score[0] - score[1]) + np.where(worse, WORSE_VERDICT, 0.0)
    return np.where(counts, cost, 0.0).tolist()  # type: ignore[no-any-return]


# ---------------------------------------------------------------- notices


def _best_out_of_stock(
    feet: Sequence[results.Profiled],
    library: results.Library,
    profile: results.FitProfile,
    question: Question,
    worn: results.Worn,
) -> results.NotInStock | None:
    """The best of the lasts that are not in stock, if one fits."""
    if not library.out_of_stock or question.by == "shape":
        return None
    judged = ranking.judged_lasts(
        feet, library.out_of_stock, profile, question.by, question.heel, library.file, worn
    )
    rows = ranking.ranking(judged, profile.tie_sds).rows
    if not rows:
        return None
    return results.NotInStock(judged.lasts[rows[0]].labels.name, VERDICTS[judged.level[rows[0]]])


def _stock_notice(missing: results.NotInStock | None) -> tuple[results.Notice, ...]:
    """The best last that the shop does not have."""
    if missing is None:
        return ()
    words = f"the best last that is not in stock is {missing.last} ({missing.verdict})"
    return (results.Notice("not_in_stock", words),)


def _worn_notice(worn: results.Worn) -> tuple[results.Notice, ...]:
    """What was worn, in one line: it shifts what is asked."""
    if worn.words is None:
        return ()
    return (results.Notice("worn_with", f"what is asked counts with {worn.words}"),)


def _notices(
    judged: ranking.JudgedLasts,
    missed: Sequence[results.Candidate],
    size_system: str | None,
    usual_mm: tuple[float, float] | None,
) -> tuple[results.Notice, ...]:
    """What the reader must know beside the table; ``usual_mm`` are the profile's lengths."""
    feet = judged.feet
    kinds = [foot.aligned.alignment.pose.kind for foot in feet]
    notices: list[results.Notice] = []
    for foot, kind in zip(feet, kinds, strict=True):
        of_foot = [*foot.unusual, *unusual_measures(foot.measures, kind, usual_mm)]
        if judged.by != "shape" and kind == "last":
            words = "its shape is like a last's; use --by shape for a last"
            of_foot.append(results.Notice("looks_like_a_last", words))
        notices += notices_about(foot.aligned.alignment.info.path, of_foot)
    if judged.by == "flare":
        words = "a search by flare knows no size: look at the length too"
        notices.append(results.Notice("scale_free", words))
    differ = reasons.pair_notice(feet, size_system)
    if differ is not None:
        notices.append(differ)
    if missed:
        names = ", ".join(candidate.last for candidate in missed)
        notices.append(results.Notice("nothing_fits", f"no last fits: the nearest are {names}"))
    elif judged.by == "fit" and not ranking.with_toe_room(judged):
        notices.append(
            results.Notice("nothing_fits", "no last fits: the length of no last is known")
        )
    if judged.by == "fit":
        notices += _not_judged(judged)
    return tuple(notices)


def _not_judged(judged: ranking.JudgedLasts) -> list[results.Notice]:
    """The zones that count and that no last was judged in, and what to do about the toe box."""
    reasons_of = list(zip(*judged.clearances.reasons, strict=True))
    known: Bools = np.any(judged.known, axis=0)
    unknown = [
        column.rule.zone
        for place, column in enumerate(judged.columns)
        if column.counts and not known[place] and set(reasons_of[place]) != {NOT_READ}
    ]
    stored_not = {
        judged.lasts[row].labels.name
        for row, reasons_there in enumerate(judged.clearances.reasons)
        if NOT_STORED in reasons_there
    }
    notices = []
    if stored_not:
        unknown = [zone for zone in unknown if zone not in TOE_BOX]
        lasts = "1 last" if len(stored_not) == 1 else f"{len(stored_not)} lasts"
        words = f"the toe box of {lasts} is not judged: {NOT_STORED}"
        notices.append(results.Notice("sections_not_stored", words))
    if unknown:
        zones = reasons.zone_list(tuple(dict.fromkeys(unknown)))
        notices.append(results.Notice("not_judged", f"not judged, for lack of a measure: {zones}"))
    return notices
