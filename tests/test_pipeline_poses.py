"""Lasts and feet of every kind in a random pose, side and unit: the right pose, kind and side."""

from __future__ import annotations

import zlib

import numpy as np
import pytest

from benchmarks.poses.case import Case, outcome
from benchmarks.poses.feet import of_kind
from benchmarks.poses.lasts import cut_last
from tests.conftest import SAMPLES
from tests.reading import read_scan
from tools.last_specs import wide
from tools.lasts import last_mesh
from tools.resting import at_rest

PITCH_DEG = 0.9  # of a heeled last against its resting line; measured: 0.45
LOW_DEG = 3.2  # of a low last and of a foot against where they were drawn; measured: 1.6
FLARE_DEG = 8.0
LASTS = {
    "shoe with a low heel": ("shoe", 15.0, "none", {}),
    "boot": ("boot", 20.0, "none", {}),
    "boot with a heel": ("boot", 85.0, "none", {}),
    "pump": ("pump", 115.0, "none", {"length_mm": 262.0}),
    "sandal": ("sandal", 70.0, "none", {}),
    "thimble": ("shoe", 45.0, "thimble", {}),
    "v-cut": ("shoe", 30.0, "v-cut", {}),
    "open hinge": ("shoe", 55.0, "hinge open", {}),
    "touching hinge": ("shoe", 25.0, "hinge touching", {}),
    "hinge in one body": ("pump", 80.0, "hinge in one body", {}),
    "small child": ("child", 5.0, "none", {"length_mm": 120.0}),
}
FEET = (
    "child", "long", "wide", "bunion", "leg to the knee", "leaning shank", "no sole",
    "no sole, long leg",
)  # fmt: skip


def seeded(name: str) -> np.random.Generator:
    return np.random.default_rng(zlib.crc32(name.encode()))


@pytest.mark.parametrize("name", LASTS)
def test_a_last_of_every_kind_is_posed(name):
    style, heel_mm, cut, given = LASTS[name]
    rng = seeded(name)
    spec = wide(rng, style, (heel_mm, heel_mm), flare_deg=FLARE_DEG, rings=70, segments=50, **given)
    vertices, faces = cut_last(*last_mesh(spec), cut)
    case = Case("own", style, "", cut, at_rest(vertices)[0], faces, FLARE_DEG, spec.length_mm)
    found = outcome(case, rng)
    assert not found.refused, found.message
    assert not found.wrong
    assert found.kind == "last"
    assert found.side_right
    assert found.unit_right
    assert abs(found.pitch_deg) < (PITCH_DEG if heel_mm > 40.0 else LOW_DEG)


@pytest.mark.parametrize("kind", FEET)
def test_a_foot_of_every_kind_is_posed(kind):
    rng = seeded(kind)
    scan = read_scan(SAMPLES / "feet" / "mh008_R.stl")
    vertices, faces = of_kind(scan.vertices_mm, scan.faces, kind, rng)
    low = vertices[:, 2] < vertices[:, 2].min() + 60.0
    case = Case("feet", kind, "", "", vertices, faces, None, float(np.ptp(vertices[low, 0])))
    found = outcome(case, rng)
    assert not found.refused, found.message
    assert not found.wrong
    assert found.kind == "foot"
    assert found.side_right
    assert found.unit_right
