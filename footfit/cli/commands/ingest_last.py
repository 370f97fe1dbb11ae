"""``footfit ingest-last``: scans of lasts into the catalogue."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import typer

from footfit.cli import options

LABELS = "What people say of the last"
KeepMesh = Literal["compact", "full"]


def _label(flag: str, metavar: str, text: str) -> Any:
    return options.option(flag, text, metavar, panel=LABELS)


def ingest_last(
    paths: list[str] | None = options.argument(
        "PATH",
        "Give scans of lasts: files, folders or globs. Else the manifest names them.",
        default=None,
    ),
    name: str | None = _label(
        "--name", "N", "Name the last. Without it the name comes from the file."
    ),
    manifest: Path | None = _label(
        "--manifest",
        "CSV",
        "Give a CSV with labels for each file: path, name, style, size, size_system, ...",
    ),
    style: str | None = _label("--style", "S", "Set the style, such as derby."),
    size: str | None = _label(
        "--size", "42", "Set the size as it is marked. footfit compares it with the length."
    ),
    size_system: str | None = _label(
        "--size-system", "eu", "Set the system of the size, such as eu or uk."
    ),
    width_label: str | None = _label("--width-label", "G", "Set the width as it is marked."),
    family: str | None = _label(
        "--family", "F", "Set the family: the lasts of one model in all sizes and widths."
    ),
    replace: bool = options.switch("--replace", "Replace a stored last of the same name."),
    dry_run: bool = options.switch("--dry-run", "Store nothing; say what would be stored."),
    keep_mesh: KeepMesh | None = options.option(
        "--keep-mesh",
        "Keep a compact copy of each mesh, or the full mesh, which custom lasts need."
        " Without it the copy is compact, unless a full one is replaced.",
        default=None,
    ),
    *,
    lasts: options.Lasts,
    reading: options.Reading,
    standing: options.Standing,
    crew: options.Crew,
    mode: options.OutputMode,
) -> None:
    """Read, align, measure and store lasts. A printed line means that the last is stored.

    You can run it again: it stores nothing twice.

    Example: footfit ingest-last lasts/ --manifest lasts.csv --jobs 2
    """
    from dataclasses import replace as changed

    from footfit.cli.answers import failures_last, sources_of, tell
    from footfit.cli.console import error_line, say, say_notices
    from footfit.cli.notices import Notices
    from footfit.cli.progress import progress
    from footfit.cli.signals import LISTENER
    from footfit.errors import BadManifest, BadOption
    from footfit.pipeline.batch import manifest as manifests
    from footfit.pipeline.batch.runs import common_code
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.library.entries import entries, labelled_beside, unused_rows
    from footfit.results import LastLabels

    given: dict[str, Any] = {
        label: manifests.label_mm(value, label) for label, value in standing.keywords().items()
    }
    texts = {"name": name, "style": style, "size": size, "size-system": size_system}
    texts |= {"width-label": width_label, "family": family}
    for flag, text in texts.items():
        if text is not None and not text.strip():
            raise BadOption(f"--{flag} is empty (an unset variable?); leave it out, or fill it in")
    labels = LastLabels(name or "", style, size, size_system, width_label, family=family, **given)
    rows = manifests.read_manifest(manifest) if manifest else []
    if manifest and not rows:
        raise BadManifest("has no line with a last; add one for each file", str(manifest))
    sources = (
        sources_of(paths, reading, sides_given=bool(manifest), quiet=mode.quiet) if paths else []
    )
    batch = entries(
        sources, rows, labels, ReadingOptions(**reading.keywords(), **standing.keywords())
    )
    mode = changed(mode, total=len(batch))
    say_notices(unused_rows(batch, rows), str(manifest), quiet=mode.quiet)
    say_notices(labelled_beside(batch, rows), None, quiet=mode.quiet)
    refused: list[int] = []
    warned = 0
    catalogue, notices = lasts.open_to_make(dry_run=dry_run), Notices(mode)
    with (
        crew.at_work() as jobs,
        reader_required(),
        failures_last(mode) as tell_failure,
        progress(mode) as bar,
    ):
        outcomes = catalogue.ingest_each(
            batch,
            replace=replace,
            dry_run=dry_run,
            jobs=jobs,
            keep_mesh=keep_mesh,
            hold_signals=LISTENER.hold,
        )
        for outcome in bar.items(outcomes):
            tell(outcome, mode, notices)
            warned += outcome.status != "unchanged" and bool(outcome.warnings)
            if outcome.failure is not None:
                refused.append(int(outcome.failure.exit))
                tell_failure(error_line(outcome.failure, as_json=mode.json, verbose=mode.verbose))
        notices.close()
        if warned:
            marked = "footfit list-lasts marks them"
            words = f"{catalogue.path}: {warned} of {mode.total} lasts have warnings; {marked}"
            say(words, quiet=mode.quiet)
        if dry_run:
            say(f"{catalogue.path}: a dry run, nothing was stored", quiet=mode.quiet)
    raise typer.Exit(common_code(refused))


@contextmanager
def reader_required() -> Iterator[None]:
    """Fail if nobody reads the answers any more: the batch is not done, so exit 0 would be wrong.

    Raises
    ------
    BadOption
        The reader of stdout has gone.
    """
    from footfit.cli.console import ReaderGone
    from footfit.errors import BadOption

    try:
        yield
    except ReaderGone as error:
        words = (
            "nobody reads the answers any more; what is stored is complete: run the command again"
        )
        raise BadOption(words) from error
