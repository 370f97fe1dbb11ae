"""The mutants: each operator on a line of its own, the draw, the plan, one trial end to end."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.mutants import scratch
from tools.mutants.__main__ import EQUIVALENTS
from tools.mutants.draw import Mutant, drawn
from tools.mutants.operators import changes, code_lines, mutations
from tools.mutants.reach import Reach
from tools.mutants.summary import Equivalent, counts, diff, equivalents
from tools.mutants.trial import Outcome, tried


def changed(source: str) -> set[str]:
    """Every mutated source, in one line each."""
    found = [change for change in mutations(source) if changes(change, source)]
    return {change.applied(source).strip() for change in found}


@pytest.mark.parametrize(
    ("source", "mutants"),
    [
        ("a < b", {"a <= b", "a > b"}),
        ("a >= b", {"a > b", "a <= b"}),
        ("a == b", {"a != b"}),
        ("a is  not b", {"a is b"}),
        ("a not in b", {"a in b"}),
        ("0 <= a < b", {"1 <= a < b", "0 < a < b", "0 >= a < b", "0 <= a <= b", "0 <= a > b"}),
        ("(a + b) * c", {"(a - b) * c", "(a + b) / c"}),
        ("a @ b", {"(b) @ (a)"}),
        ("a and b and c", {"a or b and c", "a and b or c"}),
        ("not (a)", {"(a)"}),
        ("-a", {"a"}),
        ("x = 3", {"x = 4"}),
        ("x = 300", {"x = 600"}),
        ("x = 0.25", {"x = 0.5"}),
        ("x = True", {"x = False"}),
        ("a[0]", {"a[-1]", "a[1]"}),
        ("a[-1]", {"a[0]", "a[1]", "a[-2]"}),
        ("x = min(a, b)", {"x = max(a, b)"}),
        ("x = np.any(a)", {"x = np.all(a)"}),
        ("x = os.link(a, b)", {"x = os.replace(a, b)", "x = os.link(b, a)"}),
        ("f(a, b)", {"pass", "f(b, a)"}),
        ("f(a, *b)", {"pass"}),
        ("a.b = c", {"pass"}),
        ("a += b", {"pass"}),
        ("if a:\n  b", {"if not (a):\n  b"}),
        ("x = a if b else c", {"x = a if not (b) else c"}),
        ("x = [a for a in b if a]", {"x = [a for a in b if not (a)]"}),
        ("for a in b:\n  break", {"for a in b:\n  continue"}),
        ("def f():\n  return a, b", {"def f():\n  return b, a"}),
        ("raise a", {"pass"}),
    ],
)
def test_an_operator_changes_what_it_should(source: str, mutants: set[str]) -> None:
    assert changed(source) == mutants


@pytest.mark.parametrize(
    "source",
    [
        '"""At most 3 of them."""',
        "__all__ = [1]",
        "x: Literal[3]",
        "def f(a: T[1]) -> T[2]: ...",
        "@cache(maxsize=3)\ndef f(): ...",
        "x = zip(a, strict=True)",
        "if TYPE_CHECKING:\n  from a import b",
        "x = 'a < b'",
    ],
)
def test_words_types_and_names_are_left_alone(source: str) -> None:
    assert changed(source) == set()


def test_a_change_beside_letters_of_several_bytes_is_at_its_place() -> None:
    assert changed('x = "± 3 °" + a') == {'x = "± 3 °" - a'}
    assert "x = f'{a - 1} é'" in changed("x = f'{a + 1} é'")


def test_code_is_counted_without_words_and_comments() -> None:
    assert code_lines('"""Words\n\nand more."""\n\n# a comment\nx = 1\n\n\ny = f(\n    x\n)\n') == 4


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A small project: one module whose sum is tested, and whose product is not."""
    root = tmp_path / "made"
    (root / "footfit").mkdir(parents=True)
    (root / "tests").mkdir()
    (root / "footfit" / "__init__.py").touch()
    source = (
        "SHIFT = 7\n\ndef total(a, b):\n    return a + b\n\ndef product(a, b):\n    return a * b\n"
    )
    (root / "footfit" / "sums.py").write_text(source, encoding="utf-8")
    test = "from footfit.sums import total\n\ndef test_total():\n    assert total(2, 3) == 5\n"
    (root / "tests" / "test_sums.py").write_text(test, encoding="utf-8")
    tools = Path(__file__).resolve().parents[1] / "tools"
    (root / "tools").symlink_to(tools)
    return root


