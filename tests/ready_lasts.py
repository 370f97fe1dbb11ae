"""An ingest without meshes: an executor that answers with lasts that are measured already."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Executor, Future
from typing import Any

from footfit.catalogue.group_commit import NewLast
from footfit.errors import FootfitError
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.entries import Entry
from footfit.pipeline.library.ingest import ReadyLast
from footfit.results import LastRecord
from tests import records


def entry_of(record: LastRecord, seed: int) -> Entry:
    """The file of a record that ``records.last`` makes of a seed."""
    source = Source(f"{record.labels.name}.stl", f"scan {seed}".encode(), "stl")
    return Entry(source, record.labels, ReadingOptions())


class ReadyLasts(Executor):
    """Answers every file at once, with the last of its seed or with an error."""

    width = 3

    def __init__(self, answers: Iterable[tuple[Entry, LastRecord | FootfitError]]) -> None:
        self.answers = {entry.source.path: answer for entry, answer in answers}

    def submit(self, _: Callable[..., Any], /, *args: Any, **__: Any) -> Future[Any]:
        """The answer for an entry; nothing is called."""
        future: Future[Any] = Future()
        answer = self.answers[args[0].source.path]
        if isinstance(answer, FootfitError):
            future.set_exception(answer)
        else:
            copy = records.mesh_copy(answer.info.vertices % 2)
            future.set_result(ReadyLast(answer.info.sha256, NewLast(answer, copy)))
        return future
