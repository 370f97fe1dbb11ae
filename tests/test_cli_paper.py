"""The paper's methods from the command line, on the sample lasts; and the unit that is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from footfit.geometry.numeric.rotations import angle_deg
from footfit.meshes.write import encoded_mesh
from footfit.results.values import RATIO_DIGITS
from tests.bounds import printed
from tests.conftest import SAMPLES, Footfit
from tests.distortions import in_metres
from tests.reading import read_scan

PRINTED_TWICE = 2 * printed(RATIO_DIGITS)
"""Two transforms that are the same may differ by this after printing; measured: 0."""
LASTS = sorted((SAMPLES / "lasts").glob("*.stl"))


def shown(footfit: Footfit, catalogue: Path, last: str) -> dict[str, object]:
    return footfit("show-last", last, "--catalogue", catalogue, "--json").document


def aligned(footfit: Footfit, catalogue: Path, path: Path, *options: object) -> dict[str, object]:
    return footfit("align", path, "--catalogue", catalogue, "--json", *options).document


@pytest.mark.parametrize("path", LASTS, ids=lambda path: path.stem)
def test_a_last_aligned_to_itself_lies_in_its_canonical_frame(
    footfit: Footfit, stocked: Path, path: Path
) -> None:
    """R and P_c of the mesh, and OM_E and the centroid of the reference, by the same equations."""
    document = aligned(footfit, stocked, path, "--method", "paper", "--to", path.stem)
    reference = document["reference"]
    assert isinstance(reference, dict)
    assert reference["last"] == path.stem
    canonical = np.array(shown(footfit, stocked, path.stem)["transform"])
    np.testing.assert_allclose(document["transform"], canonical, rtol=0.0, atol=PRINTED_TWICE)


def test_the_stored_paper_transform_is_what_method_paper_does(
    footfit: Footfit, stocked: Path
) -> None:
    """So ``paper_frame_angle_deg`` is what the printed method would have cost."""
    for path in LASTS[::3]:
        record = shown(footfit, stocked, path.stem)
        document = aligned(footfit, stocked, path, "--method", "paper")
        stored, found = np.array(record["paper_transform"]), np.array(document["transform"])
        if record["side"] == "left":  # stored for the mirrored file: Eq. 1 comes after mirroring
            stored = np.diag([1.0, -1.0, 1.0, 1.0]) @ stored @ np.diag([-1.0, 1.0, 1.0, 1.0])
        np.testing.assert_allclose(found, stored, rtol=0.0, atol=PRINTED_TWICE)
        cost_deg = angle_deg(found[:3, :3], np.array(record["transform"])[:3, :3])
        # for the printed decimals of two transforms and of the angle; measured: 2.4e-4 deg
        assert record["paper_frame_angle_deg"] == pytest.approx(cost_deg, abs=4.8e-4)
        printed = record["printed_frame"]
        assert isinstance(printed, dict)
        for key, value in printed.items():
            assert document[key] == value


@pytest.mark.parametrize("left", [False, True])
def test_paper_literal_is_om_e_v_prime(
    footfit: Footfit, stocked: Path, tmp_path: Path, left: bool
) -> None:
    """As printed, R cancels; a left shape is mirrored in the file before, and back after."""
    path = LASTS[0]
    if left:
        scan = read_scan(path)
        path = tmp_path / "left.stl"
        mirrored = scan.vertices_mm * [-1.0, 1.0, 1.0]
        path.write_bytes(encoded_mesh(mirrored, scan.faces[:, ::-1], "stl"))
    document = aligned(footfit, stocked, path, "--method", "paper-literal", "--to", LASTS[-1].stem)
    assert document["side"] == ("left" if left else "right")
    reference = document["reference"]
    assert isinstance(reference, dict)
    om_e = np.array(reference["om_e"])
    if left:
        om_e = np.diag([1.0, -1.0, 1.0]) @ om_e @ np.diag([-1.0, 1.0, 1.0])
    assert np.allclose(np.array(document["transform"])[:3, :3], om_e, rtol=0.0, atol=PRINTED_TWICE)


def test_another_detected_unit_is_said_once_and_is_a_warning(
    footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    scan = read_scan(foot)
    path = tmp_path / "metres.stl"
    path.write_bytes(encoded_mesh(in_metres(scan.vertices_mm), scan.faces, "stl"))
    run = footfit("align", path, "--json")
    assert run.err.count("taken as metres") == 1
    codes = [warning["code"] for warning in run.document["warnings"]]
    assert codes.count("units_detected") == 1


def test_a_length_that_a_declared_unit_makes_impossible_is_said_in_words(
    footfit: Footfit, foot: Path
) -> None:
    run = footfit("align", foot, "--units", "in")
    assert run.code == 3
    assert "taken as inches, the length is" in run.err
    assert len(run.err.strip().splitlines()) == 1
