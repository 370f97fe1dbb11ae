"""``footfit list-fits``: the entries of the fit log."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def list_fits(
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """List what wearers said of worn shoes, oldest first.

    Example: footfit list-fits --csv fits.csv
    """
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import Outputs
    from footfit.results import FitList

    outputs = Outputs(table=FitList, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    answer_result(lasts.open().fit_log.entries(), mode, outputs)
