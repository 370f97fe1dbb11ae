"""A whole catalogue copied into an empty one: from a file to a server, back, or to another file."""

from __future__ import annotations

from pathlib import Path

from footfit.catalogue.file.copying import partial_beside
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.catalogue.transfer import Copied, copy_rows
from footfit.locations import Location
from footfit.pipeline.library.check import require_sound
from footfit.results import CheckOutcome, CopyOutcome
from footfit.whole_files import give_name, require_folder

NOT_COPIED = "nothing was copied; see footfit check-catalogue"


def copy_catalogue(source: Location, target: Location) -> CopyOutcome:
    """Copy every row of a sound catalogue, with its hashes, into a new or an empty one.

    Raises
    ------
    CheckFailed
        The source is damaged.
    BadOption
        The target holds lasts, or its folder is missing.
    NoCatalogue, CatalogueUnusable
        There is no source; one of the two cannot be used. Nothing is half copied.
    """
    with open_catalogue(source) as reader:
        outcome = CheckOutcome(str(source), 0, 0, tuple(reader.findings()))
        require_sound(outcome, NOT_COPIED)
        if isinstance(target, Path) and not target.exists():
            require_folder(target)
            with partial_beside(target) as partial:
                copied = _copied(reader, partial)
                give_name(partial, target, replace=False)
        else:
            copied = _copied(reader, target)
    return CopyOutcome(str(source), str(target), copied.lasts, copied.fits)


def _copied(reader: Catalogue, target: Location) -> Copied:
    with open_catalogue(target, write=True) as writer:
        return copy_rows(reader.file, writer.file)
