"""Lasts that footfit makes: they are lasts whatever their shape is near to, and bends are said."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfit
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.graded_runs.grade_run import file_of, file_scan
from footfit.pipeline.last_making.base_last import scanned_base
from footfit.pipeline.last_making.custom.bent_surface import bent_notices
from footfit.pipeline.last_making.custom.made_last import made_last
from footfit.pipeline.scan import one_shape
from footfit.results import CustomLast, RoomPlace
from tests.conftest import SAMPLES
from tests.custom_judge import mesh_changes
from tests.customs import custom_last
from tools.lasts import LastSpec, last_mesh


def test_a_last_that_footfit_makes_is_a_last_even_if_its_shape_is_near_to_a_foots(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "derby-42.stl"
    file.write_bytes(encoded_mesh(*last_mesh(LastSpec(rings=60, segments=48)), "stl"))
    base = scanned_base(Source(str(file)), ReadingOptions())
    stands = replace(base.shape.labels, heel_height_mm=25.0)
    monkeypatch.setattr(one_shape, "TOELESS_KIND", np.inf)
    monkeypatch.setattr(one_shape, "has_toes", lambda *_: True)
    assert footfit.align(file).alignment.pose.kind == "foot"
    graded = file_scan(file_of(base.shape, base), base, stands).shape
    made = made_last(base, base.shape.vertices_mm, "right", "custom")
    assert (graded.kind, made.shape.kind, made.prepared.pose.kind) == ("last", "last", "last")
    assert (graded.stance is None, made.record.stance_by) == (False, "shape")
    assert "looks_like_a_foot" not in [each.code for each in made.record.warnings]


def bent(by_deg: float, rooms: tuple[RoomPlace, ...] = ()) -> CustomLast:
    """A custom last of a sheet of two rows of faces, whose one bend is changed by an angle."""
    along = np.arange(4.0)
    x, y = (axis.ravel() for axis in np.meshgrid(along, np.array([-1.0, 0.0, 1.0])))
    flat_mm = np.column_stack([x, y, 0.0 * x])
    low, step = np.array([[k, k + 1, k + 5, k + 4] for k in (0, 1, 2, 4, 5, 6)]), np.radians(by_deg)
    faces = np.vstack([low[:, [0, 1, 2]], low[:, [0, 2, 3]]])
    up_mm = np.where(y > 0.0, np.sin(step), 0.0)
    bent_mm = np.column_stack([x, np.where(y > 0.0, np.cos(step), y), up_mm])
    return replace(
        custom_last(), base_vertices_mm=flat_mm, vertices_mm=bent_mm, faces=faces, rooms=rooms
    )


def test_a_surface_that_bends_too_far_is_said_with_what_to_do() -> None:
    assert bent_notices(bent(1.99), bottom_kept=False) == ()
    (notice,) = bent_notices(bent(2.7), bottom_kept=False)
    words = "1 % of the edges bend by more than 2.70 degrees, and up to 2.0 is usual"
    assert (notice.code, words in notice.message) == ("bent", True)
    assert "more faces than its 12" in notice.message
    assert bent_notices(bent(2.7), bottom_kept=True) == ()
    (kept,) = bent_notices(bent(4.2), bottom_kept=True)
    assert "up to 4.0 is usual" in kept.message
    (roomy,) = bent_notices(bent(2.7, (RoomPlace("toe-top", 4.0, 4.0),)), bottom_kept=False)
    assert roomy.message.endswith("give less room with --room")


def test_the_warning_stands_in_the_answer_and_on_the_page() -> None:
    """The bend is read by the judge's own ruler too."""
    feet, lasts = SAMPLES / "feet", SAMPLES / "lasts"
    foot, base = footfit.flare(feet / "mh008_R.stl"), lasts / "derby-43.stl"
    (plain,) = footfit.customise(foot, base)
    (roomy,) = footfit.customise(foot, base, room_mm={"ball-medial": 4.0})
    for made, said in ((plain, False), (roomy, True)):
        changes = mesh_changes(made.base_vertices_mm, made.vertices_mm, made.faces)
        codes = [each["code"] for each in made.to_dict()["warnings"]]
        assert ("bent" in codes) == (changes["dihedral_deg"] > 2.0) == said
        assert ("creases may show" in footfit.page(made)) == said
    words = f"more than {changes['dihedral_deg']:.2f} degrees"
    assert words in next(each.message for each in roomy.warnings if each.code == "bent")
