"""Tools: planes and particles whose velocity is prescribed, and the nodes that they drive.

A node belongs to a tool if it lies on the tool's plane or carries mass of the tool's particles; see
`mpm.core.driven` for what it then does.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.core.driven import Driven
from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.stencils import locate, of_one_node
from mpmgeo.numerics.simd import LANES
from mpmgeo.state.layout import node_under


class Mark(NamedTuple):
    """Give a tool the nodes that its particles carry mass to and that are still free.

    Arrays: m, blocks under the tiles, owner of each node.
    """

    number: int
    cutoff: float


@visit.register(Mark)
def mark(work, here, a, p):
    m, above, owner = a
    first, wx, wy, wz = locate(here, p)
    wx, wy, wz = of_one_node(wx), of_one_node(wy), of_one_node(wz)
    row, n = here.rows, first // LANES
    I, J, K = n // (row[1] * row[2]), n // row[2] % row[1], n % row[2]
    for i in range(len(wx) // 2):
        for j in range(len(wy) // 2):
            for k in range(len(wz) // 2):
                if wx[i] * wy[j] * wz[k] * m[p] > work.cutoff:
                    node = node_under(above, here.b, row, I + i, J + j, K + k)
                    if owner[node] < 0:  # else another tool's; threads write the same
                        owner[node] = work.number
    return 0


class Tools(Effect):
    """Prescribed velocities, each with `at(t)`, that of its three components [m/s], NaN if free.

    `planes`: for each the plane's axis and side (0 lower, 1 upper), or None for particles, which
    are the sets with its number. Where two meet, planes come first, then the order of the list.
    """

    name = "tools"

    def __init__(self, velocities, planes):
        self.velocities = velocities
        self.planes = planes
        start = np.array([velocity.at(0.0) for velocity in velocities], float).reshape(-1, 3)
        self.given = (~np.isnan(start)).astype(float)
        self.before = np.nan_to_num(start)
        self.after = self.before.copy()
        self.owner = np.empty(0, np.int32)
        self._of_planes = self._keys = None

    def begin(self, solver, h):
        """Set the velocities of the step and find the nodes of all tools.

        They are those of the middle of the steps, where the velocities of all particles are.
        """
        self.before[:] = self._at(max(solver.time - 0.5 * solver.previous, 0.0))
        self.after[:] = self._at(solver.time + 0.5 * solver.time_step)
        self._claim(solver)
        solver.driven = Driven(), (self.owner, self.given, self.before, self.after)
        solver.clock.lap(self.name)

    def _at(self, t):
        return np.nan_to_num([velocity.at(t) for velocity in self.velocities])

    def _claim(self, solver):
        grid = solver.grid
        if self._keys is not grid.keys:
            self._keys = grid.keys
            self._of_planes = self._plane_owners(grid)
            self.owner = np.empty_like(self._of_planes)
        self.owner[:] = self._of_planes
        for s in solver.sets:
            if s.tool is not None:
                work = Mark(s.tool, solver.cutoff)
                solver.over_particles(work, s, (s.m, grid.above, self.owner))

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

    def end(self, solver):
        """Give the particles of the tools exactly their velocity."""
        for s in solver.sets:
            if s.tool is not None:
                for axis in np.flatnonzero(self.given[s.tool]):
                    s.v[: s.active, axis] = self.after[s.tool, axis]
                    if s.a is not None:
                        s.a[: s.active, axis] = 0.0  # nothing is to be predicted
                    if s.C is not None:
                        s.C[: s.active, :, axis] = 0.0

    stopped = end

    def restarted(self, solver):
        """Give the particles the velocities of time 0."""
        self.before[:] = self.after[:] = self._at(0.0)
        self.end(solver)

    def keeping(self, walls):
        """Return the planes that particles do not pass: not those that move."""
        return self._with_planes(walls, False)

    def cutting(self, walls):
        """Return the planes at which shapes may end: those that move, too."""
        return self._with_planes(walls, True)

    def _with_planes(self, walls, value):
        own = (axis + 3 * side for axis, side in filter(None, self.planes))
        return walls._replace(**{walls._fields[number]: value for number in own})
