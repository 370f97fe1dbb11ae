"""Answers about meshes as rich renderables for a terminal of 80 columns or more.

Words carry every meaning, and colour only repeats it. Every string from outside goes through
`cell`, which shows control characters and escapes markup. The command line writes warnings to
stderr, so they are not here.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Literal

from rich import box
from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from footfit import results
from footfit.number_words import RATIO_KEPT, plain, signed
from footfit.report.wording.text import (
    OF_RIM,
    SPREADS,
    class_words,
    length_text,
    measured_text,
    turn_words,
    visible,
)
from footfit.results.profile import spread_part

STATUS_STYLES = {"added": "green", "replaced": "green", "unchanged": "dim", "refused": "bold red"}


def terminal_text(renderable: RenderableType, width: int = 80, colour: bool = False) -> str:
    """What a terminal of ``width`` columns would show, with ANSI colours or as plain text.

    A text is one line, however long it is: scripts count the lines.
    """
    target = io.StringIO()
    console = Console(
        file=target,
        width=width,
        force_terminal=colour,
        color_system="standard" if colour else None,
        legacy_windows=False,
        highlight=False,
        emoji=False,
        markup=False,
    )
    console.print(renderable, soft_wrap=isinstance(renderable, Text))
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines()) + "\n"


def cell(text: str | None, style: str = "") -> Text:
    """A string from outside as a cell, without markup or control characters; a dash for none."""
    return Text(visible(text), style) if text else Text("-", "dim")


def facts(*rows: tuple[str, str | Text], title: str | None = None) -> RenderableType:
    """Names and values in two columns, under a bold title."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column(overflow="fold")
    for name, value in rows:
        grid.add_row(name, value if isinstance(value, Text) else Text(value))
    return Group(Text(visible(title), "bold"), grid) if title else grid


def lined_table(*columns: str, right: frozenset[str] = frozenset()) -> Table:
    """An empty table with a line under its head; the columns of ``right`` hold numbers. The name of
    a zone stays on one line.
    """
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for column in columns:
        number, whole = column in right, column == "zone"
        align: Literal["left", "right"] = "right" if number else "left"
        table.add_column(column, justify=align, overflow="fold", no_wrap=whole)
    return table


def side_words(side: results.SideVerdict) -> str:
    """The side, how sure it is, and where it comes from.

    Examples
    --------
    >>> from footfit.results import SideVerdict
    >>> side_words(SideVerdict("left", "sure", -4.21, "detected"))
    'left (detected, sure, score -4.2)'
    >>> side_words(SideVerdict(None, "undecided", 0.1, "detected"))
    'undecided (score +0.1)'
    """
    if side.side is None:
        return f"undecided (score {signed(side.score)})"
    if side.source == "given" and side.confidence != "sure":
        return f"{side.side} (given; the shape looks {side.shown}, score {signed(side.score)})"
    if side.source == "given":
        return f"{side.side} (given)"
    return f"{side.side} ({side.source}, {side.confidence}, score {signed(side.score)})"


def kind_words(pose: results.PoseQuality) -> str:
    """Foot or last, and what is known of how sure that is.

    Examples
    --------
    >>> from footfit.results import PoseQuality
    >>> kind_words(PoseQuality(0.4, 0.1, 0.2, True, "last", "low"))
    'last (detected, not sure)'
    """
    known = {"sure": "detected, sure", "low": "detected, not sure", "given": "given", None: ""}
    words = known[pose.kind_confidence]
    return f"{pose.kind} ({words})" if words else pose.kind


def aligned_scan_table(scan: results.AlignedScan) -> RenderableType:
    """One mesh, aligned: the answer of ``footfit align``."""
    return align_table(scan.alignment)


def align_table(alignment: results.Alignment) -> RenderableType:
    """One mesh, aligned."""
    frame, pose, info = alignment.eigenframe, alignment.pose, alignment.info
    centroid = ", ".join(plain(float(value)) for value in frame.centroid_mm)
    cost, margin = (plain(value, 2, RATIO_KEPT) for value in (pose.cost, pose.margin))
    sole = "rests on its sole" if pose.sole else "no sole: referred to its rim"
    rows: list[tuple[str, str | Text]] = [
        ("mesh", f"{info.faces:,} faces, {'closed' if info.watertight else 'open'}"),
        ("units", f"{info.units} ({info.units_source})"),
        ("kind", kind_words(pose)),
        ("side", side_words(alignment.side)),
        ("method", alignment.method),
        ("length", length_text(alignment.length)),
        ("eigenvalues", eigenvalue_words(frame)),
        ("centroid", f"{centroid} mm (the file's axes)"),
        ("pose", f"cost {cost}, margin {margin}, {sole}"),
    ]
    if alignment.stance is not None:
        rows += stance_rows(alignment.stance)
    if alignment.reference is not None:
        rows.append(("reference", cell(alignment.reference.last)))
    return facts(*rows, title=info.path or "standard input")


