"""The lasts of a run: a family of the catalogue, or files whose names say the sizes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from footfit.catalogue.rows.last_names import meant_name, nearest_name
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, FootfitError, OtherKind, UnknownLast, UnreadableFile
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.stance.stance import Stance
from footfit.locations import Location
from footfit.number_words import first_names
from footfit.pipeline.batch.manifest import read_manifest
from footfit.pipeline.batch.run_manifest import UNUSED, said_in
from footfit.pipeline.batch.runs import HERE, outcomes
from footfit.pipeline.batch.sources import RUN_MANIFEST, ManifestRow, Said, Source
from footfit.pipeline.graded_runs.run_increments import BY_SHAPE, CHECKED, MOST_NAMED
from footfit.pipeline.graded_runs.run_sizes import SizeLabel, size_in_name, size_number
from footfit.pipeline.scan.measure import measured_scan
from footfit.pipeline.scan.preparation import stored_shape
from footfit.pipeline.scan.reading import AS_FOUND, aligned_source
from footfit.pipeline.scan.standing import heights_by_shape, stance_labels
from footfit.results import LastLabels, LastRecord, Measure, MeasuredScan, Notice
from footfit.results.last_making.run_check import RunLast


def family_lasts(catalogue: Location, family: str) -> tuple[RunLast, ...]:
    """The lasts of a family, with the sizes of their labels; none if no last has that label.

    Raises
    ------
    BadOption
        A last of the family has no size that is a number.
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    """
    with open_catalogue(catalogue) as opened:
        records = opened.lasts(family=family).records
        return tuple(stored_last(record, _stored_stance(opened, record)) for record in records)


def stored_last(record: LastRecord, stance: Stance | None = None) -> RunLast:
    """A last of the catalogue as a run has it; raises BadOption if its size is not known.

    The ``stance`` of a last that stands by its label says how its shape alone stands.
    """
    labels = record.labels
    number = size_number(labels.size, labels.size_system, labels.name)
    label = _labelled(labels, "catalogue")
    last = _last(labels.name, label, number, record.side.side, record.measures)
    return _stands(last, record.stance_by, stance)


def _stored_stance(opened: Catalogue, record: LastRecord) -> Stance | None:
    """How the mesh copy of a last stands that stands by its label; None if there is no copy."""
    if record.stance_by != "label":
        return None
    with suppress(UnknownLast):
        shape = stored_shape(opened.mesh_copy(record.labels.name).data, record.side.side)
        return Shape(*shape, "last", stance_labels(record.labels)).stance
    return None


def named_lasts(catalogue: Location, names: Sequence[str]) -> tuple[RunLast, ...]:
    """Lasts of the catalogue by their names, as a run has them.

    Raises
    ------
    UnknownLast, BadOption
        There is no last of a name, which no family has either; its size is not known.
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    """
    if not names:
        return ()
    with open_catalogue(catalogue) as opened:
        known = opened.names()
        for name in names:
            if meant_name(known, name) is None:
                near = nearest_name(known, name)
                nearest = "" if near is None else f" (the nearest last is {near!r})"
                words = f"no last and no family is named {name!r}{nearest}"
                raise UnknownLast(f"{words}; see footfit list-lasts")
        records = [opened.record(name) for name in names]
        return tuple(stored_last(record, _stored_stance(opened, record)) for record in records)


def file_lasts(
    sources: Sequence[Source], manifest: Sequence[ManifestRow] | None = None, jobs: int = HERE
) -> tuple[tuple[RunLast, ...], tuple[FootfitError, ...], tuple[Notice, ...]]:
    """Files as a run has them: measured, with the sizes of a manifest, or else of their names; the
    errors of those that cannot be read or measured; and what is odd in the manifest.

    Without a manifest, those that lie beside the files are read.

    Raises
    ------
    BadOption
        A file's size is not known.
    BadManifest
        A manifest beside the files is not understood.
    UnreadableFile
        A file is not there.
    """
    known = _beside(sources) if manifest is None else manifest
    rows = {str(Path(row.path).resolve()): row for row in known}
    labels = {source.path: _label(source, rows) for source in sources}
    sources = [replace(source, said=_said(source, rows)) for source in sources]
    lasts, errors = [], []
    for outcome in outcomes(_measured, sources, jobs):
        if outcome.error is not None:
            errors.append(outcome.error)
            continue
        assert outcome.value is not None
        scan, stance = outcome.value
        label = labels[outcome.item.path]
        name = Path(outcome.item.path or "-").name
        number = size_number(label.size, label.size_system, name)
        last = _last(name, label, number, scan.alignment.side.side, scan.measures)
        lasts.append(_stands(last, None if stance is None else stance.decided_by, stance))
    return tuple(lasts), tuple(errors), (*_odd(known), *_doubts(sources))


def _odd(rows: Sequence[ManifestRow]) -> Iterator[Notice]:
    """A warning for files of a manifest that are not there, and for one that says no size."""
    missing = [Path(row.path).name for row in rows if not Path(row.path).exists()]
    if missing:
        words = f"the manifest names {first_names(missing, MOST_NAMED)}, and there is no such file"
        yield Notice("manifest_file_missing", f"{words}: does the run lack a last?")
    if rows and not any(row.labels.size for row in rows):
        words = "the manifest says no size: the sizes are those in the names of the files"
        yield Notice("manifest_without_sizes", words)


def _beside(sources: Iterable[Source]) -> list[ManifestRow]:
    """The rows of the manifests in the folders of files."""
    folders = dict.fromkeys(Path(source.path).parent for source in sources if source.path)
    beside = (folder / RUN_MANIFEST for folder in folders)
    return [row for path in beside if path.is_file() for row in read_manifest(path)]


def _doubts(sources: Iterable[Source]) -> Iterator[Notice]:
    """A warning for each file that is not the one that its line was written for."""
    for source in sources:
        if source.said is not None and source.said.doubt:
            yield Notice(UNUSED, f"{Path(source.path or '-').name}: {source.said.doubt}")


def _measured(source: Source) -> tuple[MeasuredScan, Stance | None]:
    """A last, and how it stands; raises OtherKind for a foot."""
    aligned = aligned_source(source, AS_FOUND)
    if aligned.alignment.pose.kind == "foot":
        raise OtherKind("its shape is a foot's, not a last's: take it out of the run", source.path)
    return measured_scan(aligned), aligned.prepared.shape.stance


def _said(source: Source, rows: Mapping[str, ManifestRow]) -> Said:
    """What the manifest says of a file. The user has it for this run, so it needs no hashes."""
    row = rows.get(str(Path(source.path or "-").resolve()))
    return Said() if row is None else said_in(row, source, "the manifest", trusted=True)


def _labelled(labels: LastLabels, size_from: str) -> SizeLabel:
    """What labels say of a last's place in a run."""
    return SizeLabel(
        size=str(labels.size),
        width=labels.width_label,
        size_from=size_from,
        size_system=labels.size_system,
        style=labels.style,
        family=labels.family,
    )


