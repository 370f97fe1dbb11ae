"""Flare: the planted turn, and the laws that a property of the shape must obey."""

from __future__ import annotations

import ast
import importlib
import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import HalfScan
from footfit.geometry.flare import levelled_bottom
from footfit.geometry.flare.centre_line import _Graph, _projected, centre_line
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, flare_class
from footfit.geometry.flare.flare_profile import flare_profile
from footfit.geometry.flare.levelled_bottom import bottom_shape
from footfit.geometry.flare.profile_distance import profile_distances
from footfit.geometry.numeric.smoothing import cubic_splines, local_quadratic
from tests import distortions, shapes
from tests.bounds import ROUNDING
from tests.strategies import seeds
from tools.lasts import LastSpec, graded, last_mesh, plain, true_flare_deg, true_heading_deg, varied

SMALL = {"rings": 90, "segments": 64}
INSIDE = slice(2, 39)  # stations .08-.80


def last(flare_deg=8.0, **fields):
    spec = LastSpec(flare_deg=flare_deg, **{**SMALL, **fields})
    return spec, *last_mesh(spec)


@pytest.fixture(scope="module")
def usual():
    _, vertices, faces = last()
    return vertices, faces, flare_profile(vertices, faces, kind="last")


def channels(profile):
    return np.array([profile.curvature[name] for name in CHANNELS])


def same(one, other, tolerance):
    assert other.angle_deg == pytest.approx(one.angle_deg, abs=tolerance)
    assert np.allclose(other.heading_deg, one.heading_deg, atol=tolerance, rtol=0)
    assert np.allclose(channels(other), channels(one), atol=tolerance, rtol=0)


@pytest.mark.parametrize("toe_shape", ["round", "almond", "square", "pointed"])
@pytest.mark.parametrize("flare_deg", [-6.0, 4.0, 16.0])
def test_a_smoothly_bent_last_reads_its_planted_turn(flare_deg, toe_shape):
    spec = plain(LastSpec(flare_deg=flare_deg, toe_shape=toe_shape, heel_height_mm=20.0, **SMALL))
    profile = flare_profile(*last_mesh(spec), kind="last")
    assert profile.angle_deg == pytest.approx(
        true_flare_deg(spec), abs=0.07
    )  # 0.038: the toe's shape
    truth = true_heading_deg(spec, profile.stations)
    assert np.abs(profile.heading_deg - truth)[INSIDE].max() < 0.4


def test_lasts_whose_sides_differ_read_their_planted_turn():
    rng = np.random.default_rng(11)
    specs = [replace(varied(rng), **SMALL) for _ in range(10)]
    errors = [flare_profile(*last_mesh(s)).angle_deg - true_flare_deg(s) for s in specs]
    assert np.sqrt(np.mean(np.square(errors))) < 0.15


def test_noise_moves_the_angle_about_as_much_as_the_sd_says(usual):
    vertices, faces, clean = usual
    rng = np.random.default_rng(2)
    noisy = [flare_profile(distortions.white_noise(vertices, rng, 0.3), faces) for _ in range(12)]
    moved = np.std([p.angle_deg for p in noisy])
    said = np.mean([p.angle_sd_deg for p in noisy])
    assert moved < 0.15  # 0.088: a noise of 0.3 mm is no tenth of a class
    assert 0.8 < moved / said < 2.0  # 1.31: white noise also moves the ends of the length
    assert said > clean.angle_sd_deg >= FlareDefinition().frame_sd_deg


