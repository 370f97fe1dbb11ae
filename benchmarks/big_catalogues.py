"""Big catalogues for benchmarks: measured lasts, each perturbed many times."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from footfit.api.catalogues import open_catalogue
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue as catalogue_at
from footfit.results import LastRecord, Measure, ShapeSections

ROOT = Path(__file__).resolve().parents[1]
SAMPLES = ROOT / "sample_data"
STYLES = 60
WIDTHS = ("F", "G", "H", "K", "M")
SIZES = (0.82, 1.18)
"""How much smaller or larger than the measured last the others are."""
NOISE = 0.012
"""The standard deviation of each measure, as a share: lasts of other models."""
FLARE_DEG = 3.0


def measured_lasts(folder: Path) -> list[NewLast]:
    """The sample lasts, read and measured by an ingest into a folder, with their sections."""
    path = folder / "measured.footfit"
    with open_catalogue(path) as lasts:
        lasts.ingest(str(SAMPLES / "lasts"), manifest=SAMPLES / "lasts.csv", jobs=2)
    return ready_lasts(path)


def ready_lasts(path: Path) -> list[NewLast]:
    """The lasts of a catalogue with their sections, ready to be added to another one."""
    with catalogue_at(path) as catalogue:
        names = catalogue.names()
        return [NewLast(catalogue.record(name), None, catalogue.sections(name)) for name in names]


def perturbed_lasts(measured: Sequence[NewLast], count: int, seed: int) -> Iterator[NewLast]:
    """So many lasts, each a measured one in another size, with other measures and flare."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        base = measured[number % len(measured)]
        assert base.sections is not None
        size = float(rng.uniform(*SIZES))
        record = _record(base.record, number, size, rng)
        outline = base.sections.toes_outline_mm
        sections = ShapeSections(
            base.sections.sections, None if outline is None else size * outline
        )
        yield NewLast(record, None, sections)


def _record(base: LastRecord, number: int, size: float, rng: np.random.Generator) -> LastRecord:
    style, noise = f"style-{number % STYLES:02d}", rng.normal(1.0, NOISE, len(base.measures))
    measures = tuple(
        _scaled(measure, size * float(factor))
        for measure, factor in zip(base.measures, noise, strict=True)
    )
    shift = rng.normal(0.0, 0.4)
    flare = replace(
        base.flare,
        angle_deg=base.flare.angle_deg + float(rng.normal(0.0, FLARE_DEG)),
        curvature={
            name: None if curve is None else curve + shift * rng.normal(1.0, 0.1, len(curve))
            for name, curve in base.flare.curvature.items()
        },
    )
    labels = replace(
        base.labels,
        name=f"{style}-{number:07d}",
        style=style,
        size=str(round(40 * size)),
        width_label=WIDTHS[number % len(WIDTHS)],
        parent=None,
    )
    sha256 = hashlib.sha256(f"{number}".encode()).hexdigest()
    return replace(
        base,
        labels=labels,
        info=replace(base.info, sha256=sha256),
        measures=measures,
        flare=flare,
        extent_mm=base.extent_mm * size,
        warnings=(),
    )


def _scaled(measure: Measure, factor: float) -> Measure:
    """A measure of a larger last; an angle stays."""
    measured = measure.measured
    if measured.value is None or measure.name.endswith("_deg"):
        return measure
    return replace(measure, measured=replace(measured, value=measured.value * factor))


def make_catalogue(path: Path, measured: Sequence[NewLast], count: int, seed: int) -> None:
    """Write a catalogue of so many lasts."""
    with catalogue_at(path, write=True) as catalogue:
        for _ in catalogue.add_many(perturbed_lasts(measured, count, seed)):
            pass
