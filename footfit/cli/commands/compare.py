"""``footfit compare``: one foot in one last, by zone and by section."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def compare(
    foot: str = options.argument(
        "FOOT", "Give the mesh file of the foot, the name of a last, or - to read stdin."
    ),
    last: str = options.argument(
        "LAST", "Give a last by its name in the catalogue, or by its mesh file."
    ),
    output: Path | None = options.output_file(
        "--output",
        "Write the foot in the last's frame, coloured by the clearance (.ply, .svg, .png).",
        "-o",
    ),
    plot: Path | None = options.output_file(
        "--plot", "Draw the sections of the foot over those of the last (.svg, .png)."
    ),
    html: Path | None = options.output_file(
        "--html", "Write a page with a 3D view that opens in any browser."
    ),
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.FootReading,
    standing: options.Standing,
    mode: options.OutputMode,
) -> None:
    """Put a foot into a last and measure the clearance in mm, zone by zone and section by section.

    --heel-height, --toe-spring and --platform are for a LAST that is a file. A stored last has
    labels of its own.

    ± is the spread of a second scan of both, and of what a heel changes. The JSON and the CSV
    have the total ± too, which also holds what is known of the trueness.

    Example: footfit compare foot.stl derby-42 --html report.html
    """
    from footfit.api import files, scans
    from footfit.cli.answers import answer_result, say_hidden_lasts, sources_of
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.progress import progress
    from footfit.errors import BadOption, NoCatalogue, UnknownLast, UnreadableFile
    from footfit.pipeline.batch.sources import Source
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.pipeline.library.named_lasts import is_bare
    from footfit.report.pictures.heat_figure import HEAT_KINDS
    from footfit.results import Comparison

    written = (
        OutputFile(output, HEAT_KINDS, files.mesh_file),
        OutputFile(plot, PICTURE_KINDS, files.picture),
        OutputFile(html, (), lambda comparison, _: files.page(comparison)),
    )
    outputs = Outputs(written, Comparison, csv, force)
    outputs.refuse(as_json=mode.json)
    sources = sources_of([foot], reading, lasts, quiet=mode.quiet)
    if len(sources) != 1:
        raise BadOption(f"holds {len(sources)} meshes; name one foot", foot)
    outputs.keep([*sources, Source(last)])
    is_file = Path(last).is_file()
    if is_file:
        say_hidden_lasts([last], lasts, quiet=mode.quiet)
    asked = {**reading.keywords(), **standing.keywords()}
    with progress(mode) as bar:
        bar.show()
        if is_file:
            comparison = scans.compare(sources[0], last, **asked)
        else:
            try:
                comparison = lasts.open().compare(sources[0], last, **asked)
            except (UnknownLast, NoCatalogue) as error:
                if is_bare(last):
                    raise
                raise UnreadableFile("there is no such file: check the path", last) from error
    answer_result(comparison, mode, outputs)
