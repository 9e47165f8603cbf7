"""A ball."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Filled
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.lattice import Lattice
from mpmgeo.parameters import Vector, parameter


@dataclass(frozen=True)
class Sphere(Filled):
    """A ball: the particles of the surrounding box of cells whose centres lie inside."""

    type: ClassVar[str] = "sphere"

    center: Vector = parameter("Centre of the ball", unit="m", place=True)
    diameter: float = parameter("Diameter of the ball", unit="m", above=0)

    def lattice(self, cell: np.ndarray) -> Lattice:
        """Return the candidate positions; raises ValueError if there are too many."""
        start = [c - self.diameter / 2 for c in self.center]
        extent, per_cell = np.full(3, self.diameter), self.particles_per_direction
        return Lattice.over(start, extent, cell, per_cell, self.zero)

    def holds(self, position: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in the ball."""
        return np.linalg.norm(position - self.center, axis=1) < self.diameter / 2

    def generate(self, cell: np.ndarray) -> Cloud:
        """Return the particles at most one radius from the centre; `cell` (3,) is in m."""
        lattice = self.lattice(cell)
        x, y, z = (
            (axis - c) / (self.diameter / 2)
            for axis, c in zip(lattice.coordinates(), self.center, strict=True)
        )
        return lattice.cloud(
            fastest="z", keep=x**2 + y**2 + z**2 <= 1, notes=self._notes(lattice.surplus())
        )

    def _notes(self, surplus):
        if not surplus:
            return []
        return [
            f"the diameter, {self.diameter:g} m, is not a multiple of the cell: "
            "the particles are not symmetric about the centre"
        ]
