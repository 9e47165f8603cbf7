"""The stages of a step, of which the schemes are made.

A stage does its own work for all particles or nodes, and lets the effects do theirs.
"""

import numba

from mpmgeo.mpm.core.loops import over_nodes, over_particles
from mpmgeo.mpm.core.newmark import Correct, Predict
from mpmgeo.mpm.core.transfer import Force, Gather, Remap, Scatter, Strain, StrainAndForce
from mpmgeo.numerics.chunks import ALONE, crew_of


class Loops:
    """Loops over the particles and nodes of a `grid`, with a `shape`; `small`: without threads."""

    @property
    def crew(self):
        """Return who runs the loops: threads, if it pays; their number never changes results."""
        return ALONE if self.small else crew_of(numba.get_num_threads())

    def over_particles(self, work, s, arrays, tiles=None, nodes=None, fresh=False):
        """Visit the particles of set `s` with a work that fills `tiles` and reads `nodes`."""
        grid = self.grid
        return over_particles(
            self.crew,
            work,
            self.shape,
            grid.frame,
            s.place,
            s.half,
            s.x,
            None if nodes is None else (nodes, grid.above),
            grid.scratch,
            tiles or (grid.solid.tiles,),
            fresh,
            arrays,
        )

    def over_nodes(self, task):
        """Visit all nodes."""
        grid = self.grid
        work, tiles, scratch, arrays = task
        place = (grid.chunk, grid.active_corner, grid.below)
        over_nodes(self.crew, work, self.shape, grid.frame, place, tiles, scratch, arrays)


class Stages(Loops):
    """What a solver does in a step; its state is that of `Solver`."""

    def scatter(self, internal=True):
        """Fill the tiles with mass, momentum and external force, and the internal one if asked."""
        fresh = True
        for s in self.sets:
            work = Scatter(self.gravity, 0.0 if s.tool is None else 1.0)
            stress, pressure = (s.stress, s.pressure) if internal else (None, None)
            means = self.mean_stresses(s) if internal else None
            arrays = (s.v, s.C, s.m, s.V, stress, pressure, s.force, means)
            self.over_particles(work, s, arrays, None, None, fresh)
            fresh = False
        self.clock.lap("scatter")

    def predict(self, ahead):
        """Fill the tiles with mass, momentum as it would be `ahead` [s] and external force."""
        for number, s in enumerate(self.sets):
            work = Predict(self.gravity, 0.0 if s.tool is None else 1.0, ahead)
            self.over_particles(work, s, (s.v, s.a, s.m, s.force), fresh=number == 0)
        self.clock.lap("scatter")

    def update_momentum(self, h):
        """Integrate the nodal momentum over h."""
        task = self.nodal.momentum(self, h)
        for act in self.asked["before_nodes"]:
            act(self, task)
        self.over_nodes(task)
        self.clock.lap("grid update")
        for act in self.asked["after_nodes"]:
            act(self, h)

    def update_velocity(self, after):
        """Make nodal velocities of the momentum in the tiles, `after` the step or before it."""
        self.over_nodes(self.nodal.velocity(self, after))
        self.clock.lap("grid update")

    def gather(self, h, stress=True):
        """Move the particles; change velocities by h times the acceleration unless h is None."""
        for act in self.asked["before_gather"]:
            act(self, h)
        nodes, step = self.grid.nodes, 0.0 if h is None else h
        for s in self.sets:
            law = s.law if stress else None
            work = Gather(law, s.rotation, self.time_step, step, self.transfer)
            means = self.mean_divergences(s) if stress else None
            v, C = (None, None) if h is None else (s.v, s.C)
            arrays = (v, C, s.material, s.follower, means)
            self.gone += self.over_particles(work, s, arrays, None, nodes)
        self.clock.lap("gather")
        for act in self.asked["after_gather"]:
            self.gone += act(self)

    def remap(self, h):
        """Change velocities by h times the acceleration, put the new momentum into the tiles."""
        grid = self.grid
        for number, s in enumerate(self.sets):
            arrays, fresh, work = (s.v, s.C, s.m), number == 0, Remap(h, self.transfer)
            self.over_particles(work, s, arrays, (grid.tiles,), grid.nodes, fresh)
        self.clock.lap("remap")
        for act in self.asked["after_remap"]:
            act(self, h)

    def correct(self, h, old, new, further):
        """Move particles by h v + `further` a, change velocities by `old` a + `new` a.

        v and the new a are those of the nodes, the old a those that the particles had.
        """
        for act in self.asked["before_gather"]:
            act(self, h)
        for s in self.sets:
            work = Correct(h, old, new, further)
            self.gone += self.over_particles(work, s, (s.v, s.a), None, self.grid.nodes)
        self.clock.lap("gather")
        for act in self.asked["after_gather"]:
            self.gone += act(self)

    @property
    def strain_step(self):
        """Return over which step strains come [s] that come before forces.

        Velocities of particles are those of the step before, and so are these strains, unless the
        velocities are predicted; in the first step there is none before.
        """
        return self.time_step if self.is_whole or self.steps == 0 else self.previous

    def strain_and_force(self):
        """Update stress with the nodal velocities, add the internal force to the tiles."""
        tiles, nodes, dt = (self.grid.tiles,), self.grid.nodes, self.strain_step
        for s in self.sets:
            if self.cells is None:
                work = StrainAndForce(s.law, s.rotation, dt)
                self.over_particles(work, s, (s.pressure, s.material), tiles, nodes)
                continue
            work = Strain(s.law, s.rotation, dt)
            self.over_particles(work, s, (s.material, self.mean_divergences(s)), None, nodes)
            arrays = (s.V, s.stress, s.pressure, self.mean_stresses(s))
            self.over_particles(Force(), s, arrays, tiles)
        self.clock.lap("strain and force")

    def mean_stresses(self, s):
        """Return the mean stresses of cells for set `s`, None if its particles share nothing."""
        return None if self.cells is None else self.cells.of_stress(self, s)

    def mean_divergences(self, s):
        """Return the mean divergences of cells for set `s`, None if its particles share nothing."""
        return None if self.cells is None else self.cells.of_divergence(self, s)
