"""Backup and restore: whole, verified copies of a catalogue, and the way back."""

from __future__ import annotations

from pathlib import Path

from footfit.catalogue.file.copying import give_name, partial_beside
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.file.migrate import copy_path
from footfit.catalogue.file.restoring import put_in_place
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, NoCatalogue, OutputExists, UnreadableFile
from footfit.pipeline.library.check import checked, require_sound
from footfit.results import BackupOutcome, CheckOutcome, RestoreOutcome

UNKEPT = "no backup was made; see footfit check-catalogue"
UNTOUCHED = "nothing was restored; the catalogue is as it was"


def backed_up(path: Path, backup: Path, *, replace: bool = False) -> BackupOutcome:
    """Copy a catalogue while others may write to it, check the copy, and only then name it.

    Raises
    ------
    OutputExists, BadOption
        The backup exists and ``replace`` is not given; it is the catalogue itself, or a folder.
    CheckFailed
        The catalogue is damaged: its copy would take the place of a good one.
    NoCatalogue, CatalogueUnusable
        There is no catalogue; it cannot be read, or the backup not be written.
    """
    _require_target(path, backup, replace=replace)
    with open_catalogue(path, older=True) as catalogue, partial_beside(backup) as partial:
        catalogue.copy_to(partial)
        outcome = _sound(partial, path, UNKEPT)
        give_name(partial, backup, replace=replace)
    return BackupOutcome(str(path), str(backup), backup.stat().st_size, outcome.lasts)


def restored(path: Path, backup: Path) -> RestoreOutcome:
    """Make a catalogue what its backup is. The backup is checked first, on a copy beside the
    catalogue that also takes this version's schema; what is there now is kept.

    Raises
    ------
    UnreadableFile, BadOption
        There is no such backup; it is the catalogue itself.
    CheckFailed
        The backup is damaged.
    CatalogueUnusable
        The backup, or what lies in the catalogue's place, is something else or cannot be used.
    """
    if path.exists() and backup.exists() and path.samefile(backup):
        raise BadOption("is the catalogue itself; name a backup of it", str(backup))
    try:
        require_sound(checked(backup), UNTOUCHED)
        path.parent.mkdir(parents=True, exist_ok=True)
        with open_catalogue(backup, older=True) as old, partial_beside(path) as whole:
            old.copy_to(whole)
            _bring_up_to_date(whole)
            outcome = _sound(whole, backup, UNTOUCHED)
            kept = put_in_place(whole, path, SETTINGS.busy_timeout_s)
    except NoCatalogue as error:
        raise UnreadableFile("there is no backup here; check the name", str(backup)) from error
    except FileExistsError as error:
        raise BadOption("the folder cannot be made; it is a file", str(path.parent)) from error
    return RestoreOutcome(
        str(path), str(backup), outcome.lasts, None if kept is None else str(kept)
    )


def _require_target(path: Path, backup: Path, *, replace: bool) -> None:
    if backup.is_dir():
        raise BadOption("is a folder; name a file in it", str(backup))
    if not backup.parent.is_dir():
        raise BadOption(f"the folder {backup.parent} does not exist; make it first", str(backup))
    if not backup.exists():
        return
    if path.exists() and path.samefile(backup):
        raise BadOption("is the catalogue itself; name another file", str(backup))
    if not replace:
        raise OutputExists("exists; add --force to replace it", str(backup))


def _sound(copy: Path, named: Path, otherwise: str) -> CheckOutcome:
    """Check a copy; what is wrong with it is said of the file that it was made from."""
    found = checked(copy)
    outcome = CheckOutcome(str(named), found.lasts, found.mesh_copies, found.findings)
    require_sound(outcome, otherwise)
    return outcome


def _bring_up_to_date(whole: Path) -> None:
    """Upgrade a copy of an older schema; the copy that an upgrade lays beside is not needed."""
    with open_catalogue(whole, write=True, create=False) as catalogue:
        before = catalogue.revisions.before
    copy_path(whole, before).unlink(missing_ok=True)
