"""``footfit compare-lasts``: how two lasts, or two revisions of one, differ."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def compare_lasts(
    first: str = options.argument("FIRST", "Give a last by its name, or by its mesh file."),
    second: str = options.argument("SECOND", "Give the other last, by its name or its mesh file."),
    tolerance: str | None = options.option(
        "--tolerance",
        "Allow so many mm by kind of measure. Else girth=2,length=1.5,width=1,height=1.5.",
        "KIND=MM,...",
        panel=options.ANSWER,
    ),
    plot: Path | None = options.output_file(
        "--plot", "Draw the sections of both lasts over each other (.svg, .png)."
    ),
    html: Path | None = options.output_file(
        "--html", "Write a page with both lasts in 3D that opens in any browser."
    ),
    output: Path | None = options.output_file(
        "--output",
        "Write the first last, coloured by the difference of the surfaces (.ply, .svg, .png).",
        "-o",
    ),
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.Reading,
    standing: options.Standing,
    mode: options.OutputMode,
) -> None:
    """Lay a last on the bottom of another one, and say how the two differ, measure by measure.

    A last of the other side is mirrored. The command ends with 7 if a measure is outside of its
    tolerance. --heel-height, --toe-spring and --platform count for both, which must be files.

    Example: footfit compare-lasts derby-42 returned.stl --tolerance girth=2,length=1.5,width=1
    """
    from footfit.api import files, last_making
    from footfit.cli.answers import answer_result, sources_of
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.progress import progress
    from footfit.errors import BadOption, CheckFailed
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.pipeline.last_making.tolerances import tolerances
    from footfit.pipeline.last_making.two_lasts import outside_words
    from footfit.report.pictures.heat_figure import HEAT_KINDS
    from footfit.results import LastDifference

    written = (
        OutputFile(output, HEAT_KINDS, files.mesh_file),
        OutputFile(plot, PICTURE_KINDS, files.picture),
        OutputFile(html, (), lambda difference, _: files.page(difference)),
    )
    outputs = Outputs(written, LastDifference, csv, force)
    outputs.refuse(as_json=mode.json)
    tolerances(tolerance)  # what is mistyped is refused before any work
    if "-" in (first, second):
        raise BadOption("compare-lasts reads two lasts, and stdin holds one: give two files")
    pair = [sources_of([mesh], reading, lasts, quiet=mode.quiet) for mesh in (first, second)]
    for mesh, sources in zip((first, second), pair, strict=True):
        if len(sources) != 1:
            raise BadOption(f"holds {len(sources)} meshes; name one last", mesh)
    outputs.keep([pair[0][0], pair[1][0]])
    with progress(mode) as bar:
        bar.show()
        asked = {**reading.keywords(), **standing.keywords()}
        difference = last_making.compare_lasts(pair[0][0], pair[1][0], tolerance=tolerance, **asked)
    answer_result(difference, mode, outputs)
    if difference.outside:
        raise CheckFailed(outside_words(difference), second)
