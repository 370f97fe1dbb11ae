"""The customer's sheet: one size, how wide the feet are, the best shoe and the next, on one A4."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from footfit.geometry.fit.sizes import EQUALLY_LONG_MM, SYSTEMS, foot_sizes, system_named
from footfit.number_words import rounded
from footfit.report.page.rendering import html_page, picture_data
from footfit.report.pictures.drawn_outlines import Mesh
from footfit.report.pictures.feet_figure import DrawnFoot, feet_figure
from footfit.report.wording import sheet_words, width_words
from footfit.report.wording.text import SHOWN_SYSTEMS
from footfit.results import Match, Measured

USUAL_SYSTEM = "eu"
COMPARED = {"length": "Length", "ball_girth": "Around the ball", "ball_width": "Width of the ball"}


def sheet_page(
    match: Match,
    meshes: Sequence[Mesh],
    *,
    title: str = "",
    customer: str = "",
    day: date,
    survey: str,
) -> str:
    """One customer's sheet as a whole HTML page without a script.

    Parameters
    ----------
    match : Match
        By fit, so that the length of each foot is known.
    meshes : sequence of (vertices_mm, faces)
        The feet's meshes, canonical mm, each on its own side.
    title, customer : str
        What the shop wants to read above the sheet; shown and not kept.
    day : date
        The day that the sheet shows.
    survey : str
        Where the shares of people come from.
    """
    shown = match.candidates or match.nearest
    drawn = drawn_feet(match, meshes)
    assert match.customer_length_mm is not None
    sizes = {size.system: size for size in foot_sizes(match.customer_length_mm)}
    asked = system_named(match.size_system) or SYSTEMS[USUAL_SYSTEM]
    widest = match.widths[wider_foot(match)]
    return html_page(
        "sheet.html.jinja",
        style="sheet.css",
        match=match,
        sheet_title=title,
        customer=customer,
        day=sheet_words.date_words(day),
        size=sizes[asked.name],
        width=widest.fitting(asked.name),
        other_sizes=[
            width_words.size_with_width(sizes[name], widest)
            for name in SHOWN_SYSTEMS
            if name != asked.name
        ],
        shares=[(share.people, width_words.share_words(share)) for share in widest.shares],
        widest_side=wider_side(match),
        measure_rows=measure_rows(match),
        differences=differences(match),
        best=shown[0] if shown else None,
        following=shown[1] if len(shown) > 1 else None,
        fits=bool(match.candidates),
        survey=survey,
        picture=picture_data(feet_figure(drawn)),
        marks=sorted({v for foot in drawn for v in foot.marks().values()}, key=sheet_words.rank),
    )


def wider_foot(match: Match) -> int:
    """Which foot of a customer is wider around the ball; the width follows it."""
    girths = [measure_of(match, place, "ball_girth").value or 0.0 for place in range(2)]
    return girths.index(max(girths[: len(match.feet)]))


def wider_side(match: Match) -> str | None:
    """The side of the wider foot of a pair; None if the feet are equally wide or it is one foot."""
    girths = [measure_of(match, place, "ball_girth").value for place in range(2)]
    if girths[0] is None or girths[1] is None:
        return None
    if rounded(abs(girths[0] - girths[1])) < sheet_words.EQUALLY_WIDE_MM:
        return None
    return match.feet[wider_foot(match)].aligned.alignment.side.side


def measure_of(match: Match, place: int, name: str) -> Measured:
    """A measure of one of the feet; unknown where there is no such foot or measure."""
    rows = match.feet[place].measures if place < len(match.feet) else ()
    return next((row.measured for row in rows if row.name == name), Measured(None))


def measure_rows(match: Match) -> list[tuple[str, list[Measured]]]:
    """The measures that the sheet shows of each foot, by their names for customers."""
    rows = (
        (words, [measure_of(match, place, name) for place in range(len(match.feet))])
        for name, words in COMPARED.items()
    )
    return [row for row in rows if any(known.value is not None for known in row[1])]


def differences(match: Match) -> list[str]:
    """How the left and the right foot of a pair differ in length and around the ball."""
    sides = [foot.aligned.alignment.side.side for foot in match.feet]
    if sorted(str(side) for side in sides) != ["left", "right"]:
        return []
    words = []
    for name, equal_mm, word in (
        ("length", EQUALLY_LONG_MM, "long"),
        ("ball_girth", sheet_words.EQUALLY_WIDE_MM, "wide"),
    ):
        values = {side: measure_of(match, i, name).value for i, side in enumerate(sides)}
        left, right = values["left"], values["right"]
        if left is not None and right is not None:
            words.append(sheet_words.difference_words((left, right), equal_mm, word))
    return words


def drawn_feet(match: Match, meshes: Sequence[Mesh]) -> list[DrawnFoot]:
    """The feet as they are drawn, the left one first; marked as they fit the best shoe."""
    fits = match.candidates[0].fits if match.candidates else ()
    feet = [
        DrawnFoot(
            mesh,
            foot.aligned.alignment.side.side,
            foot.length_mm or 0.0,
            sheet_words.place_verdicts(fits[i]) if fits else {},
        )
        for i, (foot, mesh) in enumerate(zip(match.feet, meshes, strict=True))
    ]
    return sorted(feet, key=lambda foot: foot.side or "")
