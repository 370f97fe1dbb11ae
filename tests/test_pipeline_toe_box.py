"""The toe box of a match: height and toes, what they are read from, and what is said if they are
not known.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from footfit.api.catalogues import open_catalogue
from footfit.catalogue.blocks.block_bytes import TOES as TOES_PART
from footfit.catalogue.blocks.block_reading import BlockLasts
from footfit.catalogue.blocks.record_columns import columns_of
from footfit.catalogue.store import open_catalogue as catalogue_at
from footfit.geometry.numeric.arrays import Ints
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit.fit_profile import fit_profile, shipped
from footfit.pipeline.fit.heels import heels_of
from footfit.pipeline.fit.judging import toe_box
from footfit.pipeline.fit.scoring import GOOD, REJECT, levels
from footfit.pipeline.fit.zones import NOT_READ, TOE_BOX, TOE_HEIGHT, TOES
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import Candidate, FootFit, Match, Measured, Profiled, ZoneFit
from footfit.results.columns.last_columns import LastColumns
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary, Words
from footfit.results.heel import AS_SCANNED
from tests.conftest import SAMPLES

FEET = SAMPLES / "feet"
SAME_MM = 0.2
"""A mirrored scan, in another pose; measured: 0.05 mm."""


@pytest.fixture(scope="module")
def right() -> Profiled:
    return profiled_source(Source(str(FEET / "mh008_R.stl")), ReadingOptions())


def reshaped(
    foot: Profiled, *, toes_higher: float = 1.0, inward_mm: float = 0.0, held_up_mm: float = 0.0
) -> Profiled:
    """The foot, scanned again with other toes: higher, a big toe further inside, or held up."""
    vertices_mm, faces = foot.aligned.prepared.vertices_mm.copy(), foot.aligned.prepared.faces
    x = vertices_mm[:, 0] / vertices_mm[:, 0].max()
    toes = np.clip((x - 0.76) / 0.06, 0.0, 1.0)
    vertices_mm[:, 2] *= 1.0 + toes * (toes_higher - 1.0)
    vertices_mm[:, 2] += held_up_mm * toes
    inner = np.clip((vertices_mm[:, 1] - 10.0) / 20.0, 0.0, 1.0)
    vertices_mm[:, 1] += inward_mm * toes * inner
    data = encoded_mesh(vertices_mm, faces, "stl")
    return profiled_source(Source("r.stl", data, "stl"), ReadingOptions(side="right"))


def in_last(foot: Profiled | list[Profiled], catalogue: Path, name: str = "derby-43") -> Candidate:
    answer = asked(foot, catalogue)
    return next(candidate for candidate in answer.candidates if candidate.last == name)


def asked(foot: Profiled | list[Profiled], catalogue: Path, **question: object) -> Match:
    from footfit.pipeline.fit.match import Question, matched
    from footfit.pipeline.shelf.candidates import choice

    feet = foot if isinstance(foot, list) else [foot]
    return matched(feet, choice(catalogue, None, None), Question(top=0, **question))


def zone(fit: FootFit, name: str) -> ZoneFit:
    return next(each for each in fit.zones if each.zone == name)


def mm(fit: FootFit, name: str) -> float:
    value = zone(fit, name).clearance.value
    assert value is not None
    return value


def test_a_higher_toe_has_less_room(right: Profiled, stocked: Path) -> None:
    before = in_last(right, stocked).fits[0]
    higher = reshaped(right, toes_higher=1.25)
    after = in_last(higher, stocked).fits[0]
    grown = [
        next(m.measured.value for m in foot.measures if m.name == TOE_HEIGHT)
        for foot in (right, higher)
    ]
    lost = grown[1] - grown[0]
    assert lost > 5.0
    assert mm(after, TOE_HEIGHT) == pytest.approx(mm(before, TOE_HEIGHT) - lost, abs=SAME_MM)
    assert zone(after, TOE_HEIGHT).verdict == "poor"
    assert after.verdict == "poor"


def test_a_toe_through_the_wall_is_named_and_judged(right: Profiled, stocked: Path) -> None:
    before = in_last(right, stocked)
    after = in_last(reshaped(right, inward_mm=6.0), stocked)
    toes = zone(after.fits[0], TOES)
    assert toes.place == "big toe, inner wall"
    assert mm(after.fits[0], TOES) < mm(before.fits[0], TOES) - 4.0
    assert (toes.verdict, after.verdict) == ("poor", "poor")
    assert f"big toe {-mm(after.fits[0], TOES):.1f} mm through the inner wall" in after.why
    box = after.fits[0].toe_box
    assert box is not None
    assert box.toes[0].toe == box.tightest.toe == "big toe"
    assert box.tightest.clearance == toes.clearance
    assert after.fits[0].to_dict()["toe_box"]["big_toe"]["wall"] == "inner"


def test_a_pair_has_the_toes_of_both_feet(right: Profiled, stocked: Path) -> None:
    mirrored = right.aligned.prepared.vertices_mm * [1.0, -1.0, 1.0]
    data = encoded_mesh(mirrored, right.aligned.prepared.faces[:, ::-1], "stl")
    left = profiled_source(Source("l.stl", data, "stl"), ReadingOptions())
    fits = in_last([left, right], stocked).fits
    assert [fit.side for fit in fits] == ["left", "right"]
    boxes = [fit.toe_box for fit in fits]
    assert boxes[0] is not None
    assert boxes[1] is not None
    for ours, theirs in zip(boxes[0].toes, boxes[1].toes, strict=True):
        assert ours.wall == theirs.wall
        assert ours.clearance.value == pytest.approx(theirs.clearance.value, abs=SAME_MM)


@pytest.mark.parametrize("reason", ["this part was not scanned", "the scan is open at the toes"])
def test_toes_that_were_not_scanned_are_not_judged(
    right: Profiled, stocked: Path, reason: str
) -> None:
    measures = tuple(
        replace(m, measured=Measured(None, reason=reason)) if m.name == TOE_HEIGHT else m
        for m in right.measures
    )
    known = in_last(right, stocked)
    candidate = in_last(replace(right, measures=measures), stocked)
    for name in (TOES, TOE_HEIGHT):
        lacking = zone(candidate.fits[0], name)
        assert lacking.clearance == Measured(None, reason=f"the foot: {reason}")
        assert (lacking.verdict, lacking.place) == (None, None)
    assert candidate.fits[0].toe_box is None
    assert candidate.fits[0].to_dict()["toe_box"] is None
    assert set(candidate.not_judged) - set(known.not_judged) == {TOES, TOE_HEIGHT}


def test_a_last_without_sections_says_what_to_type(right: Profiled, catalogue: Path) -> None:
    whole = in_last(right, catalogue)
    with closing(sqlite3.connect(catalogue)) as connection, connection:
        connection.execute(
            "DELETE FROM section WHERE last_id = (SELECT id FROM last WHERE name = 'derby-43')"
        )
    answer = asked(right, catalogue)
    candidate = in_last(right, catalogue)
    assert zone(candidate.fits[0], TOES).clearance.reason == toe_box.NOT_STORED
    assert zone(candidate.fits[0], TOE_HEIGHT).clearance.reason == toe_box.NOT_STORED
    notices = {notice.code: notice.message for notice in answer.warnings}
    assert "1 last is not judged" in notices["sections_not_stored"]
    assert "footfit upgrade-catalogue" in notices["sections_not_stored"]
    with open_catalogue(catalogue) as again:
        again.upgrade()
    upgraded = in_last(right, catalogue).fits[0]
    for name in (TOES, TOE_HEIGHT):
        assert mm(upgraded, name) == pytest.approx(mm(whole.fits[0], name), abs=SAME_MM)


def test_damaged_sections_are_not_judged(right: Profiled, catalogue: Path) -> None:
    with closing(sqlite3.connect(catalogue)) as connection, connection:
        connection.execute("UPDATE section SET toes_points_mm = heel_points_mm")
    reason = zone(in_last(right, catalogue).fits[0], TOES).clearance.reason
    assert reason is not None
    assert "damaged; ingest the last again with --replace" in reason


@pytest.mark.parametrize("stations", [0, 40, 79])
def test_an_outline_that_ends_before_the_tip_is_not_judged(
    right: Profiled, stocked: Path, stations: int
) -> None:
    with catalogue_at(stocked) as kept:
        record, sections = kept.record("derby-43"), kept.sections("derby-43")
    assert sections is not None
    assert sections.toes_outline_mm is not None
    outline = sections.toes_outline_mm[:stations] if stations else None
    kept_toes = [replace(sections, toes_outline_mm=outline), sections]
    lasts, sentences = columns_of([record, record], kept_toes, Vocabulary()), Words()
    heels = heels_of(AS_SCANNED, [record, record])
    toes = toe_box.foot_toes(right)
    reason = toe_box.toe_reasons(toes, lasts, sentences)
    rooms_mm = np.array([14.0, 14.0])
    tightest = toe_box.tightest_mm(toes, lasts, reason == NO_WORD, heels, heels.share, rooms_mm)
    assert sentences.values[reason[0]] == "the last: the scan is open at the toes"
    assert np.isnan(tightest[0])
    assert reason[1] == NO_WORD
    assert toe_box.toe_box(toes, lasts, 0, heels, 14.0, 0.0) is None
    box = toe_box.toe_box(toes, lasts, 1, heels, 14.0, 0.0)
    assert box is not None
    assert box.tightest.clearance.value == tightest[1]


def test_nothing_is_read_of_a_last_that_another_zone_rejects(
    right: Profiled, stocked: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read: list[str] = []
    taken = BlockLasts.taken

    def noting(lasts: BlockLasts, chosen: Ints, parts: Sequence[str]) -> LastColumns:
        answer = taken(lasts, chosen, parts)
        if tuple(parts) == (TOES_PART,):
            read.extend(answer.names)
        return answer

    monkeypatch.setattr(BlockLasts, "taken", noting)
    answer = asked(right, stocked)
    assert sorted(read) == sorted(candidate.last for candidate in answer.candidates)
    by_flare = asked(right, stocked, by="flare")
    reasons = {zone(c.fits[0], TOES).clearance.reason for c in by_flare.candidates}
    assert NOT_READ in reasons


def test_a_heel_that_is_too_high_is_judged_by_length_alone(
    right: Profiled, catalogue: Path
) -> None:
    with open_catalogue(catalogue) as lasts:
        record = lasts.last("derby-43").record
    raised = replace(record, labels=replace(record.labels, heel_height_mm=115.0))
    from footfit.pipeline.fit.match import Question, matched
    from footfit.results import Library

    library = Library((raised,), 1, None, file=catalogue)
    answer = matched([right], library, Question(profile=fit_profile("dress")))
    fit = answer.candidates[0].fits[0]
    assert "only the length is judged" in str(zone(fit, TOES).clearance.reason)


@pytest.mark.parametrize("name", shipped())
def test_every_shipped_profile_judges_the_toe_box(name: str) -> None:
    rules = {rule.zone: rule for rule in fit_profile(name).zones}
    if name == "sandal":  # it has no wall around the toes
        assert not {TOES, TOE_HEIGHT} & set(rules)
        return
    assert {TOES, TOE_HEIGHT} <= set(rules)
    for zone_name in (TOES, TOE_HEIGHT):
        rule = rules[zone_name]
        assert rule.poor is None  # a convention rejects no last
        far = np.array([[rule.target], [rule.acceptable[0] - 20.0]])
        assert levels(far, [rule], np.zeros((2, 1))).ravel().tolist() == [GOOD, REJECT - 1]
        reach = rule.target - rule.good[0]
        assert rule.good[0] - rule.acceptable[0] == pytest.approx(reach)


def test_every_sample_customer_has_a_last_with_a_good_toe_box(stocked: Path) -> None:
    with open_catalogue(stocked) as lasts:
        pair = lasts.match([str(FEET / "mh007_L.stl"), str(FEET / "mh007_R.stl")])
        single = lasts.match(str(FEET / "mh008_R.stl"))
    for answer in (pair, single):
        zones = [zone(fit, name) for fit in answer.candidates[0].fits for name in TOE_BOX]
        assert {each.verdict for each in zones} == {"good"}


def test_toes_that_are_held_up_are_judged_too(right: Profiled) -> None:
    """They were said to be open, because nothing of them lies lower than a toe box is high."""
    held_up = toe_box.plan_of_foot(reshaped(right, held_up_mm=25.0))
    level = toe_box.plan_of_foot(right)
    assert not isinstance(held_up, str)
    assert not isinstance(level, str)
    apart_mm = np.abs(held_up.edges_mm - level.edges_mm)
    assert apart_mm.max() < 12.0  # measured 7.4: its frame turns by a degree
