"""The application: every command by name, and the entry point."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from footfit.cli.boundary import run_guarded
from footfit.cli.command_group import LazyGroup
from footfit.cli.commands.align import align
from footfit.cli.commands.backup_catalogue import backup_catalogue
from footfit.cli.commands.catalogue_info import catalogue_info
from footfit.cli.commands.check_catalogue import check_catalogue
from footfit.cli.commands.compare import compare
from footfit.cli.commands.curvature import curvature
from footfit.cli.commands.demo import demo
from footfit.cli.commands.export_last import export_last
from footfit.cli.commands.flare import flare
from footfit.cli.commands.ingest_last import ingest_last
from footfit.cli.commands.list_lasts import list_lasts
from footfit.cli.commands.match import match
from footfit.cli.commands.measure import measure
from footfit.cli.commands.remove_last import remove_last
from footfit.cli.commands.rename_last import rename_last
from footfit.cli.commands.restore_catalogue import restore_catalogue
from footfit.cli.commands.set_reference import set_reference
from footfit.cli.commands.show_last import show_last
from footfit.cli.commands.upgrade_catalogue import upgrade_catalogue
from footfit.cli.settings import use_one_blas_thread
from footfit.version import __version__

PAPER, FIT = "The paper's commands", "Fit"
LIBRARY, START = "The library of lasts", "Start here"

COMMANDS = (
    ("demo", demo, START),
    ("ingest-last", ingest_last, PAPER),
    ("set-reference", set_reference, PAPER),
    ("align", align, PAPER),
    ("flare", flare, PAPER),
    ("curvature", curvature, PAPER),
    ("measure", measure, PAPER),
    ("match", match, PAPER),
    ("compare", compare, FIT),
    ("list-lasts", list_lasts, LIBRARY),
    ("show-last", show_last, LIBRARY),
    ("rename-last", rename_last, LIBRARY),
    ("remove-last", remove_last, LIBRARY),
    ("export-last", export_last, LIBRARY),
    ("catalogue-info", catalogue_info, LIBRARY),
    ("check-catalogue", check_catalogue, LIBRARY),
    ("backup-catalogue", backup_catalogue, LIBRARY),
    ("restore-catalogue", restore_catalogue, LIBRARY),
    ("upgrade-catalogue", upgrade_catalogue, LIBRARY),
)
"""Every command: its name, its function, its panel in the help."""


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"footfit {__version__}")
        raise typer.Exit


def _root(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    """Which shoe last fits this foot, and why?

    footfit reads scans of feet and lasts, and ranks lasts with reasons. New here? Try footfit demo.
    """


class Commands(LazyGroup):
    """The commands of footfit."""

    table = COMMANDS


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
