"""The application: every command by name, and the entry point."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module

import typer

from footfit.cli.boundary import run_guarded
from footfit.cli.command_group import LazyGroup
from footfit.cli.console import answer
from footfit.cli.settings import use_one_blas_thread
from footfit.version import __version__

HEADINGS = {
    "Start here": "demo",
    "The paper's commands": "ingest-last set-reference align flare curvature measure match",
    "Fit": "compare coverage",
    "Lasts made from lasts": "customise draw-last grade-last check-run compare-lasts",
    "Fit profiles": "list-profiles show-profile check-profile calibrate-profile",
    "What wearers say": "record-fit list-fits forget-fits",
    "The library of lasts": (
        "list-lasts show-last edit-last rename-last remove-last export-last catalogue-info"
        " check-lasts check-catalogue backup-catalogue restore-catalogue copy-catalogue"
        " upgrade-catalogue"
    ),
}
"""Every command below its heading in the help. Its file and its function have its name."""


COMMANDS = {name: heading for heading, names in HEADINGS.items() for name in names.split()}
"""The heading of each command in the help."""


def function_of(command: str) -> Callable[..., object]:
    """The function of a command; its file is opened only now."""
    name = command.replace("-", "_")
    function: Callable[..., object] = getattr(import_module(f"footfit.cli.commands.{name}"), name)
    return function


def _version(wanted: bool) -> None:
    if wanted:
        answer(f"footfit {__version__}")
        raise typer.Exit


def _root(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Show the version."
    ),
) -> None:
    """Which shoe last fits this foot, and why?

    footfit reads scans of feet and lasts, and ranks lasts with reasons. New here? Try footfit demo.
    """


class Commands(LazyGroup):
    """The commands of footfit."""

    headings = COMMANDS
    function_of = staticmethod(function_of)


def application() -> typer.Typer:
    """The Typer application with every command of `COMMANDS`."""
    app = typer.Typer(
        cls=Commands,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
        rich_markup_mode=None,
    )
    app.callback()(_root)
    return app


def main() -> None:
    """Run the command line and exit with its code."""
    use_one_blas_thread()
    sys.exit(run_guarded(application(), sys.argv[1:]))
