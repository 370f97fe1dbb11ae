"""A page in a headless Chromium: what it complained of, what it asked for, how it looks."""

from __future__ import annotations

import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
MISSING = "no Chromium on this machine"
QUIET = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--hide-scrollbars",
    "--enable-logging=stderr",
    "--disable-background-networking",
    "--no-first-run",
    "--virtual-time-budget=4000",
)
WEBGL, NO_WEBGL = "--enable-unsafe-swiftshader", "--disable-3d-apis"
OWN_REQUEST = "not an origin"
"""Who asked, in the browser's log, where it was the browser itself and not a page."""


@dataclass(frozen=True)
class Browsed:
    """What came of a page."""

    console: str
    requests: list[str]
    picture: np.ndarray


def browse(page: str, folder: Path, *options: str, size: tuple[int, int] = (1100, 3600)) -> Browsed:
    """Show a page and take a picture of it."""
    from matplotlib.image import imread

    folder.mkdir()
    (folder / "page.html").write_text(page, encoding="utf-8")
    width, height = size
    run = _chromium(
        folder,
        *(options or (WEBGL,)),
        f"--log-net-log={folder / 'net.json'}",
        f"--window-size={width},{height}",
        f"--screenshot={folder / 'page.png'}",
    )
    console = [line for line in run.splitlines() if "CONSOLE" in line and "GL Driver" not in line]
    picture = imread(folder / "page.png")[..., :3]
    return Browsed("\n".join(console), _requests(folder / "net.json"), picture)


def printed_sheets(page: str, folder: Path) -> int:
    """How many A4 sheets a page takes."""
    folder.mkdir()
    (folder / "page.html").write_text(page, encoding="utf-8")
    paper = folder / "page.pdf"
    _chromium(folder, f"--print-to-pdf={paper}", "--no-pdf-header-footer")
    return paper.read_bytes().count(b"/Type /Page\n")


def _chromium(folder: Path, *options: str) -> str:
    assert BROWSER is not None
    profile = f"--user-data-dir={folder / 'profile'}"
    address = f"file://{folder / 'page.html'}"
    command = [BROWSER, *QUIET, profile, *options, address]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=120).stderr


def _requests(log: Path) -> list[str]:
    """The addresses that the page itself asked for, beside its own file."""
    text = log.read_text(encoding="utf-8").rstrip().rstrip(",")
    try:
        events = json.loads(text)["events"]
    except json.JSONDecodeError:  # the browser ended before it closed its log
        events = json.loads(f"{text}]}}")["events"]
    asked = [event.get("params", {}) for event in events]
    return [
        one["url"]
        for one in asked
        if "url" in one and "initiator" in one and one["initiator"] != OWN_REQUEST
    ]


def share_of(picture: np.ndarray, colour: str, within: float = 0.03) -> float:
    """The share of a picture's pixels that have about this colour."""
    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    return float((np.abs(picture - wanted).max(axis=-1) < within).mean())
