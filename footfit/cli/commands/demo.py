"""``footfit demo``: the whole path on the sample data, in a folder of its own."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.pipeline.demo import Demonstration


def demo(
    folder: Annotated[
        Path, typer.Argument(metavar="FOLDER", help="Where to put the demo's files.")
    ] = Path("footfit-demo"),
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Ingest the sample lasts, match a sample foot, draw it: in FOLDER, away from your catalogue.

    Example: footfit demo
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.outputs import write_output
    from footfit.pipeline.demo import demonstrate
    from footfit.results import DemoOutcome

    shown = demonstrate(folder, replace=force)
    steps = Voice(as_json=False, quiet=quiet, answers=not json)
    for outcome in shown.ingested:
        tell(outcome, steps)
    tell(shown.reference, steps)
    tell(shown.foot.aligned, steps)
    tell(shown.foot, steps)
    tell(shown.match, steps)
    files = demo_files(shown)
    for name, data in files.items():
        write_output(folder / name, data, force=force)
    outputs = (str(shown.catalogue), *(str(folder / name) for name in files))
    best = shown.match.candidates[0].last if shown.match.candidates else None
    said = DemoOutcome(str(folder), len(shown.ingested), best, outputs)
    tell(said, Voice(json, quiet))


def demo_files(shown: Demonstration) -> dict[str, bytes | str]:
    """The demo's files by name, the report last."""
    from footfit.pipeline.drawables import best_comparisons, candidate_shapes
    from footfit.pipeline.export import mesh_bytes
    from footfit.report.page.match_page import match_report
    from footfit.report.pictures.figures import picture_bytes
    from footfit.report.pictures.flare_figure import flare_figure
    from footfit.report.pictures.frames_figure import frames_figure

    aligned, match = shown.foot.aligned, shown.match
    drawn = candidate_shapes(shown.catalogue, match), best_comparisons(shown.catalogue, match)
    return {
        "aligned.stl": mesh_bytes(aligned.vertices_mm, aligned.faces, Path("aligned.stl")),
        "frames.svg": picture_bytes(frames_figure(aligned), "svg"),
        "flare.svg": picture_bytes(flare_figure(shown.foot), "svg"),
        "report.html": match_report(match, *drawn),
    }
