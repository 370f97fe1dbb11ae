"""The JSON documents: keys as docs/json.md lists them, numbers rounded, one line of UTF-8 each."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit import __version__
from footfit.errors import SeveralFeet
from footfit.geometry.fit.laid_bottoms import LaidBottom
from footfit.geometry.fit.surface_difference import (
    LargestDifference,
    SurfaceDifference,
    ZoneDifference,
)
from footfit.geometry.pose.paper_frame import paper_frame_angle_deg
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.match import matched
from footfit.pipeline.graded_runs.grading_rules import grading_rule
from footfit.report.json import json_line
from footfit.results import (
    BackupOutcome,
    CheckOutcome,
    CopyOutcome,
    DemoOutcome,
    Drawing,
    EditOutcome,
    ExportOutcome,
    Finding,
    GradedRun,
    Library,
    Measured,
    Notice,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    RestoreOutcome,
    RunCheck,
    StoredLast,
    UpgradeOutcome,
)
from footfit.results.evidence.fit_entries import FitList, ForgetOutcome, RecordOutcome
from footfit.results.evidence.fit_evidence import Calibration
from footfit.results.evidence.profiles import CheckedProfile, ProfileList, ShownProfile
from footfit.results.last_making.custom_last import BaseMesh
from footfit.results.last_making.last_difference import LastDifference
from footfit.results.population.checked_lasts import LastFinding, LastsCheck
from footfit.results.values import exact, json_number, part
from tests import answers, fits, people
from tests.bounds import ROUNDING, printed
from tests.comparisons import comparison
from tests.customs import custom_last

PAGE = Path(__file__).resolve().parents[1] / "docs" / "json.md"


FINDING = Finding(
    "last", "its stored numbers were changed: ingest it again with --replace", "derby-42"
)


LASTS_CHECK = LastsCheck(
    "a.footfit", 12, 1, (LastFinding("twin", "b", "is as 'a'", "a"),), {"girth": 2.0}
)


def every_document():
    """One document per schema, each with everything in it."""
    record = answers.record()
    upgrade = UpgradeOutcome("a.footfit", "0001", "0002", "flare/1", ("derby-42",), None)
    warned = answers.alignment(warnings=(Notice("open", "open"),), reference=answers.reference())
    results = [
        warned,
        answers.foot(),
        answers.match(),
        answers.measured_scan(),
        comparison(),
        answers.outcome(),
        answers.curvature(),
        SeveralFeet("two feet; take them apart", "a.stl"),
        Library((record,), 1, "derby-42"),
        StoredLast(record, "derby-42", 0.0),
        ReferenceOutcome(answers.reference(), 12),
        EditOutcome("a", (("size", "41", "42"),), ("heel_height",), 3.0),
        RenameOutcome("b", "a"),
        RemoveOutcome("a"),
        RecordOutcome(fits.entry(footfit_version=__version__)),
        FitList((fits.entry(),)),
        ForgetOutcome("w-1", 1),
        ProfileList((fit_profile(),)),
        ShownProfile(fit_profile(), {"length": "mm"}),
        CheckedProfile("a.toml", "a", 1, "0" * 64, ("length",), ()),
        Calibration(fit_profile(), fit_profile(), (), 0, {}),
        Drawing(answers.alignment(), (), (), (), {}, {}),
        GradedRun(
            *("derby-42", "0" * 64, "42", "G", "right", "derby", BaseMesh("file", 0.0), "eu"),
            *(grading_rule("eu"), ("heel",), ()),
        ),
        RunCheck(None, "arithmetic", 1.0, None, {"girth": 2.0}, (), (), ()),
        last_difference(),
        custom_last(),
        ExportOutcome("a", "a.stl", 10, 0.1),
        answers.facts(),
        upgrade,
        CheckOutcome("a.footfit", 12, 12, (FINDING,)),
        BackupOutcome("a.footfit", "b.footfit", 9, 12),
        CopyOutcome("a.footfit", "b.footfit", 12, 3),
        RestoreOutcome("a.footfit", "b.footfit", 12, None),
        people.small_answer(),
        LASTS_CHECK,
        DemoOutcome("demo", 12, "derby-42", ("report.html",)),
    ]
    return [result.to_dict() for result in results]


def last_difference():
    """Two lasts that are one, without a measure that both have."""
    drawn, shape = comparison(), answers.foot()
    zones = (ZoneDifference("toe", 0.1, 0.0, 0.2, 9.0),)
    largest = LargestDifference(0.3, (1.0, 2.0, 3.0), "toe", 0.9)
    surface = SurfaceDifference(np.zeros(1), 0.1, 0.2, largest, zones)
    laid = LaidBottom(np.eye(4), 0.0, 1.0)
    tolerance = {"girth": 2.0}
    return LastDifference(shape, shape, False, laid, tolerance, (), surface, (), 0.0, (), drawn)


def listed_keys():
    """Heading to the keys in the first column of the table under it."""
    found: dict[str, set[str]] = {}
    heading = ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            heading = line.lstrip("# ")
        elif line.startswith("| `"):
            keys = re.findall(r"`([^`]+)`", line.split("|")[1])
            found.setdefault(heading, set()).update(keys)
    return found


COMMON = {"schema", "footfit_version"}


def test_the_page_lists_the_keys_of_every_document() -> None:
    listed = listed_keys()
    schemas = {answer["schema"] for answer in every_document()}
    assert schemas == {heading for heading in listed if heading.startswith("footfit.")}
    for answer in every_document():
        assert set(answer) - COMMON == listed[answer["schema"]], answer["schema"]
        assert answer["footfit_version"] == __version__


def test_the_page_lists_the_keys_of_every_part() -> None:
    listed = listed_keys()
    align, flare, match = every_document()[:3]
    foot, candidate = match["feet"][0], match["candidates"][0]
    assert set(align["mesh"]) == listed["mesh"]
    assert set(align["side_confidence"]) == listed["side_confidence"]
    assert set(align["pose"]) == listed["pose"]
    assert set(align["warnings"][0]) == listed["warning"]
    assert set(foot["flare"]) == listed["flare profile"] <= set(flare)
    assert set(foot) == listed["foot"]
    assert set(candidate) == listed["candidate"]
    (room,) = answers.roomy_candidate().to_dict()["surface_clearance"]
    assert set(room) == listed["surface clearance"]
    assert set(room["zones"]["medial"]) == listed["zone clearance"]
    assert set(candidate["clearance_mm"]["length"]) == listed["measured value"]
    lasts = Library((answers.record(),), 1, None).to_dict()["lasts"]
    assert set(lasts[0]) == listed["last"]
    assert set(lasts[0]["label_check"]) == listed["label_check"]
    shown = StoredLast(answers.record(), None).to_dict()
    assert set(shown["printed_frame"]) == listed["printed_frame"] <= set(align)


def test_the_page_lists_the_keys_of_a_fit() -> None:
    listed = listed_keys()
    answer = matched([answers.foot()], Library((answers.record(),), 1, None))
    match = answer.to_dict()
    fit = match["candidates"][0]["fits"][0]
    assert set(fit) == listed["fit"]
    assert {key for zone in fit["zones"].values() for key in zone} == listed["zone"]
    assert {key for size in match["feet"][0]["sizes"].values() for key in size} == listed["size"]
    rules = match["fit_profile"]["zones"]
    assert set(match["fit_profile"]) == listed["fit profile"]
    assert {key for rule in rules.values() for key in rule} == listed["rule"]
    assert list(rules) == list(fit["zones"])
    json_line(match)
    checked = CheckOutcome("a.footfit", 1, 1, (FINDING,)).to_dict()
    assert set(checked["findings"][0]) == listed["finding"]


def test_the_page_lists_the_keys_of_a_comparison() -> None:
    listed, document = listed_keys(), comparison().to_dict()
    assert {key for zone in document["zones"].values() for key in zone} == listed["zone clearance"]
    section = document["sections"][0]
    assert set(section) == listed["section"]
    assert set(section["sizes"]["width"]) == listed["size difference"]
    assert set(section["sizes"]["width"]["foot"]) == listed["measured value"]


def test_the_page_lists_the_keys_of_a_coverage() -> None:
    listed, document = listed_keys(), people.small_answer().to_dict()
    share = {"count", "of", "share", "low", "high"}
    assert set(document["good"]) == listed["share"] == share
    assert set(document["zones"][0]) == listed["served zone"]
    assert set(document["zones"][0]["alone"]) == {"good", "acceptable"}
    assert set(document["lasts"][0]) == listed["served last"]
    assert set(document["next_lasts"][0]) == listed["next last"]
    measures = {f"{name}_mm" for name in people.NAMES}
    assert set(document["feet"][0]) - measures == listed["judged foot"]
    assert set(LASTS_CHECK.to_dict()["findings"][0]) == listed["last finding"]
    json_line(document)


def test_an_error_is_said_without_the_heavy_libraries() -> None:
    code = (
        "import sys; from footfit.errors import SeveralFeet;"
        "from footfit.report.json import json_line; json_line(SeveralFeet('x', None).to_dict());"
        "print(sorted({'numpy', 'rich', 'matplotlib', 'scipy'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_every_document_is_one_line_that_reads_back() -> None:
    for answer in every_document():
        line = json_line(answer)
        assert len(line.splitlines()) == 1
        assert json.loads(line) == answer
        assert list(json.loads(line)) == sorted(answer)


def numbers(value):
    """Every number of a document."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for item in value for number in numbers(item)]
    return [value] if isinstance(value, float) else []


