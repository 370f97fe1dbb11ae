"""The file of a catalogue: what it holds, whether it is sound, copies of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from footfit import results
from footfit.api.inputs import FilePath
from footfit.catalogue.catalogue_reader import open_reader
from footfit.locations import Location, LocationName, location_of
from footfit.pipeline.batch.runs import HERE

if TYPE_CHECKING:
    from footfit.pipeline.shelf.shelf import Shelf
    from footfit.results.population.checked_lasts import LastsCheck


class CatalogueFile:
    """A catalogue's file. ``_chosen`` keeps the lasts that were read, until one is changed."""

    def __init__(self, path: Location) -> None:
        self.path = path
        self._chosen: dict[tuple[str | None, str | None], Shelf] = {}

    def info(self) -> results.CatalogueFacts:
        """Where the file is, and what it holds."""
        with open_reader(self.path) as catalogue:
            return catalogue.summary()

    def check(self) -> results.CheckOutcome:
        """Everything that is not as it was stored. Nothing is changed."""
        from footfit.pipeline.library import check

        return check.check(self.path)

    def check_lasts(self, tolerance: str | None = None) -> LastsCheck:
        """Twins, labels that the shapes contradict, and runs that break, among all lasts.

        ``tolerance`` is by kind of measure, such as "girth=2,length=1.5,width=1". Raises BadOption
        if it is not.
        """
        from footfit.pipeline.last_checks.lasts_check import check_lasts

        return check_lasts(self.path, tolerance)

    def backup(self, file: FilePath, *, replace: bool = False) -> results.BackupOutcome:
        """Copy the catalogue and check the copy; raises OutputExists, CheckFailed or BadOption."""
        from footfit.pipeline.library import backup

        return backup.back_up(self.path, Path(file), replace=replace)

    def restore(self, file: FilePath) -> results.RestoreOutcome:
        """Make the catalogue what a backup is; raises UnreadableFile, CheckFailed or BadOption."""
        from footfit.pipeline.library import backup

        self._chosen.clear()
        return backup.restore(self.path, Path(file))

    def copy_to(self, target: LocationName) -> results.CopyOutcome:
        """Copy the catalogue into a new or an empty one, of a file or a server, without loss.

        Raises
        ------
        CheckFailed, BadOption
            The catalogue is damaged; the target holds lasts.
        """
        from footfit.pipeline.library.whole_copy import copy_catalogue

        return copy_catalogue(self.path, location_of(target))

    def upgrade(
        self, jobs: int = HERE, count: Callable[[int, int], None] = lambda _done, _total: None
    ) -> results.UpgradeOutcome:
        """Bring an older catalogue to this version, and keep a copy of the old file.

        ``count`` is called with how many lasts are done, and how many there are to do.
        """
        from footfit.pipeline.library import upgrade

        self._chosen.clear()
        return upgrade.upgrade(self.path, jobs, count)
