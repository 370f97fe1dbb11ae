"""Upgrading: profiles of another definition are made anew from the catalogue's own meshes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from footfit.catalogue.store import open_catalogue
from footfit.errors import NoCatalogue
from footfit.geometry.flare import FlareDefinition
from footfit.pipeline.lasts import library
from footfit.pipeline.upgrade import upgrade


def test_profiles_of_another_definition_are_recomputed_and_marked(catalogue: Path) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        record = opened.records()[0]
        definition = replace(record.flare.definition, version="flare/0", band_height=0.2)
        older = replace(record.flare, definition=definition, angle_deg=99.0)
        opened.update_profile(record.labels.name, older)
    assert [notice.code for notice in library(catalogue).warnings] == ["outdated_last"]

    outcome = upgrade(catalogue)
    assert outcome.recomputed == (record.labels.name,)
    assert outcome.backup is None
    assert library(catalogue).warnings == ()
    with open_catalogue(catalogue) as opened:
        again = opened.record(record.labels.name)
    assert again.upgraded_from == "flare/0"
    assert again.flare.definition == FlareDefinition()
    assert again.flare.angle_deg == pytest.approx(record.flare.angle_deg, abs=0.1)
    assert upgrade(catalogue).recomputed == ()


def test_an_upgrade_makes_no_catalogue(tmp_path: Path) -> None:
    with pytest.raises(NoCatalogue):
        upgrade(tmp_path / "none.footfit")
    assert not list(tmp_path.iterdir())
