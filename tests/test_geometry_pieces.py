"""Pieces, inside-out faces, sheets, cut ends."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.geometry.mesh.samples import quadrature
from footfit.geometry.mesh.topology import boundary_loops
from footfit.geometry.pose.facing import facing
from footfit.geometry.pose.missing_parts import doubtful_end, missing_part
from footfit.geometry.pose.pieces import comparable_pieces, gap, pieces, stand_apart
from tests import distortions, shapes
from tests.bounds import ROUNDING
from tools.lasts import LastSpec, last_mesh


@pytest.fixture(scope="module")
def last():
    return last_mesh(LastSpec(rings=40, segments=32))


def test_two_lasts_are_two_comparable_pieces_that_stand_apart(last):
    vertices, faces = shapes.two_feet(*last)
    parts = comparable_pieces(pieces(vertices, faces))
    assert len(parts) == 2
    first, second = (part.vertices for part in parts)
    assert stand_apart(first, second)
    # on a sample of vertices: never less than the true gap, and not much more
    assert 40.0 <= gap(first, second) < 70.0


def test_a_speck_and_an_inner_shell_are_not_two_feet(last):
    vertices, _ = last
    speck = shapes.cube(4.0, 2)
    both = distortions.joined(last, (speck[0] + [0, 90, 0], speck[1]))
    assert len(pieces(*both)) == 1
    assert not stand_apart(vertices, vertices * 0.97)


@pytest.mark.parametrize("seed", range(3))
def test_facing_knows_inside_from_outside_in_any_pose(last, seed):
    pose = distortions.random_pose(np.random.default_rng(seed))
    moved = distortions.moved(last[0], pose)
    looks, turned = facing(moved, last[1]), facing(*distortions.inside_out(moved, last[1]))
    assert looks.outward > 0.5
    assert turned.outward == pytest.approx(-looks.outward)
    assert looks.one_way < ROUNDING


def test_facing_of_a_sheet_and_of_a_half_sphere():
    assert facing(*shapes.flat_sheet()).one_way == pytest.approx(1.0)
    # a half sphere: the area vectors add up to its equator's disc, half of its area
    half = shapes.open_cap(50.0, 90.0)
    assert facing(*half).one_way == pytest.approx(0.5, abs=8e-5)  # measured 5e-5: the mesh


def rims_of(vertices, faces):
    return [vertices[loop] for loop in boundary_loops(faces)]


@pytest.mark.parametrize(("x", "towards", "missing"), [(80, -1, "heel"), (180, 1, "toes")])
def test_a_cut_end_is_missed(last, x, towards, missing):
    cut = distortions.plane_cut(*last, np.array([x, 0.0, 0.0]), np.array([towards, 0.0, 0.0]))
    sample = quadrature(*cut, 8.0)
    assert missing_part(sample, rims_of(*cut), 270.0) == missing


def test_a_closed_cut_end_is_missed_too():
    vertices, faces = shapes.cube(1.0, 8)
    box = vertices * [200.0, 90.0, 60.0] + [0.0, 0.0, 30.0]
    assert missing_part(quadrature(box, faces, 8.0), [], 270.0) == "heel"


@pytest.mark.parametrize("toe", ["round", "square", "pointed", "almond"])
def test_whole_lasts_and_cut_legs_miss_nothing(toe):
    last = last_mesh(LastSpec(toe_shape=toe, rings=60, segments=48))
    holed = distortions.with_holes(*last, np.random.default_rng(0), 40, 7.0)
    for mesh in (last, distortions.leg_cut(*last, 60.0), holed):
        assert missing_part(quadrature(*mesh, 8.0), rims_of(*mesh), 270.0) is None


def along(last, share, towards, axis):
    """The last beyond or below a share of its extent along an axis."""
    vertices, faces = last
    low, high = vertices[:, axis].min(), vertices[:, axis].max()
    at, normal = np.zeros(3), np.zeros(3)
    at[axis], normal[axis] = low + share * (high - low), towards
    return distortions.plane_cut(vertices, faces, at, normal)


def closed(mesh):
    """The mesh with each opening closed by a flat fan."""
    vertices, faces = mesh
    for loop in boundary_loops(faces):
        fan = np.stack([np.roll(loop, -1), loop, np.full(len(loop), len(vertices))], axis=1)
        vertices, faces = (
            np.vstack([vertices, vertices[loop].mean(axis=0)]),
            np.vstack([faces, fan]),
        )
    return vertices, faces


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
@pytest.mark.parametrize("towards", [1.0, -1.0])
@pytest.mark.parametrize("lid", [False, True])
def test_a_half_along_the_foot_misses_a_side(last, share, towards, lid):
    cut = along(last, share, towards, 1)
    mesh = closed(cut) if lid else cut
    assert missing_part(quadrature(*mesh, 8.0), rims_of(*mesh), 270.0) == "side"


@pytest.mark.parametrize("height_mm", [15.0, 25.0, 38.0])
@pytest.mark.parametrize("lid", [False, True])
def test_a_sole_slab_misses_its_upper_part_and_a_cut_at_50_mm_does_not(last, height_mm, lid):
    slab = distortions.leg_cut(*last, height_mm)
    mesh = closed(slab) if lid else slab
    assert missing_part(quadrature(*mesh, 8.0), rims_of(*mesh), 270.0) == "upper part"
    cut = distortions.leg_cut(*last, 50.0)
    assert missing_part(quadrature(*cut, 8.0), rims_of(*cut), 270.0) is None


def test_an_end_that_is_open_but_no_more_is_doubtful(last):
    cut = along(last, 0.97, 1.0, 0)
    sample, rims = quadrature(*cut, 8.0), rims_of(*cut)
    assert missing_part(sample, rims, 270.0) is None
    assert doubtful_end(sample, cut[0], rims, 270.0) == "toes"
    assert doubtful_end(quadrature(*last, 8.0), last[0], [], 270.0) is None
    shorter = along(last, 0.90, 1.0, 0)
    assert missing_part(quadrature(*shorter, 8.0), rims_of(*shorter), 270.0) == "toes"


def test_a_slanting_cut_through_the_toes_is_doubtful_and_a_slanting_leg_is_not(last):
    vertices, faces = last
    at = np.array([0.94 * vertices[:, 0].max(), 0.0, 6.0])
    toes = distortions.plane_cut(vertices, faces, at, np.array([0.35, 0.0, 0.94]))
    leg = distortions.plane_cut(
        vertices, faces, np.array([60.0, 0.0, 62.0]), np.array([-0.3, 0.0, 0.95])
    )
    assert missing_part(quadrature(*toes, 8.0), rims_of(*toes), 270.0) is None
    assert doubtful_end(quadrature(*toes, 8.0), toes[0], rims_of(*toes), 270.0) == "toes"
    assert missing_part(quadrature(*leg, 8.0), rims_of(*leg), 270.0) is None
    assert doubtful_end(quadrature(*leg, 8.0), leg[0], rims_of(*leg), 270.0) is None
