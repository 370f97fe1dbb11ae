"""``footfit align``: any scan in the canonical frame."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from footfit.cli import options

MethodName = Literal["footfit", "paper", "paper-literal"]
"""How to align: by footfit's method, or by the paper's, corrected or as printed."""


def align(
    meshes: list[str] = options.MESHES,
    output: Path | None = options.output_files(
        "--output", "Write the aligned mesh in mm (.stl, .ply, .obj, .off, .3mf, .3dm).", "-o"
    ),
    plot: Path | None = options.output_files(
        "--plot", "Draw the mesh and its eigenvectors before and after (.svg, .png)."
    ),
    method: MethodName = options.option(
        "--method",
        "Align by the shape (footfit), or by the equations of the paper.",
        default="footfit",
    ),
    to: str | None = options.option(
        "--to", "Use the OM_E of this last; without it that of the reference last.", "LAST"
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.Reading,
    standing: options.Standing,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Turn scans into one frame: heel to toe along X, sole down, in mm.

    ± is the spread of a second scan of the same shape; total ± also holds what is known of the
    trueness.

    Example: footfit align foot.stl -o aligned.stl --plot frames.svg
    """
    from footfit.api import files, scans
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.pipeline.export import MESH_KINDS, PICTURE_KINDS

    mesh, picture = (output, MESH_KINDS, files.mesh_file), (plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((OutputFile(*mesh), OutputFile(*picture)), force=force)
    chosen = {"method": method, "reference": lasts.open().reference(to, method)}
    answer_scans(
        scans.align, meshes, reading, batch, mode, outputs, lasts, **chosen, **standing.keywords()
    )
