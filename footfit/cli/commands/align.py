"""``footfit align``: one comparable frame for any scan."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options
from footfit.cli.option_groups import Batch, OutputMode, Reading, with_groups


class MethodName(StrEnum):
    """How to align: footfit's own way, or the paper's, read consistently or literally."""

    footfit = "footfit"
    paper = "paper"
    paper_literal = "paper-literal"


@with_groups
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
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    reading: Reading,
    batch: Batch,
    mode: OutputMode,
) -> None:
    """Align scans: heel to toe along X, sole down, mm.

    Example: footfit align foot.stl -o aligned.stl --plot frames.svg
    """
    from footfit import api
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.settings import catalogue_at
    from footfit.pipeline.export import MESH_KINDS, PICTURE_KINDS

    mesh, picture = (output, MESH_KINDS, api.mesh_file), (plot, PICTURE_KINDS, api.picture)
    outputs = Outputs((OutputFile(*mesh), OutputFile(*picture)), force=force)
    reference = catalogue_at(catalogue).reference(to, method.value)
    chosen = {"method": method.value, "reference": reference}
    answer_scans(api.align, meshes, reading, batch, mode, outputs, **chosen)