def _label(source: Source, rows: Mapping[str, ManifestRow]) -> SizeLabel:
    """The size of a file and its system."""
    path = Path(source.path or "-")
    row = rows.get(str(path.resolve()))
    if row is not None and row.labels.size is not None:
        return _labelled(row.labels, "manifest")
    label = size_in_name(path.stem)
    if label is None and source.path is not None and not path.exists():
        raise UnreadableFile("there is no such file, folder or family: check the name", str(path))
    if label is None:
        words = "its name says no size: write the size into the name, such as derby-42.stl, or add"
        raise BadOption(
            f"{words} --manifest CSV with the columns path, size and width_label", str(path)
        )
    if row is not None:
        said = row.labels
        system, style = said.size_system or label.size_system, said.style or label.style
        return replace(label, size_system=system, style=style, family=said.family)
    return label


def _last(
    name: str, label: SizeLabel, number: float, side: str | None, measures: Iterable[Measure]
) -> RunLast:
    rows = {row.name: row.measured for row in measures}
    known = {name: mm for name in CHECKED if name in rows and (mm := rows[name].value) is not None}
    sd_mm = {name: rows[name].sd or 0.0 for name in known}
    last = RunLast(name, label.size, number, label.width, side, label.size_from, known)
    return replace(
        last,
        sd_mm=sd_mm,
        size_system=label.size_system,
        style=label.style,
        family=label.family,
    )


def _stands(last: RunLast, stands_by: str | None, stance: Stance | None) -> RunLast:
    """The last with what it stands by, and of one that stands by its label its heights by shape."""
    by_shape = heights_by_shape(stance) if stands_by == "label" else {}
    heights = {f"{name}{BY_SHAPE}": height_mm for name, height_mm in by_shape.items()}
    return replace(last, stands_by=stands_by, measures_mm={**last.measures_mm, **heights})
