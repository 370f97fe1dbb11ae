"""Several processes at once, and processes that are killed."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from footfit.catalogue.store import open_catalogue
from tests import records

ROOT = Path(__file__).resolve().parents[1]
LASTS_EACH = 6
PAGE = 4_096

FILL = """
import sys
from footfit.catalogue.store import open_catalogue
from footfit.errors import NameTaken
from tests import records
path, first, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
with open_catalogue(path, write=True) as catalogue:
    for seed in range(first, first + count):
        try:
            catalogue.add(records.last(f"last-{seed:03d}", seed), records.mesh_copy(seed, 50_000))
        except NameTaken:
            continue
        print(f"last-{seed:03d}", flush=True)
"""


def filling(path: Path, first: int, count: int) -> subprocess.Popen[str]:
    """A process that fills a catalogue and prints each name after its commit."""
    return subprocess.Popen(
        [sys.executable, "-c", FILL, str(path), str(first), str(count)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
    )


def test_the_same_lasts_from_two_processes_are_stored_once(tmp_path: Path) -> None:
    path = tmp_path / "lasts.footfit"
    writers = [filling(path, 0, LASTS_EACH) for _ in range(2)]
    names = [name for writer in writers for name in writer.communicate()[0].splitlines()]
    assert [writer.returncode for writer in writers] == [0, 0]
    assert sorted(names) == [f"last-{seed:03d}" for seed in range(LASTS_EACH)]


def content(path: Path) -> object:
    """All values of a catalogue."""
    with open_catalogue(path) as catalogue:
        copies = [catalogue.mesh_copy(name) for name in catalogue.names()]
        assert catalogue.findings() == []
        return records.plain((catalogue.lasts().records, catalogue.reference(), copies))


@pytest.mark.parametrize("torn", ["no page", "page 1", "every changed page"])
def test_a_reader_settles_what_a_power_cut_left(tmp_path: Path, torn: str) -> None:
    """A hot journal: pages are half written, and only the journal knows what they were."""
    path = tmp_path / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("kept", 1), records.mesh_copy(1, 40_000))
    truth, before = content(path), path.read_bytes()
    hot, journal = halfway_through_a_write(path)
    data = bytearray(hot.read_bytes())
    assert data != before
    changed = [at for at in range(0, len(before), PAGE) if data[at:][:PAGE] != before[at:][:PAGE]]
    assert changed
    for at in {"no page": [], "page 1": [0], "every changed page": changed}[torn]:
        data[at : at + 512] = bytes(512)  # the sector that was being written
    hot.write_bytes(data)
    assert content(hot) == truth
    assert not journal.exists()


def halfway_through_a_write(path: Path) -> tuple[Path, Path]:
    """Copies of a catalogue and its journal while pages of a transaction are in the file."""
    folder = path.parent / "halfway"
    folder.mkdir()
    writer = sqlite3.connect(path, isolation_level=None)
    writer.execute("PRAGMA cache_size = 1")  # so that pages are written before the commit
    writer.execute("BEGIN IMMEDIATE")
    writer.execute("UPDATE mesh_copy SET data = randomblob(400000)")
    writer.execute("UPDATE last SET name = 'lost'")
    for file in path.parent.glob(f"{path.name}*"):
        (folder / file.name).write_bytes(file.read_bytes())
    writer.close()
    return folder / path.name, folder / f"{path.name}-journal"
