"""Names of lasts: without regard to case, however accents are written, and stored as given."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.catalogue.rows.last_names import caseless, composed, meant_name
from footfit.catalogue.rows.writing import seal
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import CatalogueDamaged, NameTaken, UnknownLast
from tests import records
from tests.conftest import SAMPLES, Footfit

NFC, NFD = "René-40", unicodedata.normalize("NFD", "René-40")


@pytest.fixture
def catalogue_of_names(location: str) -> Iterator[Catalogue]:
    """A catalogue open for writing, with names of several kinds."""
    with open_catalogue(location, write=True) as opened:
        for seed, name in enumerate(("derby-40", NFC, "Straße", "İstanbul")):
            opened.add(records.last(name, seed), records.mesh_copy(seed))
        yield opened


@pytest.mark.parametrize(
    ("typed", "stored"),
    [
        ("derby-40", "derby-40"),
        ("DERBY-40", "derby-40"),
        ("Derby-40", "derby-40"),
        (NFC, NFC),
        (NFD, NFC),
        (NFD.upper(), NFC),
        ("STRASSE", "Straße"),
        ("i\u0307stanbul", "İstanbul"),
    ],
)
def test_a_name_is_found_in_any_case_and_form(
    catalogue_of_names: Catalogue, typed: str, stored: str
) -> None:
    assert catalogue_of_names.record(typed).labels.name == stored
    assert catalogue_of_names.mesh_copy(typed).faces
    assert catalogue_of_names.set_reference(typed).reference.last == stored
    assert catalogue_of_names.rename(typed, "other").renamed_from == stored


@given(st.text(min_size=1), st.sampled_from(["NFC", "NFD", "NFKC"]))
def test_a_name_always_means_itself(name: str, form: str) -> None:
    names = [unicodedata.normalize(form, name), name, "x", name.upper()]
    assert meant_name(names, name) == name
    assert caseless(name.upper().lower()) == caseless(name.upper())
    assert composed(unicodedata.normalize("NFD", name)) == composed(name)


@pytest.mark.parametrize("name", ["DERBY-40", "Derby-40", NFD.upper(), "STRASSE"])
@pytest.mark.parametrize("replace", [False, True])
def test_a_name_that_differs_only_in_case_is_refused(
    catalogue_of_names: Catalogue, name: str, *, replace: bool
) -> None:
    names = catalogue_of_names.names()
    with pytest.raises(NameTaken, match="differs only in case"):
        catalogue_of_names.add(records.last(name, 9), replace=replace)
    with pytest.raises(NameTaken, match="is in the catalogue"):
        catalogue_of_names.rename("İstanbul", name)
    assert catalogue_of_names.names() == names


def test_a_last_may_be_renamed_to_another_case_of_its_own_name(
    catalogue_of_names: Catalogue,
) -> None:
    assert catalogue_of_names.rename("derby-40", "Derby-40").last == "Derby-40"
    assert "Derby-40" in catalogue_of_names.names()
    assert catalogue_of_names.findings() == []


def test_the_same_name_in_another_form_is_the_same_last(catalogue_of_names: Catalogue) -> None:
    with pytest.raises(NameTaken, match="--replace"):
        catalogue_of_names.add(records.last(NFD, 9))
    catalogue_of_names.add(records.last(NFD, 9), replace=True)
    assert len(catalogue_of_names.names()) == 4
    assert catalogue_of_names.findings() == []


def test_a_catalogue_that_has_both_cases_goes_on(catalogue_of_names: Catalogue) -> None:
    """Older versions stored both: an exact name wins, and any other is asked for."""
    catalogue_of_names.add(records.last("second", 8), records.mesh_copy(8))
    with catalogue_of_names.file.atomic() as connection:
        connection.exec_driver_sql("UPDATE last SET name = 'DERBY-40' WHERE name = 'second'")
        key = connection.exec_driver_sql("SELECT id FROM last WHERE name = 'DERBY-40'").scalar()
        assert key is not None
        seal(connection, key)
    assert catalogue_of_names.record("derby-40").info.sha256 == records.last(seed=0).info.sha256
    assert catalogue_of_names.record("DERBY-40").info.sha256 == records.last(seed=8).info.sha256
    with pytest.raises(UnknownLast, match="'DERBY-40', 'derby-40': type the name as it is stored"):
        catalogue_of_names.record("Derby-40")
    catalogue_of_names.add(records.last("DERBY-40", 10), replace=True)
    assert catalogue_of_names.remove("DERBY-40").last == "DERBY-40"
    assert catalogue_of_names.record("Derby-40").labels.name == "derby-40"


def test_a_mistyped_name_in_any_case_gets_the_nearest(catalogue_of_names: Catalogue) -> None:
    with pytest.raises(UnknownLast, match="nearest is 'derby-40'"):
        catalogue_of_names.record("DERBI-40")


def test_labels_are_compared_in_any_case_and_form(catalogue_of_names: Catalogue) -> None:
    catalogue_of_names.add(records.last("labelled", 9, style=NFC, size="42 2/3"))
    for style in (NFC, NFD, NFD.upper()):
        for size in ("42 2/3", "42⅔", None):
            chosen = catalogue_of_names.lasts(style=style, size=size).records
            assert [record.labels.name for record in chosen] == ["labelled"]
    assert catalogue_of_names.lasts(style=NFC, size="42").records == ()


# ---------------------------------------------------------------- the command line

SCANS = [SAMPLES / "lasts" / f"derby-{size}.stl" for size in (38, 39)]


def test_every_command_takes_a_name_in_any_case(
    footfit: Footfit, catalogue: Path, tmp_path: Path
) -> None:
    here = ("--catalogue", catalogue, "--json")
    assert footfit("show-last", "DERBY-40", *here).document["last"] == "derby-40"
    exported = footfit("export-last", "Derby-40", "-o", tmp_path / "x.stl", *here).document
    assert exported["last"] == "derby-40"
    assert footfit("set-reference", "Derby-40", *here).document["last"] == "derby-40"
    renamed = footfit("rename-last", "DERBY-41", "new", *here).document
    assert renamed["renamed_from"] == "derby-41"
    assert footfit("remove-last", "NEW", *here).document["last"] == "new"
    foot = sorted((SAMPLES / "feet").iterdir())[0]
    aligned = footfit("align", foot, "--method", "paper", "--to", "Derby-40", *here).document
    assert aligned["reference"]["last"] == "derby-40"


def test_ingest_refuses_a_name_in_another_case_and_takes_another_form(
    footfit: Footfit, tmp_path: Path
) -> None:
    here = ("--catalogue", tmp_path / "c", "--json")
    assert footfit("ingest-last", SCANS[0], "--name", NFC, *here).document["status"] == "added"
    again = footfit("ingest-last", SCANS[0], "--name", NFD, *here).document
    assert (again["status"], again["last"]) == ("unchanged", NFC)
    for dry in ((), ("--dry-run",)):
        other = footfit("ingest-last", SCANS[1], "--name", NFC.upper(), *dry, *here)
        assert (other.code, other.document["code"]) == (2, "name_taken")
        assert "differs only in case" in other.document["error"]
    names = [last["last"] for last in footfit("list-lasts", *here).document["lasts"]]
    assert names == [NFC]


def test_a_damaged_last_of_the_name_is_said_and_no_bug(footfit: Footfit, tmp_path: Path) -> None:
    place = tmp_path / "c"
    here = ("--catalogue", place, "--json")
    footfit("ingest-last", SCANS[0], "--name", "x", *here)
    with open_catalogue(place, write=True) as opened:
        with opened.file.atomic() as connection:
            connection.exec_driver_sql("UPDATE last SET style = 'changed'")
        with pytest.raises(CatalogueDamaged):
            opened.record("x")
    for name in ("x", "X"):
        run = footfit("ingest-last", SCANS[1], "--name", name, *here)
        assert (run.code, run.document["code"]) == (2, "name_taken")
