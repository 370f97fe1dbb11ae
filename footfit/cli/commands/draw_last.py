"""``footfit draw-last``: a last or a foot in true size, to print, to plot or to cut."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from footfit.cli import options

PaperName = Literal["a4", "a3", "letter", "roll"]
"""What a PDF is printed on."""


def draw_last(
    meshes: list[str] = options.MESHES,
    output: Path = options.output_files(
        "--output", "Write the drawing in true size (.pdf, .svg, .dxf).", "-o", default=...
    ),
    foot: bool = options.switch("--foot", "Draw a foot. Without it, footfit draws a last."),
    paper: PaperName | None = options.option(
        "--paper",
        "Print the PDF on this paper; roll is one long sheet. Without it on A4.",
        panel=options.OUTPUT,
    ),
    force: bool = options.FORCE,
    *,
    lasts: options.Lasts,
    reading: options.Reading,
    standing: options.Standing,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Draw a last in true size: its bottom laid flat, plan, side and sections, with all measures.

    Print the PDF at 100 %. Each sheet has a bar of 100 mm in both directions: measure them first.

    Example: footfit draw-last derby-40 -o derby-40.pdf
    """
    from footfit.api import drawings
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.errors import BadOption

    def file(drawing: Any, kind: str) -> bytes:
        return drawings.drawing_file(drawing, kind, paper)

    given = [name for name, value in standing.keywords().items() if value is not None]
    if foot and given:
        flag = "--" + given[0].removesuffix("_mm").replace("_", "-")
        raise BadOption(f"{flag} says how a last stands: leave it out, or leave out --foot")
    suffix = output.suffix.lower()
    if paper not in (None, "roll") and suffix in (".svg", ".dxf"):
        raise BadOption(f"--paper goes with a .pdf; a {suffix} is one sheet", str(output))
    outputs = Outputs((OutputFile(output, drawings.DRAWING_KINDS, file),), force=force)
    chosen = {"foot": foot, **standing.keywords()}
    answer_scans(drawings.drawing, meshes, reading, batch, mode, outputs, lasts, **chosen)
