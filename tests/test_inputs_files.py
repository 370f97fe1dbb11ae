"""Bad files through the command line: the code, one line, nothing written or sent."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from footfit.results.values import MILLIMETRE_DIGITS
from tests import corpus, packed
from tests.bounds import printed
from tests.conftest import SAMPLES, Footfit

ROOT = Path(__file__).resolve().parents[1]
MOST_BYTES = 900_000_000
"""Of addresses: 600 MB of memory, and the code and BLAS buffers that are mapped and not used."""


@pytest.fixture(scope="module")
def bad_files(tmp_path_factory) -> dict[str, type]:
    """Every bad file and special path, with the error that it must end in."""
    folder = tmp_path_factory.mktemp("bad")
    wanted = {}
    for bad in corpus.BAD:
        (folder / bad.name).write_bytes(bad.make())
        wanted[str(folder / bad.name)] = bad.error
    special = tmp_path_factory.mktemp("special")
    for path, error in corpus.bad_paths(special):
        if "\0" not in str(path) and not path.is_dir():
            wanted[str(path)] = error
    return wanted


def guarded_run(
    log: Path, *arguments: object, more: Mapping[str, str] | None = None, before: Sequence[str] = ()
) -> tuple[subprocess.CompletedProcess[str], dict[str, list[str]]]:
    """The command line in a process that notes what it touches."""
    environment = {
        **os.environ,
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        **(more or {}),
    }
    words = [str(argument) for argument in arguments]
    command = [*before, sys.executable, "-m", "tests.guarded_run", str(log), *words]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment)
    return run, json.loads(log.read_text())


def own(path: str) -> bool:
    """A file of Python, of a library, of this project, or of the kernel: no user's."""
    homes = (
        sys.prefix,
        sys.base_prefix,
        str(ROOT),
        *filter(None, sys.path),  # where libraries are
        "/proc/",
        "/sys/",
        "/usr/",
        "/etc/",
        "/dev/null",
    )
    return path.startswith(homes) or path.endswith((".py", ".pyc", ".so", ".pth"))


def test_the_whole_corpus_in_one_run(bad_files, tmp_path):
    """Exit 3, a line each, within the memory; no socket, no other file, and no process except
    that in which rhino3dm reads.
    """
    (tmp_path / "home").mkdir()
    home = {"HOME": str(tmp_path / "home"), "GUARDED_BYTES": str(MOST_BYTES)}
    run, touched = guarded_run(tmp_path / "log", "align", *bad_files, "--json", more=home)
    assert run.returncode == 3, run.stderr
    answers = [json.loads(line) for line in run.stdout.splitlines()]
    assert {answer["path"]: answer["code"] for answer in answers} == {
        path: error.code for path, error in bad_files.items()
    }
    assert "memory" not in run.stdout
    assert "Traceback" not in run.stderr
    assert len(run.stderr.splitlines()) == len(bad_files)
    assert touched["sockets"] == touched["written"] == []
    assert set(touched["processes"]) == {"subprocess.Popen"}
    assert {path for path in touched["read"] if not own(path)} <= set(bad_files)
    assert not list((tmp_path / "home").iterdir())


def test_what_is_touched_is_seen(tmp_path, stocked):
    """The same guard sees a file written: it can fail."""
    foot = sorted((SAMPLES / "feet").iterdir())[0]
    table = tmp_path / "table.csv"
    run, touched = guarded_run(tmp_path / "log", "flare", foot, "--csv", table)
    assert run.returncode == 0, run.stderr
    assert any(str(tmp_path) in path for path in touched["written"])
    assert str(foot) in touched["read"]


