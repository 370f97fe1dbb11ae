"""A base that is given as a file, and whose content a last of the catalogue has."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import footfit as library
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.graded_runs.base_labels import known_labels
from footfit.results import LastLabels
from tests.conftest import SAMPLES, Footfit
from tests.test_pipeline_grade import base_mesh

HEEL_MM = 24.0
"""As its label says; by its shape alone the heel is 15 mm high."""


@pytest.fixture
def stored(footfit: Footfit, tmp_path: Path) -> Path:
    """A file that a catalogue has under another name, with labels."""
    mesh, catalogue = tmp_path / "from-the-maker.stl", tmp_path / "lasts.footfit"
    mesh.write_bytes(encoded_mesh(*base_mesh(15.0), "stl"))
    labels = ("--size", "42", "--size-system", "eu", "--width-label", "G", "--family", "derby")
    named = ("--name", "derby-42", "--heel-height", f"{HEEL_MM:g}")
    done = footfit("ingest-last", mesh, *named, *labels, "--catalogue", catalogue)
    assert done.code == 0, done.err
    return mesh


def test_a_file_is_graded_like_the_last_of_the_catalogue_with_its_content(
    footfit: Footfit, stored: Path, tmp_path: Path
) -> None:
    catalogue = ("--catalogue", tmp_path / "lasts.footfit")
    grade = ("--sizes", "43", *catalogue)
    done = footfit("grade-last", stored, *grade, "--store", "-o", tmp_path / "run", "--json")
    assert done.code == 0, done.err
    assert done.document["base"] == "derby-42"
    assert [each["code"] for each in done.document["warnings"]][:1] == ["base_in_catalogue"]
    assert "has the content of 'derby-42' in the catalogue" in done.err
    (last,) = done.document["lasts"]
    heel = next(each for each in last["measures"] if each["name"] == "heel_height")
    with open_catalogue(catalogue[1]) as opened:
        record, made = opened.record(last["last"]), opened.parentage(last["last"])
        base = opened.record("derby-42")
    assert heel["base"] == pytest.approx(base.heel_height_mm, abs=0.1)
    assert record.heel_height_mm == pytest.approx(base.heel_height_mm, abs=0.2)
    assert record.labels.parent == "derby-42"
    assert made is not None
    assert made.made_by == "grade"


def test_a_file_with_the_name_but_not_the_content_of_a_last_is_no_base_to_store(
    footfit: Footfit, stored: Path, tmp_path: Path
) -> None:
    other = tmp_path / "derby-42.stl"
    vertices, faces = base_mesh(15.0)
    other.write_bytes(encoded_mesh(vertices * np.array([1.0, 1.02, 1.0]), faces, "stl"))
    known = ("--base-size", "42", "--size-system", "eu", "--sizes", "43")
    place = ("--catalogue", tmp_path / "lasts.footfit", "-o", tmp_path / "run")
    done = footfit("grade-last", other, *known, *place, "--store")
    assert (done.code, "has another content there" in done.err) == (2, True), done.err
    assert not (tmp_path / "run").exists()
    alone = footfit("grade-last", other, *known, *place, "--json")
    assert alone.code == 0, alone.err
    assert alone.document["warnings"] == []


def test_heights_that_are_given_win_over_those_of_the_catalogue(
    stored: Path, tmp_path: Path
) -> None:
    known = {"base_size": "42", "size_system": "eu"}
    with pytest.raises(BadOption, match="--store needs a base of the catalogue"):
        library.grade(
            stored, "43", catalogue=tmp_path / "lasts.footfit", store=True,
            heel_height_mm=15.0, **known,
        )  # fmt: skip


def test_a_custom_last_is_made_from_the_last_with_the_content_of_its_base(
    footfit: Footfit, stored: Path, tmp_path: Path
) -> None:
    """A file of that name with another content is not its parent."""
    foot = SAMPLES / "feet" / "mh008_R.stl"
    catalogue = tmp_path / "lasts.footfit"
    made = library.customise(
        foot, str(stored), catalogue=catalogue, store=True, name="anna", profile="walking"
    )
    assert made[0].base == "derby-42"
    assert made[0].record.labels.heel_height_mm == HEEL_MM
    assert "base_in_catalogue" in {each.code for each in made[0].warnings}
    library.store_custom(made, catalogue)
    with open_catalogue(catalogue) as opened:
        assert opened.record("anna").labels.parent == "derby-42"


def test_what_is_not_known_of_a_base_is_asked_for_together() -> None:
    nothing = LastLabels("derby")
    words = "add for example --size-system eu --base-size 42 --base-width F"
    with pytest.raises(BadOption, match=words):
        known_labels(nothing, {"widths": "F,G"}, "derby.stl")
    with pytest.raises(BadOption, match=r"the size of the base is not known: .* --base-size 42$"):
        known_labels(nothing, {"size_system": "eu"}, "derby.stl")
    for name, rule in (("jp", "jis"), ("Korea", "jis"), ("china", "china")):
        with pytest.raises(BadOption, match=f"--size-system mondopoint --rule {rule}"):
            known_labels(nothing, {"size_system": name}, "derby.stl")


def test_what_contradicts_a_label_is_refused() -> None:
    labels = LastLabels("derby-40", size="40", size_system="eu", width_label="G")
    for option, value, words in (
        ("base_size", "39", "its label has the size 40, and --base-size says 39: leave it out"),
        ("base_width", "F", "its label has the width G, and --base-width says F: leave it out"),
    ):
        with pytest.raises(BadOption, match=words):
            known_labels(labels, {option: value}, "derby-40")
    same = known_labels(labels, {"base_size": "40.0", "base_width": "g"}, "derby-40")
    assert (same.system.name, same.size) == ("eu", "40.0")
    other = known_labels(labels, {"size_system": "uk", "base_size": "6.5"}, "derby-40")
    assert (other.system.name, other.size) == ("uk", "6.5")
