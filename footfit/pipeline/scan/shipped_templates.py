"""The templates that poses are fitted to, shipped beside this file (tools/make_templates.py)."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from footfit.geometry.search.templates import Template

FILE = Path(__file__).with_name("templates.npz")
# Stored as integers, since a tenth of a millimetre is far below what the fit can tell.
POINT_STEP = 1 / 16384
NORMAL_STEP = 1 / 127


@lru_cache(maxsize=1)
def shipped_templates() -> tuple[Template, ...]:
    """The templates in the order in which ties are settled, read once per process."""
    with np.load(FILE, allow_pickle=False) as arrays:
        return tuple(
            Template(
                kind=str(kind),
                points=arrays[f"{name}_points"].astype(np.float32) * np.float32(POINT_STEP),
                normals=arrays[f"{name}_normals"].astype(np.float32) * np.float32(NORMAL_STEP),
                origin=arrays[f"{name}_origin"],
                pitch=float(arrays["pitch"]),
                table=arrays[f"{name}_table"],
                middle_y=float(arrays[f"{name}_middle_y"]),
            )
            for name, kind in zip(arrays["names"], arrays["kinds"], strict=True)
        )
