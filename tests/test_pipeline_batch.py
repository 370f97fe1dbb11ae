"""A batch: in order, whatever the number of processes; one failure stops nothing."""

from __future__ import annotations

import pytest

from footfit.errors import DamagedMesh, NotAFoot
from footfit.pipeline.batch import outcomes
from footfit.pipeline.sources import Source


def length_of_name(source: Source) -> int:
    assert source.path is not None
    if "bad" in source.path:
        raise DamagedMesh("is damaged")
    if "odd" in source.path:
        raise NotAFoot("is no foot", "named already")
    if "bug" in source.path:
        raise ValueError(source.path)
    return len(source.path)


ITEMS = [Source(name) for name in ("a", "bad", "ccc", "odd", "eeeee", "ffffff")]


@pytest.mark.parametrize("jobs", [1, 2])
def test_order_values_and_errors_do_not_depend_on_the_jobs(jobs: int) -> None:
    found = list(outcomes(length_of_name, ITEMS, jobs))
    assert [outcome.item for outcome in found] == ITEMS
    assert [outcome.value for outcome in found] == [1, None, 3, None, 5, 6]
    assert [type(outcome.error) for outcome in found if outcome.error] == [DamagedMesh, NotAFoot]


def test_an_error_names_its_file_unless_it_named_one() -> None:
    errors = [outcome.error for outcome in outcomes(length_of_name, ITEMS) if outcome.error]
    assert [error.path for error in errors] == ["bad", "named already"]


def test_a_bug_is_raised_and_not_hidden_among_the_failures() -> None:
    with pytest.raises(ValueError, match="bug"):
        list(outcomes(length_of_name, [Source("a"), Source("bug")]))
