"""``footfit compare``: one foot in one last, section by section and surface against surface."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, Reading, with_groups


@with_groups
def compare(
    foot: Annotated[
        str,
        typer.Argument(
            metavar="FOOT",
            show_default=False,
            help="The foot's mesh file; - reads it from stdin.",
        ),
    ],
    last: Annotated[
        str,
        typer.Argument(
            metavar="LAST",
            show_default=False,
            help="A last of the catalogue by name, or a mesh file.",
        ),
    ],
    output: Annotated[
        Path | None,
        options.file_to_write(
            "-o",
            "--output",
            help="Write the foot in the last's frame coloured by the room: .ply, or a picture.",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        options.file_to_write(
            "--plot", help="Draw the sections of the foot over the last's (.svg, .png)."
        ),
    ] = None,
    html: Annotated[
        Path | None,
        options.file_to_write(
            "--html", help="Write a report with a 3D view that opens in any browser."
        ),
    ] = None,
    csv: options.Csv = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    reading: Reading,
    mode: OutputMode,
) -> None:
    """Lay a foot into a last: the room around it in mm, zone by zone and section by section.

    Example: footfit compare foot.stl derby-42 --html report.html
    """
    from dataclasses import replace

    from footfit import api
    from footfit.cli.answers import sources_of, tell
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.settings import catalogue_at
    from footfit.errors import BadOption
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.report.pictures.heat_figure import HEAT_KINDS
    from footfit.results import Comparison

    files = (
        OutputFile(output, HEAT_KINDS, api.mesh_file),
        OutputFile(plot, PICTURE_KINDS, api.picture),
        OutputFile(html, (), lambda comparison, _: api.page(comparison)),
    )
    outputs = Outputs(files, Comparison, csv, force)
    outputs.refuse(as_json=False)
    sources = sources_of([foot], reading)
    if len(sources) != 1:
        raise BadOption(f"holds {len(sources)} meshes; name one foot", foot)
    if Path(last).is_file():
        comparison = api.compare(sources[0], last, **reading.keywords())
    else:
        comparison = catalogue_at(catalogue).compare(sources[0], last, **reading.keywords())
    outputs.write(comparison)
    tell(comparison, replace(mode, answers=csv != options.STDOUT))
    outputs.write_csv([comparison])
