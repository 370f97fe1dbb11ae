"""Everything that can go wrong on purpose, and the exit code each wrong has.

The whole tree (a test compares this drawing with the classes)::

    FootfitError
    ├── UsageError                exit 2
    │   ├── BadOption             bad_option
    │   ├── NameTaken             name_taken
    │   └── OutputExists          output_exists
    ├── InputError                exit 3
    │   ├── UnreadableFile        unreadable_file
    │   ├── UnknownFormat         unknown_format
    │   ├── DamagedMesh           damaged_mesh
    │   ├── EmptyMesh             empty_mesh
    │   ├── TooLarge              too_large
    │   ├── TooSlow               too_slow
    │   ├── UnknownUnits          unknown_units
    │   ├── ImplausibleSize       implausible_size
    │   ├── BadManifest           bad_manifest
    │   └── BadProfile            bad_profile
    ├── NotInCatalogue            exit 4
    │   ├── NoCatalogue           no_catalogue
    │   ├── EmptyCatalogue        empty_catalogue
    │   ├── UnknownLast           unknown_last
    │   ├── NoReference           no_reference
    │   └── NoCandidate           no_candidate
    ├── GeometryRefused           exit 5
    │   ├── NotAFoot              not_a_foot
    │   ├── SeveralFeet           several_feet
    │   ├── HalfScan              half_scan
    │   ├── SideUndecided         side_undecided
    │   └── NoSole                no_sole
    ├── CatalogueUnusable         exit 6
    │   ├── CatalogueLocked       catalogue_locked
    │   ├── CatalogueNotWritable  catalogue_not_writable
    │   ├── NotACatalogue         not_a_catalogue
    │   ├── CatalogueDamaged      catalogue_damaged
    │   └── NewerCatalogue        newer_catalogue
    └── CheckFailed               exit 7, check_failed
"""

from __future__ import annotations

import re
from enum import IntEnum
from typing import ClassVar

from footfit.version import __version__


class ExitCode(IntEnum):
    """What the process answers; ``docs/exit-codes.md`` says it in words."""

    OK = 0
    BUG = 1
    USAGE = 2
    INPUT = 3
    NOT_IN_CATALOGUE = 4
    GEOMETRY_REFUSED = 5
    CATALOGUE_UNUSABLE = 6
    CHECK_FAILED = 7
    INTERRUPTED = 130
    TERMINATED = 143


class FootfitError(Exception):
    """One line for a person: what is wrong, with which thing, and what to do next.

    Parameters
    ----------
    message : str
        The line, without the path: the boundary puts the path in front.
    path : str, optional
        The file (or the catalogue) that the line is about.
    """

    code: ClassVar[str] = "error"
    exit: ClassVar[ExitCode] = ExitCode.BUG

    def __init_subclass__(cls) -> None:
        """Name the code after the class, unless the class names it: BadOption is bad_option."""
        if "code" not in vars(cls):
            cls.code = re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()

    def __init__(self, message: str, path: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.path = path

    def __reduce__(self) -> tuple[type[FootfitError], tuple[str, str | None]]:
        """Pickle with both arguments, so that a worker's error arrives whole."""
        return type(self), (self.message, self.path)

    def at(self, path: str | None) -> FootfitError:
        """The same error, naming ``path`` where it names none yet."""
        return self if self.path is not None else type(self)(self.message, path)

    def to_dict(self) -> dict[str, object]:
        """``footfit.error/1``: the last line of stderr, and a failed mesh's line on stdout."""
        return {
            "schema": "footfit.error/1",
            "footfit_version": __version__,
            "code": self.code,
            "exit": int(self.exit),
            "message": self.message,
            "path": self.path,
        }


class UsageError(FootfitError):
    """The command was given in a way that cannot be carried out."""

    exit = ExitCode.USAGE
    code = "usage"


class BadOption(UsageError):
    """An option's value is outside what the option takes."""


class NameTaken(UsageError):
    """The name, or the content, is in the catalogue already under another label."""


class OutputExists(UsageError):
    """The output file exists and ``--force`` was not given."""


class InputError(FootfitError):
    """The file, its format, its units or its size cannot be used."""

    exit = ExitCode.INPUT
    code = "input"


class UnreadableFile(InputError):
    """The path is missing, not a regular file, or may not be read."""


class UnknownFormat(InputError):
    """The content is no mesh format that footfit reads."""


class DamagedMesh(InputError):
    """The file breaks its own format: truncated, lying counts, NaN, bad indices."""


class EmptyMesh(InputError):
    """Nothing with an area is left in the file."""


class TooLarge(InputError):
    """The file is past a stated limit of size or memory."""


class TooSlow(InputError):
    """The work on the file takes longer than one file may."""


class UnknownUnits(InputError):
    """No unit makes the scan a plausible length, and none was declared."""


class ImplausibleSize(InputError):
    """With the declared unit the scan is no foot's and no last's length."""


class BadManifest(InputError):
    """The manifest CSV cannot be understood."""


class BadProfile(InputError):
    """The fit profile's TOML cannot be understood."""


class NotInCatalogue(FootfitError):
    """The catalogue, or what was asked of it, is not there."""

    exit = ExitCode.NOT_IN_CATALOGUE


class NoCatalogue(NotInCatalogue):
    """There is no catalogue at that path."""


class EmptyCatalogue(NotInCatalogue):
    """The catalogue holds no last."""


class UnknownLast(NotInCatalogue):
    """No last of that name."""


class NoReference(NotInCatalogue):
    """A paper method needs a reference last and none is set."""


class NoCandidate(NotInCatalogue):
    """No last of the catalogue passes the filters given."""


class GeometryRefused(FootfitError):
    """The mesh is well formed and is not what the command needs."""

    exit = ExitCode.GEOMETRY_REFUSED


class NotAFoot(GeometryRefused):
    """Neither a foot nor a last, as far as its shape tells."""


class SeveralFeet(GeometryRefused):
    """More than one foot in one file."""


class HalfScan(GeometryRefused):
    """Only a part of a foot: a plantar sheet, a forefoot."""


class SideUndecided(GeometryRefused):
    """The shape does not tell left from right, and the answer depends on it."""


class NoSole(GeometryRefused):
    """The scan has no sole, and the answer needs one."""


class CatalogueUnusable(FootfitError):
    """The catalogue file cannot be opened or written."""

    exit = ExitCode.CATALOGUE_UNUSABLE


class CatalogueLocked(CatalogueUnusable):
    """Another process holds the catalogue past the timeout."""


class CatalogueNotWritable(CatalogueUnusable):
    """The file or its folder is read-only, or the disk is full."""


class NotACatalogue(CatalogueUnusable):
    """The file is something else."""


class CatalogueDamaged(CatalogueUnusable):
    """SQLite cannot read the file."""


class NewerCatalogue(CatalogueUnusable):
    """A later version of footfit wrote the file."""


class CheckFailed(FootfitError):
    """A check was asked for and is not met."""

    exit = ExitCode.CHECK_FAILED
