"""Reading: every bad file ends in its error, every odd one in the mesh that it holds."""

from __future__ import annotations

import builtins
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import (
    BadOption,
    EmptyMesh,
    InputError,
    TooLarge,
    UnknownFormat,
    UnknownUnits,
    UnreadableFile,
)
from footfit.meshes.file_bytes import file_bytes, stream_bytes
from footfit.meshes.read import file_mesh
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.meshes.write import encoded_mesh
from tests import corpus
from tests.conftest import SAMPLES
from tests.reading import read_scan, scan_from_bytes
from tests.solids import surface_area

ROOT = Path(__file__).resolve().parents[1]
AREA = surface_area(corpus.VERTICES, corpus.FACES)


def write(folder: Path, name: str, data: bytes) -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


def codes(scan):
    return [notice.code for notice in scan.warnings]


@pytest.mark.parametrize("bad", corpus.BAD, ids=str)
@pytest.mark.filterwarnings("error")
def test_a_bad_file_ends_in_its_error_and_one_line(bad, tmp_path):
    path = write(tmp_path, bad.name, bad.make())
    with pytest.raises(bad.error) as caught:
        read_scan(path)
    assert type(caught.value) is bad.error
    assert caught.value.path == str(path)
    assert caught.value.message
    assert "\n" not in caught.value.message
    assert caught.value.message.isprintable()


@pytest.mark.parametrize("name", corpus.ODD)
def test_an_odd_file_is_the_mesh_that_it_holds(name, tmp_path):
    scan = read_scan(write(tmp_path, name, corpus.ODD[name]()))
    assert (scan.info.faces, scan.info.vertices) == (len(corpus.FACES), len(corpus.VERTICES))
    assert scan.info.watertight
    # measured 4.1e-09
    assert surface_area(scan.vertices_mm, scan.faces) == pytest.approx(AREA, rel=6.3e-9)


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("trailing.stl", "trailing_bytes"),
        ("called-otherwise.obj", "extension_mismatch"),
        ("ascii-no-end.stl", "end_missing"),
    ],
)
def test_what_is_odd_is_said(name, code, tmp_path):
    assert code in codes(read_scan(write(tmp_path, name, corpus.ODD[name]())))


def test_special_files_are_refused_and_not_waited_for(tmp_path):
    for path, error in corpus.bad_paths(tmp_path):
        with pytest.raises(error) as caught:
            read_scan(path)
        assert "\n" not in caught.value.message


