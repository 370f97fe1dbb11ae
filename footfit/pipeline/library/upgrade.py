"""Upgrade: bring an older catalogue to this version's schema, flare definition and measures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.geometry.flare.definition import FlareDefinition
from footfit.pipeline.library.lasts import has_other_measures
from footfit.pipeline.scan.flare import shape_flare
from footfit.pipeline.scan.measure import shape_measures
from footfit.pipeline.scan.preparation import stored_shape
from footfit.results import LastRecord, UpgradeOutcome


def upgrade(path: Path) -> UpgradeOutcome:
    """Bring the schema up to date, and every last whose profile or measures follow other
    definitions than this version's.

    A copy of the file is kept beside it if its schema changes. Profiles and measures are made
    from the catalogue's own mesh copies; a profile says which definition it replaces.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be written; it is then as it was.
    """
    definition = FlareDefinition()
    with open_catalogue(path, write=True, create=False) as catalogue:
        stored = catalogue.lasts()
        older = [
            record
            for record in stored.records
            if record.labels.name in stored.outdated or has_other_measures(record)
        ]
        for record in older:
            _renew(catalogue, record, profile=record.labels.name in stored.outdated)
        revisions = catalogue.revisions
    return UpgradeOutcome(
        path=str(path),
        revision_before=revisions.before,
        revision_after=revisions.after,
        definition=definition.version,
        recomputed=tuple(record.labels.name for record in older),
        backup=None if revisions.backup is None else str(revisions.backup),
    )


def _renew(catalogue: Catalogue, record: LastRecord, *, profile: bool) -> None:
    """Measure a last again; with ``profile`` also profile it by this version's definition."""
    copy, kind = catalogue.mesh_copy(record.labels.name), record.pose.kind
    right = stored_shape(copy.data, record.side.side)
    record = replace(record, measures=shape_measures(*right, kind))
    if profile:
        flare = shape_flare(*right, kind)
        record = replace(record, flare=flare, upgraded_from=record.flare.definition.version)
    catalogue.update_profile(record)
