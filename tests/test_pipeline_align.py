"""The whole alignment: units, sides, refusals, warnings, the paper's methods."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import (
    FootfitError,
    GeometryRefused,
    HalfScan,
    ImplausibleSize,
    NoReference,
    NotAFoot,
    SeveralFeet,
    SideContradicted,
    UnknownUnits,
)
from footfit.geometry.mesh.moments import printed_covariance, surface_second_moment
from footfit.geometry.numeric.rotations import angle_deg, moved_points
from footfit.geometry.pose import paper_frame
from footfit.meshes.units import UNIT_NAMES, UNIT_SCALES
from footfit.pipeline.scan import preparation
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.measure import measured_scan
from footfit.results import MeshInfo, Notice, Reference, Scan
from tests import distortions, shapes
from tests.bounds import EXACT, POSED, ROUNDING
from tests.conftest import SAMPLES
from tests.reading import read_scan
from tests.scans import aligned
from tools.lasts import LastSpec, last_mesh

SEEDS = st.integers(0, 2**32 - 1)
LENGTH_MM = 268.0


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(length_mm=LENGTH_MM, rings=60, segments=40))


@pytest.fixture(scope="module")
def home(last):
    """The alignment of the last as it was drawn."""
    return aligned(scan_of(*last)).alignment


def scan_of(vertices_mm, faces, *, units="mm", source="detected", scale=None):
    """A scan as the reader hands it over: the file's unit is ``units``, or provisional."""
    scale = UNIT_SCALES[units] if scale is None else scale
    info = MeshInfo(None, "0" * 64, "stl", len(vertices_mm), len(faces), True, units, source, scale)
    return Scan(info, vertices_mm, faces, (), np.arange(len(vertices_mm)))


def test_many_faces_lie_as_they_would_if_nothing_were_gathered(last, monkeypatch):
    fine = distortions.subdivided(*distortions.subdivided(*last))
    whole = aligned(scan_of(*fine)).alignment
    monkeypatch.setattr(
        preparation, "FRAMING", replace(preparation.FRAMING, many_points=len(fine[1]) - 1)
    )
    gathered = aligned(scan_of(*fine)).alignment
    there, here = gathered.canonical_transform, whole.canonical_transform
    assert 0.0 < angle_deg(there[:3, :3], here[:3, :3]) < 0.0024  # measured 0.0016
    # measured 0.0020
    assert np.abs(moved_points(there, last[0]) - moved_points(here, last[0])).max() < 0.003


def reference_of(alignment):
    """The reference that a right last makes."""
    frame, unit = alignment.printed_frame, alignment.info.unit_scale
    return Reference(
        "first",
        paper_frame.om_e(frame.eigenvectors, alignment.canonical_transform),
        paper_frame.canonical_centroid_mm(frame.centroid_mm, alignment.canonical_transform, unit),
    )


def codes(alignment):
    return [notice.code for notice in alignment.warnings]


# ---------------------------------------------------------------- laws


@settings(max_examples=12, deadline=None)
@given(seed=SEEDS, left=st.booleans(), units=st.sampled_from(sorted(UNIT_SCALES)))
def test_any_pose_side_and_unit_give_the_same_canonical_last(last, home, seed, left, units):
    rng = np.random.default_rng(seed)
    vertices, faces = distortions.mirrored(*last) if left else last
    vertices, faces = distortions.shuffled(vertices, faces, rng)
    posed = distortions.moved(vertices, distortions.random_pose(rng))
    found = aligned(scan_of(posed, faces, units=units))
    flip = [1.0, -1.0, 1.0] if left else [1.0, 1.0, 1.0]
    expected = moved_points(home.canonical_transform, vertices * flip) * flip
    assert np.abs(found.vertices_mm - expected).max() < POSED
    assert found.alignment.side.side == ("left" if left else "right")
    assert found.alignment.info.units == units
    assert found.alignment.length_mm == pytest.approx(home.length_mm, abs=POSED)
    in_file = posed / UNIT_SCALES[units]
    by_transform = moved_points(found.alignment.transform, in_file)
    assert np.abs(by_transform - found.vertices_mm).max() < ROUNDING
    linear = found.alignment.transform[:3, :3] / found.alignment.info.unit_scale
    np.testing.assert_allclose(linear @ linear.T, np.eye(3), atol=ROUNDING)
    assert np.linalg.det(linear) == pytest.approx(1.0)