@pytest.mark.parametrize("lags", [0, 1, 2, 5])
def test_the_angles_sd_is_the_scatter_carried_through_the_line(usual, lags):
    """Newey and West's variance: neighbours up to ``lags`` apart count with falling weights."""
    vertices, faces, _ = usual
    noisy = distortions.white_noise(vertices, np.random.default_rng(4), 0.5)
    definition = FlareDefinition(scatter_lags=lags, frame_sd_deg=0.0)
    line = centre_line(bottom_shape(noisy, faces, definition), definition)
    smooth, _ = local_quadratic(line.bands.x, line.bands.x, definition.scatter_bandwidth)
    gradient = angle_gradient(line, definition)
    felt = (gradient @ line.response) * (line.scatter - smooth @ line.scatter)
    apart = np.abs(np.subtract.outer(np.arange(len(felt)), np.arange(len(felt))))
    weights = np.maximum(0.0, 1.0 - apart / (lags + 1))
    variance = felt @ weights @ felt * len(felt) / (line.freedom - np.trace(smooth))
    said = flare_profile(noisy, faces, definition).angle_sd_deg
    assert said == pytest.approx(np.sqrt(variance), rel=5e-7)  # 2.5e-7: the gradient's differences
    framed = flare_profile(noisy, faces, replace(definition, frame_sd_deg=0.3)).angle_sd_deg
    assert framed == pytest.approx(np.hypot(said, 0.3), rel=ROUNDING)


def angle_gradient(line, definition, step=1e-4):
    """The flare angle's derivative by the line's coefficients, by central differences."""

    def angle_deg(values):
        means = []
        for low, high in (definition.forefoot, definition.rearfoot):
            count = definition.window_points
            places = line.x_at(low + (high - low) * (np.arange(count) + 0.5) / count)
            headings = np.arctan(cubic_splines(places, len(values))[1] @ values)
            means.append(np.degrees(headings).mean())
        return means[0] - means[1]

    known = line.coefficients
    moves = step * np.eye(len(known))
    ends = [(angle_deg(known + move), angle_deg(known - move)) for move in moves]
    return np.array([high - low for high, low in ends]) / (2.0 * step)


def test_decimation_hardly_moves_the_angle():
    _, vertices, faces = last(rings=160, segments=110)
    before = flare_profile(vertices, faces).angle_deg
    after = flare_profile(*distortions.decimated(vertices, faces, 4.0)).angle_deg
    assert after == pytest.approx(before, abs=0.004)  # 0.0021 deg


@pytest.mark.parametrize("change_deg", [-8.0, -4.0, 4.0, 8.0])
def test_a_further_bend_of_a_last_is_read_whole(usual, change_deg):
    _, vertices, faces = last(8.0 + change_deg)
    change = flare_profile(vertices, faces).angle_deg - usual[2].angle_deg
    assert change == pytest.approx(change_deg, abs=0.02)  # 0.011 deg


def test_a_graded_last_has_the_identical_profile():
    spec = LastSpec(length_mm=250.0, flare_deg=7.0, **SMALL)
    one = flare_profile(*last_mesh(spec))
    other = flare_profile(*last_mesh(graded(spec, 290.0)))
    same(one, other, ROUNDING)
    assert profile_distance(one, other)[0] < ROUNDING


@settings(max_examples=8, deadline=None)
@given(power=st.floats(-1.0, 1.0))
def test_scale_changes_nothing(usual, power):
    vertices, faces, profile = usual
    same(profile, flare_profile(vertices * 10.0**power, faces), ROUNDING)


@settings(max_examples=6, deadline=None)
@given(seed=seeds)
def test_the_order_of_vertices_and_faces_changes_nothing(usual, seed):
    vertices, faces, profile = usual
    shuffled = distortions.shuffled(vertices, faces, np.random.default_rng(seed))
    same(profile, flare_profile(*shuffled), ROUNDING)


@settings(max_examples=6, deadline=None)
@given(seed=seeds)
def test_subdivision_changes_nothing_but_how_the_surface_is_weighed(usual, seed):
    vertices, faces, profile = usual
    chosen = np.random.default_rng(seed).random(len(faces)) < 0.3
    other = flare_profile(*distortions.subdivided(vertices, faces, chosen))
    assert other.angle_deg == pytest.approx(profile.angle_deg, abs=ROUNDING)
    assert np.allclose(channels(other)[:4], channels(profile)[:4], atol=ROUNDING, rtol=0)
    # facets are weighed at their centres: right to the square of their size
    assert np.abs(channels(other)[4] - channels(profile)[4])[INSIDE].max() < 0.01


@settings(max_examples=8, deadline=None)
@given(x=st.floats(-40.0, 40.0), y=st.floats(-40.0, 40.0))
def test_where_the_shape_lies_on_the_floor_changes_nothing(usual, x, y):
    vertices, faces, profile = usual
    same(profile, flare_profile(vertices + np.array([x, y, 0.0]), faces), ROUNDING)


