"""A known bend planted in a foot: in plan, along any line, and what it is worth to the flare.

A bend along the foot's own centre line changes no section normal to it: the true change of the
heading is the planted one, whatever the windows. A bend along another line (X) also stretches
what lies beside that line; its true change is read from where the foot's own line comes to lie.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition, FlareProfile

SPAN = (0.30, 0.55)  # stations between which a foot is bent: between the flare angle's windows
_STATIONS = np.linspace(-0.6, 1.6, 8801)


@dataclass(frozen=True)
class Axis:
    """A plan curve: ``points`` (g, 2) in mm and ``heading`` (g,) in radians at _STATIONS."""

    points: np.ndarray
    heading: np.ndarray
    length_mm: float


def axis_of(heading: np.ndarray, length_mm: float, start: np.ndarray) -> Axis:
    """The curve of a heading (g,) whose station 0 is at ``start`` (2,)."""
    middle = 0.5 * (heading[1:] + heading[:-1])
    steps = np.column_stack([np.cos(middle), np.sin(middle)]) * np.diff(_STATIONS)[:, None]
    points = np.vstack([np.zeros(2), np.cumsum(steps, axis=0)]) * length_mm
    return Axis(points - at(0.0, points) + start, heading, length_mm)


def at(station: np.ndarray | float, table: np.ndarray) -> np.ndarray:
    """The rows (k, c) of a table (g, c) at some stations (k,)."""
    return np.column_stack([np.interp(station, _STATIONS, column) for column in table.T])


def own_line(profile: FlareProfile, length_mm: float) -> Axis:
    """A foot's centre line, straight on beyond its first and last station."""
    line = profile.centre_line * length_mm
    share = profile.stations[-1] - profile.stations[0]
    arc_mm = float(np.hypot(*np.diff(line, axis=0).T).sum()) / share
    heading = np.radians(np.interp(_STATIONS, profile.stations, profile.heading_deg))
    first = axis_of(heading, arc_mm, np.zeros(2))
    return axis_of(heading, arc_mm, line[0] - at(profile.stations[0], first.points)[0])


def x_axis(length_mm: float) -> Axis:
    """The straight line from heel to toe of the canonical frame."""
    return axis_of(np.zeros_like(_STATIONS), length_mm, np.zeros(2))


def bent(points: np.ndarray, axis: Axis, turn_deg: float) -> np.ndarray:
    """Points (n, 2 or 3) after the axis was bent: each keeps its station and its distance."""
    station, aside = _beside(points[:, :2], axis)
    t = np.clip((_STATIONS - SPAN[0]) / (SPAN[1] - SPAN[0]), 0.0, 1.0)
    heading = axis.heading + np.radians(turn_deg) * t * t * (3.0 - 2.0 * t)
    after = axis_of(heading, axis.length_mm, at(0.0, axis.points)[0])
    there = np.interp(station, _STATIONS, heading)
    plan = at(station, after.points)
    plan += aside[:, None] * np.column_stack([-np.sin(there), np.cos(there)])
    return np.column_stack([plan, points[:, 2:]])


def _beside(plan: np.ndarray, axis: Axis) -> tuple[np.ndarray, np.ndarray]:
    """The station of the axis in whose normal plane each point lies, and its distance there."""
    station = (plan[:, 0] - at(0.0, axis.points)[0, 0]) / axis.length_mm
    for _ in range(12):
        away = plan - at(station, axis.points)
        heading = np.interp(station, _STATIONS, axis.heading)
        ahead = away[:, 0] * np.cos(heading) + away[:, 1] * np.sin(heading)
        station = station + ahead / axis.length_mm
    return station, away[:, 1] * np.cos(heading) - away[:, 0] * np.sin(heading)


def true_change_deg(
    line: Axis, axis: Axis, turn_deg: float, definition: FlareDefinition | None = None
) -> float:
    """What a bend of the axis does to the flare angle of a foot with this centre line."""
    definition = FlareDefinition() if definition is None else definition
    plan = at(np.linspace(0.0, 1.0, 4001), line.points)
    return _flare_deg(bent(plan, axis, turn_deg), definition) - _flare_deg(plan, definition)


def _flare_deg(plan: np.ndarray, definition: FlareDefinition) -> float:
    """The flare angle of a curve (k, 2) from heel to toe, by its own length."""
    run = np.diff(plan, axis=0)
    step = np.hypot(*run.T)
    station = (np.cumsum(step) - 0.5 * step) / step.sum()
    heading = np.degrees(np.arctan2(run[:, 1], run[:, 0]))
    inside = [(station > a) & (station < b) for a, b in (definition.forefoot, definition.rearfoot)]
    fore, rear = (np.average(heading[window], weights=step[window]) for window in inside)
    return float(fore - rear)
