"""Where the catalogue is: the option, the environment, the settings file, the data folder."""

from __future__ import annotations

import os
from pathlib import Path

from footfit.errors import BadOption, BadProfile, errors_at
from footfit.locations import Location, location_of

ENVIRONMENT_NAME = "FOOTFIT_CATALOGUE"
SETTINGS_NAME = "settings.toml"
CATALOGUE_NAME = "lasts.footfit"
SLASHES = "write / in the place of \\ in the path"


def settings_path() -> Path:
    """The settings file, whether it exists or not."""
    import platformdirs

    return Path(platformdirs.user_config_dir("footfit", appauthor=False)) / SETTINGS_NAME


def settings_catalogue(path: Path) -> Location | None:
    """The ``catalogue = "..."`` line of the settings file, relative to its folder.

    Raises
    ------
    BadOption
        The file is not TOML, has an unknown key, or the value is not text.
    """
    import tomllib

    from footfit.pipeline.fit.toml_tables import check_keys

    if not path.is_file():
        return None
    try:
        text = path.read_text(encoding="utf-8-sig")
        table = tomllib.loads(text)
        check_keys(table, {"catalogue"}, "the file")
    except tomllib.TOMLDecodeError as error:
        advice = SLASHES if "\\" in text else "correct or remove it"
        raise BadOption(f"is not valid TOML ({error}); {advice}", str(path)) from error
    except UnicodeDecodeError as error:
        raise BadOption("is not UTF-8 text; save it as UTF-8", str(path)) from error
    except OSError as error:
        words = f"cannot be read ({error.strerror}); correct or remove it"
        raise BadOption(words, str(path)) from error
    except BadProfile as error:
        raise BadOption(error.message, str(path)) from error
    value = table.get("catalogue")
    if value is None:
        return None
    if not isinstance(value, str) or not value:
        raise BadOption('needs a line like: catalogue = "lasts.footfit"', str(path))
    if not value.isprintable():  # as in "C:\temp"
        raise BadOption(f"has a control character in the path; {SLASHES}", str(path))
    with errors_at(str(path)):
        given = location_of(value)
    return path.parent / _expanded(value, str(path)) if isinstance(given, Path) else given


def _expanded(text: str, origin: str) -> Path:
    """A path with ``~`` as the home folder.

    Raises
    ------
    BadOption
        There is no such home folder.
    """
    try:
        return Path(text).expanduser()
    except RuntimeError as error:
        words = f"the home folder of {text} is not known; write the whole path"
        raise BadOption(words, origin) from error


def catalogue_path(option: str | None) -> Location:
    """The catalogue to use, by the order of docs/command-line.md.

    Raises
    ------
    BadOption
        The settings file, or the address of a server, is not valid.
    """
    if option is not None:
        return location_of(option)
    named = os.environ.get(ENVIRONMENT_NAME)
    if named:
        given = location_of(named)
        return _expanded(named, ENVIRONMENT_NAME) if isinstance(given, Path) else given
    from_settings = settings_catalogue(settings_path())
    return data_folder() / CATALOGUE_NAME if from_settings is None else from_settings


def data_folder() -> Path:
    """The user's data folder, whether it exists or not."""
    import platformdirs

    return Path(platformdirs.user_data_dir("footfit", appauthor=False))


def make_folder_for(catalogue: Location, *, dry_run: bool = False) -> None:
    """Make the data folder for a catalogue that is to lie in it; no other folder is made.

    A catalogue on a server needs none.

    A ``dry_run`` only refuses what could not be made.

    Raises
    ------
    BadOption
        The catalogue's folder is another one and does not exist.
    CatalogueNotWritable
        The data folder cannot be made.
    """
    from footfit.errors import CatalogueNotWritable
    from footfit.whole_files import require_folder

    if not isinstance(catalogue, Path):
        return
    if catalogue.parent == data_folder():
        if dry_run:
            return
        try:
            catalogue.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            words = f"cannot be made, because its folder cannot be made ({error.strerror})"
            raise CatalogueNotWritable(words, str(catalogue)) from error
    require_folder(catalogue)


def use_one_blas_thread() -> None:
    """Give BLAS one thread, before NumPy is imported.

    The sums of a threaded BLAS depend on the number of threads. With one thread the same input
    gives the same bytes, whatever ``--jobs`` is and however many cores the machine has.
    """
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ.setdefault("VECLIB_MAXIMUM_THREADS", "1")