@settings(max_examples=8, deadline=None)
@given(roll=st.floats(-2.0, 2.0), pitch=st.floats(-0.5, 0.5), yaw=st.floats(-1.0, 1.0))
def test_a_slightly_wrong_frame_hardly_moves_the_angle(usual, roll, pitch, yaw):
    vertices, faces, profile = usual
    for axis, angle in (("x", roll), ("y", pitch), ("z", yaw)):
        vertices = vertices @ distortions.axis_rotation(axis, angle)[:3, :3].T
    angle_deg = flare_profile(vertices, faces).angle_deg
    assert angle_deg == pytest.approx(profile.angle_deg, abs=0.025)  # 0.013 in the corners


@settings(max_examples=8, deadline=None)
@given(roll=st.floats(-3.0, 3.0))
def test_a_roll_of_the_frame_changes_nothing(usual, roll):
    vertices, faces, profile = usual
    rolled = vertices @ distortions.axis_rotation("x", roll)[:3, :3].T
    same(profile, flare_profile(rolled, faces), 1.4e-3)  # a heading moves by 0.0007 at most


def bowl(along_mm, across_mm):
    """A block whose bottom is a doubly curved bowl of these two radii at its middle."""
    x, y = np.linspace(0, 250, 121), np.linspace(-45, 45, 61)
    X, Y = np.meshgrid(x, y, indexing="ij")
    Z = along_mm - np.sqrt(along_mm**2 - (X - 125) ** 2)
    Z = Z + across_mm - np.sqrt(across_mm**2 - Y**2)
    below = np.stack([X, Y, Z], axis=-1).reshape(-1, 3)
    above = np.stack([X, Y, np.full_like(Z, 70.0)], axis=-1).reshape(-1, 3)
    index = np.arange(x.size * y.size).reshape(x.size, y.size)
    a, b, c, d = (
        i.ravel() for i in (index[:-1, :-1], index[1:, :-1], index[:-1, 1:], index[1:, 1:])
    )
    bottom = np.concatenate([np.stack([a, c, b], axis=1), np.stack([b, c, d], axis=1)])
    sides = [
        np.stack([p, q, q + index.size, p + index.size], axis=1)
        for p, q in ((index[:-1, 0], index[1:, 0]), (index[1:, -1], index[:-1, -1]))
    ]
    quads = np.concatenate(sides)
    walls = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    faces = np.concatenate([bottom, bottom[:, ::-1] + index.size, walls])
    return np.concatenate([below, above]), faces


def test_a_bowl_has_the_curvature_of_its_radii():
    profile = flare_profile(*bowl(400.0, 300.0))
    assert profile.angle_deg == pytest.approx(0.0, abs=ROUNDING)
    middle = slice(20, 27)
    mean = 0.5 * (1 / 400 + 1 / 300) * 250
    assert profile.curvature["bottom_surface"][middle] == pytest.approx(
        mean, rel=0.005
    )  # 0.0025: the bandwidth
    for name in ("bottom_20", "bottom_50", "bottom_80"):
        assert profile.curvature[name][middle] == pytest.approx(250 / 400, rel=0.02)
    assert profile.curvature["plan"] == pytest.approx(0.0, abs=ROUNDING)


def test_a_hollow_bottom_is_negative():
    vertices, faces = bowl(400.0, 300.0)
    vertices[:, 2] = np.where(vertices[:, 2] < 70.0, 25.0 - vertices[:, 2], 70.0)
    profile = flare_profile(vertices, faces)
    for name in CHANNELS[1:]:
        assert (profile.curvature[name][20:27] < -0.5).all()


def test_the_plan_channel_is_the_planted_curvature():
    spec = plain(LastSpec(flare_deg=12.0, **SMALL))
    profile = flare_profile(*last_mesh(spec))
    step = 1e-3
    ahead, behind = (true_heading_deg(spec, profile.stations + d) for d in (step, -step))
    truth = np.radians(ahead - behind)[INSIDE] / (2 * step)
    assert np.corrcoef(truth, profile.curvature["plan"][INSIDE])[0, 1] > 0.995


