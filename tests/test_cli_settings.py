"""Where the catalogue is: option, environment, settings file, data folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from footfit.cli import settings
from footfit.errors import BadOption


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("FOOTFIT_CATALOGUE", raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(settings, "settings_path", lambda: tmp_path / "settings.toml")
    return tmp_path


def test_the_order(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert settings.catalogue_path(None).name == settings.CATALOGUE_NAME
    (home / "settings.toml").write_text('catalogue = "shop/lasts.footfit"\n')
    assert settings.catalogue_path(None) == home / "shop" / "lasts.footfit"
    monkeypatch.setenv("FOOTFIT_CATALOGUE", "/elsewhere/lasts.footfit")
    assert settings.catalogue_path(None) == Path("/elsewhere/lasts.footfit")
    assert settings.catalogue_path(Path("x")) == Path("x")


@pytest.mark.parametrize("text", ["catalogue = ", "catalogue = 3\n", 'catalogue = ""\n'])
def test_a_settings_file_that_is_not_understood_is_said(home: Path, text: str) -> None:
    (home / "settings.toml").write_text(text)
    with pytest.raises(BadOption):
        settings.catalogue_path(None)
