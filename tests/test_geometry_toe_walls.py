"""The toes against the wall of a last: planted outlines, and the lasts of both families."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.named_sections import toes_outline_mm
from footfit.geometry.fit.toe_walls import TOE_BOX, TOES, WALLS, ToesInLasts, ToesPlan
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.flare import shape_flare
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import Profiled
from tests.conftest import SCANS
from tools.bent_lasts import bent
from tools.lasts import LastSpec, last_mesh

Solid = tuple[Floats, Ints]
SECOND = SCANS.parent / "tools" / "lasts2.py"
EXACT_MM = 1e-3
STEP_MM = 0.8
"""Of planted outlines, whose stations are 2 mm apart."""
SAME_MM = 1.2
"""A foot that fills a last; measured: 0.76 mm, of two lasts of each family."""
BENT_MM = 1.2
"""The same foot in a last that was bent to another heel; measured: 0.65 mm."""
STRAIGHT = np.column_stack([np.linspace(0.0, 300.0, 61), np.zeros(61)])


def edges(length_mm: float, outer_mm: float, inner_mm: float) -> Floats:
    """The outline of a board with straight edges and a square end."""
    x = np.linspace(0.60, 0.998, 80) * length_mm
    return np.column_stack([x, np.full(80, outer_mm), np.full(80, inner_mm)])


def board(length_mm: float = 270.0, outer_mm: float = -45.0, inner_mm: float = 40.0) -> ToesPlan:
    return toe_walls.last_plan(edges(length_mm, outer_mm, inner_mm), middle(outer_mm, inner_mm))


def middle(outer_mm: float, inner_mm: float) -> Floats:
    """The centre line of a board."""
    return STRAIGHT + np.array([0.0, 0.5 * (outer_mm + inner_mm)])


def foot(
    outer_mm: float = -40.0, inner_mm: float = 35.0, bulge: tuple[float, float] = (0.0, 0.0)
) -> ToesPlan:
    """A board as a foot of 250 mm; its toes stand out by ``bulge`` mm to the outside and inside.

    Behind the toes it is as wide as a tread, so that they do not move its placement.
    """
    outline = edges(250.0, outer_mm, inner_mm)
    outline[outline[:, 0] > 0.83 * 250.0, 2] += bulge[1]
    outline[outline[:, 0] > 0.75 * 250.0, 1] -= bulge[0]
    return toe_walls.foot_plan(outline, middle(outer_mm, inner_mm))


def lay(shape: ToesPlan, *lasts: ToesPlan, room_mm: float = 14.0) -> ToesInLasts:
    count = len(lasts)
    return toe_walls.toes_in_lasts(
        shape, toe_walls.walls(lasts), np.full(count, room_mm), np.ones((count, 2))
    )


def tightest(inside: ToesInLasts, row: int = 0) -> tuple[str, str, float]:
    toe = int(inside.value_mm[row].argmin())
    return TOES[toe], WALLS[inside.wall[row, toe]], float(inside.value_mm[row, toe])


@pytest.mark.parametrize(
    ("bulge", "room_mm", "toe", "wall", "value_mm"),
    [
        ((0.0, 8.0), 14.0, "big toe", "inner", -3.0),
        ((9.0, 0.0), 14.0, "little toe", "outer", -4.0),
        ((0.0, 0.0), -2.0, "big toe", "front", -2.0),
        ((0.0, 3.0), 14.0, "big toe", "inner", 2.0),
    ],
)
def test_the_toe_that_touches_is_named_with_its_wall(
    bulge: tuple[float, float], room_mm: float, toe: str, wall: str, value_mm: float
) -> None:
    inside = lay(foot(bulge=bulge), board(), room_mm=room_mm)
    if wall == "front":  # all toes of a square end touch alike
        inside = lay(foot(bulge=bulge), board(outer_mm=-62.5, inner_mm=57.5), room_mm=room_mm)
        np.testing.assert_allclose(inside.value_mm[0], value_mm, atol=STEP_MM)
        assert set(inside.wall[0]) == {WALLS.index("front")}
        return
    assert tightest(inside)[:2] == (toe, wall)
    assert tightest(inside)[2] == pytest.approx(value_mm, abs=STEP_MM)


def test_many_lasts_answer_as_each_alone() -> None:
    shape = foot(bulge=(2.0, 5.0))
    lasts = [board(), board(275.0, -42.0, 44.0), board(265.0, -50.0, 36.0)]
    together = lay(shape, *lasts)
    for row, last in enumerate(lasts):
        alone = lay(shape, last)
        np.testing.assert_allclose(together.value_mm[row], alone.value_mm[0], atol=EXACT_MM)
        np.testing.assert_array_equal(together.wall[row], alone.wall[0])


def test_a_foot_lies_the_same_whichever_way_its_frame_is_turned() -> None:
    shape, turn = foot(bulge=(1.0, 4.0)), 0.05
    slanted = edges(250.0, -41.0, 39.0)
    slanted[:, 1:] += turn * slanted[:, :1]
    middle = STRAIGHT + np.column_stack([np.zeros(61), turn * STRAIGHT[:, 0]])
    straight = lay(toe_walls.foot_plan(edges(250.0, -41.0, 39.0), STRAIGHT), board())
    turned = lay(toe_walls.foot_plan(slanted, middle), board())
    sides = [TOES.index("big toe"), TOES.index("little toe")]
    there, here = turned.value_mm[0, sides], straight.value_mm[0, sides]
    np.testing.assert_allclose(there, here, atol=STEP_MM)
    last = edges(270.0, -42.5, 42.5)
    last[:, 1:] += 0.01 * last[:, :1]  # its principal axis, not its frame
    again = lay(shape, toe_walls.last_plan(last, STRAIGHT))
    even = lay(shape, board(270.0, -42.5, 42.5))
    np.testing.assert_allclose(again.value_mm, even.value_mm, atol=EXACT_MM)


def test_a_foot_in_the_heel_is_narrower() -> None:
    shape = foot(outer_mm=-37.5, inner_mm=37.5)
    walls = toe_walls.walls([board(outer_mm=-42.5, inner_mm=42.5)] * 2)
    scale = np.array([[1.0, 1.0], [1.0, 0.98]])
    inside = toe_walls.toes_in_lasts(shape, walls, np.array([14.0, 14.0]), scale)
    assert np.ptp(inside.outline_mm[1, :, 1]) == pytest.approx(0.98 * 75.0)
    assert tightest(inside, 1)[2] > tightest(inside, 0)[2] + 0.5


def test_each_toe_has_its_share_of_the_width() -> None:
    inside = lay(foot(), board())
    y = inside.outline_mm[0, :, 1]
    for toe, share in enumerate((0.0, *TOE_BOX.shares)):
        own = y[inside.toe == toe]
        assert own.max() == pytest.approx(y.max() - share * np.ptp(y), abs=TOE_BOX.step_mm)


# ---------------------------------------------------------------- whole shapes


def own_lasts() -> list[Solid]:
    specs = [
        LastSpec(flare_deg=4.0, heel_height_mm=12.0, toe_shape="pointed"),
        LastSpec(flare_deg=9.0, heel_height_mm=35.0, toe_shape="round", toe_turn_deg=9.0),
    ]
    return [last_mesh(replace(spec, rings=90, segments=60)) for spec in specs]


def second_family() -> list[Solid]:
    if not SECOND.is_file():
        pytest.skip("../shared/tools/lasts2.py is not here; the project's own lasts are tested")
    spec = importlib.util.spec_from_file_location("lasts2", SECOND)
    assert spec is not None
    assert spec.loader is not None
    lasts2 = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = lasts2
    spec.loader.exec_module(lasts2)
    drawn = (lasts2.random_last(np.random.default_rng(seed)) for seed in (3, 8))
    meshes = [lasts2.mesh(parameters, n_long=120, n_round=72) for parameters in drawn]
    return [(np.asarray(mesh.vertices), np.asarray(mesh.faces)) for mesh in meshes]


def last_plan(profiled: Profiled) -> ToesPlan:
    """The toes of a scanned last."""
    outline_mm = toes_outline_mm(profiled.aligned.prepared.shape)
    assert outline_mm is not None
    middle = profiled.flare.centre_line * profiled.aligned.alignment.extent_mm
    return toe_walls.last_plan(outline_mm, middle)


def own_foot(profiled: Profiled, wider: float = 1.0) -> ToesPlan:
    """The toes of a foot that fills a last, or is wider than it: its bottom, laid flat."""
    flat = profiled.aligned.prepared.shape.flat_bottom.shape
    vertices_mm = flat.vertices * flat.length_mm * [1.0, wider, 1.0]
    foot = Shape(vertices_mm, flat.faces)
    outline_mm = toes_outline_mm(foot)
    assert outline_mm is not None
    middle = shape_flare(foot).centre_line
    return toe_walls.foot_plan(outline_mm, middle * float(np.ptp(vertices_mm[:, 0])))


@pytest.mark.parametrize("family", [own_lasts, second_family])
def test_a_foot_that_fills_a_last_lies_along_its_wall(family: Callable[[], list[Solid]]) -> None:
    for vertices, faces in family():
        scan = Source("last.stl", data=encoded_mesh(vertices, faces, "stl"), format="stl")
        profiled = profiled_source(scan, ReadingOptions(side="right"))
        last = last_plan(profiled)
        inside = lay(own_foot(profiled), last, room_mm=0.0)
        assert np.abs(inside.value_mm).max() < SAME_MM
        wider = lay(own_foot(profiled, 1.08), last, room_mm=0.0)
        half_mm = 0.5 * np.ptp(inside.outline_mm[0, :, 1])
        assert wider.value_mm.min() == pytest.approx(-0.08 * half_mm, abs=0.25 * 0.08 * half_mm)


def test_the_toes_do_not_feel_the_heel() -> None:
    """The same foot in a last and in the same last, bent to a higher heel."""
    vertices, faces = last_mesh(LastSpec(heel_height_mm=5.0, rings=110, segments=70))
    straight = Source("a.stl", data=encoded_mesh(vertices, faces, "stl"), format="stl")
    higher = bent(vertices, float(np.ptp(vertices[:, 0])), 45.0)
    raised = Source("b.stl", data=encoded_mesh(higher, faces, "stl"), format="stl")
    lasts = [profiled_source(scan, ReadingOptions(side="right")) for scan in (straight, raised)]
    low, high = (last_plan(profiled) for profiled in lasts)
    shape = own_foot(lasts[0], 0.95)
    inside = lay(shape, low, high, room_mm=12.0)
    assert np.abs(inside.value_mm[1] - inside.value_mm[0]).max() < BENT_MM
