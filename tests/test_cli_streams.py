"""Standard streams as scripts have them: pipes, closed, on a full disk, and a mesh on stdin."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import corpus
from tests.conftest import ROOT, Footfit, Run

BASH = shutil.which("bash")
pytestmark = pytest.mark.skipif(BASH is None, reason="the redirections are those of bash")
FULL = pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
LIST = "footfit list-lasts --catalogue lasts.footfit"


@pytest.fixture
def shop(stocked: Path, foot: Path, tmp_path: Path) -> Path:
    """A folder with a catalogue and a foot."""
    shutil.copy(stocked, tmp_path / "lasts.footfit")
    shutil.copy(foot, tmp_path / "foot.stl")
    return tmp_path


def bash(script: str, folder: Path, **variables: str) -> Run:
    """What a script does in a shell where ``footfit`` is this version."""
    start = f'set -o pipefail; footfit() {{ "{sys.executable}" -m footfit "$@"; }}; '
    environment = {**os.environ, "HOME": str(folder), "PYTHONPATH": str(ROOT), **variables}
    done = subprocess.run(
        [str(BASH), "-c", start + script], cwd=folder, env=environment, capture_output=True
    )
    return Run(done.returncode, done.stdout.decode(), done.stderr.decode())


@pytest.mark.parametrize(
    "script",
    [
        "footfit -h | head -1",
        "footfit match -h | grep -q pair",
        "footfit --version | true",
        "footfit --show-completion bash | true",
        f"{LIST} | true",
        f"{LIST} --json | true",
    ],
)
def test_a_reader_that_goes_away_is_no_failure(script: str, shop: Path) -> None:
    run = bash(script, shop)
    assert (run.code, run.err) == (0, "")


@pytest.mark.parametrize("script", ["footfit -h", "footfit --version", LIST])
@pytest.mark.parametrize("stream", [">&-", pytest.param("> /dev/full", marks=FULL)])
def test_a_lost_answer_is_a_failure_of_one_line(script: str, stream: str, shop: Path) -> None:
    run = bash(f"{script} {stream}", shop)
    assert (run.code, run.out) == (2, "")
    (line,) = run.err.splitlines()
    assert "bug" not in line
    assert "stdout" in line
    as_json = bash(f"{LIST} --json {stream}", shop)
    assert json.loads(as_json.last_error)["exit"] == as_json.code == 2


def test_what_a_command_writes_is_written_though_its_answer_is_lost(shop: Path) -> None:
    run = bash("footfit measure foot.stl --quiet --csv foot.csv >&- 2>&-", shop)
    assert (run.code, run.out, run.err) == (2, "", "")
    assert "ball_girth" in (shop / "foot.csv").read_text()
    copied = bash("footfit backup-catalogue copy.footfit --catalogue lasts.footfit >&-", shop)
    assert copied.code == 2
    assert (shop / "copy.footfit").exists()


@pytest.mark.parametrize(
    ("stream", "code"), [("| true", 0), pytest.param("> /dev/full", 2, marks=FULL)]
)
@pytest.mark.parametrize(
    "command",
    [
        "measure foot.stl --csv answer.csv",
        "align foot.stl -o answer.stl",
        "compare foot.stl derby-40 --html answer.html --catalogue lasts.footfit",
        "list-lasts --csv answer.csv --catalogue lasts.footfit",
    ],
)
def test_files_are_written_though_nobody_reads_the_answer(
    command: str, stream: str, code: int, shop: Path
) -> None:
    run = bash(f"footfit {command} {stream}", shop)
    assert run.code == code, run.err
    assert [path.suffix for path in shop.glob("answer.*")] != []


def test_a_failure_is_not_hidden_by_a_reader_that_goes_away(shop: Path) -> None:
    run = bash("footfit measure none.stl foot.stl --csv answer.csv | true", shop)
    assert run.code == 3
    assert (shop / "answer.csv").exists()


@pytest.mark.parametrize(
    "command", ["show-last", "remove-last", "forget-fits", "export-last -o x.stl"]
)
def test_a_name_that_is_no_text_is_not_in_the_catalogue(command: str, shop: Path) -> None:
    run = bash(f"footfit {command} $'\\xff' --catalogue lasts.footfit", shop)
    assert run.code == 4, run.err
    assert len(run.err.splitlines()) == 1


@pytest.mark.parametrize("stream", ["2>&-", pytest.param("2> /dev/full", marks=FULL)])
def test_without_stderr_the_answer_and_the_code_are_the_same(stream: str, shop: Path) -> None:
    assert bash(f"{LIST} {stream}", shop).out == bash(LIST, shop).out
    assert bash(f"footfit measure none.stl {stream}", shop).code == 3
    assert bash(f"footfit measure none.stl >&- {stream}", shop).code == 3


@pytest.mark.parametrize("name", ["NO_COLOR", "FORCE_COLOR", "CI", "GITHUB_ACTIONS", "TERM"])
def test_no_colour_goes_into_a_pipe(name: str, shop: Path) -> None:
    run = bash(f"{LIST}; footfit measure none.stl", shop, **{name: "dumb"})
    assert "\x1b" not in run.out + run.err


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="there is no terminal to be had here")
@pytest.mark.parametrize("name", ["TERM", "NO_COLOR"])
def test_a_terminal_is_shown_whole_tables_and_colours_unless_it_has_none(
    name: str, shop: Path
) -> None:
    """A terminal of 20 columns wraps the lines; no column of the table is lost for it."""
    program = (
        "import fcntl, os, struct, sys, termios; from footfit.__main__ import main;"
        "near, far = os.openpty(); os.dup2(far, 1);"
        "fcntl.ioctl(1, termios.TIOCSWINSZ, struct.pack('HHHH', 30, 20, 0, 0));"
        "sys.stdout = open(1, 'w', closefd=False); sys.argv = ['footfit', *sys.argv[1:]]\n"
        "try: main()\n"
        "finally: os.write(2, os.read(near, 100_000))"
    )
    (shop / "shown.py").write_text(program)
    script = f'"{sys.executable}" shown.py list-lasts --catalogue lasts.footfit'
    coloured = bash(script, shop, TERM="xterm", NO_COLOR="")
    plain = bash(script, shop, **({"TERM": "xterm", "NO_COLOR": "1"} | {name: "dumb"}))
    assert (coloured.code, plain.code) == (0, 0), coloured.err
    assert "\x1b[" in coloured.err
    assert "\x1b" not in plain.err
    assert [line.rstrip() for line in plain.err.splitlines()] == bash(LIST, shop).out.splitlines()


def test_a_line_stays_one_line(footfit: Footfit, catalogue: Path) -> None:
    name = "[bold red]" + "very long " * 15
    run = footfit("rename-last", "derby-40", name.strip(), "--catalogue", catalogue)
    assert run.out.splitlines() == [f"renamed  derby-40 to {name.strip()}"]


def test_an_answer_is_utf_8_whatever_the_locale_is(shop: Path) -> None:
    (shop / "größe.stl").write_bytes((shop / "foot.stl").read_bytes())
    run = bash("footfit measure größe.stl", shop, PYTHONIOENCODING="ascii", LC_ALL="C.UTF-8")
    assert "größe.stl" in run.out
    assert "±" in run.out


@pytest.mark.parametrize("kind", ["stl", "obj", "ply", "off"])
def test_stdin_is_read_by_its_content(
    kind: str, footfit: Footfit, foot: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / f"foot.{kind}"
    assert footfit("align", foot, "-o", path).code == 0
    with path.open("rb") as stream:
        monkeypatch.setattr("sys.stdin", type("Stdin", (), {"buffer": stream}))
        document = footfit("align", "-", "--json").document
    assert document["mesh"]["path"] is None
    assert document["mesh"]["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (corpus.stl()[:-9], "add --format"),
        (b"dear last maker\n", "text without a mesh"),
        (b"PK\x03\x04", "ZIP"),
        (b"", "empty"),
    ],
)
def test_what_stdin_does_not_say_is_asked_for(data: bytes, words: str, shop: Path) -> None:
    (shop / "stdin").write_bytes(data)
    run = bash("footfit measure - < stdin", shop)
    assert (run.code, run.out) == (3, "")
    assert words in run.err


def test_a_closed_stdin_is_said(shop: Path) -> None:
    run = bash("footfit measure - <&-", shop)
    assert run.code == 3
    assert "standard input is closed" in run.err
