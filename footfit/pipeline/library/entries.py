"""The files of an ingest, each with its labels and with how to read it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from footfit.catalogue.rows.requirements import require_name
from footfit.errors import BadOption
from footfit.number_words import first_names
from footfit.pipeline.batch.manifest import LABEL_HEIGHTS
from footfit.pipeline.batch.run_manifest import UNUSED, as_said, said_in, with_said
from footfit.pipeline.batch.sources import RUN_MANIFEST, ManifestRow, ReadingOptions, Source
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
    no effect: see `unused_rows`. What the manifest does not name has the labels of a run's manifest
    beside it, if that was written for the file: see `labelled_beside`. Those of the command line
    override them.

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


def labelled_beside(batch: Sequence[Entry], manifest: Sequence[ManifestRow]) -> tuple[Notice, ...]:
    """A notice if files have the labels of a run's manifest that was not named, but lies there."""
    named = {_resolved(row.path) for row in manifest}
    said = (entry for entry in batch if entry.source.said and entry.source.said.row)
    count = sum(_resolved(entry.path or "") not in named for entry in said)
    if not count:
        return ()
    files = "1 file has the labels" if count == 1 else f"{count} files have the labels"
    return (Notice("labels_by_run", f"{files} of {RUN_MANIFEST} in its folder"),)


def _resolved(path: str) -> str:
    return str(Path(path).resolve())


def _entry(
    source: Source, row: ManifestRow | None, given: LastLabels, reading: ReadingOptions
) -> Entry:
    given = _filled(given, _heights(reading))
    reading = _read_as(reading, given)
    if row is None:
        source = with_said(source)
        labels, reading = _labelled_beside(source, given, reading)
    else:
        said = said_in(row, source, "the manifest", trusted=True)
        source = dataclasses.replace(source, said=said)
        # The line of another file of that name says nothing of how this one stands.
        labels = _filled(row.labels if said.row else _without_heights(row.labels), given)
        units = row.reading.units if row.reading.units != "auto" else reading.units
        side = row.reading.side if row.reading.side != "auto" else reading.side
        reading = dataclasses.replace(reading, units=units, side=side)
    labels = dataclasses.replace(labels, name=given.name or labels.name)
    if not labels.name:
        raise BadOption("a last from standard input needs --name")
    if given.name or row is not None:  # a name that comes from a file is refused with the file
        require_name(labels.name)
    if labels.family:
        require_name(labels.family, "family")
    return Entry(source, labels, _read_as(reading, labels))


def _labelled_beside(
    source: Source, given: LastLabels, reading: ReadingOptions
) -> tuple[LastLabels, ReadingOptions]:
    """The labels of a file that no manifest names, and how it is read: as was given, and else as
    the run's manifest beside it says.
    """
    read, notices = as_said(source, reading)
    said = None if source.said is None or UNUSED in {each.code for each in notices} else source.said
    own = LastLabels(Path(source.path).stem if source.path else "")
    if said is not None and said.row is not None:
        own = _without_heights(said.row.labels)
    return _filled(_filled(given, _heights(read)), own), read


def _filled(labels: LastLabels, others: LastLabels) -> LastLabels:
    """Labels with those of ``others`` where they say nothing."""
    said = dataclasses.asdict(labels).items()
    return dataclasses.replace(others, **{key: own for key, own in said if own not in (None, "")})


def _heights(reading: ReadingOptions) -> LastLabels:
    """The labels with which a file is read; they have no name."""
    return LastLabels("", **{name: getattr(reading, name) for name in LABEL_HEIGHTS})


def _read_as(reading: ReadingOptions, labels: LastLabels) -> ReadingOptions:
    """How a file is read that stands as its labels say."""
    return dataclasses.replace(reading, **{name: getattr(labels, name) for name in LABEL_HEIGHTS})


def _without_heights(labels: LastLabels) -> LastLabels:
    """Labels that do not say how a last stands."""
    return dataclasses.replace(labels, heel_height_mm=None, toe_spring_mm=None, platform_mm=None)
