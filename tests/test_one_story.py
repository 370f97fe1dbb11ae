"""Customers made by code: no output contradicts another.

``FOOTFIT_CUSTOMERS=50 pytest tests/test_one_story.py`` tries fifty; without it there are a few.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from footfit.cli import answers as cli_answers
from footfit.pipeline.fit import compare
from tests.conftest import Footfit
from tests.customers import (
    Printed,
    contradictions,
    recorder,
    result_recorder,
    write_customer,
    write_lasts,
)

CUSTOMERS = int(os.environ.get("FOOTFIT_CUSTOMERS", "12"))


@pytest.fixture(scope="module")
def shop(stocked: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a catalogue of the sample lasts, to which generated lasts are added."""
    folder = tmp_path_factory.mktemp("shop")
    shutil.copy(stocked, folder / "lasts.footfit")
    return folder


SEEN = Printed()


@pytest.mark.parametrize("number", range(CUSTOMERS))
def test_nothing_that_is_said_of_a_customer_contradicts_itself(
    footfit: Footfit, shop: Path, number: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    catalogue = shop / "lasts.footfit"
    if not (shop / "made.csv").exists():
        made = ("ingest-last", "--manifest", write_lasts(shop), "--catalogue", catalogue)
        assert footfit(*made).code == 0
    told: list[object] = []
    monkeypatch.setattr(cli_answers, "tell", recorder(told, cli_answers.tell))
    monkeypatch.setattr(compare, "compared", result_recorder(told, compare.compared))
    customer = write_customer(number, tmp_path)
    found = contradictions(customer, footfit, told, catalogue, tmp_path, SEEN)
    assert list(found) == []
