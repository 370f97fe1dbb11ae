"""The size on a label goes with the length along the bottom: no cone and no shaft changes it."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.geometry.fit.sizes import label_words
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.measure import last_record
from footfit.results import LastLabels
from tests.scans import aligned, cleaned
from tools.lasts import LastSpec, last_mesh, standing
from tools.resting import pitched

LABELS = LastLabels("last", size="37", size_system="eu")
LITTLE = 0.01  # of a size; measured: .005
GROWN_MM = (
    12.0  # by which the length at rest must grow, so that the test shows something; measured: 23
)


def records(heel_mm):
    """A last with a low cone, and the same one as a boot with an upright back."""
    spec = LastSpec(
        length_mm=250.0, heel_height_mm=heel_mm, level_tread=True, rings=110, segments=80
    )
    vertices, faces = last_mesh(spec)
    stands = pitched(vertices, float(np.radians(standing(spec).pitch_deg)))
    over_mm = np.maximum(stands[:, 2] - stands[:, 2].min() - heel_mm - 20.0, 0.0)
    behind = np.clip((0.55 - stands[:, 0] / np.ptp(stands[:, 0])) / 0.15, 0.0, 1.0)
    grown_mm = behind * over_mm
    boot = stands + np.outer(grown_mm, [-0.4, 0.0, 2.5])
    for points in (stands, boot):
        scan = aligned(cleaned(points, faces), side="right")
        yield last_record(profiled_scan(scan), LABELS)


@pytest.mark.parametrize("heel_mm", [70.0, 95.0])
def test_no_shaft_changes_the_size(heel_mm):
    low, boot = records(heel_mm)
    assert boot.length_mm - low.length_mm > GROWN_MM
    assert boot.label_check.by_length == pytest.approx(low.label_check.by_length, abs=LITTLE)
    assert "length along the bottom" in label_words(boot.label_check)
