"""The rules of single stored values: what lies just inside passes, what lies just outside does not.

Values that belong together (curves and stations, transform and unit) are tried as whole rows.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from footfit.catalogue.checks.plausible_values import implausible
from footfit.catalogue.rows.array_blobs import array_of, blob
from footfit.catalogue.rows.columns import TABLES
from footfit.catalogue.rows.rules import is_rotation
from footfit.catalogue.rows.verified_rows import LastRows, stored_lasts
from footfit.catalogue.store import open_catalogue
from tests import records
from tests.answers import turned

MIRROR = np.diag([1.0, 1.0, -1.0])
TILTED = turned(0.7)
HASH = "0" * 63
RULES: dict[str, tuple[list[object], list[object]]] = {
    "last.name": (["a", " a"], ["", " ", 7, None]),
    "last.content_sha256": ([HASH + "f"], [HASH, HASH + "00", HASH + "g", HASH + "F", 7, None]),
    "last.units": (["mm", "cm", "m", "in", "scaled"], ["ft", "", None]),
    "last.units_source": (["declared", "detected", "known-length"], ["given", None]),
    "last.unit_scale": ([1e-9, 25.4], [0, 0.0, -1e-9, math.inf, math.nan, "1", None]),
    "last.vertices": ([1], [0, -1, None]),
    "last.faces": ([1], [0, -1, None]),
    "last.watertight": ([0, 1], [2, -1, None]),
    "last.side": (["left", "right", None], ["middle", ""]),
    "last.side_confidence": (["sure", "low", "undecided"], ["high", None]),
    "last.side_score": ([-9.0, 9], [math.inf, "1", None]),
    "last.side_source": (["given", "detected"], ["declared", None]),
    "last.heel_height_mm": ([0.0, None], [math.inf, b""]),
    "last.format": (["stl", ""], [7, None]),
    "last.parent_id": ([3, None], [1.5, "3"]),
    "frame.centroid_mm": ([blob(np.zeros(3))], [blob(np.array([0, np.nan, 0])), blob(np.zeros(4))]),
    "frame.eigenvectors": (
        [blob(np.eye(3)), blob(TILTED)],
        [blob(MIRROR), blob(TILTED @ MIRROR), blob(1.00001 * TILTED), blob(np.zeros(9))[:-8]],
    ),
    "frame.eigenvalues_mm2": (
        [blob(np.array([9.0, 0.0, 1.0]))],
        [blob(np.array([9.0, -1e-9, 1.0])), blob(np.array([np.inf, 1, 1])), blob(np.ones(2))],
    ),
    "frame.pose_cost": ([0.0], [-1e-9, None]),
    "frame.pose_kind": (["foot", "last"], ["hand", None]),
    "frame.pose_sole": ([0, 1], [2]),
    "frame.length_mm": ([50.0, 1000.0], [49.99, 1000.01, None]),
    "frame.canonical_transform": ([blob(np.eye(4))], [blob(np.eye(3)), blob(np.full(16, np.inf))]),
    "frame.paper_transform": ([blob(np.eye(4)), None], [blob(np.eye(3))]),
    "flare.angle_deg": ([-90.0, 90.0, None], [-90.01, 90.01]),
    "flare.angle_sd_deg": ([0.0, None], [-1e-9]),
    "flare.flare_class": (["outflare", "straight", "inflare"], ["flat", None]),
    "flare.stations": (
        [blob(np.array([0.0, 0.5, 1.0]))],
        [
            blob(np.array(values))
            for values in ([-1e-9, 0.5], [0.5, 1.00001], [0.5, 0.5], [0.6, 0.5], [])
        ],
    ),
    "flare.heading_deg": ([blob(np.array([np.nan, 3.0]))], [blob(np.array([np.inf])), "3", None]),
    "flare.centre_line": ([blob(np.zeros(6))], [blob(np.zeros(5)), None]),
    "flare.curvature_plan": ([blob(np.zeros(5)), None], [blob(np.array([-np.inf]))]),
    "measure.name": (["length"], ["", None]),
    "measure.position": ([0, 3], [-1, None]),
    "measure.sd": ([0.0, None], [-1e-9]),
    "measure.value": ([-3.5, None], [math.inf]),
    "mesh_copy.faces": ([1], [0]),
    "mesh_copy.error_mm": ([0.0], [-1e-9, None]),
    "mesh_copy.data": ([b""], ["", None]),
    "reference.om_e": ([blob(TILTED)], [blob(MIRROR)]),
}
CASES = [
    (name, value, holds)
    for name, values in RULES.items()
    for holds, several in zip((True, False), values, strict=True)
    for value in several
]
COLUMNS = {f"{table.name}.{column.name}": column for table in TABLES for column in table.columns}


@pytest.mark.parametrize(("name", "value", "holds"), CASES)
def test_a_column_takes_what_a_scan_can_give_and_nothing_else(name, value, holds) -> None:
    assert (COLUMNS[name].implausible(value) is None) == holds


@pytest.mark.parametrize("off", [0.5e-6, -0.5e-6])
def test_a_rotation_may_be_rounded_but_not_mirrored(off: float) -> None:
    rounded = TILTED * (1.0 + 0.5 * off)
    assert is_rotation(rounded)
    assert not is_rotation(TILTED * (1.0 + 2.0 * off))
    assert not is_rotation(rounded @ MIRROR)
    assert not is_rotation(-rounded)


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> LastRows:
    """The rows of a sound last."""
    path = tmp_path_factory.mktemp("rows") / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last())
        (rows,) = stored_lasts(catalogue.file.connection)
    assert list(implausible(rows)) == []
    return rows


def changed(rows: LastRows, table: str, **columns: object) -> LastRows:
    """The rows with other values in one table's row."""
    return replace(rows, **{table: getattr(rows, table) | columns})


