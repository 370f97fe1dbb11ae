"""A custom last that a last of the catalogue beats is said."""

from __future__ import annotations

from pathlib import Path

import footfit
from footfit.report.page.custom_page import custom_page
from tests.conftest import ROOT

LASTS = ROOT / "sample_data" / "lasts"
FOOT = ROOT / "sample_data" / "feet" / "mh008_R.stl"


def custom_from(name: str, path: Path, **asked):
    (made,) = footfit.customise(str(FOOT), name, catalogue=path, name="own", **asked)
    return made


def ranked(path: Path) -> dict[str, tuple[str, ...]]:
    """The lasts in the order of a match, each with those that it is tied with."""
    with footfit.Catalogue(path) as catalogue:
        match = catalogue.match(str(FOOT))
    return {candidate.last: candidate.tied_with for candidate in match.candidates}


def test_a_last_of_the_catalogue_that_fits_better_is_said_as_match_ranks_it(tmp_path) -> None:
    path = tmp_path / "shop.footfit"
    with footfit.Catalogue(path) as catalogue:
        for name in ("derby-41", "derby-43"):
            catalogue.ingest(str(LASTS / f"{name}.stl"), heel_height_mm=25.0)
    poor = custom_from("derby-41", path)
    better = poor.better_in_stock
    assert better is not None
    document = poor.to_dict()
    assert document["better_in_stock"]["last"] == better.last == "derby-43"
    assert (better.verdict, better.custom_verdict) == ("good", poor.verdict)
    (notice,) = (each for each in poor.warnings if each.code == "better_in_stock")
    assert "derby-43 of the catalogue (good) fits this foot better than this custom last (" in (
        notice.message
    )
    assert "with --base derby-43, or from the best last without --base" in notice.message
    assert notice.message in custom_page(poor)
    best = custom_from("derby-43", path)
    assert best.better_in_stock is None
    footfit.store_custom(poor, path)
    assert [*ranked(path)] == ["derby-43", "own"]
    footfit.store_custom(best, path, replace=True)
    order = ranked(path)
    assert next(iter(order)) == "own" or "own" in order["derby-43"]
    again = custom_from("derby-41", path)  # a last that was made for a customer does not count
    assert again.better_in_stock == better
