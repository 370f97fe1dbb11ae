"""``footfit list-lasts``: the library at a glance."""

from __future__ import annotations

from footfit.cli import options


def list_lasts(
    csv: options.Csv = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """List the lasts of the catalogue, by name.

    Example: footfit list-lasts
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.outputs import one_answer, refuse_existing, write_or_answer
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts
    from footfit.report.csv import csv_text
    from footfit.results import Library

    refuse_existing(csv, force=force)
    one_answer(csv, as_json=json)
    found = lasts.list_lasts(catalogue_path(catalogue))
    if csv is not None:
        write_or_answer(csv, csv_text(Library, [found]), force=force)
    tell(found, Voice(json, quiet, answers=csv != options.STDOUT))
