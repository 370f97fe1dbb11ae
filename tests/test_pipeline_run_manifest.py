"""The manifest beside the files of a run: one file has one heel, whatever command reads it."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pytest

import footfit
from footfit.api.last_making import grader_of
from footfit.errors import BadOption, OutOfReach
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.cluster import _with_bytes
from footfit.pipeline.batch.manifest import COLUMNS
from footfit.pipeline.batch.run_manifest import OF_RUNS, STANDS, UNUSED, as_said, with_said
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.graded_runs.grade_store import RunManifest
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom import base_choice, custom_making
from footfit.results import CustomLast, GradedLast, LastLabels, Profiled
from tests.conftest import SAMPLES, Footfit
from tools.lasts import LastSpec, last_mesh

LABEL_MM = 28.5
"""What the manifests say; the shapes alone have 24.4 to 25.5 mm."""
FOOT = min((SAMPLES / "feet").iterdir())


@lru_cache(maxsize=4)
def last_file(scale: float = 1.0) -> bytes:
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=60, segments=48))
    return encoded_mesh(vertices * scale, faces, "stl")


def in_run(folder: Path, *, hashed: bool = True, label_mm: float = LABEL_MM) -> list[Path]:
    """Three lasts of a run with their manifest."""
    lines = [",".join(("path", "size", "size_system", "side", "heel_height_mm", "sha256"))]
    files = [folder / f"derby-{size}.stl" for size in (41, 42, 43)]
    for file, scale in zip(files, (0.976, 1.0, 1.024), strict=True):
        file.write_bytes(last_file(scale))
        sha256 = hashlib.sha256(last_file(scale)).hexdigest() if hashed else ""
        lines.append(f"{file.name},{file.stem[-2:]},eu,right,{label_mm},{sha256}")
    (folder / "run.csv").write_text("\n".join(lines))
    return files


def heel_mm(document: dict) -> float:
    return float(document["measures"]["heel_height"]["value"])


def codes(document: dict) -> list[str]:
    """What is said of manifests; the shapes contradict their labels too."""
    return [each["code"] for each in document["warnings"] if each["code"] in OF_RUNS]


def heels_of_commands(footfit: Footfit, file: Path, other: Path, folder: Path) -> dict[str, float]:
    """The heel that each command reads of a file, in mm; rounded to .01 mm."""
    measured = footfit("measure", file, "--json").document
    aligned = footfit("align", file, "--json").document
    drawn = footfit("draw-last", file, "-o", folder / "drawing.svg", "--json", "--force").document
    compared = footfit("compare-lasts", file, other, "--json").document
    checked = footfit("check-run", *sorted(file.parent.glob("*.stl")), "--json").document
    (last,) = (each for each in checked["lasts"] if each["last"] == file.name)
    by = "" if last["stands_by"] == "label" else "_by_shape"  # beside others that have labels
    catalogue = folder / "lasts.footfit"
    footfit("ingest-last", file, "--catalogue", catalogue, "--replace")
    stored = footfit("show-last", file.stem, "--catalogue", catalogue, "--json").document
    heels = {
        "measure": heel_mm(measured),
        "align": aligned["stance"]["heel_height_mm"],
        "draw-last": heel_mm(drawn),
        "compare-lasts": compared["measures"]["heel_height"]["first"]["value"],
        "check-run": last["measures_mm"].get(f"heel_height{by}"),
        "ingest-last": heel_mm(stored),
    }
    return {name: round(mm, 2) for name, mm in heels.items()}


@pytest.mark.parametrize("state", ["as written", "changed"])
def test_one_file_has_one_heel_in_every_command(
    footfit: Footfit, tmp_path: Path, state: str
) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    file, other, _ = in_run(folder)
    by_shape = heel_mm(footfit("measure", "--json", copy_alone(file, tmp_path)).document)
    assert abs(by_shape - LABEL_MM) > 2.5
    expected = LABEL_MM
    if state == "changed":
        for each, scale in ((file, 0.97), (other, 1.001)):
            each.write_bytes(last_file(scale))
        expected = heel_mm(footfit("measure", "--json", copy_alone(file, tmp_path)).document)
    heels = heels_of_commands(footfit, file, other, tmp_path)
    assert heels == dict.fromkeys(heels, pytest.approx(expected, abs=0.011))


def copy_alone(file: Path, folder: Path) -> Path:
    """A copy of a file in a folder without a manifest."""
    alone = folder / file.name
    alone.write_bytes(file.read_bytes())
    return alone


def test_a_file_that_was_changed_stands_by_its_shape_and_that_is_said(
    footfit: Footfit, tmp_path: Path
) -> None:
    file, other, last = in_run(tmp_path)
    assert codes(footfit("measure", file, "--json").document) == [STANDS]
    file.write_bytes(last_file(0.97))
    changed = footfit("measure", file, "--json")
    assert codes(changed.document) == [UNUSED]
    assert "derby-41.stl: run.csv beside it was written for another content" in changed.err
    checked = footfit("check-run", file, other, last)
    assert "derby-41.stl: the manifest was written for another content" in checked.err
    assert "empty its sha256 if its heights still count" in checked.err
    catalogue = tmp_path / "lasts.footfit"
    manifest = ("--manifest", tmp_path / "run.csv", "--catalogue", catalogue)
    stored = footfit("ingest-last", *manifest, "--json")
    outcome = json.loads(stored.out.splitlines()[0])
    assert codes(outcome) == [UNUSED]
    shown = footfit("show-last", "derby-41", "--catalogue", catalogue, "--json").document
    assert (shown["size"], shown["heel_height_mm"]) == ("41", None)
    swapped = tmp_path / "swapped"
    swapped.mkdir()
    first, second, _ = in_run(swapped)
    content = first.read_bytes()
    first.write_bytes(second.read_bytes())
    second.write_bytes(content)
    assert codes(footfit("measure", first, "--json").document) == [UNUSED]


def test_a_line_without_a_hash_counts_only_in_a_manifest_that_is_named(
    footfit: Footfit, tmp_path: Path
) -> None:
    file, *_ = in_run(tmp_path, hashed=False)
    measured = footfit("measure", file, "--json")
    assert codes(measured.document) == [UNUSED]
    assert "heel height 28.5 mm without a sha256" in measured.err
    assert abs(heel_mm(measured.document) - LABEL_MM) > 2.5
    catalogue = tmp_path / "lasts.footfit"
    footfit("ingest-last", "--manifest", tmp_path / "run.csv", "--catalogue", catalogue)
    shown = footfit("show-last", "derby-41", "--catalogue", catalogue, "--json").document
    assert heel_mm(shown) == pytest.approx(LABEL_MM, abs=0.011)


def test_options_win_over_the_manifest(footfit: Footfit, tmp_path: Path) -> None:
    file, *_ = in_run(tmp_path)
    given = footfit("measure", file, "--heel-height", "27", "--json").document
    assert heel_mm(given) == pytest.approx(27.0, abs=0.011)
    assert STANDS not in codes(given)
    sprung = as_said(with_said(Source(str(file))), ReadingOptions(toe_spring_mm=9.0))[0]
    assert (sprung.heel_height_mm, sprung.toe_spring_mm) == (None, 9.0)
    left = footfit("measure", file, "--side", "left", "--force-side", "--json").document
    assert (left["side"], heel_mm(left)) == ("left", pytest.approx(LABEL_MM, abs=0.011))
    scaled = footfit("measure", file, "--known-length", "240", "--json").document
    assert UNUSED not in codes(scaled)  # the lines do not say a unit
    text = (
        (tmp_path / "run.csv").read_text().replace("size_system", "units").replace(",eu,", ",mm,")
    )
    (tmp_path / "run.csv").write_text(text)
    scaled = footfit("measure", file, "--known-length", "240", "--json").document
    assert codes(scaled) == [UNUSED]
    catalogue = tmp_path / "lasts.footfit"
    footfit("ingest-last", file, "--heel-height", "27", "--size", "40", "--catalogue", catalogue)
    shown = footfit("show-last", "derby-41", "--catalogue", catalogue, "--json").document
    assert (shown["size"], shown["heel_height_mm"]) == ("40", 27.0)


def test_a_file_of_a_run_is_surely_a_last_of_its_side_and_unit(tmp_path: Path) -> None:
    (file, *_) = in_run(tmp_path)
    read, (notice,) = as_said(with_said(Source(str(file))), ReadingOptions())
    assert (read.kind, read.side, read.heel_height_mm) == ("last", "right", LABEL_MM)
    assert (notice.code, "heel height 28.5 mm" in notice.message) == (STANDS, True)
    assert as_said(Source(str(file)), ReadingOptions(kind="foot"))[0] == ReadingOptions(kind="foot")


def test_what_lies_there_and_is_no_manifest_of_the_file_changes_nothing(
    footfit: Footfit, tmp_path: Path
) -> None:
    file = tmp_path / "derby-41.stl"
    file.write_bytes(last_file())
    plain = footfit("measure", file, "--json").document
    for text in ("date,runner\n2026-01-01,Ann\n", "path,size\nderby-42.stl,42\n", ""):
        (tmp_path / "run.csv").write_text(text)
        assert footfit("measure", file, "--json").document == plain
    for text in ("path,heel_height_mm\nderby-41.stl,tall\n", "path,sha256\nderby-41.stl,12\n"):
        (tmp_path / "run.csv").write_text(text)
        broken = footfit("measure", file, "--json")
        assert codes(broken.document) == [UNUSED]
        assert "check-run says what is wrong" in broken.err
        assert broken.document["measures"] == plain["measures"]


def test_the_library_reads_a_file_as_the_commands_do(tmp_path: Path) -> None:
    file, other, _ = in_run(tmp_path)
    read = footfit.read(file)
    for mesh in (file, read, footfit.align(file), footfit.flare(read)):
        values = {row.name: row.measured.value for row in footfit.measure(mesh).measures}
        assert values["heel_height"] == pytest.approx(LABEL_MM, abs=0.011)
    compared = footfit.compare(FOOT, file)
    assert (compared.last.labels.size, compared.last.labels.heel_height_mm) == ("41", LABEL_MM)
    assert (STANDS, str(file)) in [(each.code, each.path) for each in compared.warnings]
    base = grader_of(other, "42").base  # its size and system are those of the manifest
    assert (base.record.labels.size, base.shape.labels.heel_height_mm) == ("42", LABEL_MM)
    own = grader_of(other, "42", heel_height_mm=27.0).base
    assert own.shape.labels.heel_height_mm == 27.0


def test_a_custom_last_has_the_heel_of_its_base_in_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, *_ = in_run(tmp_path)
    bases: list[BaseLast] = []

    def customised_from(foot: Profiled, base: BaseLast, *_: object) -> CustomLast:
        bases.append(base)
        raise OutOfReach("it is enough to know the base")

    monkeypatch.setattr(base_choice, "customised_from", customised_from)
    for options, heel_mm in (({}, LABEL_MM), ({"heel_height_mm": 27.0}, 27.0)):
        with pytest.raises(OutOfReach):
            footfit.customise(FOOT, file, **options)
        assert bases[-1].shape.labels.heel_height_mm == heel_mm
        assert bases[-1].record.labels.heel_height_mm == heel_mm
    assert [each.code for each in custom_making._notices(bases[0])] == [STANDS]
    assert custom_making._notices(bases[1]) == ()
    for base in ("derby-41", "auto"):
        with pytest.raises(BadOption, match="leave out the options"):
            footfit.customise(FOOT, base, catalogue=tmp_path / "lasts.footfit", heel_height_mm=27.0)


def test_a_cluster_gets_what_the_manifest_here_says(tmp_path: Path) -> None:
    file, *_ = in_run(tmp_path)
    sent = _with_bytes(Source(str(file)))
    (tmp_path / "run.csv").unlink()
    assert as_said(sent, ReadingOptions())[0].heel_height_mm == LABEL_MM
    alone = _with_bytes(Source(str(file)))
    assert (alone.data, as_said(alone, ReadingOptions())[1]) == (file.read_bytes(), ())


def test_a_run_is_written_with_the_hash_and_the_name_of_each_file() -> None:
    last = GradedLast("a:b-41", "41", None, 0.0, 0.0, (), LastLabels("a:b-41"), b"mesh")
    (row,) = RunManifest([replace(last)], "left").rows()
    assert tuple(row) == COLUMNS
    assert row["path"] == "a_b-41.stl"
    assert row["sha256"] == hashlib.sha256(b"mesh").hexdigest()
