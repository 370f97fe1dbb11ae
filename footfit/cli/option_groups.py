"""Options that go together: a command names a group, and the help shows each option of it."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from functools import wraps
from typing import Any, get_type_hints

from typer.models import ParameterInfo

from footfit.cli import options


@dataclass(frozen=True, slots=True)
class Scale:
    """How long a mesh is, and what comes on stdin."""

    units: options.Units = options.UnitName.auto
    known_length: options.Known = None
    format: options.Format = None

    def keywords(self) -> dict[str, Any]:
        """As the functions of `footfit.api` take them."""
        return {"units": self.units.value, "known_length_mm": self.known_length}


@dataclass(frozen=True, slots=True)
class Reading(Scale):
    """How a foot or a last is to be understood."""

    side: options.Side = options.SideChoice.auto

    def keywords(self) -> dict[str, Any]:
        """As the functions of `footfit.api` take them."""
        return {**Scale.keywords(self), "side": self.side.value}


@dataclass(frozen=True, slots=True)
class Batch:
    """How many meshes are worked on."""

    split: options.Split = False
    jobs: options.Jobs = 1


@dataclass(frozen=True, slots=True)
class OutputMode:
    """JSON lines or tables, with or without messages.

    ``total`` is how many answers are awaited. ``answers`` False: stdout is taken by a CSV.
    """

    json: options.Json = False
    quiet: options.Quiet = False
    verbose: options.Verbose = False
    total: int = 1
    answers: bool = True


def with_groups(command: Callable[..., None]) -> Callable[..., None]:
    """``command`` with a parameter for each option of its groups, as Typer reads them.

    A group is a dataclass; its fields that are annotated with a Typer option are options.
    """
    hints = get_type_hints(command, include_extras=True)
    groups: dict[str, Any] = {name: hint for name, hint in hints.items() if is_dataclass(hint)}
    members = {name: _options_of(group) for name, group in groups.items()}
    parameters = []
    for parameter in inspect.signature(command).parameters.values():
        own = parameter.replace(
            kind=inspect.Parameter.KEYWORD_ONLY, annotation=hints[parameter.name]
        )
        parameters += members.get(parameter.name, [own])

    @wraps(command)
    def plain_command(**given: Any) -> None:
        for name, group in groups.items():
            values = {option.name: given.pop(option.name) for option in members[name]}
            given[name] = group(**values)
        command(**given)

    plain_command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    plain_command.__annotations__ = {each.name: each.annotation for each in parameters}
    return plain_command


def _options_of(group: Any) -> list[inspect.Parameter]:
    hints = get_type_hints(group, include_extras=True)
    return [
        inspect.Parameter(
            field.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=field.default,
            annotation=hints[field.name],
        )
        for field in fields(group)
        if any(isinstance(each, ParameterInfo) for each in _metadata(hints[field.name]))
    ]


def _metadata(hint: Any) -> tuple[Any, ...]:
    return getattr(hint, "__metadata__", ())
