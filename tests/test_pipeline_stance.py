"""How a last stands: by its shape, by its labels, and what is said where they contradict."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from footfit.errors import BadOption
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.stance.cues import NO_LABELS, StanceLabels
from footfit.geometry.stance.stance import stance_of
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.preparation import prepared_scan
from footfit.pipeline.scan.standing import check_stance_labels, heights_by_shape, stance_notices
from tests.conftest import SAMPLES
from tests.reading import read_scan
from tests.scans import cleaned
from tools.last_specs import wide
from tools.lasts import LastSpec, last_mesh, standing
from tools.resting import at_rest

SPEC = LastSpec(length_mm=262.0, heel_height_mm=45.0, level_tread=True, rings=90, segments=64)
SOLVED_MM = 0.02  # of a label that decides; measured: .002
SEAT_MM = 3.0  # of the shape's heel against the drafted one, two standard deviations


def stands(labels=NO_LABELS, side="right"):
    """The alignment of one last with labels."""
    vertices, faces = last_mesh(SPEC)
    if side == "left":
        vertices, faces = vertices * [1.0, -1.0, 1.0], faces[:, ::-1]
    return aligned_scan(prepared_scan(cleaned(vertices, faces), side, None, labels)).alignment


def codes(alignment):
    return {notice.code for notice in alignment.warnings}


def test_the_shape_decides_where_nothing_is_said():
    stance = stands().stance
    drafted = standing(SPEC)
    heel_mm = drafted.height_mm(0.0) - drafted.middle_mm[:, 1].min()
    assert stance.decided_by == "shape"
    assert stance.heel_height_mm == pytest.approx(heel_mm, abs=SEAT_MM)
    assert stance.heel_height_sd_mm == pytest.approx(2.0, abs=0.5)  # a soft break; measured: 2.15
    assert -0.6 < stance.spring_per_heel < -0.3
    assert [cue.name for cue in stance.cues] == ["tread", "bottom", "seat", "shape"]


@pytest.mark.parametrize(
    ("labels", "heel_mm"),
    [
        (StanceLabels(44.0), 44.0),
        (StanceLabels(60.0, platform_mm=15.0), 45.0),
        (StanceLabels(5.0), 5.0),
    ],
)
def test_a_labelled_heel_decides(labels, heel_mm):
    alignment = stands(labels)
    assert alignment.stance.decided_by == "label"
    assert alignment.stance.heel_height_mm == pytest.approx(heel_mm, abs=SOLVED_MM)
    assert ("stance_label_contradicted" in codes(alignment)) == (heel_mm == 5.0)


def test_heel_and_spring_go_together_as_it_is_said():
    low, high = stands(StanceLabels(43.0)).stance, stands(StanceLabels(47.0)).stance
    change = high.toe_spring_mm - low.toe_spring_mm
    slope = 0.5 * (low.spring_per_heel + high.spring_per_heel)  # the last touches further forward
    assert change == pytest.approx(4.0 * slope, abs=0.3)


def test_a_labelled_toe_spring_decides_too():
    one, other = (stands(StanceLabels(None, spring)).stance for spring in (6.0, 8.0))
    assert one.decided_by == "label"
    assert other.heel_height_mm < one.heel_height_mm


def test_the_standing_transform_puts_the_ground_under_the_last():
    for side in ("right", "left"):
        vertices, faces = last_mesh(SPEC)
        if side == "left":
            vertices, faces = vertices * [1.0, -1.0, 1.0], faces[:, ::-1]
        scan = aligned_scan(prepared_scan(cleaned(vertices, faces), side))
        transform = scan.alignment.standing_transform
        np.testing.assert_allclose(transform[:3, :3] @ transform[:3, :3].T, np.eye(3), atol=1e-12)
        points = scan.vertices_mm @ transform[:3, :3].T + transform[:3, 3]
        low = points[:, 2] < 60.0
        assert points[low, 0].min() == pytest.approx(0.0, abs=0.5)
        assert points[:, 2].min() == pytest.approx(0.0, abs=0.8)  # the crown of the tread


def contradiction(labels):
    notices = stands(labels).warnings
    return next((n.message for n in notices if n.code == "stance_label_contradicted"), "")


def test_two_labels_that_do_not_go_together_are_named():
    drafted = standing(SPEC)
    heel_mm = drafted.height_mm(0.0) - drafted.middle_mm[:, 1].min()
    labels = StanceLabels(heel_mm, toe_spring_mm=drafted.tip_mm + 15.0)
    stance = stands(labels).stance
    assert "agrees better with the heel height: check both" in contradiction(labels)
    assert stance.heel_height_sd_mm > 0.4 * abs(stance.heel_height_mm - heel_mm)
    assert [cue.name for cue in stance.cues][-3:] == ["heel_label", "spring_label", "label"]
    assert contradiction(StanceLabels(heel_mm, toe_spring_mm=drafted.tip_mm)) == ""


def test_the_advice_is_for_the_label_that_was_given():
    heel_mm = stands().stance.heel_height_mm
    assert "--platform" in contradiction(StanceLabels(heel_mm + 20.0))
    assert "higher than the label says" in contradiction(StanceLabels(heel_mm - 15.0))
    assert "--platform" not in contradiction(StanceLabels(heel_mm - 15.0))
    assert "--platform" not in contradiction(StanceLabels(heel_mm + 25.0, platform_mm=5.0))
    assert "stand its toe" in contradiction(StanceLabels(None, toe_spring_mm=40.0))


def test_what_is_said_is_the_difference_of_the_two_heels():
    alone_mm = stands().stance.heel_height_mm
    labelled = stands(StanceLabels(alone_mm + 30.0)).stance.heel_height_mm
    assert f"its heel {labelled - alone_mm:.0f} mm lower" in contradiction(
        StanceLabels(alone_mm + 30.0)
    )


def test_a_label_that_no_ground_gives_widens_the_uncertainty():
    stance = stands(StanceLabels(200.0)).stance
    assert stance.heel_height_mm < 195.0
    assert stance.heel_height_sd_mm > 0.5 * (200.0 - stance.heel_height_mm)


def test_a_platform_alone_is_of_no_use():
    assert "stance_label_unused" in codes(stands(StanceLabels(platform_mm=10.0)))


def test_a_foot_stands_as_it_lies_whatever_is_said():
    scan = read_scan(SAMPLES / "feet" / "mh007_R.stl")
    alignment = aligned_scan(prepared_scan(scan, "right", None, StanceLabels(60.0))).alignment
    assert alignment.stance is None
    assert np.array_equal(alignment.standing_transform, np.eye(4))
    assert "stance_label_unused" in codes(alignment)


@pytest.mark.parametrize(
    "labels",
    [StanceLabels(-1.0), StanceLabels(None, np.nan), StanceLabels(30.0, platform_mm=500.0)],
)
def test_a_label_that_no_last_has_is_refused(labels):
    with pytest.raises(BadOption, match="is from 0 to"):
        check_stance_labels(labels)


def test_a_platform_higher_than_the_heel_is_refused():
    with pytest.raises(
        BadOption, match=r"platform \(70.0 mm\) is higher than the heel \(60.0 mm\)"
    ):
        check_stance_labels(StanceLabels(60.0, platform_mm=70.0))
    check_stance_labels(StanceLabels(60.0, platform_mm=60.0))


# ---------------------------------------------------------------- by the shape, by a label alone


@cache
def resting(style, heel_mm):
    """A last of a style, at rest, and how far along it each face is and whether it looks down."""
    spec = wide(np.random.default_rng(3), style, (heel_mm, heel_mm + 1.0))
    vertices, faces = last_mesh(spec)
    vertices = at_rest(vertices)[0]
    along = (vertices[faces].mean(axis=1)[:, 0] - vertices[:, 0].min()) / np.ptp(vertices[:, 0])
    normal = area_vectors(vertices, faces)
    return vertices, faces, along, normal[:, 2] < -0.5 * np.linalg.norm(normal, axis=1)


def opened(style, heel_mm, gap, labels=NO_LABELS):
    """The same last without its bottom between two shares of its length."""
    vertices, faces, along, down = resting(style, heel_mm)
    kept = ~(down & (along > gap[0]) & (along < gap[1]))
    return Shape(vertices, faces[kept], "last", labels)


@pytest.mark.parametrize(("style", "heel_mm"), [("shoe", 15.0), ("pump", 80.0), ("boot", 40.0)])
@pytest.mark.parametrize(
    "labels", [StanceLabels(30.0), StanceLabels(60.0, 15.0), StanceLabels(None, 20.0)]
)
def test_a_height_by_the_shape_is_that_of_the_last_without_its_label(style, heel_mm, labels):
    mesh = resting(style, heel_mm)[:2]
    alone, labelled = (stance_of(*mesh, "last", each) for each in (NO_LABELS, labels))
    assert labelled.decided_by == "label"
    by_shape = heights_by_shape(labelled)
    assert by_shape == heights_by_shape(alone)
    assert by_shape == {"heel_height": alone.heel_mm(), "toe_spring_tip": alone.tip_mm()}


@pytest.mark.parametrize(("style", "heel_mm"), [("shoe", 15.0), ("pump", 80.0), ("child", 5.0)])
def test_a_label_stands_a_last_whose_shape_shows_no_tread(style, heel_mm):
    """A hole in the shank breaks the line; the labels are those of the whole last."""
    whole = opened(style, heel_mm, (2.0, 2.0)).stance
    assert opened(style, heel_mm, (0.28, 0.52)).stance is None
    for labels in (StanceLabels(whole.heel_mm()), StanceLabels(None, whole.tip_mm())):
        shape = opened(style, heel_mm, (0.28, 0.52), labels)
        assert shape.stance.decided_by == "label"
        assert np.degrees(shape.stance.ground) == pytest.approx(np.degrees(whole.ground), abs=0.05)
        assert measure_named("stick_length").taken_of(shape).value is not None
        assert stance_notices(shape) == ()


@pytest.mark.parametrize("style", ["shoe", "pump", "child"])
@pytest.mark.parametrize(
    ("gap", "place"),
    [
        ((0.56, 0.80), "at the forepart"),
        ((0.10, 0.80), "over most of its length"),
        ((-1.0, 0.16), "at the seat"),
    ],
)
def test_a_label_of_no_use_says_where_the_bottom_is_open(style, gap, place):
    shape = opened(
        style, {"shoe": 15.0, "pump": 80.0, "child": 5.0}[style], gap, StanceLabels(20.0)
    )
    (notice,) = stance_notices(shape)
    assert notice.code == "stance_label_unused"
    assert notice.message.startswith(f"the bottom is open {place}, so the labels")
