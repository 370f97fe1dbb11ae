"""A catalogue on a PostgreSQL server: what a file does, several machines at once, and no password.

tests/test_catalogue_store.py and tests/test_catalogue_names.py run on a server too.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue
from footfit.errors import (
    BadOption,
    CatalogueLocked,
    CatalogueNotWritable,
    CatalogueUnreachable,
    CatalogueUnusable,
    NewerCatalogue,
    NoCatalogue,
    NotACatalogue,
    UnknownFit,
)
from footfit.locations import ServerUrl, location_of
from tests import records
from tests.conftest import ROOT, SAMPLES, Footfit
from tests.fits import entry
from tests.servers import PASSWORD, Server, started_server
from tests.test_catalogue_processes import LASTS_EACH, content, filling

LASTS = [str(path) for path in sorted((SAMPLES / "lasts").glob("*.stl"))[:3]]


@pytest.fixture
def url(server: Server) -> str:
    """The address of an empty database."""
    return server.database()


def fill(url: str, count: int = 3) -> None:
    """Store some lasts and entries of the fit log."""
    with open_catalogue(url, write=True) as catalogue:
        for seed in range(count):
            parent = None if seed != 1 else "last-0"
            last = records.last(f"last-{seed}", seed, parent=parent)
            catalogue.add(last, records.mesh_copy(seed))
            catalogue.fit_log.add(entry(seed, wearer=f"wearer-{seed % 2}"))


def test_nothing_is_made_for_a_reader(url: str, server: Server) -> None:
    with pytest.raises(NoCatalogue), open_catalogue(url):
        pass
    with pytest.raises(NoCatalogue), open_catalogue(url, write=True, create=False):
        pass
    with server.session(url.rpartition("/")[2]) as session:
        tables = "SELECT count(*) FROM pg_tables WHERE schemaname = 'public'"
        assert session.execute(tables).fetchone() == (0,)


def test_several_processes_make_and_fill_one_catalogue(url: str) -> None:
    writers = [filling(url, first, LASTS_EACH) for first in (0, 0, LASTS_EACH)]
    answers = [writer.communicate() for writer in writers]
    assert [writer.returncode for writer in writers] == [0, 0, 0], answers
    names = [name for out, _ in answers for name in out.splitlines()]
    assert sorted(names) == [f"last-{seed:03d}" for seed in range(2 * LASTS_EACH)]
    content(url)


def test_copies_both_ways_lose_nothing(url: str, server: Server, tmp_path: Path) -> None:
    from footfit.api.catalogues import open_catalogue as opened

    first, second, third = tmp_path / "a", tmp_path / "b", tmp_path / "c"
    fill(str(first))
    assert opened(first).copy_to(url).lasts == 3
    assert opened(url).copy_to(second).fits == 3
    assert opened(second).copy_to(third).lasts == 3
    assert content(url) == content(first)
    assert second.read_bytes() == third.read_bytes()
    for place in (url, second):
        with open_catalogue(place, write=True) as catalogue, open_catalogue(first) as origin:
            assert catalogue.fit_log.entries() == origin.fit_log.entries()
            assert catalogue.record("last-1").labels.parent == "last-0"
            catalogue.add(records.last("after", 77))  # its key is free
            catalogue.fit_log.add(entry(78))
            assert catalogue.findings() == []
    with pytest.raises(BadOption, match="holds lasts already"):
        opened(first).copy_to(url)


def test_a_damaged_catalogue_is_not_copied(url: str, footfit: Footfit, tmp_path: Path) -> None:
    fill(url)
    with open_catalogue(url, write=True) as catalogue:
        catalogue.file.connection.execute("UPDATE last SET size = '99' WHERE name = 'last-1'")
    run = footfit("copy-catalogue", url, tmp_path / "copy")
    assert (run.code, list(tmp_path.iterdir())) == (7, [])
    assert "last-1" in run.err
    assert footfit("check-catalogue", "--catalogue", url).code == 7


def test_forgetting_leaves_nothing_in_the_tables(url: str) -> None:
    fill(url, 4)
    with open_catalogue(url, write=True) as catalogue:
        assert catalogue.fit_log.forget("wearer-1").entries == 2
        assert len(catalogue.fit_log.entries()) == 2
        with pytest.raises(UnknownFit):
            catalogue.fit_log.forget("wearer-1")
        rows = "SELECT n_dead_tup FROM pg_stat_get_live_tuples('fit'::regclass) n_dead_tup"
        assert catalogue.file.connection.execute(rows).fetchone() is not None
        size = catalogue.file.connection.execute("SELECT pg_relation_size('fit')").fetchone()[0]
        assert size <= 8_192, "two entries fill one page: the table was written anew"


def test_what_a_server_does_otherwise_is_said(url: str, footfit: Footfit, tmp_path: Path) -> None:
    fill(url, 1)
    for command in (("backup-catalogue", tmp_path / "b"), ("restore-catalogue", LASTS[0])):
        run = footfit(*command, "--catalogue", url)
        assert (run.code, run.err.count("\n")) == (2, 1)
        assert "pg_dump" in run.err
    info = footfit("catalogue-info", "--catalogue", url, "--json").document
    assert (info["path"], info["lasts"]) == (url, 1)
    assert info["bytes"] > 0


def test_only_upgrade_catalogue_changes_the_schema(url: str, footfit: Footfit) -> None:
    older = Schema().up_to("0003")
    with open_catalogue(url, write=True, schema=older):
        pass
    for writing in (False, True):
        with (
            pytest.raises(CatalogueUnusable, match="upgrade-catalogue"),
            open_catalogue(url, write=writing),
        ):
            pass
    assert footfit("upgrade-catalogue", "--catalogue", url).code == 0
    fill(url, 1)
    with open_catalogue(url) as catalogue:
        assert catalogue.findings() == []


def test_an_upgrade_fills_what_the_migrations_cannot(
    url: str, server: Server, footfit: Footfit
) -> None:
    """The search blocks of a catalogue whose schema has none are made from its rows."""
    fill(url, 3)
    with server.session(url.rpartition("/")[2]) as session:
        blocks = "SELECT count(*) FROM search_block"
        before = session.execute(blocks).fetchone()
        session.execute("DROP TABLE search_block")
        session.execute("UPDATE alembic_version SET version_num = '0004'")
        run = footfit("upgrade-catalogue", "--catalogue", url, "--json")
        assert (run.code, run.document["revision_after"]) == (0, Schema().head)
        assert session.execute(blocks).fetchone() == before
    with open_catalogue(url) as catalogue:
        assert catalogue.findings() == []


def test_a_newer_schema_and_a_foreign_database_are_left_alone(url: str, server: Server) -> None:
    with server.session(url.rpartition("/")[2]) as session:
        session.execute("CREATE TABLE customers (name text)")
        with pytest.raises(NotACatalogue, match="another program"), open_catalogue(url, write=True):
            pass
        session.execute("DROP TABLE customers")
        fill(url, 1)
        session.execute("UPDATE alembic_version SET version_num = '9999'")
        for writing in (False, True):
            with pytest.raises(NewerCatalogue, match="9999"), open_catalogue(url, write=writing):
                pass
        session.execute(f"UPDATE alembic_version SET version_num = '{Schema().head}'")
    with open_catalogue(url) as catalogue:
        assert catalogue.names() == ("last-0",)


def test_a_user_who_may_only_read(url: str, server: Server) -> None:
    fill(url, 1)
    with server.session(url.rpartition("/")[2]) as session:
        session.execute("DROP ROLE IF EXISTS reader")
        session.execute(f"CREATE ROLE reader LOGIN PASSWORD '{PASSWORD}'")
        session.execute("GRANT SELECT ON ALL TABLES IN SCHEMA public TO reader")
    reader = url.replace("shop@", "reader@")
    with open_catalogue(reader) as catalogue:
        assert catalogue.names() == ("last-0",)
        assert catalogue.findings() == []
    with (
        open_catalogue(reader, write=True) as catalogue,
        pytest.raises(CatalogueNotWritable, match="right"),
    ):
        catalogue.add(records.last("mine", 5))


def test_a_held_catalogue_is_said(url: str) -> None:
    fill(url, 1)
    with (
        open_catalogue(url, write=True) as holder,
        open_catalogue(url, write=True, busy_timeout_s=0.2) as other,
        holder.file.atomic(),
        pytest.raises(CatalogueLocked),
    ):
        other.add(records.last("late", 5))


def test_a_text_that_the_server_cannot_keep_is_refused(url: str) -> None:
    with open_catalogue(url, write=True) as catalogue:
        with pytest.raises(BadOption, match="NUL"):
            catalogue.add(records.last("a", 1, style="a\0b"))
        assert catalogue.names() == ()


# ---------------------------------------------------------------- no server, no password


def with_password(url: str, password: str) -> str:
    """The address as somebody may type it, who should not."""
    return url.replace("shop@", f"shop:{password}@")


@pytest.mark.parametrize(
    "ending", ["", "?sslmode=disable", "?password=hush-hush", "?options=-csearch_path%3Dpublic"]
)
def test_what_is_shown_of_an_address_has_no_password(ending: str) -> None:
    address = f"postgresql+psycopg://ann:hush-hush@db.example:5433/lasts{ending}"
    location = location_of(address)
    assert isinstance(location, ServerUrl)
    assert str(location) == "postgresql+psycopg://ann@db.example:5433/lasts"
    assert "hush" not in repr(location)
    assert location.secret.startswith("postgresql://ann:hush-hush@db.example:5433/lasts")


@pytest.mark.parametrize(
    "address",
    [
        "postgresql://ann:hush-hush@db/lasts",
        "mysql://ann:hush-hush@db/lasts",
        "postgresql+psycopg://ann:hush-hush@db",
        "postgresql+psycopg://ann:hush-hush@db:port/lasts",
        "postgresql+psycopg://ann:hush-hush@[db/lasts",
        "postgresql+psycopg://ann:hush%hush@127.0.0.1:9/lasts",
        "postgresql+psycopg://ann:12/hush@127.0.0.1:9/lasts",
        "postgresql+psycopg://ann:hu@sh-hush@127.0.0.1:9/lasts",
        "postgresql+psycopg://ann:hush%00hush@127.0.0.1:9/lasts",
        "postgresql+psycopg://ann:hush hush@127.0.0.1:9/lasts",
        "postgresql+psycopg://ann@127.0.0.1:9/lasts?hush=1",
        "postgresql+psycopg:/ann:hush-hush@db/lasts",
        "postgresql+psycopg:ann:hush-hush@db/lasts",
        "postgresql:ann:hush-hush@db/lasts",
        "postgres:/ann:hush-hush@db/lasts",
    ],
)
def test_an_address_that_is_none_is_refused(address: str, footfit: Footfit) -> None:
    run = footfit("list-lasts", "--catalogue", address, "--verbose")
    assert (run.code, run.err.count("\n")) == (2, 1)
    assert "hush" not in run.err


def test_a_wrong_password_is_one_line_and_shown_nowhere(url: str, footfit: Footfit) -> None:
    fill(url, 1)
    wrong = with_password(url, "hush-hush")
    for mode in ((), ("--json",), ("--verbose",)):
        run = footfit("list-lasts", "--catalogue", wrong, *mode)
        assert (run.code, run.out, run.err.count("\n")) == (6, "", 1)
        assert "PGPASSWORD" in run.err
        assert "hush" not in run.err


def test_a_password_is_in_no_answer_and_on_no_page(
    url: str, footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    """Also if it is typed in the address, or comes from FOOTFIT_CATALOGUE."""
    typed = ("--catalogue", with_password(url, PASSWORD), "--json", "--verbose")
    page = tmp_path / "page.html"
    runs = [
        footfit("ingest-last", *LASTS[:1], *typed),
        footfit("match", foot, "-o", page, *typed),
        footfit("catalogue-info", *typed),
        footfit("check-catalogue", *typed),
        footfit("backup-catalogue", tmp_path / "b", *typed),
        footfit("show-last", "nobody", *typed),
        footfit("copy-catalogue", typed[1], tmp_path / "copy", "--json"),
    ]
    assert [run.code for run in runs] == [0, 0, 0, 0, 2, 4, 0]
    shown = "".join(run.out + run.err for run in runs) + page.read_text(encoding="utf-8")
    assert PASSWORD not in shown
    assert url in shown


def test_a_password_in_pgpass_is_used(
    url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "pgpass"
    file.write_text(f"127.0.0.1:*:*:shop:{PASSWORD}\n")
    file.chmod(0o600)
    monkeypatch.delenv("PGPASSWORD")
    monkeypatch.setenv("PGPASSFILE", str(file))
    fill(url, 1)


def test_a_server_that_is_not_there_is_code_6(footfit: Footfit) -> None:
    pytest.importorskip("psycopg")
    run = footfit("list-lasts", "--catalogue", "postgresql+psycopg://ann@127.0.0.1:9/lasts")
    assert (run.code, run.err.count("\n")) == (6, 1)
    assert "127.0.0.1:9/lasts" in run.err


def test_without_the_extra_a_line_says_how_to_install_it(
    footfit: Footfit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "psycopg", None)
    run = footfit("list-lasts", "--catalogue", "postgresql+psycopg://ann@127.0.0.1:9/lasts")
    assert (run.code, run.err.count("\n")) == (2, 1)
    assert "pip install 'footfit[postgres]'" in run.err


@pytest.fixture
def own_server(server: Server) -> Iterator[Server]:
    """A server that a test may stop; it needs the password of the other one."""
    with started_server() as started:
        yield started


def test_a_server_that_goes_away_in_the_middle(own_server: Server) -> None:
    """One line, code 6; what was printed is stored, and the run can be repeated."""
    url = own_server.database()
    command = [sys.executable, "-m", "footfit", "ingest-last", *LASTS, "--json"]
    command += ["--catalogue", url]
    running = subprocess.Popen(
        command, bufsize=0, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT
    )
    assert running.stdout is not None
    first = running.stdout.readline()  # without a buffer, which would keep other lines
    own_server.stop(at_once=True)
    rest, errors = running.communicate(timeout=60)
    assert running.returncode == 6
    error = json.loads(errors.splitlines()[-1])
    assert (error["code"], error["path"]) == ("catalogue_unreachable", url)
    assert b"Traceback" not in errors
    own_server.start()
    printed = {json.loads(line)["last"] for line in (first + rest).splitlines()}
    with open_catalogue(url) as catalogue:
        assert printed <= set(catalogue.names())
        assert catalogue.findings() == []
    again = subprocess.run(command, capture_output=True, check=True, cwd=ROOT)
    lines = map(json.loads, again.stdout.splitlines())
    states = {line["last"]: line["status"] for line in lines}
    assert len(states) == len(LASTS)
    assert {states[name] for name in printed} == {"unchanged"}


def test_a_server_that_is_gone_when_a_reader_asks(own_server: Server) -> None:
    url = own_server.database()
    fill(url, 1)
    with open_catalogue(url) as catalogue:
        own_server.stop(at_once=True)
        with pytest.raises(CatalogueUnreachable, match="run the command again"):
            catalogue.names()


def test_groups_of_lasts_and_single_ones_are_stored_alike(url: str, tmp_path: Path) -> None:
    """Keys, hashes and search blocks do not depend on how lasts came, nor on where they are."""
    lasts = [
        NewLast(records.last(f"last-{seed}", seed), records.mesh_copy(seed)) for seed in range(6)
    ]
    file = str(tmp_path / "lasts.footfit")
    for place in (url, file):
        with open_catalogue(place, write=True) as catalogue:
            list(catalogue.add_many(lasts[:3]))
            catalogue.add(*lasts[3])
            list(catalogue.add_many(lasts[4:]))
            assert catalogue.findings() == []
    assert content(url) == content(file)
