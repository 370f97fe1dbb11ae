"""Tables: 80 columns, words for everything, and no outside string that acts."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.text import Text

from footfit.errors import BadOption
from footfit.pipeline.fit.match import matched
from footfit.report.terminal import catalogue_tables, match_tables, scan_tables
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import (
    DemoOutcome,
    EditOutcome,
    ExportOutcome,
    Library,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    SideVerdict,
    StoredLast,
    UpgradeOutcome,
)
from tests import answers

LONG = "a-very-long-name-of-a-last-made-for-somebody-with-patience-42-eu-wide"


def every_table(name: str = "derby-42"):
    record = answers.record(name, family=name, style=name)
    upgrade = UpgradeOutcome(name, "0001", "0002", "flare/1", (name,), name)
    foot = answers.foot(name, reference=replace(answers.reference(), last=name))
    return [
        scan_tables.align_table(foot.aligned.alignment),
        scan_tables.flare_table(foot),
        match_tables.match_table(answers.match((foot,), names=(name, "oxford-42"))),
        scan_tables.ingest_line(answers.outcome(last=name)),
        scan_tables.ingest_line(
            answers.outcome(status="refused", last=None, failure=BadOption(name, name), path=name)
        ),
        scan_tables.curvature_table(answers.curvature(name)),
        catalogue_tables.list_lasts_table(Library((record,), 1, name)),
        catalogue_tables.show_last_table(StoredLast(record, name)),
        catalogue_tables.catalogue_info_table(answers.facts(path=name, styles=((name, 1),))),
        catalogue_tables.set_reference_line(
            ReferenceOutcome(replace(answers.reference(), last=name), 3)
        ),
        catalogue_tables.rename_last_line(RenameOutcome(name, name)),
        catalogue_tables.remove_last_line(RemoveOutcome(name)),
        catalogue_tables.edit_last_table(
            EditOutcome(name, (("size", "41", "42"),), ("heel_height",), 3.0)
        ),
        catalogue_tables.export_last_line(ExportOutcome(name, name, 10, 0.1)),
        catalogue_tables.upgrade_catalogue_line(upgrade),
        catalogue_tables.demo_table(DemoOutcome(name, 12, name, (name,))),
    ]


@pytest.mark.parametrize("name", ["derby-42", LONG])
@pytest.mark.parametrize("width", [80, 120])
def test_no_line_is_wider_than_the_terminal(name: str, width: int) -> None:
    for table in every_table(name):
        if isinstance(table, Text):  # one line, however long it is: scripts count the lines
            assert len(terminal_text(table, width).splitlines()) == 1
            continue
        for line in terminal_text(table, width).splitlines():
            assert cell_len(line) <= width


def test_a_long_name_is_folded_and_not_cut() -> None:
    lines = terminal_text(match_tables.match_table(answers.match(names=(LONG,))), 80).splitlines()
    rows = lines[next(i for i, line in enumerate(lines) if "─" in line) + 1 :]
    assert "".join(line[4:24].strip() for line in rows).startswith(LONG)


def test_the_match_says_what_a_fitter_asks() -> None:
    text = terminal_text(match_tables.match_table(answers.match()), 100)
    assert "right foot, 260.0 mm long, flare +10.0 ± 0.2 deg, total ± 0.4 (straight)" in text
    assert "derby, EU 42 G" in text
    assert "+11.5" in text
    assert "toe room" in text
    assert "5 of 12 lasts, by fit, profile walking. Left out: 3 too long; 4 too short." in text


def test_nothing_fits_is_an_answer() -> None:
    text = terminal_text(match_tables.match_table(answers.match(candidates=())))
    assert "No last fits." in text


def test_a_verdict_is_a_word_and_has_its_column_once_it_is_there() -> None:
    match = answers.match()
    judged = tuple(replace(c, verdict="acceptable") for c in match.candidates)
    assert "  verdict" not in terminal_text(match_tables.match_table(match))
    text = terminal_text(match_tables.match_table(replace(match, candidates=judged)), 120)
    assert "  verdict" in text
    assert text.count("acceptable") == len(judged)


def test_a_real_answer_fits_eighty_columns_with_its_sentences_and_zones() -> None:
    lasts = tuple(answers.record(f"derby-{i}", 8 + i, 271 + i) for i in range(3))
    pair = (answers.foot("l.stl", left=True, length_mm=258.0), answers.foot("r.stl"))
    for feet in (pair[1:], pair):
        answer = matched(feet, Library(lasts, 3, None))
        text = terminal_text(match_tables.match_table(answer), 80)
        assert all(cell_len(line) <= 80 for line in text.splitlines())
        for candidate in answer.candidates:
            assert candidate.why[:60] in " ".join(text.split())
            assert candidate.verdict in text
        assert "Zone by zone" in text
        assert "not judged: not measured on the foot" in " ".join(text.split())
        assert "EU 41" in text


def test_the_size_system_asked_for_is_said_with_the_sizes_beside() -> None:
    text = terminal_text(match_tables.match_table(answers.match(size_system="uk")))
    assert "size UK 7.5; beside it UK 7 and UK 8" in text


def test_where_nothing_fits_the_nearest_are_shown() -> None:
    lasts = (answers.record("far", 8, 250.0), answers.record("near", 8, 262.0))
    answer = matched((answers.foot(),), Library(lasts, 2, None))
    text = terminal_text(match_tables.match_table(answer))
    assert "The nearest, and what they miss by:" in text
    assert text.index("near") < text.index("far ")
    assert "6.0 mm past the limit" in text


def test_a_label_that_is_off_is_flagged() -> None:
    right, wrong = answers.record("right", 8, 280.0), answers.record("wrong", 8, 253.0)
    text = terminal_text(catalogue_tables.list_lasts_table(Library((right, wrong), 2, None)))
    words = " ".join(text.split())
    assert "L the size on the label is more than a size from the length: wrong footfit" in words
    shown = [catalogue_tables.show_last_table(StoredLast(last, None)) for last in (wrong, right)]
    assert ["by its length" in terminal_text(table) for table in shown] == [True, False]


def test_ties_and_mirroring_are_said() -> None:
    match = answers.match()
    first = replace(match.candidates[0], tied_with=("a", "b", "c", "d"), mirrored=True)
    text = terminal_text(match_tables.match_table(replace(match, candidates=(first,))), 240)
    assert "; shown on the last of the other foot; tied with a, b, c and 1 more" in text


def test_plain_text_has_no_escape_and_colour_has() -> None:
    table = match_tables.match_table(answers.match())
    assert "\x1b" not in terminal_text(table, colour=False)
    assert "\x1b[" in terminal_text(table, colour=True)


@pytest.mark.parametrize(
    "name", ["[bold]x[/bold]", "[/]", "x\x1b[2Jy", "a\nb\rc", "a\u202eb", ":smile:"]
)
def test_names_cannot_act(name: str) -> None:
    for table in every_table(name):
        text = terminal_text(table, 200)
        assert "\x1b" not in text
        assert "\r" not in text
        assert "\u202e" not in text
        assert scan_tables.visible(name)[:3] in text


@given(st.text(min_size=1, max_size=25))
@settings(deadline=None, max_examples=60)
def test_any_name_can_be_shown(name: str) -> None:
    for table in every_table(name):
        text = terminal_text(table, 80)
        assert all(sign.isprintable() or sign == "\n" for sign in text)


def test_the_side_says_who_said_so() -> None:
    assert scan_tables.side_words(SideVerdict("left", "sure", -2.0, "given")) == "left (given)"
    other = "left (given; the shape looks right, score +2.0)"
    assert scan_tables.side_words(SideVerdict("left", "low", 2.0, "given")) == other


def test_the_list_marks_the_reference() -> None:
    text = terminal_text(
        catalogue_tables.list_lasts_table(Library((answers.record(),), 1, "derby-42"))
    )
    assert "derby-42 *" in text
    assert "derby-42 is the reference" in text
    text = terminal_text(catalogue_tables.list_lasts_table(Library((), 0, None)))
    assert "0 lasts; no reference is set" in text


def test_the_catalogue_keeps_no_feet_and_says_so() -> None:
    assert "no scan: it is read, matched and forgotten" in terminal_text(
        catalogue_tables.catalogue_info_table(answers.facts())
    )


def test_a_last_that_is_looked_for_by_shape_is_no_foot_and_has_no_foots_size() -> None:
    match = answers.match()
    (foot,) = match.feet[:1]
    pose = replace(foot.aligned.alignment.pose, kind="last")
    alignment = replace(foot.aligned.alignment, pose=pose)
    last = replace(foot, aligned=replace(foot.aligned, alignment=alignment))
    shown = terminal_text(match_tables.match_table(replace(match, by="shape", feet=(last,))))
    assert "last, " in shown.splitlines()[0]
    assert "sizes:" not in shown
    fitted = terminal_text(match_tables.match_table(replace(match, feet=(last,))))
    assert "foot, " in fitted.splitlines()[0]
    assert "sizes:" in fitted
