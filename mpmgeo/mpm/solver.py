"""The explicit material point method: its state, its stages and the step that joins them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.base_motion import STILL, BaseMotion
from mpmgeo.boundaries.planes import Planes
from mpmgeo.mpm import grid_update, reactions, transfer
from mpmgeo.mpm.contact import Contact
from mpmgeo.mpm.incidents import Departure, Unsound
from mpmgeo.mpm.point_loads import PointLoads
from mpmgeo.mpm.tools import Tools
from mpmgeo.mpm.two_phase import PoreFluid
from mpmgeo.naming import PLANES
from mpmgeo.numerics.clock import Clock
from mpmgeo.state.grid import Grid
from mpmgeo.state.inspection import first_unsound, kinetic_energy
from mpmgeo.state.particles import ParticleSet, Population
from mpmgeo.state.sorting import OPEN, Walls, sort

SMALL = 4096  # particles up to which threads cost more than they save


@dataclass
class Solver:
    """All that a step needs; `step` advances it. SI units.

    `local`, `delayed`: share of local damping, in our form or in that of MPM-Geomechanics; None
    without. `settles`: whether kinetic damping is on. Raises Unsound when particles diverge.
    """

    grid: Grid
    sets: list[ParticleSet]
    population: Population
    shape: NamedTuple
    scheme: Callable
    planes: Planes
    time_step: float
    gravity: tuple
    base: BaseMotion | None = None
    point_loads: PointLoads | None = None
    local: float | None = None
    delayed: float | None = None
    settles: bool = False
    leaky: bool = False  # whether particles may pass planes that hold, as in MPM-Geomechanics
    cutoff: float = 0.0  # [kg] nodal mass up to which forces do not move a node
    tools: Tools | None = None
    fluid: PoreFluid | None = None
    contact: Contact | None = None
    measured: tuple[int, ...] = ()  # intervals of steps at which the reactions are measured

    time: float = 0.0
    steps: int = 0
    departures: list[Departure] = field(default_factory=list)
    clock: Clock = field(default_factory=Clock)

    def __post_init__(self):
        self.count = len(self.population.position)
        self.small = self.count <= SMALL
        self.motion = STILL
        self.reactions = None  # (6 + tools, 3) [N] of planes and tools when last measured
        self.last_energy = 0.0
        self.peak_energy = None  # before kinetic damping stopped the particles, if it is on
        self.gone = self.count  # how many particles are not where the order says
        if self.base is not None:
            self.planes = self.base.planes(self.planes)
        if self.fluid is not None:
            self.fluid.follow(self.base)

    def arrange(self):
        """Sort the particles now if some are not where the order says."""
        if self.gone:
            self._sort()

    # The step

    def step(self):
        """Advance by one time step; the first one changes velocities by half a step."""
        h = 0.5 * self.time_step if self.steps == 0 else self.time_step
        if self.base is not None and not self.base.ended:
            self.motion = self.base.advance(self.time, h)
            if self.base.ended:
                self.planes = self.base.planes_after(self.planes)
        self.clock.begin()
        if self.gone:
            self._sort()
            self.clock.lap("sort")
        if self.tools is not None:
            self.tools.advance(self.time, self.time_step)
            self.tools.claim(self)
            self.clock.lap("tools")
        self.scheme(self, h)
        if self.tools is not None:
            self.tools.hold(self.sets)
        self.steps += 1
        self.time += self.time_step
        if self.settles:
            self._settle()
            self.clock.lap("kinetic damping")

    def kinetic_energy(self) -> float:
        """Return the kinetic energy of the active particles [J]."""
        return sum(kinetic_energy(s, self.small) for s in self.sets)

    def check(self):
        """Raise Unsound if a particle is NaN, infinite or would cross a cell in a step."""
        for s in self.sets:
            p = first_unsound(s, self.speed_limit, self.small)
            if p >= 0:
                self._refuse(s, p)

    @property
    def speed_limit(self) -> float:
        """The speed at which a particle crosses the smallest cell in a step [m/s]."""
        mesh = self.grid.mesh
        return min(mesh.hx, mesh.hy, mesh.hz) / self.time_step

    def _refuse(self, s, p):
        material = int(self.population.material[s.row[p]])
        state = [np.copy(a[p]) for a in (s.x, s.v, s.stress)]
        raise Unsound(material, int(s.row[p]), self.steps, self.time, *state)

    def _sort(self):
        left = sort(self.grid, self.sets, self.small, self._walls())
        self.gone = 0
        if self.contact is not None:
            self.contact.forget(self)
        for s, count in zip(self.sets, left, strict=True):
            if not count:
                continue
            new = slice(s.active, s.active + count)
            speed = np.hypot(np.hypot(*s.v[new, :2].T), s.v[new, 2])  # squares may overflow
            broken = ~(speed <= self.speed_limit) | ~np.isfinite(s.x[new]).all(axis=1)
            if broken.any():
                self._refuse(s, s.active + int(broken.argmax()))
            first = s.active + int(s.row[new].argmin())
            rows = np.sort(s.row[new])
            self.departures.append(Departure(self.time, rows, s.x[first].copy()))

    def _walls(self):
        """Return the planes that keep particles in; who begins outside the mesh stays there."""
        if self.leaky or self.steps == 0:
            return OPEN
        walls = self.planes.walls
        moved = [] if self.tools is None else filter(None, self.tools.planes)
        return walls._replace(**{Walls._fields[axis + 3 * side]: False for axis, side in moved})

    def _settle(self):
        """Stop all particles when the kinetic energy has passed a peak (Cundall 1982)."""
        energy = self.peak_energy = self.kinetic_energy()
        if energy < self.last_energy:
            for s in self.sets:
                s.stop()
            if self.tools is not None:
                self.tools.hold(self.sets)
            energy = 0.0
        self.last_energy = energy

    # Keeping a state

    def keep(self, kept):
        """Return a copy of what changes in a run, in the arrays of the copy `kept` if not None."""
        if kept is None:
            copies = [{name: np.empty_like(a) for name, a in s.arrays().items()} for s in self.sets]
        else:
            copies = kept["sets"]
        for s, copy in zip(self.sets, copies, strict=True):
            for name, a in s.arrays().items():
                np.copyto(copy[name], a)
        order = [(s.start, s.chunk) for s in self.sets]
        return {
            "sets": copies,
            "order": order,
            "departures": len(self.departures),
            "time": self.time,
            "steps": self.steps,
        }

    def restore(self, kept):
        """Go back to the particles that `keep` returned; to look at, not to run on from.

        The nodes get the mass and velocity that these particles give them.
        """
        for s, copy, order in zip(self.sets, kept["sets"], kept["order"], strict=True):
            for name, a in s.arrays().items():
                np.copyto(a, copy[name])
            s.start, s.chunk = order
        self.time, self.steps = kept["time"], kept["steps"]
        self.peak_energy = None
        del self.departures[kept["departures"] :]
        self._sort()
        self.scatter()
        self.update_momentum(0.0)

    # The stages

    def run_kernel(self, kernel, *arguments):
        """Run a kernel with shape and mesh before its arguments, in threads if it pays."""
        return (kernel.serial if self.small else kernel)(self.shape, self.grid.mesh, *arguments)

    def scatter(self, internal=True):
        """Fill the tiles with mass, momentum and external force, and the internal one if asked."""
        g = self.grid
        for number, s in enumerate(self.sets):
            self.run_kernel(
                transfer.scatter,
                *(number == 0, s.chunk, s.start, g.corner, s.half, s.x, s.v, s.m, s.V),
                *((s.stress, s.pressure) if internal else (None, None)),
                *(self.gravity, s.force, 0.0 if s.tool is None else 1.0, g.tiles),
            )
        self.clock.lap("scatter")

    def update_momentum(self, h):
        """Integrate the nodal momentum over h."""
        g, motion = self.grid, self.motion
        if self.point_loads is not None:
            self.point_loads.apply(g)
        arguments = (
            *(self.planes, motion.before, motion.acceleration, motion.drives),
            *(self.local, self.delayed, *self.driven("before", "after"), h, self.cutoff),
            *(g.chunk, g.active_corner, g.below, g.tiles, g.scratch, g.nodes),
        )
        self.measure(reactions.add_forces, arguments)
        self.run_kernel(grid_update.update_momentum, *arguments)
        self.clock.lap("grid update")
        if self.contact is not None and h > 0.0:
            self.contact.act(self, h)

    def measure(self, kernel, arguments):
        """Sum the forces of planes and tools with a kernel if this step is one of those wanted."""
        if not any((self.steps + 1) % every == 0 for every in self.measured):
            return
        tools = 0 if self.tools is None else len(self.tools.given)
        forces = np.zeros((len(self.grid.active), len(PLANES) + tools, 3))
        self.run_kernel(kernel, *arguments, forces)
        self.reactions = forces.sum(axis=0)
        self.clock.lap("reactions")

    def driven(self, *names):
        """Return the nodes' tools, their components and velocities for kernels; None without."""
        tools = self.tools
        if tools is None:
            return (None, None, *(None for _ in names))
        return (tools.owner, tools.given, *(getattr(tools, name) for name in names))

    def update_velocity(self, base):
        """Make nodal velocities of the momentum in the tiles; base nodes move with the base."""
        g = self.grid
        velocity = self.motion.after if base == "after" else self.motion.before
        self.run_kernel(
            grid_update.update_velocity,
            *(self.planes, velocity, self.motion.drives, *self.driven(base)),
            *(g.chunk, g.active_corner, g.below, g.tiles, g.scratch, g.nodes),
        )
        self.clock.lap("grid update")

    def gather(self, h, stress=True):
        """Move the particles; change velocities by h times the acceleration unless h is None."""
        g = self.grid
        for s in self.sets:
            self.gone += self.run_kernel(
                transfer.gather,
                *(s.law if stress else None, s.rotation, s.chunk, s.start, g.corner, g.above),
                *(g.nodes, g.scratch, s.half, s.x, None if h is None else s.v, s.V, s.stress),
                *(s.state, s.strain, self.time_step, 0.0 if h is None else h),
            )
        self.clock.lap("gather")
        if self.contact is not None:
            self.gone += self.contact.settle(self)

    def remap(self, h):
        """Change velocities by h times the acceleration, put the new momentum into the tiles."""
        g = self.grid
        for number, s in enumerate(self.sets):
            self.run_kernel(
                transfer.remap,
                *(number == 0, s.chunk, s.start, g.corner, g.above, g.nodes, g.scratch),
                *(s.half, s.x, s.v, s.m, h, g.tiles),
            )
        self.clock.lap("remap")

    def strain_and_force(self):
        """Update stress with the nodal velocities, add the internal force to the tiles."""
        g = self.grid
        for s in self.sets:
            self.run_kernel(
                transfer.strain_and_force,
                *(s.law, s.rotation, s.chunk, s.start, g.corner, g.above, g.nodes, g.scratch),
                *(s.half, s.x, s.V, s.stress, s.pressure, s.state, s.strain),
                *(self.time_step, g.tiles),
            )
        self.clock.lap("strain and force")
