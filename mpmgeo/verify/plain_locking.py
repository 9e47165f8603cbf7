"""The plain twin of a solver whose particles share volume strain and pressure in each cell.

    θ̄ = Σ V tr L / Σ V,    p̄ = Σ V p / Σ V,    sums over the particles of one set in a cell

Source: as `mpmgeo/mpm/core/locking.py`.
"""

import numpy as np

from mpmgeo.numerics.jit import compiled
from mpmgeo.shapes.shape import width
from mpmgeo.verify.plain import PlainSolver
from mpmgeo.verify.plain_transfers import slopes, stencil_along, vector


@compiled
def divergences(shape, box, rows, half, x, U, θ):
    """Put the divergence of U at the particles into θ."""
    S = width(shape)
    for p in rows:
        I, wx = stencil_along(0, shape, box, half, x, p)
        J, wy = stencil_along(1, shape, box, half, x, p)
        K, wz = stencil_along(2, shape, box, half, x, p)
        θ[p] = 0.0
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    g = slopes(wx, wy, wz, i, j, k, box.cell)
                    u = vector(U, (I + i, J + j, K + k))
                    θ[p] += g[0] * u[0] + g[1] * u[1] + g[2] * u[2]


class PlainSharing(PlainSolver):
    """As `PlainSolver`, with B-bar on cells."""

    def _means(self, rows, value):
        """Return the means over cells (n,) of the `value` (n,) of the particles in `rows`."""
        cell = np.floor(self.x[rows] / self.box.cell).astype(int)
        _, cell = np.unique(cell, axis=0, return_inverse=True)
        V, means = self.V[rows], np.zeros(len(self.V))
        means[rows] = (np.bincount(cell, V * value[rows]) / np.bincount(cell, V))[cell]
        return means

    def _scatter(self, M, P, F):
        """Add mass, momentum and the force of stresses whose mean is that of the cell."""
        given, mean = self.pressure, self.stress[:, :3].mean(axis=1)
        self.pressure = mean - sum(self._means(rows, mean - given) for *_, rows in self.sets)
        super()._scatter(M, P, F)
        self.pressure = given

    def _divergence(self, rows):
        """Return the mean divergences of the cells."""
        θ = np.zeros(len(self.V))
        divergences(self.shape, self.box, rows, self.half, self.x, self.U, θ)
        return self._means(rows, θ)
