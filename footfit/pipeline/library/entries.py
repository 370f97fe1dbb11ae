"""The files of an ingest, each with its labels and with how to read it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from footfit.catalogue.rows.requirements import require_name
from footfit.errors import BadOption
from footfit.number_words import first_names
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.manifest import LABEL_HEIGHTS, ManifestRow
from footfit.results import LastLabels, Notice


@dataclass(frozen=True, slots=True)
class Entry:
    """One file to ingest, with its labels and how to read it.

    ``whole_mesh`` says that every face of its mesh is to be kept.
    """

    source: Source
    labels: LastLabels
    reading: ReadingOptions
    whole_mesh: bool = False

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""
        return self.source.path


def entries(
    sources: Sequence[Source],
    manifest: Sequence[ManifestRow],
    given: LastLabels,
    reading: ReadingOptions,
) -> list[Entry]:
    """Join files with their labels, sorted by path; without files, the manifest names them.

    A label in the manifest overrides one of the command line (``given``). A name that was typed
    (``given.name``, "" for none) overrides all. Rows of files that are not among the sources have
    no effect: see `unused_rows`.

    Raises
    ------
    BadOption
        There is nothing to ingest, ``--name`` is given for several files, standard input has no
        name, or no last or family can have a name.
    """
    rows = {_resolved(row.path): row for row in manifest}
    if manifest and not sources:
        sources = [Source(row.path) for row in manifest]
    if not sources:
        raise BadOption("nothing to ingest; name files, a folder or a --manifest")
    if given.name and len(sources) > 1:
        raise BadOption("--name names one last, and there are several files; use --manifest")
    ordered = sorted(sources, key=lambda source: source.path or "")
    return [_entry(item, rows.get(_resolved(item.path or "")), given, reading) for item in ordered]


def unused_rows(batch: Sequence[Entry], manifest: Sequence[ManifestRow]) -> tuple[Notice, ...]:
    """A notice if the manifest has rows of files that were not given: a path may be mistyped."""
    given = {_resolved(entry.path) for entry in batch if entry.path}
    named = {_resolved(row.path) for row in manifest}
    unused = [row.path for row in manifest if _resolved(row.path) not in given]
    if not unused:
        return ()
    words = f"the manifest also names {first_names(unused, 1)}, not among the files given"
    if not given & named:
        words += "; it names none of those, so they get no labels: its paths start at its folder"
    return (Notice("manifest_rows_unused", words),)


def _resolved(path: str) -> str:
    return str(Path(path).resolve())


def _entry(
    source: Source, row: ManifestRow | None, given: LastLabels, reading: ReadingOptions
) -> Entry:
    labels = row.labels if row else LastLabels(name=Path(source.path).stem if source.path else "")
    name, family = given.name or labels.name, labels.family or given.family
    if not name:
        raise BadOption("a last from standard input needs --name")
    if given.name or row is not None:  # a name that comes from a file is refused with the file
        require_name(name)
    if family:
        require_name(family, "family")
    own = {key: value for key, value in dataclasses.asdict(labels).items() if value is not None}
    labels = dataclasses.replace(given, **(own | {"name": name}))
    if row is not None:
        units = row.reading.units if row.reading.units != "auto" else reading.units
        side = row.reading.side if row.reading.side != "auto" else reading.side
        reading = dataclasses.replace(reading, units=units, side=side)
    said = {name: getattr(labels, name) for name in LABEL_HEIGHTS}
    reading = dataclasses.replace(reading, **said)
    return Entry(source, labels, reading)