def test_the_same_scan_gives_the_same_bytes(last):
    first, second = (aligned(scan_of(*last)) for _ in range(2))
    assert first.vertices_mm.tobytes() == second.vertices_mm.tobytes()
    assert first.alignment.transform.tobytes() == second.alignment.transform.tobytes()


def test_distortions_hardly_move_the_frame(last, home):
    vertices, faces = last
    rng = np.random.default_rng(5)
    for mesh in (
        (distortions.white_noise(vertices, rng, 0.3), faces),
        distortions.decimated(vertices, faces, 2),
        distortions.half_subdivided(vertices, faces),
        distortions.inside_out(vertices, faces),
    ):
        found = aligned(scan_of(*mesh)).alignment
        assert angle_deg(found.transform[:3, :3], home.transform[:3, :3]) < 0.05  # measured 0.033
        # measured 0.096
        assert np.linalg.norm(found.transform[:3, 3] - home.transform[:3, 3]) < 0.15


def test_extents_are_exact_along_x(last):
    found = aligned(scan_of(*last))
    low = found.vertices_mm[found.vertices_mm[:, 2] < 0.3 * LENGTH_MM]
    assert found.alignment.extent_mm == pytest.approx(np.ptp(low[:, 0]))


# ---------------------------------------------------------------- units


def test_the_extent_of_a_high_heel_reaches_to_its_toe():
    """As it rests, its toe lies higher than .30 of its length: the extent was 2.1 mm short."""
    spec = LastSpec(heel_height_mm=112.0, rings=90, segments=64)
    scan = aligned(scan_of(*last_mesh(spec)), side="right")
    extent_mm, shape = scan.alignment.extent_mm, scan.prepared.shape
    assert shape.vertices_mm[np.argmax(shape.vertices_mm[:, 0]), 2] > 0.30 * extent_mm
    assert 0.0 < extent_mm - shape.length_mm < 0.5


@pytest.mark.parametrize(("taken_for", "truly"), [("cm", "in"), ("m", "mm"), ("mm", "cm")])
def test_a_provisional_unit_is_corrected_by_the_length(last, taken_for, truly):
    """The reader saw a long leg, say, and took the file's numbers in another unit."""
    vertices, faces = last
    wrong = vertices / UNIT_SCALES[truly] * UNIT_SCALES[taken_for]
    scan = replace(
        scan_of(wrong, faces, units=taken_for),
        warnings=(Notice("units_detected", "too early"), Notice("open_mesh", "open")),
    )
    found = aligned(scan).alignment
    assert found.info.units == truly
    said = {notice.code: notice.message for notice in found.warnings}
    assert ("units_detected" in said) == (truly != "mm")
    assert truly == "mm" or UNIT_NAMES[truly] in said["units_detected"]
    assert said["open_mesh"] == "open"
    assert found.length_mm == pytest.approx(LENGTH_MM, abs=0.21)  # measured 0.14


def test_no_unit_fits(last):
    vertices, faces = last
    with pytest.raises(UnknownUnits, match=r"80.5.* --known-length MM$"):
        aligned(scan_of(vertices * 0.3, faces))


def test_a_small_childs_last_has_a_unit(last):
    """No unit makes 134 mm usual; a single one makes it possible."""
    found = aligned(scan_of(last[0] * 0.5, last[1])).alignment
    assert found.info.units == "mm"
    assert "length_unusual" in codes(found)