def test_a_file_that_may_not_be_read_is_said_to_be_so(tmp_path, monkeypatch):
    path = write(tmp_path, "foot.stl", corpus.stl())

    def refuse(*_arguments, **_options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", refuse)  # root may read whatever the mode bits say
    with pytest.raises(UnreadableFile, match="may not read"):
        read_scan(path)


def test_a_fifo_put_in_the_files_place_is_refused(tmp_path, monkeypatch):
    path = write(tmp_path, "foot.stl", corpus.stl())
    regular = path.stat()
    path.unlink()
    os.mkfifo(path)
    with monkeypatch.context() as patch:
        patch.setattr(Path, "stat", lambda *_arguments, **_options: regular)
        with pytest.raises(UnreadableFile, match="pipe"):
            read_scan(path)


def test_no_other_file_is_opened(tmp_path, monkeypatch):
    material = tmp_path / "pipe.mtl"
    os.mkfifo(material)  # opening it would wait for ever
    path = write(tmp_path, "foot.obj", f"mtllib {material}\n".encode() + corpus.obj())
    opened = []
    real = os.open
    monkeypatch.setattr(os, "open", lambda name, *rest: opened.append(name) or real(name, *rest))
    monkeypatch.setattr(builtins, "open", lambda name, *_: pytest.fail(f"opened {name}"))
    read_scan(path)
    assert opened == [str(path)]


def test_content_decides_and_a_wrong_declaration_is_refused():
    assert scan_from_bytes(corpus.ply(), path="foot.stl").info.format == "ply"
    assert scan_from_bytes(corpus.stl(), format="STL").info.format == "stl-binary"
    with pytest.raises(UnknownFormat, match="use --format ply"):
        scan_from_bytes(corpus.ply(), format="stl")
    with pytest.raises(BadOption):
        scan_from_bytes(corpus.ply(), format="step")


@pytest.mark.parametrize(
    "name",
    ["new\nline.stl", "[red]foot[bold].stl", "-o.stl", "=1+1.stl", "fuß ☃.stl", "\x1b[31m.stl"],
)
def test_a_name_is_kept_as_it_is(name, tmp_path):
    path = write(tmp_path, name, corpus.stl())
    assert read_scan(path).info.path == str(path)


def test_a_name_that_is_not_utf8_is_read(tmp_path):
    path = os.fsdecode(bytes(tmp_path) + b"/fu\xdf.stl")
    Path(path).write_bytes(corpus.stl())
    assert read_scan(path).info.faces == len(corpus.FACES)


def test_a_stream_is_read_up_to_the_limit(tmp_path):
    path = write(tmp_path, "foot.stl", corpus.stl())
    with path.open("rb") as stream:
        assert stream_bytes(stream, LIMITS) == corpus.stl()
    with path.open("rb") as stream, pytest.raises(TooLarge):
        stream_bytes(stream, Limits(file_bytes=100))
    with Path(os.devnull).open("rb") as stream, pytest.raises(EmptyMesh):
        stream_bytes(stream, LIMITS)


@pytest.mark.parametrize("make", [corpus.stl, corpus.ascii_stl, corpus.ply, corpus.obj, corpus.off])
@pytest.mark.parametrize(
    "limits", [Limits(faces=100), Limits(vertices=100), Limits(file_bytes=999)]
)
def test_limits_hold_in_every_format(make, limits, tmp_path):
    if make in (corpus.stl, corpus.ascii_stl) and limits.vertices == 100:
        limits = Limits(faces=100)  # STL counts facets
    with pytest.raises(TooLarge):
        file_mesh(file_bytes(str(write(tmp_path, "foot", make())), limits), limits=limits)


def test_the_hash_is_of_the_bytes_and_two_reads_are_equal(tmp_path):
    import hashlib

    path = write(tmp_path, "foot.stl", corpus.stl())
    one, other = read_scan(path), read_scan(path)
    assert one.info.sha256 == hashlib.sha256(corpus.stl()).hexdigest()
    assert one.info == other.info
    assert np.array_equal(one.vertices_mm, other.vertices_mm)
    assert np.array_equal(one.faces, other.faces)


def test_units_reach_the_scan():
    metres = encoded_mesh(corpus.VERTICES / 1000.0, corpus.FACES, "ply")
    scan = scan_from_bytes(metres)
    assert (scan.info.units, scan.info.units_source, scan.info.unit_scale) == ("m", "detected", 1e3)
    assert "units_detected" in codes(scan)
    assert np.ptp(scan.vertices_mm[:, 0]) == pytest.approx(250.0)
    assert scan_from_bytes(metres, units="m").warnings == ()
    with pytest.raises(UnknownUnits):
        scan_from_bytes(encoded_mesh(corpus.VERTICES * 40.0, corpus.FACES, "ply"))


def test_source_to_vertex_names_each_vertex_of_the_file():
    vertices = np.vstack([corpus.VERTICES, [[9.0, 9.0, 9.0]]])  # one that no face uses
    scan = scan_from_bytes(encoded_mesh(vertices, corpus.FACES, "ply"))
    source = scan.source_to_vertex
    assert source[-1] == -1
    assert np.array_equal(scan.vertices_mm[source[:-1]], corpus.VERTICES)
    soup = scan_from_bytes(corpus.stl())
    corners = corpus.VERTICES[corpus.FACES].reshape(-1, 3)
    # measured 4.6e-07
    assert np.allclose(soup.vertices_mm[soup.source_to_vertex], corners, atol=7e-7)


def test_a_binary_stl_needs_neither_trimesh_nor_scipy(tmp_path):
    path = write(tmp_path, "foot.stl", corpus.stl())
    program = (
        "import sys; from tests.reading import read_scan; read_scan(sys.argv[1]);"
        "print([name for name in ('trimesh', 'scipy', 'rich') if name in sys.modules])"
    )
    command = [sys.executable, "-c", program, str(path)]
    run = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    assert run.stdout.strip() == "[]"


def test_bombs_stay_small(tmp_path):
    """The whole corpus in a process that may have 700 MB of addresses."""
    program = (
        "import resource, sys\n"
        "import numpy\n"
        "resource.setrlimit(resource.RLIMIT_AS, (700_000_000, 700_000_000))\n"
        "from footfit.errors import InputError\n"
        "from tests.reading import read_scan\n"
        "for path in sys.argv[1:]:\n"
        "    try: read_scan(path)\n"
        "    except InputError as error: assert 'memory' not in error.message, path\n"
        "    else: raise SystemExit(path)\n"
    )
    paths = [str(write(tmp_path, bad.name, bad.make())) for bad in corpus.BAD]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, "-c", program, *paths]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment)
    assert run.returncode == 0, run.stderr


