"""A base that is refused: the message names what is out of reach, and says what to do."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from footfit.api.inputs import source_of
from footfit.errors import OutOfReach
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.last_making.base_last import scanned_base
from footfit.pipeline.last_making.custom import base_choice
from footfit.pipeline.last_making.custom.custom_aims import CustomAim, CustomQuestion
from footfit.pipeline.last_making.custom.custom_making import Making, begun
from footfit.pipeline.last_making.custom.custom_tries import Given
from footfit.pipeline.last_making.custom.out_of_reach import reason
from footfit.results.heel import AS_SCANNED
from footfit.results.worn import BAREFOOT
from tests.test_pipeline_customise import base, foot

MAKING = Making(CustomQuestion(fit_profile("walking"), AS_SCANNED, BAREFOOT))


@cache
def beginning() -> tuple[Given, tuple[CustomAim, ...]]:
    """The test's base on a coarse mesh, and the aims of the foot in it."""
    file = source_of(encoded_mesh(*base(), "stl"), {})
    return begun(foot(), scanned_base(file, ReadingOptions(units="mm")), MAKING)


def moved(**more_mm: float) -> list[CustomAim]:
    """The aims, some of which are to be so much more than the base has."""
    return [
        replace(aim, target=aim.base + more_mm[aim.measure]) if aim.measure in more_mm else aim
        for aim in beginning()[1]
    ]


def test_two_targets_that_pull_against_each_other_are_named_with_their_figures() -> None:
    given, _ = beginning()
    asked = moved(ball_girth_least=-6.0, ball_width=8.0)
    has = {aim.measure: f"{aim.base:.1f}" for aim in asked}
    girth, width = has["ball_girth_least"], has["ball_width"]
    words = reason(given, asked)
    assert words is not None
    assert words.startswith("the least ball girth and ball width are out of reach")
    assert "together (each alone can be met)" in words
    assert f"it has {girth} and {width} mm, not " in words
    assert reason(given, moved(ball_girth_least=-6.0)) is None


def test_a_target_that_changes_nothing_is_not_named() -> None:
    """Ball and waist cannot be met together, with the instep or without it."""
    given, _ = beginning()
    words = reason(given, moved(ball_girth_least=-6, waist_girth_least=5, instep_girth_least=16))
    assert words is not None
    assert words.startswith("the least ball girth and least waist girth are out of reach")


def test_a_target_that_is_out_of_reach_alone_is_named_alone() -> None:
    given, _ = beginning()
    words = reason(given, moved(instep_girth_least=45.0, ball_girth_least=-6.0))
    assert words is not None
    assert words.startswith("the least instep girth is out of reach of this base, which has 222.")


def test_targets_that_a_search_meets_give_no_reason() -> None:
    assert reason(*beginning()) is None


def test_a_refusal_without_a_better_base_says_what_to_do(monkeypatch) -> None:
    given, aims = beginning()

    def refused(*_: object) -> None:
        raise OutOfReach("the least ball girth is out of reach")

    monkeypatch.setattr(base_choice, "customised", refused)
    monkeypatch.setattr(base_choice, "begun", lambda *_: (given, aims))
    with pytest.raises(OutOfReach, match=r"; give another --base, of another size or width, or"):
        base_choice.customised_from(foot(), given.base, MAKING, None)
    monkeypatch.setattr(base_choice, "_better_base", lambda *_: None)
    with pytest.raises(OutOfReach, match=r"match best cannot be .*: give another --profile, or"):
        base_choice.customised_from(foot(), given.base, MAKING, "there")  # type: ignore[arg-type]
