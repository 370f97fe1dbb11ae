"""Cleaning: what is wrong with a mesh is planted, and must be found, said and undone."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import DamagedMesh, EmptyMesh
from footfit.geometry.mesh.surface import unit
from footfit.geometry.mesh.topology import is_closed
from footfit.geometry.pose.pieces import PIECES
from footfit.meshes.clean.spikes import pressed_spikes
from footfit.meshes.clean.triangles import welded_mesh
from tests import distortions, shapes
from tests.bounds import EXACT, ROUNDING
from tests.scans import cleaned
from tests.solids import is_consistently_wound, signed_volume, surface_area

FOOT = shapes.ellipsoid((125.0, 50.0, 40.0), subdivisions=3)


def codes(mesh):
    return [notice.code for notice in mesh.warnings]


def message(mesh, code):
    (found,) = [notice.message for notice in mesh.warnings if notice.code == code]
    return found


def rng(seed=0):
    return np.random.default_rng(seed)


def small(size, shift, subdivisions=1):
    vertices, faces = shapes.sphere(size, subdivisions)
    return vertices + np.asarray(shift), faces


def posed(vertices, faces, seed=1):
    return distortions.moved(vertices, distortions.random_pose(rng(seed))), faces


def test_a_clean_mesh_stays_as_it_is():
    vertices, faces = FOOT
    mesh = cleaned(vertices, faces)
    assert mesh.warnings == ()
    assert mesh.info.watertight
    assert np.array_equal(mesh.vertices_mm[mesh.faces], vertices[faces])
    assert np.array_equal(mesh.source_to_vertex, np.arange(len(vertices)))


def test_soup_becomes_a_surface():
    vertices, faces = distortions.soup(*FOOT)
    mesh = cleaned(vertices, faces)
    assert (len(mesh.vertices_mm), mesh.info.watertight, mesh.warnings) == (len(FOOT[0]), True, ())
    assert np.array_equal(mesh.vertices_mm[mesh.source_to_vertex], vertices)


def test_corners_rounded_apart_are_joined_and_it_is_said():
    vertices, faces = distortions.soup(*posed(*FOOT))
    off_mm = 2e-5
    vertices = vertices + rng().uniform(-off_mm, off_mm, vertices.shape)
    mesh = cleaned(vertices, faces)
    assert "near_vertices_welded" in codes(mesh)
    assert len(mesh.vertices_mm) == len(FOOT[0])
    assert mesh.info.watertight
    joined_mm = np.abs(mesh.vertices_mm[mesh.source_to_vertex] - vertices).max()
    assert joined_mm <= 2.0 * off_mm + ROUNDING  # it is one of the corners


@pytest.mark.parametrize(("apart", "joined"), [(0.2, False), (0.5, True)])
def test_corners_rounded_apart_are_joined_where_they_are_many(apart, joined):
    """A fifth of the faces apart are 1.0 vertices for each face, half of them are 1.75."""
    vertices, faces = FOOT
    loose = rng().random(len(faces)) < apart
    corners, own = distortions.soup(vertices, faces[loose])
    corners = corners + rng(1).uniform(-2e-5, 2e-5, corners.shape)
    mesh = welded_mesh(*distortions.joined((vertices, faces[~loose]), (corners, own)))
    assert [notice.code for notice in mesh.notices] == ["near_vertices_welded"] * joined
    assert is_closed(mesh.faces) is joined


def test_faces_without_area_and_faces_twice_go():
    vertices, faces = FOOT
    a, b = faces[0, :2]
    middle = len(vertices)
    vertices = np.vstack([vertices, 0.5 * (vertices[a] + vertices[b]), [0.0, 0.0, 0.0]])
    debris = [[a, a, b], [a, b, middle], faces[5], faces[6][::-1]]
    mesh = cleaned(vertices, np.vstack([faces, debris]))
    assert message(mesh, "degenerate_removed").startswith("2 ")
    assert message(mesh, "duplicates_removed").startswith("2 ")
    assert len(mesh.faces) == len(faces)
    assert mesh.source_to_vertex[-1] == -1
    assert surface_area(mesh.vertices_mm, mesh.faces) == pytest.approx(surface_area(*FOOT))


def test_a_face_without_area_that_closes_a_surface_leaves_it_watertight():
    corners = np.array([[0.0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100], [50, 0, 0]])
    faces = np.array([[0, 2, 1], [1, 2, 3], [2, 0, 3], [0, 4, 3], [4, 1, 3], [0, 1, 4]])
    mesh = cleaned(corners, faces)
    assert mesh.info.watertight
    assert (len(mesh.faces), codes(mesh)) == (5, ["degenerate_removed"])


def test_specks_go_wherever_they_lie_and_two_shapes_stay():
    specks = [small(1.0, shift) for shift in ([0, 0, 0], [400.0, 0, 0], [0, 60.0, 60.0])]
    mesh = cleaned(*distortions.joined(FOOT, *specks))
    assert message(mesh, "specks_removed").startswith("3 ")
    assert len(mesh.faces) == len(FOOT[1])
    two = cleaned(*shapes.two_feet(*FOOT))
    assert len(two.faces) == 2 * len(FOOT[1])
    assert "specks_removed" not in codes(two)


def test_a_small_patch_stays_where_it_touches_the_shape_and_goes_where_it_does_not():
    toe = small(9.0, [120.0, 20.0, 0.0], 2)
    assert len(cleaned(*distortions.joined(FOOT, toe)).faces) == len(FOOT[1]) + len(toe[1])
    away = small(9.0, [300.0, 20.0, 0.0], 2)
    assert len(cleaned(*distortions.joined(FOOT, away)).faces) == len(FOOT[1])


def test_many_strays_about_a_shape_go_and_its_own_patches_stay():
    """They hold more than a tenth of the area, as the pieces of a cracked scan may."""
    draw = rng(0)
    middle, reach = FOOT[0].mean(axis=0), np.ptp(FOOT[0], axis=0).max()
    around = [u / np.linalg.norm(u) * 1.2 * reach for u in draw.normal(size=(60, 3))]
    strays = [small(4.0, middle + one) for one in around]
    toe = small(4.0, [120.0, 20.0, 0.0])
    mesh = cleaned(*distortions.joined(FOOT, toe, *strays))
    assert message(mesh, "specks_removed").startswith("60 ")
    assert len(mesh.faces) == len(FOOT[1]) + len(toe[1])
    strays_area = 60 * surface_area(*strays[0])
    strays_share = strays_area / (strays_area + surface_area(*FOOT))
    assert strays_share > PIECES.specks  # else they are dust by their area alone


@pytest.mark.parametrize("axis", range(3))
def test_strays_in_a_row_along_any_axis_go(axis):
    """Each axis has its own cells of space: what is far along one is near along no other."""
    middle, reach = FOOT[0].mean(axis=0), np.ptp(FOOT[0][:, axis]) / 2
    along = np.eye(3)[axis] * (reach + 40.0 + 12.0 * np.arange(60)[:, None])
    strays = [small(4.0, middle + one) for one in along]
    mesh = cleaned(*distortions.joined(FOOT, *strays))
    assert codes(mesh) == ["specks_removed"]  # one piece is left
    assert message(mesh, "specks_removed").startswith("60 ")
    assert len(mesh.faces) == len(FOOT[1])


@pytest.mark.parametrize("scale", [1.0, 0.001])
def test_spikes_are_pressed_back_and_the_surface_stays_closed(scale):
    vertices, faces = FOOT
    tips = rng(4).choice(len(vertices), 4, replace=False)
    thrown = vertices.copy()
    thrown[tips] += 150.0 * unit(vertices[tips] - vertices.mean(axis=0))
    mesh = cleaned(scale * thrown, faces)
    assert message(mesh, "spikes_pressed").startswith("4 ")
    assert mesh.info.watertight
    off = np.linalg.norm(mesh.vertices_mm / scale - vertices, axis=1)
    assert off.max() < 2.9  # of 150 mm: in the middle of their neighbours; measured: 1.49
    assert np.count_nonzero(off > ROUNDING) == 4


def test_needles_that_are_no_spikes_stay():
    """A slender corner of a sheet, the tip of a tall cone, a lone needle of a triangle."""
    sheet = shapes.flat_sheet()
    cone = np.array([[0, 0, 40.0], [9, 0, 0], [0, 9, 0], [-9, 0, 0], [0, -9, 0], [0, 0, 0]])
    sides = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])
    floor = np.array([[5, 2, 1], [5, 3, 2], [5, 4, 3], [5, 1, 4]])
    for mesh in (sheet, (cone[:5] * [1, 1, 0.6], sides), (cone * [1, 1, 0.6], np.r_[sides, floor])):
        assert "spikes_pressed" not in codes(cleaned(*mesh))
    needle = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 30, 0]])
    assert "spikes_pressed" not in codes(cleaned(needle, np.array([[0, 1, 2]])))


@pytest.mark.parametrize("place", range(3))
def test_a_tip_with_one_near_neighbour_is_no_spike_at_whichever_corner_its_face_begins(place):
    """The tip is high and slender enough: only its short edge says that it is no single vertex."""
    across = 200
    x, y = np.meshgrid(np.arange(across), np.arange(across))
    sheet = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(float)
    corner = (np.arange(across - 1)[:, None] * across + np.arange(across - 1)).ravel()
    faces = np.r_[corner[:, None] + [0, 1, across + 1], corner[:, None] + [0, across + 1, across]]
    tip, near = 20_100, 20_101
    sheet[tip, 2] = 7.0
    assert pressed_spikes(sheet, faces)[1] == 1
    sheet[near, 2] = 2.0
    both = np.isin(faces, (tip, near))
    begin = np.where(both[:, [0, 1]].all(axis=1), 0, np.where(both[:, [1, 2]].all(axis=1), 1, 2))
    turned = np.take_along_axis(faces, (np.arange(3) + begin[:, None] - place) % 3, axis=1)
    assert np.isin(turned[both.sum(axis=1) == 2][:, [place, (place + 1) % 3]], (tip, near)).all()
    assert pressed_spikes(sheet, turned)[1] == 0


def test_a_surface_in_a_few_pieces_is_kept_whole():
    vertices, faces = FOOT
    beyond = vertices[faces].mean(axis=1) > np.median(vertices, axis=0)
    moved = vertices[faces] + np.where(beyond, 0.5, -0.5)[:, None, :]  # the octants, apart
    mesh = cleaned(moved.reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    assert len(mesh.faces) == len(faces)
    assert not mesh.info.watertight


def test_a_surface_in_thousands_of_pieces_is_refused():
    vertices, faces = FOOT
    pieces = vertices[faces] * 0.98 + 0.02 * vertices[faces].mean(axis=1, keepdims=True)
    with pytest.raises(DamagedMesh, match="pieces"):
        cleaned(pieces.reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))


@pytest.mark.parametrize("seed", range(4))
def test_a_floor_plate_beside_the_foot_is_taken_off_in_any_pose(seed):
    foot = FOOT[0] + [0.0, 0.0, 40.5], FOOT[1]
    scene = distortions.joined(foot, _floor(z=0.0))
    mesh = cleaned(*posed(*scene, seed))
    assert "plate_removed" in codes(mesh)
    assert len(mesh.faces) == len(FOOT[1])


def test_a_flat_noisy_sole_does_not_hide_the_floor():
    vertices, faces = FOOT
    flat = np.maximum(vertices, [-np.inf, -np.inf, -20.0]) + np.array([0.0, 0.0, 20.0])
    noisy = distortions.white_noise(flat, rng(), 0.5)
    mesh = cleaned(*posed(*distortions.joined((noisy, faces), _floor(z=0.0))))
    assert "plate_removed" in codes(mesh)
    assert len(mesh.faces) == len(faces)


def test_the_largest_thick_piece_says_what_is_a_floor():
    """A small thing beside the plate, which hangs through its plane, does not make it a part."""
    foot = FOOT[0] + [0.0, 0.0, 40.5], FOOT[1]
    mesh = cleaned(*distortions.joined(foot, small(36.0, [350.0, 0.0, 0.0]), _floor(z=0.0)))
    assert "plate_removed" in codes(mesh)


def _floor(z, size=(400.0, 300.0), cells=20):
    vertices, faces = shapes.flat_sheet(*size, cells)
    return vertices - vertices.mean(axis=0) + np.array([0.0, 0.0, z]), faces


def test_a_lid_and_a_sheet_alone_are_no_floor():
    lid = _floor(z=41.0, size=(80.0, 60.0))
    assert "plate_removed" not in codes(cleaned(*distortions.joined(FOOT, lid)))
    assert "plate_removed" not in codes(cleaned(*_floor(z=0.0)))
    across = _floor(z=0.0)  # the foot would lie on both sides
    assert "plate_removed" not in codes(cleaned(*distortions.joined(FOOT, across)))


@given(seed=st.integers(0, 10**6), share=st.floats(0.0, 1.0), is_open=st.booleans())
@settings(max_examples=40, deadline=None)
def test_winding_becomes_outward_whatever_it_was(seed, share, is_open):
    vertices, faces = posed(*FOOT, seed)
    if is_open:
        vertices, faces = distortions.with_holes(vertices, faces, rng(seed), 2, 20.0)
    turned = rng(seed).random(len(faces)) < share
    mixed = np.where(turned[:, None], faces[:, ::-1], faces)
    mesh = cleaned(vertices, mixed)
    assert is_consistently_wound(mesh.faces)
    assert signed_volume(mesh.vertices_mm, mesh.faces) > 0.0
    assert ("winding_fixed" in codes(mesh)) == bool(turned.any())
    assert ("open_mesh" in codes(mesh)) == is_open


def test_every_piece_looks_outward():
    one, other = FOOT, distortions.inside_out(*FOOT)
    scene = distortions.joined(one, (other[0] + [0.0, 150.0, 0.0], other[1]))
    mesh = cleaned(*scene)
    assert message(mesh, "winding_fixed").startswith(f"{len(FOOT[1]):,} ")
    assert signed_volume(mesh.vertices_mm, mesh.faces) == pytest.approx(2.0 * signed_volume(*FOOT))


def test_a_fin_is_said_to_be_non_manifold():
    vertices, faces = FOOT
    fin = [[faces[0, 0], faces[0, 1], len(vertices)]]
    mesh = cleaned(np.vstack([vertices, [0.0, 0.0, 90.0]]), np.vstack([faces, fin]))
    assert {"non_manifold", "open_mesh"} <= set(codes(mesh))
    assert not mesh.info.watertight


def test_watertight_agrees_with_the_topology():
    for vertices, faces in (FOOT, shapes.flat_sheet(), shapes.open_cap(), shapes.torus()):
        assert cleaned(vertices, faces).info.watertight == is_closed(faces)


def test_a_stray_unused_vertex_changes_nothing():
    vertices = np.vstack([FOOT[0], [1e9, 1e9, 1e9]])
    mesh = cleaned(vertices, FOOT[1])
    assert len(mesh.faces) == len(FOOT[1])
    assert np.ptp(mesh.vertices_mm[:, 0]) == pytest.approx(250.0)


def test_nothing_with_an_area_is_refused():
    point, line, dust = np.zeros((3, 3)), [[1, 1, 2]], FOOT[0] * 1e-200
    for vertices, faces in ((point, [[0, 1, 2]]), (FOOT[0], line), (dust, FOOT[1])):
        with pytest.raises(EmptyMesh):
            cleaned(vertices, np.array(faces))


@given(seed=st.integers(0, 10**6))
@settings(max_examples=20, deadline=None)
def test_order_does_not_matter(seed):
    scene = distortions.joined(FOOT, small(2.0, [0, 90.0, 0]))
    one, other = cleaned(*scene), cleaned(*distortions.shuffled(*scene, rng(seed)))
    assert codes(one) == codes(other)
    assert one.info.watertight == other.info.watertight
    assert surface_area(one.vertices_mm, one.faces) == pytest.approx(
        surface_area(other.vertices_mm, other.faces), rel=EXACT
    )
