"""Particles to time kernels on: where MPM-Geomechanics puts them, or spread out as in a body."""

import numpy as np

from mpmgeo.materials.elastic import Elastic
from mpmgeo.mpm.solver import SMALL
from mpmgeo.mpm.stages import Loops
from mpmgeo.shapes import SHAPES
from mpmgeo.shapes.shape import widths
from mpmgeo.state.grid import Grid, Mesh
from mpmgeo.state.layout import NODES
from mpmgeo.state.particles import ParticleSet
from mpmgeo.state.sorting import sort

PLACEMENTS = ("first cell", "spread out")
PER_CELL = 8
SIZE = 1.0  # edge of all particles, whatever their number [m]


class Scene(Loops):
    """Sorted particles of mass 1 with their grid, and the loops over them."""

    def __init__(self, configuration, placement):
        self.configuration = configuration
        count, cell = configuration.particles, np.array(configuration.cell)
        position = _positions(configuration, placement)
        cells = np.maximum(configuration.cells, np.floor(position.max(axis=0) / cell) + 1)
        mesh = Mesh.of(configuration.cell, cells.astype(int))
        self.shape = SHAPES["GIMP"]
        self.grid = Grid(mesh, widths(self.shape))
        self.small = count <= SMALL
        law = Elastic(
            id=1,
            density=configuration.density,
            young=configuration.young,
            poisson=configuration.poisson,
        )
        self.particles = ParticleSet(
            law=law.symbols,
            row=np.arange(count),
            x=position,
            v=np.zeros((count, 3)),
            m=np.ones(count),
            V=np.ones(count),
            stress=np.zeros((count, 6)),
            half=tuple(np.minimum(SIZE / 2 / cell, 0.5).tolist()),
        )
        sort(self.grid, [self.particles], self.crew)

    def visit(self, work, arrays, tiles=None, nodes=None):
        """Do a work with all particles; `tiles` are emptied before."""
        self.over_particles(work, self.particles, arrays, tiles, nodes, fresh=True)

    def set_nodal_velocity(self, velocity):
        """Give the nodes the velocity that a function of their positions (n, 3) returns."""
        mesh = self.grid.mesh
        position = self.grid.indices() * np.array([mesh.hx, mesh.hy, mesh.hz])
        records = self.grid.records()
        records[:] = 0.0
        records[..., :3] = velocity(position.reshape(-1, 3)).reshape(-1, NODES, 3)


def _positions(configuration, placement):
    """Return positions (n, 3) [m]: all in the first cell, or so many in each cell of a cube."""
    random = np.random.Generator(np.random.MT19937(configuration.seed))
    cell, count = np.array(configuration.cell), configuration.particles
    if placement == "first cell":
        return random.uniform(0.0, cell.max(), (count, 3))
    side = max(1, round((count / PER_CELL) ** (1 / 3)))
    return random.uniform(0.0, 1.0, (count, 3)) * side * cell
