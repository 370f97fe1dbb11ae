"""Meshes and arrays as the bytes of a file; the file's suffix says which kind."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.numeric.arrays import Floats
from footfit.results import AlignedScan, SurfaceCurvature

if TYPE_CHECKING:
    from numpy.typing import NDArray

MESH_KINDS = ("stl", "ply", "obj", "off", "3mf", "3dm")
PICTURE_KINDS = ("svg", "png")
CURVATURE_KINDS = ("ply", "npz")


def file_kind(path: Path, kinds: tuple[str, ...]) -> str:
    """The suffix of an output, one of ``kinds``.

    Raises
    ------
    BadOption
        The suffix is another one.

    Examples
    --------
    >>> file_kind(Path("foot.PLY"), MESH_KINDS)
    'ply'
    """
    kind = path.suffix.lower().removeprefix(".")
    if kind not in kinds:
        raise BadOption(f"end the name in {' or '.join('.' + k for k in kinds)}", str(path))
    return kind


def require_kind(kind: str, kinds: tuple[str, ...]) -> None:
    """Refuse a kind of file that a result cannot be written as.

    Raises
    ------
    BadOption
        It is none of ``kinds``.
    """
    if kind not in kinds:
        raise BadOption(f"a file cannot be of the kind {kind!r}; give {' or '.join(kinds)}")


def method_vertices(scan: AlignedScan) -> Floats:
    """The vertices (n, 3) where the alignment's own method puts them, in mm.

    `AlignedScan` holds them in the canonical frame, and a paper's method has another transform.
    """
    alignment = scan.alignment
    step = alignment.transform @ np.linalg.inv(alignment.canonical_transform)
    return np.asarray(scan.vertices_mm @ step[:3, :3].T + step[:3, 3], dtype=np.float64)


def curvature_bytes(
    curvature: SurfaceCurvature, kind: str, colours: NDArray[np.uint8] | None = None
) -> bytes:
    """Per-vertex curvature as "ply", with the colours (n, 3) where some are given, or as "npz"."""
    from footfit.meshes.write import encoded_mesh

    values: dict[str, NDArray[np.generic]] = {
        "k1": curvature.k1,
        "k2": curvature.k2,
        "mean": curvature.mean,
        "gaussian": curvature.gaussian,
    }
    if kind == "ply":
        if colours is not None:
            values["colour"] = colours
        return encoded_mesh(curvature.vertices_mm, curvature.faces, "ply", values)
    mesh: dict[str, NDArray[np.generic]] = {
        "vertices": curvature.vertices_mm,
        "faces": curvature.faces,
        "source_to_vertex": curvature.source_to_vertex,
    }
    buffer = io.BytesIO()  # NumPy writes no time into an .npz: its bytes depend on the arrays alone
    np.savez_compressed(buffer, **values, **mesh)  # type: ignore[arg-type]
    return buffer.getvalue()
