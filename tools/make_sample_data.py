"""Make sample_data/: lasts in assorted poses, their manifest, and feet copied as they are.

    python -m tools.make_sample_data FEET [-o sample_data]

FEET is the folder of CC0 feet that ``sample_data/README.md`` names; ``sample_data/feet`` will do.
Same input, same bytes.
"""

from __future__ import annotations

import argparse
import csv
import io
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.meshes.write import encoded_mesh
from tools.lasts import LastSpec, last_mesh

FEET = ("mh007_L.stl", "mh007_R.stl", "mh008_R.stl")
COLUMNS = (
    "path",
    "name",
    "style",
    "size",
    "size_system",
    "width_label",
    "side",
    "units",
    "heel_height_mm",
)
PARIS_POINT_MM = 20.0 / 3.0  # an EU size is the last's length in Paris points
SHIFT_MM = 400.0
GRADED = (
    "ball_width_mm",
    "heel_width_mm",
    "waist_width_mm",
    "joint_bulge_mm",
    "waist_cut_mm",
    "ridge_mm",
    "arch_cut_mm",
    "cone_height_mm",
)


@dataclass(frozen=True, slots=True)
class Style:
    """A family of lasts: its model in size 40, its width label, its (size, side, unit) lasts."""

    name: str
    model: LastSpec
    width_label: str
    lasts: tuple[tuple[int, str, str], ...]


def size_length_mm(size: int) -> float:
    """Length of a last of an EU size: the foot's length is 13.3 mm less, as 1.5 FL_cm + 2 says.

    >>> round(size_length_mm(42), 3), round((size_length_mm(42) - 40 / 3) / 10 * 1.5 + 2, 9)
    (280.0, 42.0)
    """
    return size * PARIS_POINT_MM


# The shapes follow what real lasts show: the inner joint lies at .67 to .69 of the length, the
# instep is a round ridge to the medial side, the waist is lifted there, the seat slopes half as
# much as the way from seat to tread, which lies level. The numbers of derby and loafer are those of
# a search, so that each sample customer has a last that is good by the profile `walking`
# (docs/decisions/0283-the-nine-profiles.md). Walls that are more upright would hang over the widest
# row.
MODEL = LastSpec(
    length_mm=size_length_mm(40),
    mt1_station=0.61,
    mt5_station=0.49,
    joint_bulge_mm=5.5,
    waist_cut_mm=-4.0,
    toe_turn_deg=7.0,
    ridge_mm=16.0,
    medial_wall=0.68,
    feather_inset=0.03,
    sole_crown=0.1,
    cone_height_mm=89.0,
    cone_width=0.35,
    seat_pitch=0.5,
    break_station=0.70,
    spring_station=0.72,
    level_tread=True,
    rings=58,
    segments=44,
)
STYLES = (
    Style(
        "derby",
        replace(
            MODEL,
            heel_height_mm=25.0,
            toe_spring_mm=12.3,
            flare_deg=8.5,
            toe_turn_deg=5.8,
            ball_width_mm=96.2,
            heel_width_mm=58.1,
            waist_width_mm=72.3,
            waist_cut_mm=-1.2,
            joint_bulge_mm=3.2,
            mt1_station=0.608,
            mt5_station=0.491,
            ridge_mm=18.1,
            medial_wall=0.81,
            feather_inset=0.067,
            sole_crown=0.63,
            break_length=0.1,
            cone_height_mm=96.6,
            cone_length=0.293,
            cone_width=0.336,
            fullness=1.151,
            arch_mm=4.4,
            arch_cut_mm=11.3,
        ),
        "G",
        (
            (38, "right", "mm"),
            (39, "right", "mm"),
            (40, "right", "mm"),
            (41, "left", "mm"),
            (43, "right", "mm"),
        ),
    ),
    Style(
        "loafer",
        replace(
            MODEL,
            heel_height_mm=18.0,
            toe_spring_mm=10.4,
            flare_deg=8.6,
            toe_turn_deg=10.0,
            ball_width_mm=91.9,
            heel_width_mm=56.8,
            waist_width_mm=71.9,
            waist_cut_mm=-2.4,
            joint_bulge_mm=5.9,
            mt1_station=0.601,
            mt5_station=0.519,
            ridge_mm=17.4,
            medial_wall=0.8,
            feather_inset=0.054,
            sole_crown=0.0,
            break_length=0.19,
            cone_height_mm=95.7,
            cone_length=0.296,
            cone_width=0.444,
            fullness=0.943,
            arch_mm=4.9,
            arch_cut_mm=17.9,
        ),
        "E",
        ((39, "right", "mm"), (40, "left", "mm"), (42, "right", "mm"), (43, "right", "mm")),
    ),
    Style(
        "trainer",
        replace(
            MODEL,
            heel_height_mm=12.0,
            toe_spring_mm=11.0,
            flare_deg=11.0,
            ball_width_mm=93.8,
            heel_width_mm=62.0,
            waist_width_mm=75.5,
            waist_cut_mm=-6.0,
            joint_bulge_mm=6.5,
            break_length=0.22,
            cone_height_mm=87.0,
            cone_width=0.40,
            fullness=1.03,
            arch_cut_mm=10.0,
        ),
        "H",
        (
            (38, "right", "mm"),
            (40, "right", "mm"),
            (41, "right", "m"),
            (42, "left", "mm"),
            (43, "right", "mm"),
        ),
    ),
)