def test_cm_and_inches_that_both_fit_are_asked_for(last):
    """A length of 13.6 is 136 mm in cm and 345 mm in inches: neither is usual."""
    vertices = last[0] * (136.0 / LENGTH_MM)
    with pytest.raises(UnknownUnits, match=r"--units cm\) or 34\d mm \(--units in\): give --units"):
        aligned(scan_of(vertices, last[1], units="cm"))


@pytest.mark.parametrize("factor", [0.1, 0.4, 1.5, 25.4, 1000.0])
def test_a_declared_unit_with_an_implausible_length_is_refused(last, factor):
    vertices, faces = last
    with pytest.raises(ImplausibleSize, match=r"taken as millimetres, .*--units"):
        aligned(scan_of(vertices * factor, faces, source="declared"))


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_a_detected_unit_is_said_once(last, unit):
    found = aligned(scan_of(*last, units=unit)).alignment
    said = [notice.message for notice in found.warnings if notice.code == "units_detected"]
    assert len(said) == (unit != "mm"), "plain millimetres are no surprise"
    if said:
        assert f"taken as {UNIT_NAMES[unit]}, so the length is {found.length_mm:.1f} mm" in said[0]
    declared = aligned(scan_of(*last, units=unit, source="declared")).alignment
    assert "units_detected" not in codes(declared)


def test_a_declared_unit_with_an_unusual_length_is_said(last):
    vertices, faces = last
    found = aligned(scan_of(vertices * 0.5, faces, source="declared")).alignment
    assert "length_unusual" in codes(found)


@pytest.mark.parametrize("factor", [0.004, 1.0, 30.0])
def test_a_known_length_settles_the_scale(last, factor):
    vertices, faces = last
    scan = scan_of(vertices * factor, faces, units="scaled", source="known-length", scale=1.0)
    found = aligned(scan, known_length_mm=251.5)
    assert found.alignment.length_mm == pytest.approx(251.5)
    rows = {measure.name: measure.measured for measure in measured_scan(found).measures}
    assert rows["length"].value == pytest.approx(251.5)
    assert found.alignment.info.units == "scaled"
    by_transform = moved_points(found.alignment.transform, scan.vertices_mm)
    assert np.abs(by_transform - found.vertices_mm).max() < ROUNDING


# ---------------------------------------------------------------- sides


def test_a_given_side_that_the_shape_surely_contradicts_is_refused_unless_it_is_forced(last):
    agreed = aligned(scan_of(*last), side="right").alignment
    with pytest.raises(
        SideContradicted, match=r"given as left.* right one \(score \+.*--force-side"
    ):
        aligned(scan_of(*last), side="left")
    against = aligned(scan_of(*last), side="left", force_side=True).alignment
    assert (agreed.side.side, agreed.side.source, agreed.side.confidence) == (
        "right",
        "given",
        "sure",
    )
    assert "side_contradicted" not in codes(agreed)
    assert (against.side.side, against.side.confidence) == ("left", "low")
    assert "side_contradicted" in codes(against)
    np.testing.assert_array_equal(agreed.transform, against.transform)


def straight_last(flare_deg=0.0):
    """A last whose two halves are mirror images but for its flare."""
    spec = LastSpec(
        flare_deg=flare_deg,
        toe_turn_deg=0.0,
        waist_cut_mm=0.0,
        joint_bulge_mm=0.0,
        arch_mm=0.0,
        arch_cut_mm=0.0,
        ridge_mm=0.0,
        rings=60,
        segments=40,
    )
    return scan_of(*last_mesh(spec))


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_side_given_wins_over_a_doubtful_detection(side):
    doubtful = straight_last(flare_deg=2.0)
    detected = aligned(doubtful).alignment  # its score is 0.97; 2.5 is sure
    assert (detected.side.side, detected.side.confidence) == ("right", "low")
    known = aligned(doubtful, side=side).alignment
    assert (known.side.side, known.side.source) == (side, "given")
    assert ("side_contradicted" in codes(known)) == (side == "left")


