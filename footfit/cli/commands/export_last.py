"""``footfit export-last``: a last of the catalogue as a mesh or as data."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def export_last(
    last: str = options.LAST,
    output: Path = options.output_file(
        "--output",
        "Write the mesh (.stl, .ply, .obj, .off), or the record (.json).",
        "-o",
        default=...,
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Write the mesh of a last (canonical frame, mm) or its record to a file.

    Example: footfit export-last derby-42 -o derby-42.stl
    """
    from footfit.api import files
    from footfit.cli.answers import tell
    from footfit.cli.outputs import refuse_existing, write_output
    from footfit.pipeline.export import MESH_KINDS, file_kind
    from footfit.report.json import json_line
    from footfit.results import ExportOutcome

    kinds = (*MESH_KINDS, "json")
    refuse_existing(output, force=force, kinds=kinds)
    catalogue, kind = lasts.open(), file_kind(output, kinds)
    name = catalogue.name(last)
    if kind == "json":
        outcome = ExportOutcome(name, str(output))
        data: bytes | str = json_line(catalogue.last(name).to_dict()) + "\n"
    else:
        copy = catalogue.mesh(name)
        outcome = ExportOutcome(name, str(output), copy.faces, copy.error_mm)
        data = files.mesh_file(copy, kind)
    write_output(output, data, force=force)
    tell(outcome, mode)
