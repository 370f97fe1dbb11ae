"""The shipped samples are what sample_data/README.md says, and their maker makes them again."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.fit.compare import compared, stored_last
from footfit.pipeline.fit.fit_profile import fit_profile, shipped
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.shelf.candidates import choice
from tests.reading import read_scan
from tests.scans import aligned, cleaned
from tests.test_shapes import euler, is_closed_and_wound, volume
from tests.test_tools_lasts import band_across
from tools import make_sample_data as maker
from tools.lasts import centre_line_mm, last_mesh, true_flare_deg

ROOT = Path(__file__).resolve().parents[1]
SAMPLES = ROOT / "sample_data"
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl(path):
    """Welded vertices and faces of a binary STL."""
    data = path.read_bytes()
    records = np.frombuffer(data, RECORD, offset=84)
    assert int.from_bytes(data[80:84], "little") == len(records)
    vertices, faces = np.unique(records["corners"].reshape(-1, 3), axis=0, return_inverse=True)
    return vertices.astype(float), faces.reshape(-1, 3)


def rows():
    with (SAMPLES / "lasts.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def specs():
    """The spec of each last that the maker draws, by name."""
    return {
        f"{style.name}-{size}": maker.sized(style.model, size)
        for style in maker.STYLES
        for size, _, _ in style.lasts
    }


ROWS = {row["name"]: row for row in rows()}


def test_the_manifest_lists_every_last_and_no_other():
    listed = sorted(row["path"] for row in ROWS.values())
    assert listed == sorted(str(p.relative_to(SAMPLES)) for p in SAMPLES.glob("lasts/*"))
    assert tuple(next(iter(ROWS.values()))) == maker.COLUMNS
    assert len(ROWS) >= 12
    styles = [row["style"] for row in ROWS.values()]
    assert all(styles.count(style) >= 4 for style in set(styles))
    assert len(set(styles)) >= 3
    sides = [row["side"] for row in ROWS.values()]
    assert 2 <= sides.count("left") < sides.count("right")


def test_all_samples_together_are_under_five_megabytes():
    assert sum(p.stat().st_size for p in SAMPLES.rglob("*") if p.is_file()) < 5_000_000


@pytest.mark.parametrize("name", ROWS)
def test_a_last_is_sound_and_as_labelled(name):
    row = ROWS[name]
    vertices, faces = stl(SAMPLES / row["path"])
    vertices = vertices * {"mm": 1.0, "m": 1000.0}[row["units"]]
    assert is_closed_and_wound(faces)
    assert euler(faces) == 2
    assert volume(vertices, faces) > 0
    assert 5000 <= len(faces) <= 8000
    spec = specs()[name]
    assert float(row["heel_height_mm"]) == spec.heel_height_mm
    assert spec.length_mm == pytest.approx(int(row["size"]) * 20 / 3)
    drawn = last_mesh(spec)
    assert volume(vertices, faces) == pytest.approx(volume(*drawn), rel=3.3e-8)  # measured 2.2e-08


def chirality(vertices, faces):
    """Third-order moment that changes its sign in a mirror and not in a turn."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    weights = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    points = (a + b + c) / 3
    points = points - np.average(points, axis=0, weights=weights)
    _, axes = np.linalg.eigh((points * weights[:, None]).T @ points)
    local = points @ axes
    signs = np.sign(weights @ local**3)
    return np.linalg.det(axes) * np.prod(signs)


@pytest.mark.parametrize("name", ROWS)
def test_a_last_is_of_the_side_it_is_labelled(name):
    drawn = chirality(*last_mesh(specs()[name]))
    shipped = chirality(*stl(SAMPLES / ROWS[name]["path"]))
    assert shipped == pytest.approx(drawn * {"right": 1, "left": -1}[ROWS[name]["side"]])


def test_no_pose_is_canonical_and_no_two_are_alike():
    axes = []
    for row in ROWS.values():
        vertices, _ = stl(SAMPLES / row["path"])
        axes.append(np.linalg.svd(vertices - vertices.mean(axis=0), full_matrices=False)[2][0])
    axes = np.array(axes)
    assert np.abs(axes[:, 0]).max() < np.cos(np.radians(12))  # measured: 24 deg
    alike = np.abs(axes @ axes.T) - np.eye(len(axes))
    assert alike.max() < np.cos(np.radians(3.6))  # measured: 7.1 deg


