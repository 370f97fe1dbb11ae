"""Many customers: --pairs by names and by CSV, a folder for the files, a summary at the end."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

from tests.conftest import SAMPLES, Footfit, Run

LEFT, RIGHT, OTHER = (
    SAMPLES / "feet" / f"{name}.stl" for name in ("mh007_L", "mh007_R", "mh008_R")
)


@pytest.fixture
def shop(tmp_path: Path, stocked: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the scans of two customers, a catalogue, and a scan that is none."""
    scans = tmp_path / "scans"
    scans.mkdir()
    shutil.copy(LEFT, scans / "Zoé gauche.stl")
    shutil.copy(RIGHT, scans / "zoé DROITE.stl")
    shutil.copy(OTHER, scans / "bob_R.stl")
    shutil.copy(stocked, tmp_path / "c.footfit")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def matched(footfit: Footfit, *arguments: object) -> Run:
    return footfit("match", *arguments, "--catalogue", "c.footfit")


def test_each_customer_has_a_line_and_a_page(footfit: Footfit, shop: Path) -> None:
    (shop / "scans" / "dan_L.stl").write_text("no mesh", encoding="utf-8")
    run = matched(
        footfit, "scans", "--pairs", "auto", "-o", "pages/", "--sheet", "pages/", "--json"
    )
    assert run.code == 3
    assert [line.get("customer", line.get("code")) for line in run.lines] == [
        "Zoé",
        "bob",
        "unknown_format",
    ]
    assert [foot["side"] for foot in run.lines[0]["feet"]] == ["left", "right"]
    assert run.lines[2]["path"] == "scans/dan_L.stl"
    pages = {path.name: path.read_text(encoding="utf-8") for path in (shop / "pages").iterdir()}
    assert sorted(pages) == ["Zoé-sheet.html", "Zoé.html", "bob-sheet.html", "bob.html"]
    assert "Zoé gauche.stl" in pages["Zoé.html"]
    for name, page in pages.items():
        customer, other = ("Zoé", "bob") if name.startswith("Zoé") else ("bob", "Zoé")
        assert f">{customer}<" in page
        assert other not in re.sub(r"[A-Za-z0-9+/=]{200,}", "", page)  # not in coded meshes
    assert "2 feet have no other foot by name" in run.err
    assert [line for line in run.err.splitlines() if line.startswith("wrote")] == [
        *("wrote pages/Zoé.html", "wrote pages/Zoé-sheet.html"),
        *("wrote pages/bob.html", "wrote pages/bob-sheet.html"),
    ]
    assert json.loads(run.last_error)["path"] == "scans/dan_L.stl"


def test_the_answer_does_not_depend_on_the_jobs(footfit: Footfit, shop: Path) -> None:
    one, two = (matched(footfit, "scans", "--pairs", "auto", "-j", n, "--json") for n in (1, 2))
    assert one.out == two.out
    assert (one.code, one.err) == (two.code, two.err)


def test_a_summary_ends_the_tables(footfit: Footfit, shop: Path) -> None:
    (shop / "scans" / "dan_L.stl").write_text("no mesh", encoding="utf-8")
    run = matched(footfit, "scans", "--pairs", "auto", "--csv", "rows.csv")
    summary = run.out[run.out.index("3 customers") :]
    assert run.out.startswith("Zoé\nZoé gauche.stl")
    for line, words in (("Zoé", "loafer-40"), ("bob", "EU 43"), ("dan", "content")):
        (row,) = [row for row in summary.splitlines() if line in row]
        assert words in row
    assert "1 of 3 customers failed" in run.err
    alone = matched(footfit, LEFT, RIGHT, "--pair")
    assert "customers" not in alone.out
    assert "customers" not in matched(footfit, LEFT, RIGHT, "--csv", "-").out


def test_fail_under_counts_customers(footfit: Footfit, shop: Path) -> None:
    run = matched(footfit, "scans", "--pairs", "auto", "--fail-under", "good", "--top", 1)
    verdicts = [line["best_verdict"] for line in matched(footfit, "scans", "--json").lines]
    assert run.code == (0 if set(verdicts) == {"good"} else 7)


# ---------------------------------------------------------------- a CSV file


