"""``footfit list-lasts``: the lasts of the catalogue."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def list_lasts(
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """List the lasts of the catalogue, by name.

    Example: footfit list-lasts
    """
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import Outputs
    from footfit.results import Library

    outputs = Outputs(table=Library, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    answer_result(lasts.open().lasts(), mode, outputs)