SEEDS = [make() for make in (corpus.stl, corpus.ply, corpus.ascii_ply, corpus.obj, corpus.off)]
SEEDS.append(corpus.ascii_stl(faces=corpus.FACES[:20]))


@st.composite
def mutated_files(draw):
    """A good file with bytes changed, cut, repeated or put in."""
    data = bytearray(draw(st.sampled_from(SEEDS)))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(data)) | st.integers(0, min(400, len(data))))
        length = draw(st.integers(0, 40))
        change = draw(st.sampled_from(["put", "cut", "end", "repeat"]))
        if change == "put":
            data[at : at + length] = draw(st.binary(max_size=12) | st.sampled_from(TOKENS))
        elif change == "cut":
            del data[at : at + length]
        elif change == "end":
            del data[at:]
        else:
            data[at:at] = data[at : at + 20 * length]
    return bytes(data)


TOKENS = [b"nan", b"-1", b"1e400", b" ", b"\n", b"\0", b"/", b"99999999999", b"f 1", b"\xff" * 4]


@given(data=mutated_files(), name=st.sampled_from(["a.stl", "a.ply", "a.obj", "a.off", "a"]))
@settings(max_examples=300, deadline=None)
def test_only_footfits_own_errors_leave_the_reader(data, name):
    try:
        scan = scan_from_bytes(data, path=name, units="mm")
    except InputError:
        return
    assert np.isfinite(scan.vertices_mm).all()
    assert scan.faces.min() >= 0
    assert scan.faces.max() < len(scan.vertices_mm) == scan.info.vertices


@given(data=st.binary(max_size=400), format_=st.sampled_from(["stl", "ply", "obj", "off", None]))
@settings(max_examples=200, deadline=None)
def test_noise_is_refused(data, format_):
    with pytest.raises(InputError):
        scan_from_bytes(data, format=format_, units="mm")


def test_the_sample_scans_are_read():
    assert_all_are_read(SAMPLES)


def test_scans_beside_the_project_are_read(scans):
    assert_all_are_read(scans)


def assert_all_are_read(folder):
    """Every scan of a folder is closed and of a foot's size; one is an open sheet."""
    paths = sorted(folder.rglob("*.stl"))
    assert paths
    for path in paths:
        scan = read_scan(path)
        assert scan.info.watertight or path.stem == "insoleTilter_scan"
        assert 100.0 < np.ptp(scan.vertices_mm, axis=0).max() < 340.0
