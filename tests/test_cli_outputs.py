"""Output files: whole or not at all, never over an existing one unasked."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

import pytest

from footfit.cli.outputs import (
    OutputFile,
    Outputs,
    folder_made,
    refuse_existing,
    write_output,
    write_outputs,
)
from footfit.errors import BadOption, NameTaken, OutputExists
from footfit.results import Library
from footfit.whole_files import give_name, partial_beside
from tests.conftest import Footfit


def test_a_file_is_written_whole_with_the_usual_permissions(tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    write_output(path, "größe", force=False)
    assert path.read_text(encoding="utf-8") == "größe"
    mask = os.umask(0)
    os.umask(mask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~mask
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_of_one_form_takes_any_name(tmp_path: Path) -> None:
    page = OutputFile(tmp_path / "page.html", (), lambda result, kind: f"<p>{result}{kind}</p>")
    picture = OutputFile(tmp_path / "page.svg", ("svg",), lambda _result, kind: kind)
    outputs = Outputs((page, picture))
    outputs.refuse(as_json=False)
    outputs.write("fits")
    assert (tmp_path / "page.html").read_text() == "<p>fits</p>"
    assert (tmp_path / "page.svg").read_text() == "svg"


def test_an_existing_file_needs_force(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_text("mine")
    with pytest.raises(OutputExists, match="--force"):
        write_output(path, "yours", force=False)
    assert path.read_text() == "mine"
    write_output(path, "yours", force=True)
    assert path.read_text() == "yours"
    assert list(tmp_path.iterdir()) == [path]


def test_several_files_are_written_all_or_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = tmp_path / "a.stl", tmp_path / "b.stl"
    calls: list[int] = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) > 1:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(BadOption, match=r"cannot be written: .*; make room on the disk") as refused:
        write_outputs({first: b"a", second: b"b"}, force=False)
    assert refused.value.path == str(second)
    assert list(tmp_path.iterdir()) == []
    monkeypatch.undo()
    write_outputs({first: b"a", second: b"b"}, force=False)
    assert sorted(tmp_path.iterdir()) == [first, second]


def test_a_folder_that_was_made_for_files_goes_if_none_is_written(tmp_path: Path) -> None:
    made, kept = tmp_path / "made", tmp_path / "kept"
    kept.mkdir()
    for folder in (made, kept):
        with pytest.raises(FileNotFoundError), folder_made(folder):
            (folder / "lost.stl").read_bytes()
    assert list(tmp_path.iterdir()) == [kept]
    with pytest.raises(BadOption, match="cannot be made"), folder_made(tmp_path / "a" / "b"):
        pass


def test_a_file_that_comes_while_ours_is_written_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.csv"
    monkeypatch.setattr(os, "fsync", lambda _descriptor: path.write_text("theirs"))
    with pytest.raises(OutputExists, match="--force"):
        write_output(path, "ours", force=False)
    assert path.read_text() == "theirs"
    assert list(tmp_path.iterdir()) == [path]


def test_what_cannot_be_written_is_refused_before_any_work(tmp_path: Path) -> None:
    with pytest.raises(BadOption, match="does not exist"):
        refuse_existing(tmp_path / "none" / "x.csv", force=True)
    with pytest.raises(BadOption, match="is a folder"):
        refuse_existing(tmp_path, force=True)
    refuse_existing(None, force=False)
    Outputs(csv=Path("-")).refuse(as_json=False)
    with pytest.raises(BadOption, match="both write to stdout"):
        Outputs(csv=Path("-")).refuse(as_json=True)


def test_a_failed_write_leaves_the_old_file_and_no_remains(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.csv"
    path.write_text("mine")

    def full(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(BadOption, match="No space left"):
        write_output(path, "yours", force=True)
    assert path.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [path]


def test_a_drive_without_links_permissions_and_folder_lists_takes_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As FAT on a stick, and some network drives; a file that comes meanwhile is kept there too."""
    fsync = os.fsync

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    def sync_of_files(descriptor: int) -> None:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, "Invalid argument")
        fsync(descriptor)

    monkeypatch.setattr(os, "link", refuse)
    monkeypatch.setattr(os, "chmod", refuse)
    monkeypatch.setattr(os, "fsync", sync_of_files)
    path = tmp_path / "x.csv"
    write_output(path, "first", force=False)
    assert path.read_text() == "first"
    write_output(path, "second", force=True)
    assert path.read_text() == "second"
    with partial_beside(path) as partial, pytest.raises(OutputExists):
        give_name(partial, path, replace=False)
    assert (path.read_text(), list(tmp_path.iterdir())) == ("second", [path])
    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(BadOption, match="not permitted"):
        write_output(tmp_path / "y.csv", "third", force=False)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    "arguments",
    [
        ("align", "FOOT", "-o", "FOOT", "--force"),
        ("measure", "FOOT", "--csv", "./FOOT", "--force"),
        ("measure", "both.stl#2", "FOOT", "--csv", "FOOT", "--force"),
        ("match", "FOOT", "--csv", "FOOT", "--force"),
        ("compare", "x.stl", "FOOT", "--html", "FOOT", "--force"),
        ("coverage", "feet.csv", "--csv", "./feet.csv", "--force"),
        ("coverage", "feet.csv", "--stock", "stock.csv", "--lasts-csv", "stock.csv", "--force"),
        ("measure", "FOOT", "--csv", "lasts.footfit", "--force"),
        ("compare", "FOOT", "x", "--html", "lasts.footfit", "--force"),
        ("match", "FOOT", "--html", "a.html", "--csv", "./a.html"),
        ("compare", "FOOT", "x", "--html", "a", "--csv", "a"),
        ("compare", "FOOT", "x", "--html", "-"),
        ("compare", "FOOT", "x", "--csv", "-", "--json"),
    ],
)
def test_no_output_replaces_a_scan_a_catalogue_or_another_output(
    arguments: tuple[str, ...],
    footfit: Footfit,
    foot: Path,
    catalogue: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "foot.stl").write_bytes(foot.read_bytes())
    (tmp_path / "feet.csv").write_text("id,length,ball_girth\na,250,240\n", encoding="utf-8")
    (tmp_path / "stock.csv").write_text("last,quantity\nderby-42,1\n", encoding="utf-8")
    kept = {path: path.read_bytes() for path in tmp_path.iterdir()}
    run = footfit(*(word.replace("FOOT", "foot.stl") for word in arguments))
    assert run.code == 2
    assert len(run.err.splitlines()) == 1
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == kept


