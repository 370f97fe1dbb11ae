"""A foot in a last, built by code: the tube foot of `answers` in a generated last."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.fit.compare import LastShape, compared
from footfit.results import Comparison, SideVerdict
from tests import answers
from tools.lasts import LastSpec, last_mesh


@cache
def last(name: str = "derby-42", left: bool = False) -> LastShape:
    """A generated last of 272 mm, coarse so that its pictures are quick."""
    spec = LastSpec(length_mm=272.0, flare_deg=8.0, rings=60, segments=48)
    vertices, faces = last_mesh(spec)
    record = answers.record(name, length_mm=272.0, left=left)
    if left:  # its mesh is the right-side copy all the same
        record = replace(record, side=SideVerdict("left", "sure", -4.1, "detected"))
    return LastShape(record, Shape(vertices, faces, "last"))


@cache
def comparison(left: bool = False, last_left: bool = False, path: str = "anna.stl") -> Comparison:
    """The tube foot, right or left, in the last, right or left."""
    return compared(answers.foot(path, left=left), last(left=last_left))
