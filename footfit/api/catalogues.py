"""A catalogue of lasts in a ``with`` block: ingest lasts, list them, match and compare feet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, Unpack

from footfit import results
from footfit.api.catalogue_file import CatalogueFile
from footfit.api.inputs import (
    CompareKeywords,
    Feet,
    FilePath,
    IngestKeywords,
    LabelKeywords,
    MatchKeywords,
    Meshes,
    Shape,
    growth_options,
    heel_options,
    known_keywords,
    reading_options,
    stance_keywords,
    worn_options,
)
from footfit.api.scans import aligned_shape, profiled_shape, sources
from footfit.catalogue.catalogue_reader import open_reader
from footfit.catalogue.file.opening import FIRST_STEPS
from footfit.errors import BadOption, NoReference
from footfit.locations import LocationName, location_of
from footfit.pipeline.batch.runs import HERE, Jobs, Outcome
from footfit.pipeline.batch.sources import Source
from footfit.pipeline.customers.customer import Customer, alone, one_pair
from footfit.pipeline.library import lasts

if TYPE_CHECKING:
    from footfit.api.wearers import FitLog
    from footfit.catalogue import store
    from footfit.catalogue.group_commit import NewLast
    from footfit.pipeline.fit.match import Question
    from footfit.pipeline.library.entries import Entry
    from footfit.pipeline.library.ingest import HoldSignals, KeepMesh
    from footfit.pipeline.shelf.shelf import Shelf
    from footfit.results.last_making.section_table import SectionTable

NO_LABELS = results.LastLabels("")
"""Nothing is said of a last: its name is that of its file."""


def open_catalogue(path: LocationName) -> Catalogue:
    """The catalogue of lasts in a file, or at the address of a server, for a ``with`` block.

    Only `Catalogue.ingest` makes one.
    """
    return Catalogue(location_of(path))


@known_keywords(MatchKeywords)
def match(feet: Feet, catalogue: LocationName, **question: Unpack[MatchKeywords]) -> results.Match:
    """The lasts of a catalogue that fit one foot, or the two feet of one customer.

    Raises
    ------
    NotInCatalogue, CatalogueUnusable, InputError, GeometryRefused
        As `Catalogue.match`.
    """
    with open_catalogue(catalogue) as lasts:
        return lasts.match(feet, **question)


class Catalogue(CatalogueFile):
    """A catalogue of lasts. Its methods raise NoCatalogue if there is no file, and
    CatalogueUnusable if the file cannot be used.

    The lasts for a match are read once, and again after this object has changed a last.
    """

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._chosen.clear()

    # ------------------------------------------------------------ feet

    @known_keywords(MatchKeywords)
    def match(self, feet: Feet, **question: Unpack[MatchKeywords]) -> results.Match:
        """The lasts that fit one foot, or the list of the two feet of one customer.

        Raises
        ------
        NoCandidate, EmptyCatalogue
            No last passes the filters, or there is none.
        BadOption
            There is no such profile or size system, or there are more than two feet.
        SameSide
            Both feet of the pair are of one side.
        InputError, GeometryRefused
            As `flare`; HalfScan if the length of a foot is not known.
        """
        from footfit.pipeline.customers.matches import answered
        from footfit.pipeline.customers.pair_sides import pair_of_feet

        asked = self._question(question)
        given: list[Any] = feet if isinstance(feet, list) else [feet]
        if len(given) not in (1, 2):
            raise BadOption(f"a match takes one foot, or the two of one customer, not {len(given)}")
        shapes = pair_of_feet([aligned_shape(foot, question) for foot in given])
        return answered(shapes, self._choice(question), asked)

    @known_keywords(MatchKeywords)
    def match_each(
        self,
        feet: Meshes | list[Customer],
        *,
        pair: bool = False,
        jobs: Jobs = HERE,
        **question: Unpack[MatchKeywords],
    ) -> Iterator[Outcome[Customer, results.Match]]:
        """An outcome for each of many feet, as `outcomes` gives it; a ``pair`` of feet has one.

        What `customers` gives has an outcome for each customer.

        Raises
        ------
        BadOption
            A pair does not have two feet; there is no such profile or size system.
        """
        from footfit.pipeline.customers.matches import matches

        asked, reading = self._question(question), reading_options(question)
        library = self._choice(question)
        given: list[Any] = feet if isinstance(feet, list) else [feet]
        if not given or not all(isinstance(each, Customer) for each in given):
            given = (one_pair if pair else alone)(sources(given))
        return matches(given, reading, library, asked, jobs=jobs)

    @known_keywords(CompareKeywords)
    def compare(
        self, foot: Shape, last: str, **reading: Unpack[CompareKeywords]
    ) -> results.Comparison:
        """A foot, or another last, in a stored last.

        Raises
        ------
        UnknownLast
            There is no last of that name.
        BadOption
            It is said how the last stands: a stored last has its own labels.
        InputError, GeometryRefused
            As `flare`; or the foot cannot be placed in the last.
        """
        from footfit.pipeline.fit.compare import compared, stored_last

        if stance_keywords(reading):
            words = "a stored last stands as it was stored; to change its labels, type"
            raise BadOption(f"{words}: footfit edit-last {last} --heel-height MM")
        around = stored_last(self.path, last)
        return compared(profiled_shape(foot, reading), around, heel_options(reading))

    @property
    def fit_log(self) -> FitLog:
        """What wearers said of shoes on these lasts."""
        from footfit.api.wearers import FitLog

        return FitLog(self.path)

    def _question(self, question: MatchKeywords) -> Question:
        from footfit.pipeline.fit.fit_profile import fit_profile
        from footfit.pipeline.fit.match import Question

        return Question(
            by=question.get("by", "fit"),
            top=question.get("top", 5),
            profile=fit_profile(question.get("profile", "walking")),
            size_system=question.get("size_system"),
            surfaces_in=self.path if question.get("clearance") else None,
            heel=heel_options(question),
            worn=worn_options(question),
            growth=growth_options(question),
            force_foot=question.get("force_foot", False),
        )

    def _choice(self, question: MatchKeywords) -> Shelf:
        from footfit.pipeline.shelf.candidates import choice, in_stock

        filters = question.get("style"), question.get("size_system")
        if filters not in self._chosen:
            self._chosen[filters] = choice(self.path, *filters)
        stock, chosen = question.get("stock"), self._chosen[filters]
        return chosen if stock is None else in_stock(chosen, Path(stock))

    @contextmanager
    def _written(self, *, create: bool = False) -> Iterator[store.Catalogue]:
        """The catalogue, open for a change; a missing one is made if ``create`` says so."""
        from footfit.catalogue import store

        self._chosen.clear()
        with store.open_catalogue(self.path, write=True, create=create) as catalogue:
            yield catalogue

    # ------------------------------------------------------------ lasts

    @known_keywords(IngestKeywords)
    def ingest(
        self,
        lasts: Meshes | None = None,
        *,
        manifest: FilePath | None = None,
        labels: results.LastLabels = NO_LABELS,
        **options: Unpack[IngestKeywords],
    ) -> tuple[results.IngestOutcome, ...]:
        """Read, align, measure and store lasts; return the outcome of each file.

        Parameters
        ----------
        lasts : mesh or list of meshes, optional
            Files, folders and globs too. Without any, the manifest names the files.
        manifest : path, optional
            A CSV file with the labels of each last; docs/catalogue.md lists its columns.
        labels : LastLabels, optional
            Labels that the manifest does not give; a ``name`` only for a single last.
        **options
            See `IngestKeywords`.

        Raises
        ------
        BadOption, BadManifest
            There is nothing to ingest, one name for several files, or the manifest is not valid.
        """
        from footfit.pipeline.batch.manifest import read_manifest
        from footfit.pipeline.library.entries import entries

        rows = [] if manifest is None else read_manifest(Path(manifest))
        given = [] if lasts is None else sources(lasts)
        batch = entries(given, rows, labels, reading_options(options))
        each = self.ingest_each(
            batch,
            replace=options.get("replace", False),
            dry_run=options.get("dry_run", False),
            jobs=options.get("jobs", HERE),
            keep_mesh=options.get("keep_mesh"),
        )
        return tuple(each)

    def ingest_each(
        self,
        batch: Sequence[Entry],
        *,
        replace: bool = False,
        dry_run: bool = False,
        jobs: Jobs = HERE,
        keep_mesh: KeepMesh | None = None,
        hold_signals: HoldSignals = nullcontext,
    ) -> Iterator[results.IngestOutcome]:
        """Store entries of ``pipeline.library.ingest``; yield the outcome of each after its commit.

        ``hold_signals`` is a block that begins before a last is stored and ends when the next
        outcome is asked for.
        """
        from footfit.pipeline.library.ingest import ingest

        self._chosen.clear()
        return ingest(
            batch,
            self.path,
            jobs=jobs,
            replace=replace,
            dry_run=dry_run,
            keep_mesh=keep_mesh,
            hold_signals=hold_signals,
        )

    def add_many(
        self, lasts: Iterable[results.LastRecord | NewLast], *, replace: bool = False
    ) -> Iterator[str]:
        """Store lasts that are measured already; yield each name after the commit that holds it.

        A `NewLast` has what belongs to a record beside it: its mesh copy, its sections, its
        parentage. Lasts that come within 0.2 s, at most 512, share a commit. A missing catalogue
        is made.

        Raises
        ------
        NameTaken, UnknownLast, BadOption
            For the first last that cannot be stored; those before it are stored.
        """
        with self._written(create=True) as catalogue:
            yield from catalogue.add_many(lasts, replace=replace)

    def lasts(
        self,
        *,
        style: str | None = None,
        size: str | None = None,
        width_label: str | None = None,
        family: str | None = None,
        sort: str = "name",
    ) -> results.Library:
        """The intact lasts that have these labels; ``warnings`` name the damaged ones.

        ``sort`` is name, size, length, ball-girth, flare or heel.
        """
        labels = {"style": style, "size": size, "width_label": width_label, "family": family}
        return lasts.list_lasts(self.path, sort, **labels)

    def name(self, name: str) -> str:
        """The name of a last as it is stored, for one in any case; raises UnknownLast."""
        with open_reader(self.path) as catalogue:
            return catalogue.name(name)

    def last(self, name: str) -> results.StoredLast:
        """All that is stored of one last, except its mesh; raises UnknownLast."""
        return lasts.last(self.path, name)

    def shape(self, name: str) -> results.Profiled:
        """A last in place of a mesh, for `measure`, `flare` or `compare`; raises UnknownLast.

        Its measures and its flare are the stored ones; its mesh is the stored copy.
        """
        from footfit.pipeline.library.named_lasts import profiled_last

        return profiled_last(self.path, name)

    def sources(self, meshes: list[str], *, split: bool = False, **reading: Any) -> list[Source]:
        """Meshes as `footfit.sources` gives them; what is no file is the last of that name."""
        from footfit.pipeline.library.named_lasts import named_sources

        return sources(meshes, split=split, named=named_sources(meshes, self.path), **reading)

    def mesh(self, name: str, most_faces: int | None = None) -> results.MeshCopy:
        """The mesh copy of a last, for `mesh_file`; raises UnknownLast.

        With ``most_faces`` it is made lighter if it has more; ``error_mm`` says how far it then
        lies from the file's mesh at most.
        """
        from footfit.meshes.copies.compact_copy import limited_copy

        with open_reader(self.path) as catalogue:
            copy = catalogue.mesh_copy(name)
        return copy if most_faces is None else limited_copy(copy, most_faces)

    def sections(self, name: str, count: int = 20) -> SectionTable:
        """``count`` sections of a last along its bottom, and the named ones; raises UnknownLast.

        Its ``rows()`` are the sizes, the rows of its ``outlines()`` the points.
        """
        from footfit.pipeline.last_making.last_sections import section_table

        return section_table(self.shape(name), count)

    def rename(self, name: str, new_name: str) -> results.RenameOutcome:
        """Give a last another name; raises UnknownLast or NameTaken."""
        with self._written() as catalogue:
            return catalogue.rename(name, new_name)

    @known_keywords(LabelKeywords)
    def edit_last(self, name: str, **labels: Unpack[LabelKeywords]) -> results.EditOutcome:
        """Change labels of a last; raises UnknownLast, or BadOption for a value no last has."""
        from footfit.pipeline.library.edit import edit_last

        self._chosen.clear()
        return edit_last(self.path, name, labels)  # type: ignore[arg-type]

    def remove(self, name: str) -> results.RemoveOutcome:
        """Remove a last; raises UnknownLast, or BadOption for the reference."""
        with self._written() as catalogue:
            return catalogue.remove(name)

    def set_reference(self, name: str) -> results.ReferenceOutcome:
        """Make a last the one whose OM_E the paper's methods use; raises UnknownLast."""
        with self._written() as catalogue:
            return catalogue.set_reference(name)

    def reference(
        self, last: str | None = None, method: results.Method = "paper"
    ) -> results.Reference | None:
        """The reference for `align`: that of a last, or the catalogue's; None for "footfit".

        Raises
        ------
        NoReference, UnknownLast
            There is none, or no such last.
        BadOption
            A last for the method "footfit", which needs no reference.
        """
        if method == "footfit":
            if last is not None:
                raise BadOption("--to goes with --method paper or paper-literal")
            return None
        with open_reader(self.path) as catalogue:
            reference = catalogue.reference(last)
        if reference is None:
            words = f"the paper's methods need a reference last; {FIRST_STEPS}"
            raise NoReference(words, str(self.path))
        return reference
