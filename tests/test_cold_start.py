"""What a command opens on its way: a cold match is mostly imports, so they are counted here.

Times are in benchmarks/speed.py and benchmarks/earlier.py; a count is the same on every machine.
"""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from footfit import results
from footfit.cli.answer_forms import FORMS
from tests.conftest import ROOT

MOST_MODULES = 245
"""Of footfit, that a match opens. 221 were measured, 303 before each result, table and format was
opened by itself; a module with its dataclasses takes half a millisecond, of 450 ms.
"""
OF_NUMPY = ("numpy.ma", "numpy.polynomial", "numpy.random")
"""Parts of NumPy that take 2 to 6 ms each to load, if NumPy itself does not load them."""
CODE = """
import json, runpy, sys
import numpy
given = set(sys.modules)
sys.argv = ["footfit", *sys.argv[1:]]
try:
    runpy.run_module("footfit", run_name="__main__")
except SystemExit as ended:
    code = ended.code
from footfit.pipeline.scan.shipped_templates import _template
templates = _template.cache_info().currsize
print(json.dumps([code, sorted(given), sorted(sys.modules), templates]))
"""


@pytest.fixture(scope="module")
def opened(foot: Path, stocked: Path) -> tuple[set[str], set[str], int]:
    """The modules that NumPy opens, those that a match opens beside them, and how many of the
    shipped templates it unpacks.
    """
    words = ("match", str(foot), "--catalogue", str(stocked))
    done = subprocess.run(
        [sys.executable, "-c", CODE, *words], capture_output=True, text=True, check=True
    )
    code, given, modules, templates = json.loads(done.stdout.splitlines()[-1])
    assert code == 0
    return set(given), set(modules) - set(given), templates


def test_a_match_opens_few_modules(opened: tuple[set[str], set[str], int]) -> None:
    own = {name for name in opened[1] if name.split(".")[0] == "footfit"}
    assert len(own) <= MOST_MODULES
    assert not own & {
        "footfit.catalogue.store",  # writes
        "footfit.meshes.formats.obj",  # the foot is an STL
        "footfit.report.wording.coverage_words",
        "footfit.results.library",
    }


def test_a_match_opens_no_part_of_numpy_that_it_can_do_without(
    opened: tuple[set[str], set[str], int],
) -> None:
    given, modules, _ = opened
    assert not modules & set(OF_NUMPY)
    assert "numpy.linalg" in given  # the names of NumPy's parts are as they are here


def test_a_match_unpacks_two_templates(opened: tuple[set[str], set[str], int]) -> None:
    assert opened[2] == 2


def test_the_names_of_results_are_listed_alike_for_people_and_for_python() -> None:
    page = ast.parse((ROOT / "footfit" / "results" / "__init__.py").read_text(encoding="utf-8"))
    (block,) = (node for node in page.body if isinstance(node, ast.If))
    typed = {
        each.asname: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for each in node.names
    }
    assert sorted(typed) == dir(results)
    for name, home in typed.items():
        assert getattr(results, name) is getattr(import_module(str(home)), name)
    with pytest.raises(AttributeError, match="no attribute 'Nothing'"):
        results.Nothing  # noqa: B018


def test_every_result_of_a_command_has_a_form_whose_table_is_there() -> None:
    population = {"LastsCheck": "checked_lasts", "Coverage": "coverage_answer"}
    for name, form in FORMS.items():
        home = f".population.{population[name]}" if name in population else ""
        kind = getattr(import_module(f"footfit.results{home}"), name)
        assert callable(kind.to_dict)
        module, function = form.maker.split(".")
        assert callable(getattr(import_module(f"footfit.report.terminal.{module}"), function))