def test_no_number_has_more_digits_than_it_means() -> None:
    for answer in every_document():
        answer.pop("definition", None)
        for foot in answer.get("feet", []):
            foot.get("flare", {}).pop("definition", None)
        for number in numbers(answer):
            assert number == round(number, 6)
            assert math.copysign(1.0, number) > 0 or number < 0
    align = every_document()[0]
    assert align["length_mm"] == round(align["length_mm"], 3)
    assert align["centroid_mm"] == [round(x, 3) for x in align["centroid_mm"]]


def test_what_is_not_measured_is_null_with_a_reason() -> None:
    match = answers.match().to_dict()
    clearance = match["candidates"][0]["clearance_mm"]
    assert clearance["length"]["reason"] is None
    assert clearance["length"]["value"] == pytest.approx(11.5)
    for name in ("ball_width", "ball_girth", "heel_width", "instep_girth"):
        assert clearance[name]["value"] is None
        assert clearance[name]["reason"]
    spoilt = replace(answers.foot(), flare=answers.profile(spoilt=("bottom_surface",)))
    flare = spoilt.to_dict()
    assert flare["curvature"]["bottom_surface"] is None
    assert len(flare["curvature"]["plan"]) == len(flare["stations"])


def test_a_measured_nan_becomes_a_reason() -> None:
    feet = (answers.foot(),)
    last = answers.record()
    nan = replace(answers.candidate(1, last), clearance_mm=(("length", Measured(float("nan"))),))
    match = answers.match(feet, candidates=(nan,)).to_dict()
    assert match["candidates"][0]["clearance_mm"]["length"]["value"] is None
    assert match["candidates"][0]["clearance_mm"]["length"]["reason"] == "not measured"
    json_line(match)


