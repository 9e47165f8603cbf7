"""Another program's step, run beside ours: a module that steps the same block by itself."""

import importlib
import sys

import numpy as np
from scenes import CELL, SOLID, TIME_STEP


class Peer:
    """The stepper of a folder with a module `yardstick`, for a block of `side` cells.

    The module has `block(side, cell)`, `scatter`, `update` and `gather`, and the constants TILE,
    PLANE and SIDE of its grid.
    """

    def __init__(self, folder, side):
        sys.path.insert(0, str(folder))
        self.module = importlib.import_module("yardstick")
        E, ν, density = SOLID["young"], SOLID["poisson"], SOLID["density"]
        self.moduli = E / 3 / (1 - 2 * ν), E / 2 / (1 + ν)
        self.x, self.start, self.corner, self.active, self.above, self.below = self.module.block(
            side, CELL
        )
        n = len(self.x)
        self.v, self.stress, self.force = np.zeros((n, 3)), np.zeros((n, 6)), np.zeros((n, 3))
        self.V, self.density = np.full(n, (CELL / 2) ** 3), np.full(n, density)
        self.m = density * self.V
        self.force[:, 2] = -9.81 * self.m
        m = self.module
        self.tiles = np.zeros((len(self.corner), m.TILE * m.PLANE))
        self.nodes = np.zeros((len(self.active), m.SIDE**3 * 8))

    def step(self):
        """Advance by one time step."""
        size = CELL, CELL / 4
        particles = self.x, self.v
        self.module.scatter(
            *(self.start, self.corner, *particles, self.m, self.V, self.stress, self.force),
            *(*size, self.tiles),
        )
        self.module.update(self.active, self.below, self.tiles, self.nodes, TIME_STEP, 4)
        self.module.gather(
            *(self.start, self.corner, self.above, self.nodes, *particles, self.density),
            *(self.m, self.V, self.stress, *size, TIME_STEP, *self.moduli),
        )
