"""Match: a foot, or a pair, against every last of a catalogue, ranked, with reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from footfit import results
from footfit.catalogue.blocks.block_bytes import BOTTOM, PLAN
from footfit.catalogue.blocks.block_reading import BadBlocks
from footfit.catalogue.blocks.search_file import OtherCatalogue
from footfit.errors import NoCandidate
from footfit.geometry.fit.sizes import label_in
from footfit.locations import Location
from footfit.number_words import signed
from footfit.pipeline.fit import ranking, reasons
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.judging.judged_lasts import Asked, Gated, JudgedLasts, asked_of
from footfit.pipeline.fit.judging.toe_box import NOT_STORED
from footfit.pipeline.fit.refused_feet import refuse_lasts, refuse_unknown_length
from footfit.pipeline.fit.scoring import UNKNOWN_SCORE
from footfit.pipeline.fit.worn_shifts import worn_with
from footfit.pipeline.fit.zones import TOE_BOX
from footfit.pipeline.scan.measure import unusual_measures, usual_alignment
from footfit.pipeline.shelf.shelf import Shelf, shelf_of
from footfit.pipeline.width.foot_width import foot_widths
from footfit.results.heel import FLARE, heel_words
from footfit.results.values import VERDICTS, notices_about
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
    ``force_foot`` takes a shape for a foot that is surely a last.
    """

    by: results.SearchBy = "fit"
    top: int = 5
    profile: results.FitProfile | None = None
    size_system: str | None = None
    surfaces_in: Location | None = None
    heel: results.HeelQuestion = field(default_factory=heel_question)
    worn: results.Worn = BAREFOOT
    growth: results.GrowthQuestion | None = None
    force_foot: bool = False


def matched(
    feet: Sequence[results.Profiled],
    library: results.Library | Shelf,
    question: Question | None = None,
) -> results.Match:
    """Rank the library for one customer: one foot, or two whose larger governs the length.

    The lasts that are shown are read from their rows. One that is damaged is left out, with a
    warning, and the next one takes its place.

    Raises
    ------
    NoCandidate
        No last passes the filters that were given.
    HalfScan
        By fit: a foot's length is not known, for example if its toes were not scanned.
    BadOption, OtherKind
        By fit or flare: a foot is a last of the catalogue, or surely a last.
    """
    question = question or Question()
    if question.by != "shape":
        refuse_lasts(
            feet, forced=question.force_foot, hint=", and --force-foot takes it for a foot"
        )
    shelf = library if isinstance(library, Shelf) else shelf_of(library)
    if not shelf.ranked.any():
        nothing = "no last passes these filters; see footfit list-lasts"
        raise NoCandidate(next((notice.message for notice in shelf.warnings), nothing))
    if question.by == "fit":
        refuse_unknown_length(feet)
    profile = question.profile or fit_profile()
    usual_mm = profile.usual_length_mm
    feet = feet if usual_mm is None else [_usual_foot(foot, usual_mm) for foot in feet]
    worn = worn_with(profile, question.worn)
    asked = asked_of(feet, profile, question.by, question.heel, worn)
    shelf, shown = _shown(asked, shelf, question.top)
    ranked = shown.ranked
    missing = _best_out_of_stock(asked, shelf, ranked)
    candidates = [_with_size(_candidate(shown, place), question) for place in shown.places]
    nearest = tuple(candidates) if ranked.nearest else ()
    rejected = ranked.gated.refusals if question.by == "fit" else {}
    return results.Match(
        feet=asked.feet,
        by=question.by,
        profile=profile.name,
        catalogue_lasts=shelf.total,
        reference=shelf.reference,
        candidates=() if ranked.nearest else tuple(candidates),
        rejected=tuple(sorted((*shelf.rejected, *rejected.items()))),
        warnings=(
            *shelf.warnings,
            *_worn_notice(worn),
            *_stock_notice(missing),
            *_notices(ranked, nearest, question.size_system, usual_mm),
        ),
        fit_profile=profile,
        nearest=nearest,
        size_system=question.size_system,
        best_verdict=_best_verdict(ranked),
        heel=asked.heel,
        widths=foot_widths(feet, profile.usual_length_mm),
        worn=worn,
        not_in_stock=missing,
        rated=dict(shelf.rated).get(profile.name, 0),
    )


@dataclass(frozen=True, slots=True)
class Shown:
    """The lasts that are shown to a customer, with their records and how their flare differs."""

    ranked: ranking.Ranking
    records: tuple[results.LastRecord, ...]
    flare: tuple[results.FlareDifference, ...]

    @property
    def places(self) -> range:
        """Their places in the ranking."""
        return range(len(self.records))


