"""footfit as a library: docs/library.md runs, the import is quick, results are tables."""

from __future__ import annotations

import contextlib
import io
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import footfit
from footfit import errors, results
from footfit.meshes.write import encoded_mesh
from footfit.results.values import MILLIMETRE_DIGITS
from tests.bounds import POSED, printed
from tests.conftest import ROOT, SAMPLES

PAGE = ROOT / "docs" / "library.md"
BLOCK = re.compile(
    r"^```python\n(?P<code>.*?)^```\n(\n```text\n.*?^```\n)?", re.MULTILINE | re.DOTALL
)
FEET, SMALLEST, LARGEST = 20, 0.95, 1.10


def fill_shop(folder: Path) -> Path:
    """The folder of the page: twenty feet of one shape in twenty sizes, and the sample lasts."""
    (folder / "feet").mkdir()
    scan = footfit.read(min((SAMPLES / "feet").iterdir()))
    sizes = [1.0, *np.linspace(SMALLEST, LARGEST, FEET - 1)]
    for number, size in enumerate(sizes, start=1):
        data = encoded_mesh(size * scan.vertices_mm, scan.faces, "stl")
        (folder / "feet" / f"foot-{number:02d}.stl").write_bytes(data)
    shutil.copytree(SAMPLES / "lasts", folder / "lasts")
    shutil.copy(SAMPLES / "lasts.csv", folder)
    return folder


def page_as_it_runs(names: dict[str, Any]) -> str:
    """The page with what its blocks print, in the folder of the page; ``names`` are filled."""
    text = PAGE.read_text(encoding="utf-8")
    parts, end = [], 0
    for block in BLOCK.finditer(text):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(compile(block["code"], str(PAGE), "exec"), names)
        shown = f"\n```text\n{out.getvalue()}```\n" if out.getvalue() else ""
        parts += [text[end : block.start()], f"```python\n{block['code']}```\n", shown]
        end = block.end()
    return "".join([*parts, text[end:]])


def test_the_page_runs_and_prints_what_it_says(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(fill_shop(tmp_path))
    names: dict[str, Any] = {}
    shown = page_as_it_runs(names)
    assert PAGE.read_text(encoding="utf-8") == shown, "fill it: python -m tests.test_library"
    assert shown.count("```text") >= 7
    assert len({row["path"] for row in names["table"]}) == FEET
    for name in ("flare.svg", "aligned.stl", "report.html"):
        assert (tmp_path / name).stat().st_size > 1000


def test_the_import_opens_no_heavy_library_and_is_quick() -> None:
    code = (
        "import time; start = time.process_time(); import footfit;"
        "took = time.process_time() - start; import sys;"
        "print(took, sorted({'numpy', 'typer', 'rich', 'sqlalchemy'} & set(sys.modules)))"
    )
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        for _ in range(5)
    ]
    took = min(float(run.stdout.split()[0]) for run in runs)
    assert {run.stdout.split(maxsplit=1)[1].strip() for run in runs} == {"[]"}
    assert took < 0.05  # the promise of docs/library.md, of a processor; measured: 0.012 s


