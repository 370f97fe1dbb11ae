"""What the coverage of a population must obey, whatever the feet and the lasts are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from benchmarks import coverage as coverage_benchmark
from footfit.pipeline.population.cover import (
    counts,
    greedy_cover,
    served_by_any,
    served_once,
    spare_rows,
)
from footfit.results.population.shares import Share
from tests.people import answer, last_for, sizes, write_csv

seeds = st.integers(0, 2**20)
FEET = 40
plain = settings(
    deadline=None,
    max_examples=15,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


def served(found) -> tuple[int, int]:
    return found.served.good.count, found.served.acceptable.count


@pytest.fixture(scope="module")
def people(tmp_path_factory) -> Path:
    return write_csv(tmp_path_factory.mktemp("people") / "feet.csv", sizes(FEET))


def test_without_lasts_nobody_is_served(people: Path) -> None:
    found = answer(people, [])
    assert (found.judged, served(found)) == (FEET, (0, 0))
    assert found.served.acceptable.value == 0.0
    assert found.next_lasts[0].gain > 0
    assert {row["status"] for row in found.feet.rows()} == {"no_last_fits"}


def test_a_last_for_each_foot_serves_all(people: Path) -> None:
    found = answer(people, [last_for(f"l{i}", foot) for i, foot in enumerate(sizes(FEET))])
    assert served(found) == (FEET, FEET)
    assert found.next_lasts == ()
    assert [zone.zone for zone in found.zones if zone.judged and zone.counts] == [
        "length",
        "ball_girth",
        "ball_width",
        "instep_girth",
        "heel_width",
    ]


@given(seeds, st.integers(1, 12))
@plain
def test_another_last_never_lowers_a_share(people: Path, seed: int, count: int) -> None:
    lasts = [last_for(f"l{i}", foot) for i, foot in enumerate(sizes(count, seed))]
    without, with_it = answer(people, lasts[:-1]), answer(people, lasts)
    assert served(without)[0] <= served(with_it)[0]
    assert served(without)[1] <= served(with_it)[1]
    for before, after in zip(without.zones, with_it.zones, strict=True):
        assert before.alone.acceptable.count <= after.alone.acceptable.count
        assert before.with_length.good.count <= after.with_length.good.count


@given(seeds, st.integers(1, 12))
@plain
def test_gains_never_rise_and_add_up(people: Path, seed: int, count: int) -> None:
    lasts = [last_for(f"l{i}", foot) for i, foot in enumerate(sizes(count, seed))]
    found = answer(people, lasts, most_next=50)
    gains = [step.gain for step in found.cover]
    assert gains == sorted(gains, reverse=True)
    assert sum(gains) == found.served.acceptable.count
    planned = [last.gain for last in found.next_lasts]
    assert planned == sorted(planned, reverse=True)
    covered = found.served.acceptable.count
    for last in found.next_lasts:
        covered += last.gain
        assert last.covered.count == covered
        assert covered / FEET <= last.covered_at_most + 1e-9 <= 1.0 + 1e-9


@given(seeds, st.randoms(use_true_random=False))
@plain
def test_the_order_of_feet_and_lasts_does_not_matter(
    people: Path, tmp_path: Path, seed: int, random
) -> None:
    rows, lasts = sizes(FEET), [last_for(f"l{i}", f) for i, f in enumerate(sizes(8, seed))]
    order, others = list(range(FEET)), list(lasts)
    random.shuffle(order)
    random.shuffle(others)
    ids = [f"p{place}" for place in order]
    shuffled = write_csv(tmp_path / "feet.csv", rows[order], ids)
    first, second = answer(people, lasts).to_dict(), answer(shuffled, others).to_dict()
    for document in (first, second):
        document["feet"].sort(key=lambda row: row["id"])
        for last in document["lasts"]:
            last["only_feet"].sort()
    assert first == second


def test_each_last_says_whom_only_it_serves_and_which_could_go(people: Path) -> None:
    feet = sizes(FEET)[:6]  # of the people: each last serves one of them at least
    lasts = [last_for(f"l{i}", foot) for i, foot in enumerate(feet)]
    lasts.append(last_for("copy", feet[0]))
    found = answer(people, lasts)
    by_name = {last.last: last for last in found.library}
    assert by_name["copy"].acceptable == by_name["l0"].acceptable > 0
    assert by_name["copy"].only == by_name["l0"].only == 0
    for last in found.library:
        without = answer(people, [r for r in lasts if r.labels.name != last.last])
        lost = found.served.acceptable.count - without.served.acceptable.count
        assert lost == last.only == len(last.only_feet)
        assert not (last.only and last.could_go)
    rest = answer(people, [r for r in lasts if r.labels.name not in found.could_go])
    assert 0 < len(found.could_go) < len(lasts)
    assert rest.served.acceptable.count == found.served.acceptable.count
    assert rest.served.good.count == found.good_if_gone


def test_a_foot_without_a_required_measure_is_not_passed(tmp_path: Path) -> None:
    rows = sizes(4)
    rows[0, 1] = np.nan
    found = answer(write_csv(tmp_path / "feet.csv", rows), [last_for("l0", sizes(4)[0])])
    assert (found.judged, dict(found.not_judged)) == (3, {"no ball girth": 1})
    row = found.feet.rows()[0]
    assert (row["status"], row["reason"]) == ("not_judged", "no ball girth")
    assert {notice.code for notice in found.warnings} == {"feet_not_judged", "few_feet"}


@given(st.integers(1, 9), st.integers(1, 30), seeds, st.floats(0.05, 0.6))
@plain
def test_sets_of_bits_are_sets(rows: int, feet: int, seed: int, share: float) -> None:
    sets = np.random.default_rng(seed).random((rows, feet)) < share
    bits = np.packbits(sets, axis=1)
    assert counts(bits).tolist() == sets.sum(axis=1).tolist()
    assert served_by_any(bits, feet).tolist() == sets.any(axis=0).tolist()
    assert served_once(bits, feet).tolist() == (sets.sum(axis=0) == 1).tolist()
    kept = sets[~spare_rows(bits)]
    assert kept.any(axis=0).tolist() == sets.any(axis=0).tolist()
    assert all(
        not np.delete(kept, row, axis=0).any(axis=0)[kept[row]].all() for row in range(len(kept))
    )
    cover = greedy_cover(bits, np.packbits(np.ones(feet, dtype=bool)))
    assert sets[cover.rows].any(axis=0).tolist() == sets.any(axis=0).tolist()
    best = brute_force(sets, len(cover.rows))
    assert (np.cumsum(cover.gains) <= best).all()
    assert (best <= cover.most).all()
    assert (np.cumsum(cover.gains) >= 0.632 * best).all()


def brute_force(sets: np.ndarray, most: int) -> np.ndarray:
    """The most feet that any choice of 1, 2 ... rows serves."""
    from itertools import combinations

    return np.array(
        [
            max(sets[list(rows)].any(axis=0).sum() for rows in combinations(range(len(sets)), k))
            for k in range(1, most + 1)
        ],
        dtype=int,
    )


def test_an_interval_is_that_of_wilson() -> None:
    """Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29."""
    known = {(81, 263): (0.2553, 0.3662), (15, 148): (0.0624, 0.1605)}
    known |= {(0, 20): (0.0, 0.1611), (1, 29): (0.0061, 0.1718)}
    for (count, of), ends in known.items():
        share = Share(count, of)
        assert (share.low, share.high) == pytest.approx(ends, abs=5e-5)


def test_a_run_serves_the_closed_form_of_a_normal_population() -> None:
    """At most 0.1 points off for evenly drawn feet; benchmarks/coverage.py draws 10^6."""
    feet = coverage_benchmark.draws(even=True, base2=15)
    for sizes_made, widths in ((range(1, 12), 1), (range(5, 8), 3)):
        half_mm = 0.5 * widths * coverage_benchmark.GIRTH_MM
        line = np.array([228.1, 0.606 * 11.8 / 12.4])
        lasts = coverage_benchmark.run_of(list(sizes_made), "ball_girth", line, 1)
        box = {"length": 0.5 * coverage_benchmark.SIZE_MM + 1e-3, "ball_girth": half_mm}
        share = coverage_benchmark.share_served(feet, lasts, coverage_benchmark.boxes(box))
        known = coverage_benchmark.closed_form(list(sizes_made), half_mm, 1)
        assert share == pytest.approx(known, abs=0.1)
    assert coverage_benchmark.closed_form(range(1, 12), 3.25, 0) == pytest.approx(27.1, abs=0.05)
    assert coverage_benchmark.closed_form(range(5, 8), 9.75, 0) == pytest.approx(48.7, abs=0.05)