def _shown(asked: Asked, shelf: Shelf, top: int) -> tuple[Shelf, Shown]:
    """The ranking whose shown lasts are intact, and the shelf as it then is.

    Rows are the truth. A last whose rows are damaged is taken from the shelf. If a search block is
    not what was stored, or somebody changed the catalogue meanwhile, the shelf is made anew.

    Raises
    ------
    NoCandidate
        No last is left.
    """
    bad: frozenset[int] = frozenset()
    while shelf.ranked.any():
        try:
            ranked = ranking.ranking(asked, shelf.lasts, shelf.ranked, top, NEAREST_NAMED)
            rows = ranked.judged.rows
            seen = shelf.lasts.shown(rows.tolist())
            damaged = [
                row for row, last in zip(rows.tolist(), seen, strict=True) if not last.record
            ]
            spoilt = [row for row, last in zip(rows.tolist(), seen, strict=True) if last.spoilt]
            if damaged or spoilt:
                shelf = shelf.without(damaged).with_spoilt(spoilt)
                continue
            profiles = shelf.lasts.taken(rows, (PLAN, BOTTOM))
            flare = ranking.flare_differences(asked.feet, profiles, ranked.judged.heels)
            records = tuple(last.record for last in seen if last.record is not None)
            return shelf, Shown(ranked, records, tuple(flare))
        except OtherCatalogue:
            shelf = shelf.anew(bad)
        except BadBlocks as error:
            bad |= error.blocks
            shelf = shelf.anew(bad)
    raise NoCandidate(shelf.warnings[0].message if shelf.warnings else "no last is left to rank")


def _usual_foot(foot: results.Profiled, usual_mm: tuple[float, float]) -> results.Profiled:
    """A foot without a warning of its length, if that is usual for the profile."""
    aligned = foot.aligned
    usual = replace(aligned, alignment=usual_alignment(aligned.alignment, usual_mm))
    return replace(foot, aligned=usual)


def _best_verdict(ranked: ranking.Ranking) -> results.Verdict | None:
    """The verdict of the first last, if it was judged in every required zone.

    What is not known is not a pass. By fit no other last has a better verdict.
    """
    judged = ranked.judged
    if judged.asked.by == "shape" or ranked.nearest or not len(judged.rows):
        return None
    return VERDICTS[judged.level[0]] if judged.sound[0] else None


def meets(match: results.Match, least: results.Verdict) -> bool:
    """Is the first last at least as good as ``least``?"""
    best = match.best_verdict
    return best is not None and VERDICTS.index(best) <= VERDICTS.index(least)


# ---------------------------------------------------------------- candidates


def _candidate(shown: Shown, place: int) -> results.Candidate:
    """The last at a place of the ranking, or one of those that come nearest if none fits."""
    ranked, last = shown.ranked, shown.records[place]
    judged = ranked.judged
    asked = judged.asked
    by_shape, labels = asked.by == "shape", last.labels
    fits = ranking.foot_fits(judged, place, last)
    zones, governed = _flat(fits), fits[asked.longer]
    if ranked.nearest:
        why = reasons.missed_sentence(zones, [column.rule for column in asked.columns])
    else:
        why = _why(shown, place, zones)
    heel = heel_words(governed.heel, HEEL_WORDS[asked.by])
    return results.Candidate(
        rank=place + 1,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        mirrored=judged.mirrored(place),
        distance=float(judged.distance[place]),
        flare=shown.flare[place],
        clearance_mm=tuple((z.zone, z.clearance) for z in governed.zones if z.unit == "mm"),
        verdict=None if by_shape else VERDICTS[judged.level[place]],
        why="; ".join(words for words in (why, heel) if words),
        tied_with=() if ranked.nearest else ranked.tied(place),
        record=last,
        distance_sd=float(judged.spread.alone()[place]) if asked.by == "fit" else None,
        fits=() if by_shape else fits,
        not_judged=() if by_shape else reasons.not_judged(zones),
    )


def _with_size(candidate: results.Candidate, question: Question) -> results.Candidate:
    """The same last with its label in the size system that was asked for."""
    asked = label_in(candidate.size, candidate.size_system, question.size_system)
    return replace(candidate, size_asked=asked)


def _flat(fits: Sequence[results.FootFit]) -> list[results.ZoneFit]:
    """The zones of all feet, in the columns' order."""
    return [zone for fit in fits for zone in fit.zones]


def _why(shown: Shown, place: int, zones: Sequence[results.ZoneFit]) -> str:
    """Why a last stands at its place."""
    ranked, judged = shown.ranked, shown.ranked.judged
    by, delta_deg = judged.asked.by, shown.flare[place].delta_deg
    if by == "flare":
        sds = [z.clearance.sd or 0.0 for z in zones if z.zone == "flare" and z.counts]
        return reasons.flare_words(delta_deg, sds[0] if sds else 0.0)
    if by == "shape":
        more = next((z.clearance.value for z in zones if z.zone == "length"), None)
        if more is None:
            return f"flare differs by {signed(delta_deg)} deg; one of the lengths is not known"
        return f"length differs by {signed(more)} mm, flare by {signed(delta_deg)} deg"
    required = [column.rule.required for column in judged.asked.columns]
    unknown = reasons.unknown_words(zones, required)
    if ranked.tier[place] == ranked.tier[0]:
        return reasons.best_sentence(zones) + unknown
    costs = _costs(judged, place)
    if not judged.sound[place] and judged.sound[0] and max(costs) < WORSE_VERDICT:
        return reasons.toe_room_words(zones) + unknown
    return reasons.behind_sentence(zones, costs, ranked.names[0]) + unknown


