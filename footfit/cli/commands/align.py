"""``footfit align``: any scan in the canonical frame."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options


class MethodName(StrEnum):
    """How to align: by footfit's method, or by the paper's, corrected or as printed."""

    footfit = "footfit"
    paper = "paper"
    paper_literal = "paper-literal"


def align(
    meshes: options.Meshes,
    output: Annotated[
        Path | None,
        options.output_file(
            "--output", "Write the aligned mesh in mm (.stl, .ply, .obj, .off).", "-o"
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
            "--method",
            help="Align by the shape (footfit), or by the equations of the paper.",
        ),
    ] = MethodName.footfit,
    to: Annotated[
        str | None,
        options.option(
            "--to", "Use the OM_E of this last; without it that of the reference last.", "LAST"
        ),
    ] = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    reading: options.Reading,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Turn scans into one frame: heel to toe along X, sole down, in mm.

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
