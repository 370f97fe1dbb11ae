"""Lasts in, lasts out: every verb of the catalogue, and what it leaves when it fails."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from footfit.catalogue import store
from footfit.catalogue.file.file_signature import SIGNATURE
from footfit.catalogue.rows import reference_last
from footfit.catalogue.rows.schema import METADATA
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import BadOption, CatalogueDamaged, NameTaken, UnknownLast
from footfit.results import LastRecord, Measure, Measured, Notice
from tests import records
from tests.bounds import EXACT, ROUNDING

SIDES = ("left", "right")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a catalogue is to be."""
    return tmp_path / "lasts.footfit"


@contextmanager
def four_lasts(place: str | Path) -> Iterator[Catalogue]:
    """A catalogue open for writing, with four lasts of both sides."""
    with open_catalogue(place, write=True) as opened:
        for seed in range(4):
            side = SIDES[seed % 2]
            opened.add(records.last(f"last-{seed}", seed, side=side), records.mesh_copy(seed))
        yield opened


@pytest.fixture
def catalogue(location: str) -> Iterator[Catalogue]:
    """A catalogue of four lasts, in a file and then on a server."""
    with four_lasts(location) as opened:
        yield opened


@pytest.fixture
def in_file(path: Path) -> Iterator[Catalogue]:
    """A catalogue of four lasts in a file."""
    with four_lasts(path) as opened:
        yield opened


def content(catalogue: Catalogue) -> list[object]:
    """All that a catalogue holds, in a form that can be compared."""
    copies = [catalogue.mesh_copy(name) for name in catalogue.names()]
    return [
        records.plain(value) for value in (catalogue.lasts().records, catalogue.reference(), copies)
    ]


def test_what_is_added_comes_back_but_for_its_folder(catalogue: Catalogue) -> None:
    for seed in range(4):
        given_last = records.last(f"last-{seed}", seed, side=SIDES[seed % 2])
        found = catalogue.record(f"last-{seed}")
        assert found.paper_transform is not None
        assert records.plain(records.as_stored(found)) == records.plain(
            records.as_stored(given_last)
        )
        assert found.info.path == f"last-{seed}.stl"
        assert catalogue.mesh_copy(f"last-{seed}") == records.mesh_copy(seed)
    assert catalogue.findings() == []


def typable(text: str) -> str:
    """What of a text may be the name of a last."""
    return "".join(sign for sign in text if sign.isprintable() and sign not in "/\\")


@settings(deadline=None, max_examples=25, suppress_health_check=list(HealthCheck))
@given(
    names=st.lists(st.text(max_size=12).map(typable), min_size=2, max_size=2),
    words=st.lists(st.text(max_size=12), min_size=2, max_size=2),
    heel=st.floats(-1e9, 1e9),
    value=st.one_of(st.none(), st.floats(allow_nan=False)),
    row=st.lists(st.floats(width=64), min_size=3, max_size=3),
)
def test_any_label_and_number_survives(
    tmp_path_factory: pytest.TempPathFactory,
    names: list[str],
    words: list[str],
    heel: float,
    value: float | None,
    row: list[float],
) -> None:
    """Also control characters, quotes and NUL in text, infinities and NaN in arrays.

    The names of lasts and families hold signs that are shown only: others are refused.
    """
    style, reason = (word.encode("utf-8", "ignore").decode("utf-8") for word in words)
    base = records.last("x" + names[0], style=style, family=names[1], heel_height_mm=heel)
    measures = (Measure("ball_width", Measured(value, None, reason or None), "ball/1"),)
    frame = replace(base.eigenframe, eigenvalues_mm2=np.array(row))
    asked = replace(base, measures=measures, eigenframe=frame, warnings=(Notice("said", reason),))
    with open_catalogue(tmp_path_factory.mktemp("any") / "c", write=True) as opened:
        opened.add(asked)
        found = opened.record(asked.labels.name)
        assert {finding.code for finding in opened.findings()} <= {"range"}
    assert records.plain(records.as_stored(found)) == records.plain(records.as_stored(asked))