def _costs(judged: JudgedLasts, row: int) -> list[float]:
    """How much more each column adds to a last's distance than to the first's; 0 if it does not
    count. Zones that make the last's verdict worse than the first's, or else its toe room, come
    before all others.
    """
    score = np.square(np.nan_to_num(judged.scores.score[[row, 0]], nan=UNKNOWN_SCORE))
    level = judged.scores.level[row]
    worse = np.zeros(len(judged.asked.columns), dtype=bool)
    if judged.level[row] > judged.level[0]:
        worse = level == judged.level[row]
    elif judged.toe_room_level[row] > judged.toe_room_level[0]:
        worse[judged.asked.length_column] = True
    counts = np.array([column.counts for column in judged.asked.columns])
    cost = judged.scores.weight * (score[0] - score[1]) + np.where(worse, WORSE_VERDICT, 0.0)
    return np.where(counts, cost, 0.0).tolist()  # type: ignore[no-any-return]


# ---------------------------------------------------------------- notices


def _best_out_of_stock(
    asked: Asked, shelf: Shelf, ranked: ranking.Ranking
) -> results.NotInStock | None:
    """The best of the lasts that are not in stock, if one fits."""
    if not shelf.out_of_stock.any() or asked.by == "shape":
        return None
    try:
        _, shown = _shown(asked, shelf.swapped(), 1)
    except NoCandidate:  # all of them are damaged
        return None
    judged = shown.ranked.judged
    if shown.ranked.nearest or not shown.records:
        return None
    better = ranked.nearest or ranking.standing(judged) < ranking.standing(ranked.judged)
    return results.NotInStock(shown.records[0].labels.name, VERDICTS[judged.level[0]], better)


def _stock_notice(missing: results.NotInStock | None) -> tuple[results.Notice, ...]:
    """The best last that the shop does not have."""
    return () if missing is None else (results.Notice("not_in_stock", missing.words),)


def _worn_notice(worn: results.Worn) -> tuple[results.Notice, ...]:
    """What was worn, in one line: it shifts what is asked."""
    if worn.words is None:
        return ()
    return (results.Notice("worn_with", f"what is asked counts with {worn.words}"),)


def _notices(
    ranked: ranking.Ranking,
    missed: Sequence[results.Candidate],
    size_system: str | None,
    usual_mm: tuple[float, float] | None,
) -> tuple[results.Notice, ...]:
    """What the reader must know beside the table; ``usual_mm`` are the profile's lengths."""
    asked = ranked.judged.asked
    feet = asked.feet
    kinds = [foot.aligned.alignment.pose.kind for foot in feet]
    notices: list[results.Notice] = []
    for foot, kind in zip(feet, kinds, strict=True):
        of_foot = [*foot.unusual, *unusual_measures(foot.measures, kind, usual_mm)]
        if asked.by != "shape" and kind == "last":
            words = "its shape is nearer to a last's than to a foot's; for a last use --by shape"
            of_foot.append(results.Notice("looks_like_a_last", words))
        notices += notices_about(foot.aligned.alignment.info.path, of_foot)
    if asked.by == "flare":
        words = "a search by flare knows no size: look at the length too"
        notices.append(results.Notice("scale_free", words))
    differ = reasons.pair_notice(feet, size_system)
    if differ is not None:
        notices.append(differ)
    if missed:
        names = ", ".join(candidate.last for candidate in missed)
        notices.append(results.Notice("nothing_fits", f"no last fits: the nearest are {names}"))
    elif asked.by == "fit" and not ranked.gated.rooms:
        notices.append(
            results.Notice("nothing_fits", "no last fits: the length of no last is known")
        )
    if asked.by == "fit":
        notices += _not_judged(asked, ranked.gated)
    return tuple(notices)


def _not_judged(asked: Asked, gated: Gated) -> list[results.Notice]:
    """The zones that count and that no last was judged in, and what to do about the toe box."""
    unknown = [
        column.rule.zone
        for column, known in zip(asked.columns, gated.known.tolist(), strict=True)
        if column.counts and not known and (gated.looked_at or column.rule.zone not in TOE_BOX)
    ]
    notices = []
    if gated.without_sections:
        unknown = [zone for zone in unknown if zone not in TOE_BOX]
        many = gated.without_sections
        lasts = "1 last" if many == 1 else f"{many} lasts"
        words = f"the toe box of {lasts} is not judged: {NOT_STORED}"
        notices.append(results.Notice("sections_not_stored", words))
    if unknown:
        zones = reasons.zone_list(tuple(dict.fromkeys(unknown)))
        notices.append(results.Notice("not_judged", f"not judged, for lack of a measure: {zones}"))
    return notices
