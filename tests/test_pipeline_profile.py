"""Fit profiles: the shipped ones hold, the user's are checked in words, the hash is of values."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import BadOption, BadProfile, FootfitError, UnreadableFile
from footfit.pipeline.fit.fit_profile import FOLDER, NO_SOURCE, fit_profile, profile_of, shipped
from footfit.results.fit import GRADES

PLAIN = """
schema = "footfit.fit-profile/1"
name = "mine"
[zones.length]
target_mm = 13
good_mm = [10, 17]
acceptable_mm = [8, 20]
required = true
[zones.ball_girth]
target_mm = -2
good_mm = [-5, 0]
acceptable_mm = [-9, 4]
poor_mm = [-14, 9]
cavity_mm = 1.5
[zones.flare]
target_deg = 0
good_deg = [-9, 5]
acceptable_deg = [-13, 9]
weight = 0.5
"""


PUBLISHED = {  # target, good, acceptable
    "pump": {"length": (10, (7, 15), (5, 20)), "ball_girth": (-3, (-6, 0), (-9, 4))},
    "boot": {"length": (14, (11, 18), (9, 23)), "ball_width": (0, (-2, 3), (-4, 5))},
    "sandal": {"length": (6, (3, 11), (1, 15)), "ball_girth": (0, (-5, 6), (-9, 11))},
    "depth": {"length": (15, (10, 20), (9, 25)), "ball_girth": (4, (0, 9), (-3, 14))},
    "walking": {
        "length": (14, (10, 20), (8, 26)),
        "ball_girth": (0, (-4, 5), (-8, 10)),
        "ball_width": (1, (-2, 4), (-5, 7)),
        "instep_girth": (2, (-2, 6), (-5, 10)),
    },
    "dress": {
        "length": (13, (10, 17), (8, 22)),
        "ball_girth": (-2, (-5, 1), (-8, 5)),
        "ball_width": (-1, (-3, 2), (-5, 4)),
        "instep_girth": (1, (-3, 4), (-6, 7)),
    },
    "sport": {
        "length": (14, (10, 18), (8, 22)),
        "ball_girth": (1, (-4, 5), (-8, 9)),
        "ball_width": (0, (-3, 3), (-5, 5)),
        "instep_girth": (0, (-4, 4), (-7, 8)),
        "toe_height": (4, (2, 9), (0, 14)),
    },
    "safety": {
        "length": (15, (12, 20), (10, 25)),
        "ball_girth": (3, (0, 8), (-4, 12)),
        "ball_width": (2, (0, 5), (-3, 7)),
        "instep_girth": (3, (0, 7), (-4, 11)),
        "toe_height": (6, (4, 12), (2, 18)),
    },
    "child": {
        "length": (14, (12, 17), (9, 20)),
        "ball_girth": (2, (-2, 6), (-5, 10)),
        "ball_width": (2, (0, 6), (-3, 10)),
        "instep_girth": (2, (-2, 6), (-5, 10)),
        "toe_height": (4, (3, 9), (2, 14)),
    },
}
HEELS = {  # target and good of the heel width and of the short heel girth
    "pump": ((-3, (-4, -1)), None),
    "dress": ((-3, (-4, -1)), (-4, (-6, 0))),
    "walking": ((-2, (-4, 1)), (-2, (-6, 3))),
    "sport": ((-2, (-4, 0)), (-3, (-6, 2))),
    "safety": ((-1, (-3, 2)), (0, (-4, 5))),
    "boot": ((-2, (-4, 0)), (0, (-3, 3))),
    "sandal": ((0, (-2, 3)), None),
    "child": ((-1, (-3, 2)), (-2, (-6, 3))),
    "depth": ((0, (-2, 3)), (0, (-4, 5))),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_every_shipped_profile_asks_for_the_published_allowances(name: str) -> None:
    profile = fit_profile(name)
    assert profile.name == name
    rules = {rule.zone: rule for rule in profile.zones}
    for zone, asked in PUBLISHED[name].items():
        assert (rules[zone].target, rules[zone].good, rules[zone].acceptable) == asked, zone
    for zone, asked in zip(("heel_width", "short_heel_girth"), HEELS[name], strict=True):
        rule = rules.get(zone)
        assert (None if rule is None else (rule.target, rule.good)) == asked, zone
    assert rules["length"].poor == rules["length"].acceptable, "a last 60 mm off never ranks"
    assert rules["ball_line"].poor is not None
    assert {"flare", "plan"} <= set(rules)
    assert ("toes" in rules) == (name != "sandal")
    assert ("instep_girth" in rules) == (name not in ("pump", "sandal"))


def test_nine_profiles_are_shipped_each_with_another_hash() -> None:
    assert set(shipped()) == set(PUBLISHED)
    assert len({fit_profile(name).sha256 for name in shipped()}) == 9


def test_a_name_is_known_in_any_case() -> None:
    assert fit_profile("Walking") == fit_profile("WALKING") == fit_profile("walking")


@pytest.mark.parametrize("name", PUBLISHED)
def test_every_range_of_a_shipped_profile_has_a_source(name: str) -> None:
    for rule in fit_profile(name).zones:
        assert rule.grade in GRADES
        assert len(rule.source) > 8, rule.zone
        assert rule.source != NO_SOURCE


def test_a_grade_that_is_none_is_refused() -> None:
    with pytest.raises(BadProfile, match="trade rule"):
        profile_of(PLAIN.replace("required = true", 'required = true\ngrade = "D"'))


def test_the_users_own_profile_is_read_from_its_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(PLAIN, encoding="utf-8")
    profile = fit_profile(str(path))
    assert [rule.zone for rule in profile.zones] == ["length", "ball_girth", "flare"]
    length, girth, flare = profile.zones
    assert length.poor == length.acceptable, "the length is a gate"
    assert (girth.poor, girth.cavity) == ((-14, 9), 1.5)
    assert (flare.poor, flare.weight) == (None, 0.5)


def test_the_hash_is_of_the_values_and_not_of_the_text() -> None:
    plain = profile_of(PLAIN)
    assert profile_of("# a comment\n" + PLAIN.replace("= 13\n", "= 13.0\n")).sha256 == plain.sha256
    assert profile_of(PLAIN.replace("= 13\n", "= 14\n")).sha256 != plain.sha256


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("good_mm = [10, 17]", "god_mm = [10, 17]", "did you mean good_mm"),
        ("[zones.ball_girth]", "[zones.bal_girth]", "no zone; the zones are length, ball_line"),
        ("target_deg = 0", "target_mm = 0", "unknown key 'target_mm'; did you mean target_deg"),
        ("good_mm = [10, 17]", "good_mm = [17, 10]", "must rise"),
        ("good_mm = [10, 17]", 'good_mm = "10-17"', "two numbers"),
        ("good_mm = [10, 17]", "good_mm = [10, 17, 18]", "two numbers"),
        ("good_mm = [10, 17]", "good_mm = [14, 17]", "does not hold its target"),
        ("acceptable_mm = [8, 20]", "acceptable_mm = [11, 20]", "does not hold its good range"),
        ("poor_mm = [-14, 9]", "poor_mm = [-8, 9]", "does not hold its acceptable range"),
        ("target_mm = 13", 'target_mm = "13"', "must be a number"),
        ("target_mm = 13", "target_mm = nan", "must be a number"),
        ("target_mm = 13", "target_mm = true", "must be a number"),
        ("weight = 0.5", "weight = -1", "between 0 and 100"),
        ("required = true", "required = 1", "true or false"),
        ("required = true", "weight = 0", "always judged"),
        ("[zones.length]", "[zones.heel_width]", "the length is always judged"),
        ('name = "mine"', "", "name must be"),
        ('name = "mine"', 'name = "mine"\nversion = "a"', "whole number"),
        ('name = "mine"', 'name = "mine"\ntie_sds = 99', "between 0 and 10"),
        ('name = "mine"', 'name = "mine"\ncolour = 1', "unknown key 'colour'"),
        ("footfit.fit-profile/1", "footfit.fit-profile/9", "schema must be"),
        ("[zones.length]", "[zones.length", "not valid TOML"),
        (PLAIN.split("name", maxsplit=1)[1], '= "x"', "no [zones.NAME] table"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(old: str, new: str, words: str) -> None:
    assert old in PLAIN
    with pytest.raises(BadProfile) as caught:
        profile_of(PLAIN.replace(old, new, 1), "mine.toml")
    assert words in caught.value.message
    assert "\n" not in caught.value.message
    assert caught.value.path == "mine.toml"


def test_a_name_that_is_not_there_lists_those_that_are() -> None:
    with pytest.raises(BadOption, match="boot, child, depth, dress, pump"):
        fit_profile("disco")


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnreadableFile):
        fit_profile(str(tmp_path / "none.toml"))
    folder = tmp_path / "folder.toml"
    folder.mkdir()
    with pytest.raises(UnreadableFile):
        fit_profile(str(folder))
    for name, data in (("bytes.toml", b"\xff\xfe\x00"), ("large.toml", b"#" * 200_000)):
        path = tmp_path / name
        path.write_bytes(data)
        with pytest.raises(BadProfile):
            fit_profile(str(path))


@given(st.data())
@settings(deadline=None, max_examples=150)
def test_no_text_breaks_the_reader(data: st.DataObject) -> None:
    """Shipped text with pieces cut out, doubled or replaced: a profile, or a line of words."""
    text = (FOLDER / "walking.toml").read_text(encoding="utf-8")
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(len(text), start + 60)))
    text = text[:start] + data.draw(st.text(max_size=8) | st.just("[[" * 40)) + text[end:]
    message = ""
    try:
        profile_of(text)
    except FootfitError as error:
        message = error.message
    assert "\n" not in message
