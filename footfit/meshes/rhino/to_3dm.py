"""A mesh as the bytes of a ``.3dm`` in millimetres."""

from __future__ import annotations

import io

import numpy as np

from footfit.errors import BadOption, TooLarge
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.read_limits import LIMITS
from footfit.meshes.rhino.watched_process import INSTALL, RhinoFailed, is_installed, run


def encoded_3dm(vertices: Floats, faces: Ints) -> bytes:
    """A ``.3dm`` with one mesh object, whose coordinates keep every bit.

    Its ids and its date are new in each file, so the same mesh does not give the same bytes.

    Raises
    ------
    BadOption
        rhino3dm is not installed.
    TooLarge
        rhino3dm could not write the mesh in the time and memory that it may take.
    """
    if not is_installed():
        raise BadOption(f"footfit writes .3dm only with rhino3dm: {INSTALL}, or write .stl")
    memory = io.BytesIO()
    np.savez(memory, vertices=vertices, faces=faces)
    try:
        return run("write", memory.getvalue(), LIMITS)
    except RhinoFailed as error:
        raise TooLarge("the .3dm could not be written: give --faces, or write .stl") from error
