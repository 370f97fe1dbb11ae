"""The tables of trueness, and which of their cells miss the bar.

A cell is a measure's errors of one family of lasts and one band of heels.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.tables import markdown
from footfit.geometry.measures.measure_table import of_kind
from tools.last_specs import HEEL_BANDS_MM

FAMILIES = ("own", "lasts2", "feet")
ASKED_INSIDE, ASKED_RATIO = 0.95, (0.8, 1.5)
FEWEST = 5  # of so few lasts a cell says nothing


@dataclass(frozen=True)
class Error:
    """How far a value is from the true one, its total standard deviation, that without the part
    of the trueness, the band of the heel, and the heel by the shape.
    """

    family: str
    band: int
    error: float
    total_sd: float
    other_sd: float
    heel_mm: float | None


Errors = dict[str, list[Error]]
"""By measure."""


def rms(numbers: Sequence[float]) -> float:
    """The root of the mean square."""
    return float(np.sqrt(np.mean(np.square(numbers))))


def trueness_rows(by_measure: Errors, kind: str) -> Iterator[list[str]]:
    """A row a measure: the error of each family, and what values state."""
    families = FAMILIES[2:] if kind == "foot" else FAMILIES[:2]
    for entry in of_kind(kind):
        cells = []
        for family in families:
            off = [e.error for e in by_measure[entry.name] if e.family == family]
            cells += [f"{np.mean(off):+.2f}", f"{rms(off):.2f}"] if off else ["", ""]
        if any(cells):
            known = entry.trueness(kind)
            stated = [
                f"{known.bias:+.2f}",
                f"{entry.sd_of(kind):g}",
                *(f"{sd:.2f}" for sd in known.sd),
            ]
            yield [entry.name, *cells, *stated]


def covered(known: Sequence[Error]) -> tuple[float, float]:
    """The share of true values within 2 total_sd, and the mean total_sd over the RMS error."""
    inside = float(np.mean([abs(e.error) <= 2.0 * e.total_sd for e in known]))
    return inside, float(np.mean([e.total_sd for e in known])) / rms([e.error for e in known])


def outside(by_measure: Errors, kind: str) -> tuple[list[str], int]:
    """The cells of measure, family and band that miss the bar, in words, and how many there are.

    A cell may miss 5 % of its true values, and one more: that is what so few lasts can show.
    """
    words, cells = [], 0
    for entry in of_kind(kind):
        for family, band in groups_of(kind):
            known = _cell_errors(by_measure[entry.name], [(family, band)])
            if len(known) < FEWEST:
                continue
            cells += 1
            inside, ratio = covered(known)
            missed = round((1.0 - inside) * len(known))
            few = missed <= 1 + (1.0 - ASKED_INSIDE) * len(known)
            if not (few and ASKED_RATIO[0] <= round(ratio, 2) <= ASKED_RATIO[1]):
                name = group_words(family, band)
                words.append(f"{entry.name} {name}: {100 * inside:.0f} %, {ratio:.2f}")
    return words, cells


def coverage_rows(by_measure: Errors, kind: str) -> Iterator[list[str]]:
    """A row a measure, and one over all measures: the share within 2 total_sd, and mean total_sd
    over RMS. The columns are all lasts and each family and band; feet have one.
    """
    groups = groups_of(kind)
    columns = [groups, *([group] for group in groups)] if len(groups) > 1 else [groups]
    for entry in of_kind(kind):
        cells = [_cell_errors(by_measure[entry.name], column) for column in columns]
        if any(cells):
            yield [entry.name, *(known_words(*covered(cell)) if cell else "" for cell in cells)]
    of_all = [all_measures(by_measure, kind, column) for column in columns]
    if any(of_all):
        yield ["all measures", *(known_words(*each) if each else "" for each in of_all)]


def known_words(inside: float, ratio: float) -> str:
    """A share and a ratio as a table has them.

    Examples
    --------
    >>> known_words(0.958, 1.12)
    '96 %, 1.1'
    """
    return f"{100 * inside:.0f} %, {ratio:.1f}"


def all_measures(
    by_measure: Errors, kind: str, groups: Sequence[tuple[str, int]]
) -> tuple[float, float] | None:
    """The share within 2 total_sd over all measures of some families and bands, and the geometric
    mean over measures and groups of mean total_sd over RMS; None if nothing is known.
    """
    names = [entry.name for entry in of_kind(kind)]
    cells = [_cell_errors(by_measure[name], [group]) for name in names for group in groups]
    cells = [cell for cell in cells if len(cell) >= FEWEST]
    if not cells:
        return None
    shares, ratios = np.array([covered(cell) for cell in cells]).T
    inside = np.average(shares, weights=[len(cell) for cell in cells])
    return float(inside), float(np.exp(np.log(ratios).mean()))


def _cell_errors(errors: Sequence[Error], groups: Sequence[tuple[str, int]]) -> list[Error]:
    """The errors of some families and bands."""
    return [error for error in errors if (error.family, error.band) in groups]


def group_words(family: str, band: int) -> str:
    """A family and a band as a table has them.

    Examples
    --------
    >>> group_words("own", 0), group_words("feet", 0)
    ('own 0-30', 'feet')
    """
    low, high = HEEL_BANDS_MM[band]
    return "feet" if family == "feet" else f"{family} {low:.0f}-{high:.0f}"


def groups_of(kind: str) -> list[tuple[str, int]]:
    """The families and bands of a kind."""
    if kind == "foot":
        return [("feet", 0)]
    return [(family, band) for family in FAMILIES[:2] for band in range(len(HEEL_BANDS_MM))]


def tables(by_measure: Errors) -> dict[str, str]:
    """The tables of docs/measures.md by name."""
    made = {}
    for kind in ("last", "foot"):
        families = FAMILIES[2:] if kind == "foot" else FAMILIES[:2]
        bands = (
            [""] if kind == "foot" else [f" {low:.0f}-{high:.0f}" for low, high in HEEL_BANDS_MM]
        )
        heads = [f"{family}: {word}" for family in families for word in ("bias", "RMS")]
        heads += ["stated bias", "sd", *(f"trueness{band}" for band in bands)]
        rows = list(trueness_rows(by_measure, kind))
        made[f"trueness-{kind}"] = markdown(["measure", *heads], rows)
        heads = [group_words(family, band) for family, band in groups_of(kind)]
        heads = ["all", *heads] if len(heads) > 1 else heads
        rows = list(coverage_rows(by_measure, kind))
        made[f"coverage-{kind}"] = markdown(["measure", *heads], rows)
    return made
