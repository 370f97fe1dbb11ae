"""A cluster on 127.0.0.1: the same bytes as here, whatever dies; what cannot be used is said."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("distributed", reason="Dask is not installed: pip install 'footfit[cluster]'")

from footfit.errors import BadOption, ClusterUnusable
from footfit.pipeline.batch import cluster as clusters
from footfit.pipeline.batch.cluster import Cluster, answer_on_worker, require_same_version
from footfit.pipeline.batch.runs import outcomes
from footfit.pipeline.batch.sources import ReadingOptions, Source, mesh_sources
from footfit.pipeline.library.entries import entries
from footfit.pipeline.library.ingest import ingest
from footfit.pipeline.library.whole_copy import copy_catalogue
from footfit.results import LastLabels
from footfit.version import __version__
from tests.clusters import LocalCluster, failing, local_cluster, path_and_size
from tests.conftest import SAMPLES, Footfit

LASTS = [str(path) for path in sorted((SAMPLES / "lasts").glob("*.*"))[:4]]
PIPES: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
"""With ``bufsize=0``: a buffer would keep the lines that come with the first one."""
NOBODY = "tcp://127.0.0.1:9"
"""Nothing listens at this port: it is the one of a service that discards what it gets."""


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    with local_cluster(tmp_path_factory.mktemp("cluster")) as started:
        yield started


def test_a_worker_killed_in_the_middle_changes_no_byte(
    cluster: LocalCluster, tmp_path: Path
) -> None:
    batch = entries(mesh_sources(LASTS), [], LastLabels(""), ReadingOptions())
    here, there = tmp_path / "a" / "lasts", tmp_path / "b" / "lasts"
    here.parent.mkdir()
    there.parent.mkdir()
    expected = [outcome.to_dict() for outcome in ingest(batch, here)]
    answers = []
    with Cluster(cluster.address) as workers:
        victim, *_ = cluster.pids()
        for outcome in ingest(batch, there, jobs=workers):
            if not answers:
                os.kill(victim, signal.SIGKILL)
            answers.append(outcome.to_dict())
    for answer in (*expected, *answers):
        answer.pop("new_catalogue")  # it names the folder
    assert answers == expected
    # A file counts its commits, and lasts that are ready together share one: a copy has one.
    copies = [copied.with_name("copy") for copied in (here, there)]
    for catalogue, copy in zip((here, there), copies, strict=True):
        copy_catalogue(catalogue, copy)
    assert copies[0].read_bytes() == copies[1].read_bytes()
    assert victim not in cluster.pids()


def test_a_batch_on_the_cluster_is_the_batch_of_this_machine(
    cluster: LocalCluster, footfit: Footfit, tmp_path: Path, foot: Path
) -> None:
    (tmp_path / "bad.stl").write_bytes(b"no mesh")
    command = ("measure", foot, tmp_path / "bad.stl", tmp_path / "missing.stl", "--json")
    here = footfit(*command)
    there = footfit(*command, "--scheduler", cluster.address)
    assert (there.code, there.out, there.err) == (here.code, here.out, here.err)
    assert here.code == 3


def test_a_match_on_the_cluster_is_the_match_of_this_machine(
    cluster: LocalCluster, footfit: Footfit, catalogue: Path, foot: Path
) -> None:
    command = ("match", foot, "--catalogue", catalogue, "--json")
    assert footfit(*command, "--scheduler", cluster.address).out == footfit(*command).out


def test_ctrl_c_leaves_what_was_acknowledged(cluster: LocalCluster, tmp_path: Path) -> None:
    lasts = sorted(str(path) for path in (SAMPLES / "lasts").glob("*.*"))
    command = [sys.executable, "-m", "footfit", "ingest-last", *lasts, "--json"]
    path = tmp_path / "lasts.footfit"
    command += ["--catalogue", str(path), "--scheduler", cluster.address]
    heard = f"import signal, runpy; signal.signal({int(signal.SIGINT)}, signal.default_int_handler)"
    heard += "; runpy.run_module('footfit', run_name='__main__', alter_sys=True)"
    command[1:3] = ["-c", heard]  # a job in the background starts with SIGINT ignored
    running = subprocess.Popen(command, bufsize=0, **PIPES)
    assert running.stdout is not None
    first = running.stdout.readline()
    running.send_signal(signal.SIGINT)
    rest, errors = running.communicate(timeout=30)
    assert running.returncode == 130
    assert b"Traceback" not in errors, errors.decode()
    lines = [json.loads(line) for line in (first + rest).splitlines()]
    from footfit.catalogue.store import open_catalogue

    with open_catalogue(path) as catalogue:
        assert set(catalogue.names()) == {line["last"] for line in lines}
    assert len(lines) < len(lasts)


def test_the_bytes_of_a_file_travel(cluster: LocalCluster, tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"12345")
    with Cluster(cluster.address) as workers:
        (found,) = outcomes(path_and_size, [Source(str(tmp_path / "a"))], workers)
    assert found.value == f"{tmp_path / 'a'} 5"


def test_a_bug_on_a_worker_is_raised_here(cluster: LocalCluster, tmp_path: Path) -> None:
    (tmp_path / "bug").touch()
    source = Source(str(tmp_path / "bug"), b"")
    with Cluster(cluster.address) as workers, pytest.raises(ValueError, match="bug"):
        list(outcomes(failing, [source], workers))


def test_a_scheduler_that_goes_away_ends_the_batch_in_one_line(
    footfit: Footfit, tmp_path: Path
) -> None:
    path = tmp_path / "lasts.footfit"
    with local_cluster(tmp_path, workers=1) as cluster:
        command = [sys.executable, "-m", "footfit", "ingest-last", *LASTS, "--json"]
        command += ["--catalogue", str(path), "--scheduler", cluster.address]
        running = subprocess.Popen(command, bufsize=0, **PIPES)
        assert running.stdout is not None
        first = running.stdout.readline()
        cluster.processes[0].kill()
        rest, errors = running.communicate(timeout=30)
    assert running.returncode == 6
    error = json.loads(errors.splitlines()[-1])
    assert (error["code"], error["path"]) == ("cluster_unusable", cluster.address)
    assert b"Traceback" not in errors, errors.decode()
    stored = {json.loads(line)["last"] for line in (first + rest).splitlines()}
    listed = footfit("list-lasts", "--catalogue", path, "--json").document
    assert {last["last"] for last in listed["lasts"]} == stored


@pytest.mark.parametrize("address", ["localhost", "tcp://localhost", "http://a:1", "tcp://a:b"])
def test_an_address_that_is_none_is_refused(address: str) -> None:
    with pytest.raises(BadOption, match="tcp://HOST:PORT"):
        Cluster(address)


def test_a_scheduler_that_does_not_answer_is_code_6(footfit: Footfit, foot: Path) -> None:
    run = footfit("measure", foot, "--scheduler", NOBODY)
    assert (run.code, run.out, run.err.count("\n")) == (6, "", 1)
    assert NOBODY in run.err


def test_a_user_in_the_address_is_refused_and_not_shown(footfit: Footfit, foot: Path) -> None:
    run = footfit("measure", foot, "--scheduler", "tcp://ann:hush-hush@127.0.0.1:9")
    assert (run.code, run.err.count("\n")) == (2, 1)
    assert "hush" not in run.err
    assert "127.0.0.1:9" in run.err


def test_another_program_at_the_address_is_one_line_in_plain_words(foot: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:

        def hang_up() -> None:
            with suppress(OSError):
                while True:
                    other.accept()[0].close()

        threading.Thread(target=hang_up, daemon=True).start()
        address = f"tcp://127.0.0.1:{other.getsockname()[1]}"
        command = [sys.executable, "-m", "footfit", "measure", str(foot), "--scheduler", address]
        run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        other.shutdown(socket.SHUT_RDWR)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (6, "", 1)
    assert "is no Dask scheduler" in run.stderr


def test_tls_without_certificates_is_said(cluster: LocalCluster) -> None:
    with pytest.raises(ClusterUnusable, match="needs certificates"):
        Cluster(cluster.address.replace("tcp", "tls"))


def test_without_the_extra_a_line_says_how_to_install_it(
    footfit: Footfit, foot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.setattr(clusters, "_require_scheduler", lambda *_: None)
    run = footfit("measure", foot, "--scheduler", NOBODY)
    assert run.code == 2
    assert run.err.count("\n") == 1
    assert "pip install 'footfit[cluster]'" in run.err


def test_a_worker_of_another_version_is_refused(cluster: LocalCluster) -> None:
    require_same_version({"tcp://a:1": __version__})
    for version, words in (("0.0.1", "has footfit 0.0.1"), (None, "has no footfit")):
        with pytest.raises(ClusterUnusable, match=words) as refusal:
            require_same_version({"tcp://a:1": __version__, "tcp://b:2": version})
        assert refusal.value.path == "tcp://b:2"
    with cluster.client() as client:
        value, error = client.submit(answer_on_worker, "0.0.1", b"").result()
    assert value is None
    assert isinstance(error, ClusterUnusable)
    assert "the command 0.0.1" in error.message
