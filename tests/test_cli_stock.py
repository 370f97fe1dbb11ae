"""``match --stock``: only what is in stock is ranked; the rest is counted, its best named."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from footfit.catalogue.blocks.record_columns import LABELS
from footfit.errors import BadManifest
from footfit.pipeline.library.stock import stock
from tests import records
from tests.conftest import Footfit

LASTS = [
    records.last("derby-41", 0, style="Derby", size="41", size_system="eu", width_label="G"),
    records.last("derby-42", 1, style="Derby", size="42", size_system="eu", width_label="G"),
    records.last("boot-42", 2, style="boot", size="42 1/2", size_system="eu", width_label="H"),
]
NAMED = [
    (last.labels.name, tuple(getattr(last.labels, label) for label in LABELS)) for last in LASTS
]


def names(folder: Path, text: str) -> tuple[set[str], int]:
    """The names in stock by a file with this text, and how many rows name no last."""
    file = folder / "stock.csv"
    file.write_text(text, encoding="utf-8")
    there = stock(file, NAMED)
    return set(there.names), len(there.unknown)


@pytest.mark.parametrize(
    ("text", "expected", "unknown"),
    [
        ("last,quantity\nderby-41,3\nDERBY-42,0\n", {"derby-41"}, 0),
        ("last\nderby-41\nderby-42\n", {"derby-41", "derby-42"}, 0),
        ("\ufefflast;quantity\nderby-41;1,0\n;;\n", {"derby-41"}, 0),
        ("style,size\nderby,41\nDERBY,42.0\n", {"derby-41", "derby-42"}, 0),
        ("style,quantity\nderby,2\n", {"derby-41", "derby-42"}, 0),
        ("style,size,width_label\nBoot,42½,h\n", {"boot-42"}, 0),
        ("size_system,size\nEU,42\n", {"derby-42"}, 0),
        ("last,quantity\nslipper,1\nderby-41,1\n", {"derby-41"}, 1),
        ("last,quantity\nderby-41,0\nderby-41,2\n", {"derby-41"}, 0),
    ],
)
def test_rows_name_lasts_or_labels(
    tmp_path: Path, text: str, expected: set[str], unknown: int
) -> None:
    assert names(tmp_path, text) == (expected, unknown)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("last,quantity\nderby-41,many\n", "quantity is 'many'"),
        ("quantity\n3\n", "names no last"),
        ("last,colour\nderby-41,red\n", "colour"),
        ("last,quantity\n", "no row"),
    ],
)
def test_what_is_not_understood_is_refused(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(BadManifest, match=words):
        names(tmp_path, text)


def test_only_what_is_in_stock_is_ranked(
    footfit: Footfit, foot: Path, catalogue: Path, tmp_path: Path
) -> None:
    everything = json.loads(footfit("match", foot, "--json", "--catalogue", catalogue).out)
    best, *others = [c["last"] for c in everything["candidates"]]
    file = tmp_path / "stock.csv"
    file.write_text("last\n" + "\n".join([*others, "slipper-99"]) + "\n", encoding="utf-8")
    run = footfit("match", foot, "--json", "--stock", file, "--catalogue", catalogue)
    assert run.code == 0, run.err
    answer = json.loads(run.out)
    assert [c["last"] for c in answer["candidates"]] == others
    total = everything["catalogue"]["lasts"]
    assert answer["rejected"]["by_reason"]["not_in_stock"] == total - len(others)
    assert answer["not_in_stock"]["last"] == best
    assert answer["not_in_stock"]["verdict"] == everything["candidates"][0]["verdict"]
    assert answer["not_in_stock"]["better"] is True
    codes = [warning["code"] for warning in answer["warnings"]]
    assert {"not_in_stock", "unknown_stock"} <= set(codes)
    unknown = answer["warnings"][codes.index("unknown_stock")]["message"]
    assert unknown.startswith("1 row names no last")
    run = footfit("match", foot, "--stock", file, "--catalogue", catalogue)
    assert f"best last that is not in stock is {best}" in " ".join((run.out + run.err).split())


def test_a_last_that_is_not_in_stock_and_fits_no_better_is_not_praised(
    footfit: Footfit, foot: Path, catalogue: Path, tmp_path: Path
) -> None:
    everything = json.loads(footfit("match", foot, "--json", "--catalogue", catalogue).out)
    best, second, *_ = [c["last"] for c in everything["candidates"]]
    file = tmp_path / "stock.csv"
    file.write_text(f"last\n{best}\n", encoding="utf-8")
    run = footfit("match", foot, "--json", "--stock", file, "--catalogue", catalogue)
    missing = json.loads(run.out)["not_in_stock"]
    assert (missing["last"], missing["better"]) == (second, False)
    run = footfit("match", foot, "--stock", file, "--catalogue", catalogue)
    assert "no better than what is in stock" in " ".join((run.out + run.err).split())


def test_an_empty_shop_is_said(
    footfit: Footfit, foot: Path, catalogue: Path, tmp_path: Path
) -> None:
    file = tmp_path / "stock.csv"
    file.write_text("last\nslipper-99\n", encoding="utf-8")
    run = footfit("match", foot, "--stock", file, "--catalogue", catalogue)
    assert run.code == 4
    assert str(file) in run.err
    assert len(run.err.splitlines()) == 1
