"""What the catalogue holds, as an ingest must know it: what becomes of a file that comes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass

from footfit.catalogue.rows.last_names import caseless, composed, differs_in_case
from footfit.catalogue.rows.requirements import same_scan
from footfit.errors import NameTaken
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.pipeline.library.entries import Entry
from footfit.results import LastLabels, LastRecord, SideName

SAME_LENGTH_MM = 0.01
"""Two known lengths that differ by less are the same: a measuring stick shows whole mm."""


@dataclass(frozen=True, slots=True)
class Held:
    """What an ingest must know of a stored last: few bytes, however many lasts there are."""

    labels: LastLabels
    sha256: str
    units: str
    lengths_mm: tuple[float | None, float]
    side: SideName | None
    flare_angle_deg: float
    whole_mesh: bool = False


def held_last(record: LastRecord, *, whole_mesh: bool = False) -> Held:
    """What is known of a last; older versions scaled its extent and not its length."""
    info, side, lengths_mm = record.info, record.side.side, (record.length_mm, record.extent_mm)
    angle_deg = record.flare.angle_deg
    return Held(record.labels, info.sha256, info.units, lengths_mm, side, angle_deg, whole_mesh)


class Holdings:
    """The lasts of the catalogue, kept up to date during a batch (also in a dry run).

    A name is the same however its accents are written. One that differs in case is not, and is
    refused. ``whole`` names the lasts whose stored copy is the whole mesh.
    """

    def __init__(self, records: Iterable[LastRecord], whole: frozenset[str] = frozenset()) -> None:
        self.by_name: dict[str, Held] = {}
        self.by_content: dict[str, str] = {}
        self.spellings: dict[str, str] = {}
        for record in records:
            self.put(record, whole_mesh=record.labels.name in whole)

    def put(self, record: LastRecord, *, whole_mesh: bool = False) -> None:
        """Add a last, or replace the one of its name."""
        name = composed(record.labels.name)
        old = self.by_name.get(name)
        if old is not None:
            self.by_content.pop(old.sha256, None)
        self.by_name[name] = held_last(record, whole_mesh=whole_mesh)
        self.by_content[record.info.sha256] = record.labels.name
        self.spellings[caseless(name)] = record.labels.name

    def named(self, name: str) -> Held | None:
        """The last of that name.

        Raises
        ------
        NameTaken
            There is none, but one whose name differs only in case.
        """
        record, spelling = self.by_name.get(composed(name)), self.spellings.get(caseless(name))
        if record is None and spelling is not None:
            raise differs_in_case(spelling)
        return record

    def status(self, sha256: str, entry: Entry, *, replace: bool) -> str:
        """What becomes of a file with that content: "added", "unchanged" or "replaced".

        Raises
        ------
        NameTaken
            Another last has the name, or the content is stored under another name.
        """
        holder, name = self.by_content.get(sha256), entry.labels.name
        if holder is not None and composed(holder) != composed(name):
            raise same_scan(holder)
        old = self.named(name)
        if old is None:
            return "added"
        labels = dataclasses.replace(entry.labels, name=old.labels.name, parent=old.labels.parent)
        same = holder is not None
        if same and old.labels == labels and _reads_alike(old, entry.reading):
            return "unchanged"
        if replace:
            return "replaced"
        scan = "another scan"
        if same:
            difference = "read otherwise" if old.labels == labels else "with other labels"
            scan = f"the same scan {difference}"
        raise NameTaken(f"{name!r} is in the catalogue with {scan}; add --replace or --name")


def _reads_alike(old: Held, reading: ReadingOptions) -> bool:
    """Whether these options would read the stored scan as it was read."""
    known = reading.known_length_mm
    length = known is None or any(abs(known - mm) < SAME_LENGTH_MM for mm in old.lengths_mm if mm)
    units = reading.units in ("auto", old.units)
    return length and units and reading.side in ("auto", old.side)
