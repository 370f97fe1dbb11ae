"""Scripts of catalogue work whose state after every step is known.

A fault may strike anywhere in a script. What it leaves must be the state after the last step that
was acknowledged or after the next one, and the rest of the script must lead to the same end.
"""

from __future__ import annotations

import hashlib
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from unittest.mock import patch

from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.group_commit import GroupSettings, NewLast
from footfit.catalogue.store import open_catalogue
from footfit.errors import FootfitError, NoCatalogue, UnreadableFile
from footfit.meshes.copies.compact_copy import compact_copy
from footfit.pipeline.library import ingest
from footfit.pipeline.library.backup import back_up, restore
from footfit.pipeline.library.entries import Entry
from footfit.results import LastRecord, MeshCopy
from tests import answers, fits, records
from tests.ready_lasts import ReadyLasts, entry_of
from tests.torture.migrations import OLD_FILE, later_schema

MAIN = "lasts.footfit"
State = dict[str, str]
"""The content of every catalogue in a folder by file name, as a hash of its values."""
Work = Callable[[Path, int], Iterator[None]]
"""``work(folder, done)``: does every step after the first ``done``, yields after each commit."""


@dataclass(frozen=True)
class Script:
    """Work in steps, from what ``prepare`` lays into an empty folder."""

    name: str
    work: Work
    prepare: Callable[[Path], None] = Path.touch

    def __str__(self) -> str:
        return self.name.partition(",")[0]


@dataclass(frozen=True)
class Truth:
    """A script's states: ``states[k]`` after k steps of an undisturbed run."""

    script: Script
    states: tuple[State, ...]

    def steps_of(self, found: State, acknowledged: int) -> int | None:
        """How many steps a found state has behind it; None where it is neither before nor after.

        A step may lay a copy beside the catalogue before it changes it.
        """
        before = self.states[acknowledged]
        if found == before:
            return acknowledged
        if acknowledged + 1 == len(self.states):
            return None
        after = self.states[acknowledged + 1]
        if found == after:
            return acknowledged + 1
        mixed = all(
            found.get(name) in (before.get(name), after.get(name))
            for name in before.keys() | after.keys() | found.keys()
        )
        return acknowledged if mixed and found.get(MAIN) == before.get(MAIN) else None


def truth(script: Script, folder: Path) -> Truth:
    """Run a script undisturbed."""
    folder.mkdir()
    script.prepare(folder)
    first = observed(folder)
    return Truth(script, (first, *(observed(folder) for _ in script.work(folder, 0))))


def finished(script: Script, folder: Path, done: int) -> State:
    """Run what is left of a script; the state at its end."""
    for _ in script.work(folder, done):
        pass
    return observed(folder)


def observed(folder: Path) -> State:
    """Every catalogue's content; a damaged one, or one with findings, says so instead."""
    found = {}
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or path.name.endswith(("-journal", ".partial")):
            continue
        with suppress(NoCatalogue):  # an empty file is none
            found[path.name] = content(path)
    return found


def content(path: Path, schema: Schema | None = None) -> str:
    """A hash of every value of a sound catalogue; its findings where it is not sound."""
    schema = schema or later_schema()
    with open_catalogue(path, older=True, schema=schema) as catalogue:
        damage = [str(finding) for finding in catalogue.findings() if finding.damage]
        if damage:
            return "; ".join(damage)
    return hashlib.sha256(repr(values(path)).encode()).hexdigest()


def values(path: Path) -> list[object]:
    """Every row of every table; the schema is for ``findings`` to judge."""
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as connection:
        connection.text_factory = bytes
        tables = [
            name.decode()
            for (name,) in connection.execute("SELECT name FROM sqlite_schema WHERE type = 'table'")
        ]
        return [
            (name, connection.execute(f"SELECT * FROM {name} ORDER BY rowid").fetchall())
            for name in sorted(tables)
        ]


@lru_cache(maxsize=4)
def mesh_copy(seed: int) -> MeshCopy:
    """A real mesh's copy, about 15 kB."""
    return compact_copy(*answers.tube(260.0 + seed, rings=40, sides=24))


# ------------------------------------------------------------------ the scripts


def filling(folder: Path, done: int, count: int = 6) -> Iterator[None]:
    """Make a catalogue and add lasts to it, all in one opening: an ingest."""
    with open_catalogue(folder / MAIN, write=True) as catalogue:
        if not done:
            yield  # a catalogue without a last
        for seed in range(max(done - 1, 0), count):
            catalogue.add(records.last(f"last-{seed}", seed), mesh_copy(seed % 2))
            yield


GROUP_LASTS = 5


def grouping(folder: Path, done: int, groups: int = 5) -> Iterator[None]:
    """Add lasts in groups, each in one commit, all in one opening: a batch."""
    with open_catalogue(folder / MAIN, write=True) as catalogue:
        for group in range(done, groups):
            seeds = range(100 + GROUP_LASTS * group, 100 + GROUP_LASTS * (group + 1))
            lasts = [NewLast(records.last(f"last-{s}", s), mesh_copy(s % 2)) for s in seeds]
            assert len(list(catalogue.add_many(lasts))) == GROUP_LASTS
            yield


