"""A PostgreSQL server of the test's own on 127.0.0.1, and databases in it."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

import pytest

PASSWORD = "s3cret-of-the-test"
USER = "shop"
PROGRAMS = sorted(Path("/usr/lib/postgresql").glob("*/bin")) + sorted(
    Path("/usr/local").glob("pgsql*/bin")
)
_numbers = count(1)


def programs() -> Path:
    """The folder of PostgreSQL's programs; the test is skipped where there is none."""
    beside = shutil.which("initdb")
    folders = [*PROGRAMS, *([Path(beside).resolve().parent] if beside else [])]
    if not folders:
        pytest.skip("there is no PostgreSQL: apt-get install postgresql")
    if os.geteuid() == 0 and (shutil.which("runuser") is None or not _has_user("postgres")):
        pytest.skip("PostgreSQL does not run as root, and there is no user postgres")
    return folders[-1]


def _has_user(name: str) -> bool:
    import pwd

    try:
        pwd.getpwnam(name)
    except KeyError:
        return False
    return True


@dataclass
class Server:
    """A server with password logins; ``folder`` holds its data."""

    folder: Path
    port: int
    process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it, and wait until it takes logins."""
        settings = {
            "listen_addresses": "127.0.0.1",
            "unix_socket_directories": str(self.folder),
            "fsync": "off",
            "max_connections": "30",
        }
        options = [word for item in settings.items() for word in ("-c", "=".join(item))]
        command = [str(programs() / "postgres"), "-D", str(self.folder / "data")]
        self.process = subprocess.Popen(
            _as_postgres([*command, "-p", str(self.port), *options]),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=self.folder,
        )
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            with suppress(Exception), self.session():
                return
            time.sleep(0.05)
        raise AssertionError("the server did not start")

    def stop(self, *, at_once: bool = False) -> None:
        """End it; ``at_once`` as a power cut would, without a word to its clients."""
        pid = (self.folder / "data" / "postmaster.pid").read_text().splitlines()[0]
        os.kill(int(pid), signal.SIGQUIT if at_once else signal.SIGINT)
        assert self.process is not None
        self.process.wait(20)

    def session(self, database: str = "postgres") -> Any:
        """A session of the owner."""
        import psycopg

        return psycopg.connect(
            host="127.0.0.1",
            port=self.port,
            user=USER,
            password=PASSWORD,
            dbname=database,
            autocommit=True,
        )

    def database(self) -> str:
        """The address of a new, empty database; the password is not in it."""
        name = f"lasts{next(_numbers)}"
        with self.session() as session:
            session.execute(f"CREATE DATABASE {name}")
        return self.address(name)

    def address(self, database: str, user: str = USER) -> str:
        """The address of a database."""
        return f"postgresql+psycopg://{user}@127.0.0.1:{self.port}/{database}"


@contextmanager
def started_server() -> Iterator[Server]:
    """A new server, ended and removed after the block."""
    bin_folder = programs()
    folder = Path(tempfile.mkdtemp(prefix="footfit-pg-"))
    try:
        (folder / "password").write_text(PASSWORD)
        if os.geteuid() == 0:
            shutil.chown(folder, "postgres", "postgres")
            shutil.chown(folder / "password", "postgres", "postgres")
        init = [str(bin_folder / "initdb"), "-D", str(folder / "data"), "-U", USER, "-E", "UTF8"]
        init += ["--locale=C", "--no-sync", "-A", "scram-sha-256", f"--pwfile={folder}/password"]
        subprocess.run(_as_postgres(init), check=True, capture_output=True, cwd=folder)
        server = Server(folder, _free_port())
        server.start()
        try:
            yield server
        finally:
            if server.process is not None and server.process.poll() is None:
                server.stop(at_once=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _as_postgres(command: list[str]) -> list[str]:
    """A command of the user postgres, if this is root: PostgreSQL refuses to run as root."""
    return ["runuser", "-u", "postgres", "--", *command] if os.geteuid() == 0 else command


def _free_port() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])
