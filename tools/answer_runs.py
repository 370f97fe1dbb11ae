"""Run a checkout's command line on many inputs and write down what it answers.

Every line of the output is one answer: ``run`` (the command as it stands in ``RUNS``), ``about``
(its input) and ``answer``: a JSON document, the rows of a CSV, an exit code with the messages, or
the hash of a written file. Paths, times and versions are replaced by fixed words.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import io
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase
from itertools import groupby
from pathlib import Path
from typing import Any

# A word in capitals is replaced by each of the inputs or output files of that name.
RUNS = (
    "match FEET --clearance --csv CSV",
    "match FEET --csv CSV",
    "match FEET --by flare --csv CSV",
    "match FEET --by shape --csv CSV",
    *(f"match FEET --profile {name}" for name in ("dress", "sport", "child", "safety")),
    "match LASTS --by shape",
    *(f"{verb} SHAPES --csv CSV" for verb in ("measure", "flare")),
    *(f"{verb} SHAPES" for verb in ("align", "curvature")),
    *(f"align SHAPES --method {name}" for name in ("paper", "paper-literal")),
    "compare FITTING --csv CSV",
    "match PAIR --pair --csv CSV",
    "match PAIR --pair --by flare --clearance",
    *(f"match FEW --size-system {name}" for name in ("eu", "uk", "us-men", "us-women")),
    *(f"match FEW --size-system {name}" for name in ("us-women-fia", "mondopoint", "other")),
    "match FEW --style derby --top 2",
    "match FEW --fail-under good",
    *(f"measure FEW {option}" for option in ("--side left", "--units cm", "--known-length 250")),
    *(f"{verb} TWO" for verb in ("align", "flare", "measure", "match", "curvature")),
    *(f"{verb} TWO --split" for verb in ("align", "flare", "measure", "match")),
    *(f"{verb} BAD" for verb in ("align", "flare", "measure", "match", "curvature")),
    "ingest-last BAD --dry-run",
    "compare BADFIT",
    "match FEW --profile nobody",
    "match FEW --catalogue nowhere.footfit",
    "show-last nobody",
    "show-last LAST",
    "export-last LAST -o JSON",
    "export-last ONELAST -o STL",
    *("align ONEFOOT -o STL", "curvature ONEFOOT -o PLY"),
    *("list-lasts --csv CSV", "check-catalogue", "catalogue-info", "demo demo"),
)
OUTPUTS = ("CSV", "JSON", "STL", "PLY")
MESHES = {".stl", ".obj", ".ply", ".off", ".glb", ".3mf"}
TIMESTAMP = re.compile(r"\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::[\d.]+)?(?:Z|[+-]\d\d:?\d\d)?)?")
Answer = tuple[str, str, Any]


def numbered(names: list[str]) -> list[str]:
    """The names, where a repeated one gets its count.

    >>> numbered(["a", "b", "a"])
    ['a', 'b', 'a#2']
    """
    seen: Counter[str] = Counter()
    result = []
    for name in names:
        seen[name] += 1
        result.append(name if seen[name] == 1 else f"{name}#{seen[name]}")
    return result


def two_feet(left: bytes, right: bytes) -> bytes:
    """Two binary STL files in one, the second moved 150 mm along y."""
    moved = bytearray(right[84:])
    for corner in (facet + at for facet in range(0, len(moved), 50) for at in (16, 28, 40)):
        struct.pack_into("<f", moved, corner, struct.unpack_from("<f", moved, corner)[0] + 150.0)
    facets = (len(left) - 84 + len(moved)) // 50
    return left[:80] + struct.pack("<I", facets) + left[84:] + bytes(moved)


def cube() -> str:
    """A closed cube of 200 mm as OBJ: as long as a foot, and no foot."""
    corners = [f"v {x} {y} {z}" for x in (0, 200) for y in (0, 200) for z in (0, 200)]
    faces = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
    return "\n".join([*corners, *(f"f {face}" for face in faces), ""])


def copy_inputs(folder: Path, scans: Path, cases: Path, samples: Path) -> None:
    """Copy all inputs into the folder, and make the bad ones and the file with two feet."""
    for source, name in ((scans, "scans"), (cases, "cases"), (samples, "samples")):
        shutil.copytree(source, folder / name, copy_function=shutil.copyfile)
    (folder / "bad").mkdir()
    (folder / "bad" / "empty.stl").write_bytes(b"")
    (folder / "bad" / "text.stl").write_text("this is no mesh\n", encoding="utf-8")
    (folder / "bad" / "cube.obj").write_text(cube(), encoding="utf-8")
    left, right = (folder / "samples" / "feet" / f"mh007_{side}.stl" for side in "LR")
    (folder / "two_feet.stl").write_bytes(two_feet(left.read_bytes(), right.read_bytes()))


def inputs(folder: Path) -> dict[str, list[tuple[str, ...]]]:
    """What each word in capitals stands for: the arguments of each command to run."""

    def meshes(name: str) -> list[str]:
        paths = sorted((folder / name).rglob("*"))
        return [p.relative_to(folder).as_posix() for p in paths if p.suffix.lower() in MESHES]

    feet = [*meshes("scans"), *meshes("cases"), *meshes("samples/feet")]
    lasts = [Path(path).stem for path in meshes("samples/lasts")]
    pairs = [(path, path.removesuffix("_L.stl") + "_R.stl") for path in feet]
    some_foot = meshes("samples/feet")[0]
    return {
        "FEET": [("scans", "cases", "samples/feet")],
        "FEW": [("samples/feet",)],
        "LASTS": [("samples/lasts",)],
        "SHAPES": [("scans", "cases", "samples/feet", "samples/lasts")],
        "FITTING": [
            *((path, lasts[place % len(lasts)]) for place, path in enumerate(feet)),
            (some_foot, f"samples/lasts/{lasts[-1]}.stl"),
            (some_foot, some_foot),
        ],
        "PAIR": [pair for pair in pairs if pair[0].endswith("_L.stl") and pair[1] in feet],
        "TWO": [("two_feet.stl",)],
        "BAD": [("bad", "nowhere.stl")],
        "BADFIT": [
            *((path, lasts[0]) for path in (*meshes("bad"), "nowhere.stl", "two_feet.stl")),
            *((some_foot, bad) for bad in ("nobody", "bad/text.stl")),
        ],
        "LAST": [(name,) for name in lasts],
        "ONELAST": [(lasts[0],)],
        "ONEFOOT": [(some_foot,)],
    }


def subject(document: dict[str, Any], otherwise: str) -> str:
    """What a document is about: its mesh, its feet, its last, else what the command was given."""
    feet = document.get("feet") or [document]
    paths = [foot.get("path") or (foot.get("mesh") or {}).get("path") for foot in feet]
    names = [*paths, document.get("last")]
    return " ".join(str(name) for name in names if name) or otherwise


def table(text: str) -> Iterator[tuple[str, Any]]:
    """The rows of a CSV, by the text of their first column, and its header."""
    rows = list(csv.DictReader(io.StringIO(text)))
    first = next(csv.reader(io.StringIO(text)), [""])
    yield "header", first
    for name, group in groupby(rows, key=lambda row: row[first[0]]):
        yield name, list(group)


class Checkout:
    """A checkout's command line, run in a folder of its own."""

    def __init__(self, python: str, root: Path, folder: Path) -> None:
        self.python = str(Path(shutil.which(python) or python).absolute())
        self.root, self.folder = root.resolve(), folder
        places = ("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "MPLCONFIGDIR")
        self.environment = {
            **os.environ,
            **{name: str(folder / "home") for name in places},
            "PYTHONPATH": str(self.root),
            "FOOTFIT_CATALOGUE": str(folder / "lasts.footfit"),
            "COLUMNS": "100",
            "NO_COLOR": "1",
        }

    def output(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run Python with the arguments."""
        line = [self.python, *arguments]
        return subprocess.run(
            line, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False
        )

    def normal(self, text: str) -> str:
        """The text without what differs from run to run."""
        for place, name in ((self.folder, "<folder>"), (self.root, "<checkout>")):
            text = text.replace(str(place), name)
        text = re.sub(r'("footfit_version": ?)"[^"]*"', r'\1"<version>"', text)
        text = re.sub(r"<folder>/out\d+\.", "<folder>/out.", text)
        return TIMESTAMP.sub("<time>", text)

    def answers(self, run: str, arguments: tuple[str, ...], number: int) -> Iterator[Answer]:
        """What one command answers: documents, outcome, messages and written files."""
        given, outputs = [], []
        for word in run.split():
            if word in OUTPUTS:
                outputs.append(self.folder / f"out{number}.{word.lower()}")
                given.append(str(outputs[-1]))
            else:
                given += arguments if word.isupper() else [word]
        done = self.output("-m", "footfit", *given, "--json")
        about = " ".join(arguments)
        messages = []
        for stream, name in ((done.stdout, run), (done.stderr, f"{run} (stderr)")):
            for line in self.normal(stream).splitlines():
                if line.startswith("{"):
                    document = json.loads(line)
                    yield name, subject(document, about), document
                else:
                    messages.append(line)
        yield f"{run} (outcome)", about, {"exit": done.returncode, "messages": "\n".join(messages)}
        for path in outputs:
            if not path.exists():
                continue
            if path.suffix == ".csv":
                for name, rows in table(self.normal(path.read_text(encoding="utf-8"))):
                    yield f"{run} (table)", f"{about}: {name}", rows
            elif path.suffix == ".json":
                yield f"{run} (file)", about, json.loads(self.normal(path.read_text("utf-8")))
            else:
                digest = hashlib.sha256(path.read_bytes()).hexdigest()
                yield f"{run} (file)", about, {"sha256": digest}


def collect(arguments: argparse.Namespace) -> int:
    """Ask the checkout everything and write the answers; 1 if the checkout does not run."""
    start = time.perf_counter()
    cases = arguments.cases or arguments.scans.parent / "cases"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        copy_inputs(folder, arguments.scans, cases, arguments.samples)
        checkout = Checkout(arguments.python, arguments.footfit_root, folder)
        place = checkout.output("-c", "import footfit; print(footfit.__file__)").stdout.strip()
        if not place.startswith(str(checkout.root)):
            print(f"{arguments.python} does not run footfit from {checkout.root}", file=sys.stderr)
            return 1
        ingest = "ingest-last --manifest samples/lasts.csv"
        answers = list(checkout.answers(ingest, (), 0))
        words = inputs(folder)
        given = [
            (run, choice)
            for run in RUNS
            if fnmatchcase(run, arguments.only)
            for choice in next((words[word] for word in run.split() if word in words), [()])
        ]
        with ThreadPoolExecutor(arguments.jobs) as pool:
            tasks = [
                pool.submit(lambda *task: list(checkout.answers(*task)), run, choice, number)
                for number, (run, choice) in enumerate(given, 1)
            ]
            for task in tasks:
                answers += task.result()
    abouts = numbered([f"{run}\n{about}" for run, about, _ in answers])
    with arguments.output.open("w", encoding="utf-8") as file:
        for (run, _, answer), about in zip(answers, abouts, strict=True):
            line = {"run": run, "about": about.partition("\n")[2], "answer": answer}
            file.write(json.dumps(line, ensure_ascii=False, sort_keys=True) + "\n")
    schemas = Counter(str(a.get("schema", "")) for _, _, a in answers if isinstance(a, dict))
    print(f"{len(given) + 1} commands in {time.perf_counter() - start:.0f} s", file=sys.stderr)
    for schema, count in sorted(schemas.items()):
        print(f"{count:6,} {schema or 'outcomes and files'}", file=sys.stderr)
    return 0
