"""How commands are found and how help looks: plain text under headings, without rich.

Rich's help takes longer to import than all the rest of ``footfit -h``. A command's options are
looked at when the command is used, not when the list of commands is shown.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

CommandTable = tuple[tuple[str, Callable[..., None], str], ...]
"""Every command: its name, its function, its heading in the help."""


def _write_options(command: Any, context: Any, formatter: Any) -> None:
    """Arguments and options under the headings that they name."""
    headings: dict[str, list[tuple[str, str]]] = {}
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context)
        if record is None:
            continue
        if parameter.param_type_name == "argument":
            heading, record = "Arguments", (parameter.metavar, record[1])
        else:
            heading = getattr(parameter, "rich_help_panel", None) or "Options"
        headings.setdefault(heading, []).append(record)
    for heading, records in headings.items():
        with formatter.section(heading):
            formatter.write_dl(records)


class PlainCommand(TyperCommand):
    """A command whose help groups the options by heading."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options."""
        _write_options(self, ctx, formatter)


class LazyGroup(TyperGroup):
    """The commands of `table`, each made when it is asked for."""

    table: CommandTable = ()

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands: dict[str, Any] = {name: None for name, _, _ in self.table}

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The command of that name, None where there is none."""
        functions = {name: function for name, function, _ in self.table}
        if cmd_name not in functions:
            return None
        single = typer.Typer(add_completion=False, rich_markup_mode=None)
        settings = {"help_option_names": ["-h", "--help"]}
        single.command(cmd_name, cls=PlainCommand, context_settings=settings)(functions[cmd_name])
        return get_command(single)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options, and the commands under their headings."""
        _write_options(self, ctx, formatter)
        headings: dict[str, list[tuple[str, str]]] = {}
        for name, function, heading in self.table:
            summary = (function.__doc__ or "").partition("\n\n")[0]
            headings.setdefault(heading, []).append((name, " ".join(summary.split())))
        for heading, records in headings.items():
            with formatter.section(heading):
                formatter.write_dl(records)
