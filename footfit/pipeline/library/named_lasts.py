"""Lasts of the catalogue in place of mesh files: a stored last, as the work on a scan gives it."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from footfit.catalogue.rows.last_names import caseless, meant_name, nearest_name
from footfit.catalogue.store import open_catalogue
from footfit.errors import (
    CatalogueUnusable,
    FootfitError,
    NoCatalogue,
    NotInCatalogue,
    UnknownLast,
    UnreadableFile,
)
from footfit.geometry.measures.landmarks import Shape
from footfit.locations import Location
from footfit.meshes.copies.compact_copy import expanded_mesh
from footfit.number_words import bound_words
from footfit.pipeline.batch.sources import GLOB_CHARACTERS, MESH_SUFFIXES, Source, is_no_path
from footfit.pipeline.library.lasts import has_other_measures
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.preparation import stored_shape
from footfit.pipeline.scan.standing import last_stance, stance_labels
from footfit.results import LastRecord, MeshCopy, Notice, PreparedScan, Profiled
from footfit.results.meshes import FROM_CATALOGUE
from footfit.results.values import fields

LOOK_WAIT_S = 0.5
"""How long footfit waits for a locked catalogue, to see whether it has a last of a file's name."""


@dataclass(frozen=True, slots=True)
class NamedLast:
    """What was typed in place of a mesh file, and the catalogue in which it may be a last."""

    catalogue: Location
    name: str

    def __call__(self) -> Profiled:
        """The last of that name.

        Raises
        ------
        UnreadableFile
            There is no such file; the message gives the nearest name of a last.
        UnknownLast, CatalogueUnusable
            It is a name, not a path, and there is no such last; the last was stored without its
            mesh; it, or the catalogue, cannot be read.
        """
        no_file = UnreadableFile("there is no such file", self.name)
        try:
            with open_catalogue(self.catalogue) as opened:
                names = opened.names()
        except NoCatalogue as error:
            raise no_file from error
        except CatalogueUnusable as error:
            if is_bare(self.name):
                raise
            raise no_file from error
        name = meant_name(names, self.name)
        if name is not None:
            return profiled_last(self.catalogue, name)
        near = nearest_name(names, self.name)
        if near is None and not is_bare(self.name):
            raise no_file
        words = "" if near is None else f"; the nearest name of a last is {near!r}"
        unknown = UnknownLast if is_bare(self.name) else UnreadableFile
        raise unknown(f"there is no such file or last{words}", self.name)


def is_bare(argument: str) -> bool:
    """Whether an argument looks like a name, without a folder and without a mesh file's suffix.

    Examples
    --------
    >>> is_bare("derby-40"), is_bare("lasts/derby-40"), is_bare("derby-40.STL")
    (True, False, False)
    """
    return Path(argument).name == argument and Path(argument).suffix.lower() not in MESH_SUFFIXES


def names_a_last(argument: str) -> bool:
    """Whether an argument that is no path can be a name: it is bare, and no pattern.

    Examples
    --------
    >>> names_a_last("derby"), names_a_last("run/derby-*.stl"), names_a_last("derby-40.stl")
    (True, False, False)
    """
    return is_bare(argument) and not GLOB_CHARACTERS & set(argument)


def named_sources(arguments: Sequence[str], catalogue: Location) -> dict[str, Source]:
    """A source for each argument that is no file: it may be a last of the catalogue.

    A pattern counts as a name only if the catalogue has a last of that name.
    """
    return {
        argument: Source(argument, stored=NamedLast(catalogue, argument))
        for argument in arguments
        if is_no_path(argument)
        if not GLOB_CHARACTERS & set(argument) or stored_name(catalogue, argument)
    }


def hidden_lasts(arguments: Sequence[str], catalogue: Location) -> tuple[Notice, ...]:
    """A notice for each argument that is a file, or a folder, and also the name of a last.

    Nothing is said if the catalogue cannot be read: files need none.
    """
    names: Sequence[str] = ()
    with (
        suppress(FootfitError),
        open_catalogue(catalogue, busy_timeout_s=LOOK_WAIT_S) as opened,
    ):
        names = opened.names()
    known = {caseless(name): name for name in names}
    return tuple(
        Notice(
            "file_before_last",
            f"{argument}: there is a file or folder here, so the last {name!r} is not read",
        )
        for argument in arguments
        if (name := known.get(caseless(argument))) is not None
    )


def stored_name(catalogue: Location, name: str) -> str | None:
    """The stored name that a name means; None if there is none, or the catalogue cannot be read."""
    with suppress(FootfitError), open_catalogue(catalogue) as opened:
        return opened.name(name)
    return None


def stored_names(catalogue: Location) -> dict[str, str]:
    """The names of a catalogue by their caseless forms; none if there is no catalogue."""
    with suppress(NotInCatalogue), open_catalogue(catalogue) as opened:
        return {caseless(name): name for name in opened.names()}
    return {}


def profiled_last(catalogue: Location, name: str) -> Profiled:
    """A stored last as a scan of it is, aligned, profiled and measured.

    Its flare and its measures are the stored ones, taken from the scan. Its mesh is the stored
    copy, in the canonical frame; a notice says how far that lies from the scan.

    Raises
    ------
    NoCatalogue, UnknownLast, CatalogueUnusable
        There is no such last, or it was stored without its mesh; it cannot be read.
    """
    with open_catalogue(catalogue) as opened:
        record = opened.record(name)
        copy = opened.mesh_copy(record.labels.name)
    aligned = aligned_scan(_prepared(record, copy))
    return Profiled(aligned, record.flare, record.measures, labels=fields(record.labels))


def _prepared(record: LastRecord, copy: MeshCopy) -> PreparedScan:
    vertices_mm, faces = expanded_mesh(copy.data)
    right = stored_shape(copy.data, record.side.side)
    shape = Shape(*right, record.pose.kind, stance_labels(record.labels))
    info = replace(
        record.info,
        path=record.labels.name,
        format=FROM_CATALOGUE,
        vertices=len(vertices_mm),
        faces=len(faces),
        units="mm",
        units_source="declared",
        unit_scale=1.0,
        step=max(record.info.resolution_mm, copy.error_mm),
    )
    return PreparedScan(
        info=info,
        side=record.side,
        pose=record.pose,
        canonical_transform=np.eye(4),
        length=record.length,
        extent_mm=record.extent_mm,
        stance=last_stance(shape, info),
        standing_transform=record.standing_transform,
        file_vertices_mm=vertices_mm,
        shape=shape,
        warnings=(*record.warnings, *_notices(record, copy)),
    )


def _notices(record: LastRecord, copy: MeshCopy) -> list[Notice]:
    """Where the shape comes from, and that its measures are older if they are."""
    words = (
        "this is the last of the catalogue: its measures were taken from the scan, and its mesh is"
        f" the stored copy, {bound_words(copy.error_mm)} from the scan"
    )
    older = "it was measured by other definitions; type: footfit upgrade-catalogue"
    notices = [Notice("stored_copy", words)]
    return [*notices, Notice("other_measures", older)] if has_other_measures(record) else notices
