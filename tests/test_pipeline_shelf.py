"""The search by columns answers as a search row by row does, and damage changes no answer."""

from __future__ import annotations

import json
import random
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfit
from benchmarks.big_catalogues import perturbed_lasts, ready_lasts
from footfit.catalogue.blocks import block_bytes, block_reading, block_writing
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue
from footfit.pipeline.fit import ranking, scoring
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.judging.judged_lasts import asked_of
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.fit.worn_shifts import worn_with
from footfit.pipeline.library.upgrade import upgrade
from footfit.pipeline.shelf import candidates, near_lasts
from footfit.pipeline.shelf.candidates import in_stock
from footfit.results import Library, Measured, Profiled, Worn
from tests import row_by_row
from tests.conftest import SAMPLES, Footfit

LASTS = 45
SEEDS = range(6)
EXACT = 1e-9


@pytest.fixture(scope="module", autouse=True, params=["blocks", "search file"])
def _small_blocks(request: pytest.FixtureRequest) -> Iterator[None]:
    """Blocks of 8 lasts, chunks of 2 blocks, and first looks of 2 lasts: every border is met.

    All tests are made twice: without a search file, and with one for every catalogue.
    """
    patch = pytest.MonkeyPatch()
    for module in (block_bytes, block_writing):
        patch.setattr(module, "BLOCK_LASTS", 8)
    patch.setattr(block_reading, "CHUNK_BLOCKS", 2)
    if request.param == "search file":
        patch.setattr(block_reading, "LEAST_LASTS", 1)
        patch.setattr(near_lasts, "PICKED", 3)
    patch.setattr(near_lasts, "FIRST_PICKED", 2)
    for name in ("FIRST_LAID", "FIRST_LOOK", "LAY_MORE", "LOOK_FURTHER"):
        patch.setattr(ranking, name, 2)
    patch.setattr(scoring, "TIER_LOOK", 1)
    yield
    patch.undo()


@pytest.fixture(scope="module")
def measured(stocked: Path) -> list[NewLast]:
    return ready_lasts(stocked)


@pytest.fixture(scope="module")
def feet() -> list[Profiled]:
    return [footfit.flare(path) for path in sorted((SAMPLES / "feet").glob("*.stl"))]


def choice(*asked):
    """The shelf of a second question: the first one made the search file, if there is to be one."""
    candidates.choice(*asked)
    return candidates.choice(*asked)


def varied(lasts: Iterator[NewLast], rng: np.random.Generator) -> Iterator[NewLast]:
    """Lasts as no generator makes them: gaps, other sides, high heels, other definitions."""
    for last in lasts:
        record, sections = last.record, last.sections
        measures = tuple(
            replace(row, measured=Measured(None, reason="a gap")) if rng.random() < 0.04 else row
            for row in record.measures
            if rng.random() > 0.03
        )
        if rng.random() < 0.08:
            measures = tuple(replace(row, definition=f"{row.name}/0") for row in measures)
        labels = record.labels
        if rng.random() < 0.3:
            labels = replace(labels, heel_height_mm=float(rng.choice([5.0, 45.0, 70.0, 115.0])))
        if rng.random() < 0.3:
            labels = replace(labels, style="derby", size="41", size_system="uk", width_label=None)
        side = "left" if rng.random() < 0.3 else "right"
        flare = record.flare
        if rng.random() < 0.1:
            flare = replace(flare, curvature={**flare.curvature, "plan": None})
        if rng.random() < 0.08:
            flare = replace(flare, definition=replace(flare.definition, version="flare/1"))
        if sections is not None and rng.random() < 0.1:
            sections = replace(sections, toes_outline_mm=None)
        record = replace(
            record,
            labels=labels,
            measures=measures,
            flare=flare,
            side=replace(record.side, side=side),
        )
        yield NewLast(record, None, None if rng.random() < 0.1 else sections)


