"""Every number and verdict of the page, the CSVs and the tables is the one of the result.

The planted answers have no two numbers alike, so that a value in another's place is seen.
"""

from __future__ import annotations

import importlib
import pkgutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from itertools import count
from pathlib import Path

import numpy as np
import pytest

from footfit.geometry.fit.clearance import ZoneClearance
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.customers.customer import alone, one_pair
from footfit.pipeline.customers.matches import matches
from footfit.pipeline.drawables import best_comparisons
from footfit.pipeline.fit.match import Question
from footfit.pipeline.shelf.candidates import choice
from footfit.pipeline.width.foot_width import foot_widths
from footfit.report.csv import csv_text
from footfit.report.page.compare_page import compare_page
from footfit.report.page.match_page import match_page
from footfit.report.terminal.comparison_tables import compare_table
from footfit.report.terminal.match_tables import match_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import (
    Comparison,
    FootFit,
    HeelChange,
    Match,
    Measure,
    Measured,
    Notice,
    SurfaceClearance,
    ToeBox,
    ToeFit,
    ZoneFit,
)
from tests import answers, readers
from tests.comparisons import comparison
from tests.conftest import SAMPLES, Footfit
from tests.readback import (
    CSV,
    PAGE,
    TERMINAL,
    Reading,
    comparison_facts,
    fact,
    holds,
    match_facts,
    problems,
)

WIDE = 400
ZONES = (("length", "mm"), ("ball_girth", "mm"), ("ball_line", "percent"), ("flare", "deg"))
ZONES += (("heel_width", "mm"), ("plan", "ratio"), ("toes", "mm"))
VERDICTS = ("good", "acceptable", "poor", "reject")
LAST_NAMES = ("oxford", "derby", "loafer", "boot", "pump")


class _Drawn:
    """Stands for a figure: the words under it are read, its drawing is another test's."""