def test_a_last_without_a_side_is_undecided():
    found = aligned(straight_last()).alignment
    assert abs(found.side.score) < 0.5  # measured 0.28
    assert found.side.side is None
    assert found.side.confidence == "undecided"
    assert "low_side_confidence" in codes(found)


# ---------------------------------------------------------------- refusals and warnings


@pytest.mark.parametrize(
    "make", [shapes.cylinder, shapes.sphere, shapes.hand, shapes.shin, shapes.flat_sheet]
)
def test_what_is_no_foot_is_refused(make):
    with pytest.raises(GeometryRefused):
        aligned(scan_of(*make()))
    with pytest.raises(GeometryRefused):
        aligned(scan_of(*make(), source="declared"))


def test_a_cube_is_no_foot():
    with pytest.raises(NotAFoot, match="neither a foot nor a last"):
        aligned(scan_of(*shapes.cube(250.0, 8)))


@pytest.mark.parametrize("gap_mm", [5.0, 40.0])
def test_two_lasts_in_one_file_are_refused(last, gap_mm):
    with pytest.raises(SeveralFeet):
        aligned(scan_of(*shapes.two_feet(*last, gap_mm=gap_mm)))


def test_a_forefoot_alone_is_half_a_scan(last):
    ahead = np.array([-1.0, 0.0, 0.0])
    with pytest.raises(HalfScan):
        aligned(scan_of(*distortions.plane_cut(*last, np.array([70.0, 0, 0]), ahead)))


def test_a_sole_alone_is_half_a_scan(last):
    up = np.array([0.0, 0.0, 1.0])
    with pytest.raises(GeometryRefused):
        aligned(scan_of(*distortions.plane_cut(*last, np.array([0.0, 0, 14.0]), up)))


def test_things_beside_the_last_are_left_out(last, home):
    cube = shapes.cube(60.0, 4)
    both = distortions.joined(last, (cube[0] + [100.0, 160.0, 30.0], cube[1]))
    found = aligned(scan_of(*both))
    assert "pieces_removed" in codes(found.alignment)
    assert len(found.faces) == len(last[1])
    assert angle_deg(found.alignment.transform[:3, :3], home.transform[:3, :3]) < ROUNDING


def test_a_ball_as_large_as_the_last_does_not_join_it(last, home):
    ball = shapes.sphere(55.0, 3)
    both = distortions.joined(last, (ball[0] + [130.0, 260.0, 55.0], ball[1]))
    found = aligned(scan_of(*both))
    assert "pieces_removed" in codes(found.alignment)
    assert len(found.faces) == len(last[1])
    assert angle_deg(found.alignment.transform[:3, :3], home.transform[:3, :3]) < ROUNDING


def test_a_plate_is_taken_off(last, home):
    pose = distortions.random_pose(np.random.default_rng(0))
    vertices, faces = distortions.floor_plate(*last)
    found = aligned(scan_of(distortions.moved(vertices, pose), faces)).alignment
    assert "plate_removed" in codes(found)
    turn = found.transform[:3, :3] @ pose[:3, :3]
    assert angle_deg(turn, home.transform[:3, :3]) < ROUNDING


@pytest.mark.parametrize(
    "box", [(0.15, 0.5, 0.0), (0.65, 0.5, 0.0), (0.7, 1.0, 0.2), (0.0, 0.5, 0.3), (0.8, 0.0, 0.2)]
)
def test_holes_in_sole_wall_and_heel_are_bridged_and_said(last, home, box):
    vertices, faces = last
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle = vertices[np.argmin(np.abs((vertices - low) / (high - low) - box).sum(axis=1))]
    keep = np.linalg.norm(vertices[faces].mean(axis=1) - middle, axis=1) > 11.0
    found = aligned(scan_of(vertices, faces[keep]))
    turn = angle_deg(found.alignment.transform[:3, :3], home.transform[:3, :3])
    assert turn < 0.015  # measured 0.0101
    # measured 0.25 and 0.00041
    assert np.linalg.norm(found.alignment.transform[:3, 3] - home.transform[:3, 3]) < 0.3
    assert found.alignment.extent_mm == pytest.approx(home.extent_mm, abs=6.2e-4)
    assert [code for code in codes(found.alignment) if "hole" in code] == ["holes_filled"]
    flat = profiled_scan(aligned(scan_of(vertices, faces))).flare.angle_deg
    assert profiled_scan(found).flare.angle_deg == pytest.approx(flat, abs=0.062)  # measured 0.041
    assert len(found.faces) == keep.sum()  # what was scanned stays what it is


