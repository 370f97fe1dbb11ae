"""Faults injected into scripts of catalogue work; ``make torture`` runs ten times as many.

Each row asserts that the faults struck, so that trials that show nothing fail.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.torture import crowd, full, kills, power, signals, syscalls, upgrades
from tests.torture.scripts import EDIT, INGEST, MIGRATE, READY, Script
from tests.torture.tally import memory

SEED = 2


@pytest.fixture
def folder() -> Iterator[Path]:
    """A folder in memory where there is one: thousands of syncs are none of what is tested."""
    place = Path(tempfile.mkdtemp(prefix="footfit-", dir=memory()))
    yield place
    shutil.rmtree(place, ignore_errors=True)


needs_strace = pytest.mark.skipif(power.strace_missing() is not None, reason="strace is not here")


@pytest.mark.parametrize(
    ("script", "count"), [(INGEST, 25), (EDIT, 10), (MIGRATE, 15), (READY, 15)], ids=str
)
def test_kill_9_loses_nothing_acknowledged(folder: Path, script: Script, count: int) -> None:
    tally = kills.kill_trials(folder, script, count, SEED)
    assert tally.bad == []
    assert tally.struck == count


def test_kill_9_of_the_command_and_its_workers(folder: Path) -> None:
    tally = kills.command_trials(folder, 1, SEED, lasts=2)
    assert tally.bad == []
    assert tally.struck == 1


@needs_strace
@pytest.mark.parametrize(
    ("script", "count"), [(INGEST, 20), (EDIT, 20), (MIGRATE, 10), (READY, 20)], ids=str
)
def test_a_power_cut_leaves_before_or_after(folder: Path, script: Script, count: int) -> None:
    tally = power.cut_trials(folder, script, count, SEED)
    assert tally.bad == []
    assert tally.struck > count / 2  # else the cuts show little; measured: 20, 20 and 9


@needs_strace
def test_without_syncs_a_power_cut_is_seen_to_harm(folder: Path) -> None:
    """The trials above can fail: with synchronous OFF more than half of them do."""
    tally = power.cut_trials(folder, INGEST, 20, SEED, "OFF")
    assert len(tally.bad) > 10  # measured: 20


@needs_strace
@pytest.mark.parametrize(("script", "every"), [(INGEST, 90), (EDIT, 140), (READY, 90)], ids=str)
def test_a_failing_call_is_said_and_harms_nothing(folder: Path, script: Script, every: int) -> None:
    tally = syscalls.failing_trials(folder, script, every, SEED)
    assert tally.bad == []
    assert tally.struck == tally.trials > 8  # measured: 10 and 13


def test_writers_and_readers_at_once(folder: Path) -> None:
    tally = crowd.crowd_trials(folder, 8, 3, 4)
    assert tally.bad == []
    assert tally.facts["reads"]


def test_backups_under_a_writer(folder: Path) -> None:
    tally = crowd.backup_trials(folder, 5, SEED)
    assert tally.bad == []
    assert tally.trials == 5


def test_a_migration_that_fails_at_any_statement_changes_nothing(folder: Path) -> None:
    tally = upgrades.failing_upgrade_trials(folder, every=5)
    assert tally.bad == []
    assert tally.struck > 5  # measured: 10


@pytest.mark.parametrize("script", [INGEST, EDIT], ids=str)
def test_a_full_disk_is_said_and_more_room_completes(folder: Path, script: Script) -> None:
    if reason := full.tmpfs_missing():
        pytest.skip(reason)
    tally = full.full_disk_trials(folder, script, 3)
    assert tally.bad == []
    assert tally.struck


@pytest.mark.parametrize("script", [INGEST, MIGRATE], ids=str)
def test_a_limit_on_the_file_is_said_and_harms_nothing(folder: Path, script: Script) -> None:
    tally = full.file_limit_trials(folder, script, 3)
    assert tally.bad == []
    assert tally.struck


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_signal_ends_the_work_and_the_count_is_true(folder: Path, jobs: int) -> None:
    tally = signals.signal_trials(folder, 2, SEED, jobs, until_s=4.0)
    assert tally.bad == []
    assert tally.struck


def test_a_signal_ends_a_command_that_waits_for_a_lock(folder: Path) -> None:
    assert signals.lock_trial(folder).bad == []
