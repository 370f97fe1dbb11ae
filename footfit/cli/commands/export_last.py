"""``footfit export-last``: a last out of the catalogue, as a mesh or as data."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def export_last(
    last: options.LastName,
    output: Annotated[
        Path,
        options.file_to_write(
            "-o",
            "--output",
            help="The file: .stl, .ply, .obj, .off for the mesh, .json for the record.",
        ),
    ],
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    mode: OutputMode,
) -> None:
    """Write a last's mesh (canonical frame, mm) or its record to a file.

    Example: footfit export-last derby-42 -o derby-42.stl
    """
    from footfit import api
    from footfit.cli.answers import tell
    from footfit.cli.outputs import refuse_existing, write_output
    from footfit.cli.settings import catalogue_at
    from footfit.pipeline.export import MESH_KINDS, file_kind
    from footfit.report.json import json_line
    from footfit.results import ExportOutcome

    kinds = (*MESH_KINDS, "json")
    refuse_existing(output, force=force, kinds=kinds)
    lasts, kind = catalogue_at(catalogue), file_kind(output, kinds)
    if kind == "json":
        outcome = ExportOutcome(last, str(output))
        data: bytes | str = json_line(lasts.last(last).to_dict()) + "\n"
    else:
        copy = lasts.mesh(last)
        outcome = ExportOutcome(last, str(output), copy.faces, copy.error_mm)
        data = api.mesh_file(copy, kind)
    write_output(output, data, force=force)
    tell(outcome, mode)
