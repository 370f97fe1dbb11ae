"""Sections: what the catalogue keeps of a last's shape beside its mesh."""

from __future__ import annotations

from footfit.geometry.fit.named_sections import named_sections, toes_outline_mm
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.stance import Stance
from footfit.results import ShapeSections


def kept_sections(
    vertices_mm: Floats, faces: Ints, kind: str, stance: Stance | None
) -> ShapeSections:
    """The sections at the named stations and the outline of the toes of a canonical right shape.

    Parameters
    ----------
    vertices_mm : (n, 3)
    faces : (m, 3)
    kind : {"foot", "last"}
    stance : Stance or None
        How it stands.
    """
    shape = Shape(vertices_mm, faces, kind, stance)
    return ShapeSections(named_sections(shape), toes_outline_mm(shape))
