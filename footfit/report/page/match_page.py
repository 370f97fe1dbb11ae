"""The page of one match: what a customer reads first, what a fitter checks, what prints on A4."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.geometry.fit.clearance import ZoneClearance
from footfit.geometry.fit.sizes import Size, foot_sizes, system_named
from footfit.report.page.rendering import html_page, picture_data
from footfit.report.page.scene import scene_of
from footfit.report.pictures.heat_figure import heat_figure
from footfit.report.pictures.judged_figure import judged_figure
from footfit.report.pictures.overlay_figure import SHOWN, Shapes, drawn_lasts, overlay_figure
from footfit.report.pictures.section_figure import STRIP, section_figure
from footfit.report.wording.comparison_words import (
    comparison_names,
    pressed_words,
    tightest_words,
)
from footfit.report.wording.fit_words import OTHER_FOOT
from footfit.report.wording.text import SHOWN_SYSTEMS, file_name, is_scanned_last, shown_size_text
from footfit.report.wording.zone_words import uncounted_lines, unjudged_lines
from footfit.results import Candidate, Comparison, Match, SideName, tightest_place

UNIT_SIGNS = {"mm": " mm", "deg": "°", "percent": " %", "ratio": ""}
PAIR_NOTICES = {"pair_difference", "feet_differ_by_a_size"}
"""What says how two feet differ; without one of them the page says it."""


def match_page(
    match: Match,
    shapes: Shapes | None = None,
    comparisons: Sequence[Comparison] = (),
    *,
    title: str = "",
    customer: str = "",
) -> str:
    """One customer's answer as a whole HTML page; the same bytes for the same match.

    It names no outside address and no folder of the machine, and every name is escaped.

    Parameters
    ----------
    match : Match
    shapes : mapping of str to (vertices_mm, faces), optional
        The candidates' meshes by name, canonical mm, each on its own side; the flare plot draws
        the outlines of those that are there.
    comparisons : sequence of Comparison
        The feet in the best last, as ``pipeline.drawables.best_comparisons`` gives them; without
        any the page has no surface to show.
    title, customer : str
        What the shop wants to read above the page; shown and not kept.
    """
    shown = match.candidates or match.nearest
    several = f"the {'best' if match.candidates else 'nearest'} lasts"
    asked = system_named(match.size_system)
    longer = max(comparisons, key=lambda each: each.foot.length_or_extent_mm, default=None)
    return html_page(
        "match.html.jinja",
        scene=scene_of(longer) if longer else None,
        match=match,
        page_title=title,
        customer=customer,
        names=", ".join(file_name(foot.aligned.alignment.info.path) for foot in match.feet),
        shown=shown,
        judged=any(candidate.verdict for candidate in shown),
        length_difference_mm=_length_difference_mm(match),
        comparisons=comparisons,
        longer=longer,
        drawn=shown[:SHOWN],
        tightest=_tightest(shown[:1], comparisons),
        pressed=_pressed(shown[:1], comparisons),
        pictures={
            "judged": [
                picture_data(judged_figure(foot, fit))
                for last in shown[:1]
                for foot, fit in zip(match.feet, last.fits, strict=False)
            ],
            "heat": [picture_data(heat_figure(each, titled=False)) for each in comparisons],
            "sections": [
                picture_data(section_figure(each, STRIP, titled=False)) for each in comparisons
            ],
            "flare": [
                picture_data(overlay_figure(foot, drawn_lasts(match, foot, shapes), several))
                for foot in match.feet
            ],
        },
        comparison_names=comparison_names,
        asked_system=asked.name if asked else None,
        unit_signs=UNIT_SIGNS,
        is_scanned_last=is_scanned_last,
        labels=labels,
        shown_sizes=shown_sizes,
        uncounted_lines=uncounted_lines,
        unjudged_lines=unjudged_lines,
    )


def _surfaces(
    comparisons: Sequence[Comparison],
) -> list[tuple[SideName | None, Sequence[ZoneClearance]]]:
    """The side of each foot and the clearance around it."""
    return [(each.foot.aligned.alignment.side.side, each.zones) for each in comparisons]


def _tightest(best: Sequence[Candidate], comparisons: Sequence[Comparison]) -> str:
    """The tightest place of the feet in the best last; empty if no surface was compared."""
    if not comparisons:
        return ""
    toes = [(fit.side, fit.toe_box) for last in best for fit in last.fits]
    return tightest_words(tightest_place(_surfaces(comparisons), toes))


def _pressed(best: Sequence[Candidate], comparisons: Sequence[Comparison]) -> list[str]:
    """Where the surface of each foot is far too tight in the best last."""
    fits = {fit.side: fit for last in best for fit in last.fits}
    return [
        sentence
        for side, zones in _surfaces(comparisons)
        for sentence in pressed_words(side, zones, fits.get(side))
    ]


def labels(candidate: Candidate, *, brief: bool = False) -> str:
    """What the maker says of a last, in one line; its side, if it is of the other foot."""
    size = shown_size_text(candidate)
    side = (
        f"{candidate.side} last{'' if brief else f', {OTHER_FOOT}'}" if candidate.mirrored else ""
    )
    return ", ".join(part for part in (candidate.style, size, side) if part)


def shown_sizes(length_mm: float, asked: str | None) -> list[Size]:
    """A foot's sizes; the one in the system that was asked for comes first."""
    sizes = {size.system: size for size in foot_sizes(length_mm)}
    first = [asked] if asked else []
    return [sizes[name] for name in dict.fromkeys((*first, *SHOWN_SYSTEMS))]


def _length_difference_mm(match: Match) -> float | None:
    """How much longer one foot of a pair is, where no notice says it."""
    lengths = [foot.length_mm for foot in match.feet if foot.length_mm is not None]
    noticed = {notice.code for notice in match.warnings} & PAIR_NOTICES
    return None if noticed or len(lengths) < 2 else max(lengths) - min(lengths)
