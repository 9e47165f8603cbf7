"""A force on one node of the grid."""

from dataclasses import dataclass

import numpy as np

from mpmgeo.naming import GHOSTS
from mpmgeo.parameters import Vector, parameter

ROUND_OFF = 1e-9


@dataclass(frozen=True)
class PointLoad:
    """A constant force on the node nearest to a point."""

    position: Vector = parameter("Point whose nearest node carries the force", unit="m")
    force: Vector = parameter("Force", unit="N")

    def node(self, origin: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Return the index (3,) of the nearest node, counted with two ghost layers.

        `origin` (3,) is the lower corner of the mesh [m], `cell` (3,) the size of its cells [m];
        halfway between two nodes the upper one is taken.
        """
        distance = (np.array(self.position) - origin) / cell
        return np.floor(distance + 0.5 + ROUND_OFF).astype(np.int64) + GHOSTS
