"""The generated lasts are sound solids with a last's proportions, and their flare is planted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from tests.bounds import EXACT, ROUNDING
from tests.test_shapes import cross, euler, is_closed_and_wound, volume
from tools import lasts
from tools.last_specs import HEEL_BANDS_MM, wide
from tools.lasts import LastSpec, graded, last_mesh, plain, varied
from tools.resting import pitched

SMALL = {"rings": 64, "segments": 52}
SPECS = {
    "default": LastSpec(),
    "plain": plain(LastSpec()),
    "flat": LastSpec(heel_height_mm=0.0, toe_spring_mm=8.0, **SMALL),
    "outflare square": LastSpec(flare_deg=-6.0, toe_shape="square", **SMALL),
    "inflare almond": LastSpec(flare_deg=16.0, toe_shape="almond", **SMALL),
    "high pointed": LastSpec(
        length_mm=250.0, heel_height_mm=60.0, toe_spring_mm=5.0, toe_shape="pointed", **SMALL
    ),
    "upright instep": LastSpec(medial_wall=0.7, feather_inset=0.03, ridge_mm=16.0, **SMALL),
}
any_last = st.integers(0, 10**6).map(lambda seed: varied(np.random.default_rng(seed), **SMALL))


def section(vertices, faces, axis, level):
    """Ends (k, 2, 3) of the segments in which the plane ``axis`` = ``level`` cuts the faces."""
    corners, height = vertices[faces], vertices[faces][:, :, axis] - level
    cut = (height.min(axis=1) < 0) & (height.max(axis=1) >= 0)
    corners, height = corners[cut], height[cut]
    after, above = np.roll(corners, -1, axis=1), np.roll(height, -1, axis=1)
    crossed = (height < 0) != (above < 0)
    share = np.where(crossed, height / np.where(crossed, height - above, 1), 0)
    points = corners + share[:, :, None] * (after - corners)
    return points[crossed].reshape(-1, 2, 3)


def band_across(spec, vertices, faces, s):
    """Extremes across the planted line of the section's lower band (.10 L), in its normal plane."""
    centre = lasts.centre_line_mm(spec, np.array([s]))[0]
    angle = np.radians(lasts.true_heading_deg(spec, np.array([s]))[0])
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    local = np.column_stack([(vertices[:, :2] - centre) @ turn.T, vertices[:, 2]])
    points = section(local, faces, 0, 0.0).reshape(-1, 3)
    band = points[points[:, 2] < points[:, 2].min() + 0.1 * spec.length_mm, 1]
    return band.min(), band.max()


@pytest.mark.parametrize("name", SPECS)
def test_a_last_is_a_closed_solid_in_the_canonical_pose(name):
    spec = SPECS[name]
    vertices, faces = last_mesh(spec)
    assert is_closed_and_wound(faces)
    assert euler(faces) == 2
    assert volume(vertices, faces) > 0
    assert np.linalg.norm(cross(vertices, faces), axis=1).min() > 0
    assert vertices[:, 0].min() == 0
    assert vertices[:, 0].max() == pytest.approx(spec.length_mm)
    assert vertices[:, 2].min() == 0
    rear = vertices[vertices[:, 0] < 0.3 * spec.length_mm, 2].min()
    fore = vertices[vertices[:, 0] > 0.5 * spec.length_mm, 2].min()
    # it rests on the seat and on the tread, of which one is drafted at 0; measured: 0.097 mm
    assert max(rear, fore) < 7e-4 * spec.length_mm


@pytest.mark.parametrize("name", SPECS)
def test_the_planted_line_halves_the_lower_band(name):
    spec = SPECS[name]
    vertices, faces = last_mesh(spec)
    for s in np.linspace(0.04, 0.96, 24):
        low, high = band_across(spec, vertices, faces, s)
        assert abs(low + high) / 2 < 2e-4 * spec.length_mm  # between facets; measured: 1.3e-4
        half_mm = lasts.half_width_mm(spec, np.array([s]))[0]
        assert (high - low) / 2 == pytest.approx(half_mm, abs=1.5e-3 * spec.length_mm)


