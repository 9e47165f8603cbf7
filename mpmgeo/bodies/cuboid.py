"""A box with edges along the axes."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Filled
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.lattice import Lattice
from mpmgeo.parameters import Vector, parameter
from mpmgeo.positions import coordinate


@dataclass(frozen=True)
class Cuboid(Filled):
    """A box between two corners, filled with whole cells counted from the lower corner."""

    type: ClassVar[str] = "cuboid"

    point_p1: Vector = parameter("Corner of lowest coordinates", unit="m", place=True)
    point_p2: Vector = parameter("Corner of highest coordinates", unit="m", place=True)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for every axis along which the box is empty."""
        for name, low, high in zip("xyz", self.point_p1, self.point_p2, strict=True):
            if not high > low:
                text = f"{coordinate(high)} and must exceed that of point_p1, {coordinate(low)}"
                yield "point_p2", f"{name} is {text}"

    def lattice(self, cell: np.ndarray) -> Lattice:
        """Return the candidate positions; raises ValueError if there are too many."""
        extent = [high - low for low, high in zip(self.point_p1, self.point_p2, strict=True)]
        per_cell = self.particles_per_direction
        return Lattice.over(self.point_p1, extent, cell, per_cell, self.zero)

    def holds(self, position: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in the box of whole cells."""
        return self.lattice(cell).covers(position)

    def generate(self, cell: np.ndarray) -> Cloud:
        """Return the particles of all cells, which are never clipped; `cell` (3,) is in m."""
        lattice = self.lattice(cell)
        return lattice.cloud(fastest="x", notes=lattice.surplus())
