"""Contact of all particle sets with the ground, as stages of a step."""

import numpy as np

from mpmgeo.boundaries.distance import distances
from mpmgeo.mpm import press, touch, touch_legacy
from mpmgeo.mpm.density import density_at, nodal_density
from mpmgeo.mpm.ground import NearGround
from mpmgeo.numerics.triangle_tree import FACE
from mpmgeo.state.grid import CHUNKS, NODES

LIGHT = 1e-6  # share of a particle's mass
CAUTION = 2.0  # for what contact does to the speeds, and for bends of the ground


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
        self.way = 0.0  # that nodes near the ground have moved at most, relative to it [m]
        self._some = np.empty(0, np.int64)
        self._mass = self._part = np.empty(0)
        self._impulse = np.empty((0, 3))
        self._speed = np.zeros(CHUNKS)
        self._lightest = None

    def act(self, solver, h):
        """Find what touches and change the nodes' velocities and accelerations."""
        self._arrange(solver)
        if len(self.near.near) and self._detect(solver):
            self._press(solver, h)
        solver.clock.lap("contact")

    def _detect(self, solver):
        """Find what touches; return whether there is anything."""
        near, grid, symbols = self.near, solver.grid, self.symbols
        dt, motion = solver.time_step, solver.motion.after
        offset = self.offset if any(self.offset) else None
        sets = _free(solver)
        place, around = (near.chunk, near.near), (near.nodes_chunk, near.active)
        self._run(
            solver, press.fastest, *around, grid.nodes, self._least(sets), motion, self._speed
        )
        step = CAUTION * dt * float(self._speed.max())
        for number, s in enumerate(sets):
            solver.run_kernel(
                touch.detect,
                *(symbols, number == 0, self.way, step, dt, offset, motion, near.shift),
                *(near.level, *place, s.start, grid.corner, grid.above, grid.nodes),
                *(grid.scratch, s.half, s.x, s.m, s.due, s.contact, self._mass, self._some),
            )
        self.way += step
        return self._some.any()

    def _press(self, solver, h):
        """Give the nodes the impulses of what touches."""
        near, grid, symbols = self.near, solver.grid, self.symbols
        dt, sets = solver.time_step, _free(solver)
        place, around = (near.chunk, near.near), (near.nodes_chunk, near.active)
        tiles = (near.below, self._some, self._mass)
        self._run(solver, press.share, solver.shape, *around, *tiles, grid.nodes, self._part)
        for number, s in enumerate(sets):
            solver.run_kernel(
                press.press,
                *(symbols, number == 0, h, dt, *place, near.around, s.start, grid.corner),
                *(s.half, s.x, s.m, s.due, s.contact, self._some, self._part, grid.scratch),
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
        self.follow(solver.motion, solver.time_step)
        if self._some.any():
            for s in _free(solver):
                gone += solver.run_kernel(
                    press.move_out,
                    *(near.chunk, near.near, s.start, solver.grid.corner, s.x),
                    *(s.due, s.contact, self._some),
                )
        solver.clock.lap("contact")
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

    def forget(self, solver):
        """Let particles that are not near the ground be looked at as soon as they come near."""
        near = self.near
        near.arrange(solver.grid, self.offset, solver.small)
        tile = solver.grid.side**3
        self._some = np.zeros(len(near.near), np.int64)
        if len(self._mass) != len(near.near) * tile:
            self._mass = np.empty(len(near.near) * tile)
            self._impulse = np.empty((len(near.near) * tile, 3))
        if len(self._part) != len(near.active) * NODES:
            self._part = np.empty(len(near.active) * NODES)
        is_near = np.zeros(len(solver.grid.keys), bool)
        is_near[near.near] = True
        for s in _free(solver):
            far = np.flatnonzero(~np.repeat(is_near, np.diff(s.start)) & (s.due[: s.active] != 0))
            s.due[far] = 0.0
            s.contact[far] = 0.0
            s.due[s.active :] = s.contact[s.active :] = 0.0

    def _arrange(self, solver):
        """Find the blocks near the ground if it has moved since the last sort."""
        if self.near.is_old(solver.grid, self.offset):
            self.forget(solver)

    def _least(self, sets):
        """Return the mass [kg] from which on a node's speed says something about particles."""
        if self._lightest is None:
            self._lightest = min((float(s.m.min()) for s in sets), default=0.0)
        return LIGHT * self._lightest

    @staticmethod
    def _run(solver, kernel, *arguments):
        (kernel.serial if solver.small else kernel)(*arguments)


class ContactAsMPMGeomechanics(Contact):
    """Contact at a distance, on particles alone, with a ground that stays where it is."""

    def act(self, solver, h):
        """Change the velocities of particles that approach the ground."""
        self._arrange(solver)
        near, grid = self.near, solver.grid
        for s in _free(solver) if len(near.near) else ():
            solver.run_kernel(
                touch_legacy.impel,
                *(self.symbols, self.ground, h, solver.time_step, solver.motion.after),
                *(near.level, near.chunk, near.near, s.start, grid.corner, grid.above),
                *(grid.nodes, grid.scratch, s.half, s.x, s.v, s.m, s.due, s.contact),
                self._some,
            )
        solver.clock.lap("contact")

    def follow(self, motion, dt):
        """Do nothing: only the velocity of the ground counts."""


def _free(solver):
    """Return the particle sets whose velocity nothing prescribes."""
    return [s for s in solver.sets if s.tool is None]
