"""Other labels for a stored last: what changes, what is measured again, and what is refused."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

import footfit as library
from footfit.catalogue.file.file_signature import SIGNATURE
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, CatalogueDamaged, NoCatalogue, UnknownLast
from footfit.pipeline.library import edit
from footfit.pipeline.library.edit import EDITABLE, edit_last
from footfit.pipeline.scan.trueness import SCANNER_SD_MM
from footfit.results import LastLabels, LastRecord
from tests import records
from tests.conftest import SAMPLES, Footfit
from tests.torture.kills import kill_trials
from tests.torture.scripts import MAIN, Script, values

LAST = "derby-40"
SCAN_MM = 0.12
"""How far a measure of a sample last's copy may be from that of its scan; measured: 0.082."""


def record_in(path: Path, name: str = LAST) -> LastRecord:
    """A last as it is stored."""
    with open_catalogue(path) as opened:
        return opened.record(name)


def findings(path: Path) -> list[object]:
    """What is wrong with a catalogue."""
    with open_catalogue(path) as opened:
        return list(opened.findings())


def measures(record: LastRecord) -> dict[str, object]:
    """Every measured value by its name."""
    return {row.name: row.measured for row in record.measures}


# ---------------------------------------------------------------- labels alone


def test_a_label_changes_and_nothing_else(catalogue: Path) -> None:
    before = record_in(catalogue)
    outcome = edit_last(catalogue, LAST.upper(), {"style": "brogue", "width_label": "H"})
    after = record_in(catalogue)
    assert after.labels == replace(before.labels, style="brogue", width_label="H")
    assert records.plain(replace(after, labels=before.labels)) == records.plain(before)
    assert outcome.changes == (("style", "derby", "brogue"), ("width_label", "G", "H"))
    assert (outcome.last, outcome.status, outcome.measured_again) == (LAST, "edited", ())
    assert findings(catalogue) == []


def test_an_empty_value_removes_a_label(catalogue: Path) -> None:
    edit_last(catalogue, LAST, {"style": "  ", "size": "", "heel_height_mm": None})
    labels = record_in(catalogue).labels
    assert (labels.style, labels.size, labels.heel_height_mm) == (None, None, None)
    assert labels.size_system == "eu"


def test_the_same_labels_write_nothing(catalogue: Path) -> None:
    before = catalogue.read_bytes()
    labels = record_in(catalogue).labels
    same = {name: getattr(labels, name) for name in EDITABLE}
    assert edit_last(catalogue, LAST, same).status == "unchanged"
    assert catalogue.read_bytes() == before


@pytest.mark.parametrize(("size", "flagged"), [("40", False), ("39.5", False), ("45", True)])
def test_a_size_that_the_length_contradicts_is_said(
    catalogue: Path, size: str, *, flagged: bool
) -> None:
    codes = [notice.code for notice in edit_last(catalogue, LAST, {"size": size}).warnings]
    assert codes == (["size_contradicted"] if flagged else [])


# ---------------------------------------------------------------- how it stands


def test_a_heel_label_decides_the_stance_as_at_the_ingest(catalogue: Path, tmp_path: Path) -> None:
    """The edited last is what the ingest of its file with that label gives."""
    edit_last(catalogue, LAST, {"heel_height_mm": 30.0, "toe_spring_mm": 12.4})
    edited = record_in(catalogue)
    fresh = tmp_path / "fresh.footfit"
    with library.open_catalogue(fresh) as lasts:
        labels = replace(edited.labels)
        lasts.ingest(str(SAMPLES / "lasts" / "derby-40.stl"), labels=labels, side="right")
        wanted = lasts.last(LAST).record
    assert edited.stance_by == wanted.stance_by == "label"
    assert edited.ground_sd_deg == pytest.approx(wanted.ground_sd_deg, abs=5e-6)
    for row, target in zip(edited.measures, wanted.measures, strict=True):
        assert row.definition == target.definition
        assert row.measured.value == pytest.approx(target.measured.value, abs=SCAN_MM), row.name
        assert row.measured.total_sd == pytest.approx(target.measured.total_sd, abs=0.02), row.name
    assert edited.flare.angle_deg == pytest.approx(wanted.flare.angle_deg, abs=0.002)
    assert [n.code for n in edited.warnings] == [n.code for n in wanted.warnings]
    assert findings(catalogue) == []