def test_a_last_without_a_sole_is_said(last):
    down = np.array([0.0, 0.0, -1.0])
    cut = distortions.plane_cut(*last, np.array([0.0, 0.0, 12.0]), down)
    found = aligned(scan_of(*cut)).alignment
    assert not found.pose.sole
    assert "no_sole" in codes(found)


@pytest.mark.parametrize("height_mm", [8.0, 15.0])
@pytest.mark.parametrize("name", ["mh008_R", "mh007_L"])
def test_a_foot_without_its_sole_is_posed_by_the_rest(name, height_mm):
    """Whatever the pose: the reference's sole is not looked for where faces are missing below."""
    found = aligned(read_scan(SAMPLES / "feet" / f"{name}.stl"))
    whole = found.alignment
    up = np.array([0.0, 0.0, 1.0])
    cut = distortions.plane_cut(found.vertices_mm, found.faces, height_mm * up, -up)
    rng = np.random.default_rng(11)
    for _ in range(3):
        pose = distortions.random_pose(rng)
        alone = aligned(scan_of(distortions.moved(cut[0], pose), cut[1])).alignment
        assert "no_sole" in codes(alone)
        assert alone.side.side == whole.side.side
        if "open_end" in codes(alone):  # at 15 mm a part of the toes went with the sole
            assert height_mm > 10.0
        else:
            assert alone.length_mm == pytest.approx(whole.length_mm, abs=1.4)  # measured 0.9
        turn = alone.transform[:3, :3] @ pose[:3, :3]
        assert min(turn[0, 0], turn[2, 2]) > np.cos(np.radians(1.4))  # measured 0.74


# ---------------------------------------------------------------- the paper's methods


def test_the_paper_methods_need_a_reference(last):
    with pytest.raises(NoReference, match="set-reference"):
        aligned(scan_of(*last), method="paper")


def test_a_reference_changes_nothing_of_footfits_own_frame(last, home):
    turned = replace(reference_of(home), om_e=np.eye(3)[[1, 2, 0]])
    found = aligned(scan_of(*last), reference=turned).alignment
    assert np.array_equal(found.transform, found.canonical_transform)
    assert np.array_equal(found.transform, home.transform)


@pytest.mark.parametrize("left", [False, True])
def test_the_paper_method_puts_a_last_on_itself(last, home, left):
    """With its own OM_E the consistent reading gives the canonical frame back."""
    vertices, faces = distortions.mirrored(*last) if left else last
    pose = distortions.random_pose(np.random.default_rng(9))
    posed = distortions.moved(vertices, pose)
    found = aligned(scan_of(posed, faces), method="paper", reference=reference_of(home)).alignment
    assert np.linalg.det(found.transform[:3, :3]) > 0
    off = moved_points(found.transform, posed) - moved_points(found.canonical_transform, posed)
    assert np.abs(off).max() < POSED


NOWHERE = Reference("nowhere", np.eye(3), np.zeros(3))


