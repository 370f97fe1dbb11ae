"""The demo: the paper's five steps on the sample data, in its own folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, GeometryRefused, OutputExists
from footfit.pipeline.batch.sources import ReadingOptions, Source, mesh_sources
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.library.ingest import entries, ingest
from footfit.pipeline.library.lasts import library
from footfit.pipeline.library.manifest import read_manifest
from footfit.pipeline.sample_data import sample_folder
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import IngestOutcome, LastLabels, Match, Profiled, ReferenceOutcome

CATALOGUE_NAME = "demo.footfit"


@dataclass(frozen=True, slots=True)
class Demonstration:
    """The results of the demo's steps."""

    catalogue: Path
    ingested: tuple[IngestOutcome, ...]
    reference: ReferenceOutcome
    foot: Profiled
    match: Match


def demonstrate(folder: Path, *, jobs: int = 1, replace: bool = False) -> Demonstration:
    """Ingest the sample lasts into a new catalogue, choose a reference, and match a sample foot.

    Raises
    ------
    OutputExists
        The folder holds a demo already and ``replace`` is not given.
    UnreadableFile
        The sample data is missing.
    """
    catalogue = _fresh_catalogue(folder, replace=replace)
    samples = sample_folder()
    batch = entries([], read_manifest(samples / "lasts.csv"), LastLabels(""), ReadingOptions())
    ingested = tuple(ingest(batch, catalogue, jobs=jobs))
    for outcome in ingested:
        if outcome.failure is not None:
            raise GeometryRefused(f"a sample last was refused: {outcome.failure}", outcome.path)
    middle = sorted(outcome.last or "" for outcome in ingested)[len(ingested) // 2]
    with open_catalogue(catalogue, write=True) as opened:
        reference = opened.set_reference(middle)
    foot = profiled_source(sample_foot(), ReadingOptions())
    match = matched([foot], library(catalogue), Question())
    return Demonstration(catalogue, ingested, reference, foot, match)


def sample_foot() -> Source:
    """The first of the sample feet, in the order of their names."""
    return mesh_sources([str(sample_folder() / "feet")])[0]


def _fresh_catalogue(folder: Path, *, replace: bool) -> Path:
    """The path of the demo's catalogue; an old demo's is deleted."""
    catalogue = folder / CATALOGUE_NAME
    if folder.exists() and not folder.is_dir():
        raise BadOption("is a file; name a folder for the demo", str(folder))
    if catalogue.exists():
        if not replace:
            raise OutputExists("holds a demo already; add --force to replace it", str(folder))
        catalogue.unlink()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadOption(f"cannot be made: {error.strerror}", str(folder)) from error
    return catalogue
