"""A pytest plugin: which test reaches which line; or the chosen tests, in the chosen order.

``FOOTFIT_MUTANTS_TIMES`` names a file for how long each test and each fixture took, and which
tests use which fixtures; each line of code is then recorded under the test or the fixture that
reached it. ``FOOTFIT_MUTANTS_PLAN`` names a file with the tests to run, and the seconds that each
may take; ``FOOTFIT_MUTANTS_LOG`` one that tells which test began last and which one failed.
"""

from __future__ import annotations

import faulthandler
import json
import os
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

TIMES, PLAN, LOG = "FOOTFIT_MUTANTS_TIMES", "FOOTFIT_MUTANTS_PLAN", "FOOTFIT_MUTANTS_LOG"
CONTEXT = "FOOTFIT_MUTANTS_CONTEXT"
"""Tells the processes that a test starts under which name their lines are recorded."""

FIXTURE = "fixture "
"""Begins the name of what a shared fixture reached; a test's name is its node's id."""


class Recorder:
    """Switches coverage to the test, or to the shared fixture, that is running."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.seconds: dict[str, float] = {}
        self.fixtures: dict[str, list[str]] = {}
        self.spent = 0.0  # in shared fixtures, since the test began

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """A test with its own fixtures."""
        began, self.spent = time.monotonic(), 0.0
        _switch(item.nodeid)
        result = yield
        self.seconds[item.nodeid] = time.monotonic() - began - self.spent
        return result

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[object]) -> Iterator[None]:
        """A fixture that several tests share counts for all of them."""
        if fixturedef.scope == "function":
            return (yield)
        name = f"{FIXTURE}{fixturedef.baseid}::{fixturedef.argname}"
        before, began = os.environ[CONTEXT], time.monotonic()
        _switch(name)
        result = yield
        self.seconds[name] = time.monotonic() - began
        self.spent += self.seconds[name]
        _switch(before)
        return result

    @pytest.hookimpl
    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        """Which shared fixtures a test asks for, itself or through others."""
        known = getattr(item, "_fixtureinfo", None)
        definitions = known.name2fixturedefs.values() if known is not None else ()
        self.fixtures[item.nodeid] = [
            f"{FIXTURE}{found.baseid}::{found.argname}"
            for several in definitions
            for found in several
            if found.scope != "function"
        ]

    @pytest.hookimpl
    def pytest_sessionfinish(self) -> None:
        """Keep the times."""
        times = {"seconds": self.seconds, "fixtures": self.fixtures}
        Path(self.path).write_text(json.dumps(times), encoding="utf-8")


class Runner:
    """Runs the tests of a plan in its order, and ends the process where one takes too long."""

    def __init__(self, plan: str, log: str) -> None:
        seconds: dict[str, float] = json.loads(Path(plan).read_text(encoding="utf-8"))
        self.seconds = seconds
        self.log = Path(log)

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Only the plan's tests, as it lists them."""
        known = {item.nodeid: item for item in items}
        items[:] = [known[name] for name in self.seconds if name in known]

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """One test, with its time."""
        self.note(began=item.nodeid)
        faulthandler.dump_traceback_later(self.seconds[item.nodeid], exit=True)
        result = yield
        faulthandler.cancel_dump_traceback_later()
        return result

    @pytest.hookimpl
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """What failed."""
        if report.failed:
            self.note(failed=report.nodeid)

    def note(self, **event: str) -> None:
        """Add an event to the log, at once: the process may end any moment."""
        with self.log.open("a", encoding="utf-8") as file:
            file.write(json.dumps(event) + "\n")


def _switch(name: str) -> None:
    import coverage

    os.environ[CONTEXT] = name
    measuring = coverage.Coverage.current()
    assert measuring is not None, "the tests are not being measured"
    measuring.switch_context(name)


def pytest_configure(config: pytest.Config) -> None:
    """Record, or run a plan, as the environment says."""
    if TIMES in os.environ:
        os.environ[CONTEXT] = ""
        config.pluginmanager.register(Recorder(os.environ[TIMES]), "mutants-recorder")
    if PLAN in os.environ:
        runner = Runner(os.environ[PLAN], os.environ[LOG])
        config.pluginmanager.register(runner, "mutants-runner")