def test_a_shape_without_a_sole_has_no_bottom_channels(usual):
    vertices, faces, profile = usual
    centres = vertices[faces].mean(axis=1)
    down = np.cross(*(vertices[faces[:, i]] - vertices[faces[:, 0]] for i in (1, 2)))[:, 2] < 0
    bare = flare_profile(vertices, faces[~(down & (centres[:, 2] < 30.0))])
    assert all(bare.curvature[name] is None for name in CHANNELS[1:])
    assert bare.curvature["plan"] is not None
    assert bare.angle_deg == pytest.approx(profile.angle_deg, abs=0.07)  # 0.037 deg


def test_half_a_last_is_refused(usual):
    vertices, faces, _ = usual
    gap = np.abs(vertices[faces, 0].mean(axis=1) - 130.0) < 75.0
    with pytest.raises(HalfScan, match="length: scan the whole foot again"):
        flare_profile(vertices, faces[~gap])


def test_holes_in_the_wall_do_not_upset_the_angle(usual):
    vertices, faces, profile = usual
    holed = distortions.with_holes(vertices, faces, np.random.default_rng(7), 3, 10.0)
    assert flare_profile(*holed).angle_deg == pytest.approx(profile.angle_deg, abs=0.04)  # 0.023


def test_the_class_of_a_last_follows_the_thresholds_and_a_foot_has_none():
    definition = FlareDefinition()
    least, most = definition.last_straight_deg
    angles = (least - 0.1, least, most, most + 0.1)
    names = [flare_class(angle, "last", definition) for angle in angles]
    assert names == ["outflare", "straight", "straight", "inflare"]
    assert {flare_class(angle, "foot", definition) for angle in (-3.0, *angles, 30.0)} == {None}


def test_the_definition_travels_as_json():
    stored = json.loads(json.dumps(asdict(FlareDefinition())))
    lists = {k: tuple(v) if isinstance(v, list) else v for k, v in stored.items()}
    assert FlareDefinition(**lists) == FlareDefinition()


MODULES = ("flare.flare_profile", "flare.definition", "flare.centre_line", "flare.band_edges")
MODULES += ("flare.bottom_curves", "flare.levelled_bottom", "flare.sole_curvature")
MODULES += ("flare.flattened", "flare.unrolling", "numeric.smoothing")
SPARING = {"_NEIGHBOURHOOD", "_LIFT"}  # the next test: no value depends on them
BESIDE = {"ANOTHER_LINE_SD_DEG"}  # of the total uncertainty, no part of the profile


def numbers_of(node):
    constants = (n for n in ast.walk(node) if isinstance(n, ast.Constant))
    return [c.value for c in constants if isinstance(c.value, int | float)]


@pytest.mark.parametrize("name", MODULES)
def test_no_chosen_number_stands_outside_the_definition(name):
    source = importlib.import_module(f"footfit.geometry.{name}").__file__
    body = ast.parse(Path(source).read_text(encoding="utf-8")).body
    assigned = (n for n in body if isinstance(n, ast.Assign | ast.AnnAssign))
    named = {
        target.id
        for node in assigned
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        if isinstance(target, ast.Name) and numbers_of(node)
    }
    assert named <= SPARING | BESIDE


def test_what_is_left_out_before_changes_nothing(usual, monkeypatch):
    vertices, faces, profile = usual
    monkeypatch.setattr(levelled_bottom, "_NEIGHBOURHOOD", 0.2)
    monkeypatch.setattr(levelled_bottom, "_LIFT", 0.1)
    same(profile, flare_profile(vertices, faces), ROUNDING)


@pytest.mark.parametrize(
    "finer",
    [
        {"table": (-0.1, 1.1, 4801)},
        {"projections": 5},
        {"turn_least": 0.1},
        {"window_points": 400},
        {"surface_bins": 2401},
        {"surface_halvings": 9},
        {"length_rounds": 8},
    ],
    ids=lambda finer: next(iter(finer)),
)
def test_how_finely_it_is_solved_hardly_matters(usual, finer):
    vertices, faces, profile = usual
    other = flare_profile(vertices, faces, FlareDefinition(**finer))
    assert other.angle_deg == pytest.approx(profile.angle_deg, abs=2e-4)  # 1.2e-4 deg
    assert np.abs(channels(other) - channels(profile))[:, INSIDE].max() < 2e-4  # 1.0e-4


