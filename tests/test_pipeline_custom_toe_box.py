"""The toe box of a custom last: wider and higher where the toes need it, and only there."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import footfit
from benchmarks import stance
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.last_making.custom import custom_making
from footfit.results import CustomLast, JudgedZone, ToeBoxChange
from tests.conftest import ROOT
from tests.custom_judge import kept_moves, mesh_changes
from tools.lasts import LastSpec, last_mesh

FOOT = ROOT / "sample_data" / "feet" / "mh007_R.stl"
BENT_DEG = {False: 2.0, True: 4.0}
"""The bar of the bend; the second one with --keep bottom."""


@cache
def foot():
    return footfit.flare(str(FOOT))


@cache
def base(family: str):
    """A last with a low toe box, or a high one: vertices and faces."""
    sizes = {"heel_width": 57.0, "ball_width": 92.0, "heel_height": 20.0}
    if family == "lasts2":
        if not stance.second_family():
            pytest.skip("../shared/tools/lasts2.py is not here; the project's own are tested")
        import lasts2

        spec = lasts2.Last2(length=266.0, toe_height=20.0, **sizes)
        mesh = lasts2.mesh(spec, n_long=110, n_round=72)
        return stance.at_rest(np.array(mesh.vertices))[0], np.array(mesh.faces)
    return last_mesh(
        LastSpec(
            length_mm=266.0,
            ball_width_mm=92.0,
            heel_width_mm=62.0,
            heel_height_mm=20.0,
            fullness=1.0 if family == "high" else 0.8,
            toe_shape="pointed" if family == "pointed" else "round",
            level_tread=True,
            rings=110,
            segments=80,
        )
    )


@cache
def custom(family: str, **asked: object) -> CustomLast:
    (made,) = footfit.customise(foot(), base(family), **asked)
    return made


def zone_of(made: CustomLast, name: str) -> JudgedZone:
    return next(zone for zone in made.judged if zone.name == name)


def unchanged(monkeypatch, family: str, **asked: object) -> CustomLast:
    """The custom last without any change for its toes."""
    with monkeypatch.context() as patch:
        patch.setattr(custom_making, "toe_box_plans", lambda *_: iter(()))
        (made,) = footfit.customise(foot(), base(family), **asked)
    return made


def shape_of(mesh: tuple[np.ndarray, np.ndarray]) -> Shape:
    """A mesh as it lies in its canonical frame."""
    return footfit.flare(mesh, units="mm", side="right").aligned.prepared.shape


def height_over_toe_mm(made: CustomLast) -> float:
    """The height of the written last where the foot has its toe height, read from its mesh."""
    shape = shape_of((made.vertices_mm, made.faces))
    room_mm = zone_of(made, "length").custom
    place = 1.0 - ((1.0 - HEIGHTS.toe) * foot().length_mm + room_mm) / shape.length_mm
    return float(np.ptp(shape.across(place).points[:, 1]))


@pytest.mark.parametrize("family", ["low", "lasts2"])
@pytest.mark.parametrize("keep", [False, True])
def test_a_low_toe_box_is_raised_behind_the_toe(monkeypatch, family, keep) -> None:
    asked = {"keep_bottom": True} if keep else {}
    plain, made = unchanged(monkeypatch, family, **asked), custom(family, **asked)
    before, after = (zone_of(each, "toe_height") for each in (plain, made))
    assert (before.custom_verdict, after.custom_verdict) == ("acceptable", "good")
    assert made.toe_box.higher_mm > 1.0
    (notice,) = (notice for notice in made.warnings if notice.code == "toe_box_changed")
    assert f"top {made.toe_box.higher_mm:.1f} mm up" in notice.message
    grown_mm = height_over_toe_mm(made) - height_over_toe_mm(plain)
    assert grown_mm == pytest.approx(after.custom - before.custom, abs=0.3)  # so it is real
    sound(made, bottom_kept=keep)


def test_walls_move_out_where_toes_stand_through_them(monkeypatch) -> None:
    """A pointed toe takes more than that: it becomes better, and the answer says why not good."""
    plain, made = unchanged(monkeypatch, "pointed"), custom("pointed")
    before, after = (zone_of(each, "toes").custom for each in (plain, made))
    assert after > before + 2.0
    assert made.toe_box.inner_mm > 2.0
    assert zone_of(made, "toes").why is not None
    sound(made, bottom_kept=False)


def sound(made: CustomLast, *, bottom_kept: bool) -> None:
    """Check what is kept, by a judge of its own, and the mesh."""
    ends = made.base_vertices_mm, made.vertices_mm, made.faces
    kept = kept_moves(*ends, shape_of((made.base_vertices_mm, made.faces)).upright)
    assert kept["toe"] < 0.1
    assert max(kept["bottom heights"], kept["toe spring"], kept["top plane"]) < 0.1
    changes = mesh_changes(*ends)
    assert changes["flipped"] == changes["intersections"] == 0.0
    assert changes["dihedral_deg"] < BENT_DEG[bottom_kept]
    assert changes["aspect"] < 2.0
    for zone in made.zones:
        assert abs(zone.reached - zone.target) < (0.3 if zone.name == "length" else 0.5), zone.name


def test_nothing_happens_where_the_toe_box_is_good(monkeypatch) -> None:
    made = custom("high")
    assert {zone_of(made, name).custom_verdict for name in ("toes", "toe_height")} == {"good"}
    assert made.toe_box == ToeBoxChange()
    assert not {"toe_box_changed", "toe_room_moved"} & {notice.code for notice in made.warnings}
    np.testing.assert_array_equal(made.vertices_mm, unchanged(monkeypatch, "high").vertices_mm)