def test_the_transform_takes_the_file_to_the_frame() -> None:
    alignment = answers.alignment()
    document, frame = alignment.to_dict(), alignment.eigenframe
    assert np.allclose(document["transform"], alignment.transform, rtol=0, atol=printed(6))
    assert np.allclose(document["eigenvectors"], frame.eigenvectors, rtol=0, atol=printed(6))
    paired = document["row_eigenvalues_mm2"]
    assert np.allclose(paired, frame.eigenvalues_mm2, rtol=0, atol=printed(3))
    assert paired != sorted(paired, reverse=True) == document["eigenvalues_mm2"]


def test_only_a_label_that_is_off_its_length_has_words() -> None:
    near, off = (
        answers.record(size="42", length_mm=length_mm).entry(None)["label_check"]
        for length_mm in (280.0, 260.0)
    )
    assert (near["flagged"], near["words"]) == (False, None)
    assert off["flagged"]
    assert off["words"].endswith("it is EU 39 by its length")


def test_rejected_lasts_are_counted_by_reason() -> None:
    match = answers.match().to_dict()
    assert match["rejected"] == {"count": 7, "by_reason": {"too_long": 3, "too_short": 4}}


def test_a_curvature_counts_only_vertices_that_have_one() -> None:
    curvature = answers.curvature()
    document = curvature.to_dict()
    assert document["defined_vertices"] == len(curvature.mean) - 5
    spread = document["mean_per_mm"]
    assert spread["p05"] < spread["p50"] < spread["p95"]
    nothing = replace(curvature, k1=np.full_like(curvature.k1, np.nan))
    assert nothing.to_dict()["k1_per_mm"]["p50"] is None


