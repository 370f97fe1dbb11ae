"""Backup and restore: make whole, verified copies of a catalogue, and bring one back."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from footfit.catalogue.blocks.search_file import drop_search_file
from footfit.catalogue.file.copying import partial_beside
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.file.migrate import copy_path
from footfit.catalogue.file.restoring import put_in_place
from footfit.catalogue.server.catalogue_server import NO_FILE
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, NoCatalogue, UnreadableFile
from footfit.locations import Location, ServerUrl
from footfit.pipeline.library.check import check, require_sound
from footfit.results import BackupOutcome, CheckOutcome, RestoreOutcome
from footfit.whole_files import give_name, require_folder, require_free

NO_BACKUP = "no backup was made; see footfit check-catalogue"
NOT_RESTORED = "nothing was restored; the catalogue is as it was"


def back_up(path: Location, backup: Path, *, replace: bool = False) -> BackupOutcome:
    """Copy a catalogue, check the copy, and only then give it its name.

    Other programs may write to the catalogue meanwhile.

    Raises
    ------
    OutputExists, BadOption
        The backup exists and ``replace`` is not given; it is the catalogue itself, or a folder.
    CheckFailed
        The catalogue is damaged: its copy might take the place of a good one.
    NoCatalogue, CatalogueUnusable
        There is no catalogue; it cannot be read, or the backup cannot be written.
    """
    path = _file_of(path)
    _refuse_itself(path, backup, "name another file")
    require_free(backup, replace=replace)
    with open_catalogue(path, older=True) as catalogue, partial_beside(backup) as partial:
        catalogue.copy_to(partial)
        outcome = _require_sound_copy(partial, path, NO_BACKUP)
        give_name(partial, backup, replace=replace)
    return BackupOutcome(str(path), str(backup), backup.stat().st_size, outcome.lasts)


def restore(path: Location, backup: Path) -> RestoreOutcome:
    """Make a catalogue what its backup is; the file that is there now is kept.

    The backup is checked first. Then a copy of it beside the catalogue is brought to this
    version's schema, and is checked too.

    Raises
    ------
    UnreadableFile, BadOption
        There is no such backup, or it is the catalogue itself; the catalogue's folder is missing.
    CheckFailed
        The backup is damaged.
    CatalogueUnusable
        The backup, or the file in the catalogue's place, is no catalogue or cannot be used.
    """
    path = _file_of(path)
    _refuse_itself(path, backup, "name a backup of it")
    try:
        require_sound(check(backup), NOT_RESTORED)
        require_folder(path)
        with open_catalogue(backup, older=True) as old, partial_beside(path) as whole:
            old.copy_to(whole)
            _bring_up_to_date(whole)
            outcome = _require_sound_copy(whole, backup, NOT_RESTORED)
            kept = put_in_place(whole, path, SETTINGS.busy_timeout_s)
            drop_search_file(path)
    except NoCatalogue as error:
        raise UnreadableFile("there is no backup here; check the name", str(backup)) from error
    return RestoreOutcome(
        str(path), str(backup), outcome.lasts, None if kept is None else str(kept)
    )


def _file_of(path: Location) -> Path:
    """The catalogue's file.

    Raises
    ------
    BadOption
        The catalogue is on a server.
    """
    if isinstance(path, ServerUrl):
        raise BadOption(NO_FILE, str(path))
    return path


def _refuse_itself(path: Path, backup: Path, instead: str) -> None:
    if path.is_file() and backup.exists() and path.samefile(backup):
        raise BadOption(f"is the catalogue itself; {instead}", str(backup))


def _require_sound_copy(copy: Path, original: Path, otherwise: str) -> CheckOutcome:
    """Check a copy; a refusal names the file that the copy was made from."""
    outcome = dataclasses.replace(check(copy), path=str(original))
    require_sound(outcome, otherwise)
    return outcome


def _bring_up_to_date(whole: Path) -> None:
    """Upgrade a copy of an older schema; the backup that an upgrade makes is not needed here."""
    with open_catalogue(whole, write=True, create=False) as catalogue:
        before = catalogue.revisions.before
    copy_path(whole, before).unlink(missing_ok=True)
