"""The search file: never used when it is torn, stale or another catalogue's; its bounds hold."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfit
from benchmarks.big_catalogues import perturbed_lasts, ready_lasts
from footfit.catalogue.blocks import block_reading, search_file
from footfit.catalogue.blocks.search_file import search_path
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue
from footfit.geometry.flare.definition import CHANNELS, FlareDefinition, FlareProfile
from footfit.geometry.flare.profile_distance import inside, profile_distances
from footfit.geometry.flare.profile_sketch import least_squares, sketches
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.library.backup import back_up, restore
from footfit.pipeline.shelf import near_lasts
from footfit.pipeline.shelf.candidates import choice
from footfit.results import Profiled
from footfit.results.columns.packed_names import PackedNames, packed
from tests.conftest import SAMPLES

LASTS = 300


@pytest.fixture(scope="module", autouse=True)
def _search_files_for_all() -> Iterator[None]:
    """A search file for every catalogue, and few lasts at a time."""
    patch = pytest.MonkeyPatch()
    patch.setattr(block_reading, "LEAST_LASTS", 1)
    patch.setattr(near_lasts, "PICKED", 7)
    patch.setattr(near_lasts, "FIRST_PICKED", 3)
    yield
    patch.undo()


@pytest.fixture(scope="module")
def measured(stocked: Path) -> list[NewLast]:
    return ready_lasts(stocked)


@pytest.fixture(scope="module")
def foot() -> Profiled:
    return footfit.flare(SAMPLES / "feet" / "mh008_R.stl")


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory, measured: list[NewLast]) -> Path:
    """A catalogue with lasts whose flare lies close together, and some that lack a channel."""
    path = tmp_path_factory.mktemp("large") / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        list(catalogue.add_many(map(_some_lack_a_channel, perturbed_lasts(measured, LASTS, 3))))
    return path


def _some_lack_a_channel(last: NewLast) -> NewLast:
    flare = last.record.flare
    if int(last.record.labels.name[-7:]) % 11 == 0:
        flare = replace(flare, curvature={**flare.curvature, "bottom_20": None})
    return last._replace(record=replace(last.record, flare=flare))


@pytest.fixture
def catalogue(large: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(large, tmp_path / "lasts.footfit"))


def names(path: Path, foot: Profiled, by: str = "flare", top: int = 5) -> list[tuple[object, ...]]:
    found = matched([foot], choice(path, None, None), Question(by=by, top=top))
    return [(c.last, c.distance, c.tied_with) for c in found.candidates]


def is_used(path: Path) -> bool:
    return choice(path, None, None).lasts.search is not None


@pytest.mark.parametrize("by", ["flare", "shape"])
@pytest.mark.parametrize("top", [1, 5, 290, 0])
def test_a_search_file_changes_no_answer(
    by: str, top: int, catalogue: Path, foot: Profiled
) -> None:
    without = names(catalogue, foot, by, top)
    assert is_used(catalogue)
    assert names(catalogue, foot, by, top) == without


def torn(path: Path) -> None:
    """The file ends in the middle, as after a power cut."""
    os.truncate(path, path.stat().st_size // 2)


def empty(path: Path) -> None:
    os.truncate(path, 0)


def zeros(path: Path) -> None:
    """Its second half was never written to the disk."""
    size = path.stat().st_size
    os.truncate(path, size // 2)
    os.truncate(path, size)


def one_bit(share: float) -> Callable[[Path], None]:
    def change(path: Path) -> None:
        data = bytearray(path.read_bytes())
        data[int(share * (len(data) - 1))] ^= 4
        path.write_bytes(data)

    change.__name__ = f"one_bit_{share}"
    return change


def other_text(path: Path) -> None:
    path.write_bytes(b"no search file " * 100)


HARMS = [torn, empty, zeros, other_text]
HARMS += [one_bit(share) for share in (0.0, 0.0003, 0.01, 0.03, 0.06, 0.1, 0.3, 0.6, 0.9)]


@pytest.mark.parametrize("harm", HARMS, ids=lambda harm: harm.__name__)
def test_a_damaged_search_file_changes_no_answer(
    harm: Callable[[Path], None], catalogue: Path, foot: Profiled
) -> None:
    sound = [names(catalogue, foot, by) for by in ("flare", "shape")]
    harm(search_path(catalogue))
    assert [names(catalogue, foot, by) for by in ("flare", "shape")] == sound


def test_each_changed_row_of_a_search_file_is_seen(catalogue: Path, foot: Profiled) -> None:
    """Rows of profiles are verified as they are read: none that a search needs can be wrong."""
    sound = names(catalogue, foot)
    path = search_path(catalogue)
    search = choice(catalogue, None, None).lasts.search
    assert search is not None
    data = bytearray(path.read_bytes())
    row = search.curves(np.arange(1)).nbytes + 8
    for at in range(len(data) - (LASTS - 1) * row, len(data), row):  # the profiles come last
        data[at] ^= 1
    path.write_bytes(data)
    search = choice(catalogue, None, None).lasts.search
    assert search is not None
    for place in range(1, LASTS):
        with pytest.raises(search_file.BadSearchFile):
            search.curves(np.array([place]))
    assert not is_used(catalogue)  # in this process it is not tried again
    assert names(catalogue, foot) == sound


def test_a_change_of_the_catalogue_makes_the_file_stale(catalogue: Path, foot: Profiled) -> None:
    first = names(catalogue, foot)[0][0]
    old = search_path(catalogue).read_bytes()
    with open_catalogue(catalogue, write=True) as opened:
        if opened.reference().last == first:
            opened.set_reference(next(name for name in opened.names() if name != first))
        opened.remove(str(first))
    assert not search_path(catalogue).exists()  # it held what was removed
    search_path(catalogue).write_bytes(old)
    assert first not in [row[0] for row in names(catalogue, foot)]
    assert search_path(catalogue).read_bytes() != old
    assert is_used(catalogue)


def test_a_restore_leaves_no_search_file_of_what_was_there(
    catalogue: Path, foot: Profiled, tmp_path: Path
) -> None:
    sound = names(catalogue, foot)
    back_up(catalogue, tmp_path / "backup.footfit")
    with open_catalogue(catalogue, write=True) as opened:
        opened.rename(opened.names()[0], "of another time")
    names(catalogue, foot)
    assert search_path(catalogue).exists()
    restore(catalogue, tmp_path / "backup.footfit")
    assert not search_path(catalogue).exists()
    assert names(catalogue, foot) == sound


def test_the_file_of_another_catalogue_is_not_used(
    catalogue: Path, measured: list[NewLast], foot: Profiled, tmp_path: Path
) -> None:
    """Even of one that was made in the same steps, has the same size and the same time."""
    other = tmp_path / "other.footfit"
    with open_catalogue(other, write=True) as opened:
        list(opened.add_many(map(_some_lack_a_channel, perturbed_lasts(measured, LASTS, 4))))
    times = (catalogue.stat().st_atime_ns, catalogue.stat().st_mtime_ns)
    os.utime(other, ns=times)
    own = names(other, foot)
    names(catalogue, foot)
    shutil.copy(search_path(catalogue), search_path(other))
    assert not is_used(other)
    assert names(other, foot) == own


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="folders are always writable")
def test_a_folder_that_cannot_be_written_has_no_search_file(
    catalogue: Path, foot: Profiled
) -> None:
    catalogue.parent.chmod(0o555)
    try:
        assert names(catalogue, foot) == names(catalogue, foot)
        assert not search_path(catalogue).exists()
    finally:
        catalogue.parent.chmod(0o755)


def test_a_disk_that_takes_no_file_changes_no_answer(
    catalogue: Path, foot: Profiled, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = names(catalogue, foot)
    search_path(catalogue).unlink()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(search_file, "_write", full)
    assert names(catalogue, foot) == sound
    assert [path.name for path in catalogue.parent.iterdir()] == [catalogue.name]


MATCH = """
import sys
from pathlib import Path
from footfit.catalogue.blocks import block_reading
from footfit.pipeline.shelf.candidates import choice
block_reading.LEAST_LASTS = 1
for _ in range(20):
    shelf = choice(Path(sys.argv[1]), None, None)
    Path(sys.argv[1] + ".search").unlink(missing_ok=True)
