"""A process keeps its locks whatever else it does with the file.

POSIX drops all locks that a process has on a file when it closes any descriptor of that file.
"""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import pytest

from footfit.catalogue.file.file_signature import kind_of_file
from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueLocked
from footfit.pipeline.library.backup import back_up
from tests import records

OPEN_FILES = Path("/proc/self/fd")

TRY_TO_WRITE = """
import sqlite3, sys
connection = sqlite3.connect(sys.argv[1], timeout=0.0, isolation_level=None)
try:
    connection.execute("BEGIN IMMEDIATE")
except sqlite3.OperationalError as error:
    print(error.sqlite_errorname)
else:
    print("written")
"""


def another_process_writes(path) -> str:
    command = [sys.executable, "-c", TRY_TO_WRITE, str(path)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("last", 0))
    return path


def read_again(path):
    with open_catalogue(path) as catalogue:
        assert catalogue.names() == ("last",)


def open_to_write_again(path):
    with (
        pytest.raises(CatalogueLocked),
        open_catalogue(path, write=True, busy_timeout_s=0.0),
    ):
        pass


def back_up_beside(path):
    back_up(path, path.with_name("backup.footfit"))


def look(path):
    assert kind_of_file(path) == "catalogue"


def read_in_a_thread(path):
    thread = threading.Thread(target=read_again, args=(path,))
    thread.start()
    thread.join()


@pytest.mark.parametrize(
    "again",
    [look, read_again, read_in_a_thread, open_to_write_again, back_up_beside],
    ids=lambda f: f.__name__,
)
def test_a_second_opening_in_the_process_leaves_its_lock(path, again):
    with open_catalogue(path, write=True) as catalogue, catalogue.file.atomic():
        assert another_process_writes(path) == "SQLITE_BUSY"
        again(path)
        assert another_process_writes(path) == "SQLITE_BUSY"
    assert another_process_writes(path) == "written"


@pytest.mark.skipif(not OPEN_FILES.is_dir(), reason="only /proc lists a process's files")
def test_looking_again_and_again_holds_one_descriptor_until_the_catalogue_is_closed(path):
    def held() -> int:
        return sum(os.path.samestat(status, path.stat()) for status in open_files())

    with open_catalogue(path, write=True):
        before = held()
        for _ in range(20):
            read_again(path)
        assert held() == before + 1
    assert held() == 0


def open_files():
    for name in OPEN_FILES.iterdir():
        with suppress(OSError):
            yield os.fstat(int(name.name))


def test_a_flag_that_a_system_lacks_adds_nothing_to_how_a_file_is_opened():
    code = (
        "import os; [delattr(os, name) for name in ('O_NONBLOCK', 'O_CLOEXEC')];"
        "from footfit.catalogue.file import descriptors; print(descriptors._READING, os.O_RDONLY)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    used, reading = run.stdout.split()
    assert used == reading
