"""``footfit curvature``: the concentrated curvature of a surface, per vertex."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import SurfaceCurvature


def curvature(
    meshes: options.Meshes,
    output: Annotated[
        Path | None,
        options.file_to_write(
            "-o",
            "--output",
            help="Write k1, k2, mean, gaussian per vertex (.ply coloured by the mean, .npz).",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        options.file_to_write("--plot", help="Draw the mean curvature on the mesh (.svg, .png)."),
    ] = None,
    radius: Annotated[
        float | None,
        typer.Option(
            "--radius",
            metavar="MM",
            min=0,
            show_default=False,
            help="The scale in mm; 0 is the paper's one ring. Else 6 % of the longest extent.",
        ),
    ] = None,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    jobs: options.Jobs = 1,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Concentrated curvature of a surface at every vertex, in 1/mm.

    Example: footfit curvature foot.stl -o curvature.ply --plot curvature.png
    """
    from functools import partial

    from footfit.cli.answers import Voice, only_one, sources_of, told
    from footfit.cli.outputs import refuse_existing
    from footfit.pipeline.batch.runs import outcomes
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.export import CURVATURE_KINDS, PICTURE_KINDS
    from footfit.pipeline.scan.reading import curvature_source

    sources = sources_of(meshes, format)
    only_one(sources, output, plot)
    refuse_existing(output, force=force, kinds=CURVATURE_KINDS)
    refuse_existing(plot, force=force, kinds=PICTURE_KINDS)
    reading = ReadingOptions(units.value, known_length)
    named = None if output is None else str(output)
    work = partial(curvature_source, reading=reading, radius_mm=radius, output=named)
    code = told(
        outcomes(work, sources, jobs),
        Voice(json, quiet, len(sources)),
        then=lambda values: write_curvature(values, output, plot, force=force),
    )
    raise typer.Exit(code)


def write_curvature(
    values: SurfaceCurvature, output: Path | None, plot: Path | None, *, force: bool
) -> None:
    """Write the files that were asked for."""
    from footfit.cli.outputs import write_output
    from footfit.pipeline.drawables import canonical_view
    from footfit.pipeline.export import PICTURE_KINDS, curvature_bytes, file_kind
    from footfit.report.pictures.curvature_figure import curvature_colours, curvature_figure
    from footfit.report.pictures.figures import picture_bytes

    if output is not None:
        is_ply = output.suffix.lower() == ".ply"
        colours = curvature_colours(values) if is_ply else None
        write_output(output, curvature_bytes(values, output, colours), force=force)
    if plot is not None:
        data = picture_bytes(
            curvature_figure(values, canonical_view(values)), file_kind(plot, PICTURE_KINDS)
        )
        write_output(plot, data, force=force)
