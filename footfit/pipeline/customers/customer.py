"""Whose feet the scans are: each for itself, a pair, or pairs by a CSV file or by file names."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from footfit.errors import BadManifest, BadOption
from footfit.number_words import first_names
from footfit.pipeline.batch.side_words import SideInName, names_somebody, side_in_name
from footfit.pipeline.batch.sources import Source, stored_path
from footfit.results import Notice, SideName

if TYPE_CHECKING:
    from footfit.pipeline.batch.csv_rows import CsvRow

COLUMNS = ("customer", "left", "right")
SIDES: tuple[SideName, ...] = ("left", "right")
NAMED_ALONE = 10
"""So many customers with a single foot are named."""
IN_CSV = "name the feet in a CSV file with the columns customer, left and right (--pairs FILE.csv)"


@dataclass(frozen=True, slots=True)
class CustomerFoot:
    """A scan of a customer. ``given`` is a side that somebody gives, ``named`` one of the name."""

    source: Source
    given: SideName | None = None
    named: SideName | None = None

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""
        return self.source.path


@dataclass(frozen=True, slots=True)
class Customer:
    """One foot, or a left and a right one; ``name`` is None if nobody gives it."""

    feet: tuple[CustomerFoot, ...]
    name: str | None = None

    @property
    def path(self) -> str | None:
        """The path of the first foot."""
        return self.feet[0].path

    @property
    def title(self) -> str:
        """The name, or that of the first file."""
        return self.name or file_stem(self.path)

    @property
    def paths(self) -> tuple[str | None, ...]:
        """The path of each foot."""
        return tuple(foot.path for foot in self.feet)


def alone(sources: Iterable[Source]) -> list[Customer]:
    """A customer for each scan."""
    return [Customer((CustomerFoot(source),)) for source in sources]


def one_pair(sources: Sequence[Source]) -> list[Customer]:
    """The two scans of one customer.

    Raises
    ------
    BadOption
        There are not two.
    """
    if len(sources) != 2:
        raise BadOption(f"--pair takes two different scans of one customer, not {len(sources)}")
    return [Customer(tuple(map(CustomerFoot, sources)))]


# ---------------------------------------------------------------- by a CSV file


def pairs_in_csv(path: Path) -> list[Customer]:
    """The customers of a CSV file, as a spreadsheet writes it; paths are relative to it.

    The columns are customer, left and right. One foot may be missing. A customer without a name
    has that of the first file.

    Raises
    ------
    BadManifest
        The file is not understood, a row has no foot, or a customer or a file is named twice.
    """
    from footfit.pipeline.batch.csv_rows import Faults, csv_rows

    faults, customers = Faults(), []
    names: set[str] = set()
    read: set[str] = set()
    for row in csv_rows(path, COLUMNS, (), faults):
        with faults.collecting():
            customer = _customer_in(row, path.parent)
            customers.append(customer)
            name, files = _key(customer.name or ""), [str(each) for each in customer.paths]
            for number, each in enumerate(files):
                if each in read or each in files[:number]:
                    raise BadManifest(f"names {each} twice; keep it once", row.where)
            if name in names:
                words = f"names the customer {customer.name!r} twice"
                raise BadManifest(f"{words}; give each line a name of its own", row.where)
            names.add(name)
            read.update(files)
    faults.refuse(str(path))
    if not customers:
        raise BadManifest(f"names no customer; {IN_CSV}", str(path))
    return customers


def _customer_in(row: CsvRow, folder: Path) -> Customer:
    given = {side: row.values[side] for side in SIDES if side in row.values}
    if not given:
        raise BadManifest("has no foot; fill in left or right, or remove the line", row.where)
    feet = tuple(
        CustomerFoot(Source(stored_path(str(folder / path))), given=side)
        for side, path in given.items()
    )
    name = " ".join(row.values.get("customer", "").split())
    return Customer(feet, name or _named_file(feet[0].path or "").customer)


# ---------------------------------------------------------------- by the names of files


@dataclass(frozen=True, slots=True)
class _NamedFile:
    """What the name of a file says: the customer's folder and name, and the side, if any."""

    folder: str
    customer: str
    said: SideInName

    @property
    def key(self) -> tuple[str, str]:
        """What the feet of one customer have in common."""
        return self.folder, _key(self.customer)