def test_a_measure_taken_again_keeps_the_scanners_part_of_its_total_sd(tmp_path: Path) -> None:
    """The edited last is as sure as its file, ingested from that scanner with that label."""
    file = str(SAMPLES / "lasts" / "derby-40.stl")
    totals = []
    for height_mm in (None, 30.0):
        path = tmp_path / f"{height_mm}.footfit"
        with library.open_catalogue(path) as lasts:
            labels = LastLabels("", heel_height_mm=height_mm)
            lasts.ingest(file, labels=labels, side="right", scanner="phone")
        if height_mm is None:
            again = edit_last(path, LAST, {"heel_height_mm": 30.0}).measured_again
        totals.append({row.name: row.measured.total_sd for row in record_in(path).measures})
    edited, wanted = totals
    assert {"heel_height", "stick_length"} <= set(again)
    for name in again:
        assert edited[name] == pytest.approx(wanted[name], abs=0.02), name
    assert edited["heel_height"] is not None
    assert edited["heel_height"] > SCANNER_SD_MM["phone"]["height"]


def test_what_the_stance_does_not_change_stays_as_it_was_scanned(catalogue: Path) -> None:
    before = measures(record_in(catalogue))
    outcome = edit_last(catalogue, LAST, {"heel_height_mm": 40.0})
    after = measures(record_in(catalogue))
    assert {"heel_height", "toe_spring", "stick_length"} <= set(outcome.measured_again)
    assert {"length", "ball_girth", "heel_width"}.isdisjoint(outcome.measured_again)
    for name, value in before.items():
        assert (after[name] == value) == (name not in outcome.measured_again)


@pytest.mark.parametrize(
    "labels",
    [{"heel_height_mm": 60.0}, {"toe_spring_mm": 40.0}, {"platform_mm": 20.0}],
)
def test_a_heel_that_the_shape_contradicts_is_said_until_it_is_mended(
    catalogue: Path, labels: dict[str, float]
) -> None:
    usual = record_in(catalogue)
    outcome = edit_last(catalogue, LAST, labels)
    assert [notice.code for notice in outcome.warnings] == ["stance_label_contradicted"]
    assert "stance_label_contradicted" in [n.code for n in record_in(catalogue).warnings]
    (label,) = labels
    mended = edit_last(catalogue, LAST, {label: getattr(usual.labels, label)})
    assert mended.warnings == ()
    assert record_in(catalogue).warnings == usual.warnings
    again = measures(record_in(catalogue))
    for name, value in measures(usual).items():
        assert again[name].value == pytest.approx(value.value, abs=SCAN_MM)


def test_the_reference_can_be_edited(catalogue: Path) -> None:
    with open_catalogue(catalogue) as opened:
        reference = opened.reference()
    assert reference is not None
    edit_last(catalogue, reference.last, {"heel_height_mm": 30.0})
    with open_catalogue(catalogue) as opened:
        assert records.plain(opened.reference()) == records.plain(reference)
    assert findings(catalogue) == []


