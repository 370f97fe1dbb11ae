"""The options that commands share, each written once. Options that go together form a group.

A command has a parameter of a group's type; `command_group` shows each option of the group.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

STDOUT = Path("-")
"""Where a file is asked for: the answer goes to stdout instead."""

ANSWER = "Answer"
READING = "Reading the scan"
CATALOGUE = "Catalogue"
OUTPUT = "Files written"


class UnitName(StrEnum):
    """The units a scan can be in."""

    auto = "auto"
    mm = "mm"
    cm = "cm"
    m = "m"
    inch = "in"


class SideChoice(StrEnum):
    """The side of the body; ``auto`` goes by the shape."""

    auto = "auto"
    left = "left"
    right = "right"


class FormatName(StrEnum):
    """Mesh formats that footfit reads."""

    stl = "stl"
    obj = "obj"
    ply = "ply"
    off = "off"
    glb = "glb"
    threemf = "3mf"


def option(flag: str, help: str, metavar: str | None = None, *, panel: str | None = None) -> Any:
    """An option with a value that has no default to show."""
    return typer.Option(flag, metavar=metavar, show_default=False, rich_help_panel=panel, help=help)


def switch(flag: str, help: str, *, panel: str | None = None) -> Any:
    """An option without a value; the help shows no type, which a reader would try to give."""
    return typer.Option(flag, metavar="", rich_help_panel=panel, help=help)


def output_file(flag: str, help: str, *short: str) -> Any:
    """An option that names a file to write; its content differs from command to command."""
    return typer.Option(
        *short, flag, metavar="FILE", show_default=False, rich_help_panel=OUTPUT, help=help
    )


def argument(metavar: str, help: str) -> Any:
    """What a command works on, given without a flag."""
    return typer.Argument(metavar=metavar, show_default=False, help=help)


Meshes = Annotated[
    list[str],
    argument("MESH", "Give mesh files, folders or globs, or - to read one mesh from stdin."),
]
LastName = Annotated[str, argument("LAST", "Give the name of a last; list-lasts shows the names.")]
Catalogue = Annotated[
    Path | None,
    option(
        "--catalogue",
        "Use this file. Else FOOTFIT_CATALOGUE, the settings file or your data folder.",
        "PATH",
        panel=CATALOGUE,
    ),
]
Jobs = Annotated[
    int,
    typer.Option(
        "--jobs",
        "-j",
        metavar="N",
        min=1,
        rich_help_panel=READING,
        help="Work with this many processes. The answer is the same for any number.",
    ),
]
Force = Annotated[bool, switch("--force", "Replace output files that exist.", panel=OUTPUT)]
Csv = Annotated[
    Path | None,
    output_file("--csv", "Write the answer as CSV; - writes it to stdout instead of the table."),
]


@dataclass(frozen=True, slots=True)
class Scale:
    """How long a mesh is, and what comes on stdin."""

    units: Annotated[
        UnitName,
        typer.Option(
            "--units",
            rich_help_panel=READING,
            help="Set the unit of the file; auto takes the one that makes the length 180-340 mm.",
        ),
    ] = UnitName.auto
    known_length: Annotated[
        float | None,
        typer.Option(
            "--known-length",
            metavar="MM",
            min=115,
            max=370,
            show_default=False,
            rich_help_panel=READING,
            help="Scale a scan without a true scale to this heel-to-toe length in mm.",
        ),
    ] = None
    format: Annotated[
        FormatName | None,
        option("--format", "Set the format of the mesh on stdin.", panel=READING),
    ] = None

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {"units": self.units.value, "known_length_mm": self.known_length}


@dataclass(frozen=True, slots=True)
class Reading(Scale):
    """How a foot or a last is to be understood."""

    side: Annotated[
        SideChoice,
        typer.Option(
            "--side",
            rich_help_panel=READING,
            help="Set the side; auto detects it, and says how sure it is.",
        ),
    ] = SideChoice.auto

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {**Scale.keywords(self), "side": self.side.value}


@dataclass(frozen=True, slots=True)
class Batch:
    """How many meshes are worked on."""

    split: Annotated[
        bool,
        switch(
            "--split",
            "Take the feet of one file apart; each has a line of its own (file.stl#1, #2).",
            panel=READING,
        ),
    ] = False
    jobs: Jobs = 1


@dataclass(frozen=True, slots=True)
class OutputMode:
    """JSON lines or tables, with or without messages.

    ``total`` is how many answers are expected. ``answers`` is False if a CSV goes to stdout.
    """

    json: Annotated[
        bool, switch("--json", "Write JSON lines to stdout, one document per mesh.", panel=ANSWER)
    ] = False
    quiet: Annotated[
        bool, switch("--quiet", "Print the answer only, and no messages.", panel=ANSWER)
    ] = False
    verbose: Annotated[bool, switch("--verbose", "Show the traceback of a bug.", panel=ANSWER)] = (
        False
    )
    total: int = 1
    answers: bool = True
