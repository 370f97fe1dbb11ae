"""The page of a custom last."""

from __future__ import annotations

from footfit.report.page.custom_figure import custom_figure
from footfit.report.page.rendering import html_page, picture_data
from footfit.report.wording.custom_words import (
    CUSTOM_SPREADS,
    GIRTH_WORDS,
    advice_words,
    custom_verdict_words,
    has_room,
    judged_words,
    room_words,
    with_spread,
    zone_words,
)
from footfit.report.wording.fit_words import SAME_IS_ZERO
from footfit.report.wording.text import file_name
from footfit.results import CustomLast


def custom_page(custom: CustomLast) -> str:
    """A custom last as a whole HTML page; the same bytes for the same last."""
    return html_page(
        "custom.html.jinja",
        custom=custom,
        foot=file_name(custom.foot),
        verdict=custom_verdict_words(custom),
        advice=advice_words(custom),
        label=zone_words,
        girths=GIRTH_WORDS,
        rooms=room_words(custom),
        roomy=any(map(has_room, custom.zones)),
        with_spread=with_spread,
        judged=judged_words,
        same=SAME_IS_ZERO,
        spreads=CUSTOM_SPREADS,
        moved=picture_data(custom_figure(custom, titled=False)),
    )
