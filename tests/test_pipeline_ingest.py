"""Ingest without meshes: which labels a file gets, what becomes of names and contents, commits."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, CatalogueLocked, EmptyMesh, FootfitError, NameTaken
from footfit.locations import location_of
from footfit.pipeline.batch.manifest import manifest_rows
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.entries import Entry, entries, unused_rows
from footfit.pipeline.library.holdings import Holdings
from footfit.pipeline.library.ingest import ingest
from footfit.results import LastLabels, LastRecord
from tests.ready_lasts import ReadyLasts, entry_of
from tests.records import last
from tests.torture.scripts import content

NOTHING = LastLabels("")
PLAIN = ReadingOptions()


def entry(name: str = "oxford-42", **labels: object) -> Entry:
    record = last(name)
    given = replace(record.labels, **labels)
    return Entry(Source(f"{name}.stl"), given, PLAIN)


STORED = last("oxford-42", seed=1)
HOLDINGS = Holdings([STORED])


def status(sha256: str, name: str, replace_it: bool = False, **labels: object) -> str:
    wanted = replace(STORED.labels, name=name, **labels)
    return HOLDINGS.status(sha256, Entry(Source("x.stl"), wanted, PLAIN), replace=replace_it)


def test_what_becomes_of_a_file() -> None:
    same, other = STORED.info.sha256, "0" * 64
    assert status(other, "new") == "added"
    assert status(same, "oxford-42") == "unchanged"
    assert status(same, "oxford-42", True) == "unchanged"
    assert status(other, "oxford-42", True) == "replaced"
    assert status(same, "oxford-42", True, style="boot") == "replaced"
    for wrong in ((other, "oxford-42", {}), (same, "oxford-42", {"style": "boot"})):
        with pytest.raises(NameTaken, match="--replace"):
            status(wrong[0], wrong[1], **wrong[2])
    for replace_it in (False, True):
        with pytest.raises(NameTaken, match="oxford-42"):
            status(same, "new", replace_it)


def test_a_side_or_unit_that_contradicts_the_stored_one_is_another_reading() -> None:
    one = Entry(Source("x.stl"), STORED.labels, ReadingOptions(side="left"))
    with pytest.raises(NameTaken, match="read otherwise"):
        HOLDINGS.status(STORED.info.sha256, one, replace=False)


def test_labels_come_from_the_manifest_then_the_command_line_then_the_stem() -> None:
    rows = manifest_rows("path,name,style,side\na.stl,one,,left\n", Path(), "m.csv")
    given = LastLabels("", style="derby", size="42")
    first, second = entries([Source("b.stl"), Source("a.stl")], rows, given, PLAIN)
    assert (first.labels.name, first.labels.style, first.reading.side) == ("one", "derby", "left")
    assert (second.labels.name, second.labels.size, second.reading.side) == ("b", "42", "auto")


def test_a_manifest_alone_names_its_files_in_sorted_order() -> None:
    rows = manifest_rows("path\nb.stl\na.stl\n", Path("shop"), "m.csv")
    batch = entries([], rows, NOTHING, PLAIN)
    assert [one.source.path for one in batch] == [str(Path("shop") / n) for n in ("a.stl", "b.stl")]


def test_rows_of_other_files_are_said_and_stop_nothing() -> None:
    rows = manifest_rows("path,style\na.stl,derby\nc.stl,\n", Path(), "m.csv")
    batch = entries([Source("a.stl")], rows, NOTHING, PLAIN)
    assert [one.labels.style for one in batch] == ["derby"]
    (notice,) = unused_rows(batch, rows)
    assert "c.stl" in notice.message
    assert "no labels" not in notice.message
    assert unused_rows(batch, rows[:1]) == ()


def test_a_manifest_whose_paths_miss_every_file_is_said() -> None:
    rows = manifest_rows("path,style\nlasts/a.stl,derby\n", Path("lasts"), "m.csv")
    (notice,) = unused_rows(entries([Source("lasts/a.stl")], rows, NOTHING, PLAIN), rows)
    assert "no labels" in notice.message


def test_a_known_length_is_another_reading_unless_it_is_the_stored_one() -> None:
    sha, labels = STORED.info.sha256, STORED.labels
    known_mm = {STORED.length_mm: "unchanged", STORED.length_mm + 1: "replaced"}
    scaled_by_its_extent = {STORED.extent_mm: "unchanged"}  # as older versions did
    for known, expected in (known_mm | scaled_by_its_extent).items():
        one = Entry(Source("x.stl"), labels, ReadingOptions(known_length_mm=known))
        assert HOLDINGS.status(sha, one, replace=True) == expected


def test_what_cannot_be_meant_is_refused() -> None:
    two = [Source("a.stl"), Source("b.stl")]
    with pytest.raises(BadOption, match="--name"):
        entries(two, [], LastLabels("one"), PLAIN)
    with pytest.raises(BadOption, match="--name"):
        entries([Source(None, b"x", "stl")], [], NOTHING, PLAIN)
    with pytest.raises(BadOption, match="nothing to ingest"):
        entries([], [], NOTHING, PLAIN)


# ------------------------------------------------------------------ lasts that are ready together


def files(*lasts: tuple[str, int] | FootfitError) -> list[tuple[Entry, LastRecord | FootfitError]]:
    """Files with the lasts that they hold, each by name and seed, or with what is wrong."""
    made: list[tuple[Entry, LastRecord | FootfitError]] = []
    for number, each in enumerate(lasts):
        if isinstance(each, FootfitError):
            made.append((entry_of(last(f"bad-{number}", 900 + number), 900 + number), each))
        else:
            made.append((entry_of(last(*each), each[1]), last(*each)))
    return made


def ingested(
    place: Path | str, *lasts: tuple[str, int] | FootfitError, **options: Any
) -> list[tuple[str | None, str, str | None]]:
    """What an ingest says of files whose lasts are ready at once: name or path, status, failure."""
    answers = files(*lasts)
    batch, location = [entry for entry, _ in answers], location_of(place)
    outcomes = ingest(batch, location, jobs=ReadyLasts(answers), **options)
    return [
        (done.last or done.path, done.status, None if done.failure is None else str(done.failure))
        for done in outcomes
    ]


@pytest.fixture
def commits(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many lasts each commit held that several lasts share; 0 for one that failed."""
    made: list[int] = []
    together = Catalogue.add_together

    def counted(self: Catalogue, group: Any, *others: Any, **options: Any) -> bool:
        stored = together(self, group, *others, **options)
        made.append(len(group) if stored else 0)
        return stored

    monkeypatch.setattr(Catalogue, "add_together", counted)
    return made


