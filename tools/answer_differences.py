"""Show that two checkouts of footfit give the same answers.

    python -m tools.answer_differences collect --python PY --footfit-root CHECKOUT \
        --scans ../shared/scans -o before.jsonl
    python -m tools.answer_differences compare before.jsonl after.jsonl --expect '*.length_mm'

``collect`` runs the checkout's command line (``tools/answer_runs.py``) and writes one answer a
line. ``compare`` exits with 1 if a number, verdict, code, exit code or written file differs, or if
a key or an answer is gone. Changed words and added keys do not count. A key begins with its run:
``match FEET --by flare.candidates.0.distance``. Nothing is imported from footfit, so one copy of
this script serves every checkout.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from tools.answer_runs import collect, numbered

ROOT = Path(__file__).resolve().parents[1]
ADDED, WORDS, FIGURES = "added", "words", "figures in words"
HARMLESS = (ADDED, WORDS, FIGURES)
# Keys that hold a sentence for people. A sentence may change, but not turn into null or back.
WORD_KEYS = ("message", "messages", "why", "reason", "error", "summary", "label_check.words")
FIGURE = re.compile(r"\d[\d,]*(?:\.\d+)?")
Answers = dict[tuple[str, str], Any]


@dataclass(frozen=True, slots=True)
class Difference:
    """One value that differs: its kind, its dotted key and both values."""

    kind: str
    key: str
    before: Any
    after: Any


def differences(before: Any, after: Any, key: str, tolerance: float = 0.0) -> Iterator[Difference]:
    """What differs between two answers; ``key`` stands before every dotted key."""
    if isinstance(before, dict) and isinstance(after, dict):
        old, new = document_name(before), document_name(after)
        if old != new:  # an answer on one side, an error on the other: no key is comparable
            yield Difference("outcome", f"{key}.schema", old, new)
            return
        for name in sorted(before.keys() | after.keys()):
            below = f"{key}.{name}"
            if name not in after:
                yield Difference("vanished", below, before[name], None)
            elif name not in before:
                yield Difference(ADDED, below, None, after[name])
            else:
                yield from differences(before[name], after[name], below, tolerance)
    elif isinstance(before, list) and isinstance(after, list):
        yield from list_differences(before, after, key, tolerance)
    elif not same_value(before, after, tolerance):
        yield Difference(kind_of_difference(key, before, after), key, before, after)


def list_differences(
    before: list[Any], after: list[Any], key: str, tolerance: float
) -> Iterator[Difference]:
    """What differs between two lists; warnings are compared by code, whatever their order."""
    if all(isinstance(item, dict) and "code" in item for item in before + after):
        old, new = (
            dict(zip(numbered([item["code"] for item in items]), items, strict=True))
            for items in (before, after)
        )
        for code in sorted(old.keys() | new.keys()):
            if code in old and code in new:
                yield from differences(old[code], new[code], f"{key}.{code}", tolerance)
            else:
                yield Difference("code", f"{key}.{code}", old.get(code), new.get(code))
        return
    if len(before) != len(after):
        yield Difference("list length", key, len(before), len(after))
    for place, (old_item, new_item) in enumerate(zip(before, after, strict=False)):
        yield from differences(old_item, new_item, f"{key}.{place}", tolerance)


def document_name(document: dict[str, Any]) -> str:
    """The schema without its version, an error with its code; empty where there is no schema.

    >>> document_name({"schema": "footfit.flare/1"})
    'footfit.flare'
    """
    name = str(document.get("schema", "")).split("/")[0]
    return f"error {document['code']}" if name == "footfit.error" else name


def number_in(value: Any) -> float | None:
    """The number that a JSON value or a CSV cell holds, or None."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    try:
        return float(value)
    except ValueError:
        return None


def same_value(before: Any, after: Any, tolerance: float) -> bool:
    """Whether two values agree to the printed digit, or two numbers within the tolerance."""
    if repr(before) == repr(after):
        return True
    old, new = number_in(before), number_in(after)
    return tolerance > 0 and old is not None and new is not None and abs(old - new) <= tolerance


def kind_of_difference(key: str, before: Any, after: Any) -> str:
    """The kind of difference that two unequal values are, by their key and type."""
    sentences = isinstance(before, str) and isinstance(after, str) and bool(before) and bool(after)
    if sentences and key.endswith(tuple(f".{name}" for name in WORD_KEYS)):
        old, new = (Counter(FIGURE.findall(text)) for text in (before, after))
        return WORDS if old == new else FIGURES
    name = key.rpartition(".")[2]
    if name in ("code", "exit", "verdict"):
        return name
    return "value" if number_in(before) is None or number_in(after) is None else "number"


def answer_differences(
    before: Answers, after: Answers, tolerance: float = 0.0
) -> Iterator[tuple[str, Difference]]:
    """Every difference between two collections, each with the input that it is about."""
    for name in sorted(before.keys() | after.keys()):
        run, about = name
        if name not in after:
            yield about, Difference("answer vanished", run, "an answer", None)
        elif name not in before:
            yield about, Difference("answer added", run, None, "an answer")
        else:
            for item in differences(before[name], after[name], run, tolerance):
                yield about, item


