"""The templates that poses are fitted to, shipped beside this file (tools/make_templates.py)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, overload

import numpy as np

from footfit.geometry.search.templates import Template

FILE = Path(__file__).with_name("templates.npz")
# Stored as integers, since a tenth of a millimetre is far below what the fit can tell.
POINT_STEP = 1 / 16384
NORMAL_STEP = 1 / 127


class ShippedTemplates(Sequence[Template]):
    """The templates in the order in which ties are settled. Each is read when it is asked for:
    most shapes need two of them, and each takes 2 ms to unpack.
    """

    def __init__(self, names: Sequence[str], kinds: Sequence[str]) -> None:
        self._named = list(zip(names, kinds, strict=True))

    def __len__(self) -> int:
        return len(self._named)

    @overload
    def __getitem__(self, place: int) -> Template: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[Template, ...]: ...
    def __getitem__(self, place: int | slice) -> Template | tuple[Template, ...]:
        if isinstance(place, slice):
            return tuple(_template(*each) for each in self._named[place])
        return _template(*self._named[place])


@lru_cache(maxsize=1)
def shipped_templates() -> ShippedTemplates:
    """The templates that this footfit has."""
    with np.load(FILE, allow_pickle=False) as arrays:
        return ShippedTemplates(arrays["names"].tolist(), arrays["kinds"].tolist())


@cache
def _template(name: str, kind: str) -> Template:
    """One template, read once per process."""
    with np.load(FILE, allow_pickle=False) as arrays:
        own: dict[str, Any] = {
            part: arrays[f"{name}_{part}"]
            for part in ("points", "normals", "origin", "table", "middle_y")
        }
        return Template(
            kind=kind,
            points=own["points"].astype(np.float32) * np.float32(POINT_STEP),
            normals=own["normals"].astype(np.float32) * np.float32(NORMAL_STEP),
            origin=own["origin"],
            pitch=float(arrays["pitch"]),
            table=own["table"],
            middle_y=float(own["middle_y"]),
        )