def stance_rows(stance: results.LastStance) -> list[tuple[str, str | Text]]:
    """How a last stands: its heel height and its toe spring, and what decides them."""
    by = {"label": "by the label", "shape": "by the shape alone"}[stance.decided_by]
    heel = results.Measured(stance.heel_height_mm, total_sd=stance.heel_height_sd_mm)
    spring = results.Measured(stance.toe_spring_tip_mm, total_sd=stance.toe_spring_tip_sd_mm)
    return [
        ("heel height", f"{measured_text(heel, 'mm')} ({by})"),
        ("toe spring tip", measured_text(spring, "mm")),
        ("±", Text(SPREADS, "dim")),
    ]


def eigenvalue_words(frame: results.Eigenframe) -> str:
    """The value of each eigenvector, under the names in the picture of the frames.

    Examples
    --------
    >>> import numpy as np
    >>> from footfit.results import Eigenframe
    >>> eigenvalue_words(Eigenframe(np.zeros(3), np.eye(3), np.array([5200.0, 480.0, 610.0])))
    'e1 5200.0, e2 480.0, e3 610.0 mm2'
    """
    values = (plain(float(value)) for value in frame.eigenvalues_mm2)
    return ", ".join(f"e{row} {value}" for row, value in enumerate(values, 1)) + " mm2"


def flare_table(profiled: results.Profiled) -> RenderableType:
    """The flare of one mesh, with the spread of its curvature."""
    alignment, flare = profiled.aligned.alignment, profiled.flare
    rows: list[tuple[str, str | Text]] = [
        ("side", side_words(alignment.side)),
        ("flare", Text(flare_words(profiled), "bold")),
        ("length", length_text(alignment.length)),
        ("definition", flare.definition.version),
        ("±", Text(SPREADS, "dim")),
    ]
    for channel, values in flare.curvature.items():
        rows.append((channel, "not measurable" if values is None else _range_words(values)))
    return facts(*rows, title=alignment.info.path or "standard input")


def flare_words(profiled: results.Profiled) -> str:
    """The flare angle with its uncertainty, and the class of a last."""
    flare = profiled.flare
    return f"{turn_words(flare, 'deg')}{class_words(flare)}"


def _range_words(values: Sequence[float] | object) -> str:
    import numpy as np

    array = np.asarray(values, dtype=np.float64)
    known = array[np.isfinite(array)]
    if not len(known):
        return "not measurable"
    return f"{signed(float(known.min()))} to {signed(float(known.max()))} (curvature times length)"


def ingest_line(outcome: results.IngestOutcome) -> Text:
    """The outcome of one file, in one line; why it was refused is said as an error."""
    line = Text(f"{outcome.status:<10}", STATUS_STYLES.get(outcome.status, ""))
    if outcome.failure is not None:
        return line.append(visible(outcome.path or "standard input"), "default")
    line.append(visible(outcome.last or "-"), "bold default")
    if outcome.side is not None:
        line.append(f"  {outcome.side}", "not bold")
    if outcome.flare_angle_deg is not None:
        line.append(f"  flare {signed(outcome.flare_angle_deg)} deg", "not bold")
    return line.append("  is now the reference", "not bold") if outcome.reference else line


def curvature_table(curvature: results.SurfaceCurvature) -> RenderableType:
    """The spread of a surface's curvature."""
    scale = f"radius {plain(curvature.radius_mm)} mm" if curvature.radius_mm else "one ring"
    rows: list[tuple[str, str | Text]] = [("scale", scale)]
    named = (("k1", curvature.k1, "1/mm"), ("k2", curvature.k2, "1/mm"))
    more = (("mean", curvature.mean, "1/mm"), ("gaussian", curvature.gaussian, "1/mm2"))
    for name, values, unit in (*named, *more):
        quantiles = " / ".join(
            "-" if value is None else f"{value:+.5f}" for value in spread_part(values).values()
        )
        rows.append((name, f"{quantiles} {unit} (5 % / median / 95 %)"))
    return facts(*rows, title=curvature.info.path or "standard input")


def draw_last_table(drawing: results.Drawing) -> RenderableType:
    """The views that were drawn in true size, and those that are missing."""
    alignment = drawing.alignment
    rows: list[tuple[str, str | Text]] = [("side", side_words(alignment.side))]
    for view in drawing.views:
        width, height = (plain(value) for value in view.size_mm)
        rows.append((view.name, f"{width} x {height} mm"))
    if drawing.missing:
        rows.append(("not drawn", f"{', '.join(drawing.missing)}: the scan is open there"))
    if drawing.has_rim:
        rows.append(("hole", OF_RIM))
    return facts(*rows, title=alignment.info.path or "standard input")


def measure_table(scan: results.MeasuredScan) -> RenderableType:
    """One mesh: every measure with its uncertainty, or the reason why there is none."""
    alignment = scan.alignment
    rows: list[tuple[str, str | Text]] = [
        ("side", f"{side_words(alignment.side)}, measured as a {kind_words(alignment.pose)}")
    ]
    for measure in scan.measures:
        words = cell(measured_text(measure.measured, measure.unit))
        rows.append((measure.words, words))
    rows.append(("±", Text(SPREADS, "dim")))
    return facts(*rows, title=alignment.info.path or "standard input")
