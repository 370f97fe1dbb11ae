"""The options that commands share, each written once.

============  =======================================================
``Meshes``    files, folders, globs, or ``-`` for stdin
``Catalogue``  ``--catalogue PATH``
``Json``      ``--json``
``Quiet``     ``--quiet``
``Verbose``   ``--verbose``
``Units``     ``--units mm|cm|m|in|auto``
``Known``     ``--known-length MM``
``Side``      ``--side left|right|auto``
``Format``    ``--format`` for stdin
``Split``     ``--split``
``Jobs``      ``--jobs N``
``Csv``       ``--csv FILE``
``Force``     ``--force``
``LastName``  the name of a last
============  =======================================================
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from typer.models import OptionInfo

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
    """The side of the body, or let the shape tell."""

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


def file_to_write(*flags: str, help: str) -> OptionInfo:
    """An option that names a file to write; what is in it differs from command to command."""
    option: OptionInfo = typer.Option(
        *flags, metavar="FILE", show_default=False, rich_help_panel=OUTPUT, help=help
    )
    return option


def switch(flag: str, *, help: str, panel: str | None = None) -> OptionInfo:
    """An option without a value: the help shows no type that a reader would try to give it."""
    option: OptionInfo = typer.Option(flag, metavar="", rich_help_panel=panel, help=help)
    return option


Meshes = Annotated[
    list[str],
    typer.Argument(
        metavar="MESH",
        show_default=False,
        help="Mesh files, folders or globs; - reads one mesh from stdin.",
    ),
]
Catalogue = Annotated[
    Path | None,
    typer.Option(
        "--catalogue",
        metavar="PATH",
        show_default=False,
        rich_help_panel=CATALOGUE,
        help="The catalogue file. Else FOOTFIT_CATALOGUE, the settings file, your data folder.",
    ),
]
Json = Annotated[
    bool,
    switch("--json", panel=ANSWER, help="JSON lines on stdout, one document per mesh."),
]
Quiet = Annotated[
    bool,
    switch("--quiet", panel=ANSWER, help="No messages, only the answer."),
]
Verbose = Annotated[
    bool,
    switch("--verbose", panel=ANSWER, help="Show the traceback of a bug."),
]
Units = Annotated[
    UnitName,
    typer.Option(
        "--units",
        rich_help_panel=READING,
        help="The file's unit; auto takes the one that makes the length 180-340 mm.",
    ),
]
Known = Annotated[
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
]
Side = Annotated[
    SideChoice,
    typer.Option(
        "--side", rich_help_panel=READING, help="The side; auto detects it and says how surely."
    ),
]
Format = Annotated[
    FormatName | None,
    typer.Option(
        "--format",
        show_default=False,
        rich_help_panel=READING,
        help="The format of the mesh on stdin.",
    ),
]
Split = Annotated[
    bool,
    switch(
        "--split",
        panel=READING,
        help="Take the feet of one file apart; each is a line of its own (file.stl#1, #2).",
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
        help="Processes to work with; the answer is the same for any number.",
    ),
]
Force = Annotated[
    bool,
    switch("--force", panel=OUTPUT, help="Replace output files that exist."),
]
Csv = Annotated[
    Path | None,
    file_to_write(
        "--csv", help="Write the answer as CSV; - writes it to stdout instead of the table."
    ),
]
LastName = Annotated[
    str,
    typer.Argument(
        metavar="LAST", show_default=False, help="The last's name; list-lasts shows them."
    ),
]
