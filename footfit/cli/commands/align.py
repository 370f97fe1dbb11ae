"""``footfit align``: one comparable frame for any scan."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import AlignedScan


class MethodName(StrEnum):
    """How to align: footfit's own way, or the paper's, read consistently or literally."""

    footfit = "footfit"
    paper = "paper"
    paper_literal = "paper-literal"


def align(
    meshes: options.Meshes,
    output: Annotated[
        Path | None,
        options.file_to_write(
            "-o", "--output", help="Write the aligned mesh (.stl, .ply, .obj, .off), mm."
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        options.file_to_write(
            "--plot", help="Draw the mesh and its eigenvectors before and after (.svg, .png)."
        ),
    ] = None,
    method: Annotated[
        MethodName,
        typer.Option(
            "--method", help="footfit settles the pose by shape; the others are as printed."
        ),
    ] = MethodName.footfit,
    to: Annotated[
        str | None,
        typer.Option(
            "--to",
            metavar="LAST",
            show_default=False,
            help="Whose OM_E to use, else the reference's.",
        ),
    ] = None,
    side: options.Side = options.SideChoice.auto,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    split: options.Split = False,
    jobs: options.Jobs = 1,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Align scans: heel to toe along X, sole down, mm.

    Example: footfit align foot.stl -o aligned.stl --plot frames.svg
    """
    from functools import partial

    from footfit.cli.answers import Voice, only_one, sources_of, split_where_asked, told
    from footfit.cli.outputs import refuse_existing
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.batch.runs import outcomes
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.export import MESH_KINDS, PICTURE_KINDS
    from footfit.pipeline.library.lasts import alignment_reference
    from footfit.pipeline.scan.reading import aligned_source

    refuse_existing(output, force=force, kinds=MESH_KINDS)
    refuse_existing(plot, force=force, kinds=PICTURE_KINDS)
    reading = ReadingOptions(units.value, known_length, side.value)
    sources = split_where_asked(sources_of(meshes, format), reading, split=split)
    only_one(sources, output, plot)
    reference = alignment_reference(catalogue_path(catalogue), method.value, to)
    work = partial(aligned_source, reading=reading, method=method.value, reference=reference)
    code = told(
        outcomes(work, sources, jobs),
        Voice(json, quiet, len(sources)),
        then=lambda scan: write_alignment(scan, output, plot, force=force),
    )
    raise typer.Exit(code)


def write_alignment(
    scan: AlignedScan, output: Path | None, plot: Path | None, *, force: bool
) -> None:
    """Write the files that were asked for."""
    from footfit.cli.outputs import write_output
    from footfit.pipeline.export import PICTURE_KINDS, file_kind, mesh_bytes, method_vertices
    from footfit.report.pictures.figures import picture_bytes
    from footfit.report.pictures.frames_figure import frames_figure

    if output is not None:
        data = mesh_bytes(method_vertices(scan), scan.faces, output)
        write_output(output, data, force=force)
    if plot is not None:
        data = picture_bytes(frames_figure(scan), file_kind(plot, PICTURE_KINDS))
        write_output(plot, data, force=force)
