"""Commands: how they are found, how options are grouped, and plain help without rich.

The help of rich takes longer to import than all the rest of ``footfit -h``. The options of a
command are read when the command is used, not when the list of commands is shown.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import wraps
from pathlib import Path
from typing import Any, get_type_hints

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from footfit.cli.console import answer
from footfit.cli.options import OUTPUT


def plain_command(command: Callable[..., object]) -> Callable[..., None]:
    """``command`` with a parameter for each option of its groups, as Typer reads them.

    A group is a dataclass; some of its fields are options. If the command returns a result, it is
    told in the command's output mode.
    """
    hints = get_type_hints(command)
    groups: dict[str, Any] = {name: hint for name, hint in hints.items() if is_dataclass(hint)}
    members = {name: _options_of(group) for name, group in groups.items()}
    parameters: list[inspect.Parameter] = []
    for name, parameter in inspect.signature(command).parameters.items():
        parameters += members.get(name) or [_keyword(name, parameter.default, hints[name])]

    @wraps(command)
    def with_groups(**given: Any) -> None:
        for name, group in groups.items():
            given[name] = group(**{each.name: given.pop(each.name) for each in members[name]})
        result = command(**given)
        if result is not None:
            from footfit.cli.answers import tell

            tell(result, given["mode"])

    with_groups.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    with_groups.__annotations__ = {each.name: each.annotation for each in parameters}
    return with_groups


def _options_of(group: Any) -> list[inspect.Parameter]:
    hints = get_type_hints(group)
    members = [field for field in fields(group) if "option" in field.metadata]
    return [_keyword(each.name, each.metadata["option"], hints[each.name]) for each in members]


def _keyword(name: str, default: Any, hint: Any) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(name, kind, default=default, annotation=hint)


Record = tuple[str, str]
"""An option or a command as the help shows it, and its help text."""


def _records(command: Any, context: Any) -> Iterator[tuple[str, Record]]:
    """Arguments and options, each with the heading that it names."""
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context)
        if record is None:
            continue
        if parameter.param_type_name == "argument":
            yield "Arguments", (parameter.metavar, record[1])
        else:
            yield getattr(parameter, "rich_help_panel", None) or "Options", record


def _write_sections(records: Iterable[tuple[str, Record]], formatter: Any) -> None:
    """Records below their headings."""
    headings: dict[str, list[Record]] = {}
    for heading, record in records:
        headings.setdefault(heading, []).append(record)
    for heading, below in headings.items():
        with formatter.section(heading):
            formatter.write_dl(below)


def _show_help(context: Any, _option: Any, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        answer(context.get_help())
        context.exit()


def _usage_piece(argument: Any) -> str:
    name = f"{argument.metavar}..." if argument.nargs == -1 else str(argument.metavar)
    return name if argument.required else f"[{name}]"


class _HelpAsAnswer:
    """A command whose help is written as every answer is: a reader that goes away is no failure."""

    def get_help_option(self, ctx: Any) -> Any:
        """The option that shows the help."""
        shown = super().get_help_option(ctx)  # type: ignore[misc]
        if shown is not None:
            shown.callback = _show_help
        return shown


class PlainCommand(_HelpAsAnswer, TyperCommand):
    """A command whose help groups the options by heading."""

    def invoke(self, ctx: Any) -> Any:
        """Run the command, unless it would write over a file that it reads."""
        written: list[str] = []
        files: list[Path] = []
        read: list[str] = []
        for parameter in self.params:
            value = ctx.params.get(parameter.name)
            values = value if isinstance(value, (list, tuple)) else [value]
            is_output = getattr(parameter, "rich_help_panel", None) == OUTPUT
            names = [str(name) for name in values if isinstance(name, (str, Path))]
            (written if is_output else read).extend(names)
            if is_output and parameter.type.name in ("path", "file", "directory"):
                files.extend(Path(name) for name in names if Path(name).suffix)
        if written:
            from footfit.cli.outputs import refuse_inputs, refuse_twice

            refuse_twice(path for path in files if not path.is_dir())
            refuse_inputs(written, read)
        return super().invoke(ctx)

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """What follows the command in the line of its usage: ``[OPTIONS] MESH...``."""
        arguments = (each for each in self.get_params(ctx) if each.param_type_name == "argument")
        return ["[OPTIONS]", *map(_usage_piece, arguments)]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options."""
        _write_sections(_records(self, ctx), formatter)


class LazyGroup(_HelpAsAnswer, TyperGroup):
    """The commands of `headings`, each opened and built when it is used."""

    headings: Mapping[str, str] = {}
    function_of: Callable[[str], Callable[..., object]]

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands: dict[str, Any] = dict.fromkeys(self.headings)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The command of that name, None where there is none."""
        if cmd_name not in self.headings:
            return None
        single = typer.Typer(add_completion=False, rich_markup_mode=None)
        settings = {"help_option_names": ["-h", "--help"]}
        command = single.command(cmd_name, cls=PlainCommand, context_settings=settings)
        command(plain_command(self.function_of(cmd_name)))
        return get_command(single)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options, and the commands under their headings."""
        docs = ((name, self.function_of(name).__doc__ or "") for name in self.headings)
        summaries = (
            (self.headings[name], (name, " ".join(doc.partition("\n\n")[0].split())))
            for name, doc in docs
        )
        _write_sections((*_records(self, ctx), *summaries), formatter)
