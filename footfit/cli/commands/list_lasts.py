"""``footfit list-lasts``: the lasts of the catalogue."""

from __future__ import annotations

from footfit.cli import options


def list_lasts(
    csv: options.Csv = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    mode: options.OutputMode,
) -> None:
    """List the lasts of the catalogue, by name.

    Example: footfit list-lasts
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import Outputs
    from footfit.cli.settings import catalogue_path
    from footfit.results import Library

    outputs = Outputs(table=Library, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    answer_result(open_catalogue(catalogue_path(catalogue)).lasts(), mode, outputs)
