"""Whether a custom last bends the surface of its base so far that creases may show."""

from __future__ import annotations

from footfit.geometry.deform.bending import bend_deg
from footfit.number_words import RATIO_KEPT, plain
from footfit.pipeline.last_making.custom.custom_tries import BENT_DEG
from footfit.results import Notice
from footfit.results.last_making.custom_last import CustomLast

COARSE_FACES = 20_000
"""For a base with fewer faces more are advised: with edges half as long, 1.7 became 1.0 degrees."""


def bent_notices(custom: CustomLast, *, bottom_kept: bool) -> tuple[Notice, ...]:
    """A warning if the written last bends the surface of its base farther than a last should, and
    what to do. The room for single places counts too.
    """
    most_deg, faces = BENT_DEG[bottom_kept], len(custom.faces)
    bent_deg = bend_deg(custom.base_vertices_mm, custom.vertices_mm, custom.faces)
    if bent_deg <= most_deg:
        return ()
    advice = "take another base"
    if faces < COARSE_FACES:
        advice = f"take a base with more faces than its {faces:,}"
    if custom.rooms:
        advice = "give less room with --room"
    words = (
        f"creases may show: 1 % of the edges bend by more than {plain(bent_deg, 2, RATIO_KEPT)}"
        f" degrees, and up to {plain(most_deg)} is usual. Look at the last before you cut it, or"
        f" {advice}"
    )
    return (Notice("bent", words),)
