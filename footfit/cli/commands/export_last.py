"""``footfit export-last``: a last of the catalogue as a mesh or as data."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.cli import options

FEWEST_FACES = 500
"""A mesh of fewer faces is no last any more."""


def export_last(
    last: str = options.LAST,
    output: Path = options.output_file(
        "--output",
        "Write the mesh (.stl, .ply, .obj, .off, .3mf, .3dm), or the record (.json). In a folder "
        "the file is named after the labels.",
        "-o",
        metavar="FILE|FOLDER/",
        default=...,
    ),
    faces: int = options.option(
        "--faces",
        "Write a mesh of at most this many faces, and say how far it lies from the file's mesh; 0 "
        "writes all.",
        "N",
        default=40_000,
        panel=options.OUTPUT,
        min=0,
    ),
    sections: int | None = options.option(
        "--sections",
        "Also write N sections along the bottom: their sizes (NAME_sections.csv) and their "
        "outlines (NAME_outlines.csv).",
        "N",
        panel=options.OUTPUT,
        min=1,
        max=500,
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Write the mesh of a last (canonical frame, mm) or its record to a file.

    Example: footfit export-last derby-42 -o derby-42.stl --sections 20
    """
    from footfit.api import files
    from footfit.cli.answers import tell
    from footfit.cli.outputs import OutputFile, folder_made, refuse_existing, write_outputs
    from footfit.errors import BadOption
    from footfit.pipeline.export import MESH_KINDS, file_kind, trade_name
    from footfit.report.csv import csv_text
    from footfit.report.json import json_line
    from footfit.results import ExportOutcome
    from footfit.results.last_making.section_table import OutlineTable, SectionTable
    from footfit.whole_files import require_folder

    if 0 < faces < FEWEST_FACES:
        raise BadOption(f"--faces takes {FEWEST_FACES:,} or more, or 0 for all: fewer show no last")
    kinds = (*MESH_KINDS, "json")
    target = OutputFile(output, kinds, files.mesh_file)
    catalogue = lasts.open()
    if target.is_folder:
        require_folder(output)
    else:
        refuse_existing(output, force=force, kinds=kinds)
    name = catalogue.name(last)
    record = catalogue.last(name)
    path = target.target(trade_name(record.record))
    tables = [path.with_name(f"{path.stem}_{tag}.csv") for tag in ("sections", "outlines")]
    for file in (path, *(tables if sections else ())):
        if file.parent.is_dir():
            refuse_existing(file, force=force)
    kind = file_kind(path, kinds)
    outcome = ExportOutcome(name, str(path))
    written: list[tuple[Path, bytes | str]] = []
    if kind == "json":
        written.append((path, json_line(record.to_dict()) + "\n"))
    else:
        copy = catalogue.mesh(name, faces or None)
        outcome = ExportOutcome(name, str(path), copy.faces, copy.error_mm)
        written.append((path, files.mesh_file(copy, kind)))
    if sections:
        table = catalogue.sections(name, sections)
        written.append((tables[0], csv_text(SectionTable, [table])))
        written.append((tables[1], csv_text(OutlineTable, [table.outlines()])))
        outcome = replace(outcome, sections=str(tables[0]), outlines=str(tables[1]))
    with folder_made(path.parent):
        write_outputs(dict(written), force=force)
    tell(outcome, mode)
