"""Whose feet the scans are: by file names in several languages, by a CSV file, by the sides."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.errors import BadManifest, BadOption
from footfit.pipeline.batch.side_words import side_in_name, side_of_file
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.customers.customer import (
    Customer,
    alone_notices,
    one_pair,
    pairs_by_name,
    pairs_in_csv,
)
from footfit.pipeline.customers.pair_sides import with_named_side
from footfit.pipeline.scan.reading import prepared_source
from footfit.results import MeshInfo, Scan
from footfit.whole_files import safe_file_name
from tests.conftest import SAMPLES
from tests.reading import read_scan
from tests.scans import aligned
from tests.test_pipeline_sides import taken_for


def paired(*paths: str) -> list[tuple[str | None, tuple[str | None, ...]]]:
    """The customers of files by their names: each with the name and the paths."""
    customers = pairs_by_name([Source(path) for path in paths])
    return [(customer.name, customer.paths) for customer in customers]


# ---------------------------------------------------------------- names


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("ann_L", "ann_R"),
        ("L_ann", "R_ann"),
        ("ann.left", "ann.right"),
        ("ANN-LEFT", "ann-Right"),
        ("ann links", "ann rechts"),
        ("ann_li", "ann_re"),
        ("pied gauche ann", "pied droit ann"),
        ("ann_gauche", "ann_droite"),
        ("ann (izq)", "ann (der)"),
        ("ann izquierdo", "ann derecho"),
        ("ann_esquerdo", "ann_direito"),
        ("ann_sinistro", "ann_destro"),
        ("ann sx", "ann dx"),
        ("ann vänster", "ann höger"),
        ("ann venstre", "ann HØYRE"),
        ("ann lewa", "ann prawa"),
        ("ann_левая", "ann_правая"),
        ("ann_左足", "ann_右足"),
    ],
)
@pytest.mark.parametrize("form", ["NFC", "NFD"])
def test_left_and_right_are_known_in_many_languages(left: str, right: str, form: str) -> None:
    names = [unicodedata.normalize(form, f"scans/{each}.stl") for each in (right, left)]
    ((_, paths),) = paired(*names)
    assert paths == (names[1], names[0]), "the left foot comes first"


def test_a_word_is_a_whole_token() -> None:
    for name in ("lee", "Clara", "bright", "aleft", "rightly", "rl", "Relin", "sol"):
        assert side_in_name(name).sides == frozenset(), name
    assert side_in_name("Li_left").rest == "Li"
    assert side_in_name("L_Smith_right").rest == "L_Smith"
    assert side_of_file("der.stl") is None, "an abbreviation alone warns of nothing"


@given(st.text(st.characters(codec="utf-8"), max_size=30), st.sampled_from(["left", "right"]))
def test_a_side_is_found_beside_any_other_word(name: str, side: str) -> None:
    plain = side_in_name(name)
    said = side_in_name(f"{name}_{side}")
    assert side in said.sides
    if not plain.sides:
        assert said.side == side


def test_what_a_name_says_beside_the_side_is_the_customer() -> None:
    assert paired("s/Zoé gauche.stl", "s/bob_R.stl", "s/ZOÉ_droite.stl", "s/bob_L.obj") == [
        ("Zoé", ("s/Zoé gauche.stl", "s/ZOÉ_droite.stl")),
        ("bob", ("s/bob_L.obj", "s/bob_R.stl")),
    ]
    assert paired("ann_L_1.stl", "ann_R_1.stl", "ann_L_2.stl", "ann_R_2.stl") == [
        ("ann_1", ("ann_L_1.stl", "ann_R_1.stl")),
        ("ann_2", ("ann_L_2.stl", "ann_R_2.stl")),
    ]


def test_the_folder_may_name_the_customer_or_the_side() -> None:
    assert paired("ann/left.stl", "ann/right.stl", "bob/L.stl", "bob/R.stl") == [
        ("ann", ("ann/left.stl", "ann/right.stl")),
        ("bob", ("bob/L.stl", "bob/R.stl")),
    ]
    assert paired("ann/left foot.stl", "ann/Right_Foot.stl", "bob/Fuß rechts.stl") == [
        ("ann", ("ann/left foot.stl", "ann/Right_Foot.stl")),
        ("bob", ("bob/Fuß rechts.stl",)),
    ]
    assert paired("s/left/ann.stl", "s/right/ann.stl") == [
        ("ann", ("s/left/ann.stl", "s/right/ann.stl"))
    ]
    assert paired("s/ann/left/foot.stl", "s/ann/right/foot.stl", "s/bob/left foot/scan.stl") == [
        ("ann", ("s/ann/left/foot.stl", "s/ann/right/foot.stl")),
        ("bob", ("s/bob/left foot/scan.stl",)),
    ]
    assert len(paired("mon/ann_L.stl", "tue/ann_R.stl")) == 2, "another folder, another customer"


def test_feet_without_another_one_are_alone_and_said() -> None:
    customers = pairs_by_name([Source(p) for p in ("ann_L.stl", "x.stl", "bob_L.stl", "bob_R.stl")])
    assert [(c.name, len(c.feet)) for c in customers] == [("ann", 1), ("x", 1), ("bob", 2)]
    (notice,) = alone_notices(customers)
    assert notice.message.startswith("2 feet have no other foot by name")
    assert "ann_L.stl, x.stl" in notice.message
    assert alone_notices(customers[2:]) == ()


@pytest.mark.parametrize(
    ("paths", "words"),
    [
        (("ann_L.stl", "ann_left.stl"), "both the left foot of 'ann'"),
        (("ann_L.stl", "ann_R.stl", "ANN_R.obj"), "both the right foot of 'ann'"),
        (("left_right.stl",), "both left and right"),
        (("ann_links_rechts.stl", "b_L.stl"), "both left and right"),
    ],
)
def test_names_that_are_not_clear_are_refused_with_what_to_do(
    paths: tuple[str, ...], words: str
) -> None:
    with pytest.raises(BadOption, match=words) as refused:
        paired(*paths)
    assert "rename" in refused.value.message
    assert "--pairs FILE.csv" in refused.value.message
    assert refused.value.path in paths


def test_the_two_parts_of_one_file_are_a_pair() -> None:
    info = MeshInfo(None, "0" * 64, "stl", 3, 1, True, "mm", "detected", 1.0)
    scan = Scan(info, np.zeros((3, 3)), np.zeros((1, 3), np.int64), ())
    parts = [Source(f"scans/both.stl#{i}", scan=scan) for i in (1, 2, 3)]
    (pair,) = pairs_by_name(parts[:2])
    assert (pair.name, [foot.named for foot in pair.feet]) == ("both", [None, None])
    assert [each.name for each in pairs_by_name(parts)] == ["both-1", "both-2", "both-3"]


def test_a_pair_takes_two() -> None:
    with pytest.raises(BadOption, match="not 3"):
        one_pair([Source(name) for name in "abc"])


# ---------------------------------------------------------------- a CSV file


def in_csv(folder: Path, text: str, encoding: str = "utf-8") -> list[Customer]:
    path = folder / "pairs.csv"
    path.write_bytes(text.encode(encoding))
    return pairs_in_csv(path)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("mark", [",", ";", "\t"])
def test_a_csv_file_is_read_as_spreadsheets_write_it(
    tmp_path: Path, encoding: str, mark: str
) -> None:
    rows = [
        ["Customer", "Left", "Right", "", ""],
        [" Ann  Lee", "feet\\a.stl", "feet/b.stl", "", ""],
        ["", "", "", "", ""],
        ["Bob", "", "c.stl", "", ""],
        ["", "d_L.stl", "", "", ""],
    ]
    text = "\r\n".join(mark.join(cells) for cells in rows)
    (tmp_path / "feet").mkdir()
    (tmp_path / "feet" / "a.stl").touch()
    ann, bob, third = in_csv(tmp_path, text, encoding)
    assert (ann.name, ann.paths) == (
        "Ann Lee",
        (str(tmp_path / "feet" / "a.stl"), str(tmp_path / "feet" / "b.stl")),
    )
    assert [foot.given for foot in ann.feet] == ["left", "right"]
    assert (bob.name, [foot.given for foot in bob.feet]) == ("Bob", ["right"])
    assert third.name == "d"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("customer,left,right\nAnn,,\n", "line 2.*has no foot"),
        ("customer,left,right\nAnn,a.stl,b.stl\nann,c.stl,\n", "the customer 'ann' twice"),
        ("customer,left,right\nAnn,a.stl,a.stl\n", "a.stl twice"),
        ("customer,left,right\nAnn,a.stl,\nBob,,a.stl\n", "a.stl twice"),
        ("customer,left,right\n", "names no customer"),
        ("", "names no customer|is empty|no column"),
        ("name,left,right\nAnn,a.stl,\n", "unknown column 'name'"),
        ("customer,left,left\nAnn,a.stl,b.stl\n", "twice"),
    ],
)
def test_what_a_csv_file_does_not_say_clearly_is_refused(
    tmp_path: Path, text: str, words: str
) -> None:
    with pytest.raises(BadManifest) as refused:
        in_csv(tmp_path, text)

    assert re.search(words, f"{refused.value.path}: {refused.value.message}")


# ---------------------------------------------------------------- the name and the shape


def test_a_doubtful_side_gives_way_to_the_name_and_a_sure_one_does_not() -> None:
    foot = aligned(read_scan(SAMPLES / "feet" / "mh008_R.stl"))
    for score in (0.9, 0.1):
        named = with_named_side(taken_for(foot, score), "left")
        assert (named.alignment.side.side, named.alignment.side.source) == ("left", "name")
        assert "side_from_name" in [notice.code for notice in named.alignment.warnings]
    assert with_named_side(foot, "left") is foot


def test_a_name_against_a_sure_shape_is_said(tmp_path: Path) -> None:
    data = (SAMPLES / "feet" / "mh008_R.stl").read_bytes()
    codes = {}
    for name in ("ann_L.stl", "ann_R.stl", "ann.stl"):
        (tmp_path / name).write_bytes(data)
        prepared = prepared_source(Source(str(tmp_path / name)), ReadingOptions())
        codes[name] = "side_name_differs" in [notice.code for notice in prepared.warnings]
    assert codes == {"ann_L.stl": True, "ann_R.stl": False, "ann.stl": False}


# ---------------------------------------------------------------- names of files


@given(st.text(max_size=300))
def test_any_name_gives_a_file_that_can_be_written(tmp_path_factory, name: str) -> None:
    made = safe_file_name(name, ".html")
    folder = tmp_path_factory.mktemp("names")
    (folder / made).write_text("", encoding="utf-8")
    assert [each.name for each in folder.iterdir()] == [made]
    assert not set('<>:"/\\|?*#%\n') & set(made)
    assert len(made.encode()) <= 255 - len(".12345678.partial") - 1


def test_long_names_stay_apart() -> None:
    first, second = (safe_file_name("é" * 200 + end, ".html") for end in "ab")
    assert first != second
