"""Many processes on one catalogue: writers that make and fill it, readers, backups meanwhile."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import FootfitError, NoCatalogue
from footfit.pipeline.library.backup import back_up
from tests import records
from tests.torture.kills import Child, forked
from tests.torture.scripts import MAIN, mesh_copy
from tests.torture.tally import Tally

PAUSE_S = 2e-5
"""After each last of the endless writer, for each last that is there: 20 ms at a thousand."""


def crowd_trials(folder: Path, writers: int, lasts: int, readers: int) -> Tally:
    """Every last of every writer is stored, nobody meets a lock error or half a last."""
    tally = Tally(f"{writers} writers, {readers} readers", trials=writers * lasts)
    folder.mkdir(exist_ok=True)
    path = folder / MAIN
    mesh_copy(0)
    writing = [_writer(path, first * lasts, lasts) for first in range(writers)]
    reading = [_reader(path) for _ in range(readers)]
    for number, (acknowledged, code) in enumerate(child.wait() for child in writing):
        tally.struck += acknowledged
        if (acknowledged, code) != (lasts, 0):
            tally.breach(f"writer {number}: exit {code} after {acknowledged} lasts")
    (folder / "done").touch()
    seen = [child.wait() for child in reading]
    tally.facts["reads"] = sum(reads for reads, _ in seen)
    for number, (_, code) in enumerate(seen):
        if code:
            tally.breach(f"reader {number}: exit {code}")
    with open_catalogue(path) as catalogue:
        if len(catalogue.names()) != writers * lasts:
            tally.breach(f"{len(catalogue.names())} lasts are there")
        tally.bad.extend(map(str, catalogue.findings()))
    return tally


def _writer(path: Path, first: int, count: int) -> Child:
    def work(acknowledge: Callable[[], None]) -> None:
        with open_catalogue(path, write=True) as catalogue:
            for seed in range(first, first + count):
                catalogue.add(records.last(f"last-{seed:04d}", seed), mesh_copy(0))
                acknowledge()

    return forked(work)


def _reader(path: Path) -> Child:
    """Exit 1 where it met half a last, fewer lasts than before, or an error."""

    def work(acknowledge: Callable[[], None]) -> int:
        seen = 0
        while not path.with_name("done").exists():
            try:
                with open_catalogue(path) as catalogue:
                    rows = catalogue.lasts()
            except NoCatalogue:
                if seen:
                    return 1
                continue
            whole = all(record.paper_transform is not None for record in rows.records)
            if rows.damaged or not whole or len(rows.records) < seen:
                return 1
            seen = len(rows.records)
            acknowledge()
        return 0

    return forked(work)


def backup_trials(folder: Path, count: int, seed: int) -> Tally:
    """Backups under a writer: each is sound and holds what was stored when it began."""
    tally = Tally("backup under a writer")
    folder.mkdir(exist_ok=True)
    path = folder / MAIN
    generator = random.Random(seed)
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("last-0000", 0), mesh_copy(0))
    writer = _endless_writer(path)
    try:
        for trial in range(count):
            before, backup = _names(path), folder / f"backup-{trial}"
            try:
                back_up(path, backup)
            except FootfitError as error:
                tally.breach(f"backup {trial}: {error!r}")
                continue
            held, after = _names(backup), _names(path)
            tally.trials += 1
            tally.struck += before != after
            if not before <= held <= after:
                tally.breach(f"backup {trial}: {len(before)} lasts before, {len(held)} in it")
            if generator.random() < 0.5:
                backup.unlink()
    finally:
        writer.kill()
        acknowledged, _ = writer.wait()
    tally.facts["lasts written meanwhile"] = acknowledged
    tally.bad.extend(f"{left.name} was left" for left in folder.glob(".*.partial"))
    return tally


def _endless_writer(path: Path) -> Child:
    """Adds lasts, the more there are the slower: a backup takes the longer the larger the catalogue
    is, and on a slow machine fifty of them would never catch up with a writer at full speed.
    """

    def work(acknowledge: Callable[[], None]) -> None:
        with open_catalogue(path, write=True) as catalogue:
            for seed in range(1, 100_000):
                catalogue.add(records.last(f"last-{seed:04d}", seed), mesh_copy(0))
                acknowledge()
                time.sleep(PAUSE_S * seed)

    return forked(work)


def _names(path: Path) -> set[str]:
    with open_catalogue(path) as catalogue:
        return set(catalogue.names())
