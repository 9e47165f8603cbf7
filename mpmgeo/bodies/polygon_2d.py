"""A prism: a polygon extruded along an axis."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Filled
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.lattice import ROUND_OFF, Lattice
from mpmgeo.bodies.outline import crossing
from mpmgeo.parameters import Vector, parameter
from mpmgeo.positions import mean_edge, resolution


@dataclass(frozen=True)
class Polygon2D(Filled):
    """A polygon in a coordinate plane, extruded along the third axis, filled with cubic cells."""

    type: ClassVar[str] = "polygon_2d"

    points: tuple[Vector, ...] = parameter("Corners of the polygon in order", unit="m", place=True)
    extrude_direction: str = parameter("Axis of the extrusion", choices=("x", "y", "z"))
    extrude_displacement: float = parameter(
        "Length of the extrusion, from the lowest coordinate of the corners upwards",
        unit="m",
        above=0,
    )
    discretization_length: float | None = parameter(
        "Edge of the cubic cells; the mean cell size of the mesh if absent or 0",
        unit="m",
        minimum=0,
        default=None,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the points span no polygon."""
        if len(self.points) < 3:
            yield "points", f"has {len(self.points)} points and needs at least 3"
        elif self._is_flat():
            yield "points", f"enclose no area in the plane across {self.extrude_direction}"

    def remarks(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the outline crosses itself."""
        edges = crossing(self._corners)
        if edges is not None:
            one, other = (
                f"from points[{n}] to points[{(n + 1) % len(self.points)}]" for n in edges
            )
            text = f"the edge {one} crosses the one {other}"
            if self.points[edges[0]] == self.points[edges[1]]:
                text = f"the edge {one} is there once more {other}"
            yield "points", f"{text}; what an outline encloses twice is left empty (even-odd rule)"

    @property
    def fullness(self) -> float:
        """Return about which share of the positions of the lattice becomes particles."""
        h, v = (self._corners - self._corners[0]).T
        area = 0.5 * abs(h @ np.roll(v, -1) - v @ np.roll(h, -1))
        return min(area / np.ptp(self._corners, axis=0).prod(), 1.0)

    def lattice(self, cell: np.ndarray) -> Lattice:
        """Return the candidate positions; raises ValueError if there are too many."""
        edge = self.discretization_length or mean_edge(cell)
        axes = list(zip(*self.points, strict=True))
        extent = [max(axis) - min(axis) for axis in axes]
        extent[self._along] = self.extrude_displacement
        start, per_cell = list(map(min, axes)), self.particles_per_direction
        return Lattice.over(start, extent, 3 * [edge], per_cell, self.zero)

    def holds(self, position: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in the prism."""
        lattice = self.lattice(cell)
        plane = [(self._along + 1) % 3, (self._along + 2) % 3]
        nudge = np.maximum(ROUND_OFF * lattice.cell, self._resolution)[plane]
        inside = contains(self._corners, *position[:, plane].T, nudge=nudge)
        return inside & lattice.covers(position)

    def generate(self, cell: np.ndarray) -> Cloud:
        """Return the particles whose centres lie inside the polygon; `cell` (3,) is in m."""
        lattice = self.lattice(cell)
        horizontal, vertical = (self._along + 1) % 3, (self._along + 2) % 3
        axes = lattice.coordinates()
        inside = contains(
            self._corners,
            axes[horizontal],
            axes[vertical],
            nudge=np.maximum(ROUND_OFF * lattice.cell, self._resolution)[[horizontal, vertical]],
        )
        notes = lattice.surplus(self.extrude_direction) + _oversize(lattice.size, cell)
        return lattice.cloud(fastest="x", keep=inside, notes=notes)

    def _is_flat(self):
        """Tell whether all corners lie on one line in the plane of the polygon."""
        plane = np.delete(np.array(self.points, dtype=np.float64), self._along, axis=1)
        size = np.linalg.svd(plane - plane[0], compute_uv=False)
        return size[1] <= max(ROUND_OFF * size[0], self._resolution.max())

    @property
    def _corners(self):
        """Horizontal and vertical coordinates (m, 2) [m] of the corners."""
        plane = [(self._along + 1) % 3, (self._along + 2) % 3]
        return np.array(self.points, dtype=np.float64)[:, plane]

    @property
    def _resolution(self):
        return resolution(self.zero, self.points)

    @property
    def _along(self):
        return "xyz".index(self.extrude_direction)


def contains(corners, horizontal, vertical, nudge) -> np.ndarray:
    """Tell which points lie in a polygon by counting crossings to their right (even-odd rule).

    `corners` (m, 2) are horizontal and vertical coordinates; the points' coordinates broadcast.
    Left and lower edges belong to the polygon, right and upper ones do not, so that polygons with
    a common edge share no point. `nudge` [m], (2,) or one number, moves the points right and up:
    round-off must not decide on which side of an edge they lie. Source: Shimrat (1962), Algorithm
    112.
    """
    inside = np.zeros(np.broadcast_shapes(horizontal.shape, vertical.shape), dtype=bool)
    right, up = np.broadcast_to(nudge, 2)
    right, up = horizontal + right, vertical + up
    for (h, v), (h_before, v_before) in zip(corners, np.roll(corners, 1, axis=0), strict=True):
        if v != v_before:
            spanned = (v > up) != (v_before > up)
            with np.errstate(over="ignore"):
                share = np.clip((vertical - v) / (v_before - v), 0, 1)
            inside ^= spanned & (right < h + (h_before - h) * share)
    return inside


def _oversize(size, cell):
    if (size <= cell * (1 + ROUND_OFF)).all():
        return []
    return [
        f"the particles, {size.max():g} m wide, are larger than the cells of the mesh: "
        "shape functions reach too few nodes; choose a smaller discretization_length"
    ]
