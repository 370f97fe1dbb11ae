"""How much longer lasts with a heel are along their bottoms, by column."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

from footfit.catalogue.blocks.record_columns import measure_columns
from footfit.geometry.fit.along_the_bottom import ALONG_BOTTOM, LastLengths, length_along_bottom
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats, Ints, distinct
from footfit.pipeline.fit.judging.cells import OTHER_DEFINITION, Cells, ZoneShape
from footfit.results.columns.last_columns import LastColumns, MeasureColumns
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary, Words

LENGTHS = {known.name: measure_named(known.name).definition_id for known in fields(LastLengths)}
"""The measures that say how long a last is along its bottom, with their definitions."""


def shape_gain(shape: ZoneShape, sentences: Words) -> Cells:
    """The `column_gain` of one foot or last, (1,)."""
    words, heel_mm = Vocabulary(), shape.labelled_heel_mm
    measures = measure_columns([tuple(shape.measures.values())], words)
    labelled_mm = np.array([np.nan if heel_mm is None else heel_mm])
    return column_gain(measures, words.measures, labelled_mm, sentences)


def bottom_gain(shape: ZoneShape) -> tuple[float, float]:
    """How much longer one last is along its bottom, and the standard deviation of that; NaN if it
    is not known.
    """
    if (shape.heel_height_mm or 0.0) <= ALONG_BOTTOM.level_mm:
        return 0.0, 0.0
    gain = shape_gain(shape, Words())
    return float(gain.value[0]), float(gain.last_sd[0])


def last_gain(lasts: LastColumns, sentences: Words) -> Cells:
    """The `column_gain` of lasts."""
    assert lasts.measures is not None
    return column_gain(lasts.measures, lasts.words.measures, lasts.heel_label_mm, sentences)


def column_gain(
    measures: MeasureColumns, words: Words, labelled_mm: Floats, sentences: Words
) -> Cells:
    """How much longer a last with a heel is along its bottom than along its resting plane.

    Without the measures of its bottom the toe room of a last with a high heel is not known.
    ``words`` are the vocabulary's, ``labelled_mm`` (n,) the heel heights on the labels.
    """
    heel_mm = measures.column("heel_height").value
    heel_mm = np.where(np.isnan(heel_mm), labelled_mm, heel_mm)
    gain_mm, sd_mm = np.zeros((2, len(heel_mm)))
    reason = np.full(len(heel_mm), NO_WORD)
    rows = np.flatnonzero(heel_mm > ALONG_BOTTOM.level_mm)
    if len(rows):
        gain_mm[rows], sd_mm[rows], reason[rows] = _heeled_gain(
            measures.taken(rows), words, heel_mm[rows], sentences
        )
    return Cells(gain_mm, np.zeros(len(heel_mm)), sd_mm, reason)


def _heeled_gain(
    measures: MeasureColumns, words: Words, heel_mm: Floats, sentences: Words
) -> tuple[Floats, Floats, Ints]:
    """The gain of lasts with a heel, its spread, and why it is not known, (n,) each."""
    columns = {name: measures.column(name) for name in LENGTHS}
    functional_mm = measures.column("functional_length").value
    measured = np.nan_to_num(functional_mm) != 0.0
    level_mm = np.where(measured, functional_mm, measures.column("length").value)
    lengths = np.stack([column.value for column in columns.values()])
    whole = ~np.isnan(level_mm) & ~np.isnan(lengths).any(axis=0)
    other = np.zeros(len(heel_mm), dtype=bool)
    for name, column in columns.items():
        there = column.word != NO_WORD
        for word in distinct(column.word[there]).tolist():
            if words.values[word][0] != LENGTHS[name]:
                other |= column.word == word
    reason = np.where(whole & other, sentences.number(OTHER_DEFINITION), NO_WORD)
    high = ~whole & (heel_mm >= ALONG_BOTTOM.raised_mm)
    if high.any():
        reason[high] = sentences.number("the last: its bottom is not measured")
    with np.errstate(invalid="ignore"):
        along_mm, sd_mm = length_along_bottom(level_mm, LastLengths(*lengths))
    known = whole & ~other
    gain_mm = np.where(known, along_mm - level_mm, np.where(whole | high, np.nan, 0.0))
    return gain_mm, np.where(known, sd_mm, 0.0), reason
