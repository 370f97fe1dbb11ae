"""The main commands where everything is missing that only POSIX has, and stdout is cp1252."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT, SAMPLES, Run

pytestmark = pytest.mark.skipif(
    not Path("/proc/self/fd").is_dir(), reason="open files are seen in /proc"
)
FEET = [str(path) for path in sorted((SAMPLES / "feet").glob("mh007_*.stl"))]
LASTS = [SAMPLES / "lasts" / f"{name}.stl" for name in ("derby-39", "derby-40", "trainer-40")]
COMMANDS = (
    ("ingest-last", *LASTS, "--size-system", "eu", "--jobs", "2"),
    ("list-lasts",),
    ("set-reference", "derby-40"),
    ("measure", *FEET, "--csv", "measures.csv", "--jobs", "2"),
    ("match", *FEET, "--pair", "--html", "page.html", "--csv", "-"),
    ("match", *FEET, "--pairs", "auto", "--sheet", "sheets/", "--jobs", "2"),
    ("edit-last", "derby-39", "--size", "39½"),
    ("compare", FEET[0], "derby-40", "-o", "heat.png", "--html", "clearance.html"),
    ("align", FEET[0], "-o", "aligned.stl"),
    ("align", FEET[0], "-o", "aligned.stl", "--force"),
    ("curvature", FEET[0], "-o", "curvature.ply"),
    ("rename-last", "derby-40", "größe ½"),
    ("backup-catalogue", "backup.footfit"),
    ("backup-catalogue", "backup.footfit", "--force"),
    ("remove-last", "trainer-40"),
    ("check-catalogue",),
    ("restore-catalogue", "backup.footfit"),
    ("list-lasts", "--json"),
)
REFUSED = (
    (2, ("match", FEET[0], "--html", "page.html")),
    (3, ("measure", "none.stl")),
    (4, ("show-last", "none")),
    (6, ("list-lasts", "--catalogue", "page.html")),
)


@pytest.fixture(scope="module")
def shop(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder, and a program that is loaded before every command."""
    folder = tmp_path_factory.mktemp("shop")
    (folder / "start").mkdir()
    program = "from tests.without_posix import take_away\ntake_away()\n"
    (folder / "start" / "sitecustomize.py").write_text(program, encoding="utf-8")
    return folder


def windows(shop: Path, *arguments: object) -> Run:
    """What a command does there."""
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(shop),
        "MPLCONFIGDIR": str(shop / "matplotlib"),
        "PYTHONPATH": os.pathsep.join((str(shop / "start"), str(ROOT))),
        "PYTHONIOENCODING": "cp1252",
        "PYTHONWARNDEFAULTENCODING": "1",
        "FOOTFIT_CATALOGUE": str(shop / "lasts.footfit"),
    }
    command = [sys.executable, "-m", "footfit", *map(str, arguments)]
    done = subprocess.run(command, cwd=shop, env=environment, capture_output=True)
    return Run(done.returncode, done.stdout.decode(), done.stderr.decode())


def test_what_is_taken_away_is_missing(shop: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(shop / "start"), str(ROOT)))}
    for code in (
        "import fcntl",
        "import signal; signal.SIGALRM",
        "import os; os.fork",
        "import os; file = open('x', 'w'); os.replace('x', 'y')",
        "from pathlib import Path; file = open('x', 'w'); Path('x').unlink()",
    ):
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=shop, env=environment, capture_output=True
        )
        assert done.returncode == 1, code


def test_a_damaged_catalogue_is_restored_there_too(shop: Path, stocked: Path) -> None:
    """The damaged file is moved away and another takes its name: no open file may be in the way."""
    backup, path = shop / "whole.footfit", shop / "damaged.footfit"
    data = stocked.read_bytes()
    backup.write_bytes(data)
    path.write_bytes(data[:100] + b"\xff" * 3_000 + data[3_100:])
    run = windows(shop, "restore-catalogue", backup, "--catalogue", path)
    assert run.code == 0, run.err
    assert (shop / "damaged.footfit.before-restore").exists()
    listed = windows(shop, "list-lasts", "--catalogue", path, "--json")
    assert len(listed.document["lasts"]) == len(list((SAMPLES / "lasts").glob("*.stl")))


def test_the_main_commands_do_their_work(shop: Path) -> None:
    for arguments in COMMANDS:
        run = windows(shop, *arguments)
        assert run.code == 0, (arguments, run.err)
        assert run.out, arguments
        assert "Traceback" not in run.err
        blamed = [line for line in run.err.splitlines() if "EncodingWarning" in line]
        assert not [line for line in blamed if str(ROOT / "footfit") in line]
    assert "größe ½" in run.out
    assert len(run.document["lasts"]) == len(LASTS)
    assert not list(shop.rglob("*.partial*"))
    for name in ("page.html", "clearance.html", "measures.csv", "heat.png", "curvature.ply"):
        assert (shop / name).stat().st_size > 1_000
    for code, arguments in REFUSED:
        run = windows(shop, *arguments)
        assert (run.code, run.out, len(run.err.splitlines())) == (code, "", 1), arguments
