"""Contact of all particle sets with the ground, as a part of a step."""

import numpy as np

from mpmgeo.boundaries.distance import distances
from mpmgeo.effect import Effect
from mpmgeo.mpm.core.loops import over_nodes, over_particles
from mpmgeo.mpm.terrain.density import NOTHING, nodal_density
from mpmgeo.mpm.terrain.ground import NearGround
from mpmgeo.mpm.terrain.press import Fastest, MoveOut, Part, Press, Push
from mpmgeo.mpm.terrain.touch import COLUMNS, TOUCHING, Detect
from mpmgeo.mpm.terrain.touch_legacy import LEVEL, Impel
from mpmgeo.numerics.chunks import ALONE, CHUNKS
from mpmgeo.numerics.triangle_tree import DEPTH, FACE
from mpmgeo.state.checked import demand, number_from, vector_from

LIGHT = 1e-6  # share of a particle's mass
FARTHEST = 1e6  # cells by which a ground may move; beyond, blocks have no names
CAUTION = 2.0  # for what contact does to the speeds, and for bends of the ground


class Contact(Effect):
    """Contact with a ground that may move: changes the nodes, then the positions.

    `symbols`: μ, k and D; `surface`, `ground`: in coordinates of the mesh, where they lie at the
    start; `offset` (3,) [m]: how far the ground has moved since, the same in any coordinates.
    """

    name = "ground"
    columns = COLUMNS  # of the particles' arrays of contact

    def __init__(self, symbols, surface, ground, mesh, width):
        self.symbols = symbols
        self.surface = surface
        self.ground = ground
        self.near = NearGround(ground, mesh, width, symbols.D)
        self.offset = (0.0, 0.0, 0.0)
        self.way = 0.0  # that nodes near the ground have moved at most, relative to it [m]

    def join(self, solver):
        """Look at the particles that can touch the ground: no velocity of theirs is prescribed."""
        self.sets = [s for s in solver.sets if s.tool is None]
        self.least = LIGHT * min((float(s.m.min()) for s in self.sets), default=0.0)
        self.places = []

    def after_nodes(self, solver, h):
        """Find what touches and change the nodes' velocities and accelerations."""
        self._arrange(solver)
        if len(self.near.near) and self._detect(solver):
            of_node, before = solver.grid.solid.at_nodes, None
            if solver.ledger is not None:
                before = of_node("acceleration").copy()
            self._press(solver, h)
            if before is not None:
                m, v, a = map(of_node, ("mass", "velocity", "acceleration"))
                power = m * ((a - before) * (v - 0.5 * h * a)).sum(axis=1)
                solver.ledger.put_in(h * float(power.sum()))
        solver.clock.lap("contact")

    def _detect(self, solver):
        """Find what touches; return whether there is anything."""
        near, grid, dt = self.near, solver.grid, solver.time_step
        motion = solver.motion.after
        square = np.zeros(len(near.active))
        self._over_nodes(solver, Fastest(self.least, motion), (grid.nodes, near.active, square))
        step = CAUTION * dt * float(square.max() ** 0.5)
        offset = self.offset if any(self.offset) else None
        work = Detect(self.symbols, self.way, step, 1.0 / dt, offset, motion, near.shift)
        near.touched[:] = 0
        nodes = grid.nodes, near.above
        for number, s in enumerate(self.sets):
            arrays = (near.level, s.m, s.due, s.contact, near.touched)
            self._over_particles(solver, work, number, arrays, nodes)
        self.way += step
        return near.touched.any()

    def _press(self, solver, h):
        """Give the nodes the impulses of what touches."""
        near, grid = self.near, solver.grid
        around = (grid.nodes, near.active, near.gather_touched())
        self._over_nodes(solver, Part(), around, is_sum=True)
        nodes = grid.nodes, near.above
        work = Press(self.symbols, h, 1.0 / solver.time_step)
        for number, s in enumerate(self.sets):
            arrays = (s.m, s.due, s.contact, near.touched)
            self._over_particles(solver, work, number, arrays, nodes)
        driven, of_driven = solver.driven
        work = Push(solver.planes, driven, h)
        self._over_nodes(solver, work, (*around, of_driven), is_sum=True)

    def after_gather(self, solver):
        """Move overlapping particles out; return how many are then outside their block."""
        near, gone = self.near, 0
        self.follow(solver.motion, solver.time_step)
        if near.touched.any():
            before = self._potential(solver)
            for number, s in enumerate(self.sets):
                arrays = (s.due, s.contact, near.touched)
                gone += self._over_particles(solver, MoveOut(), number, arrays)
            if solver.ledger is not None:
                solver.ledger.put_in(before - self._potential(solver))
        solver.clock.lap("contact")
        return gone

    def _potential(self, solver):
        """Return the work of the constant forces [J] if a ledger asks: who moves out is lifted."""
        return 0.0 if solver.ledger is None else float(solver.tally().potential.sum())

    def _over_particles(self, solver, work, number, arrays, nodes=None):
        """Visit the particles of a set in the blocks near the ground."""
        s = self.sets[number]
        return over_particles(
            *(solver.crew, work, solver.shape, solver.grid.frame, self.places[number]),
            *(s.half, s.x, nodes, solver.grid.scratch, (self.near.field.tiles,), False, arrays),
        )

    def _over_nodes(self, solver, work, arrays, is_sum=False):
        """Visit the nodes near the ground, the tiles that are touched summed before if asked."""
        near = self.near
        tiles = (near.field.tiles,) if is_sum else None
        place = near.nodes_chunk, near.nodes_corner, near.below
        over_nodes(
            *(solver.crew, work, solver.shape, solver.grid.frame, place),
            *(tiles, solver.grid.scratch, arrays),
        )

    def follow(self, motion, dt):
        """Let the ground move for a step of the base, as far as blocks have names."""
        far = [FARTHEST * h for h in self.near.cell]
        moved = (u + dt * v for u, v in zip(self.offset, motion.after, strict=True))
        self.offset = tuple(max(-f, min(f, u)) for f, u in zip(far, moved, strict=True))

    def distance(self, x):
        """Return the signed distances (n,) [m] of points (n, 3) [m] to the ground as it lies.

        The points are in coordinates of the mesh.
        """
        out = np.empty(len(x))
        distances(ALONE, self.ground, np.ascontiguousarray(x) - self.offset, out)
        return out

    def level(self, s, at):
        """Return the signed distances (n,) [m] of the particles `at` of a set, as files have it."""
        return self.distance(s.x[at])

    def density(self, solver):
        """Return node indices (n, 3), and the share (n,) of their volume that particles fill."""
        density = self._filled(solver)
        return density.indices().reshape(-1, 3), density.values.ravel()

    def density_at(self, solver, x):
        """Return that share (n,) at points (n, 3) [m] in coordinates of the mesh."""
        return self._filled(solver).at(solver.grid.mesh, x)

    def _filled(self, solver):
        return nodal_density(solver)

    def triangles(self):
        """Return centres (n, 3) [m] and normals (n, 3) of the triangles as they lie.

        The centres are in coordinates of the mesh.
        """
        corner, normal, _, _ = self.surface
        return corner.mean(axis=1) + self.offset, normal[:, FACE]

    def after_sort(self, solver):
        """Let particles that are not near the ground be looked at as soon as they come near."""
        near, grid = self.near, solver.grid
        near.arrange(grid, self.offset, solver.crew)
        near.touched[:] = 0
        self.places = [near.place(s) for s in self.sets]
        is_near = np.zeros(len(grid.keys), bool)
        is_near[near.near] = True
        for s in self.sets:
            far = np.flatnonzero(~np.repeat(is_near, np.diff(s.start)) & (s.due[: s.active] != 0))
            s.due[far] = 0.0
            s.contact[far] = 0.0
            s.due[s.active :] = s.contact[s.active :] = 0.0

    def _arrange(self, solver):
        """Find the blocks near the ground if it has moved since the last sort."""
        if self.near.is_old(solver.grid, self.offset):
            self.after_sort(solver)

    def held(self):
        """Return how far the ground and the nodes near it have moved."""
        return {"offset": self.offset, "way": self.way}

    def take(self, state):
        """Go on with what `held` once returned."""
        offset, self.way = vector_from(state, "offset"), number_from(state, "way", least=0.0)
        far = max(abs(u) / h for u, h in zip(offset, self.near.cell, strict=True))
        demand(far <= FARTHEST, f"offset moves the ground by {far:.3g} cells")
        self.offset = offset


