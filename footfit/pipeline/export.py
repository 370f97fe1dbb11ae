"""Meshes and arrays as the bytes of a file; the file's suffix says which kind."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from footfit.errors import BadOption
from footfit.number_words import plain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from footfit.geometry.numeric.arrays import Floats
    from footfit.results import AlignedScan, LastRecord, SurfaceCurvature

MESH_KINDS = ("stl", "ply", "obj", "off", "3mf", "3dm")
PICTURE_KINDS = ("svg", "png")
CURVATURE_KINDS = ("ply", "npz")
MOST_FACES = 40_000
"""Of a mesh that is handed over: as a binary STL it has 2 MB, and every program takes it."""


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


def trade_name(record: LastRecord) -> str:
    """What a file of a last is called in a folder: what its labels and its stance say of it.

    Style (else the name), size system and size, width, side, heel height, toe spring at the tip,
    and the unit; what is not known is left out.
    """
    labels = record.labels
    spring_mm = labels.toe_spring_mm
    spring_mm = record.value_of("toe_spring_tip") if spring_mm is None else spring_mm
    size = f"{(labels.size_system or '').upper()}{labels.size or ''}"
    heights = (("h", record.heel_height_mm), ("ts", spring_mm))
    words = (
        labels.style or labels.name,
        size if labels.size else None,
        labels.width_label,
        record.side.side,
        *(None if mm is None else f"{tag}{plain(mm, 0)}" for tag, mm in heights),
        "mm",
    )
    return "_".join(word for word in words if word)


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
