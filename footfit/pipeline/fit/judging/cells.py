"""One zone of one foot in many lasts: last minus foot, or the sentence why it is unknown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np

from footfit.geometry.flare.definition import FlareProfile
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct
from footfit.results import LastRecord, Measure, Profiled
from footfit.results.columns.last_columns import LastColumns
from footfit.results.columns.vocabulary import NO_WORD, Words

MEASURE_AGAIN = (
    "type: footfit upgrade-catalogue; if a last has no mesh copy, ingest its file again with"
    " --replace"
)
"""What helps a last whose stored numbers are old; ranking does not read whether it has a copy."""
OTHER_DEFINITION = f"measured by another definition; {MEASURE_AGAIN}"


@dataclass(frozen=True, slots=True)
class Cells:
    """The clearances of one foot in one zone of n lasts, (n,) each.

    ``value`` is NaN where it is not measured; ``reason`` then is the number of a sentence, else
    NO_WORD.
    """

    value: Floats
    foot_sd: Floats
    last_sd: Floats
    reason: Ints

    def where(self, rows: Bools, others: Cells) -> Cells:
        """The other clearances in some rows."""
        return Cells(
            *(
                np.where(rows, getattr(others, known.name), getattr(self, known.name))
                for known in fields(self)
            )
        )


@dataclass(frozen=True, slots=True)
class ZoneShape:
    """What zones read of a foot or a last; shares of the length are of ``extent_mm``."""

    extent_mm: float
    flare: FlareProfile
    measures: Mapping[str, Measure]
    labelled_heel_mm: float | None = None

    def measured_mm(self, name: str) -> float | None:
        """The value of a measure, by whichever definition; None where there is none."""
        return self.measures[name].measured.value if name in self.measures else None

    @property
    def heel_height_mm(self) -> float | None:
        """The heel height as measured, else as labelled; a foot has none."""
        measured_mm = self.measured_mm("heel_height")
        return self.labelled_heel_mm if measured_mm is None else measured_mm


def foot_shape(foot: Profiled) -> ZoneShape:
    """What zones read of a foot."""
    measures = {measure.name: measure for measure in foot.measures}
    return ZoneShape(foot.aligned.alignment.extent_mm, foot.flare, measures)


def last_shape(last: LastRecord) -> ZoneShape:
    """What zones read of a last."""
    measures = {measure.name: measure for measure in last.measures}
    return ZoneShape(last.extent_mm, last.flare, measures, last.labels.heel_height_mm)


def missing(count: int, reason: int) -> Cells:
    """No clearance in so many lasts, for one reason."""
    nothing = np.zeros(count)
    return Cells(np.full(count, np.nan), nothing, nothing, np.full(count, reason))


def known_cells(value: Floats, foot_sd: float, last_sd: Floats | float) -> Cells:
    """Clearances that are known of all lasts."""
    return Cells(
        value,
        np.full(len(value), foot_sd),
        np.broadcast_to(np.asarray(last_sd, dtype=np.float64), value.shape),
        np.full(len(value), NO_WORD),
    )


def measure_difference(foot: ZoneShape, lasts: LastColumns, name: str, sentences: Words) -> Cells:
    """The last's measure minus the foot's, if both have it and mean the same by it."""
    own = foot.measures.get(name)
    if own is None:
        return missing(len(lasts), sentences.number("not measured on the foot"))
    if own.measured.value is None:
        why = own.measured.reason or "not measured"
        return missing(len(lasts), sentences.number(f"the foot: {why}"))
    theirs = lasts.measure(name)
    lacks, silent = theirs.word == NO_WORD, np.isnan(theirs.value)
    used = distinct(theirs.word[~lacks])
    reason = np.full(len(lasts), NO_WORD)
    for word in used.tolist():
        definition, why = lasts.words.measures.values[word]
        of_word = theirs.word == word
        if definition != own.definition:
            reason[of_word] = sentences.number(OTHER_DEFINITION)
        unknown = of_word & silent
        if unknown.any():
            reason[unknown] = sentences.number(f"the last: {why or 'not measured'}")
    reason[lacks] = sentences.number("not measured on the last") if lacks.any() else NO_WORD
    known = reason == NO_WORD
    return Cells(
        np.where(known, theirs.value - own.measured.value, np.nan),
        np.where(known, own.measured.sd or 0.0, 0.0),
        np.where(known, theirs.sd, 0.0),
        reason,
    )