def test_what_the_front_names_is_there() -> None:
    for name in footfit.__all__:
        assert getattr(footfit, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        footfit.nothing  # noqa: B018
    assert footfit.errors is errors
    assert footfit.FootfitError is errors.FootfitError
    assert footfit.LastLabels is results.LastLabels


def test_the_library_uses_no_terminal() -> None:
    code = (
        "import footfit, sys; footfit.align; footfit.open_catalogue('none');"
        "print(sorted({'typer', 'rich', 'footfit.cli'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_a_result_takes_the_place_of_its_file(foot: Path) -> None:
    aligned = footfit.align(foot)
    assert footfit.flare(aligned).to_dict() == footfit.flare(foot).to_dict()
    assert footfit.measure(footfit.flare(aligned)).to_dict() == footfit.measure(foot).to_dict()
    assert footfit.align(footfit.read(foot)).to_dict() == aligned.to_dict()
    profiled = footfit.flare(aligned)
    assert footfit.flare(profiled) is profiled


def test_arrays_give_what_their_file_gives(foot: Path) -> None:
    scan = footfit.read(foot, units="mm")
    named = footfit.measure(foot, units="mm").rows()
    unnamed = footfit.measure((scan.vertices_mm, scan.faces), units="mm").rows()
    assert unnamed == [row | {"path": None} for row in named]
    inches = footfit.align((scan.vertices_mm / 25.4, scan.faces.tolist()), units="in")
    assert inches.alignment.length_mm == pytest.approx(
        named[0]["value_mm"], abs=printed(MILLIMETRE_DIGITS)
    )


@pytest.mark.parametrize(
    ("vertices", "faces", "error"),
    [
        (np.zeros((3, 2)), [[0, 1, 2]], errors.DamagedMesh),
        (np.eye(3), [[0.0, 1.0, 2.0]], errors.DamagedMesh),
        (np.eye(3), [[0, 1, 3]], errors.DamagedMesh),
        (np.eye(3) * np.nan, [[0, 1, 2]], errors.DamagedMesh),
        ("left.stl", "right.stl", errors.DamagedMesh),
        (np.eye(3), np.zeros((0, 3), dtype=int), errors.EmptyMesh),
        (np.zeros((3, 3)), [[0, 1, 2]], errors.EmptyMesh),
    ],
)
def test_arrays_that_are_no_mesh_are_refused(vertices, faces, error) -> None:
    with pytest.raises(error):
        footfit.read((vertices, faces), units="mm")


def test_a_batch_goes_on_after_a_failure_and_keeps_its_order(foot: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.stl"
    broken.write_bytes(b"solid nothing")
    for jobs in (0, 2):
        first, second = footfit.outcomes(footfit.measure, [str(broken), str(foot)], jobs=jobs)
        assert (first.value, first.error.code, first.item.path) == (
            None,
            "empty_mesh",
            str(broken),
        )
        assert second.value.to_dict() == footfit.measure(foot).to_dict()


def test_two_feet_of_one_file_are_taken_apart(foot: Path) -> None:
    scan = footfit.read(foot)
    step = 2.0 * np.ptp(scan.vertices_mm[:, 1]) + 30.0
    beside = scan.vertices_mm + np.array([0.0, step, 0.0])
    both = (
        np.concatenate([scan.vertices_mm, beside]),
        np.concatenate([scan.faces, scan.faces + len(scan.vertices_mm)]),
    )
    with pytest.raises(errors.SeveralFeet):
        footfit.align(both, units="mm")
    parts = footfit.sources(both, split=True, units="mm")
    alone = footfit.align(foot).alignment.length_mm
    lengths = [
        outcome.value.alignment.length_mm for outcome in footfit.outcomes(footfit.align, parts)
    ]
    assert lengths == pytest.approx([alone, alone], abs=POSED)


def test_a_catalogue_reads_its_lasts_once_and_again_after_a_change(
    catalogue: Path, foot: Path, monkeypatch
) -> None:
    from footfit.pipeline.shelf import candidates

    profiled = footfit.flare(foot)
    reads = []
    choice = candidates.choice
    monkeypatch.setattr(candidates, "choice", lambda *a: reads.append(a) or choice(*a))
    with footfit.open_catalogue(catalogue) as lasts:
        best = lasts.match(profiled).candidates[0].last
        assert lasts.match(profiled).candidates[0].last == best
        assert len(reads) == 1
        lasts.rename(best, "renamed")
        assert lasts.match(profiled).candidates[0].last == "renamed"
        assert len(reads) == 2
    again = footfit.match(profiled, catalogue, top=1)
    assert [candidate.last for candidate in again.candidates] == ["renamed"]


def test_a_match_asks_what_the_command_asks(request, stocked: Path, foot: Path) -> None:
    question = {"by": "flare", "top": 2, "style": "derby", "side": "left"}
    answer = footfit.match(str(foot), stocked, clearance=True, **question)
    arguments = [part for key, value in question.items() for part in (f"--{key}", value)]
    run = request.getfixturevalue("footfit")(
        "match", foot, "--catalogue", stocked, "--clearance", "--json", *arguments
    )
    assert run.document == answer.to_dict()


def test_a_pair_is_a_list_of_two(stocked: Path, foot: Path) -> None:
    left = footfit.flare(foot)
    right = footfit.align(SAMPLES / "feet" / "mh007_R.stl")
    assert len(footfit.match([left, right], stocked).feet) == 2
    with pytest.raises(errors.SameSide, match="both left feet"):
        footfit.match([left, left], stocked)
    with pytest.raises(errors.BadOption, match="not 3"):
        footfit.match([left] * 3, stocked)


def test_ingest_says_what_became_of_each_file(tmp_path: Path) -> None:
    paths = sorted(str(path) for path in (SAMPLES / "lasts").iterdir())[:2]
    with footfit.open_catalogue(tmp_path / "new.footfit") as lasts:
        with pytest.raises(errors.NoCatalogue):
            lasts.lasts()
        dry = lasts.ingest(paths, dry_run=True)
        assert [outcome.status for outcome in dry] == ["added", "added"]
        assert not lasts.path.exists()
        labels = footfit.LastLabels("mine", style="derby")
        (outcome,) = lasts.ingest(paths[0], labels=labels, side="right")
        assert (outcome.last, outcome.status) == ("mine", "added")
        assert lasts.last("mine").record.labels == labels
        assert lasts.lasts().rows()[0]["style"] == "derby"
        assert lasts.check().findings == ()
        assert lasts.backup(tmp_path / "copy.footfit").lasts == 1


def test_rows_are_flat_dicts_that_share_their_columns(stocked: Path, foot: Path) -> None:
    profiled = footfit.flare(foot)
    with footfit.open_catalogue(stocked) as lasts:
        tables = [
            footfit.measure(foot),
            profiled,
            lasts.match(profiled),
            lasts.lasts(),
            lasts.compare(profiled, lasts.lasts().ordered()[0].labels.name),
        ]
    for table in tables:
        rows = table.rows()
        assert {tuple(row) for row in rows} == {table.columns}
        values = {type(value) for row in rows for value in row.values()}
        assert values <= {str, int, float, bool, type(None)}


def test_a_file_of_a_result_is_of_a_known_kind(foot: Path) -> None:
    aligned = footfit.align(foot)
    for make in (footfit.picture, footfit.mesh_file):
        with pytest.raises(errors.BadOption, match="cannot be of the kind 'gif'"):
            make(aligned, "gif")
        with pytest.raises(errors.BadOption, match="there is no"):
            make("a string", "svg" if make is footfit.picture else "stl")
    assert footfit.picture(aligned, "png").startswith(b"\x89PNG")
    assert footfit.mesh_file(aligned, "off").startswith(b"OFF")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name, contextlib.chdir(fill_shop(Path(name))):
        PAGE.write_text(page_as_it_runs({}), encoding="utf-8")


@pytest.mark.parametrize(
    ("function", "given", "words"),
    [
        (footfit.customise, {"keep": True}, "did you mean 'keep_bottom'"),
        (footfit.customise, {"profil": "dress"}, "did you mean 'profile'"),
        (footfit.customise, {"room": {}}, "did you mean 'room_mm'"),
        (footfit.measure, {"unit": "cm"}, "did you mean 'units'"),
        (footfit.read, {"sides": "left"}, "has no keyword 'sides'"),
        (footfit.Catalogue.match, {"profiles": "dress"}, "did you mean 'profile'"),
        (footfit.Catalogue.edit_last, {"styles": "x"}, "did you mean 'style'"),
        *(
            (function, {"bogus": 1}, "has no keyword 'bogus'")
            for function in (
                *(footfit.grade, footfit.compare_lasts, footfit.draw_last, footfit.drawing),
                *(footfit.match, footfit.flare, footfit.align, footfit.compare, footfit.coverage),
                *(footfit.curvature, footfit.Catalogue.match_each, footfit.Catalogue.compare),
                footfit.Catalogue.ingest,
            )
        ),
    ],
)
def test_a_mistyped_keyword_is_refused(function, given, words) -> None:
    with pytest.raises(TypeError, match=words):
        function("a", "b", **given)


def test_sizes_are_a_text() -> None:
    with pytest.raises(errors.BadOption, match="the sizes are a text"):
        footfit.grade("last.stl", [42, 43])  # type: ignore[arg-type]
