"""Contact of all particle sets with the ground, as stages of a step."""

import numpy as np

from mpmgeo.boundaries.distance import distances
from mpmgeo.mpm import press, touch, touch_legacy
from mpmgeo.mpm.density import density_at, nodal_density
from mpmgeo.mpm.ground import NearGround
from mpmgeo.numerics.triangle_tree import FACE
from mpmgeo.state.grid import NODES


class Contact:
    """Contact with a ground that may move: `act` changes the nodes, `settle` the positions.

    `symbols`: μ, k and D; `offset` (3,) [m]: how far the ground has moved.
    """

    def __init__(self, symbols, surface, ground, mesh, width):
        self.symbols = symbols
        self.surface = surface
        self.ground = ground
        self.near = NearGround(ground, mesh, width, symbols.D)
        self.offset = (0.0, 0.0, 0.0)
        self._some = np.empty(0, np.int64)

    def act(self, solver, h):
        """Find what touches and change the nodes' velocities and accelerations."""
        near, grid, symbols = self._arranged(solver), solver.grid, self.symbols
        if not len(near.near):
            return
        dt, motion = solver.time_step, solver.motion.after
        offset = self.offset if any(self.offset) else None
        sets = _free(solver)
        place = (near.chunk, near.near)
        for number, s in enumerate(sets):
            solver.run_kernel(
                touch.detect,
                *(symbols, number == 0, dt, offset, motion, near.shift),
                *(near.level, near.lowest, *place, s.start, grid.corner, grid.above, grid.nodes),
                *(grid.scratch, s.half, s.x, s.v, s.m, s.touching, s.contact),
                *(self._mass, self._some),
            )
        if not self._some.any():
            return
        around = (near.nodes_chunk, near.active)
        run = press.share.serial if solver.small else press.share
        run(solver.shape, *around, near.below, self._some, self._mass, grid.nodes, self._part)
        for number, s in enumerate(sets):
            solver.run_kernel(
                press.press,
                *(symbols, number == 0, h, dt, *place, near.around, s.start, grid.corner),
                *(s.half, s.x, s.m, s.touching, s.contact, self._some, self._part, grid.scratch),
                self._impulse,
            )
        tools = solver.tools
        solver.run_kernel(
            press.push,
            *(solver.planes, *((None, None) if tools is None else (tools.owner, tools.given))),
            *(h, *around, grid.active_corner, near.below, self._some, self._impulse),
            *(grid.scratch, grid.nodes),
        )

    def settle(self, solver):
        """Move overlapping particles out; return how many are then outside their block."""
        near, gone = self.near, 0
        if self._some.any():
            for s in _free(solver):
                gone += solver.run_kernel(
                    press.move_out,
                    *(near.chunk, near.near, s.start, solver.grid.corner, s.x),
                    *(s.touching, s.contact, self._some),
                )
        return gone

    def follow(self, motion, dt):
        """Let the ground move for a step of the base."""
        self.offset = tuple(u + dt * v for u, v in zip(self.offset, motion.after, strict=True))

    def distance(self, x):
        """Return the signed distances (n,) [m] of points (n, 3) [m] to the ground as it lies."""
        out = np.empty(len(x))
        distances(self.ground, np.ascontiguousarray(x) - self.offset, out)
        return out

    def density(self, solver):
        """Return the share (blocks, 64) of the nodes' volume that particles fill."""
        return nodal_density(solver)

    def density_at(self, solver, x):
        """Return that share (n,) at points (n, 3) [m]."""
        return density_at(solver, x)

    def triangles(self):
        """Return centres (n, 3) [m] and normals (n, 3) of the triangles as they lie."""
        corner, normal, _, _ = self.surface
        return corner.mean(axis=1) + self.offset, normal[:, FACE]

    def _arranged(self, solver):
        near = self.near
        if near.arrange(solver.grid, self.offset, solver.small):
            tile = solver.grid.side**3
            self._some = np.zeros(len(near.near), np.int64)
            self._mass = np.empty(len(near.near) * tile)
            self._impulse = np.empty((len(near.near) * tile, 3))
            self._part = np.empty(len(near.active) * NODES)
        return near

    def is_near(self, solver, s, at):
        """Return which of the particles `at` of a set are in blocks near the ground."""
        near = self._arranged(solver).near
        rows = np.zeros(len(s.row), bool)
        for b in near:
            rows[s.start[b] : s.start[b + 1]] = True
        return rows[at]


class ContactAsMPMGeomechanics(Contact):
    """Contact at a distance, on particles alone, with a ground that stays where it is."""

    def act(self, solver, h):
        """Change the velocities of particles that approach the ground."""
        near, grid = self._arranged(solver), solver.grid
        for s in _free(solver) if len(near.near) else ():
            solver.run_kernel(
                touch_legacy.impel,
                *(self.symbols, self.ground, h, solver.time_step, solver.motion.after),
                *(near.level, near.lowest, near.chunk, near.near, s.start, grid.corner, grid.above),
                *(grid.nodes, grid.scratch, s.half, s.x, s.v, s.m, s.touching, s.contact),
                self._some,
            )

    def follow(self, motion, dt):
        """Do nothing: only the velocity of the ground counts."""


def _free(solver):
    """Return the particle sets whose velocity nothing prescribes."""
    return [s for s in solver.sets if s.tool is None]