def test_a_profiles_arrays_stand_at_the_fixed_stations(usual):
    profile = usual[2]
    definition = profile.definition
    assert len(profile.stations) == definition.stations
    ends = (definition.stations_from, definition.stations_to)
    assert (profile.stations[0], profile.stations[-1]) == pytest.approx(ends)
    assert channels(profile).shape == (5, definition.stations)
    assert profile.heading_deg.shape == profile.stations.shape
    assert profile.centre_line.shape == (definition.stations, 2)
    assert np.isfinite(channels(profile)).all()


# ------------------------------------------------------------------ distance


@pytest.fixture(scope="module")
def library():
    return [flare_profile(*last(f, heel_height_mm=h)[1:]) for f, h in ((2, 10), (8, 25), (14, 40))]


def profile_distance(a, b):
    """The distance of two profiles, and its parts."""
    found = profile_distances(a, [b])
    return float(found.total[0]), {name: float(part[0]) for name, part in found.parts.items()}


def test_the_distance_is_symmetric_and_zero_to_itself(usual, library):
    profile = usual[2]
    for other in library:
        there, parts = profile_distance(profile, other)
        back, _ = profile_distance(other, profile)
        assert there == pytest.approx(back)
        assert sum(parts.values()) == pytest.approx(there**2)
    assert profile_distance(profile, profile)[0] == 0.0


def test_many_distances_are_the_single_ones(usual, library):
    profile = usual[2]
    found = profile_distances(profile, library)
    singles = [profile_distance(profile, other) for other in library]
    assert found.total == pytest.approx([d for d, _ in singles])
    for name in CHANNELS:
        assert found.parts[name] == pytest.approx([parts[name] for _, parts in singles])
    assert profile_distances(profile, []).total.shape == (0,)


def test_a_rescan_is_nearer_than_any_other_last(usual, library):
    vertices, faces, profile = usual
    noisy = distortions.white_noise(vertices, np.random.default_rng(3), 0.3)
    found = profile_distances(flare_profile(noisy, faces), [profile, library[0], library[2]])
    assert found.total.argmin() == 0
    assert found.total[0] < 1.9  # 0.98: the sd of a channel is its repeatability
    assert found.total[1:].min() > 3.0 * found.total[0]


def test_a_missing_channel_leaves_its_weight_to_the_others(usual, library):
    profile = usual[2]
    bare = replace(profile, curvature={**profile.curvature, "bottom_surface": None})
    distance, parts = profile_distance(bare, library[0])
    whole = profile_distance(profile, library[0])[1]
    assert np.isnan(parts["bottom_surface"])
    assert parts["plan"] > whole["plan"]
    known = [part for part in parts.values() if not np.isnan(part)]
    assert sum(known) == pytest.approx(distance**2)


def test_profiles_of_other_stations_are_not_compared(usual):
    vertices, faces, profile = usual
    other = flare_profile(vertices, faces, FlareDefinition(stations=24))
    with pytest.raises(ValueError, match="definitions"):
        profile_distance(profile, other)


def test_a_round_thing_has_no_flare():
    vertices, faces = shapes.sphere(60.0, 3)
    profile = flare_profile(vertices + np.array([0.0, 0.0, 60.0]), faces)
    assert profile.angle_deg == pytest.approx(0.0, abs=ROUNDING)


@pytest.mark.parametrize("left", [0.6, 0.4, 0.25])
def test_a_point_near_the_middle_of_a_bend_is_put_where_its_normal_meets_the_line(left):
    """``left`` is how much of the way to the line's centre of curvature is still to go."""
    x, bend, at = np.linspace(-1.0, 2.0, 30_001), 4.0, np.array([0.02, 0.05])
    line = _Graph(x, 0.5 * bend * x**2, bend * x, np.full_like(x, bend))
    aside = (1.0 - left) / bend
    points = np.stack([at - bend * at * aside, 0.5 * bend * at**2 + aside], axis=1)
    assert np.abs(_projected(points, line, FlareDefinition()) - at).max() < 9e-5  # measured 5e-5
