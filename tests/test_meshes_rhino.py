"""``.3dm``: what is shown of a model, its unit, its surfaces without gaps, and damaged files."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.errors import BadOption, DamagedMesh, EmptyMesh, InputError, UnknownFormat
from footfit.geometry.mesh.topology import boundary_edges, is_closed
from footfit.meshes.read import file_mesh
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.meshes.rhino import from_3dm, to_3dm, watched_process
from footfit.meshes.write import encoded_mesh
from tests import rhino_models as rhino
from tests.distortions import subdivided
from tests.rhino_models import FACES, VERTICES
from tests.shapes import ellipsoid
from tests.solids import signed_volume
from tools.fuzz import mutated


def read(data: bytes):
    return from_3dm.read_3dm(data, LIMITS)


def codes(raw) -> list[str]:
    return [notice.code for notice in raw.warnings]


def test_a_mesh_comes_back_bit_for_bit():
    raw = read(encoded_mesh(VERTICES, FACES, "3dm"))
    assert np.array_equal(raw.vertices, VERTICES)
    assert np.array_equal(raw.faces, FACES)
    assert (raw.unit, raw.warnings) == ("mm", ())


@pytest.mark.parametrize(
    ("unit", "name", "scale"),
    [
        ("Inches", "in", 1.0),
        ("Meters", "m", 1.0),
        ("Feet", "in", 12.0),
        ("Microns", "mm", 0.001),
        ("None", None, 1.0),
    ],
)
def test_the_models_unit_is_taken(unit, name, scale):
    raw = read(rhino.model(unit=unit))
    assert raw.unit == name
    assert np.allclose(raw.vertices, VERTICES * scale, rtol=1e-12, atol=0)


@pytest.mark.parametrize("version", [2, 4, 5, 8])
def test_files_of_older_versions_are_read(version):
    model = rhino.Model().add(rhino.mesh())
    raw = read(model.data(version))
    assert np.allclose(raw.vertices, VERTICES, atol=1e-5)  # float32 before version 6
    with pytest.raises(DamagedMesh, match="cut off"):
        read(model.data(version)[:-50])


def test_a_unit_that_no_last_has_is_refused():
    with pytest.raises(UnknownFormat, match="set it to millimetres"):
        read(rhino.model(unit="LightYears"))


def test_quads_become_triangles():
    square = np.array([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 4.0]])
    raw = read(rhino.model(rhino.mesh(square, np.array([[0, 1, 2, 3]]))))
    assert raw.faces.tolist() == [[0, 1, 2], [0, 2, 3]]  # the shorter diagonal


def test_what_is_hidden_is_left_out_and_counted():
    model = rhino.Model()
    hidden = model.layer(visible=False)
    inside, shown = model.layer(inside=hidden), model.layer()
    for layer in (hidden, inside, shown):
        model.add(rhino.mesh(), layer)
    model.add(rhino.mesh(), visible=False)
    raw = read(model.data())
    assert len(raw.faces) == len(FACES)
    assert codes(raw) == ["hidden_objects"]
    assert raw.warnings[0].message.startswith("3 hidden objects")


def test_a_model_in_which_all_is_hidden_is_empty():
    with pytest.raises(EmptyMesh, match="1 objects are hidden"):
        read(rhino.hidden_model())


def test_blocks_in_blocks_stand_where_they_were_put():
    model = rhino.Model()
    inner = model.block(rhino.mesh())
    outer = model.block(model.place(inner, (0, 9, 0), 90.0))
    model.add(model.place(outer, (500, 0, 0), 90.0))
    raw = read(model.data())
    # twice a quarter turn about Z; the shift of the inner one is turned by the outer
    assert np.allclose(raw.vertices, VERTICES * [-1, -1, 1] + [500 - 9, 0, 0], atol=1e-9)
    assert np.array_equal(raw.faces, FACES)


def test_a_surface_without_a_render_mesh_is_refused():
    with pytest.raises(UnknownFormat, match=r"5 surfaces of the \.3dm have no render mesh"):
        read(rhino.brep_model([(VERTICES, FACES)]))


def patches(gap: float):
    """An ellipsoid in six sectors, every other one finer, which lie apart by up to a gap."""
    vertices, faces = ellipsoid((125.0, 50.0, 35.0), subdivisions=3)
    middle = vertices[faces].mean(axis=1)
    sector = np.floor((np.arctan2(middle[:, 2], middle[:, 1]) / np.pi + 1.0) * 3.0) % 6
    cut = []
    for number in range(6):
        used, corners = np.unique(faces[sector == number], return_inverse=True)
        points, triangles = vertices[used], corners.reshape(-1, 3)
        away = points.mean(axis=0) * [0, 1, 1]
        points = points + 0.5 * gap * away / np.linalg.norm(away)
        cut.append(subdivided(points, triangles) if number % 2 else (points, triangles))
    return cut


@pytest.mark.parametrize("gap", [0.02, 0.4])
def test_gaps_between_patches_are_closed(gap):
    raw = read(rhino.brep_model(patches(gap)))
    assert is_closed(raw.faces)
    assert codes(raw) == ["gaps_closed"]
    whole = signed_volume(*ellipsoid((125.0, 50.0, 35.0), subdivisions=3))
    assert signed_volume(raw.vertices, raw.faces) == pytest.approx(whole, rel=gap / 35.0)


@pytest.mark.parametrize("kind", ["sphere", "cylinder", "extrusion"])
def test_the_solids_of_rhino_are_read_by_their_render_meshes(kind):
    """Seams have their vertices twice, poles many times, and caps other ones than the side."""
    mesh = file_mesh(rhino.solid_model(kind), "solid.3dm").mesh
    radius, height = rhino.RADIUS_MM, rhino.HEIGHT_MM
    whole = 4.0 / 3.0 * radius if kind == "sphere" else height
    assert is_closed(mesh.faces)
    volume = signed_volume(mesh.vertices, mesh.faces)
    assert volume == pytest.approx(np.pi * radius**2 * whole, rel=0.02)  # of chords: 0.002 to 0.01


def test_a_wide_gap_stays_open():
    raw = read(rhino.brep_model(patches(3.0)))
    assert len(boundary_edges(raw.faces)) > 100
    assert "gaps_open" in codes(raw)


def test_a_gap_that_stays_open_is_said_with_what_to_do():
    raw = read(rhino.brep_model(patches(1.4)))  # sectors at 60 degrees: .7 mm apart
    assert "gaps_open" in codes(raw)
    message = raw.warnings[-1].message
    assert "gaps of about 0.7 mm, and footfit closes 0.5 mm" in message
    assert "join the surfaces in Rhino" in message


# ---------------------------------------------------------------- what is wrong


def test_without_rhino3dm_the_message_says_how_to_install_it(monkeypatch, footfit, tmp_path):
    data = rhino.model()
    path = tmp_path / "last.3dm"
    path.write_bytes(data)
    for module in (from_3dm, to_3dm):
        monkeypatch.setattr(module, "is_installed", lambda: False)
    with pytest.raises(UnknownFormat, match=r"pip install 'footfit\[rhino\]'"):
        read(data)
    with pytest.raises(BadOption, match=r"pip install 'footfit\[rhino\]'"):
        encoded_mesh(VERTICES, FACES, "3dm")
    done = footfit("align", path)
    assert done.code == 3
    assert "type pip install 'footfit[rhino]'" in done.err


def test_a_cut_off_file_is_refused_at_once(monkeypatch):
    data = rhino.model()
    monkeypatch.setattr(from_3dm, "run", None)
    for end in (32, 33, 100, len(data) // 2, len(data) - 1):
        with pytest.raises(DamagedMesh, match="cut off"):
            read(data[:end])
    with pytest.raises(DamagedMesh, match="cut off"):
        read(data.replace(b"       80", b"    eight"))


def test_damaged_files_give_a_mesh_or_one_line(monkeypatch):
    """rhino3dm itself looks for many seconds through some of them, and is stopped."""
    monkeypatch.setattr(watched_process, "RHINO", watched_process.RhinoSettings(seconds=1.5))
    sound, refusals = rhino.model(), []
    for number in range(16):
        try:
            file_mesh(mutated(sound, np.random.default_rng([3, number])), "last.3dm")
        except InputError as error:
            refusals.append(error.message)
    assert 0 < len(refusals) < 16
    assert not [words for words in refusals if "\n" in words]


def test_more_than_the_limits_is_refused():
    with pytest.raises(InputError, match="100"):
        from_3dm.read_3dm(rhino.model(), Limits(faces=100))
    model = rhino.Model()
    block = model.block(rhino.mesh())
    for _ in range(3):
        block = model.block(*(model.place(block) for _ in range(10)))
    model.add(model.place(block))
    with pytest.raises(DamagedMesh, match="blocks"):
        read(model.data())
