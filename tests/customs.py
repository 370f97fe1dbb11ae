"""A custom last with everything in it, for documents, tables and pages."""

from __future__ import annotations

import numpy as np

from footfit.results import (
    BaseMesh,
    CustomLast,
    CustomZone,
    GirthPlane,
    JudgedZone,
    KeptPlace,
    Notice,
    Parentage,
    ShapeSections,
)
from tests import answers, shapes


def custom_last() -> CustomLast:
    """A custom last whose mesh is a sphere."""
    vertices_mm, faces = shapes.sphere(1)
    plane = GirthPlane((100.0, 0.0, 20.0), (1.0, 0.0, 0.0))
    zones = (
        CustomZone("length", "length", "mm", None, None, 262.2, 259.2, 259.24),
        CustomZone(
            "ball_girth_least", "ball_girth", "mm", 224.5, 0.0, 225.6, 224.5, 224.46, plane=plane
        ),
        CustomZone(
            *("heel_girth_instep", "short_heel_girth", "mm", 320.9, -4.0, 350.3, 349.6, 349.8),
            follows=True,
            plane=plane,
        ),
    )
    return CustomLast(
        base="derby-42",
        base_sha256="0" * 64,
        base_mesh=BaseMesh("light copy", 0.2),
        foot="foot.stl",
        foot_sha256="1" * 64,
        side="right",
        mirrored=False,
        profile="walking",
        profile_version=3,
        profile_sha256="2" * 64,
        heel=None,
        zones=zones,
        judged=(
            JudgedZone("length", "toe room", "mm", 13.0, 16.0, "good", 13.0, "good"),
            JudgedZone("toes", "toes", "mm", -1.0, -3.1, "good", -4.6, "acceptable"),
        ),
        kept=(KeptPlace("bottom heights", 0.01), KeptPlace("top plane", 0.02)),
        toe_shift_mm=-3.0,
        flare_turn_deg=1.0,
        largest_move_mm=4.8,
        least_determinant=0.71,
        warnings=(Notice("light_copy", "the base is a light copy"),),
        record=answers.record(),
        sections=ShapeSections({}, None),
        parentage=Parentage("derby-42", "0" * 64, "customise", (), {}),
        vertices_mm=vertices_mm,
        base_vertices_mm=vertices_mm,
        faces=faces,
        moved_mm=np.linspace(-5.0, 5.0, len(vertices_mm)),
    )
