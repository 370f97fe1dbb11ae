"""``footfit list-lasts``: the lasts of the catalogue."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from footfit.cli import options

SortName = Literal["name", "size", "length", "ball-girth", "flare", "heel"]
"""The order of the list."""


def list_lasts(
    style: str | None = options.option("--style", "List only lasts of this style.", "S"),
    size: str | None = options.option("--size", "List only lasts with this size.", "42"),
    width: str | None = options.option("--width", "List only lasts with this width.", "G"),
    family: str | None = options.option("--family", "List only lasts of this family.", "F"),
    sort: SortName = options.option(
        "--sort", "Set the order; the least comes first.", default="name"
    ),
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """List the lasts of the catalogue, and mark those that have warnings.

    Example: footfit list-lasts --style derby --sort length
    """
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import Outputs
    from footfit.results import Library

    outputs = Outputs(table=Library, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    listed = lasts.open().lasts(style=style, size=size, width_label=width, family=family, sort=sort)
    answer_result(listed, mode, outputs)
