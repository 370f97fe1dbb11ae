"""Fixtures that many tests share: the command line in this process, a catalogue of sample lasts."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from tests.servers import PASSWORD, Server, started_server

settings.register_profile("here", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
"""CI draws the same examples every time; elsewhere each run of property tests draws new ones. No
example has a deadline: on a busy machine it would fail.
"""
settings.load_profile("ci" if os.environ.get("CI") else "here")

ROOT = Path(__file__).resolve().parents[1]
SAMPLES = ROOT / "sample_data"
SCANS = ROOT.parent / "shared" / "scans"


@dataclass(frozen=True)
class Run:
    """What one run of the command line did."""

    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[dict[str, Any]]:
        """stdout as JSON lines."""
        return [json.loads(line) for line in self.out.splitlines()]

    @property
    def document(self) -> dict[str, Any]:
        """stdout as one JSON document."""
        (line,) = self.lines
        return line

    @property
    def last_error(self) -> str:
        """The last line of stderr."""
        return self.err.strip().splitlines()[-1]


Footfit = Callable[..., Run]


@pytest.fixture
def footfit(
    capsysbinary: pytest.CaptureFixture[bytes],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path_factory: pytest.TempPathFactory,
) -> Footfit:
    """Run ``footfit ARGS`` in this process, with no catalogue of the user's in reach."""
    from footfit.cli.app import application
    from footfit.cli.boundary import run_guarded

    home = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("HOME", str(home))
    for name in ("FOOTFIT_CATALOGUE", "XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)

    def run(*arguments: object) -> Run:
        capsysbinary.readouterr()
        words = [str(argument) for argument in arguments]
        monkeypatch.setattr(sys, "argv", ["footfit", *words])
        code = run_guarded(application(), words)
        out, err = capsysbinary.readouterr()
        return Run(code, out.decode(), err.decode())

    return run


@pytest.fixture(scope="session")
def stocked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue of the sample lasts; read it, or copy it before writing."""
    from footfit.pipeline.batch.manifest import read_manifest
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.library.entries import entries
    from footfit.pipeline.library.ingest import ingest
    from footfit.results import LastLabels

    path = tmp_path_factory.mktemp("stocked") / "lasts.footfit"
    rows = read_manifest(SAMPLES / "lasts.csv")
    batch = entries([], rows, LastLabels(""), ReadingOptions())
    assert {outcome.status for outcome in ingest(batch, path)} == {"added"}
    return path


@pytest.fixture
def catalogue(stocked: Path, tmp_path: Path) -> Path:
    """A copy of the stocked catalogue, to write to."""
    return Path(shutil.copy(stocked, tmp_path / "lasts.footfit"))


@pytest.fixture(scope="session")
def server() -> Iterator[Server]:
    """A PostgreSQL server of the tests' own; libpq finds its password in the environment."""
    pytest.importorskip("psycopg", reason="psycopg is not installed: footfit[postgres]")
    with started_server() as started, pytest.MonkeyPatch.context() as patch:
        patch.setenv("PGPASSWORD", PASSWORD)
        yield started


@pytest.fixture(params=["file", "server"])
def location(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """Where a catalogue is to be: a file, then a database of a server."""
    if request.param == "file":
        return str(tmp_path / "lasts.footfit")
    return str(request.getfixturevalue("server").database())


@pytest.fixture(scope="session")
def foot() -> Path:
    """The first sample foot."""
    return sorted((SAMPLES / "feet").iterdir())[0]


@pytest.fixture(scope="session")
def scans() -> Path:
    """The folder of real scans beside the project."""
    if not SCANS.is_dir():
        pytest.skip("../shared/scans is not here; the sample feet are tested alone")
    return SCANS
