"""A batch: in order, whatever the number of processes; one failure stops nothing."""

from __future__ import annotations

import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from contextlib import suppress
from pathlib import Path

import pytest

from footfit.errors import DamagedMesh, NotAFoot, TooLarge, TooSlow, UnreadableFile
from footfit.pipeline.batch.runs import AHEAD_PER_JOB, HERE, outcomes
from footfit.pipeline.batch.sources import Source
from footfit.pipeline.batch.work_limits import WorkLimits
from footfit.pipeline.batch.workers import WorkerPool


def length_of_name(source: Source) -> int:
    assert source.path is not None
    if "bad" in source.path:
        raise DamagedMesh("is damaged")
    if "odd" in source.path:
        raise NotAFoot("is no foot", "named already")
    if "bug" in source.path:
        raise ValueError(source.path)
    return len(source.path)


ITEMS = [Source(name) for name in ("a", "bad", "ccc", "odd", "eeeee", "ffffff")]


@pytest.mark.parametrize("jobs", [HERE, 1, 2])
def test_order_values_and_errors_do_not_depend_on_the_jobs(jobs: int) -> None:
    found = list(outcomes(length_of_name, ITEMS, jobs))
    assert [outcome.item for outcome in found] == ITEMS
    assert [outcome.value for outcome in found] == [1, None, 3, None, 5, 6]
    assert [type(outcome.error) for outcome in found if outcome.error] == [DamagedMesh, NotAFoot]


def test_an_error_names_its_file_unless_it_named_one() -> None:
    errors = [outcome.error for outcome in outcomes(length_of_name, ITEMS) if outcome.error]
    assert [error.path for error in errors] == ["bad", "named already"]


def test_a_bug_is_raised_and_not_hidden_among_the_failures() -> None:
    with pytest.raises(ValueError, match="bug"):
        list(outcomes(length_of_name, [Source("a"), Source("bug")]))


def fate_of(source: Source) -> str:
    """Do to the worker what the name says."""
    fate = source.path or ""
    if fate == "hangs":
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})  # one long call hears nothing
    if fate in ("hangs", "slow"):
        for _ in range(600):
            time.sleep(0.1)
    if fate == "swallows":
        with suppress(BaseException):
            time.sleep(60)
        time.sleep(60)
    if fate == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if fate == "crashes":
        os.kill(os.getpid(), signal.SIGSEGV)
    if fate == "greedy":
        bytes(2_000_000_000)
    return fate


FATES = ["a", "slow", "b", "killed", "greedy", "c", "crashes", "hangs", "d"]
TIGHT = WorkLimits(seconds=2.0, grace_seconds=2.0, address_bytes=1_000_000_000)


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_worker_that_dies_or_hangs_costs_its_own_file_only(jobs: int) -> None:
    found = list(outcomes(fate_of, [Source(fate) for fate in FATES], jobs, TIGHT))
    assert [outcome.value for outcome in found if outcome.value] == ["a", "b", "c", "d"]
    errors = {outcome.item.path: outcome.error for outcome in found if outcome.error}
    assert {path: type(error) for path, error in errors.items()} == {
        "slow": TooSlow,
        "killed": TooLarge,
        "greedy": TooLarge,
        "crashes": UnreadableFile,
        "hangs": TooSlow,
    }
    assert all(error.path == path for path, error in errors.items())
    assert not multiprocessing.active_children()


def test_this_process_holds_to_time_and_memory_too() -> None:
    before = resource.getrlimit(resource.RLIMIT_AS), signal.getsignal(signal.SIGALRM)
    fates = [Source(fate) for fate in ("a", "slow", "greedy", "b")]
    found = list(outcomes(fate_of, fates, HERE, TIGHT))
    assert [type(outcome.error) for outcome in found] == [
        type(None),
        TooSlow,
        TooLarge,
        type(None),
    ]
    assert (resource.getrlimit(resource.RLIMIT_AS), signal.getsignal(signal.SIGALRM)) == before
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_work_that_swallows_the_end_of_its_time_is_told_again() -> None:
    (found,) = outcomes(fate_of, [Source("swallows")], HERE, TIGHT)
    assert isinstance(found.error, TooSlow)
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_a_single_item_is_done_in_this_process() -> None:
    (found,) = outcomes(own_process, [Source("a")], 2)
    assert found.value == os.getpid()


