"""Two feet in one file: refused by name, taken apart on request, each as if it came alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from footfit.meshes.write import encoded_mesh
from tests import packed, shapes
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES, Footfit
from tests.distortions import floor_plate, in_metres, joined, moved, random_pose
from tests.reading import read_scan


@pytest.fixture
def both(tmp_path: Path) -> Path:
    """A left and a right foot beside each other, posed as one, in metres."""
    left, right = (read_scan(path) for path in sorted((SAMPLES / "feet").glob("mh007_*.stl")))
    beside = right.vertices_mm - np.array([0.0, 150.0 + np.ptp(right.vertices_mm[:, 1]), 0.0])
    vertices, faces = joined((left.vertices_mm, left.faces), (beside, right.faces))
    posed = moved(vertices, random_pose(np.random.default_rng(11)))
    path = tmp_path / "both.stl"
    path.write_bytes(encoded_mesh(in_metres(posed), faces, "stl"))
    return path


def test_several_feet_are_refused_with_what_to_type(footfit: Footfit, both: Path) -> None:
    run = footfit("align", both)
    assert run.code == 5
    assert "--split" in run.last_error


@pytest.mark.parametrize(
    "command", [("ingest-last", "BOTH"), ("compare", "BOTH", "FOOT"), ("compare", "FOOT", "BOTH")]
)
def test_a_command_without_split_does_not_advise_it(
    command: tuple[str, ...], footfit: Footfit, both: Path, foot: Path, tmp_path: Path
) -> None:
    named = {"BOTH": both, "FOOT": foot}
    run = footfit(*(named.get(word, word) for word in command), "--catalogue", tmp_path / "c")
    assert run.code == 5
    assert str(both) in run.last_error
    assert "--split" not in run.err
    assert "save each in a file of its own" in run.last_error


def test_split_gives_each_foot_as_if_it_came_alone(footfit: Footfit, both: Path) -> None:
    lines = footfit("flare", both, "--split", "--json").lines
    assert [line["mesh"]["path"] for line in lines] == [f"{both}#1", f"{both}#2"]
    alone = footfit("flare", *sorted((SAMPLES / "feet").glob("mh007_*.stl")), "--json").lines
    ours = {line["side"]: line["flare_angle_deg"] for line in lines}
    theirs = {line["side"]: line["flare_angle_deg"] for line in alone}
    assert set(ours) == {"left", "right"}
    for side, angle in ours.items():
        assert angle == pytest.approx(theirs[side], abs=ROUNDING)


def test_one_foot_stays_one(footfit: Footfit, foot: Path, tmp_path: Path) -> None:
    document = footfit("align", foot, "--split", "--json").document
    assert document["mesh"]["path"] == str(foot)
    scan = read_scan(foot)
    vertices, faces = floor_plate(scan.vertices_mm, scan.faces)
    plate = tmp_path / "plate.stl"
    plate.write_bytes(encoded_mesh(vertices, faces, "stl"))
    assert len(footfit("align", plate, "--split", "--json").lines) == 1


def test_a_file_that_cannot_be_read_has_its_own_line(
    footfit: Footfit, both: Path, tmp_path: Path
) -> None:
    run = footfit("align", tmp_path / "none.stl", both, "--split", "--json")
    assert [line["schema"] for line in run.lines] == [
        "footfit.error/1",
        "footfit.align/2",
        "footfit.align/2",
    ]


def test_two_feet_in_one_file_can_be_one_customer(
    footfit: Footfit, both: Path, stocked: Path
) -> None:
    document = footfit(
        "match", both, "--split", "--pair", "--catalogue", stocked, "--json"
    ).document
    assert sorted(foot["side"] for foot in document["feet"]) == ["left", "right"]


def test_split_keeps_the_declared_unit_and_the_notices_of_the_file(
    footfit: Footfit, both: Path, tmp_path: Path
) -> None:
    scan = read_scan(both)
    faces = scan.faces.copy()
    faces[::2] = faces[::2, ::-1]  # some look inward: the reader turns them and says so
    path = tmp_path / "both.3mf"
    model = packed.model(scan.vertices_mm / 25.4, faces, 'unit="inch"')
    path.write_bytes(packed.threemf(model))
    lines = footfit("align", path, "--split", "--json").lines
    assert [line["mesh"]["path"] for line in lines] == [f"{path}#1", f"{path}#2"]
    for line in lines:
        assert (line["mesh"]["units"], line["mesh"]["units_source"]) == ("in", "declared")
        assert line["mesh"]["sha256"] == read_scan(path).info.sha256
        assert line["mesh"]["watertight"]
        assert "winding_fixed" in {notice["code"] for notice in line["warnings"]}
    faces_of_both = sum(line["mesh"]["faces"] for line in lines)
    assert faces_of_both == len(scan.faces)


def test_split_says_what_was_left_out_beside_the_feet(
    footfit: Footfit, both: Path, tmp_path: Path
) -> None:
    scan = read_scan(both)
    third = shapes.ellipsoid((30.0, 20.0, 20.0), subdivisions=3)
    away = scan.vertices_mm.max(axis=0) + 100.0
    vertices, faces = joined((scan.vertices_mm, scan.faces), (third[0] + away, third[1]))
    path = tmp_path / "three.ply"
    path.write_bytes(encoded_mesh(vertices, faces, "ply"))
    lines = footfit("align", path, "--split", "--json").lines
    assert len(lines) == 2
    for line in lines:
        assert "pieces_removed" in {notice["code"] for notice in line["warnings"]}
