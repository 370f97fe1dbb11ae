"""``footfit align``: one comparable frame for any scan."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options


class MethodName(StrEnum):
    """How to align: footfit's own way, or the paper's, read consistently or literally."""

    footfit = "footfit"
    paper = "paper"
    paper_literal = "paper-literal"


def align(
    meshes: options.Meshes,
    output: Annotated[
        Path | None,
        options.output_file(
            "--output", "Write the aligned mesh (.stl, .ply, .obj, .off), mm.", "-o"
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        options.output_file(
            "--plot", "Draw the mesh and its eigenvectors before and after (.svg, .png)."
        ),
    ] = None,
    method: Annotated[
        MethodName,
        typer.Option(
            "--method", help="footfit settles the pose by shape; the others are as printed."
        ),
    ] = MethodName.footfit,
    to: Annotated[
        str | None, options.option("--to", "Whose OM_E to use, else the reference's.", "LAST")
    ] = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    reading: options.Reading,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Align scans: heel to toe along X, sole down, mm.

    Example: footfit align foot.stl -o aligned.stl --plot frames.svg
    """
    from footfit.api import files, scans
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.export import MESH_KINDS, PICTURE_KINDS

    mesh, picture = (output, MESH_KINDS, files.mesh_file), (plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((OutputFile(*mesh), OutputFile(*picture)), force=force)
    reference = open_catalogue(catalogue_path(catalogue)).reference(to, method.value)
    chosen = {"method": method.value, "reference": reference}
    answer_scans(scans.align, meshes, reading, batch, mode, outputs, **chosen)
