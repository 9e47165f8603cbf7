"""A force shared by the particles in a box."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mpmgeo.parameters import Vector, parameter


@dataclass(frozen=True)
class BoxLoad:
    """A constant total force, shared equally by the particles that start inside a closed box."""

    point_p1: Vector = parameter("Corner of lowest coordinates", unit="m")
    point_p2: Vector = parameter("Corner of highest coordinates", unit="m")
    load: Vector = parameter("Total force", unit="N")

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for every axis along which the box is turned round."""
        for name, low, high in zip("xyz", self.point_p1, self.point_p2, strict=True):
            if high < low:
                yield "point_p2", f"{name} is {high:g}, below that of point_p1, {low:g}"

    def contains(self, position: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in the closed box."""
        return ((position >= self.point_p1) & (position <= self.point_p2)).all(axis=1)

    def particle_force(self, position: np.ndarray) -> np.ndarray:
        """Return the force (n, 3) [N] on particles that start at `position` (n, 3) [m].

        Without a particle in the box all forces are zero.
        """
        inside = self.contains(position)
        share = np.array(self.load) / max(np.count_nonzero(inside), 1)
        return inside[:, None] * share