def test_lasts_that_are_ready_together_share_a_commit(tmp_path: Path, commits: list[int]) -> None:
    lasts = [(f"last-{seed}", seed) for seed in range(7)]
    said = ingested(tmp_path / "many", *lasts)
    assert said == [(name, "added", None) for name, _ in lasts]
    assert commits == [7]
    for each in lasts:
        ingested(tmp_path / "single", each)
    assert commits == [7, *[1] * 7]
    assert content(tmp_path / "many") == content(tmp_path / "single")
    assert {status for _, status, _ in ingested(tmp_path / "many", *lasts)} == {"unchanged"}
    assert len(commits) == 8


def test_what_is_refused_takes_no_other_last_with_it(location: str, commits: list[int]) -> None:
    """A bad file, a name and a scan that come twice in one group, and two that are stored."""
    ingested(location, ("a", 1), ("b", 2))
    said = ingested(
        location, ("c", 3), EmptyMesh("is empty"), ("C", 4), ("d", 3), ("a", 5), ("e", 6)
    )
    assert [status for _, status, _ in said] == ["added", *["refused"] * 4, "added"]
    assert "is empty" in str(said[1][2])
    assert "'c', a name that differs only in case" in str(said[2][2])
    assert "the same mesh is in the catalogue as 'c'" in str(said[3][2])
    assert "'a' is in the catalogue with another scan" in str(said[4][2])
    assert commits == [2, 2]


def test_a_name_that_cannot_be_stored_is_refused_alone(location: str, commits: list[int]) -> None:
    said = ingested(location, ("a", 1), ("b\udcff", 2), ("c", 3))
    assert [status for _, status, _ in said] == ["added", "refused", "added"]
    assert "cannot be stored as a name" in str(said[1][2])
    assert commits == [0]
    with open_catalogue(location) as catalogue:
        assert catalogue.names() == ("a", "c")
        assert catalogue.findings() == []


def test_lasts_that_another_program_stores_meanwhile(location: str, commits: list[int]) -> None:
    """The same last is unchanged, another one of its name is refused, and the others are stored."""
    ingested(location, ("a", 1))
    meanwhile = [last("b", 2), last("c", 30)]

    @contextmanager
    def held() -> Iterator[None]:
        with open_catalogue(location, write=True) as other:
            while meanwhile:
                other.add(meanwhile.pop())
        yield

    said = ingested(location, ("b", 2), ("c", 3), ("d", 4), hold_signals=held)
    assert [status for _, status, _ in said] == ["unchanged", "refused", "added"]
    assert "'c' is in the catalogue" in str(said[1][2])
    assert commits == [1, 0]


def test_replaced_lasts_share_a_commit_too(tmp_path: Path, commits: list[int]) -> None:
    lasts = [(f"last-{seed}", seed) for seed in range(4)]
    others = [(name, seed + 10) for name, seed in lasts]
    ingested(tmp_path / "many", *lasts)
    said = ingested(tmp_path / "many", *others, ("new", 50), replace=True)
    assert [status for _, status, _ in said] == [*["replaced"] * 4, "added"]
    assert commits == [4, 5]
    ingested(tmp_path / "single", *lasts)
    for each in (*others, ("new", 50)):
        ingested(tmp_path / "single", each, replace=True)
    assert content(tmp_path / "many") == content(tmp_path / "single")


def test_a_dry_run_of_a_group_stores_nothing(tmp_path: Path, commits: list[int]) -> None:
    said = ingested(tmp_path / "lasts", ("a", 1), ("A", 2), dry_run=True)
    assert [status for _, status, _ in said] == ["added", "refused"]
    assert not (tmp_path / "lasts").exists()
    assert commits == []


def test_a_locked_catalogue_ends_the_batch_and_stores_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "lasts"
    ingested(path, ("a", 1))
    before = path.read_bytes()
    briefly = partial(open_catalogue, busy_timeout_s=0.1)
    monkeypatch.setattr("footfit.pipeline.library.ingest.open_catalogue", briefly)
    holder = sqlite3.connect(path, isolation_level=None)

    @contextmanager
    def held() -> Iterator[None]:
        holder.execute("BEGIN IMMEDIATE")
        yield

    with closing(holder), pytest.raises(CatalogueLocked):
        ingested(path, ("b", 2), ("c", 3), hold_signals=held)
    assert path.read_bytes() == before