def report(
    items: list[tuple[str, Difference]], expected: list[str], *, words: bool, every: bool
) -> tuple[list[str], int]:
    """The lines to print, and how many differences are neither harmless nor expected.

    Differences of one kind in one key are one line, with the largest as an example; places in
    lists count as one key. With ``every`` each difference is a line. An expected pattern is
    matched with the key, and with ``ABOUT: KEY``.
    """
    lines: dict[tuple[str, str], list[tuple[float, str]]] = {}
    failures = 0
    met: set[str] = set()
    for about, item in items:
        names = (item.key, f"{about}: {item.key}")
        patterns = [p for p in expected if any(fnmatchcase(name, p) for name in names)]
        met.update(patterns)
        harmless = item.kind in HARMLESS
        failures += not (harmless or patterns)
        kind = f"expected {item.kind}" if patterns and not harmless else item.kind
        key = item.key if every else re.sub(r"\.\d+(?=\.|$)", ".*", item.key)
        old, new = (json.dumps(value, ensure_ascii=False) for value in (item.before, item.after))
        example = f"{about}: {old[:160]} -> {new[:160]}"
        lines.setdefault((kind, key), []).append((-change(item), example))
    told = [
        f"{kind}: {key} ({len(examples)} times): {example}"
        for (kind, key), examples in sorted(lines.items())
        if kind != WORDS or words
        for _, example in sorted(examples)[: None if every else 1]
    ]
    told += [f"expected but not met: {pattern}" for pattern in expected if pattern not in met]
    return told, failures


def change(item: Difference) -> float:
    """How far apart two numbers are; 0 for anything else."""
    old, new = number_in(item.before), number_in(item.after)
    return 0.0 if old is None or new is None else abs(new - old)


def value_count(answer: Any) -> int:
    """How many values an answer holds.

    >>> value_count({"a": [1, 2], "b": None})
    3
    """
    if isinstance(answer, dict):
        answer = list(answer.values())
    return sum(map(value_count, answer)) if isinstance(answer, list) else 1


def read_answers(path: Path, only: str) -> Answers:
    """The answers that ``collect`` wrote, by run and input, of the runs that fit a pattern."""
    with path.open(encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    return {
        (line["run"], line["about"]): line["answer"]
        for line in lines
        if fnmatchcase(line["run"], only)
    }


def compare(arguments: argparse.Namespace) -> int:
    """Print how two collections differ; 1 if more than words and added keys do."""
    before, after = (
        read_answers(path, arguments.only) for path in (arguments.before, arguments.after)
    )
    if not before:
        sys.exit(f"{arguments.before} holds no such answers: collect them again")
    items = list(answer_differences(before, after, arguments.tolerance))
    lines, failures = report(items, arguments.expect, words=arguments.words, every=arguments.all)
    for line in lines:
        print(line)
    for kind, count in sorted(Counter(item.kind for _, item in items).items()):
        print(f"{count:7,} {kind}")
    print(f"compared {len(before):,} answers with {value_count(list(before.values())):,} values")
    print(f"{failures:,} differences that are neither words nor added keys nor expected")
    return 1 if failures else 0


def main() -> int:
    """Read the command line and do what it asks."""
    parser = argparse.ArgumentParser(description="Do two checkouts of footfit answer alike?")
    verbs = parser.add_subparsers(dest="verb", required=True)
    verb = verbs.add_parser("collect", help="run a checkout and write its answers")
    verb.add_argument("--python", default=sys.executable, help="the Python that runs the checkout")
    verb.add_argument("--footfit-root", type=Path, default=ROOT, help="the checkout")
    verb.add_argument("--scans", type=Path, required=True, help="a folder of foot scans")
    verb.add_argument("--cases", type=Path, help="difficult files, else 'cases' beside the scans")
    verb.add_argument("--samples", type=Path, default=ROOT / "sample_data", help="feet and lasts")
    verb.add_argument("--jobs", type=int, default=2, help="commands to run at a time")
    verb.add_argument("--only", default="*", metavar="RUN", help="such as 'match*'")
    verb.add_argument("-o", "--output", type=Path, required=True, help="the file to write")
    verb.set_defaults(run=collect)
    verb = verbs.add_parser("compare", help="print how two collections differ")
    verb.add_argument("before", type=Path)
    verb.add_argument("after", type=Path)
    verb.add_argument("--tolerance", type=float, default=0.0, help="numbers may differ by this")
    verb.add_argument(
        "--expect",
        nargs="+",
        action="extend",
        default=[],
        metavar="KEY",
        help="keys that may differ, such as '*.length_mm'",
    )
    verb.add_argument("--only", default="*", metavar="RUN", help="such as 'match*'")
    verb.add_argument("--words", action="store_true", help="show the words that changed")
    verb.add_argument("--all", action="store_true", help="show every difference, not one a key")
    verb.set_defaults(run=compare)
    arguments = parser.parse_args()
    result: int = arguments.run(arguments)
    return result


if __name__ == "__main__":
    sys.exit(main())
