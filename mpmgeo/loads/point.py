"""A force on one node of the grid."""

from dataclasses import dataclass

import numpy as np

from mpmgeo.parameters import Placed, Vector, parameter
from mpmgeo.positions import resolution

GHOSTS = 2
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class PointLoad(Placed):
    """A constant force on the node nearest to a point."""

    position: Vector = parameter("Point whose nearest node carries the force", unit="m", place=True)
    force: Vector = parameter("Force", unit="N")

    def node(self, cell: np.ndarray) -> np.ndarray:
        """Return the index (3,) of the nearest node, counted with two ghost layers.

        The position is that in the mesh, `cell` (3,) the size of its cells [m]; halfway between two
        nodes the upper one is taken.
        """
        slack = np.maximum(ROUND_OFF, resolution(self.zero, self.position) / cell)
        return np.floor(np.array(self.position) / cell + 0.5 + slack).astype(np.int64) + GHOSTS