@pytest.mark.parametrize("sign", ["n", "ü"])
def test_the_longest_name_that_a_folder_takes_is_written(sign: str, tmp_path: Path) -> None:
    path = tmp_path / (sign * (250 // len(sign.encode())) + ".csv")
    write_output(path, "first", force=False)
    write_output(path, "second", force=True)
    assert path.read_text() == "second"
    with pytest.raises(BadOption, match="too long"):
        write_output(path.with_name(path.name + "xx"), "third", force=False)
    assert list(tmp_path.iterdir()) == [path]


def test_what_goes_with_files_is_done_with_all_of_them_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, stored = tmp_path / "last.stl", []

    def refused() -> None:
        raise NameTaken("the same mesh is in the catalogue")

    with pytest.raises(NameTaken):
        write_outputs({path: b"a"}, force=False, then=refused)
    assert list(tmp_path.iterdir()) == []

    def full(_descriptor: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(BadOption, match="cannot be written"):
        write_outputs({path: b"a"}, force=False, then=lambda: stored.append(1))
    assert (stored, list(tmp_path.iterdir())) == ([], [])


@pytest.mark.parametrize(
    ("number", "step"),
    [
        (errno.EROFS, "name a file in a folder that you may write to"),
        (errno.EFBIG, "name a folder on a disk that takes larger files"),
    ],
)
def test_what_the_system_refuses_is_said_with_what_to_do(
    number: int, step: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(_descriptor: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(os, "fsync", refused)
    with pytest.raises(BadOption, match=f"cannot be written: {os.strerror(number)}; {step}"):
        write_outputs({tmp_path / "a.stl": b"a"}, force=False)


def test_a_csv_is_written_with_the_other_files_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = OutputFile(tmp_path / "page.html", (), lambda _result, _kind: "page")
    outputs = Outputs((page,), table=Library, csv=tmp_path / "table.csv")
    monkeypatch.setattr(Outputs, "csv_text", lambda *_: "a,b")
    assert len(outputs.write("result", with_csv=True)) == 2
    (tmp_path / "page.html").unlink()
    with pytest.raises(OutputExists):
        outputs.write("result", with_csv=True)
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize(
    "command",
    [
        ("customise", "foot.stl", "-o", "x.stl", "--html", "./x.stl"),
        ("customise", "foot.stl", "-o", "x.stl", "--plot", "q.svg", "--html", "q.svg"),
        ("compare-lasts", "a.stl", "b.stl", "--plot", "q.svg", "--html", "../{here}/q.svg"),
        ("coverage", "feet.csv", "--html", "c.html", "--cache", "c.html"),
        ("curvature", "foot.stl", "-o", "x.svg", "--plot", "x.svg"),
        ("match", "foot.stl", "--html", "p.html", "--sheet", "p.html"),
    ],
)
def test_no_command_writes_one_file_twice(
    command: tuple[str, ...], footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("foot.stl", "a.stl", "b.stl", "feet.csv"):
        (tmp_path / name).write_text("not read")
    run = footfit(*(part.format(here=tmp_path.name) for part in command))
    assert (run.code, "is named for two outputs; name two files" in run.err) == (2, True), run.err
    assert len(list(tmp_path.iterdir())) == 4
