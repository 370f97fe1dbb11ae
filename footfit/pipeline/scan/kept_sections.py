"""Sections: what the catalogue keeps of a last's shape beside its mesh."""

from __future__ import annotations

from footfit.geometry.fit.named_sections import named_sections, toes_outline_mm
from footfit.geometry.measures.landmarks import Shape
from footfit.results import ShapeSections


def kept_sections(shape: Shape) -> ShapeSections:
    """The sections at the named stations and the outline of the toes of a canonical right shape."""
    return ShapeSections(named_sections(shape), toes_outline_mm(shape))
