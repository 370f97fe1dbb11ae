"""Foot or last: toes decide where the fit does not, a doubt is said, and ``--kind`` ends it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import footfit as library
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.pose.toes import has_toes
from footfit.meshes.write import encoded_mesh
from tests.conftest import SCANS, Footfit
from tests.distortions import moved, random_pose, white_noise
from tests.reading import read_scan
from tests.tube_feet import tube_foot
from tools.last_specs import wide
from tools.lasts import last_mesh
from tools.resting import at_rest

TUBE_FEET = {
    "plain": tube_foot(255.0),
    "child": tube_foot(150.0, wide=1.08),
    "bunion": tube_foot(270.0, bunion=0.03),
    "leg to the knee": tube_foot(250.0, leg=1.5),
}
"""All of these fit the template of a last better than that of a foot."""
SOCK = tube_foot(255.0, sock=True)


def posed(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    return moved(vertices, random_pose(np.random.default_rng(5))), faces


@pytest.mark.parametrize("name", TUBE_FEET)
def test_a_crude_foot_with_five_toes_is_a_foot(name: str) -> None:
    pose = library.align(posed(*TUBE_FEET[name]), units="mm").alignment.pose
    assert (pose.kind, pose.kind_confidence) == ("foot", "sure")


@pytest.mark.parametrize(("style", "heel"), [("shoe", 10.0), ("child", 5.0), ("boot", 50.0)])
def test_a_last_has_no_toes_also_with_noise(style: str, heel: float) -> None:
    rng = np.random.default_rng(3)
    spec = wide(rng, style, (heel, heel + 1.0), rings=100, segments=72)
    vertices, faces = last_mesh(spec)
    vertices = at_rest(white_noise(vertices, rng, 0.3))[0]
    about = (vertices - [vertices[:, 0].min(), 0.0, 0.0]) / spec.length_mm
    assert not has_toes(about, faces)
    pose = library.align((vertices, faces), units="mm").alignment.pose
    assert pose.kind == "last"


def test_one_dent_in_the_front_is_no_toe() -> None:
    vertices, faces = last_mesh(wide(np.random.default_rng(3), "shoe", (10.0, 11.0)))
    about = (vertices - [vertices[:, 0].min(), 0.0, 0.0]) / np.ptp(vertices[:, 0])
    dent = np.linalg.norm(about[:, :2] - [0.86, about[:, 1].mean()], axis=1) < 0.012
    about[dent & (about[:, 2] > 0.05)] -= [0.0, 0.0, 0.01]
    assert not has_toes(about, faces)


def test_a_foot_in_a_sock_is_in_doubt_and_the_kind_that_is_given_counts() -> None:
    mesh = posed(*SOCK)
    doubted = library.measure(mesh, units="mm")
    assert (doubted.alignment.pose.kind, doubted.to_dict()["kind_confidence"]) == ("last", "low")
    (notice,) = [each for each in doubted.alignment.warnings if each.code == "kind_doubtful"]
    assert notice.message.endswith("if it is a foot, add --kind foot")
    given = library.measure(mesh, units="mm", kind="foot")
    assert (given.to_dict()["kind"], given.to_dict()["kind_confidence"]) == ("foot", "given")
    assert "kind_doubtful" not in {each.code for each in given.alignment.warnings}
    assert "stick_length" not in {each.name for each in given.measures}
    assert given.alignment.length_mm == pytest.approx(doubted.alignment.length_mm, abs=3.0)


def test_the_commands_say_the_kind_and_take_it(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    scan = tmp_path / "sock.stl"
    scan.write_bytes(encoded_mesh(*SOCK, "stl"))
    doubt = "it is taken for a last, but that is not sure: if it is a foot, add --kind foot"
    aligned, measured = footfit("align", scan), footfit("measure", scan)
    assert "last (detected, not sure)" in aligned.out
    assert "measured as a last (detected, not sure)" in " ".join(measured.out.split())
    assert doubt in aligned.err
    assert doubt in measured.err
    matched = footfit("match", scan, "--catalogue", stocked)
    assert doubt in matched.err
    assert "nearer to a last's" in matched.err
    given = footfit("match", scan, "--kind", "foot", "--catalogue", stocked)
    assert "--kind" not in given.err
    assert "nearer to a last's" not in given.err
    assert footfit("measure", scan, "--kind", "foot", "--json").document["kind"] == "foot"


@pytest.mark.skipif(not SCANS.exists(), reason="the scans beside the project are not here")
@pytest.mark.parametrize("name", ["dupontgu_R", "MHR_template_L"])
def test_a_real_foot_without_visible_toes_stays_a_foot(name: str) -> None:
    alignment = library.align(read_scan(SCANS / f"{name}.stl")).alignment
    assert (alignment.pose.kind, alignment.pose.kind_confidence) == ("foot", "low")
    assert "kind_doubtful" not in {each.code for each in alignment.warnings}
