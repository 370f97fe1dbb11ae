"""Changed bytes: flips, torn sectors, zeroed pages, truncations."""

from __future__ import annotations

import random
import re
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from footfit.catalogue.file.engine import connect
from footfit.errors import ExitCode, FootfitError
from footfit.pipeline.library.check import check
from footfit.pipeline.shelf.candidates import choice
from tests import records
from tests.torture.scripts import MAIN, filling, values
from tests.torture.tally import Tally

PAGE, SECTOR = 4_096, 512
Harm = Callable[[bytearray, random.Random], None]


def flip(data: bytearray, generator: random.Random) -> None:
    """One bit."""
    bit = generator.randrange(8 * len(data))
    data[bit // 8] ^= 1 << (bit % 8)


def torn(data: bytearray, generator: random.Random) -> None:
    """A sector that was never written: another one's bytes are there."""
    old, new = (SECTOR * generator.randrange(len(data) // SECTOR) for _ in range(2))
    data[new : new + SECTOR] = data[old : old + SECTOR]


def zeroed(data: bytearray, generator: random.Random) -> None:
    """A page of zeros."""
    at = PAGE * generator.randrange(len(data) // PAGE)
    data[at : at + PAGE] = bytes(PAGE)


def cut_short(data: bytearray, generator: random.Random) -> None:
    """A file that ends early, half of the times between two pages."""
    length = generator.randrange(len(data))
    del data[length // PAGE * PAGE if length % 2 else length :]


HARMS: dict[str, Harm] = {
    "bit flips": flip,
    "torn sectors": torn,
    "zeroed pages": zeroed,
    "truncations": cut_short,
}


def damage_trials(folder: Path, harm: str, count: int, seed: int) -> Tally:
    """Every changed value is found (7), or the file refused (6); no damaged last is ranked."""
    tally = Tally(f"damage: {harm}")
    folder.mkdir(exist_ok=True)
    for _ in filling(folder, 0):
        pass
    sound = (folder / MAIN).read_bytes()
    truth, good = values(folder / MAIN), ranked(folder / MAIN)
    generator = random.Random(seed)
    codes = dict.fromkeys((0, 6, 7), 0)
    copy = folder / "copy"
    unseen = 0
    for trial in range(count):
        data = bytearray(sound)
        HARMS[harm](data, generator)
        copy.write_bytes(data)
        changed = _changed(copy, truth)
        tally.trials += 1
        tally.struck += changed
        unseen += changed and bytes(data) != sound and _sqlite_is_content(copy)
        try:
            code = _code(copy)
            codes[code] += 1
            if changed and code == 0:
                tally.breach(f"trial {trial}: a changed value is not found")
            for name, record in ranked(copy).items():
                if record != good.get(name):
                    tally.breach(f"trial {trial}: the damaged last {name!r} is ranked")
        except Exception as error:  # noqa: BLE001 - a bug is a breach as well
            tally.breach(f"trial {trial}: {error!r}")
    tally.facts |= {f"exit {code}": number for code, number in codes.items()}
    tally.facts["changed and missed by SQLite's own checks"] = unseen
    return tally


def _code(path: Path) -> int:
    """What ``check-catalogue`` answers."""
    try:
        return int(ExitCode.CHECK_FAILED) if check(path).findings else 0
    except FootfitError as error:
        # A file without a byte is none, and is said so.
        return 6 if error.exit == 4 and not path.stat().st_size else int(error.exit)


def ranked(path: Path) -> dict[str, object]:
    """The lasts that a match can show; none where it is refused."""
    try:
        shelf = choice(path, None, None)
        _, shown = shelf.with_records()
        return {record.labels.name: records.plain(record) for record in shown}
    except FootfitError:
        return {}


def _changed(path: Path, truth: list[object]) -> bool:
    """Is any value, or any object of the schema, not what it was?"""
    try:
        return values(path) != truth or _schema(path) != _schema(path.with_name(MAIN))
    except (sqlite3.Error, UnicodeDecodeError, OverflowError):
        return True


def _schema(path: Path) -> list[object]:
    """Every object and mark; how the words of the SQL are spaced is no value."""
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as connection:
        connection.text_factory = bytes
        rows = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_schema").fetchall()
        marks = [connection.execute(f"PRAGMA {mark}").fetchall() for mark in MARKS]
        spaced = [[re.sub(rb"\s+", b" ", word or b"") for word in row] for row in rows]
        return [*spaced, *marks]


MARKS = ("application_id", "user_version")


def _sqlite_is_content(path: Path) -> bool:
    """Do SQLite's own checks find nothing?"""
    try:
        with closing(connect(path, "ro")) as connection:
            ok = connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
            return ok and not connection.execute("PRAGMA foreign_key_check").fetchall()
    except (sqlite3.Error, UnicodeDecodeError):
        return False


def column_trials(folder: Path) -> Tally:
    """Every column of every table, set to another value of its kind, to null, to another type."""
    tally = Tally("damage: every column")
    folder.mkdir(exist_ok=True)
    for _ in filling(folder, 0):
        pass
    sound, copy = folder / MAIN, folder / "copy"
    with closing(sqlite3.connect(sound)) as connection:
        tables = [name for (name,) in connection.execute("SELECT name FROM sqlite_schema")]
        columns = [
            (table, row[1])
            for table in tables
            for row in connection.execute(f"PRAGMA table_info({table})")
        ]
    for table, column in columns:
        for change in CHANGES:
            copy.write_bytes(sound.read_bytes())
            if not _set(copy, table, column, change):
                continue
            tally.trials += 1
            tally.struck += 1
            if _code(copy) == 0:
                tally.breach(f"{table}.{column} {change}")
    return tally


CHANGES = (
    "CASE typeof({0}) WHEN 'text' THEN {0} || 'x' WHEN 'blob' THEN zeroblob(length({0}))"
    " ELSE {0} + 1000 END",
    "NULL",
    "CASE typeof({0}) WHEN 'text' THEN CAST({0} AS BLOB) ELSE CAST({0} AS TEXT) END",
)


def _set(path: Path, table: str, column: str, change: str) -> bool:
    """Change one value; False where the table's own rules, or its emptiness, do not let us."""
    value = change.format(column)
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA ignore_check_constraints = ON")
        where = f"rowid = (SELECT max(rowid) FROM {table} WHERE {column} IS NOT NULL)"
        same = f"typeof({value}) = typeof({column}) AND {value} IS {column}"
        try:
            done = connection.execute(
                f"UPDATE {table} SET {column} = {value} WHERE {where} AND NOT ({same})"
            )
        except sqlite3.IntegrityError:
            return False
        connection.commit()
        return done.rowcount > 0 and _really(path, path.with_name(MAIN))


def _really(path: Path, sound: Path) -> bool:
    """A column's affinity may turn the new value into the old one."""
    return values(path) != values(sound)
