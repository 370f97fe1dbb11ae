"""``python -m tests.torture.old_file``: store a catalogue as the newest schema has it.

Run once when a schema is released, never again for it: ``tests/data/catalogue-NNNN.footfit`` is
what footfit of that day wrote, and what every later one must read and upgrade.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.geometry.fit.stations import NamedSection
from footfit.meshes.copies.compact_copy import compact_copy
from footfit.results import ShapeSections
from tests import answers, fits, records
from tests.torture.migrations import DATA, HEAD

LASTS = 4


def store(path: Path) -> None:
    """Write a small catalogue with everything that a catalogue can hold."""
    vertices, faces = answers.tube(260.0, rings=24, sides=16)
    copy = compact_copy(vertices, faces)
    section = NamedSection(np.eye(4), vertices[:16, 1:])
    sections = ShapeSections({"ball": section, "toes": section}, vertices[:16])
    with open_catalogue(path, write=True) as catalogue:
        for seed in range(LASTS):
            side, parent = ("right", "left")[seed % 2], "last-0" if seed == 3 else None
            record = records.last(f"last-{seed}", seed, side=side, parent=parent)
            made = records.parentage("last-0") if parent else None
            catalogue.add(record, copy, sections, made)
            catalogue.fit_log.add(fits.entry(seed))


if __name__ == "__main__":
    target = DATA / f"catalogue-{HEAD}.footfit"
    target.unlink(missing_ok=True)
    store(target)
    print(target)
