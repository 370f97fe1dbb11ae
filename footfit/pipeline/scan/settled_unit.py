"""The unit of a scan, settled by its length along X, and the notices about it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from footfit.errors import ImplausibleSize, UnknownUnits
from footfit.geometry.search.pose_search import Windows
from footfit.meshes.units import UNIT_NAMES, UNIT_SCALES, UNIT_SETTINGS
from footfit.number_words import plain
from footfit.results import MeshInfo, Notice, Scan


@dataclass(frozen=True, slots=True)
class LengthSettings:
    """Which lengths along X are plausible, in mm.

    ``window_slack``: how far the rough pose's length may be off, as a share.
    """

    usual_mm: tuple[float, float] = UNIT_SETTINGS.length_mm
    possible_mm: tuple[float, float] = UNIT_SETTINGS.possible_mm
    window_slack: float = 0.15


LENGTHS = LengthSettings()


def length_windows(info: MeshInfo, known_length_mm: float | None) -> Windows:
    """Plausible lengths, in the scan's provisional mm; none if the scale is unknown."""
    if known_length_mm is not None or info.units_source == "known-length":
        return ()
    ranges = [(*LENGTHS.possible_mm, info.unit_scale)]
    if info.units_source == "detected":
        ranges += [(*LENGTHS.usual_mm, scale) for scale in UNIT_SCALES.values()]
    less, more = 1 - LENGTHS.window_slack, 1 + LENGTHS.window_slack
    return tuple(
        (less * low * info.unit_scale / scale, more * high * info.unit_scale / scale)
        for low, high, scale in ranges
    )


def info_with_unit(
    info: MeshInfo, extent: float, length: float, known_length_mm: float | None
) -> MeshInfo:
    """The info with the unit that the extent along X confirms, or that gives the known length.

    ``extent`` and the measured ``length`` are in provisional mm.

    Raises
    ------
    UnknownUnits, ImplausibleSize
        No unit, or not the declared one, makes it a foot's or last's.
    """
    if known_length_mm is not None:
        scale = info.unit_scale * known_length_mm / length
        return replace(info, units="scaled", units_source="known-length", unit_scale=scale)
    if info.units_source == "detected":
        name = detected_unit(extent / info.unit_scale)
        return replace(info, units=name, unit_scale=UNIT_SCALES[name])
    least, most = LENGTHS.possible_mm
    if info.units_source == "declared" and not least <= extent <= most:
        raise ImplausibleSize(
            f"taken as {UNIT_NAMES[info.units]}, the length is {extent:,.0f} mm, and a foot or last"
            f" has {least:.0f}-{most:.0f} mm: check --units, or give --known-length MM"
        )
    return info


def detected_unit(length: float) -> str:
    """The unit that makes a length in the file's numbers usual; else the only possible one.

    Raises
    ------
    UnknownUnits
        No unit makes it a possible length, or two do.

    Examples
    --------
    >>> detected_unit(25.0), detected_unit(10.0), detected_unit(125.0)
    ('cm', 'in', 'mm')
    """
    for low, high in (LENGTHS.usual_mm, LENGTHS.possible_mm):
        names = [name for name, scale in UNIT_SCALES.items() if low <= length * scale <= high]
        if len(names) == 1:
            return names[0]
    low, high = LENGTHS.possible_mm
    if not names:
        raise UnknownUnits(
            f"no unit makes the length ({length:.4g} in the file) {low:.0f}-{high:.0f} mm:"
            " if the scale is wrong, give --known-length MM"
        )
    lengths = " or ".join(f"{length * UNIT_SCALES[n]:.0f} mm (--units {n})" for n in names)
    raise UnknownUnits(f"the length {length:.4g} in the file is {lengths}: give --units")


def read_notices(scan: Scan, info: MeshInfo, length_mm: float | None) -> list[Notice]:
    """The scan's warnings, with the unit that is settled in place of the one that was guessed."""
    kept = [notice for notice in scan.warnings if notice.code != "units_detected"]
    if info.units_source != "detected" or info.units == "mm":
        return kept
    return [*kept, _detected(info, length_mm)]


def length_notices(length_mm: float) -> list[Notice]:
    """A length that is possible, but unusual."""
    low, high = LENGTHS.usual_mm
    if low <= length_mm <= high:
        return []
    words = f"the length is {plain(length_mm)} mm, outside the usual {low:.0f}-{high:.0f} mm"
    return [Notice("length_unusual", words)]


def _detected(info: MeshInfo, length_mm: float | None) -> Notice:
    length = "" if length_mm is None else f", so the length is {plain(length_mm)} mm"
    words = f"the numbers are taken as {UNIT_NAMES[info.units]}{length} (--units changes this)"
    return Notice("units_detected", words)
