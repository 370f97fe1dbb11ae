"""Labels that the shapes contradict: size, width, heel and side."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import pairwise

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import label_number
from footfit.number_words import plain, signed
from footfit.pipeline.batch.side_words import side_in_name
from footfit.pipeline.graded_runs.run_sizes import width_numbers
from footfit.results import LastRecord
from footfit.results.population.checked_lasts import LastCode, LastFinding

WIDER_MM = 1.0
"""A wider last of one size has at least so much more ball girth; a width step is 4 to 7 mm."""
_LETTER = re.compile(r"(?<![^\W_])[lr](?![^\W_])", re.IGNORECASE)
"""A single letter of a last's name may be a size or a width, and says no side."""
STORED: dict[str, LastCode] = {
    "side_contradicted": "side_contradicted",
    "side_name_differs": "side_contradicted",
    "low_side_confidence": "side_doubtful",
    "stance_label_contradicted": "heel_contradicted",
    "looks_like_a_foot": "looks_like_a_foot",
}
"""Warnings of the ingest that say that a label, or the kind, does not go with the shape."""


def label_findings(records: Sequence[LastRecord]) -> Iterator[LastFinding]:
    """What the shape of each last contradicts of its labels."""
    for record in records:
        name = record.labels.name
        for notice in record.label_notices:
            yield LastFinding("size_contradicted", name, notice.message)
        codes = set()
        for notice in record.warnings:
            if notice.code in STORED:
                codes.add(STORED[notice.code])
                yield LastFinding(STORED[notice.code], name, notice.message)
        if not codes & {"side_contradicted", "side_doubtful"}:
            yield from _side_findings(record)
    yield from _width_findings(records)


def _side_findings(record: LastRecord) -> Iterator[LastFinding]:
    """A side that was given, or that the name says, and that the shape does not show."""
    name, side = record.labels.name, record.side
    shape = f"its shape looks {side.shown} (score {signed(side.score)})"
    said = side_in_name(_LETTER.sub("", name)).side
    if side.source == "given" and side.shown != side.side:
        sure = side.confidence == "sure"
        code: LastCode = "side_contradicted" if sure else "side_doubtful"
        yield LastFinding(code, name, f"it was given as {side.side}, and {shape}")
    elif said is not None and said != side.side:
        yield LastFinding("side_contradicted", name, f"its name says {said}, and {shape}")


def _width_findings(records: Sequence[LastRecord]) -> Iterator[LastFinding]:
    """Widths of one model and size that do not rise with the ball girth."""
    groups: dict[tuple[object, ...], list[LastRecord]] = defaultdict(list)
    for record in records:
        labels = record.labels
        size = label_number(labels.size)
        model = labels.family or labels.style
        if size is None or model is None or not labels.width_label:
            continue
        if record.value_of("ball_girth") is not None:
            side = record.side.side or ""
            groups[model, labels.size_system or "", size, side].append(record)
    for key in sorted(groups, key=str):
        yield from _widths_of(str(key[0]), groups[key])


def _widths_of(family: str, group: Sequence[LastRecord]) -> Iterator[LastFinding]:
    try:
        number = width_numbers(sorted({str(each.labels.width_label) for each in group}))
    except BadOption:  # the widths have no order that is known
        return
    ordered = sorted(
        group, key=lambda each: (number[str(each.labels.width_label)], each.labels.name)
    )
    for narrow, wide in pairwise(ordered):
        first, second = (str(each.labels.width_label) for each in (narrow, wide))
        more = (wide.value_of("ball_girth") or 0.0) - (narrow.value_of("ball_girth") or 0.0)
        if first != second and more < WIDER_MM:
            other = narrow.labels.name
            size = "no more" if more >= 0.0 else f"{plain(-more)} mm less"
            words = f"its width is {second}, and it has {size} ball girth than {other!r} in {first}"
            yield LastFinding(
                "width_contradicted", wide.labels.name, words, other, family,
                "ball_girth", more, WIDER_MM,
            )  # fmt: skip