def pairs_by_name(sources: Sequence[Source]) -> list[Customer]:
    """The customers of files whose names say left or right, in the order of their first files.

    What a name says beside the side is the customer. If it says no more, or only "foot", the
    folder's name is; the folder may say the side too. Two parts of one file are a pair. A foot
    without another one is a customer with one foot.

    Raises
    ------
    BadOption
        A name says both sides, or two files are the same foot of one customer.
    """
    groups: dict[tuple[str, str], list[tuple[_NamedFile, CustomerFoot]]] = {}
    for source in sources:
        file = _of_part(source) or _named_file(source.path or "-")
        if len(file.said.sides) > 1:
            words = f"the name says both left and right: rename the file, or {IN_CSV}"
            raise BadOption(words, source.path)
        foot = CustomerFoot(source, named=file.said.side)
        groups.setdefault(file.key, []).append((file, foot))
    return [customer for group in groups.values() for customer in _customers_of(group)]


def _customers_of(group: Sequence[tuple[_NamedFile, CustomerFoot]]) -> Iterator[Customer]:
    """The customers among the files of one name."""
    name, feet = group[0][0].customer, [foot for _, foot in group]
    sided = [foot for side in SIDES for foot in feet if foot.named == side]
    for first, second in pairwise(sided):
        if first.named == second.named:
            words = f"this and {second.path} are both the {first.named} foot of {name!r} by name"
            raise BadOption(f"{words}: rename one, or {IN_CSV}", first.path)
    pair = sided or [foot for foot in feet if _of_part(foot.source) is not None]
    if len(pair) == 2:
        yield Customer(tuple(pair), name)
    for foot in feet:
        if len(pair) != 2 or foot not in pair:
            yield Customer((foot,), name if foot.named else file_stem(foot.path))


def file_stem(path: str | None) -> str:
    """The name of a file without its folder and suffix; of a part of a file with its number.

    Examples
    --------
    >>> file_stem("scans/ann.stl"), file_stem("both.stl#2"), file_stem(None)
    ('ann', 'both-2', 'standard input')
    """
    file, mark, number = (path or "standard input").rpartition("#")
    if not (mark and number.isdigit()):
        return Path(path or "standard input").stem
    return f"{Path(file).stem}-{number}"


def _named_file(path: str) -> _NamedFile:
    """The customer and the side by the name of a file, and by that of its folder."""
    place = Path(path)
    said, folder = side_in_name(place.stem), place.parent
    of_folder = side_in_name(folder.name)
    if not said.sides and of_folder.sides and not names_somebody(of_folder.rest):
        said, folder = SideInName(of_folder.sides, said.rest), folder.parent
    if said.sides and not names_somebody(said.rest):
        return _NamedFile(str(folder.parent), folder.name or "customer", said)
    return _NamedFile(str(folder), said.rest, said)


def _of_part(source: Source) -> _NamedFile | None:
    """One shape of a file that holds several (``both.stl#1``): the file is the customer."""
    file, mark, number = (source.path or "").rpartition("#")
    if source.scan is None or not mark or not number.isdigit():
        return None
    return _NamedFile(f"{file}#", Path(file).stem, SideInName(frozenset(), ""))


def _key(name: str) -> str:
    return unicodedata.normalize("NFC", " ".join(name.split())).casefold()


def alone_notices(customers: Sequence[Customer]) -> tuple[Notice, ...]:
    """A notice that names the customers of whom only one foot is there."""
    single = [customer.path or "-" for customer in customers if len(customer.feet) == 1]
    if not single:
        return ()
    feet = "1 foot has" if len(single) == 1 else f"{len(single)} feet have"
    words = f"{feet} no other foot by name, and {'is' if len(single) == 1 else 'are'} matched alone"
    return (Notice("matched_alone", f"{words}: {first_names(single, NAMED_ALONE)}"),)