def test_what_cannot_be_measured_comes_back_so(catalogue: Catalogue) -> None:
    flare = replace(records.profile(), angle_deg=float("nan"), angle_sd_deg=float("nan"))
    flare.curvature["bottom_surface"] = None
    catalogue.add(replace(records.last("last-1", 1), flare=flare), replace=True)
    found = catalogue.record("last-1")
    assert np.isnan(found.flare.angle_deg)
    assert np.isnan(found.flare.angle_sd_deg)
    assert found.flare.curvature["bottom_surface"] is None
    assert catalogue.findings() == []


def test_the_first_last_is_the_reference(location: str) -> None:
    with open_catalogue(location, write=True) as opened:
        assert opened.reference() is None
        opened.add(records.last("first", 7))
        opened.add(records.last("second", 8))
        reference = opened.reference()
        assert reference is not None
        assert reference.last == "first"
        # Its own printed frame turned by its own OM_E is its canonical frame: a rotation apart.
        found = opened.record("first")
        assert found.paper_transform is not None
        np.testing.assert_allclose(found.paper_transform, found.canonical_transform, atol=ROUNDING)


@pytest.mark.parametrize("name", ["last-0", "last-1"])
def test_set_reference_expresses_every_last_by_it(catalogue: Catalogue, name: str) -> None:
    """Eq. 8 on points: OM_E R (x - P_c) plus the reference's centroid, left ones mirrored first."""
    reference = catalogue.set_reference(name).reference
    assert reference.last == name
    np.testing.assert_allclose(reference.om_e @ reference.om_e.T, np.eye(3), atol=EXACT)
    assert np.linalg.det(reference.om_e) == pytest.approx(1.0)
    for record in catalogue.lasts().records:
        transform = record.paper_transform
        assert transform is not None
        frame, scale = record.printed_frame, record.info.unit_scale
        left = record.side.side == "left"
        mirror = np.diag([-1.0, 1.0, 1.0]) if left else np.eye(3)
        centroid = mirror @ frame.centroid_mm / scale
        np.testing.assert_allclose(
            transform[:3, :3] @ centroid + transform[:3, 3], reference.centroid_mm, atol=ROUNDING
        )
        # Each eigenvector, mirrored with its mesh, comes to lie along OM_E's column.
        turned = (transform[:3, :3] / scale) @ (frame.eigenvectors @ mirror).T
        np.testing.assert_allclose(
            np.abs(np.einsum("ij,ij->j", turned, reference.om_e)), 1.0, atol=ROUNDING
        )
        assert np.linalg.det(transform[:3, :3]) > 0
    assert catalogue.findings() == []


def test_a_new_last_is_expressed_by_the_reference_that_is_set(catalogue: Catalogue) -> None:
    catalogue.add(records.last("late", 9))
    once = catalogue.record("late").paper_transform
    reference = catalogue.reference()
    assert reference is not None
    catalogue.set_reference(reference.last)
    again = catalogue.record("late").paper_transform
    assert once is not None
    assert again is not None
    assert once.tobytes() == again.tobytes()


