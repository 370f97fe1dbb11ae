"""What commands say on stderr: only surprises, each once, the path first, a line for each file."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.phases import begin, heard_by
from tests.conftest import ROOT, SAMPLES, Footfit
from tests.distortions import plane_cut
from tests.reading import read_scan

PAIR = [SAMPLES / "feet" / f"mh007_{side}.stl" for side in "LR"]
LAST = SAMPLES / "lasts" / "derby-40.stl"


def in_unit(source: Path, path: Path, mm_per_unit: float) -> Path:
    """The mesh of a file in another unit, in a file of its own."""
    scan = read_scan(source, units="mm")
    path.write_bytes(encoded_mesh(scan.vertices_mm / mm_per_unit, scan.faces, "stl"))
    return path


# ---------------------------------------------------------------- units


@pytest.mark.parametrize(
    "command",
    [
        ("align", PAIR[0]),
        ("measure", *PAIR),
        ("curvature", PAIR[0]),
        ("match", *PAIR, "--catalogue", "CATALOGUE"),
        ("compare", PAIR[1], "derby-40", "--catalogue", "CATALOGUE"),
        ("ingest-last", LAST, "--dry-run", "--replace", "--catalogue", "CATALOGUE"),
    ],
    ids=lambda command: command[0],
)
def test_plain_millimetres_are_not_announced(
    footfit: Footfit, stocked: Path, command: tuple[object, ...]
) -> None:
    run = footfit(*(stocked if word == "CATALOGUE" else word for word in command))
    assert run.code == 0
    assert "millimetres" not in run.err


@pytest.mark.parametrize("verb", ["align", "ingest-last"])
def test_the_unusual_units_of_a_batch_are_named_in_one_line(
    footfit: Footfit, tmp_path: Path, verb: str
) -> None:
    inches = in_unit(PAIR[0], tmp_path / "inches.stl", 25.4)
    metres = in_unit(PAIR[1], tmp_path / "metres.stl", 1000.0)
    more = ("--catalogue", tmp_path / "c.footfit", "--dry-run") if verb == "ingest-last" else ()
    run = footfit(verb, *PAIR, inches, metres, *more, "--json")
    assert run.code == 0
    lines = [line for line in run.err.splitlines() if "taken as" in line]
    assert lines == [
        f"2 of 4 taken as millimetres; 1 as inches: {inches}; 1 as metres: {metres}"
        " (--units changes this)"
    ]
    told = [[each["code"] for each in line["warnings"]] for line in run.lines]
    assert [codes.count("units_detected") for codes in told] == [0, 0, 1, 1] or verb != "align"
    alone = footfit("align", inches).err
    assert alone.startswith(f"{inches}: the numbers are taken as inches")


# ---------------------------------------------------------------- the path first


def test_every_notice_begins_with_the_path_that_it_speaks_of(
    footfit: Footfit, catalogue: Path, tmp_path: Path
) -> None:
    scan = read_scan(PAIR[1])
    top = scan.vertices_mm[:, 2].min() + 58.0
    low = tmp_path / "low.stl"
    mesh = plane_cut(scan.vertices_mm, scan.faces, [0, 0, top], [0, 0, 1.0])
    low.write_bytes(encoded_mesh(*mesh, "stl"))
    runs = [
        footfit("match", PAIR[0], low, "--pair", "--catalogue", catalogue),
        footfit("match", low, "--size-system", "uk", "--catalogue", catalogue),
        footfit("compare", low, "derby-40", "--catalogue", catalogue),
        footfit("measure", low, PAIR[0]),
        footfit("ingest-last", low, "--catalogue", catalogue, "--dry-run"),
    ]
    paths = (str(low), str(PAIR[0]), str(catalogue))
    for run in runs:
        assert run.code == 0
        assert "cut" in run.err
        for line in run.err.splitlines():
            assert line.startswith(paths), line


def test_a_notice_about_all_customers_is_said_once(
    footfit: Footfit, catalogue: Path, foot: Path
) -> None:
    run = footfit("match", *PAIR, "--size-system", "uk", "--catalogue", catalogue)
    assert run.err.count("no last is labelled in UK sizes") == 1


# ---------------------------------------------------------------- once


def test_what_the_table_says_is_not_said_twice(footfit: Footfit, stocked: Path) -> None:
    command = ("match", PAIR[0], "--known-length", 200, "--catalogue", stocked)
    shown = footfit(*command)
    assert "No last fits" in shown.out
    assert "no last fits" not in shown.err
    for other in (["--json"], ["--csv", "-"]):
        assert footfit(*command, *other).err.count("no last fits") == 1


# ---------------------------------------------------------------- files


def test_each_written_file_has_a_line(footfit: Footfit, stocked: Path, tmp_path: Path) -> None:
    page, rows, plot = (tmp_path / name for name in ("a.html", "a.csv", "a.svg"))
    run = footfit("match", PAIR[0], "--html", page, "--csv", rows, "--catalogue", stocked)
    assert run.err.splitlines()[-2:] == [f"wrote {page}", f"wrote {rows}"]
    assert footfit("flare", PAIR[0], "--plot", plot, "--quiet").err == ""
    again = footfit("flare", PAIR[0], "--plot", plot, "--force")
    assert again.err == f"wrote {plot}\n"


def test_with_json_an_error_stays_the_last_line(footfit: Footfit, tmp_path: Path) -> None:
    rows = tmp_path / "rows.csv"
    run = footfit("measure", PAIR[0], tmp_path / "none.stl", "--csv", rows, "--json")
    assert run.code == 3
    assert f"wrote {rows}" in run.err
    assert json.loads(run.last_error)["code"] == "unreadable_file"


# ---------------------------------------------------------------- progress


def test_the_phases_of_a_customer_come_in_order(footfit: Footfit, stocked: Path) -> None:
    heard: list[str] = []
    begin("page")  # nobody listens: nothing happens
    with heard_by(heard.append):
        from footfit.api.catalogues import open_catalogue

        answers = open_catalogue(stocked).match_each(
            [str(path) for path in PAIR], pair=True, jobs=1
        )
        assert [outcome.error for outcome in answers] == [None]
    assert heard == ["reading", "pose", "measures"] * 2 + ["match"]


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="the system has no pseudo-terminals")
def test_a_person_who_waits_for_one_customer_sees_the_phases(stocked: Path, tmp_path: Path) -> None:
    shown = seen_on_a_terminal(
        *("match", *PAIR, "--pair", "--html", tmp_path / "page.html", "--catalogue", stocked)
    )
    for phase in ("reading", "pose", "measures", "match", "page"):
        assert phase in shown
    assert " s left" in shown
    assert f"wrote {tmp_path / 'page.html'}" in shown.replace("\r\n", "")
    many = seen_on_a_terminal("align", *PAIR)
    assert "1/2" in many
    assert "reading" not in many
    for quiet in ("--quiet", "--json"):
        assert seen_on_a_terminal("align", PAIR[0], quiet) == ""


def seen_on_a_terminal(*arguments: object) -> str:
    """What a run of footfit shows on stderr, if that is a terminal."""
    master, slave = os.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "200"}
    words = [str(argument) for argument in arguments]
    process = subprocess.Popen(
        [sys.executable, "-m", "footfit", *words],
        stdout=subprocess.DEVNULL,
        stderr=slave,
        cwd=ROOT,
        env=environment,
    )
    os.close(slave)
    shown = b""
    while True:
        try:
            read = os.read(master, 65536)
        except OSError:  # the last one who writes has gone
            break
        if not read:
            break
        shown += read
    os.close(master)
    assert process.wait() == 0
    return shown.decode()
