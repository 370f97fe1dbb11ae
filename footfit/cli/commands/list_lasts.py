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
    from footfit.cli.answer_forms import LIST_LASTS
    from footfit.cli.answers import Voice, tell
    from footfit.cli.outputs import one_answer, refuse_existing, write_or_answer
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts
    from footfit.report.csv.answers_csv import lasts_csv

    refuse_existing(csv, force=force)
    one_answer(csv, as_json=json)
    found = lasts.listed(catalogue_path(catalogue))
    if csv is not None:
        write_or_answer(csv, lasts_csv(found.lasts, found.reference), force=force)
    tell(found, LIST_LASTS, Voice(json, quiet, answers=csv != options.STDOUT))