def ingesting(folder: Path, done: int, count: int = 16) -> Iterator[None]:
    """An ingest whose lasts are ready at once, so that three share a commit; each line is a step.

    Among them are a bad file, a name that is taken in its own group, and a last that is stored.
    """
    lasts = [records.last(f"last-{seed}", seed) for seed in range(100, 100 + count)]
    files: list[tuple[Entry, LastRecord | FootfitError]] = [
        (entry_of(last, seed), last) for seed, last in enumerate(lasts, 100)
    ]
    files[4:4] = [
        (entry_of(records.last("bad", 90), 90), UnreadableFile("is no mesh")),
        (entry_of(records.last("last-103", 91), 91), records.last("last-103", 91)),
        (entry_of(records.last("last-0", 0), 0), records.last("last-0", 0)),
    ]
    batch = [entry for entry, _ in files]
    with patch.object(ingest, "GROUP", GroupSettings(most_lasts=3, longest_s=60.0)):
        outcomes = ingest.ingest(batch, folder / MAIN, jobs=ReadyLasts(files))
        for line, _outcome in enumerate(outcomes, 1):
            if line > done:
                yield


def editing(folder: Path, done: int) -> Iterator[None]:
    """Every writing verb once, each in an opening of its own: the commands."""
    for step in EDITS[done:]:
        step(folder)
        yield


def _edit(change: Callable[..., object], *arguments: object) -> Callable[[Path], None]:
    def step(folder: Path) -> None:
        with open_catalogue(folder / MAIN, write=True, create=False) as catalogue:
            change(catalogue, *arguments)

    return step


EDITS: tuple[Callable[[Path], None], ...] = (
    _edit(lambda c: c.set_reference("last-3")),
    _edit(lambda c: c.rename("last-1", "renamed")),
    _edit(lambda c: c.remove("last-2")),
    _edit(lambda c: c.add(records.last("last-4", 40), mesh_copy(1), replace=True)),
    _edit(
        lambda c: c.update_measured(
            replace(c.record("last-5"), flare=records.profile(50), upgraded_from="flare/0")
        )
    ),
    _edit(lambda c: c.add(records.last("graded", 41, parent="last-0"), mesh_copy(0))),
    lambda folder: _back_up(folder, "backup.footfit"),
    _edit(lambda c: c.remove("graded")),
    lambda folder: _restore(folder, "backup.footfit"),
    _edit(lambda c: c.set_reference("last-5")),
    _edit(lambda c: c.edit("last-0", _relabelled)),
)


def _relabelled(record: LastRecord, _: object) -> tuple[LastRecord, None]:
    """Another heel height with another stance, as an edit makes them."""
    other = records.last("last-0", 60)
    labels = replace(record.labels, heel_height_mm=40.0, style="edited")
    return replace(record, labels=labels, flare=other.flare, measures=other.measures), None


def _back_up(folder: Path, name: str) -> None:
    back_up(folder / MAIN, folder / name, replace=True)


def _restore(folder: Path, name: str) -> None:
    """A restore that is done again after a fault keeps what it kept under one name only."""
    for kept in folder.glob(f"{MAIN}.before-restore*"):
        kept.unlink()
    restore(folder / MAIN, folder / name)


def _filled(folder: Path) -> None:
    for _ in filling(folder, 0):
        pass


def migrating(folder: Path, done: int) -> Iterator[None]:
    """A stored file of the first schema, brought up by three migrations, then written to."""
    schema = later_schema()
    if done < 1:
        with open_catalogue(folder / MAIN, write=True, schema=schema):
            pass
        yield
    if done < 2:
        with open_catalogue(folder / MAIN, write=True, schema=schema) as catalogue:
            catalogue.rename("last-1", "after")
        yield


def recording(folder: Path, done: int) -> Iterator[None]:
    """Entries of the fit log, each in an opening of its own, and two that are forgotten."""
    for step in RECORDS[done:]:
        step(folder)
        yield


RECORDS: tuple[Callable[[Path], None], ...] = (
    *(_edit(lambda c, entry: c.fit_log.add(entry), fits.entry(n)) for n in range(6)),
    _edit(lambda c: c.fit_log.forget("W2")),
    _edit(lambda c: c.fit_log.forget(fits.entry(4).id)),
)


def _old_file(folder: Path) -> None:
    shutil.copy(OLD_FILE, folder / MAIN)


INGEST = Script("ingest", filling)
EDIT = Script("edit, backup, restore", editing, _filled)
MIGRATE = Script("migrate", migrating, _old_file)
RECORD = Script("record fits", recording, _filled)
GROUP = Script("group commit", grouping, _filled)
READY = Script("ingest in groups", ingesting, _filled)
ALL = (INGEST, EDIT, MIGRATE, RECORD, GROUP, READY)
SCRIPTS = {script.name.split(",")[0]: script for script in ALL}
