"""The fit log of a catalogue: entries are added, read and forgotten, never changed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.rows.columns import FIT
from footfit.catalogue.rows.records import fit_entry_of
from footfit.catalogue.rows.verified_rows import row_digest, rows
from footfit.catalogue.rows.writing import add_fit, delete_rows
from footfit.errors import CatalogueDamaged, UnknownFit

if TYPE_CHECKING:
    from footfit.catalogue.file.dialect import Driver
    from footfit.catalogue.rows.digests import Row
    from footfit.catalogue.server.any_location import OpenLocation
    from footfit.results import FitEntry, ForgetOutcome


@dataclass(frozen=True, slots=True)
class FitLog:
    """The entries in a catalogue file. An entry outlives the last that it names."""

    file: OpenLocation

    def entries(self) -> tuple[FitEntry, ...]:
        """Every entry, oldest first.

        Raises
        ------
        CatalogueDamaged
            An entry is not what was stored; the message names it.
        """
        with self.file.reading() as connection:
            return tuple(fit_entry_of(self._intact(row)) for row in rows(connection, FIT))

    def counts(self) -> tuple[tuple[str, int], ...]:
        """How many entries each fit profile has, by its name."""
        with self.file.reading() as connection:
            counts = connection.execute("SELECT profile, count(*) FROM fit GROUP BY profile")
            return tuple(sorted((str(name), int(count)) for name, count in counts))

    def add(self, entry: FitEntry) -> None:
        """Store an entry.

        Raises
        ------
        CatalogueUnusable
            It could not be stored; the catalogue is as it was.
        """
        with self.file.atomic() as connection:
            add_fit(connection, entry)

    def forget(self, asked: str) -> ForgetOutcome:
        """Remove the entries of a wearer's code, or the one entry of an id, for good.

        The file is written anew afterwards, so that nothing of them is left in it. If that fails,
        their place was overwritten all the same.

        Raises
        ------
        UnknownFit
            There is no such code or id.
        """
        from footfit.results import ForgetOutcome

        with self.file.atomic() as connection:
            keys = _keys(driver_of(connection), asked)
            if not keys:
                raise UnknownFit(
                    f"no entry has the code or id {asked!r}; footfit list-fits shows them"
                )
            for key in keys:
                delete_rows(connection, FIT, key)
        self.file.compact()
        return ForgetOutcome(asked, len(keys))

    def _intact(self, row: Row) -> Row:
        if row.get("sha256") != row_digest(FIT, row):
            raise CatalogueDamaged(
                f"the fit entry {row.get('id')!r} is damaged; restore the catalogue from a backup,"
                f" or remove the entry: footfit forget-fits {row.get('id')}",
                str(self.file.path),
            )
        return row


def _keys(connection: Driver, asked: str) -> list[int]:
    """The keys of the entries that have this code or id."""
    try:
        asked.encode()
    except UnicodeEncodeError:  # bytes that are no text cannot be stored
        return []
    select = "SELECT number FROM fit WHERE wearer = ? OR id = ? ORDER BY number"
    return [int(key) for (key,) in connection.execute(select, (asked, asked))]
