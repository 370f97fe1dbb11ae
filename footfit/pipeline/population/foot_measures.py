"""What is kept of one scanned foot while a population is looked at: measures, and no scan."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.toe_walls import ToesPlan
from footfit.geometry.flare.definition import FlareProfile
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit.judging.cells import ZoneShape, foot_shape
from footfit.pipeline.fit.judging.toe_box import plan_of_foot
from footfit.pipeline.population.shape_columns import shape_columns
from footfit.pipeline.population.tables import FootTable
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import Profiled, SideName

NO_CURVE = np.empty((0, 2))


@dataclass(frozen=True, slots=True)
class FootMeasures:
    """One foot: its side, what zones read of it, and its toes in plan, if they were scanned whole.

    ``key`` is the hash of the scan's file, and which foot of the file it is. Of
    the flare only the angle and the plan curvature stay.
    """

    key: str
    side: SideName | None
    shape: ZoneShape
    toes: ToesPlan | None


def read_foot(source: Source, reading: ReadingOptions) -> FootMeasures:
    """The measures of one scan; a function of a module, so that a worker can take it.

    Raises
    ------
    InputError, GeometryRefused
        As a match of this foot.
    """
    return foot_measures(profiled_source(source, reading), part_mark(source))


def part_mark(source: Source) -> str:
    """Which foot of its file a source is: "#1", or nothing."""
    mark = (source.path or "").rpartition("#")
    return f"#{mark[2]}" if source.scan is not None and mark[1] and mark[2].isdigit() else ""


def foot_measures(foot: Profiled, mark: str = "") -> FootMeasures:
    """What is kept of a foot; ``mark`` says which one of its file it is."""
    whole, toes = foot_shape(foot), plan_of_foot(foot)
    flare = foot.flare
    shape = ZoneShape(
        whole.extent_mm,
        FlareProfile(
            definition=flare.definition,
            angle_deg=flare.angle_deg,
            angle_sd_deg=flare.angle_sd_deg,
            flare_class=None,
            stations=flare.stations,
            heading_deg=NO_CURVE[:, 0],
            curvature={"plan": flare.curvature.get("plan")},
            centre_line=NO_CURVE,
        ),
        dict(whole.measures),
    )
    info = foot.aligned.alignment.info
    side = foot.aligned.alignment.side.side
    return FootMeasures(info.sha256 + mark, side, shape, None if isinstance(toes, str) else toes)


def foot_table(ids: Sequence[str], feet: Sequence[FootMeasures], names: Iterable[str]) -> FootTable:
    """Scanned feet as a table with the measures of these names."""
    return FootTable(
        tuple(ids),
        tuple(foot.side for foot in feet),
        shape_columns([foot.shape for foot in feet], names),
        toes=tuple(foot.toes for foot in feet),
    )
