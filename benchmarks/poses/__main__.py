"""Is the pose right, and the side, for lasts and feet of every kind: many seeded cases.

    python -m benchmarks.poses [--count 600] [--seed 11] [--family feet] [--write]

A third of the cases are lasts of the project's generator, a third of ``../shared/tools/lasts2.py``
and a third feet; without the folder beside the project only the first are tried. Each is aligned
once in a random pose, side and unit. ``--write`` puts the table into docs/alignment.md.
"""

from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from benchmarks.poses.case import Case, Outcome, outcome
from benchmarks.poses.feet import foot
from benchmarks.poses.lasts import TOOLS, other_last, own_last
from benchmarks.tables import markdown, put

FLARED_DEG = 2.0  # from here on the side must be known
HEADS = (
    "family", "kind", "heel, mm", "cases", "right", "wrong", "refused",
    "side right", "wrong and sure", "undecided", "pitch off, deg", "s of a core",
)  # fmt: skip
Row = tuple[Case, Outcome]


def families() -> dict[str, Callable[[np.random.Generator, int], Case]]:
    """What draws a case of each family that is at hand."""
    if not TOOLS.exists():
        return {"own lasts": own_last}
    return {"own lasts": own_last, "lasts2": other_last, "feet": foot}


def results(names: Iterable[str], count: int, seed: int) -> Iterator[Row]:
    """``count`` cases, spread over the families, each with its outcome."""
    draws = families()
    chosen = list(names)
    for name in chosen:
        rng = np.random.default_rng(seed)
        for number in range(count // len(chosen)):
            case = draws[name](rng, number)
            yield case, outcome(case, rng)


def line(case: Case, result: Outcome) -> str:
    """What is said of a case that did not come out right."""
    flare = "" if case.flare_deg is None else f", flare {case.flare_deg:.1f}"
    size = f"{case.length_mm:.0f} mm{flare}, cut {case.cut}"
    if result.refused:
        return f"refused: {case.family}, {case.kind}, {case.heel}, {size}: {result.message}"
    return (
        f"{case.family}, {case.kind}, {case.heel}, {size}: axis off {result.axis_deg:.0f} deg, "
        f"pitch {result.pitch_deg:.1f}, roll {result.roll_deg:.1f}, kind {result.kind}, "
        f"cost {result.cost:.2f}, "
        f"margin {result.margin:.2f}, side {'right' if result.side_right else 'wrong'} "
        f"({result.word}), unit {'right' if result.unit_right else 'wrong'}"
    )


def is_plain(case: Case, result: Outcome) -> bool:
    """Whether there is nothing to say of a case."""
    sure = result.side_right or result.word == "undecided"
    foot_or_last = result.kind == ("foot" if case.family == "feet" else "last")
    return not (result.refused or result.wrong) and sure and foot_or_last and result.unit_right


def table(rows: Iterable[Row]) -> Iterator[list[str]]:
    """A row for each family, kind and heel band."""
    groups: dict[tuple[str, str, str], list[Outcome]] = defaultdict(list)
    for case, result in rows:
        groups[case.family, case.kind, case.heel].append(result)
        groups[case.family, "all", ""].append(result)
    for key, group in sorted(groups.items()):
        posed = [each for each in group if not each.refused]
        off = [abs(each.pitch_deg) for each in posed if not each.wrong]
        yield [
            *key,
            str(len(group)),
            str(sum(not each.wrong for each in posed)),
            str(sum(each.wrong for each in posed)),
            str(len(group) - len(posed)),
            str(sum(each.side_right for each in posed)),
            str(sum(each.word == "sure" and not each.side_right for each in posed)),
            str(sum(each.word == "undecided" for each in posed)),
            f"{np.median(off):.1f} / {max(off):.1f}" if off else "-",
            f"{np.median([each.seconds for each in group]):.2f}",
        ]


def main() -> None:
    """Print what did not come out right, then the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--family", action="append", choices=sorted(families()))
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    rows = []
    for case, result in results(options.family or families(), options.count, options.seed):
        rows.append((case, result))
        if options.verbose or not is_plain(case, result):
            print(line(case, result), file=sys.stderr, flush=True)
    text = f"{len(rows)} cases, seed {options.seed}:\n\n" + markdown(HEADS, list(table(rows)))
    print(text)
    if options.write:
        put("alignment.md", "poses", text)


if __name__ == "__main__":
    main()