def test_the_readme_states_the_planted_flare_and_the_sizes():
    text = (SAMPLES / "README.md").read_text(encoding="utf-8")
    for style in maker.STYLES:
        line = next(row for row in text.splitlines() if row.startswith(f"| {style.name} |"))
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        assert float(cells[3].split()[0]) == pytest.approx(true_flare_deg(style.model))
        assert float(cells[2].split()[0]) == style.model.heel_height_mm
        assert cells[4] == style.width_label
        sizes = [int(size) for size in re.findall(r"\d+", cells[5])]
        assert sizes == [size for size, _, _ in style.lasts]


@pytest.mark.parametrize("style", maker.STYLES, ids=lambda style: style.name)
def test_a_style_is_shaped_as_real_lasts_are(style):
    """Their inner joint lies at .673, .676 and .690 of the length, their ridge is medial."""
    vertices, faces = last_mesh(style.model)
    for s in np.linspace(0.06, 0.94, 12):
        low, high = band_across(style.model, vertices, faces, s)
        # between the rings' facets; measured: 1.4e-4
        assert abs(low + high) / 2 < 2.5e-4 * style.model.length_mm
    scan = aligned(cleaned(vertices, faces), side="right").prepared
    shape = Shape(scan.vertices_mm, scan.faces, "last")
    joint = (shape.mt1[0] - shape.x_mm(0.0)) / shape.length_mm
    assert 0.67 <= joint <= 0.692  # measured: .686 to .690
    middle = centre_line_mm(style.model, np.array([0.5]))[0]
    near = np.abs(vertices[:, 0] - middle[0]) < 5.0
    crown = vertices[near][np.argmax(vertices[near, 2])]
    assert crown[1] - middle[1] > 8.0  # measured: 14.8


@pytest.fixture(scope="module")
def feet():
    return {name: profiled_scan(aligned(read_scan(SAMPLES / "feet" / name))) for name in maker.FEET}


@pytest.mark.parametrize("name", maker.FEET)
def test_a_foot_lies_in_every_last_that_is_good_for_it(name, feet, stocked):
    """By the default profile it has a good last and a poor one, and no good last is pierced."""
    foot, everything = feet[name], choice(stocked, None, None)
    by_verdict = {
        profile: [
            (last.verdict, last.last)
            for last in matched(
                [foot], everything, Question(profile=fit_profile(profile), top=99)
            ).candidates
        ]
        for profile in shipped()
        if profile != "sandal"  # it has no wall in front of the toes
    }
    assert {"good", "poor"} <= {verdict for verdict, _ in by_verdict["walking"]}
    good = {last for each in by_verdict.values() for verdict, last in each if verdict == "good"}
    for last in good:
        for question in (heel_question(), heel_question(as_scanned=True)):
            clearance_mm = compared(foot, stored_last(stocked, last), question).clearance_mm
            assert np.nanmin(clearance_mm) > -3.0, last  # measured: -2.87


@pytest.mark.parametrize("name", maker.FEET)
def test_a_foot_is_sound_and_has_a_last_of_its_length(name):
    vertices, faces = stl(SAMPLES / "feet" / name)
    assert is_closed_and_wound(faces)
    length_mm = np.ptp(vertices[:, 0])
    text = (SAMPLES / "README.md").read_text(encoding="utf-8")
    assert f"{length_mm:.1f} mm" in text
    allowances = [maker.size_length_mm(int(row["size"])) - length_mm for row in ROWS.values()]
    assert sum(10 <= allowance <= 17 for allowance in allowances) >= 2


def test_the_maker_makes_the_shipped_samples_again(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for folder in (first, second):
        maker.write_samples(SAMPLES / "feet", folder)
    made = sorted(p.relative_to(first) for p in first.rglob("*") if p.is_file())
    shipped = {p.relative_to(SAMPLES) for p in SAMPLES.rglob("*") if p.is_file()}
    assert shipped == {*made, Path("README.md")}
    for path in made:
        content = (first / path).read_bytes()
        assert content == (second / path).read_bytes()
        if path.parts[0] == "lasts":  # another machine's sine may differ in the last bit
            new, old = (
                np.frombuffer(data, RECORD, offset=84)["corners"]
                for data in (content, (SAMPLES / path).read_bytes())
            )
            np.testing.assert_allclose(new, old, rtol=1e-5, atol=1e-3)
        else:
            assert content == (SAMPLES / path).read_bytes()