@given(any_last)
@settings(max_examples=25, deadline=None)
def test_any_last_is_sound_and_has_the_flare_it_states(spec):
    vertices, faces = last_mesh(spec)
    assert is_closed_and_wound(faces)
    assert euler(faces) == 2
    assert lasts.true_flare_deg(spec) == pytest.approx(spec.flare_deg, abs=ROUNDING)
    for s in (0.1, 0.43, 0.67, 0.9):
        low, high = band_across(spec, vertices, faces, s)
        assert abs(low + high) / 2 < 2.5e-4 * spec.length_mm  # measured: 1.3e-4
    s = np.linspace(0.002, 0.998, 400)
    line = lasts.centre_line_mm(spec, s)
    step = np.diff(line, axis=0)
    middle = lasts.true_heading_deg(spec, (s[1:] + s[:-1]) / 2)
    # measured 5.2e-4
    np.testing.assert_allclose(np.degrees(np.arctan2(step[:, 1], step[:, 0])), middle, atol=0.001)


@given(any_last)
@settings(max_examples=15, deadline=None)
def test_sections_are_simple_loops(spec):
    """A level line crosses a section twice; four times over a hollow sole or a swung crest."""
    vertices, faces = last_mesh(spec)
    for s in (0.06, 0.2, 0.45, 0.67, 0.85, 0.95):
        segments = section(vertices, faces, 0, s * spec.length_mm)[:, :, 1:]
        rows = np.linspace(segments[..., 1].min(), segments[..., 1].max(), 42)[1:-1]
        for z in rows + 1e-7:
            below = segments[..., 1] < z
            assert (below[:, 0] != below[:, 1]).sum() in (2, 4)


@pytest.mark.parametrize("band", HEEL_BANDS_MM)
def test_the_truth_of_a_stance_is_read_from_the_mesh_that_stands(band):
    """Tread and tip of the mesh, without any code of the product: the two lie as drafted."""
    spec = wide(np.random.default_rng(HEEL_BANDS_MM.index(band)), "shoe", band, **SMALL)
    vertices, _ = last_mesh(spec)
    pose = lasts.standing(spec)
    level = pitched(vertices, np.radians(pose.pitch_deg))
    level[:, 2] -= level[:, 2].min()
    tip_ring = slice(-1 - sum(lasts._rows(spec.segments)), None)  # it has one rib and no sole
    feather = np.argmin(vertices[tip_ring, 2])
    assert level[tip_ring][feather, 2] == pytest.approx(pose.tip_mm, abs=0.1)  # measured .03
    tread = level[np.abs(level[:, 0] / np.ptp(level[:, 0]) - 0.68) < 0.02]
    low = tread[tread[:, 2] < 1.0]
    # a parabola across its crown has its lowest place near the middle: it stands level
    bend, slope, _ = np.polyfit(low[:, 1] - low[:, 1].mean(), low[:, 2], 2)
    assert abs(slope) < 0.02
    assert bend > 0.0


def test_a_left_last_is_the_mirror_image():
    right = last_mesh(LastSpec(**SMALL))
    left = last_mesh(LastSpec(side="left", **SMALL))
    np.testing.assert_array_equal(left[0] * [1, -1, 1], right[0])
    assert volume(*left) == pytest.approx(volume(*right))


def test_a_graded_last_is_the_same_shape():
    spec = LastSpec(heel_height_mm=40.0, ball_width_mm=101.0, **SMALL)
    larger = graded(spec, 300.0)
    assert larger.heel_height_mm == pytest.approx(40 * 300 / 270)
    np.testing.assert_allclose(last_mesh(larger)[0] / 300, last_mesh(spec)[0] / 270, atol=EXACT)
    s = np.linspace(0, 1, 50)
    np.testing.assert_allclose(
        lasts.true_heading_deg(larger, s), lasts.true_heading_deg(spec, s), atol=ROUNDING
    )