@pytest.fixture(autouse=True)
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages with empty pictures: no function named as its module draws."""
    from footfit.report import pictures

    for found in pkgutil.iter_modules(pictures.__path__):
        module = importlib.import_module(f"{pictures.__name__}.{found.name}")
        if hasattr(module, found.name):
            monkeypatch.setattr(module, found.name, lambda *_, **__: _Drawn())
        if hasattr(module, "svg_text"):
            monkeypatch.setattr(module, "svg_text", lambda _figure: "<svg/>")


# ------------------------------------------------------------------ planted answers


def planted_feet(pair: bool) -> tuple:
    """A left and a right foot, or the right one, with what could be measured and what not."""
    feet = []
    for number, (path, left) in enumerate((("l.stl", True), ("r.stl", False))[1 - pair :]):
        foot = answers.foot(path, left=left, length_mm=258.3 + 2.9 * number, turn_deg=9.4 + number)
        note = Notice("holes_closed", f"{number + 4} holes were closed")
        alignment = replace(foot.aligned.alignment, warnings=(note,))
        info = replace(alignment.info, faces=7_680 + 1_211 * number)
        aligned = replace(foot.aligned, alignment=replace(alignment, info=info))
        rows = (
            Measure("ball_girth", Measured(241.7 + 3.1 * number, 1.3 + number), "ball_girth/1"),
            Measure("heel_width", Measured(63.4 + 1.7 * number), "heel_width/1"),
            Measure("instep_girth", Measured(None, None, "the leg is cut"), "instep_girth/1"),
        )
        feet.append(replace(foot, aligned=aligned, measures=(*foot.measures, *rows)))
    return tuple(feet)


def planted_fits(number: int, feet: int) -> tuple[FootFit, ...]:
    """Each foot in each zone of a last: another clearance, score and verdict everywhere."""
    fits = []
    for foot, side in zip(range(feet), ("left", "right")[2 - feet :], strict=True):
        zones = []
        for place, (zone, unit) in enumerate(ZONES):
            value = round(-7.63 + 3.17 * place + 1.23 * number - 0.41 * foot, 2)
            lacking = zone == "ball_line" and number == 0
            known = Measured(None, None, "no joint") if lacking else Measured(value, 0.3 + foot)
            verdict = None if lacking else VERDICTS[(place + number + foot) % 4]
            counts = not (foot and zone == "heel_width")
            score, target = value / 7, -4.5 + 1.5 * place
            where = "big toe, inner wall" if zone == "toes" else None
            zones.append(ZoneFit(zone, unit, known, target, score, verdict, counts, where))
        heel, toes = planted_heel(number, foot), planted_toes(number, foot)
        fits.append(FootFit(side, VERDICTS[(number + foot) % 4], tuple(zones), heel, toes))
    return tuple(fits)


def planted_toes(number: int, foot: int) -> ToeBox | None:
    """The toes of a foot in a last; in one they press more than anything else, in one they are not
    known.
    """
    if number == 1:
        return None
    deepest = -17.4 - foot if number == 3 else 1.7 + number
    toes = tuple(
        ToeFit(toe, "inner", Measured(deepest + 2.3 * place, 0.7))
        for place, toe in enumerate(("big toe", "second toe", "third toe"))
    )
    points = np.array([[200.0, 30.0], [240.0, 10.0], [210.0, -30.0]])
    wall = np.array([[160.0, -45.0, 40.0], [260.0, -5.0, 5.0]])
    return ToeBox(toes, points, np.arange(3), wall)


def planted_heel(number: int, foot: int) -> HeelChange | None:
    """What the heel of a last changes of a foot; of one last its drop is not known, and one foot is
    taken as it was scanned.
    """
    if number == 3:
        return None
    names = ("length", "ball_width", "ball_girth", "heel_width", "flare_angle")[number % 2 :]
    step = 0.37 * number + 0.19 * foot
    changes = [(name, Measured(step - 1.7 * i - 0.61, 0.5)) for i, name in enumerate(names)]
    drop_mm = None if number == 2 else 41.3 + 7.1 * number
    share = 0.517 + 0.1 * number
    return HeelChange(drop_mm, 3.3, "flat-to-heel/1", share, True, False, tuple(changes))


def planted_surfaces(number: int, feet: int) -> tuple[SurfaceClearance, ...]:
    """Where each foot is tight and loose in a last; the last foot could not be laid into one."""
    rooms = []
    for foot, side in zip(range(feet), ("left", "right")[2 - feet :], strict=True):
        step = 0.7 * number + 0.3 * foot
        zones = (
            ZoneClearance("medial", 0.63, -6.15 - step, 9.19, 91.1, 26.4 + 9 * step, 5.2),
            ZoneClearance("lateral", 1.21, -3.05 - step, 8.3, 88.4, 31.7 + 9 * step, 2.1),
            ZoneClearance("dorsal", 2.34, -2.45 - step, 10.9, 44.0, 12.3, 14.9 + 9 * step),
            ZoneClearance("toe", 5.61, -1.08, 12.31 + step, 47.3, 1.5, 17.6 + 9 * step),
            ZoneClearance("bottom", None, None, None, 0.0, 0.0, 0.0),
        )
        bad = number == 2 and foot == feet - 1
        room = (None, (), "the sole is open") if bad else (2.9 + step, zones, None)
        rooms.append(SurfaceClearance(side, *room))
    return tuple(rooms)


def planted(feet: int = 1, lasts: int = 5, *, judged: bool = True, **more: object) -> Match:
    """An answer that shows everything that an answer can show."""
    shapes = planted_feet(feet == 2)
    many = []
    for number, name in zip(range(lasts), LAST_NAMES, strict=False):
        record = answers.record(f"{name}-4{number}", 4.3 + 1.9 * number, 269.4 + 1.7 * number)
        labels = {"style": name, "size": f"4{number}", "width_label": "GHKLM"[number]}
        record = replace(record, labels=replace(record.labels, **labels))
        one = answers.candidate(
            number + 1,
            record,
            verdict=VERDICTS[number % 4] if judged else None,
            why=f"tight at the {name}'s ball by {1.1 + number:.1f} mm",
            mirrored=number == 3,
        )
        spread = None if number == 4 else 0.61 + 0.1 * number
        many.append(
            replace(
                one,
                distance=0.834 + 0.373 * number,
                distance_sd=0.1234567 + 0.1 * number if judged else None,
                flare=replace(one.flare, distance=0.4321987 + number),
                clearance_mm=(
                    ("length", Measured(11.2 + 1.4 * number, spread)),
                    ("ball_girth", Measured(-3.7 + number, 1.5)),
                ),
                fits=planted_fits(number, feet) if judged else (),
                not_judged=("ball_line", "toe_height") if number == 0 else (),
                surfaces=planted_surfaces(number, feet),
            )
        )
    values: dict[str, object] = {
        "candidates": tuple(many),
        "catalogue_lasts": 17,
        "reference": "derby-41",
        "rejected": (("too_long", 3), ("too_short", 4)),
        "warnings": (Notice("damaged_last", "pump-39 was left out: it is damaged"),),
    }
    match = answers.match(shapes, **(values | more))
    return replace(match, widths=foot_widths(match.feet))


def as_nearest(match: Match) -> Match:
    """The same lasts where none of them fits: three are named."""
    notice = Notice("nothing_fits", "no last fits this foot")
    return replace(
        match, candidates=(), nearest=match.candidates[:3], warnings=(*match.warnings, notice)
    )


def tied(match: Match) -> Match:
    """Lasts that the distance does not tell apart, one of them from four others."""
    names = [candidate.last for candidate in match.candidates]
    ties = [tuple(names[1:5]), (names[0],), (names[0], names[3]), (names[2], names[0]), ()]
    lasts = zip(match.candidates, ties, strict=False)
    return replace(match, candidates=tuple(replace(one, tied_with=tie) for one, tie in lasts))


CASES = {
    "one foot": planted(),
    "a pair": planted(2),
    "a pair that differs by a notice": planted(
        2, warnings=(Notice("pair_difference", "the feet differ by 2.9 mm"),)
    ),
    "one last": planted(lasts=1),
    "nothing fits": as_nearest(planted()),
    "nothing fits a pair": as_nearest(planted(2)),
    "nothing is near": replace(as_nearest(planted()), nearest=(), rejected=()),
    "ties": tied(planted()),
    "ties of a pair": tied(planted(2)),
    "by flare": planted(judged=False, by="flare"),
    "by shape": planted(judged=False, by="shape", rejected=(), reference=None),
    "UK sizes": planted(size_system="uk"),
    "no surface was asked for": replace(
        planted(), candidates=tuple(replace(c, surfaces=()) for c in planted().candidates)
    ),
}


@pytest.fixture(params=list(CASES))
def match(request: pytest.FixtureRequest) -> Match:
    """Each kind of answer."""
    return CASES[request.param]


# ------------------------------------------------------------------ what they show


def test_the_page_shows_the_match(match: Match) -> None:
    reading = readers.read_match_page(match_page(match))
    assert problems(PAGE, reading, match_facts(match)) == []


def test_the_csv_shows_the_match(match: Match) -> None:
    assert problems(CSV, readers.read_match_csv(csv_text(Match, [match])), match_facts(match)) == []


def test_the_terminal_shows_the_match(match: Match) -> None:
    reading = readers.read_match_terminal(terminal_text(match_table(match), WIDE))
    assert problems(TERMINAL, reading, match_facts(match)) == []


@pytest.mark.parametrize("pair", [False, True])
def test_the_page_shows_the_room_in_the_best_last(pair: bool) -> None:
    match = planted(1 + pair)
    rooms = [comparison(True, True, "l.stl"), moved(comparison(path="r.stl"))][1 - pair :]
    reading = readers.read_match_page(match_page(match, None, rooms))
    assert problems(PAGE, reading, match_facts(match, rooms)) == []


def moved(known: Comparison) -> Comparison:
    """A comparison whose every number differs from the one it is made from."""
    steps = count(1)
    zones = tuple(
        replace(
            zone,
            mean_mm=zone.mean_mm + 0.3 * step,
            p05_mm=zone.p05_mm - 0.2 * step,
            p95_mm=zone.p95_mm + 0.7 * step,
            area_cm2=zone.area_cm2 + 30.0 * step,
            tight_cm2=zone.tight_cm2 + 2.0 * step,
            pressed_cm2=zone.pressed_cm2 + 13.7 * step,
            loose_cm2=zone.loose_cm2 + 3.0 * step,
        )
        for zone, step in zip(known.zones, steps, strict=False)
    )
    empty = ZoneClearance("toe", None, None, None, 0.0, 0.0, 0.0)
    return replace(
        known,
        zones=(*zones[:-1], empty),
        placement=replace(known.placement, swing_mm=2.34),
        warnings=(Notice("toes_apart", "the toes are 3 mm apart"),),
    )


COMPARISONS = {
    "right in right": lambda: comparison(path="r.stl"),
    "left in right": lambda: comparison(True, False, "l.stl"),
    "moved": lambda: moved(comparison(path="r.stl")),
    "in a heel": lambda: heeled(comparison(path="r.stl"), 47.3, length_only=False),
    "in a heel too high": lambda: heeled(comparison(path="r.stl"), 112.4, length_only=True),
    "as scanned": lambda: replace(comparison(path="r.stl"), heel=None),
    "no toe room": lambda: replace(
        comparison(path="r.stl"), toe_room=Measured(None, None, "the toes are open")
    ),
}


def heeled(known: Comparison, drop_mm: float, *, length_only: bool) -> Comparison:
    """A comparison with a last that has a heel; no two numbers are alike."""
    values = {"length": -2.27, "ball_width": -0.83, "ball_girth": 1.19, "flare_angle": 1.61}
    sds = iter((1.7, 1.1, 2.3, 0.9))
    changes = tuple((name, Measured(value, next(sds))) for name, value in values.items())
    heel = HeelChange(drop_mm, 3.3, "flat-to-heel/1", 0.57, True, length_only, changes)
    return replace(known, heel=heel, toe_room=Measured(12.61, 1.74))


@pytest.mark.parametrize("name", list(COMPARISONS))
def test_the_outputs_show_the_comparison(name: str) -> None:
    known = COMPARISONS[name]()
    facts = list(comparison_facts(known))
    page = readers.read_compare_page(compare_page(known))
    assert problems(PAGE, page, facts) == []
    table = readers.read_compare_terminal(terminal_text(compare_table(known), WIDE))
    assert problems(TERMINAL, table, facts) == []
    cells = readers.read_keyed_csv(csv_text(Comparison, [known]), "part", "place", "quantity")
    assert problems(CSV, cells, facts) == []


# ------------------------------------------------------------------ as the command line makes them


@pytest.mark.parametrize("pair", [False, True], ids=["one foot", "a pair"])
def test_the_command_writes_what_the_search_answered(
    footfit: Footfit,
    catalogue: Path,
    tmp_path: Path,
    pair: bool,
) -> None:
    damage(catalogue)
    feet = [str(path) for path in sorted((SAMPLES / "feet").iterdir())[: 1 + pair]]
    question = Question(surfaces_in=catalogue)
    sources = [Source(path) for path in feet]
    customers = one_pair(sources) if pair else alone(sources)
    library = choice(catalogue, None, None)
    (outcome,) = matches(customers, ReadingOptions(), library, question)
    match = outcome.value
    assert match is not None
    assert "damaged_last" in [notice.code for notice in match.warnings]
    page, rows = tmp_path / "page.html", tmp_path / "rows.csv"
    command = ("match", *feet, *["--pair"] * pair, "--catalogue", catalogue, "--clearance")
    run = footfit(*command, "--html", page, "--csv", rows)
    assert run.code == 0
    facts = list(match_facts(match, best_comparisons(catalogue, match)))
    assert problems(PAGE, readers.read_match_page(page.read_text("utf-8")), facts) == []
    assert problems(CSV, readers.read_match_csv(rows.read_text("utf-8")), facts) == []
    assert run.out == terminal_text(match_table(match))


def damage(catalogue: Path) -> None:
    """One last whose length is not what was stored."""
    with closing(sqlite3.connect(catalogue)) as connection, connection:
        connection.execute("UPDATE frame SET length_mm = 262.5 WHERE last_id = 2")


# ------------------------------------------------------------------ the harness itself


@pytest.mark.parametrize(
    ("text", "values", "shown"),
    [
        ("260.0 ± 0.4 mm", ("260.0", "0.4"), True),
        ("260.0 ± 0.4 mm", ("0.4", "260.0"), False),
        ("260.0 ± 0.4 mm", ("260.0",), False),
        ("260.0 mm", ("60.0",), False),
        ("-3.2 mm", ("3.2",), False),
        ("+13.5 ● (good)", ("+13.5", "● (good)"), True),
        ("+13.52 ● (good)", ("+13.5", "● (good)"), False),
        ("derby-42, EU 42", ("derby-42", "EU 42"), True),
        ("derby-42, EU 42, 7", ("derby-42", "EU 42"), False),
    ],
)
def test_a_text_holds_its_values_in_order_and_no_other_number(text, values, shown) -> None:
    assert holds(text, values) == shown


def test_what_is_missing_wrong_or_too_much_is_a_problem() -> None:
    facts = [fact("room", "+3.2", PAGE), fact("said so", "7", PAGE), fact("row", "9", CSV)]
    sound = Reading({"room": "+3.2 mm"}, ["after 7 days", "words"])
    assert problems(PAGE, sound, facts) == []
    for bad in (
        Reading({}, sound.said),
        Reading({"room": "+3.1 mm"}, sound.said),
        Reading(sound.cells, ["words"]),
        Reading(sound.cells, [*sound.said, "and 8 more"]),
        Reading(sound.cells | {"width": "4"}, sound.said),
    ):
        assert len(problems(PAGE, bad, facts)) == 1
    assert problems(CSV, Reading({"row": "9 "}), facts) != []


def test_a_planted_answer_has_no_two_numbers_alike() -> None:
    match = planted(2)
    clearances = [
        zone.clearance.value
        for candidate in match.candidates
        for fit in candidate.fits
        for zone in fit.zones
        if zone.clearance.value is not None
    ]
    assert len({round(value, 1) for value in clearances}) == len(clearances)