@pytest.mark.skipif(shutil.which("strace") is None, reason="strace is not installed")
def test_no_system_call_reaches_for_a_network(bad_files, tmp_path):
    """Beneath Python as well: of the whole corpus and the odd files, on two processes."""
    odd = tmp_path / "odd"
    odd.mkdir()
    for name in ("with-picture.glb", "plain.3mf", "materials.obj"):
        (odd / name).write_bytes(corpus.ODD[name]())
    (odd / "entity.3mf").write_bytes(
        packed.threemf(packed.outside_entity("http://127.0.0.1:9/x.dtd"))
    )
    calls = tmp_path / "calls"
    trace = ["strace", "-f", "-qq", "--seccomp-bpf", "-e", "trace=%network", "-o", str(calls)]
    some = [path for path in bad_files if not path.endswith("bomb.3mf")]
    run, _ = guarded_run(tmp_path / "log", "align", odd, *some, "--jobs", 2, before=trace)
    assert run.returncode in (3, 5), run.stderr
    said = calls.read_text()
    for call in ("connect(", "sendto(", "sendmsg(", "AF_INET"):
        assert call not in said


@pytest.mark.parametrize("bad", corpus.BAD[::7], ids=str)
@pytest.mark.parametrize("command", ["flare", "match", "ingest-last", "curvature"])
def test_every_command_refuses_a_bad_file_in_one_line(footfit, stocked, tmp_path, bad, command):
    path = tmp_path / bad.name
    path.write_bytes(bad.make())
    before = stocked.read_bytes()
    more = ["--catalogue", stocked] if command in ("match", "ingest-last") else []
    run = footfit(command, path, *more, "--json")
    assert run.code == 3
    assert len(run.err.splitlines()) == 1
    assert json.loads(run.last_error)["code"] == bad.error.code
    assert list(tmp_path.iterdir()) == [path]
    assert stocked.read_bytes() == before


def test_a_stream_on_stdin_is_behind_the_same_guards(tmp_path):
    environment = {**os.environ, "HOME": str(tmp_path)}
    for data, format_, code in (
        (b"", "stl", "empty_mesh"),
        (corpus.stl()[:-9], "stl", "damaged_mesh"),
        (packed.glb(), "stl", "unknown_format"),
        (packed.threemf(packed.entity_bomb()), "3mf", "damaged_mesh"),
    ):
        command = [sys.executable, "-m", "footfit", "align", "-", "--format", format_, "--json"]
        run = subprocess.run(command, input=data, capture_output=True, cwd=ROOT, env=environment)
        assert run.returncode == 3
        assert json.loads(run.stderr.splitlines()[-1])["code"] == code
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not hasattr(os, "setresuid") or os.geteuid() != 0, reason="needs root to drop")
def test_a_file_that_may_not_be_read_is_refused(tmp_path):
    path = tmp_path / "secret.stl"
    path.write_bytes(corpus.stl())
    path.chmod(0)
    program = (
        "import os, sys\n"
        "from footfit.errors import UnreadableFile\n"
        "from tests.reading import read_scan\n"
        "os.chmod(os.path.dirname(sys.argv[1]), 0o755)\n"
        "os.setresuid(65534, 65534, 65534)\n"
        "try: read_scan(sys.argv[1])\n"
        "except UnreadableFile as error: print(error.code)\n"
    )
    command = [sys.executable, "-c", program, str(path)]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert run.stdout.strip() == "unreadable_file", run.stderr


def test_a_foot_as_glb_and_3mf_is_the_same_foot(footfit: Footfit, foot: Path, tmp_path: Path):
    from tests.reading import read_scan

    scan = read_scan(foot)
    glb, threemf = tmp_path / "foot.glb", tmp_path / "foot.3mf"
    tree = packed.tree(scan.vertices_mm, scan.faces)
    tree["accessors"][0]["componentType"] = 5123
    glb.write_bytes(
        packed.glb_of(json.dumps(tree).encode(), packed.body(scan.vertices_mm, scan.faces))
    )
    model = packed.model(scan.vertices_mm / 25.4, scan.faces, 'unit="inch"')
    threemf.write_bytes(packed.threemf(model))
    documents = [footfit("align", path, "--json").document for path in (foot, glb, threemf)]
    assert [document["mesh"]["units"] for document in documents] == ["mm", "m", "in"]
    assert len({document["side"] for document in documents}) == 1
    lengths = [document["length_mm"] for document in documents]
    assert lengths == pytest.approx([lengths[0]] * 3, abs=2 * printed(MILLIMETRE_DIGITS))
    assert len(footfit("align", tmp_path, "--json").lines) == 2  # a folder takes them too