def test_the_mesh_grows_with_rings_and_segments():
    assert len(last_mesh(LastSpec())[1]) == pytest.approx(35000, rel=0.0054)  # measured 0.0035
    assert 4000 < len(last_mesh(LastSpec(rings=60, segments=44))[1]) < 6000


def test_the_sides_differ_where_a_foot_differs():
    """The ridge leans, the arch rises and the waist is cut to the medial side."""
    spec = LastSpec()
    vertices, faces = last_mesh(spec)
    waist = section(vertices, faces, 0, 0.43 * 270).reshape(-1, 3)
    instep = section(vertices, faces, 0, 0.56 * 270).reshape(-1, 3)
    middle = lasts.centre_line_mm(spec, np.array([0.56]))[0, 1]
    assert instep[np.argmax(instep[:, 2]), 1] - middle > 0.6 * spec.ridge_mm  # measured: 1.0
    centre = lasts.centre_line_mm(spec, np.array([0.43]))[0, 1]
    half_mm = lasts.half_width_mm(spec, np.array([0.43]))[0]
    medial = waist[np.abs(waist[:, 1] - centre - 0.7 * half_mm) < 2, 2].min()
    lateral = waist[np.abs(waist[:, 1] - centre + 0.7 * half_mm) < 2, 2].min()
    assert medial > lateral + 0.8 * spec.arch_mm  # measured: 1.55


def test_an_upright_medial_wall_leaves_the_lateral_one():
    """At the instep the medial side gets fuller; the heel and the lateral wall stay."""
    leaning, upright = (last_mesh(LastSpec(medial_wall=w, **SMALL))[0] for w in (0.0, 0.7))
    change = np.linalg.norm(upright - leaning, axis=1)
    instep = np.abs(leaning[:, 0] - 0.5 * 270) < 0.05 * 270
    medial = leaning[:, 1] > lasts.centre_line_mm(LastSpec(), np.array([0.5]))[0, 1] + 9.0
    assert change[instep & medial].max() > 5.0  # measured: 11.3
    assert change[leaning[:, 0] < 0.09 * 270].max() < EXACT
    assert change[instep & (leaning[:, 1] < -9.0)].max() < EXACT


@pytest.mark.parametrize("heel_mm", [0.0, 25.0, 40.0])
def test_proportions_are_a_lasts(heel_mm):
    """Shares of the length that last makers' tables give, with room for styles."""
    spec = LastSpec(heel_height_mm=heel_mm)
    vertices, faces = last_mesh(spec)
    length_mm = spec.length_mm
    assert 0.35 < np.ptp(vertices[:, 1]) / length_mm < 0.40
    heel = section(vertices, faces, 0, length_mm / 6).reshape(-1, 3)
    assert 0.23 < np.ptp(heel[:, 1]) / length_mm < 0.27
    assert 0.31 < np.ptp(heel[:, 2]) / length_mm < 0.38
    # ball girth: a tape through MT1 and MT5, across the planted joint stations
    joints = lasts.centre_line_mm(spec, np.array([spec.mt5_station, spec.mt1_station]))
    joints[:, 1] += lasts.half_width_mm(spec, np.array([spec.mt5_station, spec.mt1_station])) * [
        -1,
        1,
    ]
    along = (joints[1] - joints[0]) / np.linalg.norm(joints[1] - joints[0])
    across = np.array([-along[1], along[0]])
    turned = np.column_stack(
        [
            (vertices[:, :2] - joints[0]) @ across,
            (vertices[:, :2] - joints[0]) @ along,
            vertices[:, 2],
        ]
    )
    ball = section(turned, faces, 0, 0.0).reshape(-1, 3)[:, 1:]
    assert 0.80 < ConvexHull(ball).area / length_mm < 1.0  # in 2-D, area is the perimeter


def test_a_spec_is_not_changed_by_grading():
    spec = LastSpec()
    assert graded(spec, 280.0) != spec
    assert replace(spec) == LastSpec()
