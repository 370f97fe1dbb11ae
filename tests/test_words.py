"""The form of everything that a person reads: help, messages, notices, and the docs' lines."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from footfit import errors
from footfit.cli.app import COMMANDS, application, function_of
from tests.conftest import ROOT, Footfit

PACKAGE = ROOT / "footfit"
MOST_WORDS = 30
"""In one sentence of help or of a message; docs/style.md."""
ERRORS = {name for name, value in vars(errors).items() if isinstance(value, type)} - {"ExitCode"}
COMMON_ABBREVIATIONS = ("e.g.", "i.e.", "Eq.", "approx.")


class Words(NamedTuple):
    """A text that a person reads, and where it stands."""

    where: str
    text: str


# ---------------------------------------------------------------- finding the texts


def texts(node: ast.expr | None, names: dict[str, list[ast.expr]]) -> list[str]:
    """The texts that an expression can be; what is filled in counts as the word ``x``."""
    match node:
        case ast.Constant(value=str() as text):
            return [text]
        case ast.JoinedStr(values=values):
            return ["".join(v.value if isinstance(v, ast.Constant) else "x" for v in values)]
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return [a + b for a in texts(left, names) for b in texts(right, names)]
        case ast.IfExp(body=body, orelse=other):
            return texts(body, names) + texts(other, names)
        case ast.Name(id=name) if name in names:
            return [text for value in names[name] for text in texts(value, {})]
    return []


def message_node(call: ast.Call) -> ast.expr | None:
    """The argument of a call that a person reads, if it is an error, a notice or a finding."""
    name = getattr(call.func, "id", getattr(call.func, "attr", ""))
    place = 0 if name in ERRORS else 1 if name in ("Notice", "Finding") else None
    if place is None:
        return None
    named = {keyword.arg: keyword.value for keyword in call.keywords}
    return named.get("message", call.args[place] if len(call.args) > place else None)


def messages() -> Iterator[Words]:
    """Every message in the package that is written out, or assembled in the same function."""
    for path in sorted(PACKAGE.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for function in ast.walk(tree):
            if not isinstance(function, ast.FunctionDef):
                continue
            names: dict[str, list[ast.expr]] = {}
            for node in ast.walk(function):
                if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                    names.setdefault(node.targets[0].id, []).append(node.value)
            for node in ast.walk(function):
                if isinstance(node, ast.Call):
                    for text in texts(message_node(node), names):
                        yield Words(f"{path.relative_to(ROOT)}:{node.lineno}", text)
        for node in tree.body:
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
                for text in texts(message_node(node.value), {}):
                    yield Words(f"{path.relative_to(ROOT)}:{node.lineno}", text)


def helps() -> Iterator[Words]:
    """Every help text of the application: of the commands and of their options."""
    from typer.main import get_command

    group: Any = get_command(application())
    for name in COMMANDS:
        yield Words(f"footfit {name}", inspect.getdoc(function_of(name)) or "")
        for parameter in group.get_command(None, name).params:
            yield Words(f"footfit {name} {parameter.name}", parameter.help or "")


def sentences(text: str) -> list[str]:
    """A text taken apart where a sentence ends."""
    for short in COMMON_ABBREVIATIONS:
        text = text.replace(short, short.rstrip("."))
    return [part for part in re.split(r"(?<=[.?!])\s+|\n\s*\n", text) if part.strip()]


# ---------------------------------------------------------------- the rules


def faults(text: str) -> list[str]:
    """What is wrong with a text of either kind."""
    found = []
    longest = max((len(part.split()) for part in sentences(text)), default=0)
    if longest > MOST_WORDS:
        found.append(f"a sentence of {longest} words")
    if "  " in text or text != text.strip():
        found.append("spaces")
    return found


def message_faults(text: str) -> list[str]:
    """A message is one line, begins small, and ends without a full stop."""
    found = faults(text)
    if text[:1].isupper() and not text[:2].isupper():
        found.append("begins with a capital letter")
    if text.endswith(".") and not text.endswith("..."):
        found.append("ends with a full stop")
    if "\n" in text:
        found.append("more than one line")
    return found


def help_faults(text: str) -> list[str]:
    """A help text is of whole sentences: each ends with a full stop, but for an example."""
    found = faults(text)
    for part in sentences(text):
        if not part.startswith("Example: ") and not part.endswith((".", "?")):
            found.append(f"no full stop after {part[-20:]!r}")
    return found


def test_every_message_has_the_form() -> None:
    wrong = {words: message_faults(words.text) for words in messages()}
    assert len(wrong) > 150, "the messages are not found any more"
    assert {words: why for words, why in wrong.items() if why} == {}


def test_every_help_text_has_the_form() -> None:
    wrong = {words: help_faults(words.text) for words in helps()}
    assert len(wrong) > 100
    assert all(words.text for words in wrong)
    assert {words: why for words, why in wrong.items() if why} == {}


def spoken(value: Any, key: str = "") -> Iterator[str]:
    """Every sentence for people in a JSON document."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield from spoken(item, name)
    elif isinstance(value, list):
        for item in value:
            yield from spoken(item, key)
    elif isinstance(value, str) and key in ("message", "why", "reason", "words"):
        yield value


def test_what_the_application_says_has_the_form(
    footfit: Footfit, stocked: Path, foot: Path, tmp_path: Path
) -> None:
    """The sentences that are put together from parts: reasons, zones, sizes, notices."""
    (tmp_path / "empty.stl").write_bytes(b"")
    here = ("--catalogue", stocked, "--json")
    runs = [
        footfit("match", foot, "--top", 0, "--clearance", *here),
        footfit("match", foot, "--by", "flare", "--size-system", "uk", *here),
        footfit("match", foot, "--by", "shape", *here),
        footfit("match", foot, "--known-length", 200, *here),
        footfit("compare", foot, "loafer-40", *here),
        footfit("measure", foot, tmp_path / "empty.stl", "--side", "right", "--json"),
        footfit("list-lasts", *here),
    ]
    texts = {text for run in runs for line in run.lines for text in spoken(line)}
    texts |= {line.partition(": ")[2] for run in runs for line in run.err.splitlines()}
    assert len(texts) > 30
    assert {text: why for text in texts if (why := faults(text))} == {}
