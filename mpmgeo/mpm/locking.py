"""Means of cells for the stages of a solver whose particles share volume strain and pressure."""

from mpmgeo.mpm.core.cells import Average
from mpmgeo.mpm.core.locking import MEAN, SumDivergence, SumMeanStress
from mpmgeo.mpm.task import Task
from mpmgeo.state.field import Field, Lanes

SUMS = Lanes(
    tile={"volume": (0, 1), "volume times value": (1, 1)},
    node={"mean": (MEAN, 1)},
)


class CellMeans:
    """Means over the particles of one set in each cell; a later mean takes the place of an earlier.

    What it returns is for kernels: the blocks under the tiles, and the records of the cells.
    """

    def __init__(self):
        self.field = Field(SUMS)
        self._keys = None

    def of_stress(self, solver, s):
        """Return the mean total stresses [Pa] of the particles of set `s`."""
        return self._mean(solver, s, SumMeanStress(), (s.V, s.stress, s.pressure), None)

    def of_divergence(self, solver, s):
        """Return the mean divergences [1/s] of the nodal velocity at the particles of set `s`."""
        return self._mean(solver, s, SumDivergence(), (s.V,), solver.grid.nodes)

    def _mean(self, solver, s, work, arrays, nodes):
        grid, field = solver.grid, self.field
        if self._keys is not grid.keys:
            self._keys = grid.keys
            field.fit(len(grid.keys), grid.rows, len(grid.active))
        tiles = (field.tiles,)
        solver.over_particles(work, s, arrays, tiles, nodes, fresh=True)
        solver.over_nodes(Task(Average(MEAN), tiles, grid.scratch, (field.nodes,)))
        return grid.above, field.nodes
