"""A coverage of a damaged catalogue: rows are the truth, and what is wrong is said."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from footfit.api.populations import coverage
from footfit.catalogue.blocks.block_bytes import PARTS
from footfit.errors import BadManifest
from footfit.results.population.coverage_answer import Coverage
from tests.people import sizes, write_csv


@pytest.fixture
def lasts(stocked: Path, tmp_path: Path) -> Path:
    copy = tmp_path / "lasts.footfit"
    copy.write_bytes(stocked.read_bytes())
    return copy


def answer(lasts: Path, *statements: str) -> Coverage:
    with closing(sqlite3.connect(lasts)) as connection, connection:
        for statement in statements:
            connection.execute(statement)
    return coverage(write_csv(lasts.with_name("feet.csv"), sizes(12)), lasts)


def codes(found: Coverage) -> list[str]:
    return [notice.code for notice in found.warnings if notice.code.startswith("damaged")]


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize(
    "harm", ["UPDATE search_block SET data = x'00'", "DELETE FROM search_block"]
)
def test_a_damaged_or_missing_block_changes_no_share_and_is_said(
    part: str, harm: str, lasts: Path
) -> None:
    sound = answer(lasts)
    found = answer(lasts, f"{harm} WHERE part = '{part}'")
    assert (codes(sound), codes(found)) == ([], ["damaged_blocks"])
    assert found.served == sound.served
    assert found.library == sound.library


def test_a_last_with_damaged_rows_is_left_out_and_named(lasts: Path) -> None:
    sound = answer(lasts)
    name = sound.library[0].last
    found = answer(
        lasts,
        "UPDATE measure SET value = value + 9 WHERE name = 'ball_girth' AND last_id ="
        f" (SELECT id FROM last WHERE name = {name!r})",
    )
    assert found.lasts == sound.lasts - 1
    assert name not in [last.last for last in found.library]
    said = [notice.message for notice in found.warnings if notice.code == "damaged_last"]
    assert len(said) == 1
    assert said[0].startswith(f"{name} was left out: it is damaged")


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("b,left,252,220,14,2", "more values than columns"),
        ("b,middle,252,220,92", "side is 'middle'"),
    ],
)
def test_a_row_that_is_not_understood_is_refused_with_its_line(
    row: str, words: str, lasts: Path, tmp_path: Path
) -> None:
    feet = tmp_path / "rows.csv"
    feet.write_text(
        f"id,side,length,ball_girth,ball_width\na,left,250,240,95\n{row}\n", encoding="utf-8"
    )
    with pytest.raises(BadManifest, match=words) as refused:
        coverage(feet, lasts)
    assert f"{feet} line 3" == refused.value.path
