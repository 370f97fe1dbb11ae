"""Which meshes a command was given."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import pytest

from footfit.errors import BadOption, UnreadableFile
from footfit.pipeline.batch.sources import left_out, mesh_sources


def touched(folder: Path, *names: str) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()


def names(sources: list, folder: Path) -> list[str]:
    return [str(Path(source.path).relative_to(folder)) for source in sources]


def test_a_folder_gives_its_meshes_sorted_and_nothing_else(tmp_path: Path) -> None:
    touched(tmp_path, "b.stl", "a.OBJ", "deep/c.ply", "notes.txt", ".hidden.stl", ".venv/d.stl")
    assert names(mesh_sources([str(tmp_path)]), tmp_path) == ["a.OBJ", "b.stl", "deep/c.ply"]


def test_a_glob_is_expanded_where_the_shell_did_not(tmp_path: Path) -> None:
    touched(tmp_path, "l1.stl", "l2.stl", "x.ply")
    assert names(mesh_sources([str(tmp_path / "l*.stl")]), tmp_path) == ["l1.stl", "l2.stl"]


def test_a_glob_may_begin_in_the_folder_above(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("run/a.stl", "here/b.stl"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).touch()
    monkeypatch.chdir(tmp_path / "here")
    assert [source.path for source in mesh_sources(["../run/*.stl"])] == ["../run/a.stl"]


def test_a_file_whose_name_is_a_glob_is_that_file(tmp_path: Path) -> None:
    touched(tmp_path, "foot[1].stl")
    assert names(mesh_sources([str(tmp_path / "foot[1].stl")]), tmp_path) == ["foot[1].stl"]


def test_each_file_comes_once(tmp_path: Path) -> None:
    touched(tmp_path, "a.stl", "b.stl")
    given = [str(tmp_path / "b.stl"), str(tmp_path)]
    assert names(mesh_sources(given), tmp_path) == ["b.stl", "a.stl"]


def test_a_missing_file_is_kept_so_that_its_own_line_says_so() -> None:
    assert [source.path for source in mesh_sources(["nowhere.stl"])] == ["nowhere.stl"]


@pytest.mark.parametrize("argument", ["", "*.stl"])
def test_a_folder_or_glob_without_a_mesh_is_refused(tmp_path: Path, argument: str) -> None:
    touched(tmp_path, "notes.txt")
    with pytest.raises(UnreadableFile, match="holds no mesh"):
        mesh_sources([str(tmp_path / argument) if argument else str(tmp_path)])


@pytest.mark.parametrize("argument", ["**x/*.stl", "y" * 300 + ".stl"])
def test_what_the_system_will_not_look_up_has_its_own_line(argument: str) -> None:
    assert [source.path for source in mesh_sources([argument, "foot.stl"])] == [
        argument,
        "foot.stl",
    ]


def test_an_empty_argument_is_not_the_current_folder() -> None:
    with pytest.raises(BadOption, match="empty"):
        mesh_sources([""])


@pytest.mark.parametrize("argument", ["", "*.stl"])
def test_beside_others_a_folder_or_glob_without_a_mesh_costs_its_own_line_only(
    tmp_path: Path, argument: str
) -> None:
    touched(tmp_path, "a.stl")
    (tmp_path / "empty").mkdir()
    bare, good = str(tmp_path / "empty" / argument), str(tmp_path / "a.stl")
    assert [source.path for source in mesh_sources([bare, good])] == [bare, good]


def test_files_of_other_kinds_are_counted(tmp_path: Path) -> None:
    touched(tmp_path, "a.stl", "a.usdz", "b.USDZ", "sub/c.gltf", "d.zip", "lasts.csv", ".x.zip")
    for argument in (tmp_path, tmp_path / "**" / "*"):
        (notice,) = left_out(str(argument))
        assert notice.message.startswith("4 files were left out (1 gltf, 2 usdz, 1 zip); ")
    assert left_out(str(tmp_path / "*.stl")) == left_out(str(tmp_path / "a.usdz")) == ()
    (tmp_path / "a.stl").unlink()
    with pytest.raises(UnreadableFile, match="2 usdz"):
        mesh_sources([str(tmp_path)])


def test_a_path_is_found_in_the_other_unicode_form(tmp_path: Path) -> None:
    """macOS writes an accent as a character of its own (NFD); keyboards write one (NFC)."""
    forms = [unicodedata.normalize(form, "Zoë é.stl") for form in ("NFC", "NFD")]
    for stored, typed in (forms, forms[::-1]):
        touched(tmp_path, stored)
        (source,) = mesh_sources([str(tmp_path / typed)])
        assert Path(source.path or "").is_file()
        (tmp_path / stored).unlink()