print(len(shelf.ranked))
"""


def test_processes_that_make_and_remove_it_at_once_disturb_nobody(
    catalogue: Path, foot: Profiled
) -> None:
    sound = names(catalogue, foot)
    command = [sys.executable, "-c", MATCH, str(catalogue)]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    while any(process.poll() is None for process in running):
        assert names(catalogue, foot) == sound
    assert [process.communicate()[0].strip() for process in running] == [str(LASTS)] * 2
    left = [path.name for path in catalogue.parent.iterdir() if "partial" in path.name]
    assert not left


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_in_its_place_is_not_waited_for(catalogue: Path, foot: Profiled) -> None:
    question = Question(by="flare")
    sound = matched([foot], choice(catalogue, None, None), question)
    search_path(catalogue).unlink(missing_ok=True)
    os.mkfifo(search_path(catalogue))
    beside = matched([foot], choice(catalogue, None, None), question)
    assert [c.last for c in beside.candidates] == [c.last for c in sound.candidates]


def test_it_is_not_more_readable_than_the_catalogue(catalogue: Path) -> None:
    catalogue.chmod(0o600)
    choice(catalogue, None, None)
    assert search_path(catalogue).stat().st_mode & 0o777 == 0o600


def test_a_small_catalogue_has_none(catalogue: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(block_reading, "LEAST_LASTS", LASTS + 1)
    assert not is_used(catalogue)
    assert not search_path(catalogue).exists()


# ---------------------------------------------------------------- bounds, and names


def profile(rng: np.random.Generator, spread: float, middle: float) -> FlareProfile:
    definition = FlareDefinition()
    stations = np.linspace(definition.stations_from, definition.stations_to, definition.stations)
    nothing = np.zeros(definition.stations)
    waves = rng.normal(0.0, spread, (len(CHANNELS), 6)) @ np.cos(
        np.outer(np.arange(6), np.pi * stations)
    )
    noise = rng.normal(middle, rng.choice([0.0, 0.01, spread]), waves.shape)
    curves = dict(zip(CHANNELS, waves + noise, strict=True))
    return FlareProfile(
        definition, 8.0, 0.3, "straight", stations, nothing, curves, np.zeros((len(stations), 2))
    )


@pytest.mark.parametrize("seed", range(8))
def test_a_sketch_is_never_further_away_than_the_profile(seed: int) -> None:
    """Whatever the curves are: smooth or noise, near zero or far from it; one foot or two."""
    rng = np.random.default_rng(seed)
    spread, middle = 10.0 ** rng.uniform(-3, 2), rng.choice([0.0, 1.0, -300.0])
    feet = [profile(rng, spread, middle) for _ in range(2)]
    many = [profile(rng, spread, middle) for _ in range(200)] + feet
    curves = np.array([[p.curvature[name] for name in CHANNELS] for p in many])
    part = inside(feet[0].stations)
    known = sketches(curves[:, :, part])
    for asked in (feet[:1], feet):
        exact = np.mean([np.square(profile_distances(f, many).total) for f in asked], axis=0)
        least = least_squares(asked, known)
        assert least is not None
        assert (least <= exact * (1.0 + 1e-12)).all()
    assert np.isnan(sketches(np.full((1, 5, 37), np.nan))).all()
    lacking = replace(feet[0], curvature={**feet[0].curvature, "plan": None})
    assert least_squares([lacking], known) is None


def test_names_are_those_that_were_packed() -> None:
    given = ["", "derby 41", "é" * 3, "bad \udcff byte", "pump", ""]
    every = PackedNames(*packed(given), np.arange(6))
    assert list(every) == given
    assert [every[at] for at in range(6)] == given
    assert every[2:4] == given[2:4]
    assert list(every.taken(np.array([4, 0, 3]))[1:]) == ["", "bad \udcff byte"]
    assert every != given[:5]
