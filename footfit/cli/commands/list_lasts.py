"""``footfit list-lasts``: the library at a glance."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def list_lasts(
    csv: options.Csv = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    mode: OutputMode,
) -> None:
    """List the lasts of the catalogue, by name.

    Example: footfit list-lasts
    """
    from dataclasses import replace

    from footfit.cli.answers import tell
    from footfit.cli.outputs import Outputs
    from footfit.cli.settings import catalogue_at
    from footfit.results import Library

    outputs = Outputs(table=Library, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    library = catalogue_at(catalogue).lasts()
    outputs.write_csv([library])
    tell(library, replace(mode, answers=csv != options.STDOUT))
