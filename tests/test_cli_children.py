"""A child's foot: what length is usual follows the fit profile."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from footfit.errors import BadProfile
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.fit.fit_profile import FOLDER, fit_profile, profile_of
from tests.conftest import Footfit
from tests.reading import read_scan

CHILD = ("--profile", "child")


def foot_of(length_mm: float, foot: Path, folder: Path) -> Path:
    """A sample foot, scaled to a length."""
    scan = read_scan(foot)
    scale = length_mm / float(np.ptp(scan.vertices_mm, axis=0).max())
    path = folder / f"{length_mm:.0f}.stl"
    path.write_bytes(encoded_mesh(scale * scan.vertices_mm, scan.faces, "stl"))
    return path


@pytest.mark.parametrize(
    ("length_mm", "given", "unusual"),
    [
        (126.0, CHILD, False),
        (176.0, CHILD, False),
        (250.0, CHILD, False),
        (300.0, CHILD, True),
        (126.0, (), True),
        (176.0, (), True),
        (250.0, (), False),
        (126.0, ("--profile", "walking"), True),
    ],
)
def test_the_lengths_follow_the_profile(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path,
    length_mm: float, given: tuple[str, ...], unusual: bool,
) -> None:  # fmt: skip
    scan = foot_of(length_mm, foot, tmp_path)
    for command in (("measure",), ("match", "--by", "flare", "--catalogue", stocked)):
        run = footfit(command[0], scan, *command[1:], *given)
        assert run.code == 0
        assert ("is unusual; feet" in run.err) == (unusual and length_mm >= 180)
        assert ("outside the usual" in run.err) == (unusual and length_mm < 180)
        document = footfit(command[0], scan, *command[1:], *given, "--json").document
        feet = document.get("feet", [document])
        codes = {notice["code"] for answer in (document, *feet) for notice in answer["warnings"]}
        assert ({"suspect_measure", "length_unusual"} & codes != set()) == unusual


def test_a_childs_foot_whose_number_is_a_mans_in_inches_asks_for_the_unit(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    """12.6 is 126 mm in cm and 320 mm in inches: the usual unit is one of an adult's."""
    scan = foot_of(12.6, foot, tmp_path)
    for command in (("measure",), ("match", "--catalogue", stocked)):
        run = footfit(command[0], scan, *command[1:], *CHILD)
        assert run.code == 3
        assert (
            "mm in centimetres. The profile is for feet of 110-260 mm: give --units cm" in run.err
        )
        assert footfit(command[0], scan, *command[1:], *CHILD, "--units", "cm").code == 0
        assert "taken as inches" in footfit(command[0], scan, *command[1:]).err


def test_a_short_foot_gets_the_hint(footfit: Footfit, foot: Path, tmp_path: Path) -> None:
    scan = foot_of(150.0, foot, tmp_path)
    assert "is this a child's foot? add --profile child" in footfit("measure", scan).err


def test_a_profile_of_ones_own_says_its_lengths() -> None:
    text = (FOLDER / "child.toml").read_text(encoding="utf-8")
    child = fit_profile("child")
    assert child.usual_length_mm == (110.0, 260.0)
    other = profile_of(text.replace("[110, 260]", "[150, 200]"))
    assert other.usual_length_mm == (150.0, 200.0)
    assert other.sha256 == child.sha256, "the rules are the same"
    for bad in ("[260, 110]", "[1, 2, 3]", "'short'", "110"):
        with pytest.raises(BadProfile, match="usual_length_mm"):
            profile_of(text.replace("[110, 260]", bad))
    assert fit_profile("walking").usual_length_mm is None


def test_an_unknown_profile_is_refused(footfit: Footfit, foot: Path) -> None:
    run = footfit("measure", foot, "--profile", "baby")
    assert (run.code, len(run.err.splitlines())) == (2, 1)
    assert "child" in run.err
