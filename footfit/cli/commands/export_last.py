"""``footfit export-last``: a last out of the catalogue, as a mesh or as data."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from footfit.cli import options


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
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Write a last's mesh (canonical frame, mm) or its record to a file.

    Example: footfit export-last derby-42 -o derby-42.stl
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.outputs import refuse_existing, write_output
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.export import MESH_KINDS, copy_bytes
    from footfit.pipeline.library import lasts
    from footfit.report.json import json_line
    from footfit.results import ExportOutcome

    refuse_existing(output, force=force, kinds=(*MESH_KINDS, "json"))
    path, outcome = catalogue_path(catalogue), ExportOutcome(last, str(output))
    if output.suffix.lower() == ".json":
        data: bytes | str = json_line(lasts.last(path, last).to_dict()) + "\n"
    else:
        copy = lasts.mesh_copy(path, last)
        outcome = replace(outcome, faces=copy.faces, error_mm=copy.error_mm)
        data = copy_bytes(copy, output)
    write_output(output, data, force=force)
    tell(outcome, Voice(json, quiet))