def test_a_seed_draws_the_same_mutants_and_none_twice(tree: Path) -> None:
    modules = [tree / "footfit" / "sums.py"]
    first = drawn(tree, modules, seed=1, count=99)
    assert first == drawn(tree, modules, seed=1, count=99)
    assert {mutant.mutation.words for mutant in first} == {
        "7 -> 8",
        "a + b -> a - b",
        "a * b -> a / b",
    }
    assert len(drawn(tree, modules, seed=2, count=2)) == 2


def test_only_the_tests_that_reach_a_line_are_planned(tree: Path) -> None:
    total, product = (
        next(m for m in drawn(tree, [tree / "footfit/sums.py"], 1, 9) if words in m.mutation.words)
        for words in ("a + b", "a * b")
    )
    known = Reach(
        seconds={"quick": 0.1, "slow": 2.0, "through": 0.5, "fixture x": 1.0},
        fixtures={"through": ["fixture x"], "quick": []},
    )
    known.lines["footfit/sums.py"][4] |= {"slow", "quick", "fixture x"}
    assert known.plan(total, 9.0) == {"quick": 0.1, "through": 1.5, "slow": 2.0}
    assert known.plan(total, 1.6) == {"quick": 0.1, "through": 1.5}
    assert known.plan(product, 9.0) == {}


def test_a_mutant_is_caught_by_a_test_that_passes_without_it(tree: Path, tmp_path: Path) -> None:
    template = scratch.template(tree, tmp_path / "template")
    mutants = {m.mutation.words: m for m in drawn(tree, [tree / "footfit/sums.py"], 1, 9)}
    test = "tests/test_sums.py::test_total"
    caught = tried(mutants["a + b -> a - b"], {test: 0.1}, template, tmp_path / "one")
    assert (caught.word, caught.test) == ("caught", test)
    left = tried(mutants["a * b -> a / b"], {test: 0.1}, template, tmp_path / "one")
    assert (left.word, left.test) == ("survived", None)
    unseen = tried(mutants["a * b -> a / b"], {}, template, tmp_path / "one")
    assert unseen.word == "not reached"
    assert counts([caught, left, unseen]) == "1 of 3 mutants caught (33.3 %)"
    assert diff(tree, caught.mutant) == "-    return a + b\n+    return a - b"
    broken = tree / "tests" / "test_sums.py"
    broken.write_text(broken.read_text().replace("== 5", "== 6"), encoding="utf-8")
    template = scratch.template(tree, tmp_path / "other")
    known = tried(mutants["a + b -> a - b"], {test: 0.1}, template, tmp_path / "one")
    assert known.word == "not reached", "its only test fails anyway"


def test_every_equivalent_mutant_has_a_reason_and_is_listed_once() -> None:
    listed = equivalents(EQUIVALENTS)
    assert all(len(known.reason.split()) > 4 for known in listed)
    names = [(known.file, known.function, known.change) for known in listed]
    assert len(set(names)) == len(names)


def test_an_equivalent_mutant_is_known_by_file_function_and_change(tree: Path) -> None:
    (mutant,) = (
        m for m in drawn(tree, [tree / "footfit/sums.py"], 1, 9) if "a + b" in m.mutation.words
    )
    own = Equivalent("footfit/sums.py", "total", "a + b -> a - b", "for no reason at all")
    assert own.means(mutant)
    other = Mutant("footfit/other.py", mutant.mutation)
    assert not own.means(other)
    assert isinstance(Outcome(mutant, "survived", 0, None, 0.0).mutant, Mutant)
