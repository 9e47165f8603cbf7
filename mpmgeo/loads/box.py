"""A force shared by the particles in a box."""

from dataclasses import dataclass

import numpy as np

from mpmgeo.parameters import Vector, parameter
from mpmgeo.region import Box


@dataclass(frozen=True)
class BoxLoad(Box):
    """A constant total force, shared equally by the particles that start inside a closed box."""

    load: Vector = parameter("Total force", unit="N")

    def particle_force(self, position: np.ndarray) -> np.ndarray:
        """Return the force (n, 3) [N] on particles that start at `position` (n, 3) [m].

        Without a particle in the box all forces are zero.
        """
        inside = self.contains(position)
        share = np.array(self.load) / max(np.count_nonzero(inside), 1)
        return inside[:, None] * share