def catalogue_of(path: Path, measured: list[NewLast], seed: int) -> Path:
    rng = np.random.default_rng(seed)
    with open_catalogue(path, write=True) as catalogue:
        lasts = varied(perturbed_lasts(measured, LASTS, seed), rng)
        assert len(list(catalogue.add_many(lasts))) == LASTS
        names = catalogue.names()
        catalogue.rename(names[5], "another name")
        catalogue.remove(names[9])
        catalogue.add(replace_content(catalogue.record(names[20])), replace=True)
        assert not [finding for finding in catalogue.findings() if finding.damage]
    return path


def replace_content(record):
    """The record of another scan of the same name."""
    return replace(record, info=replace(record.info, sha256="ab" * 32), extent_mm=200.0)


def library_of(path: Path, shelf) -> Library:
    """The same lasts as records, read from their rows."""
    return Library(
        shelf.with_records()[1],
        shelf.total,
        shelf.reference,
        shelf.rejected,
        shelf.warnings,
        path,
        rated=shelf.rated,
    )


QUESTIONS = (
    Question(),
    Question(top=40),
    Question(profile=fit_profile("dress"), worn=Worn(sock_mm=2.0, heel_lift_mm=8.0)),
    Question(profile=fit_profile("sandal"), heel=heel_question(as_scanned=True)),
    Question(profile=fit_profile("pump"), heel=heel_question(scanned_at_drop_mm=60.0), top=3),
)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_match_answers_as_row_by_row(
    seed: int, measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    path = catalogue_of(tmp_path / "lasts.footfit", measured, seed)
    customer = [feet[2]] if seed % 2 else feet[:2]
    style = ("derby", None, None)[seed % 3]
    shelf = choice(path, style, None)
    for question in QUESTIONS:
        profile = question.profile or fit_profile()
        worn = worn_with(profile, question.worn)
        asked = asked_of(customer, profile, "fit", question.heel, worn)
        chosen = own_side(shelf, customer)
        wanted = row_by_row.answer(asked, path, chosen, question.top)
        found = matched(customer, shelf, question)
        assert dict(found.rejected).items() >= wanted["rejected"].items()
        assert [c.last for c in found.nearest] == wanted.get("nearest", [])
        assert [c.last for c in found.candidates] == wanted.get("lasts", [])
        assert [c.verdict for c in found.candidates] == wanted.get("verdicts", [])
        assert [sorted(c.tied_with) for c in found.candidates] == [
            sorted(names) for names in wanted.get("tied", [])
        ]
        for candidate, distance, cells in zip(
            found.candidates, wanted.get("distances", []), wanted.get("cells", []), strict=True
        ):
            assert candidate.distance == pytest.approx(distance, abs=EXACT)
            zones = [zone for fit in candidate.fits for zone in fit.zones]
            for zone, cell in zip(zones, cells, strict=True):
                assert zone.clearance.reason == cell.reason
                if cell.reason is None:
                    assert zone.clearance.value == pytest.approx(cell.value, abs=EXACT)


def own_side(shelf, customer: list[Profiled]) -> list[str]:
    """The names of the lasts that the customer is compared with, one by one."""
    longer = max(customer, key=lambda foot: foot.length_or_extent_mm)
    side, records = longer.aligned.alignment.side.side, shelf.with_records()[1]

    def twins(one, other) -> bool:
        labels = [
            (r.labels.style, r.labels.size, r.labels.size_system, r.labels.width_label)
            for r in (one, other)
        ]
        named = None not in labels[0][:2]
        return named and labels[0] == labels[1] and abs(one.extent_mm - other.extent_mm) < 2.0

    return [
        record.labels.name
        for record in records
        if record.side.side == side
        or not any(other.side.side == side and twins(record, other) for other in records)
    ]


@pytest.mark.parametrize("seed", SEEDS)
def test_blocks_and_records_give_one_document(
    seed: int, measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    """All three searches, filters, stock, a pair: the same document, with its reasons and ties."""
    path = catalogue_of(tmp_path / "lasts.footfit", measured, 100 + seed)
    stock = tmp_path / "stock.csv"
    with open_catalogue(path) as catalogue:
        some = catalogue.names()[:: 1 + seed % 3]
    stock.write_text("\n".join(["last", *some, "no such last"]), encoding="utf-8")
    for style, system in ((None, None), ("derby", None), (None, "uk")):
        shelf = choice(path, style, system)
        library = library_of(path, shelf)
        for by in ("fit", "flare", "shape"):
            for customer in (feet[2:], feet[:2]):
                question = Question(by=by, top=4)
                assert documents(customer, shelf, question) == documents(
                    customer, library, question
                )
        shelf = in_stock(shelf, stock)
        names = set(shelf.names)
        library = replace(
            library_of(path, shelf),
            out_of_stock=tuple(r for r in library.lasts if r.labels.name not in names),
        )
        assert documents(feet[:1], shelf, Question()) == documents(feet[:1], library, Question())


def documents(customer: list[Profiled], lasts, question: Question) -> str:
    return json.dumps(matched(customer, lasts, question).to_dict(), sort_keys=True)


def harmed(path: Path, *statements: str) -> None:
    with closing(sqlite3.connect(path)) as connection, connection:
        for statement in statements:
            connection.execute(statement)


@pytest.mark.parametrize("by", ["fit", "flare", "shape"])
def test_a_damaged_last_is_not_shown_and_the_next_one_takes_its_place(
    by: str, measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    path = catalogue_of(tmp_path / "lasts.footfit", measured, 7)
    question = Question(by=by, top=3)
    sound = matched(feet[2:], choice(path, None, None), replace(question, top=5))
    names = [c.last for c in sound.candidates or sound.nearest]
    key = f"(SELECT id FROM last WHERE name = {names[0]!r})"
    harmed(path, f"UPDATE flare SET angle_deg = angle_deg + 1 WHERE last_id = {key}")
    found = matched(feet[2:], choice(path, None, None), question)
    shown = [c.last for c in found.candidates or found.nearest]
    assert shown == names[1:4]
    warnings = {notice.code: notice.message for notice in found.warnings}
    assert warnings["damaged_last"].startswith(f"{names[0]} was left out")


HARMS = (
    "UPDATE search_block SET data = zeroblob(length(data)) WHERE part = '{part}' AND block = 2",
    "UPDATE search_block SET hash = 'x' WHERE part = '{part}' AND block = 2",
    "UPDATE search_block SET layout = 'blocks/0' WHERE part = '{part}'",
    "DELETE FROM search_block WHERE part = '{part}' AND block = 3",
    "UPDATE search_block SET data = CAST('abc' AS TEXT) WHERE part = '{part}' AND block = 1",
    "UPDATE search_block SET block = block + 50 WHERE part = '{part}' AND block = 4",
)


@pytest.mark.parametrize("harm", HARMS)
@pytest.mark.parametrize("part", block_bytes.PARTS)
def test_a_damaged_block_changes_no_answer(
    harm: str, part: str, measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    path = SHARED.get("path") or catalogue_of(tmp_path / "lasts.footfit", measured, 8)
    SHARED["path"] = path
    copy = tmp_path / "copy.footfit"
    copy.write_bytes(path.read_bytes())
    harmed(copy, harm.format(part=part))
    for by in ("fit", "flare"):
        question = Question(by=by, top=4)
        sound, found = (matched(feet[2:], choice(p, None, None), question) for p in (path, copy))
        assert [c.to_dict() for c in found.candidates] == [c.to_dict() for c in sound.candidates]
        assert found.rejected == sound.rejected
    with open_catalogue(copy, write=True) as catalogue:
        assert "search_block" in [finding.code for finding in catalogue.findings()]
        assert catalogue.renew_blocks()
        assert not [finding for finding in catalogue.findings() if finding.damage]


SHARED: dict[str, Path] = {}


def test_blocks_with_the_hash_of_an_earlier_version_are_read_as_they_are(
    measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    path = catalogue_of(tmp_path / "lasts.footfit", measured, 10)
    sound = matched(feet[2:], choice(path, None, None), Question(top=4))
    with closing(sqlite3.connect(path)) as connection, connection:
        for key, data in connection.execute("SELECT rowid, data FROM search_block").fetchall():
            earlier = block_bytes.OTHER_HASH, block_bytes.checksum(data, block_bytes.OTHER_HASH)
            assert earlier[1] != block_bytes.checksum(data)
            change = "UPDATE search_block SET layout = ?, hash = ? WHERE rowid = ?"
            connection.execute(change, (*earlier, key))
    shelf = choice(path, None, None)
    assert not shelf.lasts.bad
    assert not len(shelf.lasts.from_rows)
    assert matched(feet[2:], shelf, Question(top=4)).to_dict() == sound.to_dict()
    with open_catalogue(path, write=True) as catalogue:
        assert "search_block" not in {finding.code for finding in catalogue.findings()}
        assert catalogue.renew_blocks() == 0
        catalogue.rename(catalogue.names()[0], "renamed")
    with closing(sqlite3.connect(path)) as connection:
        layouts = connection.execute("SELECT DISTINCT layout FROM search_block").fetchall()
    assert (block_bytes.LAYOUT,) in layouts
    assert not choice(path, None, None).lasts.bad


def test_a_catalogue_that_is_changed_meanwhile_is_read_again(
    measured: list[NewLast], feet: list[Profiled], tmp_path: Path
) -> None:
    path = catalogue_of(tmp_path / "lasts.footfit", measured, 9)
    shelf = choice(path, None, None)
    first = matched(feet[2:], shelf, Question(by="flare")).candidates[0].last
    with open_catalogue(path, write=True) as catalogue:
        if catalogue.reference().last == first:
            catalogue.set_reference(next(n for n in catalogue.names() if n != first))
        catalogue.remove(first)
    again = matched(feet[2:], shelf, Question(by="flare"))
    assert first not in [c.last for c in again.candidates]
    assert not [n for n in again.warnings if n.code in ("damaged_blocks", "damaged_last")]


@pytest.mark.parametrize("seed", range(3))
def test_blocks_do_not_depend_on_how_they_came_about(
    seed: int, measured: list[NewLast], tmp_path: Path
) -> None:
    """Added together or one by one, changed and changed back: the same bytes."""
    lasts = list(perturbed_lasts(measured, 30, seed))
    chance = random.Random(seed)
    paths = [tmp_path / f"{name}.footfit" for name in ("many", "single")]
    for path in paths:
        with open_catalogue(path, write=True) as catalogue:
            if path == paths[0]:
                list(catalogue.add_many(lasts))
                continue
            for last in lasts:
                catalogue.add(*last)
            for last in chance.sample(lasts, 5):
                catalogue.rename(last.record.labels.name, "x")
                catalogue.rename("x", last.record.labels.name)
    blocks = [blocks_of(path) for path in paths]
    assert blocks[0] == blocks[1]
    assert len(blocks[0]) == 4 * len(block_bytes.PARTS) + 30


def blocks_of(path: Path) -> list[tuple[object, ...]]:
    with closing(sqlite3.connect(path)) as connection:
        blocks = "SELECT * FROM search_block ORDER BY block, part"
        seals = "SELECT id, record_sha256 FROM last ORDER BY id"
        return connection.execute(blocks).fetchall() + connection.execute(seals).fetchall()


def test_an_upgrade_makes_wrong_blocks_anew_and_says_so(
    stocked: Path, tmp_path: Path, footfit: Footfit
) -> None:
    path = tmp_path / "lasts.footfit"
    path.write_bytes(stocked.read_bytes())
    with open_catalogue(path, write=True) as catalogue:
        catalogue.renew_blocks()  # of 8 lasts each
    harmed(path, "UPDATE search_block SET hash = 'x' WHERE part = 'plan' AND block = 0")
    shelf = choice(path, None, None)
    assert shelf.lasts.bad == frozenset()
    assert [notice.code for notice in upgrade(path).warnings] == ["blocks_renewed"]
    harmed(path, "UPDATE search_block SET hash = 'x' WHERE part = 'toes' AND block = 1")
    shown = footfit("upgrade-catalogue", "--catalogue", path)
    assert shown.err == f"{path}: 1 search block was made anew from the lasts' rows\n"
    assert upgrade(path).warnings == ()
    with open_catalogue(path) as catalogue:
        assert catalogue.findings() == []
