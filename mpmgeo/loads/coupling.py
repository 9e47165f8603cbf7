"""One-way coupling: pore pressures that a file gives at points act on the particles near them.

    σ = σ′ − p I

in the internal force; the material law knows the effective stress σ′ alone.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, NamedTuple

import numpy as np

from mpmgeo.action import Action
from mpmgeo.listed import position_problem, read_entries
from mpmgeo.numerics.fit import linear_fit
from mpmgeo.numerics.neighbours import Neighbours
from mpmgeo.parameters import Placed, parameter
from mpmgeo.values import is_number, shown

RADII = {"nearest": 0.5, "linear": 1.5}
"""Radius of the search in mean cell sizes where none is given."""


class Points(NamedTuple):
    """Points of a file in its order: position (m, 3) [m], pressure (m,) [Pa]."""

    position: np.ndarray
    pressure: np.ndarray


class Pressures(NamedTuple):
    """Pressure (n,) [Pa] of the particles, 0 where none is known, and which particles and points
    have found each other: known (n,), matched (m,)."""

    pressure: np.ndarray
    known: np.ndarray
    matched: np.ndarray


@dataclass(frozen=True)
class HydroMechanicalCoupling(Action, Placed):
    """Pore pressures that a file gives at points and that the particles keep for the whole run."""

    key: ClassVar[str] = "hydro_mechanical_coupling"
    about: ClassVar[str] = "Pore pressures from a file"
    is_several: ClassVar[bool] = False
    switch: ClassVar[str | None] = "enabled"
    one_phase_only: ClassVar[str] = "pressures from a file and two phases exclude each other"

    enabled: bool = parameter("Whether the pore pressures act", default=False)
    kind: str = parameter(
        "Kind of coupling: the pressures act on the particles and do not change",
        key="type",
        choices=("one_way",),
        default="one_way",
    )
    pore_pressure_field: Path | None = parameter(
        "JSON list of objects with `position` [m] and `pressure` [Pa], compression positive",
        file=True,
        default=None,
    )
    interpolation: str = parameter(
        "Value of a particle: that of the nearest point, or a linear fit to all in the radius",
        choices=tuple(RADII),
        default="nearest",
    )
    radius: float | None = parameter(
        "Distance below which points count; absent: 0.5 (nearest) or 1.5 (linear) mean cell sizes",
        unit="m",
        above=0,
        default=None,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the coupling acts without a file."""
        if self.enabled and self.pore_pressure_field is None:
            yield "pore_pressure_field", "is required when enabled is true"

    def complaints(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the file cannot be used."""
        try:
            _ = self.points if self.enabled else None
        except ValueError as error:
            yield "pore_pressure_field", str(error)

    @cached_property
    def points(self) -> Points:
        """Return the points of the file; raises ValueError if it cannot be used."""
        needs = 'a list of objects with "position" and "pressure"'
        entries = read_entries(self.pore_pressure_field, needs, _problem)
        if not entries:
            raise ValueError(f"{self.pore_pressure_field}: the list is empty")
        return Points(
            np.array([entry["position"] for entry in entries], float) - self.zero,
            np.array([entry["pressure"] for entry in entries], float),
        )

    def pressures(self, position: np.ndarray, cell: float, last: bool = False) -> Pressures:
        """Return the pressures of particles at `position` (n, 3) [m]; `cell`: mean cell size [m].

        `last`: the last point of the file within the radius counts, as in MPM-Geomechanics, not
        the nearest. Of points at the same distance the last one counts.
        """
        points = self.points
        value = np.zeros(len(position))
        known, matched = np.zeros(len(position), bool), np.zeros(len(points.pressure), bool)
        radius = self.radius or RADII[self.interpolation] * cell
        for place, point, distance in Neighbours(points.position, radius).pairs(position):
            matched[point] = True
            if self.interpolation == "linear":
                at, group = np.unique(place, return_inverse=True)
                value[at] = _fitted(position[at], group, points, point, 1 - distance / radius)
            else:
                order = np.lexsort((-point, 0 * distance if last else distance, place))
                at, first = np.unique(place[order], return_index=True)
                value[at] = points.pressure[point[order][first]]
            known[at] = True
        return Pressures(value, known, matched)


def _fitted(x, group, points, point, weight):
    """Return the linear fit at places x (n, 3), within the values of the points that count."""
    pressure = points.pressure[point]
    fit = linear_fit(x, group, points.position[point], weight, pressure)
    low, high = np.full(len(x), np.inf), np.full(len(x), -np.inf)
    np.minimum.at(low, group, pressure)
    np.maximum.at(high, group, pressure)
    return np.clip(fit, low, high)


def _problem(entry):
    if message := position_problem(entry):
        return message
    if "pressure" not in entry:
        return '"pressure" is missing'
    if not is_number(entry["pressure"]):
        return f'"pressure" needs a finite number, has {shown(entry["pressure"])}'
    return None
