"""The page of one foot in one last."""

from __future__ import annotations

from footfit.geometry.fit.clearance import CLEARANCE
from footfit.report.page.rendering import html_page, picture_data
from footfit.report.page.scene import scene_of
from footfit.report.pictures.drawn_outlines import own_side
from footfit.report.pictures.heat_figure import heat_figure
from footfit.report.pictures.overlay_figure import DrawnLast, overlay_figure
from footfit.report.pictures.section_figure import section_figure
from footfit.report.wording.comparison_words import SIZE_HEADS, comparison_names
from footfit.results import Comparison


def compare_page(comparison: Comparison) -> str:
    """One foot in one last as a whole HTML page; the same bytes for the same comparison."""
    foot, last = comparison_names(comparison)
    drawn = DrawnLast(1, comparison.last, own_side(comparison)[1])
    return html_page(
        "compare.html.jinja",
        scene=scene_of(comparison),
        comparison=comparison,
        foot=foot,
        last=last,
        size_heads=SIZE_HEADS,
        limits=CLEARANCE,
        pictures={
            "heat": picture_data(heat_figure(comparison, titled=False)),
            "sections": picture_data(section_figure(comparison, titled=False)),
            "flare": picture_data(overlay_figure(comparison.foot, [drawn], last)),
        },
    )
