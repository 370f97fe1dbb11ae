"""The look that all pictures share, and their bytes: SVG and PNG, the same on every run."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from footfit.errors import BadOption

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.geometry.numeric.arrays import Floats
    from footfit.report.pictures.shading import Frame

Point = tuple[float, float]

INK = "#22303c"
QUIET = "#8a97a3"
PAPER = "#ffffff"
FILL = "#e9edf0"
SERIES = ("#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00")
"""Colours that the colour-blind tell apart (Okabe and Ito); each also has its own dash."""
DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (8, 2, 2, 2)), (0, (1, 1)))
REAR_WINDOW, FORE_WINDOW = "#cfe3f2", "#fbe3c8"
DIVERGING = "RdBu_r"
"""Red for convex and for inward, blue for hollow and for outward; safe for the colour-blind."""
VERDICT_COLOURS = {
    "good": "#1b7a4b",
    "acceptable": "#a86200",
    "poor": "#b3261e",
    "reject": "#5f1512",
}
"""The verdicts' colours, as on the page."""
SKIN = (0.86, 0.80, 0.74)

_STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.edgecolor": QUIET,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "xtick.color": QUIET,
    "ytick.color": QUIET,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "text.color": INK,
    "text.parse_math": False,
    "figure.facecolor": PAPER,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "svg.hashsalt": "footfit",
    "svg.fonttype": "path",
}


@contextmanager
def house_style() -> Iterator[None]:
    """Use the defaults of matplotlib and this look; the settings of a user change nothing."""
    import matplotlib.style

    with matplotlib.style.context(["default", _STYLE]):
        yield


@contextmanager
def new_figure(width: float, height: float) -> Iterator[Figure]:
    """Make a figure of this size in inches, and use the look of all pictures to draw on it."""
    from matplotlib.figure import Figure

    with house_style():
        yield Figure(figsize=(width, height), layout="constrained")


def svg_text(figure: Figure) -> str:
    """The figure as SVG: text is drawn as outlines; there is no date and no program's address."""
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    return _file_of(figure, format="svg", metadata=nothing).decode("utf-8")


def png_bytes(figure: Figure) -> bytes:
    """The figure as PNG, 150 dots an inch."""
    return _file_of(figure, format="png", dpi=150, metadata={"Software": None})


def _file_of(figure: Figure, **options: Any) -> bytes:
    target = io.BytesIO()
    with house_style():
        figure.savefig(target, **options)
    return target.getvalue()


def picture_bytes(figure: Figure, kind: str) -> bytes:
    """The figure in the format ``kind``: "svg" or "png".

    Raises
    ------
    BadOption
        Another format is asked for.
    """
    if kind == "svg":
        return svg_text(figure).encode("utf-8")
    if kind == "png":
        return png_bytes(figure)
    raise BadOption(f"a picture is svg or png, not {kind!r}; end its name in .svg or .png")


def write_title(figure: Figure, words: str) -> None:
    """Write the title of a whole figure into its upper left corner."""
    figure.suptitle(words, x=0.01, ha="left", fontsize=12, fontweight="bold")


def show_image(axes: Axes, image: Floats, frame: Frame) -> None:
    """Show an RGBA image in an axes whose data are mm, as large as ``frame``."""
    extent = (frame.left, frame.right, frame.bottom, frame.top)
    axes.imshow(image, extent=extent, interpolation="antialiased")
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
    hide_axes(axes)


def draw_scale_bar(
    axes: Axes, length_mm: float = 50.0, place: tuple[float, float] = (0.03, 0.02)
) -> None:
    """Draw a bar of ``length_mm`` in an axes whose data are mm, at ``place`` in axes fractions."""
    left, right = axes.get_xlim()
    bottom, top = axes.get_ylim()
    x, y = left + place[0] * (right - left), bottom + place[1] * (top - bottom)
    step = length_mm if right > left else -length_mm
    axes.plot([x, x + step], [y, y], color=INK, linewidth=2.0, solid_capstyle="butt")
    write_beside(axes, f"{length_mm:.0f} mm", (x + step / 2, y), (0, 3), fontsize=8)


def write_beside(
    axes: Axes, words: str, place: Point, offset: Point = (0.0, 0.0), **style: Any
) -> None:
    """Write words, centred ``offset`` points away from a place in the axes' data."""
    style = {"textcoords": "offset points", "ha": "center"} | style
    axes.annotate(words, place, xytext=offset, **style)


def arrow_style(colour: str, width: float, head: str = "-|>", shrink: int = 0) -> dict[str, Any]:
    """How an arrow is drawn; ``shrink`` points are left out at its end."""
    return {
        "arrowstyle": head,
        "color": colour,
        "linewidth": width,
        "shrinkA": 0,
        "shrinkB": shrink,
    }


def hide_axes(axes: Axes) -> None:
    """Show a drawing in true proportion, without ticks and frame."""
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)
