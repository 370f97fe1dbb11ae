"""Which unit a file's numbers are in."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.errors import BadOption, UnknownUnits
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.pose.extents import principal_extents
from footfit.results import Notice

UNIT_SCALES = {"mm": 1.0, "cm": 10.0, "in": 25.4, "m": 1000.0}
UNIT_NAMES = {"mm": "millimetres", "cm": "centimetres", "in": "inches", "m": "metres"}


@dataclass(frozen=True, slots=True)
class UnitSettings:
    """Between which lengths the longest extent of a foot or last lies.

    Attributes
    ----------
    length_mm : tuple of float
        A foot or last; narrow enough that two units never both fit (10 / 25.4 is the closest pair).
    with_leg_mm : tuple of float
        A foot with so much leg that the leg is the longest extent; the alignment, which finds the
        foot's length, confirms or corrects it.
    """

    length_mm: tuple[float, float] = (180.0, 340.0)
    with_leg_mm: tuple[float, float] = (340.0, 900.0)


UNIT_SETTINGS = UnitSettings()


@dataclass(frozen=True, slots=True)
class Units:
    """The answer: ``name`` and ``source`` as in ``MeshInfo``, ``scale`` to mm, what to say."""

    name: str
    source: str
    scale: float
    warnings: tuple[Notice, ...] = ()


def plausible_unit(extent: float, settings: UnitSettings = UNIT_SETTINGS) -> tuple[str, float]:
    """The unit that makes a longest extent a foot's or last's, and its scale to mm.

    Parameters
    ----------
    extent : float
        In the file's own numbers.
    settings : UnitSettings

    Returns
    -------
    (str, float)
        Such as ``("m", 1000.0)``. Where a long leg fits two units, the smaller one.

    Raises
    ------
    UnknownUnits
        No unit does.

    Examples
    --------
    >>> plausible_unit(0.262), plausible_unit(10.3), plausible_unit(410.0)
    (('m', 1000.0), ('in', 25.4), ('mm', 1.0))
    """
    for shortest, longest in (settings.length_mm, settings.with_leg_mm):
        for name, scale in UNIT_SCALES.items():
            if shortest <= extent * scale <= longest:
                return name, scale
    low, high = settings.length_mm
    raise UnknownUnits(
        f"the longest extent is {extent:.4g}, and no unit (mm, cm, m, in) makes that a foot's or"
        f" last's {low:.0f}-{high:.0f} mm: say --units, or --known-length MM"
    )


def settled_units(
    vertices: Floats, wanted: str, known_length_mm: float | None, in_file: str | None
) -> Units:
    """A mesh's unit: by a known length, else as declared, as the file says, or as is plausible.

    Parameters
    ----------
    vertices : (n, 3) float64
        Cleaned, in the file's numbers.
    wanted : str
        "mm", "cm", "m", "in", or "auto".
    known_length_mm : float or None
        The scale is then provisional: it makes the longest principal extent this long; the
        alignment settles it on the length of the foot.
    in_file : str or None
        The unit that the file itself declares.

    Raises
    ------
    UnknownUnits
        "auto", and no unit is plausible.
    """
    if known_length_mm is not None:
        extent = float(principal_extents(vertices)[0][0])
        return Units("scaled", "known-length", known_length_mm / extent)
    declared = wanted if wanted != "auto" else in_file
    if declared is not None:
        return Units(declared, "declared", UNIT_SCALES[declared])
    extent = float(principal_extents(vertices)[0][0])
    name, scale = plausible_unit(extent)
    if name == "mm":
        return Units(name, "detected", scale)
    message = (
        f"the numbers are taken as {UNIT_NAMES[name]}: the longest extent is then"
        f" {extent * scale:.0f} mm (--units says otherwise)"
    )
    return Units(name, "detected", scale, (Notice("units_detected", message),))


def checked_options(wanted: str, known_length_mm: float | None) -> None:
    """Refuse unit options that cannot be carried out, before a file is opened.

    Raises
    ------
    BadOption
        An unknown unit, a known length outside what is possible, or both given.
    """
    if wanted != "auto" and wanted not in UNIT_SCALES:
        raise BadOption(f"no unit is called {wanted!a}: use {', '.join(UNIT_SCALES)} or auto")
    if known_length_mm is None:
        return
    if not 0.0 < known_length_mm < float("inf"):
        raise BadOption("a known length is a positive number of mm")
    if wanted != "auto":
        raise BadOption("--units and --known-length contradict each other: give one of them")
