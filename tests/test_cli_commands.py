"""The paper's commands from the command line, on the sample data."""

from __future__ import annotations

import csv
import io
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from footfit.geometry.flare.definition import CHANNELS
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.results.values import MILLIMETRE_DIGITS
from tests.bounds import printed
from tests.conftest import SAMPLES, Footfit
from tests.distortions import in_metres, moved, random_pose
from tests.reading import read_scan

ALIGN_KEYS = {
    "schema",
    "footfit_version",
    "mesh",
    "side",
    "side_confidence",
    "side_source",
    "method",
    "transform",
    "eigenvalues_mm2",
    "eigenvectors",
    "centroid_mm",
    "reference",
    "pose",
    "length_mm",
    "extent_mm",
    "warnings",
}
CANDIDATE_KEYS = {
    "rank",
    "last",
    "style",
    "size",
    "side",
    "distance",
    "flare",
    "clearance_mm",
    "verdict",
    "why",
    "tied_with",
}


def test_align_takes_the_file_to_the_frame_it_reports(
    footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    output, plot = tmp_path / "aligned.stl", tmp_path / "frames.svg"
    run = footfit("align", foot, "-o", output, "--plot", plot, "--json")
    assert run.code == 0
    document = run.document
    assert set(document) >= ALIGN_KEYS
    assert document["schema"] == "footfit.align/2"
    transform = np.array(document["transform"])
    assert np.linalg.det(transform[:3, :3]) > 0
    ours = read_scan(output).vertices_mm
    theirs = moved(read_scan(foot).vertices_mm, transform)
    # the transform has 6 decimals, which reach a third of a metre; measured: 9.0e-5 mm
    assert np.allclose(np.sort(ours, axis=0), np.sort(theirs, axis=0), rtol=0.0, atol=1.7e-4)
    extent_mm = pytest.approx(document["extent_mm"], abs=2 * printed(MILLIMETRE_DIGITS))
    assert np.ptp(ours[:, 0]) == extent_mm
    assert plot.read_text().startswith("<?xml")


def test_flare_gives_the_five_channels_and_its_definition(
    footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    plot = tmp_path / "flare.png"
    document = footfit("flare", foot, "--json", "--plot", plot).document
    assert set(document["curvature"]) == set(CHANNELS)
    assert document["definition"]["version"].startswith("flare/")
    assert document["flare_angle_sd_deg"] > 0
    assert len(document["stations"]) == len(document["heading_deg"])
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_flare_as_csv_on_stdout(footfit: Footfit, foot: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(footfit("flare", foot, "--csv", "-").out)))
    document = footfit("flare", foot, "--json").document
    assert len(rows) == len(document["stations"])


def test_curvature_writes_what_it_counts(footfit: Footfit, foot: Path, tmp_path: Path) -> None:
    output, picture = tmp_path / "c.npz", tmp_path / "c.png"
    document = footfit("curvature", foot, "-o", output, "--plot", picture, "--json").document
    with np.load(output) as arrays:
        assert set(arrays) == {
            "k1",
            "k2",
            "mean",
            "gaussian",
            "vertices",
            "faces",
            "source_to_vertex",
        }
        assert len(arrays["k1"]) == len(arrays["vertices"]) == document["mesh"]["vertices"]
        defined = np.isfinite(arrays["mean"])
        assert (arrays["k1"][defined] <= arrays["k2"][defined]).all()
    assert footfit("curvature", foot, "-o", tmp_path / "c.ply", "--radius", 0).code == 0
    ply = (tmp_path / "c.ply").read_bytes()
    assert ply.startswith(b"ply")
    assert b"property uchar red" in ply
    assert document["output"] == str(output)


def test_match_ranks_with_every_key_of_the_contract(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    report = tmp_path / "report.html"
    run = footfit("match", foot, "--catalogue", stocked, "--json", "--html", report)
    document = run.document
    assert set(document) >= {"feet", "by", "profile", "catalogue", "candidates", "rejected"}
    assert document["candidates"], "the sample lasts are made to fit the sample feet"
    gate = next(rule for rule in fit_profile(document["profile"]).zones if rule.zone == "length")
    shortest, longest = gate.poor or gate.acceptable
    for rank, candidate in enumerate(document["candidates"], start=1):
        assert set(candidate) >= CANDIDATE_KEYS
        assert candidate["rank"] == rank
        length = candidate["clearance_mm"]["length"]
        assert shortest <= length["value"] <= longest
        assert length["sd"] > 0
        girth = candidate["clearance_mm"]["ball_girth"]
        assert (girth["value"] is None) == bool(girth["reason"])
        assert candidate["why"]
    assert str(foot.parent) not in report.read_text(encoding="utf-8")


def test_match_is_the_same_in_any_pose_and_unit(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    scan = read_scan(foot)
    turned = moved(scan.vertices_mm, random_pose(np.random.default_rng(5)))
    other = tmp_path / "posed.stl"
    other.write_bytes(encoded_mesh(in_metres(turned), scan.faces, "stl"))
    answers = [
        footfit("match", path, "--catalogue", stocked, "--json").document for path in (foot, other)
    ]
    names = [[c["last"] for c in answer["candidates"]] for answer in answers]
    assert names[0] == names[1]
    lengths = [answer["feet"][0]["measures"]["length"]["value"] for answer in answers]
    assert lengths[0] == pytest.approx(lengths[1], abs=2 * printed(MILLIMETRE_DIGITS))


def test_a_stored_last_finds_itself_by_shape(footfit: Footfit, stocked: Path) -> None:
    listed = footfit("list-lasts", "--catalogue", stocked, "--json").document["lasts"]
    for row in csv.DictReader((SAMPLES / "lasts.csv").open()):
        run = footfit(
            "match", SAMPLES / row["path"], "--by", "shape", "--catalogue", stocked, "--json"
        )
        best = run.document["candidates"][0]
        assert best["last"] == (row["name"] or Path(row["path"]).stem)
    assert len(listed) == len(list(csv.DictReader((SAMPLES / "lasts.csv").open())))


@pytest.mark.parametrize("by", ["fit", "flare", "shape"])
def test_two_runs_and_two_jobs_give_the_same_bytes(
    footfit: Footfit, stocked: Path, by: str
) -> None:
    command = ("match", SAMPLES / "feet", "--by", by, "--catalogue", stocked, "--json")
    outputs = {footfit(*command, "--jobs", jobs).out for jobs in (1, 1, 2)}
    assert len(outputs) == 1


def test_a_batch_goes_on_after_a_bad_file(footfit: Footfit, foot: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.stl"
    bad.write_bytes(foot.read_bytes()[:5000])
    run = footfit("align", bad, foot, tmp_path / "none.stl", "--json")
    assert run.code == 3
    assert [line["schema"] for line in run.lines] == [
        "footfit.error/1",
        "footfit.align/2",
        "footfit.error/1",
    ]
    assert json.loads(run.last_error)["code"] == "unreadable_file"


def test_stdin_may_be_given_its_format_and_has_no_path(
    footfit: Footfit, foot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Stdin:
        buffer = io.BytesIO(foot.read_bytes())

    monkeypatch.setattr("sys.stdin", Stdin)
    document = footfit("align", "-", "--format", "stl", "--json").document
    assert document["mesh"]["path"] is None


def test_match_says_what_to_type_where_there_is_nothing_to_match(
    footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    run = footfit("match", foot, "--catalogue", tmp_path / "none.footfit")
    assert run.code == 4
    assert "footfit demo" in run.err
    assert "footfit ingest-last FOLDER" in run.err
    assert not list(tmp_path.iterdir())


def test_outputs_are_refused_before_any_work(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    there = tmp_path / "there.svg"
    there.write_text("mine")
    for command in (("align", "--plot"), ("flare", "--plot"), ("curvature", "--plot")):
        assert footfit(command[0], foot, command[1], there).code == 2
    assert footfit("match", foot, "--catalogue", stocked, "--html", there).code == 2
    assert there.read_text() == "mine"
    two = (foot, SAMPLES / "feet")
    assert footfit("align", *two, "-o", tmp_path / "one.stl").code == 2
    late = footfit("align", foot, "-o", tmp_path / "one.xyz")
    assert (late.code, late.out) == (2, "")
    assert footfit("flare", foot, "--csv", "-", "--json").code == 2
    assert [path.name for path in tmp_path.iterdir()] == ["there.svg"]


def test_the_paper_methods_need_a_reference(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    assert footfit("align", foot, "--method", "paper", "--catalogue", tmp_path / "none").code == 4
    for method in ("paper", "paper-literal"):
        run = footfit("align", foot, "--method", method, "--catalogue", stocked, "--json")
        assert run.document["reference"]["last"]
    assert footfit("align", foot, "--to", "x", "--catalogue", stocked).code == 2
    run = footfit("align", foot, "--method", "paper", "--to", "x", "--catalogue", stocked)
    assert run.code == 4


def test_demo_keeps_to_its_folder(
    footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / "mine.footfit"
    monkeypatch.setenv("FOOTFIT_CATALOGUE", str(mine))
    run = footfit("demo", "shown")
    assert run.code == 0
    assert not mine.exists()
    assert [path.name for path in tmp_path.iterdir()] == ["shown"]
    for path in (tmp_path / "shown").iterdir():
        assert path.stat().st_size > 0
        assert path.name in run.out
    assert footfit("demo", "shown").code == 2
    assert footfit("demo", "shown", "--force", "--json").document["best_last"]


def test_ingest_is_idempotent_and_never_overwrites_unasked(
    footfit: Footfit, tmp_path: Path
) -> None:
    catalogue = ("--catalogue", tmp_path / "c.footfit", "--json")
    rows = list(csv.DictReader((SAMPLES / "lasts.csv").open()))[:2]
    one, two = (tmp_path / f"{i}.stl" for i in (1, 2))
    for path, row in zip((one, two), rows, strict=True):
        shutil.copy(SAMPLES / row["path"], path)
    command = ("ingest-last", one, "--side", rows[0]["side"] or "auto", *catalogue)

    dry = footfit(*command, "--dry-run").document
    assert (dry["status"], (tmp_path / "c.footfit").exists()) == ("added", False)
    assert dry["dry_run"] is True
    first = footfit(*command).document
    assert set(first) >= {"path", "status", "last", "side", "flare_angle_deg", "error"}
    assert (first["status"], first["last"]) == ("added", "1")
    assert footfit(*command).document["status"] == "unchanged"
    relabelled = footfit(*command, "--style", "derby")
    assert (relabelled.code, relabelled.document["status"]) == (2, "refused")
    assert footfit(*command, "--style", "derby", "--replace").document["status"] == "replaced"
    renamed = footfit(*command, "--name", "other")
    assert renamed.code == 2
    assert "'1'" in renamed.document["error"]
    other = footfit("ingest-last", two, "--name", "1", *catalogue)
    assert other.code == 2
    listed = footfit("list-lasts", *catalogue).document["lasts"]
    assert [(last["last"], last["style"]) for last in listed] == [("1", "derby")]


def test_the_library_commands(footfit: Footfit, catalogue: Path, tmp_path: Path) -> None:
    here = ("--catalogue", catalogue, "--json")
    names = [last["last"] for last in footfit("list-lasts", *here).document["lasts"]]
    reference = footfit("catalogue-info", *here).document["reference"]
    other = next(name for name in names if name != reference)
    assert footfit("remove-last", reference, *here).code == 2
    assert footfit("set-reference", other, *here).document["last"] == other
    assert footfit("rename-last", reference, "renamed", *here).code == 0
    assert footfit("show-last", "renamed", *here).document["last"] == "renamed"
    stl, record = tmp_path / "x.stl", tmp_path / "x.json"
    assert footfit("export-last", "renamed", "-o", stl, *here).code == 0
    assert footfit("export-last", "renamed", "-o", record, *here).code == 0
    again = footfit("match", stl, "--by", "shape", "--side", "right", *here).document
    assert again["candidates"][0]["last"] == "renamed"
    assert json.loads(record.read_text())["last"] == "renamed"
    assert footfit("remove-last", "renamed", *here).code == 0
    assert footfit("show-last", "renamed", *here).code == 4
    assert footfit("upgrade-catalogue", *here).document["recomputed"] == []


@pytest.mark.parametrize(
    "command",
    [
        ("list-lasts",),
        ("show-last", "x"),
        ("edit-last", "x", "--size", "40"),
        ("rename-last", "x", "y"),
        ("remove-last", "x"),
        ("export-last", "x", "-o", "x.stl"),
        ("set-reference", "x"),
        ("catalogue-info",),
        ("upgrade-catalogue",),
    ],
)
def test_library_commands_make_no_catalogue(
    footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    run = footfit(*command, "--catalogue", "none.footfit")
    assert run.code == 4
    assert len(run.err.splitlines()) == 1
    assert not list(tmp_path.iterdir())
