"""``footfit demo``: every step on the sample data, in a folder of its own."""

from __future__ import annotations

from pathlib import Path

import typer

from footfit.cli import options


def demo(
    folder: Path = typer.Argument(
        Path("footfit-demo"), metavar="FOLDER", help="Choose the folder for the files of the demo."
    ),
    force: bool = options.FORCE,
    *,
    mode: options.OutputMode,
) -> None:
    """Ingest the sample lasts, match a sample foot and draw it, in a folder of its own.

    Example: footfit demo
    """
    from dataclasses import replace

    from footfit.api import files
    from footfit.cli.answers import tell
    from footfit.cli.outputs import write_output
    from footfit.pipeline.demo import demonstrate
    from footfit.results import DemoOutcome

    shown = demonstrate(folder, replace=force)
    steps = replace(mode, json=False, answers=not mode.json)
    for result in (*shown.ingested, shown.reference, shown.foot.aligned, shown.foot, shown.match):
        tell(result, steps)
    written: dict[str, bytes | str] = {
        "aligned.stl": files.mesh_file(shown.foot.aligned, "stl"),
        "frames.svg": files.picture(shown.foot.aligned),
        "flare.svg": files.picture(shown.foot),
        "report.html": files.page(shown.match, shown.catalogue),
    }
    for name, data in written.items():
        write_output(folder / name, data, force=force)
    outputs = (str(shown.catalogue), *(str(folder / name) for name in written))
    best = shown.match.candidates[0].last if shown.match.candidates else None
    tell(DemoOutcome(str(folder), len(shown.ingested), best, outputs), mode)
