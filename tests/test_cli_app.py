"""The application: help, version, start-up cost, usage errors, the boundary."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from footfit import __version__
from footfit.cli.app import COMMANDS, application
from footfit.cli.boundary import run_guarded
from tests.conftest import Footfit

HEAVY = ("numpy", "scipy", "trimesh", "sqlalchemy", "alembic", "matplotlib", "jinja2", "rich")


def modules_after(*arguments: str) -> set[str]:
    """The top-level modules that a run of the command line imports, in a process of its own."""
    code = (
        "import sys; from footfit.cli.app import application;"
        "from footfit.cli.boundary import run_guarded;"
        f"run_guarded(application(), {list(arguments)!r});"
        "print('\\n' + ' '.join(sorted({m.split('.')[0] for m in sys.modules})))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.splitlines()[-1].split())


@pytest.mark.parametrize("command", [None, *COMMANDS])
def test_help_opens_none_of_the_heavy_libraries(command: str | None) -> None:
    arguments = ("-h",) if command is None else (command, "-h")
    assert not modules_after(*arguments) & set(HEAVY)


def test_a_match_without_a_page_opens_no_templates(foot: Path, catalogue: Path) -> None:
    opened = modules_after("match", str(foot), "--catalogue", str(catalogue))
    assert "numpy" in opened
    assert not opened & {"jinja2", "matplotlib"}


@pytest.mark.parametrize("command", list(COMMANDS))
def test_every_command_has_help_with_an_example_and_the_shared_options(
    footfit: Footfit, command: str
) -> None:
    run = footfit(command, "-h")
    assert run.code == 0
    text = " ".join(run.out.split())
    assert f"Example: footfit {command}" in text
    for option in ("--json", "--quiet", "--verbose"):
        assert option in text


def test_version(footfit: Footfit) -> None:
    assert footfit("--version").out == f"footfit {__version__}\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ("no-such-command",),
        ("align",),
        ("align", "foot.stl", "--units", "ft"),
        ("match", "foot.stl", "--top", "0"),
        ("align", "foot.stl", "--no-such-option"),
    ],
)
def test_a_usage_error_is_one_line_and_exit_2(footfit: Footfit, arguments: tuple[str, ...]) -> None:
    run = footfit(*arguments)
    assert run.code == 2
    assert run.out == ""
    assert len(run.err.splitlines()) == 1
    assert run.err.startswith("footfit: ")


def test_an_error_with_json_is_a_document(footfit: Footfit, tmp_path: Path) -> None:
    run = footfit("list-lasts", "--catalogue", tmp_path / "none", "--json")
    error = json.loads(run.last_error)
    assert run.code == error["exit"] == 4
    assert set(error) == {"schema", "footfit_version", "code", "exit", "message", "path"}
    assert error["schema"] == "footfit.error/1"
    assert error["code"] == "no_catalogue"
    assert not (tmp_path / "none").exists()


@pytest.mark.parametrize("verbose", [False, True])
def test_a_bug_is_exit_1_and_shows_its_traceback_only_on_request(
    verbose: bool, capsysbinary: pytest.CaptureFixture[bytes]
) -> None:
    def broken(**_: object) -> None:
        raise RuntimeError("broken")

    assert run_guarded(broken, ["--verbose"] if verbose else []) == 1
    err = capsysbinary.readouterr().err.decode()
    assert ("Traceback" in err) == verbose
    assert "please report it" in err.splitlines()[-1]


def test_the_entry_points_agree(footfit: Footfit) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "footfit", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout == footfit("--version").out
    assert application().info.no_args_is_help is True
