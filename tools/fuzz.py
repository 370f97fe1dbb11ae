"""Mutated mesh files against the readers: ``python -m tools.fuzz --count 20000 --seed 1``.

Every mutation starts from a sound file of one of the formats. It may be read, or refused by one of
footfit's own input errors; anything else (another exception, a warning, more than 2 s or 500 MB)
is a failure: the seed and the number of the mutation are printed, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from footfit.errors import InputError
from footfit.pipeline.batch.work_limits import WorkLimits, hold_to_limits
from tests import corpus, packed
from tests.reading import scan_from_bytes

LIMITS = WorkLimits(seconds=2.0, address_bytes=500_000_000)
FORMATS = {
    "stl": (corpus.stl, lambda: corpus.ascii_stl(faces=corpus.FACES[:40])),
    "ply": (corpus.ply, corpus.ascii_ply),
    "obj": (corpus.obj,),
    "off": (corpus.off,),
    "glb": (packed.glb,),
    "3mf": (packed.threemf, lambda: corpus.loose(packed.model())),
}
WORDS = (
    *(b"nan", b"-1", b"1e400", b"0", b"99999999999", b"-inf", b"0x7f", b"1_0", b".", b"/"),
    *(b"f 1", b"v 1 2", b"endloop", b"facet", b"element face 7", b"end_header\n", b"solid"),
    *(b"\n", b"\r", b"\t", b" " * 50, b"\0", b"\xff" * 4, b"\xff\xff\xff\x7f", b"\xef\xbb\xbf"),
    *(b"<!DOCTYPE a>", b"</mesh>", b'"count":', b"[[[[", b"PK\1\2", b"PK\5\6"),
)
NAMES = ("foot.stl", "foot.ply", "foot.obj", "foot.off", "foot.glb", "foot.3mf", "foot", None)


@dataclass(slots=True)
class Tally:
    """What became of the mutations of one format."""

    read: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    failures: list[str] = field(default_factory=list)
    slowest_s: float = 0.0


def mutated(data: bytes, rng: np.random.Generator) -> bytes:
    """The bytes with one to six changes, half of the time such as keep every length."""
    changed = bytearray(data)
    in_place = rng.random() < 0.5
    for _ in range(rng.integers(1, 7)):
        size = len(changed)
        at = int(rng.integers(0, (min(size, 400) if rng.random() < 0.4 else size) + 1))
        length = int(rng.integers(0, 40))
        change = int(rng.choice((4, 6)) if in_place else rng.integers(0, 7))
        if change == 0:
            changed[at : at + length] = rng.bytes(int(rng.integers(0, 12)))
        elif change == 1:
            changed[at : at + length] = WORDS[int(rng.integers(len(WORDS)))]
        elif change == 2:
            del changed[at : at + length]
        elif change == 3:
            changed[at:at] = changed[at : at + 20 * length]
        elif change == 4 and at < size:
            changed[at] ^= 1 << int(rng.integers(8))
        elif change == 5 and rng.random() < 0.3:
            del changed[at:]
        elif change == 6:
            changed[at : at + 4] = int(rng.integers(2**32)).to_bytes(4, "little")
    return bytes(changed)


def trial(data: bytes, name: str | None, tally: Tally, label: str) -> None:
    """Read one mutation and count what became of it."""
    begin = time.perf_counter()
    try:
        with warnings.catch_warnings(), hold_to_limits(LIMITS):
            warnings.simplefilter("error")
            scan = scan_from_bytes(data, path=name, units="mm")
        sound = np.isfinite(scan.vertices_mm).all() and scan.faces.max() < len(scan.vertices_mm)
        if not sound or scan.faces.min() < 0:
            tally.failures.append(f"{label}: an unsound mesh was read")
        tally.read += 1
    except InputError as error:
        tally.refused[error.code] += 1
        if "\n" in error.message or error.message.startswith("took "):
            tally.failures.append(f"{label}: {error.message}")
    except Exception as error:  # noqa: BLE001 - what this program looks for
        tally.failures.append(f"{label}: {type(error).__name__}: {error}")
    tally.slowest_s = max(tally.slowest_s, time.perf_counter() - begin)


def tallies(count: int, seed: int) -> dict[str, Tally]:
    """``count`` mutations, shared out over the formats; the same for the same seed."""
    import trimesh  # noqa: F401 - what the first GLB waits for is no work on it

    found = {name: Tally() for name in FORMATS}
    sound = {name: [make() for make in makers] for name, makers in FORMATS.items()}
    formats = list(FORMATS)
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        format_ = formats[number % len(formats)]
        start = sound[format_][int(rng.integers(len(sound[format_])))]
        name = NAMES[int(rng.integers(len(NAMES)))] if rng.random() < 0.5 else f"foot.{format_}"
        trial(mutated(start, rng), name, found[format_], f"{format_} seed {seed} number {number}")
    return found


def table(found: dict[str, Tally]) -> str:
    """One line per format."""
    lines = [f"{'format':8}{'read':>8}{'refused':>9}{'failed':>8}{'slowest':>10}  refused as"]
    for name, tally in found.items():
        refused = ", ".join(f"{code} {n}" for code, n in sorted(tally.refused.items()))
        lines.append(
            f"{name:8}{tally.read:8}{sum(tally.refused.values()):9}{len(tally.failures):8}"
            f"{tally.slowest_s:8.2f} s  {refused}"
        )
    return "\n".join(lines)


def main() -> int:
    """Run the mutations, print the table, then every failure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    found = tallies(given.count, given.seed)
    print(f"{given.count} mutated mesh files, seed {given.seed}")
    print(table(found))
    failures = [line for tally in found.values() for line in tally.failures]
    print("\n".join(failures) or "nothing but a mesh or footfit's own refusal came out")
    return 1 if failures else 0


if __name__ == "__main__":
    raise SystemExit(main())
