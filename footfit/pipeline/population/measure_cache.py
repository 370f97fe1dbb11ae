"""A file that keeps the measures of scanned feet, so that a long run can go on.

It is JSON lines. Each line is written at once and is on the disk before the foot is counted, and it
has a hash of its own: a line that a crash tore is passed over. A foot is known by the hash of its
file, with how it was read and by which definitions. No name, no path and no scan is kept.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.fit.toe_walls import ToesPlan
from footfit.geometry.flare.definition import FlareDefinition, FlareProfile
from footfit.geometry.measures.measure_table import of_kind
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.pipeline.fit.judging.cells import ZoneShape
from footfit.pipeline.population.foot_measures import NO_CURVE, FootMeasures
from footfit.results import Measure, Measured
from footfit.version import __version__
from footfit.whole_files import require_folder, sync

SCHEMA = "footfit.foot-measures/1"
HEAD = json.dumps({"schema": SCHEMA}) + "\n"
KEYS = ("value", "sd", "reason", "total_sd", "bias")


def reading_key(reading: ReadingOptions) -> str:
    """A hash of how a foot is read and measured: with another one its measures may differ."""
    definitions = [entry.definition_id for entry in of_kind("foot")]
    known = [__version__, asdict(reading), definitions, asdict(FlareDefinition())]
    return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest()


@contextmanager
def measure_cache(
    path: Path, reading: ReadingOptions
) -> Iterator[tuple[Mapping[str, FootMeasures], Callable[[FootMeasures], None]]]:
    """Open the cache for a ``with`` block: the feet that it has by the hash of their files, and a
    function that adds one. A missing file is made.

    Raises
    ------
    BadOption
        The path is another kind of file, or the system refuses to read or write it.
    """
    require_folder(path)
    key = reading_key(reading)
    try:
        whole = _checked_end(path)
        feet = dict(_kept_feet(path, key)) if whole else {}
        with path.open("ab") as file:
            if not whole:
                file.truncate(0)
                file.write(HEAD.encode())
                file.flush()
                sync(path)
                sync(path.parent)

            def add(foot: FootMeasures) -> None:
                file.write(_line(key, foot).encode())
                file.flush()
                sync(path)

            yield feet, add
    except OSError as error:
        words = f"the cache cannot be used: {error.strerror or error}"
        raise BadOption(words, str(path)) from error


def _checked_end(path: Path) -> bool:
    """Whether there is a cache; one that a crash cut off is ended with a line break.

    Raises
    ------
    BadOption
        It is another file: nothing is written to it.
    """
    if not path.exists():
        return False
    if not path.is_file():
        raise BadOption("is not a file; name a file for --cache", str(path))
    with path.open("rb") as file:
        start = file.read(len(HEAD))
    if start != HEAD.encode():
        if HEAD.encode().startswith(start):  # a crash tore the head
            return False
        raise BadOption("is not a cache of footfit; name another file for --cache", str(path))
    with path.open("rb+") as file:
        file.seek(-1, 2)
        if file.read(1) != b"\n":
            file.write(b"\n")
    return True


def _kept_feet(path: Path, key: str) -> Iterator[tuple[str, FootMeasures]]:
    """The feet that were read in the same way; a line that is not as it was written is passed."""
    with path.open(encoding="utf-8", errors="replace") as file:
        for line in file:
            try:
                said = json.loads(line)
                text = said["foot"]
                if said["key"] == key and said["sha256"] == _hash(key, text):
                    foot = _foot_of(json.loads(text))
                    yield foot.key, foot
            except (ValueError, KeyError, TypeError):
                continue


def _line(key: str, foot: FootMeasures) -> str:
    text = json.dumps(_values_of(foot))
    return json.dumps({"key": key, "sha256": _hash(key, text), "foot": text}) + "\n"


def _hash(key: str, text: str) -> str:
    return hashlib.sha256(f"{key} {text}".encode()).hexdigest()


def _values_of(foot: FootMeasures) -> dict[str, Any]:
    """A foot as plain values; every number comes back as it was."""
    shape, flare = foot.shape, foot.shape.flare
    plan = flare.curvature.get("plan")
    measures = {
        name: [row.definition, *(getattr(row.measured, key) for key in KEYS)]
        for name, row in shape.measures.items()
    }
    toes = foot.toes
    return {
        "file": foot.key,
        "side": foot.side,
        "extent_mm": shape.extent_mm,
        "measures": measures,
        "angle_deg": [flare.angle_deg, flare.angle_sd_deg],
        "stations": flare.stations.tolist(),
        "plan": None if plan is None else plan.tolist(),
        "toes": None if toes is None else [toes.edges_mm.tolist(), toes.seat_mm.tolist()],
    }


def _foot_of(values: Mapping[str, Any]) -> FootMeasures:
    """The foot of plain values."""
    measures = {
        name: Measure(name, Measured(**dict(zip(KEYS, row[1:], strict=True))), row[0])
        for name, row in values["measures"].items()
    }
    angle_deg, sd_deg = values["angle_deg"]
    flare = FlareProfile(
        definition=FlareDefinition(),
        angle_deg=angle_deg,
        angle_sd_deg=sd_deg,
        flare_class=None,
        stations=np.array(values["stations"]),
        heading_deg=NO_CURVE[:, 0],
        curvature={"plan": _array(values["plan"])},
        centre_line=NO_CURVE,
    )
    toes = values["toes"]
    plan = None if toes is None else ToesPlan(np.array(toes[0]), np.array(toes[1]))
    shape = ZoneShape(values["extent_mm"], flare, measures)
    return FootMeasures(values["file"], values["side"], shape, plan)


def _array(values: list[float] | None) -> Floats | None:
    return None if values is None else np.array(values)
