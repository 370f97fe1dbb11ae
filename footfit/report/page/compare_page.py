"""The page of one foot in one last."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.geometry.fit.clearance import CLEARANCE
from footfit.report.page.page_pictures import (
    compared_flare_picture,
    heat_picture,
    section_picture,
)
from footfit.report.page.rendering import html_page
from footfit.report.page.scene import scene_of
from footfit.report.wording.comparison_words import SIZE_HEADS, comparison_names

if TYPE_CHECKING:
    from footfit.results import Comparison


def compare_report(comparison: Comparison) -> str:
    """One foot in one last as a whole HTML page; the same bytes for the same comparison."""
    foot, last = comparison_names(comparison)
    return html_page(
        "compare.html.jinja",
        scene=scene_of(comparison),
        comparison=comparison,
        foot=foot,
        last=last,
        size_heads=SIZE_HEADS,
        limits=CLEARANCE,
        pictures={
            "heat": heat_picture(comparison),
            "sections": section_picture(comparison),
            "flare": compared_flare_picture(comparison),
        },
    )