@given(st.text(max_size=40))
@settings(deadline=None, max_examples=200)
def test_any_name_gives_one_line_of_utf8_that_reads_back(name: str) -> None:
    line = json_line(RemoveOutcome(name).to_dict())
    assert len(line.splitlines()) == 1
    assert json.loads(line.encode("utf-8"))["last"] == name


def test_a_file_name_that_is_no_text_reads_back() -> None:
    name = b"f\xfc\xdf.stl".decode("utf-8", "surrogateescape")
    line = json_line({"path": name})
    assert json.loads(line.encode("utf-8"))["path"] == name


def test_a_number_is_rounded_by_the_unit_that_its_key_names() -> None:
    value = 1.23456789
    keys = ("x_mm", "x_deg", "x_mm2", "x_cm2", "x_per_mm", "x_per_mm2", "x", "bottom_20")
    rounded_by_key = part({key: (np.float64(value), np.array([[value]])) for key in keys})
    for key, digits in zip(keys, (3, 3, 3, 1, 6, 6, 6, 6), strict=True):
        assert rounded_by_key[key] == [round(value, digits), [[round(value, digits)]]]


@given(st.floats(-1e9, 1e9) | st.sampled_from([math.nan, math.inf, -math.inf]), st.integers(0, 6))
@settings(deadline=None, max_examples=200)
def test_rounding_keeps_the_number_and_nulls_the_rest(value: float, digits: int) -> None:
    result = json_number(value, digits)
    if not math.isfinite(value):
        assert result is None
    else:
        assert abs(result - value) <= printed(digits) + 1e-15 * abs(value)
        assert str(result) != "-0.0"


def test_definitions_lose_nothing_but_what_json_cannot_say() -> None:
    held = {"a": (1, 2.5, float("nan")), "b": np.float64(0.1), "c": np.int64(3), "d": True}
    assert exact(held) == {"a": [1, 2.5, None], "b": 0.1, "c": 3, "d": True}


@pytest.mark.parametrize("left", [False, True])
@pytest.mark.parametrize("planted_deg", [0.0, 11.5, 90.0, 171.0])
def test_the_papers_frame_is_turned_by_the_planted_angle(left: bool, planted_deg: float) -> None:
    """The paper's frame of a left last is that of its mirror image; the angle is the same."""
    angle = np.radians(planted_deg)
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1.0]]
    )
    record = answers.record(left=left)
    rotation = record.canonical_transform[:3, :3]
    file_mirror = np.diag([-1.0, 1, 1]) if left else np.eye(3)
    frame_mirror = np.diag([1.0, -1, 1]) if left else np.eye(3)
    paper = answers.placed(turn @ frame_mirror @ rotation @ file_mirror, [1, 2, 3], scale=1000.0)
    assert np.linalg.det(paper[:3, :3]) > 0
    angle_deg = paper_frame_angle_deg(paper, record.canonical_transform, mirrored=left)
    assert angle_deg == pytest.approx(planted_deg, abs=ROUNDING)


def test_lasts_are_listed_by_name_with_the_reference_marked() -> None:
    records = [answers.record("b"), answers.record("a")]
    document = Library(tuple(records), 2, "b").to_dict()
    assert [last["last"] for last in document["lasts"]] == ["a", "b"]
    assert [last["reference"] for last in document["lasts"]] == [False, True]