def test_the_columns_of_a_csv_give_the_sides(footfit: Footfit, shop: Path) -> None:
    table = shop / "scans" / "pairs.csv"
    table.write_text("customer;left;right\nAnn;zoé DROITE.stl;\n", encoding="utf-8-sig")
    run = matched(footfit, "--pairs", table, "--json")
    error = json.loads(run.last_error)
    assert (run.code, error["code"]) == (5, "side_contradicted")
    forced = matched(footfit, "--pairs", table, "--force-side", "--json").document
    assert (forced["customer"], forced["feet"][0]["side"]) == ("Ann", "left")
    table.write_text("customer,left,right\nAnn,Zoé gauche.stl,zoé DROITE.stl\n", encoding="utf-8")
    document = matched(footfit, "--pairs", table, "--json").document
    assert [foot["side_source"] for foot in document["feet"]] == ["given", "given"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("scans", "--pairs", "auto", "--pair"), "--pairs for many"),
        (("scans", "--pairs", "auto", "--side", "left"), "--side goes with no --pairs"),
        (("scans", "--pairs", "pairs.csv"), "leave them out"),
        (("scans", "--customer", "Ann", "-o", "pages/"), "--customer names one customer"),
        (("--pairs", "auto"), "no mesh was given"),
        (("scans", "--force-side"), "--force-side goes with"),
        (("scans", "--pair", "--side", "left"), "--side goes with one foot"),
        (("scans", "--as-scanned", "--heel-lift", "5"), "--heel-lift does not go with"),
        (("scans", "--by", "shape", "--profile", "dress"), "--profile goes with --by fit"),
        ((), "no mesh was given"),
    ],
)
def test_what_does_not_go_together_is_refused(
    footfit: Footfit, shop: Path, arguments: tuple[str, ...], words: str
) -> None:
    run = matched(footfit, *arguments)
    assert run.code == 2
    assert words in run.err


# ---------------------------------------------------------------- folders


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("a/ann_L.stl", "b/Ann_R.stl", "--pairs", "auto", "-o", "pages/"), "rename one"),
        (("a/ann_L.stl", "b/Ann_R.stl", "--html", "x.html"), "name a folder (x/)"),
        (("a/ann_L.stl", "b/Ann_R.stl", "-o", "none/pages/"), "does not exist"),
        (("a/ann_L.stl", "-o", "old/"), "exists"),
    ],
)
def test_files_that_would_be_lost_are_refused_before_any_work(
    footfit: Footfit, shop: Path, arguments: tuple[str, ...], words: str
) -> None:
    for name in ("a/ann_L.stl", "b/Ann_R.stl", "old/ann_L.html"):
        (shop / name).parent.mkdir()
        (shop / name).write_text("no mesh: work on it would fail with 3", encoding="utf-8")
    before = sorted(shop.rglob("*"))
    run = matched(footfit, *arguments)
    assert run.code == 2
    assert words in run.err
    assert sorted(shop.rglob("*")) == before


def test_align_writes_many_into_a_folder(footfit: Footfit, shop: Path) -> None:
    run = footfit("align", "scans", "-o", "out/", "--plot", "out", "--json")
    assert run.code == 0
    assert sorted(path.name for path in (shop / "out").iterdir()) == [
        *("Zoé gauche.stl", "Zoé gauche.svg", "bob_R.stl", "bob_R.svg"),
        *("zoé DROITE.stl", "zoé DROITE.svg"),
    ]
    again = footfit("align", "scans", "-o", "out/")
    assert again.code == 2
    assert footfit("align", "scans/bob_R.stl", "-o", "out", "--force").code == 0
    own = footfit("align", "scans", "-o", "scans/", "--force")
    assert own.code == 2
    assert "is read by this command too" in own.err
    assert (shop / "scans" / "bob_R.stl").read_bytes() == OTHER.read_bytes()


def test_a_curvature_names_its_own_file_in_the_folder(footfit: Footfit, shop: Path) -> None:
    run = footfit("curvature", "scans/bob_R.stl", "-o", "out/", "--json")
    assert run.document["output"] == str(Path("out/bob_R.ply"))
    assert Path(run.document["output"]).is_file()
