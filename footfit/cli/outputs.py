"""Output files: written under another name and renamed; a file is only replaced with --force."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Sized
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from footfit.cli.console import answer, say
from footfit.cli.options import STDOUT
from footfit.errors import BadOption, CatalogueUnusable, FootfitError
from footfit.pipeline.export import file_kind
from footfit.whole_files import (
    give_name,
    partial_beside,
    require_folder,
    require_free,
    safe_file_name,
    sync,
)

if TYPE_CHECKING:
    from footfit.pipeline.batch.sources import Source


READ_TOO = "is read by this command too; name another file to write"


@dataclass(frozen=True, slots=True)
class OutputFile:
    """A file to write for one result, if there is a ``path``.

    ``content`` makes it from the result and the suffix of the path, which is one of ``kinds``.
    Without ``kinds`` the file has one form, and any name.

    A path that is a folder, or that has no suffix and does not exist, is a folder for the files of
    many results: each has the name of what it is of, with a ``tag``, and the first of ``kinds``.
    """

    path: Path | None
    kinds: tuple[str, ...]
    content: Callable[[Any, str], bytes | str]
    tag: str = ""

    @property
    def is_folder(self) -> bool:
        """Whether the path is a folder for files."""
        if self.path is None or not self.kinds:
            return False
        return self.path.is_dir() or not (self.path.suffix or self.path.exists())

    def target(self, stem: str) -> Path:
        """The file of a result that is named so."""
        assert self.path is not None
        if not self.is_folder:
            return self.path
        return self.path / safe_file_name(stem, f"{self.tag}.{self.kinds[0]}")


@dataclass(frozen=True, slots=True)
class Outputs:
    """The files that a command writes: ``files`` for a single result, a CSV for all tables.

    ``as_table`` makes the table of a result, ``failed_table`` that of an item that failed.
    """

    files: tuple[OutputFile, ...] = ()
    table: type[Any] | None = None
    csv: Path | None = None
    force: bool = False
    as_table: Callable[[Any], Any] = lambda result: result
    failed_table: Callable[[Any, FootfitError], Any] | None = None
    stems: tuple[str, ...] = ()

    def refuse(self, *, as_json: bool) -> None:
        """Stop before any work if a file could not be written at the end.

        Raises
        ------
        OutputExists, BadOption
            As `refuse_existing`; also if ``--csv -`` and ``--json`` are given together, or if two
            outputs have one name.
        """
        for file in self.files:
            if file.path is not None and file.is_folder:
                require_folder(file.path)
            else:
                refuse_existing(file.path, force=self.force, kinds=file.kinds)
        if self.csv == STDOUT and as_json:
            raise BadOption("--csv - and --json both write to stdout; give --csv a file")
        if self.csv != STDOUT:
            refuse_existing(self.csv, force=self.force)
        refuse_twice(self.paths)

    @property
    def paths(self) -> list[Path]:
        """Every file that is written, as far as its name is known."""
        paths = [] if self.csv is None or self.csv == STDOUT else [self.csv]
        for file in self.files:
            if file.path is not None:
                stems = self.stems if file.is_folder else ("",)
                paths += [file.target(stem) for stem in stems]
        return paths

    def placed(self, stems: Sequence[str], sources: Iterable[Source], unless: str = "") -> Outputs:
        """The outputs of results that are named so, in this order, made from the sources.

        Raises
        ------
        OutputExists, BadOption
            A file would replace another one: one that is there, the scan, or that of another
            result.
        """
        self.require_one(stems, unless)
        named = replace(self, stems=tuple(stems))
        named.keep(sources)
        taken: dict[str, str] = {}
        for file in self.files if len(stems) else ():
            for stem in stems if file.is_folder else ():
                target = file.target(stem)
                other = taken.setdefault(str(target.absolute()).casefold(), stem)
                if other is not stem:
                    words = f"would be the file of both {other!r} and {stem!r}: rename one of them"
                    raise BadOption(words, str(target))
                if target.parent.is_dir():
                    refuse_existing(target, force=self.force)
        return named

    def keep(self, sources: Iterable[Source]) -> None:
        """Refuse an output that would replace one of the meshes that are read.

        Raises
        ------
        BadOption
            The scan would be lost, also with --force.
        """
        names = (source.path or "" for source in sources)
        read = (name if Path(name).exists() else name.rpartition("#")[0] for name in names)
        refuse_inputs(map(str, self.paths), read)

    def require_one(self, meshes: Sized, unless: str = "") -> None:
        """Refuse one file for several meshes; ``unless`` names another solution.

        Raises
        ------
        BadOption
            The meshes would be written over one another.
        """
        single = [file.path for file in self.files if file.path and not file.is_folder]
        if single and len(meshes) != 1:
            words = f"is one file and there are {len(meshes)} meshes; name a folder"
            words += f" ({single[0].parent / single[0].stem}/)"
            raise BadOption(f"{words}, or {unless}" if unless else words, str(single[0]))

    @property
    def writes_files(self) -> bool:
        """Whether a result has a file of its own."""
        return any(file.path is not None for file in self.files)

    def write(self, result: Any, number: int = 0, *, with_csv: bool = False) -> list[Path]:
        """Write the files of a result, once the content of all is there; return their paths.

        ``number`` is the result's place among all. A single result has its CSV among its files.
        """
        contents: list[tuple[Path, bytes | str]] = []
        if with_csv and self.csv is not None and self.csv != STDOUT:
            contents.append((self.csv, self.csv_text([result])))
        for file in self.files:
            if file.path is not None:
                target = file.target(self.stems[number] if self.stems else "")
                kind = file_kind(target, file.kinds) if file.kinds else ""
                contents.append((target, file.content(result, kind)))
        with ExitStack() as folders:
            for path, _ in contents:
                folders.enter_context(folder_made(path.parent))
            write_outputs(dict(contents), force=self.force)
        return [path for path, _ in contents]

    def csv_text(self, results: Iterable[Any]) -> str:
        """The tables as CSV."""
        from footfit.report.csv import csv_text

        assert self.table is not None
        return csv_text(self.table, results)

    def write_csv(self, results: Iterable[Any]) -> list[Path]:
        """Write the tables, to stdout or to a file whose path is returned."""
        if self.csv is None or self.table is None:
            return []
        text = self.csv_text(results)
        if self.csv == STDOUT:
            answer(text)
            return []
        write_output(self.csv, text, force=self.force)
        return [self.csv]


def say_written(paths: Iterable[Path], *, quiet: bool) -> None:
    """Write a line for each file that was written."""
    for path in paths:
        say(f"wrote {path}", quiet=quiet)


def refuse_twice(paths: Iterable[Path]) -> None:
    """Refuse one file for two outputs, however its path is written.

    Raises
    ------
    BadOption
        One output would take the place of the other.
    """
    seen = set()
    for path in paths:
        if path.resolve() in seen:
            raise BadOption("is named for two outputs; name two files", str(path))
        seen.add(path.resolve())


def file_id(path: Path) -> tuple[int, int]:
    """What two paths of one file have in common."""
    known = path.stat()
    return known.st_dev, known.st_ino


def refuse_inputs(outputs: Iterable[str], inputs: Iterable[str]) -> None:
    """Refuse an output that is there and is one of the inputs, also with --force.

    Raises
    ------
    BadOption
        The input would be lost.
    """
    there = {known: name for name in outputs if (known := _known_file(name)) is not None}
    for name in inputs if there else ():
        known = _known_file(name)
        if known in there and not _is_catalogue(Path(there[known])):  # it has its own words
            raise BadOption(READ_TOO, there[known])


def _known_file(name: str) -> tuple[int, int] | None:
    """The `file_id` of a name, if it is that of a file."""
    try:
        return file_id(Path(name)) if Path(name).is_file() else None
    except (OSError, ValueError):  # such as a name that is too long
        return None


@contextmanager
def folder_made(folder: Path) -> Iterator[None]:
    """Make a folder for outputs, if it is not there; remove it again if nothing can be written.

    Raises
    ------
    BadOption
        The system refuses.
    """
    is_new = not folder.exists()
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise BadOption(f"the folder cannot be made: {error.strerror}", str(folder)) from error
    try:
        yield
    except BaseException:
        with suppress(OSError):  # it holds a file
            if is_new:
                folder.rmdir()
        raise


def refuse_existing(path: Path | None, *, force: bool, kinds: tuple[str, ...] = ()) -> None:
    """Stop before any work if an output could not be written at the end.

    ``kinds`` are the suffixes that the output may have; without ``kinds`` it may have any.

    Raises
    ------
    OutputExists
        The file exists and ``force`` is not given.
    BadOption
        The folder does not exist, the path is a folder or not valid, or the suffix is wrong; or
        the file is a catalogue, which no --force replaces.
    """
    if path is None:
        return
    try:
        require_free(path, replace=force)
    except OSError as error:  # such as a name that is too long
        raise _not_written(error, path) from error
    if kinds:
        file_kind(path, kinds)
    if _is_catalogue(path):
        raise BadOption("is a catalogue of lasts; name another file to write", str(path))


def _is_catalogue(path: Path) -> bool:
    from footfit.catalogue.file.file_signature import kind_of_file

    try:
        return path.exists() and kind_of_file(path) in ("catalogue", "interrupted")
    except CatalogueUnusable:
        return False


def write_output(path: Path, data: bytes | str, *, force: bool) -> None:
    """Write the whole of ``data`` to ``path``, or nothing.

    Raises
    ------
    OutputExists, BadOption
        As `refuse_existing`; also if the system refuses to write.
    """
    write_outputs({path: data}, force=force)


def write_outputs(
    contents: Mapping[Path, bytes | str],
    *,
    force: bool,
    then: Callable[[], object] = lambda: None,
) -> None:
    """Write all files, or none: each gets its name when all are on the disk.

    What goes with the files, such as storing a last, is done by ``then`` before they get their
    names. If it fails, no file is written; if a file cannot be written, it is not done.

    Raises
    ------
    OutputExists, BadOption
        As `write_output`.
    """
    with ExitStack() as partials:
        complete: dict[Path, Path] = {}
        for path, data in contents.items():
            refuse_existing(path, force=force)
            with _refused_by_system(path):
                complete[path] = partials.enter_context(partial_beside(path))
                complete[path].write_bytes(data.encode("utf-8") if isinstance(data, str) else data)
                sync(complete[path])
        then()
        for path, partial in complete.items():
            with _refused_by_system(path):
                give_name(partial, path, replace=force)


NEXT_STEP = {
    errno.ENOSPC: "make room on the disk, or name a folder on another one",
    errno.EDQUOT: "make room on the disk, or name a folder on another one",
    errno.EFBIG: "name a folder on a disk that takes larger files, or raise the limit (ulimit -f)",
    errno.ENAMETOOLONG: "give a shorter name",
}
"""What to do about what the system refuses; anything else goes away in another folder."""


def _not_written(error: OSError, path: Path) -> BadOption:
    """What the system refused, and what to do."""
    step = NEXT_STEP.get(error.errno or 0, "name a file in a folder that you may write to")
    return BadOption(f"cannot be written: {error.strerror}; {step}", str(path))


@contextmanager
def _refused_by_system(path: Path) -> Iterator[None]:
    """Say what the system refused, and of which file."""
    try:
        yield
    except OSError as error:
        raise _not_written(error, path) from error
