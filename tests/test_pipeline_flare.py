"""From an aligned mesh to its profile: sides, kinds, refusals, feet of known bend."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from benchmarks import bends
from footfit.errors import SideUndecided
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition
from footfit.geometry.flare.flare_profile import flare_profile
from footfit.geometry.flare.levelled_bottom import low_length
from footfit.pipeline.scan.flare import profiled_scan
from tests import distortions
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES
from tests.reading import read_scan
from tests.scans import aligned, aligned_of, right_shape
from tests.solids import signed_volume

FEET = SAMPLES / "feet"


@pytest.fixture(scope="module")
def right():
    return aligned(read_scan(FEET / "mh007_R.stl"))


def as_left(one):
    """The mirror image of an aligned right shape, as an aligned left one."""
    vertices, faces = distortions.mirrored(one.vertices_mm, one.faces)
    side = replace(one.alignment.side, side="left")
    return aligned_of(replace(one.alignment, side=side), vertices, faces)


def test_a_left_foots_profile_is_its_mirror_images(right):
    one, other = profiled_scan(right), profiled_scan(as_left(right))
    assert other.flare.angle_deg == pytest.approx(one.flare.angle_deg, abs=ROUNDING)
    assert other.flare.angle_sd_deg == pytest.approx(one.flare.angle_sd_deg, abs=ROUNDING)
    for name in CHANNELS:
        assert np.allclose(
            other.flare.curvature[name], one.flare.curvature[name], atol=ROUNDING, rtol=0
        )
    for a, b in zip(one.measures, other.measures, strict=True):
        assert b.measured.value == pytest.approx(a.measured.value, abs=ROUNDING)


def test_a_right_shape_stays_and_a_left_one_is_turned_over(right):
    vertices, faces = right_shape(right)
    assert np.array_equal(vertices, right.vertices_mm)
    assert np.array_equal(faces, right.faces)
    left = as_left(right)
    mirrored = right_shape(left)
    assert np.allclose(mirrored[0], vertices)
    assert np.sign(signed_volume(*mirrored)) == np.sign(signed_volume(vertices, faces))


def test_an_undecided_side_is_refused_with_what_to_type(right):
    side = replace(right.alignment.side, side=None)
    undecided = replace(right, alignment=replace(right.alignment, side=side))
    with pytest.raises(SideUndecided, match="--side left or --side right"):
        profiled_scan(undecided)


def test_measures_carry_their_sd_and_definition(right):
    found = profiled_scan(right)
    by_name = {measure.name: measure for measure in found.measures}
    assert by_name["length"].measured.value == pytest.approx(
        right.alignment.length_mm, abs=ROUNDING
    )
    # steadied against noise: a few tenths inside the plain extent (docs/measures.md)
    assert 0.0 < right.alignment.extent_mm - by_name["length"].measured.value < 1.0
    for measure in found.measures:
        value, sd = measure.measured.value, measure.measured.sd
        assert (value is None) == (sd is None) == (measure.measured.reason is not None)
        assert sd is None or sd > 0.0
        assert measure.definition


def test_what_is_not_there_has_a_reason_and_no_sd(right):
    centres = right.vertices_mm[right.faces].mean(axis=1)
    start = right.vertices_mm[:, 0].min() + right.alignment.extent_mm / 6.0
    kept = right.faces[np.abs(centres[:, 0] - start) > 8.0]
    holed = aligned_of(right.alignment, right.vertices_mm, kept)
    heel = next(m for m in profiled_scan(holed).measures if m.name == "heel_width")
    assert (heel.measured.value, heel.measured.sd) == (None, None)
    assert "open at the heel" in heel.measured.reason


@pytest.mark.parametrize("name", ["mh007_L", "mh007_R", "mh008_R"])
def test_a_foot_of_known_bend_reads_the_bend(name):
    assert_bends_are_read(FEET / f"{name}.stl")


@pytest.mark.parametrize("name", ["mh000_L", "mh005_R", "mh010_L"])
def test_a_foot_beside_the_project_reads_the_bend(scans, name):
    assert_bends_are_read(scans / "makehuman" / f"{name}.stl")


def assert_bends_are_read(path):
    """Bent by known angles about its own line and about X, the foot reads what was planted."""
    vertices, faces = right_shape(aligned(read_scan(path)))
    before = flare_profile(vertices, faces)
    length_mm = low_length(vertices, FlareDefinition().length_height)[1]
    line = bends.own_line(before, length_mm)
    for axis in (line, bends.x_axis(length_mm)):
        for turn_deg in (-8.0, -4.0, 4.0, 8.0):
            after = flare_profile(bends.bent(vertices, axis, turn_deg), faces)
            change_deg = bends.true_change_deg(line, axis, turn_deg)
            assert after.angle_deg - before.angle_deg == pytest.approx(change_deg, abs=0.3)
            if axis is line:
                assert change_deg == pytest.approx(turn_deg, abs=ROUNDING)


def test_a_planted_bend_keeps_what_lies_across_the_line(right):
    vertices, faces = right_shape(right)
    length_mm = low_length(vertices, FlareDefinition().length_height)[1]
    line = bends.own_line(flare_profile(vertices, faces), length_mm)
    still = bends.bent(vertices, line, 0.0)
    assert np.abs(still - vertices).max() < 2.9e-4  # measured 0.00019
    moved = bends.bent(vertices, line, 8.0)
    low = vertices[:, 2] < 20.0
    heel, toe = (low & (np.abs(vertices[:, 0] / length_mm - at) < 0.08) for at in (0.12, 0.85))
    for part in (heel, toe):  # stiff on either side of the bend
        before, after = vertices[part], moved[part]
        away = np.linalg.norm(before - before[0], axis=1)
        # measured 1.6e-06
        assert np.allclose(np.linalg.norm(after - after[0], axis=1), away, atol=2.4e-6)


def test_a_flare_that_no_foot_has_is_said(right):
    """The forefoot turned by a quarter, as of a foot that hangs in the air."""
    assert profiled_scan(right).unusual == ()
    vertices = right.vertices_mm
    turned = bends.bent(vertices, bends.x_axis(right.alignment.extent_mm), 30.0)
    (found,) = profiled_scan(aligned_of(right.alignment, turned, right.faces)).unusual
    assert found.code == "suspect_flare"
    assert "(-3 to +33)" in found.message


def test_what_is_said_of_the_angle_grows_where_the_sole_is_missing(right):
    whole = profiled_scan(right).flare
    pose = replace(right.alignment.pose, sole=False)
    alignment = replace(right.alignment, pose=pose)
    cut = profiled_scan(aligned_of(alignment, right.vertices_mm, right.faces)).flare
    assert cut.angle_deg == whole.angle_deg
    assert cut.angle_sd_deg == pytest.approx(np.hypot(whole.angle_sd_deg, 2.0))
    assert whole.angle_sd_deg >= 0.2