class ContactAsMPMGeomechanics(Contact):
    """Contact at a distance, on particles alone, with a ground that stays where it is.

    `keeps_density`: whether files want the density, which is that at the beginning of a step.
    """

    columns = LEVEL + 1
    keeps_density = False
    _density = None

    def after_nodes(self, solver, h):
        """Change the velocities of particles that approach the ground."""
        if self.keeps_density:
            self._density = nodal_density(solver)
        self._arrange(solver)
        near, grid = self.near, solver.grid
        near.touched[:] = 1
        work = Impel(self.symbols, h, solver.time_step, solver.motion.after)
        waiting, last = np.empty((CHUNKS, DEPTH), np.int64), np.zeros(CHUNKS, np.int64)
        nodes = grid.nodes, near.above
        for number, s in enumerate(self.sets if len(near.near) else ()):
            arrays = (self.ground, near.level, s.v, s.m, s.due, s.contact, waiting, last)
            last[:] = 0
            self._over_particles(solver, work, number, arrays, nodes)
        solver.clock.lap("contact")

    def follow(self, motion, dt):
        """Do nothing: only the velocity of the ground counts."""

    def level(self, s, at):
        """Return the distances (n,) [m] that particles near the ground gathered in the last step.

        Those below it have 0, since they have been put onto it; of the others it is the distance.
        """
        return np.where(s.due[at] == TOUCHING, s.contact[at, LEVEL], self.distance(s.x[at]))

    def _filled(self, solver):
        """Return the density of the last step, none before the first one."""
        if solver.steps == 0:
            return NOTHING
        return nodal_density(solver) if self._density is None else self._density

    def take(self, state):
        """Go on with what `held` once returned; the density of its last step is not known."""
        super().take(state)
        self._density = None