def own_process(source: Source) -> int:
    return os.getpid()


def test_a_bug_in_a_worker_is_raised_and_leaves_no_process() -> None:
    with pytest.raises(ValueError, match="bug"):
        list(outcomes(length_of_name, [Source("a"), Source("bug"), Source("c")], 2))
    assert not multiprocessing.active_children()


def test_any_executor_of_the_library_can_work() -> None:
    with ThreadPoolExecutor(2) as executor:
        found = list(outcomes(length_of_name, ITEMS, executor))
        assert executor.submit(len, "abc").result() == 3, "it is not shut down"
    assert [outcome.value for outcome in found] == [1, None, 3, None, 5, 6]


class Counting(Executor):
    """An executor that notes how many calls were in flight at most."""

    width = 3

    def __init__(self) -> None:
        self.flying, self.most = 0, 0

    def submit(self, fn, /, *args, **kwargs):
        self.flying += 1
        self.most = max(self.most, self.flying)
        outer, future = self, Future()

        def result(timeout: float | None = None) -> object:
            outer.flying -= 1
            return fn(*args, **kwargs)

        future.result = result
        return future


def test_few_items_are_in_flight_however_many_there_are() -> None:
    """The memory of the parent does not grow with the batch."""
    executor = Counting()
    items = [Source("x" * (1 + number % 7)) for number in range(1_000)]
    values = [outcome.value for outcome in outcomes(length_of_name, items, executor)]
    assert values == [1 + number % 7 for number in range(1_000)]
    assert executor.most == 3 * AHEAD_PER_JOB


def test_what_is_known_is_not_worked_on() -> None:
    known = {"a": 100}.get
    for jobs in (HERE, 2):
        found = outcomes(length_of_name, ITEMS, jobs, known=lambda item: known(item.path or ""))
        assert [outcome.value for outcome in found] == [100, None, 3, None, 5, 6]


def test_a_pool_is_an_executor() -> None:
    with WorkerPool(2) as pool:
        futures = [pool.submit(pow, base, 2) for base in range(9)]
        assert sorted(done.result() for done in as_completed(futures)) == [n * n for n in range(9)]
        with pytest.raises(Exception, match="pickle"):
            pool.submit(lambda: 1)
    assert not multiprocessing.active_children()
    with pytest.raises(RuntimeError, match="shut down"):
        pool.submit(pow, 2, 2)


def test_a_pool_that_is_ended_at_once_leaves_no_future_open() -> None:
    pool = WorkerPool(1)
    futures = [pool.submit(time.sleep, 60) for _ in range(3)]
    while not futures[0].running():
        time.sleep(0.01)
    pool.shutdown(cancel_futures=True)
    assert all(future.done() for future in futures)
    assert not multiprocessing.active_children()


ENDS_EARLY = """
import sys, time
from multiprocessing import util
from footfit.pipeline.batch.workers import WorkerPool

spawn, started = util.spawnv_passfds, []

def slow_spawn(*args):
    process = spawn(*args)
    started.append(process)
    if len(started) == 2:  # the first is Python's own; this one waits for what it is to do
        time.sleep(0.5)
    return process

if __name__ == "__main__":
    util.spawnv_passfds = slow_spawn
    pool = WorkerPool(2)
    answer = pool.submit(len, "abc")
    while len(started) < 2:
        time.sleep(0.01)
    sys.exit("the one line")
"""


def test_a_command_that_ends_while_its_workers_start_writes_one_line(tmp_path: Path) -> None:
    script = tmp_path / "ends_early.py"
    script.write_text(ENDS_EARLY, encoding="utf-8")
    run = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout, run.stderr) == (1, "", "the one line\n")
