"""``footfit curvature``: the concentrated curvature of a surface at every vertex."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import SurfaceCurvature


def curvature(
    meshes: list[str] = options.MESHES,
    output: Path | None = options.output_files(
        "--output",
        "Write k1, k2, mean and gaussian of each vertex (.ply coloured by the mean, .npz).",
        "-o",
    ),
    plot: Path | None = options.output_files(
        "--plot", "Draw the mean curvature on the mesh (.svg, .png)."
    ),
    radius: float | None = options.option(
        "--radius",
        "Set the scale in mm; 0 is the paper's one ring. Else 6 % of the longest extent.",
        "MM",
        min=0,
    ),
    force: bool = options.FORCE,
    *,
    lasts: options.Lasts,
    scale: options.Scale,
    crew: options.Crew,
    mode: options.OutputMode,
) -> None:
    """Measure the concentrated curvature of a surface at every vertex, in 1/mm.

    Example: footfit curvature foot.stl -o curvature.ply --plot curvature.png
    """
    from footfit.api import files
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.pipeline.export import CURVATURE_KINDS, PICTURE_KINDS

    mesh, picture = (output, CURVATURE_KINDS, files.mesh_file), (plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((OutputFile(*mesh), OutputFile(*picture)), force=force)
    chosen = {"radius_mm": radius, "output": None if output is None else str(output)}
    batch = options.Batch(split=False, jobs=crew.jobs, scheduler=crew.scheduler)
    answer_scans(curvature_with_output, meshes, scale, batch, mode, outputs, lasts, **chosen)


def curvature_with_output(mesh: Any, output: str | None, **options: Any) -> SurfaceCurvature:
    """The curvature of a mesh; its document names the file that holds all values."""
    from dataclasses import replace

    from footfit.api import files, scans
    from footfit.cli.outputs import OutputFile
    from footfit.pipeline.customers.customer import file_stem
    from footfit.pipeline.export import CURVATURE_KINDS

    surface = scans.curvature(mesh, **options)
    if output is None:
        return replace(surface, output=None)
    written = OutputFile(Path(output), CURVATURE_KINDS, files.mesh_file)
    return replace(surface, output=str(written.target(file_stem(surface.info.path))))
