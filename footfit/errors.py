"""Every error that footfit raises on purpose, and its exit code.

Below `FootfitError` stands a class for each exit code from 2 to 7, and below it one for each
``code``. docs/exit-codes.md lists them all; a test compares the page with the classes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from enum import IntEnum
from typing import Any, ClassVar

from footfit.version import __version__


class ExitCode(IntEnum):
    """The process's exit codes, which ``docs/exit-codes.md`` explains."""

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
    """A line for a person: what is wrong, where, and what to do next.

    Parameters
    ----------
    message : str
        The line without the path, which the command line puts in front.
    path : str, optional
        The file (or the catalogue) that the line is about.
    details : str
        The numbers behind the message, which ``--verbose`` shows.

    Attributes
    ----------
    others : tuple of FootfitError
        More errors that can be mended at the same time. Each is a line of its own.
    """

    code: ClassVar[str] = "error"
    exit: ClassVar[ExitCode] = ExitCode.BUG

    def __init_subclass__(cls) -> None:
        """Name the code after the class, unless the class names it: BadOption is bad_option."""
        if "code" not in vars(cls):
            cls.code = re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()

    def __init__(self, message: str, path: str | None = None, details: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.path = path
        self.details = details
        self.others: tuple[FootfitError, ...] = ()

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle with all arguments, so that a worker's error arrives whole."""
        return type(self), (self.message, self.path, self.details), {"others": self.others}

    def at(self, path: str | None) -> FootfitError:
        """The same error, naming ``path`` where it names none yet."""
        named = self.path is not None or path is None
        return self if named else type(self)(self.message, path, self.details)

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


@contextmanager
def errors_at(path: str | None) -> Iterator[None]:
    """Name ``path`` in every error of the block that names no file yet."""
    try:
        yield
    except FootfitError as error:
        raise error.at(path) from error.__cause__


class UsageError(FootfitError):
    """The command cannot be carried out as it was typed."""

    exit = ExitCode.USAGE
    code = "usage"


class BadOption(UsageError):
    """The option does not take this value."""


class NameTaken(UsageError):
    """The catalogue already has this name, or this content under another label."""


class OutputExists(UsageError):
    """The output file exists and ``--force`` was not given."""


class InputError(FootfitError):
    """The file, its format, its units or its size cannot be used."""

    exit = ExitCode.INPUT
    code = "input"


class UnreadableFile(InputError):
    """The path is missing, not a regular file, or may not be read."""


class UnknownFormat(InputError):
    """footfit does not read a format with this content."""


class DamagedMesh(InputError):
    """The file breaks its own format: cut off, wrong counts, NaN, wrong indices."""


class EmptyMesh(InputError):
    """Nothing with an area is left in the file."""


class TooLarge(InputError):
    """The file is over a stated limit of size or memory."""


class TooSlow(InputError):
    """The work on the file takes longer than is allowed for a file."""


class TooCoarse(InputError):
    """The file keeps its coordinates in steps that are too coarse to measure."""


class UnknownUnits(InputError):
    """In no unit does the scan have a plausible length, and no unit was declared."""


class ImplausibleSize(InputError):
    """In the declared unit, the scan is not as long as a foot or a last."""


class BadManifest(InputError):
    """The manifest CSV cannot be understood."""


class BadProfile(InputError):
    """The TOML of a fit profile, a heel model or a grading rule cannot be understood."""


class NotInCatalogue(FootfitError):
    """The catalogue, or something in it, is missing."""

    exit = ExitCode.NOT_IN_CATALOGUE


class NoCatalogue(NotInCatalogue):
    """There is no catalogue at that path."""


class EmptyCatalogue(NotInCatalogue):
    """The catalogue holds no last."""


class UnknownLast(NotInCatalogue):
    """The catalogue has no last of this name."""


class UnknownFit(NotInCatalogue):
    """The fit log has no entry of this code or id."""


class NoReference(NotInCatalogue):
    """A method of the paper needs a reference last, and none is set."""


class NoCandidate(NotInCatalogue):
    """No last of the catalogue passes the given filters."""


class GeometryRefused(FootfitError):
    """The mesh is valid, but it is not what the command needs."""

    exit = ExitCode.GEOMETRY_REFUSED


class NotAFoot(GeometryRefused):
    """By its shape it is neither a foot nor a last."""


class SeveralFeet(GeometryRefused):
    """The file holds more than one foot."""


class HalfScan(GeometryRefused):
    """The file holds only a part of a foot, such as its sole or its forefoot."""


class SideUndecided(GeometryRefused):
    """The side cannot be told from the shape, and the answer depends on it."""


class SideContradicted(GeometryRefused):
    """The side that was given is surely not the side that the shape shows."""


class SameSide(UsageError):
    """The two feet of a pair are of one side."""


class OtherKind(GeometryRefused):
    """The shape is a foot where a last is asked for, or the other way round."""


class NoSole(GeometryRefused):
    """The scan has no sole, and the answer needs one."""


class OutOfReach(GeometryRefused):
    """The base cannot be changed into the last that is asked for; the message names the zone."""


class CatalogueUnusable(FootfitError):
    """The catalogue, or the cluster that works for it, cannot be used."""

    exit = ExitCode.CATALOGUE_UNUSABLE


class CatalogueLocked(CatalogueUnusable):
    """Another process keeps the catalogue locked for longer than the timeout."""


class CatalogueNotWritable(CatalogueUnusable):
    """The file or its folder is read-only, or the disk is full."""


class NotACatalogue(CatalogueUnusable):
    """The file is not a catalogue."""


class CatalogueDamaged(CatalogueUnusable):
    """SQLite cannot read the file."""


class NewerCatalogue(CatalogueUnusable):
    """A newer version of footfit wrote the file."""


class CatalogueUnreachable(CatalogueUnusable):
    """The server of a shared catalogue does not answer, or it refuses the user."""


class ClusterUnusable(CatalogueUnusable):
    """The scheduler of a cluster does not answer, or its workers cannot be used."""


class CheckFailed(FootfitError):
    """A requested check has failed."""

    exit = ExitCode.CHECK_FAILED