@pytest.mark.parametrize("left", [False, True])
def test_the_literal_method_is_om_e_v_prime(last, left):
    """A left shape is mirrored before Eq. 1 and back after Eq. 8."""
    OM_E = distortions.random_rotation(np.random.default_rng(3))
    reference = replace(NOWHERE, om_e=OM_E)
    vertices, faces = distortions.mirrored(*last) if left else last
    posed = distortions.moved(vertices, distortions.random_pose(np.random.default_rng(4)))
    found = aligned(scan_of(posed, faces), method="paper-literal", reference=reference)
    assert found.alignment.side.side == ("left" if left else "right")
    before = [-1.0, 1.0, 1.0] if left else [1.0, 1.0, 1.0]
    after = [1.0, -1.0, 1.0] if left else [1.0, 1.0, 1.0]
    expected = ((posed - posed.mean(axis=0)) * before) @ OM_E.T * after
    assert np.abs(moved_points(found.alignment.transform, posed) - expected).max() < ROUNDING


def signed_orders():
    """Every order and every choice of signs of three rows, as matrices (3, 3)."""
    for order in permutations(range(3)):
        for signs in product((-1.0, 1.0), repeat=3):
            yield np.diag(signs) @ np.eye(3)[list(order)]


@pytest.mark.parametrize("method", ["footfit", "paper", "paper-literal"])
def test_eigenvectors_are_a_rotation_with_their_own_values(last, home, method):
    """The rows follow X, Y, Z (literally: the eigenvalues), and each value is its row's."""
    vertices, faces = last
    found = aligned(scan_of(*last), method=method, reference=NOWHERE).alignment
    frame, R = found.eigenframe, found.eigenframe.eigenvectors
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=EXACT)
    assert np.linalg.det(R) == pytest.approx(1.0)
    moment = surface_second_moment if method == "footfit" else printed_covariance
    own = R @ moment(vertices, faces) @ R.T
    np.testing.assert_allclose(own, np.diag(frame.eigenvalues_mm2), atol=ROUNDING)
    rotation = found.canonical_transform[:3, :3]
    if method == "paper-literal":
        assert frame.eigenvalues_mm2.tolist() == sorted(frame.eigenvalues_mm2, reverse=True)
    else:
        ways = [q for q in signed_orders() if np.linalg.det(q) > 0]
        assert len(ways) == 24
        assert np.trace(R @ rotation.T) >= max(np.trace(q @ R @ rotation.T) for q in ways)
    printed = found.printed_frame
    np.testing.assert_array_equal(printed.centroid_mm, vertices.mean(axis=0))
    np.testing.assert_array_equal(printed.eigenvectors, home.printed_frame.eigenvectors)


def test_the_rows_order_is_not_always_that_of_the_values():
    """A last as high as it is wide: its second eigenvalue belongs to Z, and so it is said."""
    vertices, faces = last_mesh(LastSpec(length_mm=LENGTH_MM, rings=60, segments=40))
    high = np.array([1.0, 0.9, 1.6])
    frame = aligned(scan_of(vertices * high, faces)).alignment.eigenframe
    assert frame.eigenvalues_mm2[0] > frame.eigenvalues_mm2[2] > frame.eigenvalues_mm2[1]


# ---------------------------------------------------------------- real scans


@pytest.mark.parametrize("name", ["mh007_L", "mh007_R", "mh008_R"])
@pytest.mark.parametrize("worn", ["as it is", "rough", "coarse"])
def test_sample_feet_stand_upright_in_any_pose(name, worn):
    scan = read_scan(SAMPLES / "feet" / f"{name}.stl")
    vertices, faces = scan.vertices_mm, scan.faces
    rng = np.random.default_rng(5)
    if worn == "rough":
        vertices = distortions.white_noise(vertices, rng, 0.5)
    if worn == "coarse":
        vertices, faces = distortions.decimated(vertices, faces, 3.0)
    worn_scan = replace(scan, vertices_mm=vertices, faces=faces)
    # measured: 0.96 and 1.9 deg
    assert_upright(worn_scan, name, (1, 0, 0), (0, 0, 1), toes_deg=1.9, up_deg=3.7)


