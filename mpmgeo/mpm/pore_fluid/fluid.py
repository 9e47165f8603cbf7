"""The pore fluid of a solver: its fields of nodes, and what a step does with them.

One set of particles carries both phases and moves with the solid (Jassim, Stolle and Vermeer 2013).
The schemes are those of one phase; the stresses that the solid's works see are the effective ones.
"""

from mpmgeo.boundaries.planes import BASE, FREE, Planes
from mpmgeo.effect import Effect
from mpmgeo.mpm.core.cells import Average
from mpmgeo.mpm.core.transfer import Remap
from mpmgeo.mpm.pore_fluid.nodes import Momenta, Velocities
from mpmgeo.mpm.pore_fluid.transfer import MEAN, GatherFluid, ScatterFluid, Share, SumCells
from mpmgeo.mpm.task import Task
from mpmgeo.numerics.chunks import CHUNKS
from mpmgeo.numerics.simd import LANES, aligned
from mpmgeo.state.field import Field, Lanes
from mpmgeo.state.layout import NODES

FLOW = Lanes(
    tile={"mass": (0, 1), "momentum": (1, 3), "pressure force": (4, 3), "volume": (7, 1)},
    node={"flux": (0, 3), "acceleration": (3, 3), "pressure of cell": (6, 1), "porosity": (7, 1)},
)
PORES = Lanes(tile={"volume": (0, 1), "drag": (1, 3), "force": (4, 3)}, node={})
SUMS = 3  # fields whose tiles are summed at once: solid, flow, pores


class PoreFluid(Effect):
    """The fluid in the pores of all particles.

    `walls`: the planes for the fluid; `smooth`: whether the particles of a cell share its mean
    pressure.
    """

    name = "fluid"

    def __init__(self, walls: Planes, smooth: bool):
        self.walls = walls
        self.smooth = smooth
        self.flow, self.pores = Field(FLOW), Field(PORES, has_nodes=False)
        self.scratch = aligned(CHUNKS * SUMS * NODES * LANES)
        self._keys = None

    def join(self, solver):
        """Let the lowest wall move with a base, unless the fluid passes it freely."""
        solver.nodal = self
        if solver.planes.z0 == BASE and self.walls.z0 != FREE:
            self.walls = self.walls._replace(z0=BASE)

    def begin(self, solver, h):
        """Give the grid's blocks their records of the fluid."""
        grid = solver.grid
        if self._keys is not grid.keys:
            self._keys = grid.keys
            for field in (self.flow, self.pores):
                field.fit(len(grid.keys), grid.rows, len(grid.active))

    def momentum(self, solver, h):
        """Return the task that integrates the momenta of both phases over h."""
        motion, (driven, arrays) = solver.motion, solver.driven
        work = Momenta(
            *(solver.planes, self.walls, motion.before, motion.acceleration, motion.drives),
            *(solver.damping, solver.gravity, driven, h, solver.cutoff),
        )
        tiles = (solver.grid.tiles, self.flow.tiles, self.pores.tiles)
        return Task(work, tiles, self.scratch, (solver.grid.nodes, self.flow.nodes, arrays))

    def velocity(self, solver, after):
        """Return the task that makes velocities of both momenta after the step."""
        motion, (driven, arrays) = solver.motion, solver.driven
        work = Velocities(solver.planes, self.walls, motion.after, motion.drives, driven)
        tiles = (solver.grid.tiles, self.flow.tiles)
        return Task(work, tiles, self.scratch, (solver.grid.nodes, self.flow.nodes, arrays))

    def before_nodes(self, solver, task):
        """Fill the tiles with the fluid's mass, momentum, pressure force and drag."""
        if self.smooth:
            self._share_pressures(solver)
        tiles = (self.flow.tiles, self.pores.tiles)
        for number, p in enumerate(solver.sets):
            arrays = (p.mf, p.vf, p.pf, p.V, p.pull)
            solver.over_particles(ScatterFluid(p.fluid), p, arrays, tiles, fresh=number == 0)
        solver.clock.lap("fluid: scatter")

    def _share_pressures(self, solver):
        """Give all particles of a cell the mean of their pressures, weighted by volume."""
        flow, tiles = self.flow, (self.flow.tiles,)
        for number, p in enumerate(solver.sets):
            solver.over_particles(SumCells(), p, (p.V, p.pf, p.free), tiles, fresh=number == 0)
        solver.over_nodes(Task(Average(MEAN), tiles, self.scratch, (flow.nodes,)))
        for p in solver.sets:
            solver.over_particles(Share(), p, (solver.grid.above, flow.nodes, p.pf, p.free))
        solver.clock.lap("fluid: means of cells")

    def after_remap(self, solver, h):
        """Change the fluid's velocities and put its new momentum into the tiles."""
        for number, p in enumerate(solver.sets):
            tiles, nodes = (self.flow.tiles,), self.flow.nodes
            arrays = p.vf, None, p.mf
            solver.over_particles(Remap(h), p, arrays, tiles, nodes, fresh=number == 0)
        solver.clock.lap("fluid: remap")

    def before_gather(self, solver, h):
        """Update the pressures, the particles where they were; change the fluid's velocities."""
        for p in solver.sets:
            work = GatherFluid(p.fluid, solver.time_step, 0.0 if h is None else h)
            arrays = (None if h is None else p.vf, p.m, p.V, p.pf, p.free)
            solver.over_particles(work, p, arrays, nodes=self.flow.nodes)
        solver.clock.lap("fluid: gather")
