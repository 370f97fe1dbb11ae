"""The page of one foot in one last, and the parts of it that the page of a match shows too."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.report.page.page import Cell, page, picture, table, text, together, warning
from footfit.report.page.scene import scene_block
from footfit.report.wording.comparison_words import (
    SIZE_HEADS,
    lengths_words,
    swing_words,
)
from footfit.report.wording.text import difference_text, file_name, plain, signed, visible
from footfit.results import Candidate, FlareDifference, Match

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results import Comparison, SectionComparison

ZONE_HEADS = (
    ("Mean, mm", "n"),
    ("5 to 95 %, mm", "n"),
    ("Tight, cm²", "n"),
    ("Loose, cm²", "n"),
    ("Area, cm²", "n"),
)


def compare_report(comparison: Comparison) -> str:
    """One foot in one last as a whole HTML page; the same bytes for the same comparison."""
    scene = scene_block(comparison)
    foot, last = _names(comparison)
    mirrored = " (a last of the other side, mirrored)" if comparison.mirrored else ""
    side = comparison.foot.aligned.alignment.side.side
    body = [
        f"<h1>{text(foot)} in {text(last)}</h1>",
        f'<p class="lead">The {side} foot in the last{mirrored}: '
        f"{text(lengths_words(comparison))}.</p>",
        *(warning(notice) for notice in comparison.warnings),
        scene,
        "<h2>The room, zone by zone</h2>",
        room_part(comparison, named=False),
        heat_picture(comparison),
        "<h2>The sections, last minus foot</h2>",
        section_table(comparison),
        section_picture(comparison),
        together("Flare: the foot against the last", flare_picture(comparison)),
        HOW,
    ]
    return page(f"footfit: {foot} in {last}", body, scene=bool(scene))


HOW = """<div class="read"><h2>How to read it</h2>
<p>The foot is laid into the last heel on heel and tread on tread; the last's pitch and toe spring
are followed by turning the foot and bending it ahead of its tread. The room is the distance from
the foot's surface to the last's: + is room, - is where the foot is larger. What stands over a
shoe's topline is not compared.</p>
<p>Tight counts the area with less than -2 mm, loose the area with more than +8 mm. An edge's
difference says how far the last's edge lies outside of the foot's. ± is one standard deviation.
</p></div>"""


def _names(comparison: Comparison) -> tuple[str, str]:
    foot = file_name(comparison.foot.aligned.alignment.info.path)
    return foot, visible(comparison.last.labels.name)


def wide_scene(comparisons: Sequence[Comparison]) -> str:
    """The one 3D view of a page: of the longer foot."""
    if not comparisons:
        return ""
    return scene_block(max(comparisons, key=lambda one: one.foot.length_or_extent_mm))


def heat_picture(comparison: Comparison) -> str:
    """The room from four sides."""
    from footfit.report.pictures.heat_figure import heat_figure

    foot, last = _names(comparison)
    words = (
        f"{foot} in {last} from four sides: blue is room, red is where the foot is larger; the "
        "dashed line is the last."
    )
    return picture(heat_figure(comparison, titled=False), words, kind="wide")


def section_picture(comparison: Comparison, *, strip: bool = False) -> str:
    """The sections; in one strip where they are not the page's matter."""
    from footfit.report.pictures.section_figure import ACROSS, STRIP, section_figure

    foot, last = _names(comparison)
    words = (
        f"{foot} (filled) and {last} (line) cut by the same planes, seen from behind; last minus "
        "foot in mm."
    )
    figure = section_figure(comparison, STRIP if strip else ACROSS, titled=False)
    return picture(figure, words, kind="wide")


def flare_picture(comparison: Comparison) -> str:
    """Sole, profile, heading and plan curvature of the two, heels together as they were aligned."""
    from footfit.report.pictures.match_figure import match_figure

    foot, last = _names(comparison)
    words = (
        f"{foot} with {last}. Sole from above, profile from the side, heading and plan curvature "
        "along the centre line."
    )
    figure = match_figure(_as_match(comparison), {last_name(comparison): _stored_side(comparison)})
    return picture(figure, words, kind="flare")


def last_name(comparison: Comparison) -> str:
    """The last's name as it is stored."""
    return comparison.last.labels.name


def _stored_side(comparison: Comparison) -> tuple[Floats, Ints]:
    """The last's mesh on its own side: the comparison holds a right shape."""
    vertices, faces = comparison.last_vertices_mm, comparison.last_faces
    if comparison.last.side.side != "left":
        return vertices, faces
    return vertices * np.array([1.0, -1.0, 1.0]), faces[:, ::-1]


def _as_match(comparison: Comparison) -> Match:
    """The comparison as the answer of a search that found this one last, for its flare plot."""
    last, labels = comparison.last, comparison.last.labels
    found = Candidate(
        rank=1,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        mirrored=comparison.mirrored,
        distance=0.0,
        flare=FlareDifference(0.0, comparison.flare_delta_deg, ()),
        clearance_mm=(),
        verdict=None,
        why="",
        tied_with=(),
        record=last,
    )
    return Match((comparison.foot,), "shape", "", 1, None, (found,), (), ())


def room_part(comparison: Comparison, *, named: bool) -> str:
    """The room by zone as a table, with the swing in words."""
    foot = text(_names(comparison)[0])
    title = f"<h3>{foot}</h3>" if named else ""
    shown = ZONE_HEADS[:-1] if named else ZONE_HEADS  # two feet share a row: no room for the area
    cells = (row[: len(shown) + 1] for row in _zone_rows(comparison))
    rows = table([("Zone", ""), *shown], cells, kind="zones")
    return f"{title}{rows}<p>{text(swing_words(comparison).capitalize())}.</p>"


def _zone_rows(comparison: Comparison) -> Iterable[list[Cell]]:
    for zone in comparison.zones:
        if zone.mean_mm is None or zone.p05_mm is None or zone.p95_mm is None:
            yield [(text(zone.zone), "name"), *[("-", "n")] * len(ZONE_HEADS)]
            continue
        yield [
            (text(zone.zone), "name"),
            (signed(zone.mean_mm), "n"),
            (f"{signed(zone.p05_mm)} to {signed(zone.p95_mm)}", "n"),
            (plain(zone.tight_cm2, 0), "n"),
            (plain(zone.loose_cm2, 0), "n"),
            (plain(zone.area_cm2, 0), "n"),
        ]


def section_table(comparison: Comparison) -> str:
    """The differences of every section, with where it is cut."""
    heads = [("Section", ""), ("At, mm", "n"), *((name, "n") for name in SIZE_HEADS.values())]
    rows = (_section_row(section) for section in comparison.sections)
    return table([(name[:1].upper() + name[1:], kind) for name, kind in heads], rows, kind="zones")


def _section_row(section: SectionComparison) -> list[Cell]:
    sizes = {size.name: size.difference for size in section.sizes}
    return [
        (text(section.station), "name"),
        (plain(section.x_mm, 0), "n"),
        *((difference_text(sizes[name]), "n") for name in SIZE_HEADS),
    ]
