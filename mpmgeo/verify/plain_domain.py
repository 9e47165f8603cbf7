"""The plain solver of particles that follow their domains: eight corners, a matrix that deforms.

    x ← x + Δt ⅛ Σ U(x_c),    B ← A B Aᵀ,  A = I + Δt L,    l = √diag B

Source: that of `mpmgeo/mpm/core/domain.py`.
"""

from math import floor

import numpy as np

from mpmgeo.mpm.core.domain import MOST
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.shapes.shape import width
from mpmgeo.verify.plain import PlainSolver
from mpmgeo.verify.plain_transfers import slopes, stencil_along


@inlined
def interpolated(box, U, g, c):
    """Return component c of the nodal field U at the place g, in cells, by hats."""
    i, j, k = floor(g[0]), floor(g[1]), floor(g[2])
    x, y, z = g[0] - i, g[1] - j, g[2] - k
    value = 0.0
    for a in range(2):
        for b in range(2):
            for d in range(2):
                w = (x if a else 1.0 - x) * (y if b else 1.0 - y) * (z if d else 1.0 - z)
                value += w * U[i + a + box.ghosts, j + b + box.ghosts, k + d + box.ghosts, c]
    return value


@compiled
def follow(shape, box, rows, half, x, A, U, dt):
    """Move particles with their corners; add Δt L, in cells, to their A (n, 3, 3)."""
    S = width(shape)
    way = np.empty(3)
    for p in rows:
        I, wx = stencil_along(0, shape, box, half, x, p)
        J, wy = stencil_along(1, shape, box, half, x, p)
        K, wz = stencil_along(2, shape, box, half, x, p)
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    G = slopes(wx, wy, wz, i, j, k, box.cell)
                    for a in range(3):
                        for b in range(3):
                            u = U[I + i, J + j, K + k, a] / box.cell[a]
                            A[p, a, b] += dt * u * G[b] * box.cell[b]
        way[:] = 0.0
        g = x[p, 0] / box.cell[0], x[p, 1] / box.cell[1], x[p, 2] / box.cell[2]
        for a in (-1.0, 1.0):
            for b in (-1.0, 1.0):
                for d in (-1.0, 1.0):
                    at = g[0] + a * half[p, 0], g[1] + b * half[p, 1], g[2] + d * half[p, 2]
                    for c in range(3):
                        way[c] += 0.125 * dt * interpolated(box, U, at, c)
        for c in range(3):
            x[p, c] += way[c]


class FollowingSolver(PlainSolver):
    """A copy of the state of a solver with domains that steps on by itself; see `PlainSolver`."""

    EFFECTS = ("domains",)

    def _copy(self, solver):
        super()._copy(solver)
        self.domain, self.least = np.zeros((solver.count, 3, 3)), np.zeros((solver.count, 3))
        for s in solver.sets:
            self.domain[s.row] = s.domain[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
            self.least[s.row] = s.least

    def step(self):
        """Advance by one time step, with the sizes that particles have at its start."""
        super().step()
        root = np.sqrt(np.diagonal(self.domain, axis1=1, axis2=2))
        self.half[self.active] = np.clip(root, self.least, MOST)[self.active]

    def _gather(self, h, A, drift, strains=False):
        super()._gather(h, A, None, strains)
        if strains:
            A = np.tile(np.eye(3), (len(self.x), 1, 1))
            for *_, rows in self.sets:
                follow(self.shape, self.box, rows, self.half, self.x, A, self.U, self.time_step)
            self.domain = A @ self.domain @ A.transpose(0, 2, 1)
