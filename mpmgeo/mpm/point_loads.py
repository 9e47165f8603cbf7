"""Forces on single nodes, added to the tiles after the particles' forces."""

import numpy as np

from mpmgeo.numerics.simd import LANES
from mpmgeo.state.grid import SIDE, keys_of

MASS, FORCE = 0, slice(4, 7)


class PointLoads:
    """Constant forces (k, 3) [N] on the nodes of index (k, 3)."""

    def __init__(self, node, force):
        self.node = np.asarray(node, np.int64)
        self.force = np.asarray(force, float)
        self._keys = None

    def _find(self, grid):
        """Find a tile that covers each node, and the node's record in it."""
        corner = self.node // SIDE
        self._keys = grid.keys
        self._owner = np.full(len(self.node), -1)
        self._at = np.zeros(len(self.node), np.int64)
        for index, key in enumerate(keys_of(corner)):
            block = np.searchsorted(grid.active, key)
            if block == len(grid.active) or grid.active[block] != key:
                continue
            for owner in grid.below[block]:
                local = self.node[index] - grid.corner[owner] * SIDE
                if owner >= 0 and (local < grid.side).all():
                    record = (local[0] * grid.side + local[1]) * grid.side + local[2]
                    self._owner[index] = owner
                    self._at[index] = owner * grid.record + record * LANES
                    break

    def apply(self, grid):
        """Add the forces to the tiles; one on a node that no tile covers does nothing."""
        if self._keys is not grid.keys:
            self._find(grid)
        records = grid.tiles.reshape(-1, LANES)
        covered = self._owner >= 0
        np.add.at(records[:, FORCE], self._at[covered] // LANES, self.force[covered])

    def idle(self, grid):
        """Return which loads (k,) act on a node without mass, and so on nothing."""
        mass = np.zeros(len(self.node))
        records, keys = grid.records(), keys_of(self.node // SIDE)
        for index, (key, inner) in enumerate(zip(keys, self.node % SIDE, strict=True)):
            block = np.searchsorted(grid.active, key)
            if block < len(grid.active) and grid.active[block] == key:
                n = (inner[0] * SIDE + inner[1]) * SIDE + inner[2]
                mass[index] = records[block, n, 6]
        return mass == 0.0
