"""How a last was made from another one: what is kept, and what becomes of it."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

import footfit
from footfit.catalogue.rows.columns import PARENTAGE
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, CatalogueDamaged, UnknownLast
from footfit.pipeline.library import backup, edit
from tests import records

MADE = records.parentage("base", figures={"hold": ["heel"]})
CUSTOM = records.parentage(
    "base",
    made_by="customise",
    rule=None,
    foot_sha256="f" * 64,
    profile="dress",
    profile_version=2,
    profile_sha256="e" * 64,
    figures={"flare_follow": 0.5, "room": {"ball-medial": 4.0}},
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "lasts.footfit"


@pytest.fixture
def catalogue(path: Path) -> Iterator[Catalogue]:
    """A base, a graded last, a custom last, and a scanned one."""
    with open_catalogue(path, write=True) as opened:
        opened.add(records.last("base", 0))
        graded = records.last("graded", 1, parent="base", family="derby")
        opened.add(graded, parentage=MADE)
        opened.add(records.last("custom", 2, parent="base"), parentage=CUSTOM)
        opened.add(records.last("scanned", 3))
        yield opened


def test_parentage_comes_back_as_it_was_stored(catalogue: Catalogue, path: Path) -> None:
    assert catalogue.parentage("graded") == MADE
    assert catalogue.parentage("custom") == CUSTOM
    assert catalogue.parentage("scanned") is None
    assert catalogue.findings() == []
    with footfit.open_catalogue(path) as lasts:
        document = lasts.last("graded").to_dict()
        assert lasts.last("scanned").to_dict()["parentage"] is None
        assert [record.labels.name for record in lasts.lasts(family="DERBY").lasts] == ["graded"]
    assert document["parentage"]["base"] == document["parent"] == "base"
    assert document["parentage"]["targets"][0]["target"] == 276.667


def test_a_base_that_is_renamed_is_renamed_in_its_children_alone(catalogue: Catalogue) -> None:
    stranger = replace(MADE, base_sha256="a" * 64)
    catalogue.add(records.last("other", 4), parentage=stranger)
    catalogue.rename("base", "derby-42")
    assert catalogue.parentage("graded") == replace(MADE, base="derby-42")
    assert catalogue.record("graded").labels.parent == "derby-42"
    assert catalogue.parentage("other") == stranger
    assert catalogue.findings() == []


def test_a_base_is_removed_once_the_ties_are_cut(catalogue: Catalogue, path: Path) -> None:
    catalogue.set_reference("scanned")
    with pytest.raises(BadOption, match="--parent"):
        catalogue.remove("base")
    for name in ("graded", "custom"):
        outcome = edit.edit_last(path, name, {"parent": ""})
        assert outcome.changes == (("parent", "base", None),)
    catalogue.remove("base")
    assert catalogue.parentage("graded") == MADE
    catalogue.remove("graded")
    count = "SELECT count(*) FROM parentage"
    with sqlite3.connect(path) as connection:
        assert connection.execute(count).fetchone() == (1,)
    connection.close()


def test_a_parent_is_another_last_and_no_descendant(catalogue: Catalogue, path: Path) -> None:
    outcome = edit.edit_last(path, "scanned", {"parent": "GRADED", "family": "derby"})
    assert {label: new for label, _, new in outcome.changes} == {
        "parent": "graded",
        "family": "derby",
    }
    assert catalogue.record("scanned").labels.parent == "graded"
    for parent in ("scanned", "base"):
        with pytest.raises(BadOption, match="descends"):
            edit.edit_last(path, "base", {"parent": parent})
    with pytest.raises(UnknownLast):
        edit.edit_last(path, "base", {"parent": "nobody"})
    assert catalogue.record("base").labels.parent is None
    assert catalogue.findings() == []


def test_the_same_file_keeps_its_parentage_and_another_does_not(catalogue: Catalogue) -> None:
    catalogue.add(records.last("graded", 1), replace=True)
    assert catalogue.parentage("graded") == MADE
    assert catalogue.record("graded").labels.parent == "base"
    catalogue.add(records.last("graded", 9), replace=True)
    assert catalogue.parentage("graded") is None
    assert catalogue.record("graded").labels.parent is None


@pytest.mark.parametrize(
    "change", ["base = 'x'", "targets = '[]'", "foot_sha256 = NULL", "made_by = 'grade'"]
)
def test_changed_parentage_is_found_named_and_cured(
    catalogue: Catalogue, path: Path, change: str
) -> None:
    with sqlite3.connect(path) as connection:
        connection.execute(f"UPDATE {PARENTAGE.name} SET {change} WHERE last_id = 3")
    connection.close()
    assert [(f.code, f.last) for f in catalogue.findings()] == [("parentage", "custom")]
    with pytest.raises(CatalogueDamaged, match="the parentage of 'custom' is damaged"):
        catalogue.parentage("custom")
    catalogue.rename("base", "renamed")
    assert [f.code for f in catalogue.findings()] == ["parentage"], "damage is not sealed anew"
    catalogue.add(records.last("custom", 2), replace=True)
    assert catalogue.findings() == []


def test_implausible_parentage_is_a_finding(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue:
        wrong = replace(MADE, base_sha256="no hash")
        catalogue.add(records.last("graded", 1), parentage=wrong)
        (finding,) = catalogue.findings()
    assert (finding.code, finding.last) == ("range", "graded")
    assert "parentage.base_sha256" in finding.message


def test_a_backup_holds_parentage(catalogue: Catalogue, path: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.footfit"
    backup.back_up(path, copy)
    catalogue.remove("graded")
    backup.restore(path, copy)
    with open_catalogue(path) as again:
        assert again.parentage("graded") == MADE
        assert again.findings() == []
