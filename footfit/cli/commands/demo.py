"""``footfit demo``: every step on the sample data, in a folder of its own."""

from __future__ import annotations

from pathlib import Path

import typer

from footfit.cli import options

CATALOGUE_NAME = "demo.footfit"


def demo(
    folder: Path = typer.Argument(
        Path("footfit-demo"), metavar="FOLDER", help="Choose the folder for the files of the demo."
    ),
    force: bool = options.FORCE,
    *,
    mode: options.OutputMode,
) -> object:
    """Ingest the sample lasts, match a sample foot and draw it, in a folder of its own.

    Example: footfit demo
    """
    from dataclasses import replace

    from footfit.api import files, scans
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.outputs import write_output
    from footfit.errors import GeometryRefused
    from footfit.pipeline.sample_data import sample_folder
    from footfit.results import DemoOutcome

    catalogue, samples = fresh_catalogue(folder, replace=force), sample_folder()
    lasts = open_catalogue(catalogue)
    ingested = lasts.ingest(manifest=samples / "lasts.csv", jobs=1)
    for outcome in ingested:
        if outcome.failure is not None:
            raise GeometryRefused(f"a sample last was refused: {outcome.failure}", outcome.path)
    middle = sorted(outcome.last or "" for outcome in ingested)[len(ingested) // 2]
    reference = lasts.set_reference(middle)
    foot = scans.flare(scans.sources(samples / "feet")[0])
    match = lasts.match(foot)
    steps = replace(mode, json=False, answers=not mode.json)
    for result in (*ingested, reference, foot.aligned, foot, match):
        tell(result, steps)
    written: dict[str, bytes | str] = {
        "aligned.stl": files.mesh_file(foot.aligned, "stl"),
        "frames.svg": files.picture(foot.aligned),
        "flare.svg": files.picture(foot),
        "report.html": files.page(match, catalogue),
    }
    for name, data in written.items():
        write_output(folder / name, data, force=force)
    outputs = (str(catalogue), *(str(folder / name) for name in written))
    best = match.candidates[0].last if match.candidates else None
    return DemoOutcome(str(folder), len(ingested), best, outputs)


def fresh_catalogue(folder: Path, *, replace: bool) -> Path:
    """The path of the demo's catalogue; an old demo's is deleted.

    Raises
    ------
    OutputExists
        The folder holds a demo already and ``replace`` is not given.
    BadOption
        The folder cannot be made.
    """
    from footfit.errors import BadOption, OutputExists

    catalogue = folder / CATALOGUE_NAME
    if folder.exists() and not folder.is_dir():
        raise BadOption("is a file; name a folder for the demo", str(folder))
    if catalogue.exists():
        if not replace:
            raise OutputExists("holds a demo already; add --force to replace it", str(folder))
        catalogue.unlink()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadOption(f"cannot be made: {error.strerror}", str(folder)) from error
    return catalogue
