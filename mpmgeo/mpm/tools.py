"""Tools: planes and particles whose velocity is prescribed, and the nodes that they drive.

A node belongs to a tool if it lies on the tool's plane or carries mass of the tool's particles. In
the prescribed components it then has the tool's velocity V after the step, whatever it carries:

    a = (V' − v)/h,   v = (Σ S m v − m_t V) / (m − m_t),   F = (m V' − Σ S m v)/h − f

a: what the particles beside the tool get, m_t: mass of the tool at the node, V and V': its velocity
before and after, F: the force that the tool exerts, so that momentum is balanced exactly.
"""

import numpy as np
from numba import prange

from mpmgeo.mpm.tile import block_origin, locate
from mpmgeo.numerics.jit import blockwise
from mpmgeo.numerics.simd import LANES
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE


@blockwise
def mark(shape, mesh, number, chunk, start, corner, above, half, x, m, cutoff, owner):
    """Give tool `number` the nodes that its particles carry mass to and that are still free."""
    S = width(shape)
    row = SIDE + S - 1
    reach = (row + SIDE - 1) // SIDE
    for c in prange(len(chunk) - 1):
        for b in range(chunk[c], chunk[c + 1]):
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                first, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                n = first // LANES
                for i in range(S):
                    for j in range(S):
                        for k in range(S):
                            if not wx[i] * wy[j] * wz[k] * m[p] > cutoff:
                                continue
                            I, J, K = n // (row * row) + i, n // row % row + j, n % row + k
                            o = (I // SIDE * reach + J // SIDE) * reach + K // SIDE
                            inner = (I % SIDE * SIDE + J % SIDE) * SIDE + K % SIDE
                            node = above[b, o] * NODES + inner
                            if owner[node] < 0:  # else another tool's; threads write the same
                                owner[node] = number


class Tools:
    """Prescribed velocities, each with `at(t)`, that of its three components [m/s], NaN if free.

    `planes`: for each the plane's axis and side (0 lower, 1 upper), or None for particles, which
    are the sets with its number. Where two meet, planes come first, then the order of the list.
    """

    def __init__(self, velocities, planes):
        self.velocities = velocities
        self.planes = planes
        start = np.array([velocity.at(0.0) for velocity in velocities], float).reshape(-1, 3)
        self.given = (~np.isnan(start)).astype(float)
        self.before = np.nan_to_num(start)
        self.after = self.before.copy()
        self.owner = np.empty(0, np.int32)
        self._of_planes = self._keys = None

    def advance(self, time, dt):
        """Set the velocities for the step from `time` to `time` + dt [s].

        They are those of the middle of the steps, where the velocities of all particles are.
        """
        self.before[:] = self._at(max(time - 0.5 * dt, 0.0))
        self.after[:] = self._at(time + 0.5 * dt)

    def _at(self, t):
        return np.nan_to_num([velocity.at(t) for velocity in self.velocities])

    def claim(self, solver):
        """Find the nodes of all tools for the particles as they are."""
        grid = solver.grid
        if self._keys is not grid.keys:
            self._keys = grid.keys
            self._of_planes = self._plane_owners(grid)
            self.owner = np.empty_like(self._of_planes)
        self.owner[:] = self._of_planes
        for s in solver.sets:
            if s.tool is not None:
                kernel = mark.serial if solver.small else mark
                kernel(
                    *(solver.shape, grid.mesh, s.tool, s.chunk, s.start, grid.corner, grid.above),
                    *(s.half, s.x, s.m, solver.cutoff, self.owner),
                )

    def _plane_owners(self, grid):
        index = grid.indices().reshape(-1, 3)
        owner = np.full(len(index), -1, np.int32)
        last = (grid.mesh.nx, grid.mesh.ny, grid.mesh.nz)
        for number, plane in enumerate(self.planes):
            if plane is not None:
                axis, side = plane
                i = index[:, axis]
                owner[(i >= last[axis] if side else i <= 0) & (owner < 0)] = number
        return owner

    def hold(self, sets):
        """Give the particles of the tools exactly their velocity."""
        for s in sets:
            if s.tool is not None:
                for axis in np.flatnonzero(self.given[s.tool]):
                    s.v[: s.active, axis] = self.after[s.tool, axis]
