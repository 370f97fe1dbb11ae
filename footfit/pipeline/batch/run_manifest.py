"""What the manifest of a run says of the files that lie beside it, if it was written for them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from footfit.errors import BadManifest, FootfitError
from footfit.number_words import plain
from footfit.pipeline.batch.manifest import LABEL_HEIGHTS, read_manifest
from footfit.pipeline.batch.sources import (
    RUN_MANIFEST,
    ManifestRow,
    ReadingOptions,
    Said,
    Source,
    content_hash,
    lies_beside_a_manifest,
)
from footfit.results import Notice

STANDS = "stance_by_run"
"""The notice of a last that stands as its run's manifest says."""
UNUSED = "run_manifest_unused"
"""The notice of a last that stands by its shape alone, though a manifest has its name."""
OF_CONTENT = "base_in_catalogue"
"""The notice of a base that was given as a file, and whose content a last of the catalogue has."""
OF_RUNS = (STANDS, UNUSED, OF_CONTENT)
BY_SHAPE = "so it stands by its shape alone: give --heel-height if you know it"
OR_EMPTY = "so it stands by its shape alone: empty its sha256 if its heights still count"
"""What a doubt ends with; the second one if the user has named the manifest."""


def with_said(source: Source) -> Source:
    """A source with what the manifest beside its file says of it, if that was not looked up yet."""
    if source.said is not None:
        return source
    said = said_beside(source) if lies_beside_a_manifest(source) else Said()
    return replace(source, said=said)


def said_beside(source: Source) -> Said:
    """What the manifest in the folder of a file says of it.

    A line counts if it has the name of the file and the SHA-256 of its content. A file that was
    changed after the manifest was written, or another one of that name, has its own stance.
    """
    path = Path(source.path or "-")
    manifest = path.parent / RUN_MANIFEST
    try:
        rows = read_manifest(manifest)
    except BadManifest:
        if not _names(manifest, path.name):
            return Said()
        words = f"{RUN_MANIFEST} beside it is not understood, so it stands by its shape alone"
        return Said(doubt=f"{words}: check-run says what is wrong in it")
    resolved = path.resolve()
    row = next((row for row in rows if Path(row.path).resolve() == resolved), None)
    return Said() if row is None else said_in(row, source, f"{RUN_MANIFEST} beside it")


def said_in(row: ManifestRow, source: Source, manifest: str, *, trusted: bool = False) -> Said:
    """What a line says of its file; ``manifest`` is the noun of a doubt.

    A line without a hash counts only if it is ``trusted``: the user has named its manifest.
    """
    if row.sha256 is None:
        if trusted or not row.says_how_it_stands:
            return Said(row if trusted else None)
        words = f"{manifest} says {_heights(row)} without a sha256"
        return Said(doubt=f"{words}, {BY_SHAPE}")
    try:
        if content_hash(source) == row.sha256:
            return Said(row)
    except FootfitError:  # the file is not there, for example: its reading says so
        return Said()
    if not row.says_how_it_stands:
        return Said()
    words = f"{manifest} was written for another content of this file (sha256)"
    return Said(doubt=f"{words}, {OR_EMPTY if trusted else BY_SHAPE}")


def as_said(source: Source, reading: ReadingOptions) -> tuple[ReadingOptions, tuple[Notice, ...]]:
    """How a source is read with what its manifest says, and what is to be said of that.

    Options that were given win: a height over all heights of the manifest.
    """
    said = source.said or said_beside(source)
    own = any(getattr(reading, name) is not None for name in LABEL_HEIGHTS)
    if reading.kind == "foot" or (said.row is None and (own or not said.doubt)):
        return reading, ()
    if said.row is None:
        return reading, (Notice(UNUSED, said.doubt),)
    row = said.row
    units = row.reading.units
    if units != "auto" and (reading.units not in ("auto", units) or reading.known_length_mm):
        words = f"its scale is given, and not that of {RUN_MANIFEST}, {BY_SHAPE}"
        return reading, () if own or not row.says_how_it_stands else (Notice(UNUSED, words),)
    side = row.reading.side if reading.side == "auto" else reading.side
    kind = "last" if reading.kind == "auto" and row.sha256 is not None else reading.kind
    read = replace(reading, units=units if reading.units == "auto" else reading.units)
    read = replace(read, side=side, kind=kind)
    if own or not row.says_how_it_stands:
        return read, ()
    read = replace(read, **{name: getattr(row.labels, name) for name in LABEL_HEIGHTS})
    words = f"it stands as {RUN_MANIFEST} beside it says: {_heights(row)}"
    return read, (Notice(STANDS, words),)


def said_notices(notices: Iterable[Notice], path: str | None) -> tuple[Notice, ...]:
    """Those of some notices that say what a manifest did, as notices about the file ``path``."""
    return tuple(replace(each, path=path) for each in notices if each.code in OF_RUNS)


def _heights(row: ManifestRow) -> str:
    """The heights of a line in words."""
    known = ((name, getattr(row.labels, name)) for name in LABEL_HEIGHTS)
    words = (
        f"{name.removesuffix('_mm').replace('_', ' ')} {plain(value)} mm"
        for name, value in known
        if value is not None
    )
    return ", ".join(words)


def _names(manifest: Path, name: str) -> bool:
    """Whether the bytes of a file that is no manifest hold the name of another file."""
    try:
        data = manifest.read_bytes()
    except OSError:
        return False
    return name.encode() in data or name.encode("utf-16-le") in data