def sized(model: LastSpec, size: int) -> LastSpec:
    """The model in an EU size: graded with its length, the heel and the toe spring kept."""
    ratio = size_length_mm(size) / model.length_mm
    grown = {
        name: getattr(model, name) * ratio for name in GRADED if getattr(model, name) is not None
    }
    return replace(model, length_mm=size_length_mm(size), **grown)


def posed(vertices_mm: Floats, rng: np.random.Generator) -> Floats:
    """The vertices turned by a uniform random rotation and shifted."""
    w, x, y, z = (q := rng.normal(size=4)) / np.linalg.norm(q)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    moved: Floats = vertices_mm @ turn.T + rng.uniform(-SHIFT_MM, SHIFT_MM, 3)
    return moved


def last_files(style: Style, rng: np.random.Generator) -> list[tuple[dict[str, str], bytes]]:
    """The manifest rows and file contents of a style's lasts."""
    files = []
    for size, side, units in style.lasts:
        spec = sized(style.model, size)
        vertices_mm, faces = last_mesh(replace(spec, side=side))
        vertices = posed(vertices_mm, rng) * {"mm": 1.0, "m": 1e-3}[units]
        name = f"{style.name}-{size}"
        values = (
            f"lasts/{name}.stl",
            name,
            style.name,
            str(size),
            "eu",
            style.width_label,
            side,
            units,
            f"{spec.heel_height_mm:g}",
        )
        row = dict(zip(COLUMNS, values, strict=True))
        files.append((row, encoded_mesh(vertices, faces, "stl")))
    return files


def manifest(rows: list[dict[str, str]]) -> str:
    """The rows as CSV text."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def write_samples(feet: Path, folder: Path) -> None:
    """Write lasts, manifest and feet into ``folder``."""
    for name in ("lasts", "feet"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(2)
    files = [entry for style in STYLES for entry in last_files(style, rng)]
    for row, content in files:
        (folder / row["path"]).write_bytes(content)
    (folder / "lasts.csv").write_text(manifest([row for row, _ in files]), encoding="utf-8")
    for name in FEET:
        content = (feet / name).read_bytes()  # FEET may be the output's own folder
        (folder / "feet" / name).write_bytes(content)


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("feet", type=Path, help="the folder of CC0 feet")
    parser.add_argument("-o", "--output", type=Path, default=Path("sample_data"))
    given = parser.parse_args()
    write_samples(given.feet, given.output)


if __name__ == "__main__":
    main()
