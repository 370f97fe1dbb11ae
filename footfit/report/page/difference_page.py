"""The page of two lasts that are laid on each other."""

from __future__ import annotations

from footfit.report.page.rendering import html_page, picture_data
from footfit.report.page.scene import scene_of
from footfit.report.pictures.drawn_outlines import own_side
from footfit.report.pictures.heat_figure import heat_figure
from footfit.report.pictures.overlay_figure import DrawnLast, overlay_figure
from footfit.report.pictures.section_figure import section_figure
from footfit.report.wording import difference_words as words
from footfit.results import Comparison, LastDifference
from footfit.results.last_making.last_difference import TOLERANCE_SOURCE


def difference_page(difference: LastDifference, drawn: Comparison) -> str:
    """How two lasts differ as a whole HTML page; ``drawn`` are both with meshes that are light."""
    first, second = words.last_names(difference)
    line = DrawnLast(1, drawn.last, own_side(drawn)[1])
    return html_page(
        "compare_lasts.html.jinja",
        scene=scene_of(drawn),
        difference=difference,
        first_name=first,
        second_name=second,
        source=TOLERANCE_SOURCE,
        words={
            "laid": words.laid_words(difference),
            "verdict": words.verdict_words(difference),
            "sections": words.SECTION_GIRTHS,
            "zones": words.ZONE_NAMES,
            "surface": words.surface_difference_words(difference),
        },
        measures=[(words.value_name(row), words.value_cells(row)) for row in difference.measures],
        pictures={
            "heat": picture_data(heat_figure(drawn, titled=False)),
            "sections": picture_data(section_figure(drawn, titled=False)),
            "flare": picture_data(overlay_figure(drawn.foot, [line], second)),
        },
    )
