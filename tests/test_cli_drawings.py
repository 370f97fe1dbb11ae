"""``footfit draw-last``: files, folders, lasts of the catalogue, refusals."""

from __future__ import annotations

import shutil
from pathlib import Path

from tests import paper
from tests.conftest import SAMPLES, Footfit

LAST = SAMPLES / "lasts" / "derby-40.stl"
FOOT = SAMPLES / "feet" / "mh007_L.stl"


def test_a_last_is_drawn_and_the_file_is_named(footfit: Footfit, tmp_path: Path) -> None:
    target = tmp_path / "sheet.svg"
    run = footfit("draw-last", LAST, "-o", target)
    assert run.code == 0
    assert run.err == f"wrote {target}\n"
    assert "bottom" in run.out
    assert paper.svg(target.read_bytes()).bars_mm
    again = footfit("draw-last", LAST, "-o", target)
    assert (again.code, "--force" in again.err) == (2, True)
    assert footfit("draw-last", LAST, "-o", target, "--force").code == 0


def test_many_lasts_have_a_folder_and_the_same_bytes_for_any_jobs(
    footfit: Footfit, tmp_path: Path
) -> None:
    (tmp_path / "lasts").mkdir()
    for name in ("derby-38", "loafer-42"):
        shutil.copy(SAMPLES / "lasts" / f"{name}.stl", tmp_path / "lasts")
    (tmp_path / "lasts" / "broken.stl").write_bytes(b"solid")
    run = footfit("draw-last", tmp_path / "lasts", "-o", tmp_path / "out", "--json")
    assert run.code == 3
    schemas = [line["schema"] for line in run.lines]
    assert schemas == ["footfit.error/1", "footfit.draw-last/1", "footfit.draw-last/1"]
    views = {view["name"]: view for view in run.lines[1]["views"]}
    length_mm = run.lines[1]["measures"]["bottom_length"]["value"]
    assert abs(views["bottom"]["height_mm"] - length_mm) < 0.002  # both are rounded to .001
    assert footfit("draw-last", tmp_path / "lasts", "-o", tmp_path / "two", "-j", 2).code == 3
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert names == ["derby-38.pdf", "loafer-42.pdf"]
    for name in names:
        first, second = (tmp_path / folder / name for folder in ("out", "two"))
        assert first.read_bytes() == second.read_bytes()


def test_a_last_of_the_catalogue_has_its_labels(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    target = tmp_path / "sheet.dxf"
    run = footfit("draw-last", "loafer-42", "-o", target, "--catalogue", stocked)
    assert run.code == 0
    text = " ".join(paper.dxf(target.read_bytes()).words)
    assert "loafer-42, right last, EU 42 E" in text
    assert "style loafer" in text
    assert "by the label" in text


def test_the_other_kind_is_refused_and_nothing_is_written(footfit: Footfit, tmp_path: Path) -> None:
    target = tmp_path / "sheet.pdf"
    run = footfit("draw-last", FOOT, "-o", target)
    assert run.code == 5
    assert run.last_error.endswith("a foot's, not a last's: add --foot to draw it as a foot")
    assert footfit("draw-last", LAST, "--foot", "-o", target).code == 5
    assert not target.exists()


def test_options_that_do_not_go_together_are_refused(footfit: Footfit, tmp_path: Path) -> None:
    for words in (
        ("-o", tmp_path / "sheet.png"),
        ("-o", tmp_path / "sheet.svg", "--paper", "a3"),
        ("-o", tmp_path / "sheet.pdf", "--paper", "a5"),
        (),
    ):
        assert footfit("draw-last", LAST, *words).code == 2
    assert not list(tmp_path.iterdir())
