"""The page of the coverage of a population."""

from __future__ import annotations

from footfit.report.page.rendering import html_page, picture_data
from footfit.report.plots.coverage_figures import (
    MOST_POINTS,
    cover_figure,
    flare_figure_of,
    measures_figure,
    scatter_figure,
)
from footfit.report.wording.coverage_words import (
    GREEDY_WORDS,
    PRIVACY_WORDS,
    coverage_sentence,
    go_words,
)
from footfit.results.population.coverage_answer import Coverage

SHOWN_LASTS = 40
SHOWN_GROUPS = 40


def coverage_page(answer: Coverage) -> str:
    """The coverage as a whole HTML page; the same bytes for the same answer. It names no foot."""
    figures = {
        "scatter": scatter_figure(answer) if answer.feet.ids else None,
        "cover": cover_figure(answer) if answer.judged else None,
        "flare": flare_figure_of(answer),
        "measures": measures_figure(answer),
    }
    order = sorted(answer.library, key=lambda last: (-last.acceptable, last.last))
    return html_page(
        "coverage.html.jinja",
        answer=answer,
        sentence=coverage_sentence(answer),
        could_go=go_words(answer),
        greedy=GREEDY_WORDS,
        privacy=PRIVACY_WORDS,
        missing=answer.served.acceptable.of - answer.served.acceptable.count,
        shown_lasts=order[:SHOWN_LASTS],
        more_lasts=len(order) - SHOWN_LASTS,
        shown_groups=SHOWN_GROUPS,
        some_points=MOST_POINTS if len(answer.feet.ids) > MOST_POINTS else 0,
        pictures={
            name: None if figure is None else picture_data(figure)
            for name, figure in figures.items()
        },
    )
