"""Upgrade: an older catalogue to this version's schema and flare definition."""

from __future__ import annotations

from pathlib import Path

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.geometry.flare import FlareDefinition, FlareProfile, flare_profile
from footfit.meshes.copies import expanded
from footfit.pipeline.flare import as_right
from footfit.results import LastRecord, UpgradeOutcome


def upgrade(path: Path) -> UpgradeOutcome:
    """Bring the schema up to date (a copy of the file is kept beside it) and re-compute each
    profile of another flare definition from the catalogue's own mesh copy, marked as such.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is none, or it cannot be written; it is then as it was.
    """
    definition = FlareDefinition()
    with open_catalogue(path, write=True, create=False) as catalogue:
        older = [r for r in catalogue.records() if r.flare.definition != definition]
        for record in older:
            catalogue.update_profile(
                record.labels.name,
                _recomputed(catalogue, record, definition),
                upgraded_from=record.flare.definition.version,
            )
        revisions = catalogue.revisions
    return UpgradeOutcome(
        path=str(path),
        revision_before=revisions.before,
        revision_after=revisions.after,
        definition=definition.version,
        recomputed=tuple(record.labels.name for record in older),
        backup=None if revisions.backup is None else str(revisions.backup),
    )


def _recomputed(
    catalogue: Catalogue, record: LastRecord, definition: FlareDefinition
) -> FlareProfile:
    vertices_mm, faces = expanded(catalogue.mesh_copy(record.labels.name).data)
    right = as_right(vertices_mm, faces, record.side.side)
    return flare_profile(*right, definition, record.pose.kind)