def test_a_transform_is_a_rigid_motion_with_the_units_scale(stored: LastRows) -> None:
    scale = stored.last["unit_scale"]
    matrix = array_of(stored.frame["canonical_transform"], 4, 4)
    sheared, mirrored, shifted, endless = (matrix.copy() for _ in range(4))
    sheared[0, 1] += 0.01 * scale
    mirrored[:3, 0] *= -1.0
    shifted[3] = (0.0, 0.0, 1.0, 1.0)
    endless[0, 3] = np.nan
    for wrong in (sheared, mirrored, shifted, endless, 2.0 * matrix):
        rows = changed(stored, "frame", canonical_transform=blob(wrong))
        assert any("rigid motion" in words for words in implausible(rows))
    moved = matrix.copy()
    moved[:3, 3] += 40.0
    assert list(implausible(changed(stored, "frame", canonical_transform=blob(moved)))) == []
    scaled = changed(stored, "last", unit_scale=2.0 * scale)
    assert any("rigid motion" in words for words in implausible(scaled))


def test_curves_have_a_value_per_station(stored: LastRows) -> None:
    flare = stored.flare
    count = len(array_of(flare["stations"]))
    heading = array_of(flare["heading_deg"]).copy()
    for column in ("heading_deg", "curvature_plan", "centre_line"):
        data = flare[column]
        for wrong in (data[:-16], data + data[-16:]):
            rows = changed(stored, "flare", **{column: wrong})
            assert any("curves" in words for words in implausible(rows)), column
    for degrees, sound in ((180.0, True), (-180.0, True), (180.01, False), (-180.01, False)):
        heading[count // 2] = degrees
        rows = changed(stored, "flare", heading_deg=blob(heading))
        assert (list(implausible(rows)) == []) == sound
    heading[count // 2] = np.nan
    assert list(implausible(changed(stored, "flare", heading_deg=blob(heading)))) == []


def test_a_definition_has_the_version_that_its_row_names(stored: LastRows) -> None:
    rows = changed(stored, "flare", definition_version="flare/0")
    assert any("version" in words for words in implausible(rows))


def test_each_table_is_looked_at(stored: LastRows) -> None:
    wrong = [
        changed(stored, "last", side="middle"),
        changed(stored, "frame", pose_kind="hand"),
        changed(stored, "flare", flare_class="flat"),
        replace(stored, measures=(*stored.measures[1:], stored.measures[0] | {"sd": -1.0})),
        replace(stored, notices=(*stored.notices, {"position": 0.5, "code": "a", "message": ""})),
    ]
    columns = ("last.side", "frame.pose_kind", "flare.flare_class", "measure.sd", "notice.position")
    for rows, column in zip(wrong, columns, strict=True):
        (words,) = implausible(rows)
        assert words.startswith(f"{column} is ")


def test_a_name_that_came_meanwhile_is_not_taken(tmp_path: Path) -> None:
    from footfit.errors import OutputExists
    from footfit.whole_files import give_name

    ours, theirs = tmp_path / "ours.partial", tmp_path / "backup.footfit"
    ours.write_text("ours")
    theirs.write_text("theirs")
    with pytest.raises(OutputExists, match="--force"):
        give_name(ours, theirs, replace=False)
    assert (ours.read_text(), theirs.read_text()) == ("ours", "theirs")
    give_name(ours, theirs, replace=True)
    assert theirs.read_text() == "ours"
