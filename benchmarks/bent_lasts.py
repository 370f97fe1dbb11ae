"""One last bent to higher heels: its flare, the length of its bottom and its ball girth.

    python -m benchmarks.bent_lasts [--write]

A flat last of each family is bent from heel 0 to 110 mm. Its sections stay upright, turn half with
the bottom, or turn all the way (``tools/bent_lasts.py``). *By the bend* is what the bend does to
the girth itself: the least girth of all planes through the two places of the surface that were the
joints of the flat last, by a search that shares no code with footfit (``tests/tape_peer.py``).
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchmarks import stance
from benchmarks.tables import markdown, put
from footfit.errors import FootfitError
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.flare_profile import bottom_profile
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats, Ints
from tests.tape_peer import edges_of, least_about
from tools.bent_lasts import bent
from tools.last_specs import LastSpec
from tools.lasts import last_mesh
from tools.resting import at_rest

HEELS_MM = (0.0, 60.0, 80.0, 95.0, 110.0)
TURNINGS = {"upright": 0.0, "half turned": 0.5, "turned": 1.0}
OWN = LastSpec(heel_height_mm=0.0, toe_spring_mm=6.0, level_tread=True, rings=110, segments=80)
OTHERS = ((231.0, 11), (261.0, 12))  # length in mm, seed
NAMES = ("heel_height", "bottom_length", "ball_girth_least")
HEADS = ["last", "sections", "read", *(f"heel {heel_mm:.0f}" for heel_mm in HEELS_MM[1:])]
ROWS = ("heel height, mm", "flare, deg", "bottom length, mm", "ball girth, mm", "by the bend, mm")


@dataclass(frozen=True)
class Flat:
    """A last without a heel as it stands, and its length along the ground."""

    name: str
    vertices_mm: Floats
    faces: Ints
    length_mm: float


def flat_lasts() -> Iterator[Flat]:
    """Flat lasts of both families."""
    for length_mm in (255.0, 275.0):
        yield _standing(f"own, {length_mm:.0f} mm", *last_mesh(replace(OWN, length_mm=length_mm)))
    if stance.second_family():
        import lasts2

        for length_mm, seed in OTHERS:
            spec = lasts2.random_last(np.random.default_rng(seed), length=length_mm)
            spec.heel_height, spec.toe_spring = 0.0, 5.0
            mesh = lasts2.mesh(spec, n_long=130, n_round=80)
            resting, _ = at_rest(np.array(mesh.vertices))
            yield _standing(f"lasts2, {length_mm:.0f} mm", resting, np.array(mesh.faces))


def _standing(name: str, vertices_mm: Floats, faces: Ints) -> Flat:
    stands = stance.stance_of(vertices_mm, faces, "last")
    assert stands is not None
    turn = stands.standing_transform
    return Flat(name, vertices_mm @ turn[:3, :3].T + turn[:3, 3], faces, stands.length_mm)


def readings(last: Flat, turning: float) -> Floats:
    """What is read at each heel, (heels, rows); NaN where there is nothing."""
    rows, joints = [], None
    for heel_mm in HEELS_MM:
        high = bent(last.vertices_mm, last.length_mm, heel_mm, turning)
        shape = Shape(at_rest(high)[0], last.faces, "last")
        if joints is None and shape.joints is not None:
            joints = [nearest_places(shape, place) for place in shape.joints]
        rows.append([*_read(shape), np.nan if joints is None else _by_the_bend(shape, joints)])
    return np.array(rows)


def nearest_places(shape: Shape, place: Floats) -> Ints:
    """The vertices that stand for a place of the surface: the nearest."""
    return np.argsort(np.linalg.norm(shape.vertices_mm - place, axis=1))[:1]


def _read(shape: Shape) -> list[float]:
    values = [measure_named(name).value_of(shape).value for name in NAMES]
    heel_mm, bottom_mm, girth_mm = (np.nan if value is None else value for value in values)
    definition = FlareDefinition()
    try:
        profile = bottom_profile(shape.flat_bottom, shape.vertices_mm, "last", definition)
    except FootfitError:
        return [heel_mm, np.nan, bottom_mm, girth_mm]
    return [heel_mm, profile.angle_deg, bottom_mm, girth_mm]


def _by_the_bend(shape: Shape, joints: list[Ints]) -> float:
    outer, inner = (shape.vertices_mm[near].mean(axis=0) for near in joints)
    return least_about(shape.vertices_mm, edges_of(shape.faces), outer, inner, shape.upright)


def rows(lasts: Iterator[Flat]) -> Iterator[list[str]]:
    """A row for each last, bend and reading: its change from heel 0."""
    for last in lasts:
        for word, turning in TURNINGS.items():
            read = readings(last, turning)
            for name, values in zip(ROWS, read.T, strict=True):
                change = values[1:] - (0.0 if name == ROWS[0] else values[0])
                cells = [f"{value:.1f}" if name == ROWS[0] else f"{value:+.2f}" for value in change]
                yield [last.name, word, name, *cells]


def main() -> None:
    """Print the table, or write it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    text = markdown(HEADS, list(rows(flat_lasts())))
    print(text)
    if options.write:
        put("stance.md", "bends", text)


if __name__ == "__main__":
    main()