def test_match_goes_by_the_new_labels(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    here = ("--catalogue", catalogue, "--json")
    with library.open_catalogue(catalogue) as lasts:
        lasts.edit_last(LAST, style="only this one")
        answer = lasts.match(str(foot), style="Only this one", by="flare")
    assert [candidate.last for candidate in answer.candidates] == [LAST]
    run = footfit("match", foot, "--style", "only this one", "--by", "flare", *here)
    assert [candidate["last"] for candidate in run.document["candidates"]] == [LAST]


# ---------------------------------------------------------------- refusals: nothing changes


@pytest.mark.parametrize(
    "labels",
    [
        {},
        {"heel_height_mm": 500.0},
        {"heel_height_mm": -1.0},
        {"heel_height_mm": float("nan")},
        {"toe_spring_mm": float("inf")},
        {"platform_mm": "thick"},
        {"name": "other"},
        {"side": "left"},
        {"style": "brogue", "toe_spring_mm": 90.0},
    ],
)
def test_a_value_that_no_last_has_changes_nothing(
    catalogue: Path, labels: dict[str, object]
) -> None:
    before = catalogue.read_bytes()
    with pytest.raises(BadOption):
        edit_last(catalogue, LAST, labels)
    assert catalogue.read_bytes() == before


def test_a_last_without_a_mesh_takes_labels_but_no_heel(catalogue: Path) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        opened.add(opened.record(LAST), None, replace=True)
    edit_last(catalogue, LAST, {"size": "41"})
    before = catalogue.read_bytes()
    with pytest.raises(UnknownLast, match=r"stored without its mesh.*--replace"):
        edit_last(catalogue, LAST, {"size": "42", "heel_height_mm": 30.0})
    assert catalogue.read_bytes() == before
    assert record_in(catalogue).labels.size == "41"


@pytest.mark.parametrize("harm", ["rows", "copy"])
def test_a_damaged_last_gets_no_new_hash(catalogue: Path, harm: str) -> None:
    what = "last SET style = 'x'" if harm == "rows" else "mesh_copy SET faces = 7"
    with closing(sqlite3.connect(catalogue)) as connection:
        connection.execute(f"UPDATE {what}")
        connection.commit()
    before = catalogue.read_bytes()
    with pytest.raises(CatalogueDamaged, match="--replace"):
        edit_last(catalogue, LAST, {"heel_height_mm": 30.0})
    assert catalogue.read_bytes() == before


def test_a_fault_in_the_middle_leaves_the_old(
    catalogue: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = values(catalogue)

    def failing(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(edit, "with_measured", failing)
    with pytest.raises(KeyboardInterrupt):
        edit_last(catalogue, LAST, {"style": "brogue", "heel_height_mm": 30.0})
    assert values(catalogue) == before
    assert findings(catalogue) == []


def test_no_catalogue_is_made(tmp_path: Path) -> None:
    with pytest.raises(NoCatalogue):
        edit_last(tmp_path / "none", LAST, {"style": "x"})
    assert not list(tmp_path.iterdir())


# ---------------------------------------------------------------- the command line


def test_the_command_says_what_changed(footfit: Footfit, catalogue: Path) -> None:
    here = ("--catalogue", catalogue)
    run = footfit("edit-last", LAST, "--size", "45", "--heel-height", "60", "--style=", *here)
    assert run.code == 0
    said = " ".join(run.out.split())
    for words in ("edited derby-40", "size 40 to 45", "style derby to none", "25 mm to 60 mm"):
        assert words in said
    for words in ("larger than its length", "lower than the label says"):
        assert f"{LAST}: " in run.err
        assert words in run.err
    document = footfit("edit-last", LAST, "--size", "40", *here, "--json").document
    assert document["schema"] == "footfit.edit-last/1"
    assert document["changes"] == {"size": {"before": "45", "after": "40"}}
    assert (document["status"], document["measured_again"]) == ("edited", [])
    shown = footfit("show-last", LAST, *here, "--json").document
    assert (shown["size"], shown["heel_height_mm"], shown["style"]) == ("40", 60.0, None)


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        ((LAST,), 2, "nothing to change"),
        ((LAST, "--heel-height", "high"), 2, "--heel-height takes a number of mm"),
        ((LAST, "--toe-spring", "90"), 2, "a toe spring is from 0 to 80 mm"),
        (("derby-4O", "--size", "40"), 4, "the nearest is 'derby-4"),
        (("none", "--size", "40"), 4, "see footfit list-lasts"),
    ],
)
def test_the_command_refuses_in_one_line(
    footfit: Footfit, catalogue: Path, arguments: tuple[str, ...], code: int, words: str
) -> None:
    before = catalogue.read_bytes()
    run = footfit("edit-last", *arguments, "--catalogue", catalogue)
    assert (run.code, run.out, len(run.err.splitlines())) == (code, "", 1)
    assert words in run.err
    assert catalogue.read_bytes() == before


def test_an_older_catalogue_is_upgraded_first(footfit: Footfit, tmp_path: Path) -> None:
    old = Path(__file__).parent / "data" / "catalogue-0001.footfit"
    place = tmp_path / "old.footfit"
    place.write_bytes(old.read_bytes())
    run = footfit("edit-last", "last-1", "--size", "43", "--catalogue", place, "--json")
    assert run.code == 0
    info = footfit("catalogue-info", "--catalogue", place, "--json").document
    assert info["schema_revision"] == SIGNATURE.revisions[-1]
    assert record_in(place, "last-1").labels.size == "43"


# ---------------------------------------------------------------- kills


def edited_twice(folder: Path, done: int) -> Iterator[None]:
    """Two edits that measure the last again, each in an opening of its own."""
    for heel_mm in (30.0, 20.0)[done:]:
        edit_last(folder / MAIN, LAST, {"style": f"heel {heel_mm:g}", "heel_height_mm": heel_mm})
        yield


def test_kill_9_leaves_the_labels_and_measures_before_or_after(
    catalogue: Path, tmp_path: Path
) -> None:
    def prepare(folder: Path) -> None:
        shutil.copy(catalogue, folder / MAIN)

    place = tmp_path / "kills"
    place.mkdir()
    tally = kill_trials(place, Script("edit-last", edited_twice, prepare), 4, seed=1)
    assert (tally.struck, tally.bad) == (4, [])