def test_a_fault_in_the_middle_of_set_reference_leaves_the_old(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, calls = content(catalogue), []

    def failing(*given: object) -> object:
        calls.append(given)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return real(*given)

    real = reference_last.transform_by
    monkeypatch.setattr(reference_last, "transform_by", failing)
    with pytest.raises(KeyboardInterrupt):
        catalogue.set_reference("last-2")
    monkeypatch.undo()
    assert len(calls) == 3
    assert content(catalogue) == before
    assert catalogue.findings() == []


def test_a_fault_in_the_middle_of_an_add_leaves_no_half_last(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = content(catalogue)

    def failing(*given: object) -> None:
        raise RuntimeError("after its rows were written")

    monkeypatch.setattr(store, "express", failing)
    with pytest.raises(RuntimeError):
        catalogue.add(records.last("half", 9), records.mesh_copy(9))
    with pytest.raises(RuntimeError):
        catalogue.add(records.last("last-1", 9), records.mesh_copy(9), replace=True)
    monkeypatch.undo()
    assert content(catalogue) == before
    assert catalogue.findings() == []


def test_a_name_or_a_content_that_is_there_is_refused(catalogue: Catalogue) -> None:
    before = content(catalogue)
    with pytest.raises(NameTaken, match=r"last-1.*--replace"):
        catalogue.add(records.last("last-1", 9))
    with pytest.raises(NameTaken, match="as 'last-1'"):
        catalogue.add(records.last("other", 1))
    with pytest.raises(NameTaken, match="as 'last-1'"):
        catalogue.add(records.last("last-2", 1), replace=True)
    assert content(catalogue) == before


def test_the_same_lasts_in_the_same_order_are_the_same_catalogue(tmp_path: Path) -> None:
    places = [tmp_path / "one", tmp_path / "two"]
    for place in places:
        with open_catalogue(place, write=True) as opened:
            for seed in range(3):
                opened.add(records.last(f"last-{seed}", seed), records.mesh_copy(seed))
            opened.set_reference("last-2")
    one, two = (place.read_bytes() for place in places)
    assert one == two


def test_odd_values_are_sealed_alike_together_and_alone(tmp_path: Path) -> None:
    """What the database gives back otherwise than it was sent, and what JSON writes otherwise."""
    odd = [
        Measured(-0.0, -0.0, None, -0.0, -0.0),
        Measured(np.nan, np.nan, None, np.nan, np.nan),
        Measured(np.inf, 0.1, None, np.inf),
        Measured(np.float64(1e22), 1e-7, None, np.float32(0.1)),
        Measured(None, None, 'a "reason" \u00e9 \U0001f45f\n'),
        Measured(1, 2, None, 3, 4),
        Measured(5.0, None, None, None, 1.0),
    ]
    lasts = []
    for seed in range(9):
        last = records.last(f"Ren\u00e9 {seed}", seed, side=SIDES[seed % 2], style="\U0001f45f")
        turned = odd[seed % len(odd) :] + odd[: seed % len(odd)]
        measures = tuple(Measure(f"m{i}", value, f"by {i}") for i, value in enumerate(turned))
        info = replace(last.info, watertight=np.bool_(seed % 2), faces=np.int64(seed + 1))
        flare = replace(last.flare, angle_deg=np.nan if seed % 3 else -0.0)
        lasts.append(replace(last, measures=measures, info=info, flare=flare))
    dumps = []
    for name in ("many", "single"):
        with open_catalogue(tmp_path / name, write=True) as catalogue:
            if name == "many":
                assert len(list(catalogue.add_many(lasts))) == len(lasts)
            else:
                for last in lasts:
                    catalogue.add(last)
            codes = {finding.code for finding in catalogue.findings() if finding.damage}
            assert codes == {"range"}  # of the infinite values: no hash is wrong
        with closing(sqlite3.connect(tmp_path / name)) as connection:
            dumps.append(list(connection.iterdump()))
    assert dumps[0] == dumps[1]


def test_replacing_keeps_what_points_to_a_last(catalogue: Catalogue) -> None:
    catalogue.add(records.last("graded", 9, parent="last-1", family="derby"))
    catalogue.add(records.last("last-1", 10, side="left"), records.mesh_copy(10), replace=True)
    assert catalogue.record("graded").labels.parent == "last-1"
    assert catalogue.record("last-1").length_mm == records.last(seed=10).length_mm
    assert catalogue.mesh_copy("last-1") == records.mesh_copy(10)
    catalogue.add(records.last("new", 11), replace=True)
    assert "new" in catalogue.names()
    assert catalogue.findings() == []


def test_replacing_the_reference_expresses_all_by_the_new_scan(catalogue: Catalogue) -> None:
    old = catalogue.reference()
    catalogue.add(records.last("last-0", 12), replace=True)
    new = catalogue.reference()
    assert old is not None
    assert new is not None
    assert new.last == "last-0"
    assert not np.allclose(new.om_e, old.om_e)
    assert catalogue.findings() == [], "every paper transform follows the new OM_E"


@pytest.mark.parametrize("damaged", [False, True])
def test_the_only_last_is_removed_with_its_reference(location: str, damaged: bool) -> None:
    with open_catalogue(location, write=True) as opened:
        opened.add(records.last("only", 1), records.mesh_copy(1))
        if damaged:
            with opened.file.atomic() as connection:
                connection.exec_driver_sql("UPDATE last SET style = 'changed'")
        outcome = opened.remove("only")
        assert (outcome.last, outcome.left) == ("only", 0)
        assert (opened.names(), opened.reference(), opened.findings()) == ((), None, [])
        opened.add(records.last("next", 2))
        reference = opened.reference()
        assert reference is not None
        assert reference.last == "next"
        assert opened.findings() == []


def test_the_reference_and_a_parent_are_not_removed(catalogue: Catalogue) -> None:
    catalogue.add(records.last("graded", 9, parent="last-1"))
    before = content_without_meshes(catalogue)
    with pytest.raises(BadOption, match=r"another reference first.*set-reference"):
        catalogue.remove("last-0")
    with pytest.raises(BadOption, match="parent of 'graded'"):
        catalogue.remove("last-1")
    assert content_without_meshes(catalogue) == before
    catalogue.remove("graded")
    catalogue.remove("last-1")
    assert catalogue.names() == ("last-0", "last-2", "last-3")
    assert catalogue.findings() == []


def content_without_meshes(catalogue: Catalogue) -> object:
    return records.plain((catalogue.lasts().records, catalogue.reference()))


def test_removing_takes_every_row_of_a_last(catalogue: Catalogue) -> None:
    catalogue.remove("last-2")
    with catalogue.file.reading() as connection:
        for table in ("frame", "flare", "measure", "notice", "mesh_copy"):
            select = f"SELECT count(DISTINCT last_id) FROM {table}"
            assert connection.execute(select).fetchone() == (3,)


def test_renaming(catalogue: Catalogue) -> None:
    catalogue.add(records.last("graded", 9, parent="last-0"))
    catalogue.rename("last-0", "first model")
    reference = catalogue.reference()
    assert reference is not None
    assert reference.last == "first model"
    assert catalogue.record("graded").labels.parent == "first model"
    with pytest.raises(NameTaken):
        catalogue.rename("last-1", "last-2")
    with pytest.raises(UnknownLast, match="nearest is 'last-1'"):
        catalogue.rename("last1", "x")
    catalogue.rename("last-1", "last-1")
    assert catalogue.findings() == []


@pytest.mark.parametrize("name", ["", "  ", "\udcff"])
def test_a_name_that_cannot_be_stored_is_refused(catalogue: Catalogue, name: str) -> None:
    with pytest.raises(BadOption, match=r"type one|give another one"):
        catalogue.add(records.last(name, 9))
    with pytest.raises(BadOption, match=r"type one|give another one"):
        catalogue.rename("last-1", name)
    with pytest.raises(UnknownLast):
        catalogue.record(name)


def test_a_file_name_that_is_no_utf8_is_kept_readable(catalogue: Catalogue) -> None:
    scan = records.last("odd", 9)
    catalogue.add(replace(scan, info=replace(scan.info, path="/x/\udcff.stl")))
    assert catalogue.record("odd").info.path == "\\udcff.stl"


def test_a_parent_must_be_there_and_no_descendant(catalogue: Catalogue) -> None:
    with pytest.raises(UnknownLast, match="nothing"):
        catalogue.add(records.last("graded", 9, parent="nothing"))
    catalogue.add(records.last("child", 9, parent="last-1"))
    catalogue.add(records.last("grandchild", 10, parent="child"))
    with pytest.raises(BadOption, match="descends"):
        catalogue.add(records.last("last-1", 1, parent="grandchild"), replace=True)
    with pytest.raises(BadOption, match="descends"):
        catalogue.add(records.last("last-1", 1, parent="last-1"), replace=True)


def test_a_profile_made_anew_says_what_it_replaces(catalogue: Catalogue) -> None:
    flare, measures = records.profile(77), records.last(seed=78).measures
    changed = replace(catalogue.record("last-1"), flare=flare, upgraded_from="flare/0")
    catalogue.update_measured(changed)
    found = catalogue.record("last-1")
    assert records.plain(found.flare) == records.plain(flare)
    assert found.upgraded_from == "flare/0"
    assert found.measures == records.last("last-1", 1).measures
    catalogue.update_measured(replace(changed, upgraded_from=None, measures=measures))
    assert catalogue.record("last-1").measures == measures
    assert catalogue.record("last-1").upgraded_from is None
    assert catalogue.findings() == []


def test_a_mesh_that_was_not_stored_is_said(catalogue: Catalogue) -> None:
    catalogue.add(records.last("bare", 9))
    with pytest.raises(UnknownLast, match="without its mesh"):
        catalogue.mesh_copy("bare")


def test_facts_count_what_is_there(catalogue: Catalogue, location: str) -> None:
    catalogue.add(records.last("bare", 9, style=None))
    facts = catalogue.summary()
    assert facts.path == location
    assert facts.bytes == catalogue.file.size_bytes
    assert (facts.lasts, facts.reference, facts.schema_revision) == (
        5,
        "last-0",
        SIGNATURE.revisions[-1],
    )
    assert facts.definitions == ((records.profile().definition.version, 5),)
    assert facts.styles == (("", 1), ("boot", 1), ("oxford", 2), ("trainer", 1))
    assert facts.sides == (("left", 2), ("right", 3))
    assert (facts.mesh_copies, facts.mesh_copy_bytes) == (4, 8_000)
    assert facts.worst_copy_error_mm == 0.12


def test_facts_count_the_rows_of_every_table_also_of_a_strange_one(
    in_file: Catalogue, path: Path
) -> None:
    tables = {table.name for table in METADATA.sorted_tables}
    kept = dict(in_file.summary().kept)
    assert set(kept) == tables
    assert (kept["last"], kept["reference"], kept["mesh_copy"]) == (4, 1, 4)
    with closing(sqlite3.connect(path)) as connection:
        connection.execute('CREATE TABLE "customer""s feet" (name TEXT)')
        connection.execute("""INSERT INTO "customer""s feet" VALUES ('somebody')""")
        connection.commit()
    assert dict(in_file.summary().kept)['customer"s feet'] == 1


def test_no_folder_and_no_user_is_in_the_file(in_file: Catalogue, path: Path) -> None:
    assert b"somebody" not in path.read_bytes()


def damage(catalogue: Catalogue, name: str) -> None:
    """Change a value of a last behind footfit's back."""
    catalogue.file.connection.execute("UPDATE last SET size = '99' WHERE name = ?", (name,))


def test_damage_is_never_sealed_as_sound(catalogue: Catalogue) -> None:
    damage(catalogue, "last-1")
    for write in (
        lambda: catalogue.set_reference("last-2"),
        lambda: catalogue.rename("last-1", "x"),
        lambda: catalogue.update_measured(records.last("last-1")),
        lambda: catalogue.record("last-1"),
    ):
        with pytest.raises(CatalogueDamaged, match="'last-1'") as caught:
            write()
        assert caught.value.path == str(catalogue.file.path)
    assert [finding.last for finding in catalogue.findings()] == ["last-1"]


def test_the_same_file_again_cures_a_damaged_last(catalogue: Catalogue) -> None:
    damage(catalogue, "last-1")
    with pytest.raises(NameTaken):
        catalogue.add(records.last("last-1", 9))
    catalogue.add(records.last("last-1", 1, side="left"), records.mesh_copy(1))
    assert catalogue.findings() == []
    damage(catalogue, "last-2")
    catalogue.remove("last-2")
    assert catalogue.findings() == []


def test_a_record_is_plain_and_can_be_pickled(catalogue: Catalogue) -> None:
    import pickle

    record = catalogue.record("last-1")
    copy = pickle.loads(pickle.dumps(record))
    assert isinstance(copy, LastRecord)
    assert records.plain(copy) == records.plain(record)