@pytest.mark.parametrize(
    ("name", "toes", "up"),
    [
        ("FIND_template", (1, 0, 0), (0, 0, 1)),
        ("MHR_template_L", (1, 0, 0), (0, 0, 1)),
        ("MHR_template_R", (1, 0, 0), (0, 0, 1)),
        ("dupontgu_L", (0, -1, 0), (0, 0, 1)),
        ("dupontgu_R", (-0.28, -0.96, 0), (0, 0, 1)),
        ("makehuman/mh003_L", (1, 0, 0), (0, 0, 1)),
    ],
)
def test_real_scans_stand_upright_in_any_pose(scans, name, toes, up):
    # of whom nobody has measured how they point; found: 6.9 and 12.6 deg, both FIND_template
    assert_upright(read_scan(scans / f"{name}.stl"), name, toes, up, toes_deg=12.0, up_deg=14.0)


def assert_upright(scan, name, toes, up, toes_deg, up_deg):
    """In a random pose its toes point along X and its leg along Z, and its side is sure."""
    pose = distortions.random_pose(np.random.default_rng(len(name)))
    posed = replace(scan, vertices_mm=distortions.moved(scan.vertices_mm, pose))
    found = aligned(posed).alignment
    turn = found.transform[:3, :3] / found.info.unit_scale @ pose[:3, :3]
    assert turn[0] @ np.array(toes) > np.cos(np.radians(toes_deg))
    assert turn[2] @ np.array(up) > np.cos(np.radians(up_deg))
    if name[-2:] in ("_L", "_R"):
        assert found.side.side == ("left" if name.endswith("L") else "right")
        assert found.side.confidence == "sure"


@pytest.mark.parametrize("name", ["mh007_L", "mh008_R"])
def test_the_plantar_sheet_of_a_sample_is_refused_in_one_line(name):
    """What a scanner under a glass plate sees: all that faces down, and no more."""
    scan = read_scan(SAMPLES / "feet" / f"{name}.stl")
    corners = scan.vertices_mm[scan.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = (normals[:, 2] < 0.0) & (corners[:, :, 2].min(axis=1) < 25.0)
    assert_refused_as_half(replace(scan, faces=scan.faces[seen]))


def test_a_plantar_sheet_is_refused_in_one_line(scans):
    assert_refused_as_half(read_scan(scans / "insoleTilter_scan.stl"))


def assert_refused_as_half(scan):
    """Half a scan, and the message is one line."""
    with pytest.raises(FootfitError) as refused:
        aligned(scan)
    assert isinstance(refused.value, HalfScan)
    assert "\n" not in refused.value.message


def test_a_mirrored_copy_has_the_mirrored_frame_to_rounding() -> None:
    """The whole pipeline: pose search and all, from the file's axes."""
    scan = read_scan(SAMPLES / "feet" / "mh007_L.stl")
    vertices, faces = distortions.mirrored(scan.vertices_mm, scan.faces)
    left, right = aligned(scan), aligned(replace(scan, vertices_mm=vertices, faces=faces))
    assert (left.alignment.side.side, right.alignment.side.side) == ("left", "right")
    assert left.alignment.length_mm == pytest.approx(right.alignment.length_mm, abs=ROUNDING)
    assert np.allclose(left.vertices_mm * [1, -1, 1], right.vertices_mm, atol=POSED, rtol=0)
    ours, theirs = profiled_scan(left).flare, profiled_scan(right).flare
    assert ours.angle_deg == pytest.approx(theirs.angle_deg, abs=ROUNDING)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_half_that_cannot_be_posed_is_said_to_be_open(last, axis):
    vertices, faces = last
    cut = np.zeros(3)
    cut[axis] = 1.0
    at = 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))
    half = distortions.plane_cut(vertices, faces, at, cut)
    with pytest.raises((NotAFoot, HalfScan)) as refused:
        aligned(scan_of(*half))
    assert re.search(r"open over \d+ % of its size|cut|sheet", refused.value.message)
