"""Every number and word of the smaller tables and CSVs is the one of the result."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rich.console import RenderableType

from footfit.report.csv import csv_text
from footfit.report.terminal.catalogue_tables import (
    backup_catalogue_line,
    catalogue_info_table,
    check_catalogue_table,
    copy_catalogue_line,
    demo_table,
    export_last_line,
    list_lasts_table,
    remove_last_line,
    rename_last_line,
    restore_catalogue_table,
    set_reference_line,
    show_last_table,
    upgrade_catalogue_line,
)
from footfit.report.terminal.scan_tables import (
    align_table,
    curvature_table,
    flare_table,
    ingest_line,
    measure_table,
    terminal_text,
)
from footfit.results import (
    BackupOutcome,
    CheckOutcome,
    CopyOutcome,
    DemoOutcome,
    ExportOutcome,
    Finding,
    Library,
    Measure,
    Measured,
    MeasuredScan,
    Notice,
    Profiled,
    Reference,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    RestoreOutcome,
    StoredLast,
    UpgradeOutcome,
)
from tests import answers, readers, records
from tests.readback import CSV, TERMINAL, holds, problems
from tests.readback_tables import (
    align_facts,
    catalogue_facts,
    curvature_facts,
    flare_facts,
    last_facts,
    library_facts,
    measured_facts,
)

WIDE = 400


def test_the_outputs_show_the_measures() -> None:
    scan = answers.measured_scan("feet/anna.stl")
    more = Measure("heel_width", Measured(63.4321, 0.0), "heel_width/2")
    many = [replace(scan, measures=(*scan.measures, more)), answers.measured_scan("b.stl")]
    facts = [known for one in many for known in measured_facts(one)]
    cells = readers.read_keyed_csv(csv_text(MeasuredScan, many), "path", "measure")
    assert problems(CSV, cells, facts) == []
    table = readers.read_terms(terminal_text(measure_table(many[0]), WIDE))
    assert problems(TERMINAL, table, measured_facts(many[0])) == []


@pytest.mark.parametrize("spoilt", [(), ("bottom_20",)])
def test_the_outputs_show_the_flare(spoilt: tuple[str, ...]) -> None:
    foot = answers.foot("feet/left.stl", left=True, turn_deg=-3.4)
    shape = replace(foot, flare=answers.profile(-3.4, spoilt))
    holed = shape.flare.curvature["plan"].copy()
    holed[7] = np.nan
    shape = replace(
        shape, flare=replace(shape.flare, curvature=shape.flare.curvature | {"plan": holed})
    )
    table = readers.read_terms(terminal_text(flare_table(shape), WIDE))
    assert problems(TERMINAL, table, flare_facts(shape)) == []
    assert (
        problems(CSV, readers.read_stations_csv(csv_text(Profiled, [shape])), flare_facts(shape))
        == []
    )


def test_the_outputs_show_the_library() -> None:
    lasts = [
        answers.record("boot-42", 9.6, 271.3, left=True, heel_height_mm=34.6, family="boots"),
        answers.record("derby-41", 8.1, 265.7, size="41", parent="derby-40", width_label=None),
        answers.record("pump", -2.2, 259.9, style=None, size=None, size_system=None),
    ]
    library = Library(tuple(lasts), 3, "boot-42")
    table = readers.read_lasts_terminal(terminal_text(list_lasts_table(library), WIDE))
    assert problems(TERMINAL, table, library_facts(lasts, "boot-42")) == []
    cells = readers.read_keyed_csv(
        csv_text(Library, [replace(library, lasts=tuple(lasts[::-1]))]), "last"
    )
    assert problems(CSV, cells, library_facts(lasts, "boot-42")) == []


@pytest.mark.parametrize("reference", [None, answers.reference()])
def test_the_table_shows_the_alignment(reference: Reference | None) -> None:
    for left, sole in ((False, True), (True, False)):
        known = answers.alignment("feet/anna.stl", left=left, reference=reference)
        known = replace(known, pose=replace(known.pose, sole=sole))
        table = readers.read_terms(terminal_text(align_table(known), WIDE))
        assert problems(TERMINAL, table, align_facts(known)) == []


@pytest.mark.parametrize("radius_mm", [15.0, 0.0])
def test_the_table_shows_the_curvature(radius_mm: float) -> None:
    known = replace(answers.curvature(), radius_mm=radius_mm)
    table = readers.read_terms(terminal_text(curvature_table(known), WIDE))
    assert problems(TERMINAL, table, curvature_facts(known)) == []


@pytest.mark.parametrize("reference", ["boot-42", "derby-41", None])
def test_the_table_shows_the_last(reference: str | None) -> None:
    record = answers.record("boot-42", 9.6, 271.3, left=True, heel_height_mm=34.6, family="boots")
    more = (
        Measure("ball_girth", Measured(241.7, 1.3), "ball_girth/1"),
        Measure("heel_width", Measured(None, None, "open at the heel"), "heel_width/1"),
    )
    note = Notice("holes_closed", "4 holes were closed")
    record = replace(
        record, measures=(*record.measures, *more), warnings=(note,), upgraded_from="flare/0"
    )
    plain = replace(answers.record("pump", -2.2, style=None, size=None), paper_transform=None)
    custom = {"rule": None, "profile": "dress", "made_by": "customise"}
    for last in (
        StoredLast(record, reference),
        StoredLast(plain, reference),
        StoredLast(record, reference, parentage=records.parentage("boot-40")),
        StoredLast(record, reference, parentage=records.parentage("boot-40", **custom)),
    ):
        table = readers.read_terms(terminal_text(show_last_table(last), WIDE))
        assert problems(TERMINAL, table, last_facts(last)) == []


def test_the_table_shows_the_catalogue() -> None:
    sides, systems = (("right", 9), ("left", 3)), (("eu", 11), ("", 1))
    for more in ({}, {"worst_copy_error_mm": None, "reference": None}):
        known = answers.facts(sides=sides, size_systems=systems, **more)
        table = readers.read_terms(terminal_text(catalogue_info_table(known), WIDE), titled=False)
        assert problems(TERMINAL, table, catalogue_facts(known)) == []


LINES: list[tuple[RenderableType, tuple[str, ...]]] = [
    (set_reference_line(ReferenceOutcome(answers.reference(), 3)), ("derby-42", "3")),
    (rename_last_line(RenameOutcome("new-7", "old-6")), ("old-6", "new-7")),
    (remove_last_line(RemoveOutcome("old-6")), ("old-6",)),
    (export_last_line(ExportOutcome("a-1", "a.json")), ("a-1", "a.json")),
    (
        export_last_line(ExportOutcome("a-1", "a.stl", 12_345, 0.184)),
        ("a-1", "a.stl", "12,345", "0.18"),
    ),
    (
        copy_catalogue_line(CopyOutcome("c.footfit", "d.footfit", 14, 3)),
        ("c.footfit", "d.footfit", "14", "3"),
    ),
    (
        backup_catalogue_line(BackupOutcome("c.footfit", "b.footfit", 1_849_000, 14)),
        ("c.footfit", "b.footfit", "14", "1.8"),
    ),
    (check_catalogue_table(CheckOutcome("c", 14, 13, ())), ("c", "14", "13", "sound")),
    (
        check_catalogue_table(CheckOutcome("c", 14, 13, (Finding("last", "bad 2", "a-7"),))),
        ("c", "14", "13", "last", "a-7", "bad 2"),
    ),
    (
        restore_catalogue_table(RestoreOutcome("c", "b.footfit", 14, "old.footfit")),
        ("c", "b.footfit", "14", "old.footfit"),
    ),
    (
        upgrade_catalogue_line(UpgradeOutcome("c", "0001", "0002", "flare/3", ("a", "b"), "old")),
        ("c", "0001", "0002", "2", "flare/3", "none", "old"),
    ),
    (
        upgrade_catalogue_line(UpgradeOutcome("c", "0002", "0002", "flare/3", (), None)),
        ("c", "0002", "as before", "0", "flare/3", "none", "-"),
    ),
    (
        demo_table(DemoOutcome("demo", 14, "derby-40", ("a.json", "r.html"))),
        ("demo", "14", "derby-40", "a.json", "r.html"),
    ),
    (ingest_line(answers.outcome()), ("added", "derby-42", "right", "+8.0")),
    (ingest_line(answers.outcome(reference=True, side=None)), ("added", "derby-42", "+8.0", "is")),
]


@pytest.mark.parametrize("number", range(len(LINES)))
def test_a_line_shows_its_outcome(number: int) -> None:
    line, values = LINES[number]
    assert holds(" ".join(terminal_text(line, WIDE).split()), values)
