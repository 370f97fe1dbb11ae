"""The library of lasts: list, show, rename, remove, export, set the reference."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, EmptyCatalogue, NoReference
from footfit.geometry.measures.measure_table import of_kind
from footfit.results import (
    CatalogueFacts,
    LastRecord,
    Library,
    MeshCopy,
    Method,
    Notice,
    Reference,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    StoredLast,
)

FIRST_STEPS = "type: footfit ingest-last FOLDER, or try: footfit demo"


def listed(path: Path) -> Library:
    """Every intact last by name, whatever its definition; damaged ones are said.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    """
    with open_catalogue(path) as catalogue:
        records, names, reference = catalogue.records(), catalogue.names(), catalogue.reference()
    intact = {record.labels.name for record in records}
    return Library(
        lasts=records,
        total=len(names),
        reference=reference.last if reference else None,
        warnings=tuple(_damaged(name) for name in names if name not in intact),
    )


def last(path: Path, name: str) -> StoredLast:
    """One last, and the reference's name.

    Raises
    ------
    UnknownLast
        There is no last of that name.
    """
    with open_catalogue(path) as catalogue:
        reference = catalogue.reference()
        return StoredLast(catalogue.record(name), reference.last if reference else None)


def set_reference(path: Path, name: str) -> ReferenceOutcome:
    """Make a last the paper's "first model": every stored ``paper_transform`` is rewritten, in
    one transaction and without the mesh files.

    Raises
    ------
    NoCatalogue, UnknownLast, CatalogueUnusable
        There is no such last, or the catalogue cannot be written; nothing is changed.
    """
    with open_catalogue(path, write=True, create=False) as catalogue:
        return ReferenceOutcome(catalogue.set_reference(name), len(catalogue.names()))


def rename(path: Path, name: str, new_name: str) -> RenameOutcome:
    """Give a last another name.

    Raises
    ------
    UnknownLast, NameTaken
        The one is not there, or the other is.
    """
    with open_catalogue(path, write=True, create=False) as catalogue:
        catalogue.rename(name, new_name)
    return RenameOutcome(new_name, name)


def remove(path: Path, name: str) -> RemoveOutcome:
    """Remove a last; the reference is refused.

    Raises
    ------
    UnknownLast, BadOption
        There is no such last, or it is the reference.
    """
    with open_catalogue(path, write=True, create=False) as catalogue:
        catalogue.remove(name)
    return RemoveOutcome(name)


def mesh_copy(path: Path, name: str) -> MeshCopy:
    """The catalogue's copy of a last's mesh, canonical mm.

    Raises
    ------
    UnknownLast
        There is no last of that name.
    """
    with open_catalogue(path) as catalogue:
        return catalogue.mesh_copy(name)


def facts(path: Path) -> CatalogueFacts:
    """What the catalogue is and holds."""
    with open_catalogue(path) as catalogue:
        return catalogue.summary()


def library(path: Path, style: str | None = None, size_system: str | None = None) -> Library:
    """The lasts to match against; a damaged one is left out and said.

    Raises
    ------
    NoCatalogue, EmptyCatalogue
        There is nothing to match against; the message says what to type.
    """
    with open_catalogue(path) as catalogue:
        total = len(catalogue.names())
        if not total:
            raise EmptyCatalogue(f"the catalogue holds no last; {FIRST_STEPS}", str(path))
        rows = catalogue.rows_for_search(style=style, size_system=size_system)
        reference = catalogue.reference()
    return Library(
        lasts=rows.records,
        total=total,
        reference=reference.last if reference else None,
        rejected=rows.rejected,
        warnings=(
            *(_damaged(name) for name in rows.damaged),
            *(_outdated(name) for name in rows.outdated),
            *_measured_otherwise(rows.records),
        ),
    )


def _damaged(name: str) -> Notice:
    words = f"{name} was left out: it is damaged; ingest it again with --replace"
    return Notice("damaged_last", words)


def _outdated(name: str) -> Notice:
    words = f"{name} was left out: its profile is older; type: footfit upgrade-catalogue"
    return Notice("outdated_last", words)


def _measured_otherwise(records: Sequence[LastRecord]) -> list[Notice]:
    """What to do where lasts were measured by other definitions than this version's."""
    wanted = {kind: {entry.definition_id for entry in of_kind(kind)} for kind in ("foot", "last")}
    other = [
        record.labels.name
        for record in records
        if {measure.definition for measure in record.measures} != wanted[record.pose.kind]
    ]
    if not other:
        return []
    which = other[0] if len(other) == 1 else f"{len(other)} of {len(records)} lasts"
    verb = "was" if len(other) == 1 else "were"
    words = f"{which} {verb} measured by other definitions: zones whose definition changed are not"
    return [Notice("other_measures", f"{words} judged; type: footfit upgrade-catalogue")]


def alignment_reference(path: Path, method: Method, to: str | None) -> Reference | None:
    """The reference that an alignment needs: of ``to``, of the catalogue, or none.

    Raises
    ------
    NoCatalogue, NoReference
        A paper method needs a reference last and there is none.
    BadOption
        ``to`` for a method that uses no reference.
    """
    if method == "footfit":
        if to is not None:
            raise BadOption("--to goes with --method paper or paper-literal")
        return None
    with open_catalogue(path) as catalogue:
        if to is not None:
            return catalogue.as_reference(to)
        reference = catalogue.reference()
    if reference is None:
        raise NoReference(f"the paper's methods need a reference last; {FIRST_STEPS}", str(path))
    return reference
