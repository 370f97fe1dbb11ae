"""One shape in a pose that is known, and what footfit makes of it in a random one."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

import footfit
from footfit.errors import FootfitError
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.units import UNIT_SCALES
from tests import distortions

WRONG_DEG = 25.0  # of X or Z, from the pose that is known
USUAL_MM = (180.0, 340.0)


@dataclass(frozen=True)
class Case:
    """A right shape in mm: x heel to toe, z up, at rest. ``flare_deg`` is None for feet."""

    family: str
    kind: str
    heel: str
    cut: str
    vertices: Floats
    faces: Ints
    flare_deg: float | None
    length_mm: float


@dataclass(frozen=True)
class Outcome:
    """What came of a case: ``refused`` is the error's code, angles are degrees."""

    refused: str = ""
    message: str = ""
    axis_deg: float = 0.0
    pitch_deg: float = 0.0
    roll_deg: float = 0.0
    kind: str = ""
    side_right: bool = False
    word: str = ""
    unit_right: bool = False
    cost: float = 0.0
    margin: float = 0.0
    seconds: float = 0.0

    @property
    def wrong(self) -> bool:
        """Whether a pose was accepted that is not the shape's."""
        return not self.refused and self.axis_deg > WRONG_DEG


def outcome(case: Case, rng: np.random.Generator) -> Outcome:
    """A case aligned in a random pose, side and unit; the unit is detected if it can be."""
    vertices, faces, side = case.vertices, case.faces, "right"
    if rng.random() < 0.5:
        vertices, faces = distortions.mirrored(vertices, faces)
        side = "left"
    pose = distortions.random_pose(rng)
    unit = str(rng.choice(sorted(UNIT_SCALES)))
    detectable = USUAL_MM[0] < case.length_mm < USUAL_MM[1] or unit in ("mm", "m")
    posed = distortions.moved(vertices, pose) / UNIT_SCALES[unit]
    started = time.process_time()
    try:
        aligned = footfit.align((posed, faces), units="auto" if detectable else unit)
    except FootfitError as error:
        return Outcome(error.code, str(error), seconds=time.process_time() - started)
    answer = aligned.alignment
    seconds = time.process_time() - started
    turn = answer.canonical_transform[:3, :3] @ pose[:3, :3] / answer.info.unit_scale
    off = np.degrees(np.arccos(np.clip([turn[0, 0], turn[2, 2]], -1.0, 1.0)))
    return Outcome(
        axis_deg=float(off.max()),
        pitch_deg=float(np.degrees(np.arctan2(turn[2, 0], turn[2, 2]))),
        roll_deg=float(np.degrees(np.arctan2(turn[2, 1], turn[2, 2]))),
        kind=answer.pose.kind,
        side_right=answer.side.side == side,
        word=answer.side.confidence,
        unit_right=answer.info.units == unit,
        cost=answer.pose.cost,
        margin=answer.pose.margin,
        seconds=seconds,
    )
