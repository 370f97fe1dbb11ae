"""``footfit copy-catalogue``: a whole catalogue from a file to a server, or back."""

from __future__ import annotations

from footfit.cli import options


def copy_catalogue(
    source: str = options.argument("FROM", "Name the catalogue to copy: a file or an address."),
    target: str = options.argument("TO", "Name a new or an empty catalogue."),
    *,
    mode: options.OutputMode,
) -> object:
    """Copy a whole catalogue between a file and a server, in any direction, without loss.

    The address of a server is postgresql+psycopg://USER@HOST:PORT/DATABASE. The password comes from
    PGPASSWORD or ~/.pgpass.

    Example: footfit copy-catalogue lasts.footfit postgresql+psycopg://ann@db.example/lasts
    """
    from footfit.api.catalogues import open_catalogue

    return open_catalogue(source).copy_to(target)
