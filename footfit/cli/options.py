"""The options that commands share, each written once. Options that go together form a group.

A command has a parameter of a group's type; `command_group` shows each option of the group.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import typer

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from footfit.api.catalogues import Catalogue
    from footfit.locations import Location

UnitName = Literal["auto", "mm", "cm", "m", "in"]
SideChoice = Literal["auto", "left", "right"]
KindChoice = Literal["auto", "foot", "last"]
ScannerName = Literal["laser", "handheld", "phone", "photos"]
LoadName = Literal["air", "sitting", "half", "full"]
SexName = Literal["female", "male"]
TimeName = Literal["morning", "evening"]
FormatName = Literal["stl", "obj", "ply", "off", "glb", "3mf", "3dm"]

STDOUT = Path("-")
"""Where a file is asked for: the answer goes to stdout instead."""

ANSWER = "Answer"
READING = "Reading the scan"
OUTPUT = "Files written"
STANDING = "How the last stands"
WORN = "What is worn"
SWITCH: dict[str, Any] = {"metavar": "", "default": False}
"""An option without a value; the help shows no type, which a reader would try to give."""


def option(
    flag: str,
    help: str,
    metavar: str | None = None,
    *more: str,
    default: Any = None,
    panel: str | None = None,
    **more_settings: Any,
) -> Any:
    """An option with a value, by its flags; the help shows its default, if there is one."""
    shown: dict[str, Any] = {"metavar": metavar, "rich_help_panel": panel, "help": help}
    shown |= more_settings
    return typer.Option(default, flag, *more, show_default=default not in (None, "", ...), **shown)


def _possible_length(value: float | None) -> float | None:
    """The known length, checked before any file is opened."""
    if value is not None:
        from footfit.meshes.units import check_unit_options

        check_unit_options("auto", value)
    return value


def switch(flag: str, help: str, *, panel: str | None = None) -> Any:
    """An option without a value."""
    return option(flag, help, **SWITCH, panel=panel)


def output_file(
    flag: str, help: str, *short: str, metavar: str = "FILE", default: Any = None
) -> Any:
    """An option that names a file to write; its content differs from command to command."""
    first, *more = *short, flag
    return option(first, help, metavar, *more, default=default, panel=OUTPUT)


def output_files(flag: str, help: str, *short: str, default: Any = None) -> Any:
    """An option that names a file to write, or a folder for the files of many meshes."""
    return output_file(flag, help, *short, metavar="FILE|FOLDER/", default=default)


def head_text(flag: str, help: str, metavar: str) -> Any:
    """An option with a text for the head of the pages that are written."""
    return option(flag, help, metavar, default="", panel=OUTPUT)


def argument(metavar: str, help: str, default: Any = ...) -> Any:
    """What a command works on, given without a flag."""
    return typer.Argument(default, metavar=metavar, show_default=False, help=help)


def member(flag: str, help: str, metavar: str | None = None, **settings: Any) -> Any:
    """A field of a group that is an option."""
    return member_of(option(flag, help, metavar, **settings))


def member_of(info: Any) -> Any:
    """A field of a group that is shown as an option; code that makes a group gives its value."""
    return field(metadata={"option": info})


MESHES = argument(
    "MESH",
    "Give mesh files, folders or globs, names of lasts, or - to read one mesh from stdin.",
)
LAST = argument("LAST", "Give the name of a last; list-lasts shows the names.")
JOBS = option(
    "--jobs",
    "Work with this many processes. The answer is the same for any number.",
    "N",
    "-j",
    default=1,
    panel=READING,
    min=1,
)
FORCE = switch("--force", "Replace output files that exist.", panel=OUTPUT)
CSV = output_file("--csv", "Write the answer as CSV; - writes it to stdout instead of the table.")


@dataclass(frozen=True, slots=True)
class Lasts:
    """The catalogue of lasts that a command uses."""

    catalogue: str | None = member(
        "--catalogue",
        "Use this file, or the address of a server. Else FOOTFIT_CATALOGUE, the settings file or "
        "your data folder.",
        "PATH|ADDRESS",
        panel="Catalogue",
    )

    def path(self) -> Location:
        """Where the catalogue is, whether it exists or not."""
        from footfit.cli.settings import catalogue_path

        return catalogue_path(self.catalogue)

    def open(self) -> Catalogue:
        """The catalogue, for the methods of the library."""
        from footfit.api.catalogues import open_catalogue

        return open_catalogue(self.path())

    def open_to_make(self, *, dry_run: bool = False) -> Catalogue:
        """The catalogue for a method that makes one: it has its folder, except in a dry run.

        Raises
        ------
        BadOption, CatalogueNotWritable
            Its folder does not exist; the data folder cannot be made.
        """
        from footfit.cli.settings import make_folder_for

        catalogue = self.open()
        make_folder_for(catalogue.path, dry_run=dry_run)
        return catalogue


@dataclass(frozen=True, slots=True)
class Scale:
    """How long a mesh is, and what comes on stdin."""

    units: UnitName = member(
        "--units",
        "Set the unit of the file; auto takes the one that makes the length 180-340 or 110-370 mm.",
        default="auto",
        panel=READING,
    )
    known_length: float | None = member(
        "--known-length",
        "Scale a scan without a true scale to this heel-to-toe length in mm, from 110 to 370.",
        "MM",
        panel=READING,
        callback=_possible_length,
    )
    format: FormatName | None = member(
        "--format",
        "Set the format of the mesh on stdin, if its content does not say it.",
        panel=READING,
    )

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {"units": self.units, "known_length_mm": self.known_length}


@dataclass(frozen=True, slots=True)
class Reading(Scale):
    """How a foot or a last is to be understood."""

    side: SideChoice = member(
        "--side", "Set the side; auto detects it, and says how sure it is.", default="auto",
        panel=READING,
    )  # fmt: skip
    kind: KindChoice = member(
        "--kind", "Set the kind, foot or last; auto detects it, and says if that is not sure.",
        default="auto", panel=READING,
    )  # fmt: skip
    force_side: bool = member(
        "--force-side", "Take the given side even if the shape is surely of the other side.",
        **SWITCH, panel=READING,
    )  # fmt: skip
    scanner: ScannerName | None = member(
        "--scanner",
        "Say what kind of scanner was used: each total ± in mm then holds its uncertainty.",
        panel=READING,
    )

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        shape = {"side": self.side, "force_side": self.force_side, "kind": self.kind}
        return {**Scale.keywords(self), **shape, "scanner": self.scanner}


@dataclass(frozen=True, slots=True)
class FootReading(Reading):
    """How a foot is to be understood, and how it is compared with a last that has a heel."""

    as_scanned: bool = member(
        "--as-scanned",
        "Compare the foot as it was scanned. Without it, footfit takes the foot as it would be in "
        "the heel of the last.",
        **SWITCH,
        panel=READING,
    )
    scanned_at_drop: float | None = member(
        "--scanned-at-drop",
        "Say by how many mm the heel stood higher than the forepart in the scanner; 0 is flat.",
        "MM",
        panel=READING,
        min=0,
        max=120,
    )

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        heel = {"as_scanned": self.as_scanned, "scanned_at_drop_mm": self.scanned_at_drop}
        return {**Reading.keywords(self), **heel}


@dataclass(frozen=True, slots=True)
class WornWith:
    """What is worn with the shoes, and how the foot was scanned; without it the profile decides."""

    sock: float | None = member(
        "--sock", "Set the thickness of the sock in mm; nylon .5, dress 1, sport 2, wool 3.", "MM",
        panel=WORN, min=0, max=10,
    )  # fmt: skip
    insole: float | None = member(
        "--insole", "Set the thickness in mm of an insole under the whole foot.", "MM",
        panel=WORN, min=0, max=15,
    )  # fmt: skip
    heel_lift: float | None = member(
        "--heel-lift", "Set how many mm lie under the heel alone; they add to the drop.", "MM",
        panel=WORN, min=0, max=40,
    )  # fmt: skip
    load: LoadName | None = member(
        "--load",
        "Say how the foot was loaded in the scanner: air, sitting, half (on both feet), full.",
        panel=WORN,
    )
    time: TimeName | None = member(
        "--time", "Say when the foot was scanned: feet swell until the evening.", panel=WORN
    )
    scanned_in_sock: float | None = member(
        "--scanned-in-sock", "Set the thickness in mm of the sock that the scan holds.", "MM",
        panel=WORN, min=0, max=10,
    )  # fmt: skip

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {
            "sock_mm": self.sock,
            "insole_mm": self.insole,
            "heel_lift_mm": self.heel_lift,
            "load": self.load,
            "time": self.time,
            "scanned_in_sock_mm": self.scanned_in_sock,
        }


@dataclass(frozen=True, slots=True)
class Growing:
    """A child, who grows."""

    growth: bool = member(
        "--growth", "Say for how many months a child's shoe will do.", **SWITCH, panel=WORN
    )
    age: float | None = member(
        "--age", "Set the child's age in years; without it the foot's length tells.", "YEARS",
        panel=WORN, min=0.5, max=18,
    )  # fmt: skip
    sex: SexName | None = member("--sex", "Set the child's sex: girls stop earlier.", panel=WORN)

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {"growth": self.growth, "age_years": self.age, "sex": self.sex}


@dataclass(frozen=True, slots=True)
class Standing:
    """What is known of how a last stands; without it the shape decides."""

    heel_height: float | None = member(
        "--heel-height",
        "Set the last's heel height in mm, if you know it. It decides how the last stands.",
        "MM",
        panel=STANDING,
        min=0,
        max=200,
    )
    toe_spring: float | None = member(
        "--toe-spring",
        "Set the toe spring at the tip in mm, if you know it. It decides how the last stands.",
        "MM",
        panel=STANDING,
        min=0,
        max=80,
    )
    platform: float | None = member(
        "--platform",
        "Set how many mm of the heel height are under the forepart too, as of a shoe with a sole.",
        "MM",
        panel=STANDING,
        min=0,
        max=100,
    )

    def keywords(self) -> dict[str, Any]:
        """The options as the functions of `footfit.api` take them."""
        return {
            "heel_height_mm": self.heel_height,
            "toe_spring_mm": self.toe_spring,
            "platform_mm": self.platform,
        }


@dataclass(frozen=True, slots=True)
class Crew:
    """Who works: processes of this machine, or a cluster."""

    jobs: int = member_of(JOBS)
    scheduler: str | None = member(
        "--scheduler", "Work on this scheduler's Dask cluster. The scans travel to its workers.",
        "tcp://HOST:PORT", panel=READING,
    )  # fmt: skip

    @contextmanager
    def at_work(self) -> Iterator[int | Executor]:
        """What the functions of `footfit.api` take as ``jobs``.

        Raises
        ------
        BadOption, ClusterUnusable
            The address is not valid; the cluster cannot be used.
        """
        if self.scheduler is None:
            yield self.jobs
            return
        from footfit.api.scans import cluster

        with cluster(self.scheduler) as workers:
            yield workers


@dataclass(frozen=True, slots=True)
class Batch(Crew):
    """How many meshes are worked on, and who works."""

    split: bool = member(
        "--split",
        "Take the feet of one file apart; each has a line of its own (file.stl#1, #2).",
        **SWITCH,
        panel=READING,
    )


@dataclass(frozen=True, slots=True)
class OutputMode:
    """JSON lines or tables, with or without messages.

    ``total`` is how many answers are expected. ``answers`` is False if a CSV goes to stdout.
    """

    json: bool = member(
        "--json", "Write JSON lines to stdout, one document per mesh.", **SWITCH, panel=ANSWER
    )
    quiet: bool = member(
        "--quiet", "Print the answer only, and no messages.", **SWITCH, panel=ANSWER
    )
    verbose: bool = member(
        "--verbose", "Show the numbers behind a refusal, and the traceback of a bug.",
        **SWITCH, panel=ANSWER,
    )  # fmt: skip
    total: int = 1
    answers: bool = True
