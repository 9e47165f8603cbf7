"""The pore fluid of a solver: its records on the grid and the stages that the solid does not have.

One set of particles carries both phases and moves with the solid (Jassim, Stolle and Vermeer 2013).
The schemes are those of one phase with the stages of the fluid beside them; the stresses that the
solid's kernels see are the effective ones.
"""

from mpmgeo.boundaries.planes import BASE, FREE, Planes
from mpmgeo.mpm import fluid_grid, fluid_transfer, transfer
from mpmgeo.numerics.simd import LANES, aligned
from mpmgeo.state.grid import CHUNKS, NODES, room


class PoreFluid:
    """The fluid in the pores of all particles.

    `walls`: the planes for the fluid; `smooth`: whether the particles of a cell share its mean
    pressure.
    """

    def __init__(self, walls: Planes, smooth: bool):
        self.walls = walls
        self.smooth = smooth
        self.flow = self.pores = self.flux = aligned(0)
        self.scratch = aligned(CHUNKS * fluid_grid.SUMS * NODES * LANES)
        self._keys = None

    def fit(self, grid):
        """Give the grid's blocks their records of the fluid."""
        if self._keys is grid.keys:
            return
        self._keys = grid.keys
        count = len(grid.keys) * grid.side**3
        self.flow, self.pores = room(self.flow, count), room(self.pores, count)
        self.flux = room(self.flux, len(grid.active) * NODES)

    def follow(self, base):
        """Let the lowest wall move with a base that moves, unless the fluid passes it freely."""
        if base is not None and self.walls.z0 != FREE:
            self.walls = self.walls._replace(z0=BASE)

    # The stages

    def scatter(self, s):
        """Fill the tiles with the fluid's mass, momentum, pressure force and drag."""
        grid = s.grid
        self.fit(grid)
        if self.smooth:
            self._share_pressures(s)
        for number, p in enumerate(s.sets):
            s.run_kernel(
                fluid_transfer.scatter,
                *(p.fluid, number == 0, p.chunk, p.start, grid.corner, p.half, p.x, p.mf, p.vf),
                *(p.V, p.pf, p.pull, self.flow, self.pores),
            )
        s.clock.lap("fluid: scatter")

    def _share_pressures(self, s):
        """Give all particles of a cell the mean of their pressures, weighted by volume."""
        grid = s.grid
        for number, p in enumerate(s.sets):
            s.run_kernel(
                fluid_transfer.sum_cells,
                *(number == 0, p.chunk, p.start, grid.corner, p.x, p.V, p.pf, p.free, self.flow),
            )
        s.run_kernel(fluid_grid.average, grid.chunk, grid.below, self.flow, self.scratch, self.flux)
        for p in s.sets:
            s.run_kernel(
                fluid_transfer.share,
                *(p.chunk, p.start, grid.corner, grid.above, self.flux, p.x, p.pf, p.free),
            )
        s.clock.lap("fluid: means of cells")

    def update_momentum(self, s, h):
        """Integrate the nodal momenta of both phases over h."""
        grid, motion = s.grid, s.motion
        if s.point_loads is not None:
            s.point_loads.apply(grid)
        arguments = (
            *(s.planes, self.walls, motion.before, motion.acceleration, motion.drives),
            *(s.local, s.gravity, *s.driven("before", "after"), h, s.cutoff, grid.chunk),
            *(grid.active_corner, grid.below, grid.tiles, self.flow, self.pores, self.scratch),
            *(grid.nodes, self.flux),
        )
        s.measure(fluid_grid.add_forces, arguments)
        s.run_kernel(fluid_grid.update_momentum, *arguments)
        s.clock.lap("grid update")

    def remap(self, s, h):
        """Change the fluid's velocities and put its new momentum into the tiles."""
        grid = s.grid
        for number, p in enumerate(s.sets):
            s.run_kernel(
                transfer.remap,
                *(number == 0, p.chunk, p.start, grid.corner, grid.above, self.flux, grid.scratch),
                *(p.half, p.x, p.vf, p.mf, h, self.flow),
            )
        s.clock.lap("fluid: remap")

    def update_velocity(self, s):
        """Make velocities of the momenta in the tiles; base nodes move as the base does now."""
        grid, motion = s.grid, s.motion
        s.run_kernel(
            fluid_grid.update_velocity,
            *(s.planes, self.walls, motion.after, motion.drives, *s.driven("after")),
            *(grid.chunk, grid.active_corner, grid.below, grid.tiles, self.flow, self.scratch),
            *(grid.nodes, self.flux),
        )
        s.clock.lap("grid update")

    def gather(self, s, h):
        """Update the pressures; change the fluid's velocities unless h is None."""
        grid = s.grid
        for p in s.sets:
            s.run_kernel(
                fluid_transfer.gather,
                *(p.fluid, p.chunk, p.start, grid.corner, grid.above, self.flux, grid.scratch),
                *(p.half, p.x, None if h is None else p.vf, p.m, p.V, p.pf, p.free),
                *(s.time_step, 0.0 if h is None else h),
            )
        s.clock.lap("fluid: gather")
