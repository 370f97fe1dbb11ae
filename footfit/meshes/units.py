"""Which unit a file's numbers are in."""

from __future__ import annotations

import math
from dataclasses import dataclass

from footfit.errors import BadOption, UnknownUnits
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.pose.extents import principal_extents
from footfit.results.values import Notice

UNIT_SCALES = {"mm": 1.0, "cm": 10.0, "in": 25.4, "m": 1000.0}
UNIT_NAMES = {"mm": "millimetres", "cm": "centimetres", "in": "inches", "m": "metres"}


@dataclass(frozen=True, slots=True)
class UnitSettings:
    """The ranges of the longest extent of a foot or last, in the order in which they are tried.

    Attributes
    ----------
    length_mm : tuple of float
        A usual foot or last. The range is so narrow that no two units fit one number (cm and inches
        are the closest pair).
    with_leg_mm : tuple of float
        A foot with so much leg that the leg is the longest extent. The alignment finds the foot's
        length and confirms or corrects the unit.
    possible_mm : tuple of float
        From the foot of a small child to the largest last. Cm and inches can both fit.
    longest_leg_mm : float
        No leg is longer, so no unit is proposed that makes the extent longer.
    """

    length_mm: tuple[float, float] = (180.0, 340.0)
    with_leg_mm: tuple[float, float] = (340.0, 900.0)
    possible_mm: tuple[float, float] = (110.0, 370.0)
    longest_leg_mm: float = 1_400.0


UNIT_SETTINGS = UnitSettings()


@dataclass(frozen=True, slots=True)
class Units:
    """A mesh's unit: ``name`` and ``source`` as in ``MeshInfo``, ``scale`` to mm, warnings."""

    name: str
    source: str
    scale: float
    warnings: tuple[Notice, ...] = ()


def plausible_unit(extent: float, settings: UnitSettings = UNIT_SETTINGS) -> tuple[str, float]:
    """The unit in which a longest extent is that of a foot or last, and its scale to mm.

    Parameters
    ----------
    extent : float
        In the file's own numbers.
    settings : UnitSettings

    Returns
    -------
    (str, float)
        Such as ``("m", 1000.0)``; the smaller unit if two fit. The alignment looks at the unit
        again.

    Raises
    ------
    UnknownUnits
        No unit fits.

    Examples
    --------
    >>> plausible_unit(0.262), plausible_unit(10.3), plausible_unit(410.0), plausible_unit(134.0)
    (('m', 1000.0), ('in', 25.4), ('mm', 1.0), ('mm', 1.0))
    """
    for shortest, longest in (settings.length_mm, settings.with_leg_mm, settings.possible_mm):
        for name, scale in UNIT_SCALES.items():
            if shortest <= extent * scale <= longest:
                return name, scale
    raise UnknownUnits(_no_unit(extent, settings))


def _no_unit(extent: float, settings: UnitSettings) -> str:
    """What a longest extent would be in the nearest units, and which option can help.

    Examples
    --------
    >>> near, advice = _no_unit(95.0, UNIT_SETTINGS).split(": ")
    >>> near
    'the longest extent is 95 (95 mm if in mm, 950 mm if in cm), and a foot or last has 110-370 mm'
    >>> advice
    'if the scale is wrong, give --known-length MM; if it has a long leg, give --units cm'
    """
    low, high = settings.possible_mm
    lengths = [(extent * scale, name) for name, scale in UNIT_SCALES.items()]
    below = [each for each in lengths if each[0] < low]
    above = [each for each in lengths if each[0] > high]
    near = ", ".join(f"{mm:,.4g} mm if in {name}" for mm, name in (*below[-1:], *above[:1]))
    words = f"the longest extent is {extent:.4g} ({near}), and a foot or last has"
    words += f" {low:.0f}-{high:.0f} mm: if the scale is wrong, give --known-length MM"
    if above and above[0][0] <= settings.longest_leg_mm:
        words += f"; if it has a long leg, give --units {above[0][1]}"
    return words


def settled_units(
    vertices: Floats, wanted: str, known_length_mm: float | None, in_file: str | None
) -> Units:
    """A mesh's unit: from a known length, else as the user or the file says, else as it fits.

    Parameters
    ----------
    vertices : (n, 3) float64
        Cleaned, in the file's numbers.
    wanted : str
        "mm", "cm", "m", "in", or "auto".
    known_length_mm : float or None
        In mm. It makes the longest principal extent this long, until the alignment knows the
        length of the foot and settles the scale.
    in_file : str or None
        The unit that the file itself declares.

    Raises
    ------
    UnknownUnits
        The unit is "auto", and none fits.
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
        f"the unit is taken to be {UNIT_NAMES[name]}: the longest extent is then"
        f" {extent * scale:.0f} mm (use --units for another unit)"
    )
    return Units(name, "detected", scale, (Notice("units_detected", message),))


def _impossible_length(known_mm: float) -> str:
    """What is wrong with a known length, and what may have been meant, as in another unit.

    Examples
    --------
    >>> _impossible_length(25.2)
    'the known length of 25.2 mm is too short; this is in mm: did you mean 252?'
    >>> _impossible_length(4000.0)
    'the known length of 4000 mm is too long; it is 110-370 mm'
    >>> _impossible_length(math.nan)
    'the known length is not a number; it is 110-370 mm'
    """
    low, high = UNIT_SETTINGS.possible_mm
    if math.isnan(known_mm):
        return f"the known length is not a number; it is {low:.0f}-{high:.0f} mm"
    words = f"the known length of {known_mm:g} mm is too {'short' if known_mm < low else 'long'}"
    meant = [known_mm * scale for scale in (*UNIT_SCALES.values(), 0.1)]
    for least, most in (UNIT_SETTINGS.length_mm, UNIT_SETTINGS.possible_mm):
        if close := [mm for mm in meant if least <= mm <= most]:
            return f"{words}; this is in mm: did you mean {close[0]:.0f}?"
    return f"{words}; it is {low:.0f}-{high:.0f} mm"


def check_unit_options(wanted: str, known_length_mm: float | None) -> None:
    """Refuse unit options that cannot be carried out, before a file is opened.

    Raises
    ------
    BadOption
        The unit is unknown, the known length is not one of a foot or last, or both are given.
    """
    if wanted != "auto" and wanted not in UNIT_SCALES:
        raise BadOption(f"no unit is called {wanted!a}: use {', '.join(UNIT_SCALES)} or auto")
    if known_length_mm is None:
        return
    low, high = UNIT_SETTINGS.possible_mm
    if not low <= known_length_mm <= high:
        raise BadOption(_impossible_length(known_length_mm))
    if wanted != "auto":
        raise BadOption("--units and --known-length exclude each other: give only one of them")
