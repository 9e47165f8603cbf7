"""How full of particles the space is: at a node the share Σ S V₀ of its volume, V₀ at the start."""

from typing import NamedTuple

import numpy as np

from mpmgeo.mpm.core.loops import at_node, visit
from mpmgeo.mpm.core.stencils import locate
from mpmgeo.mpm.core.tile import deposit_value
from mpmgeo.mpm.task import Task
from mpmgeo.numerics.simd import lane, load, pack
from mpmgeo.state.grid import corners_of, keys_of, nodes_of
from mpmgeo.state.layout import CUBE, NODES, SIDE, inner


class Density(NamedTuple):
    """The density (blocks, 64) [-] at the nodes of the blocks of `keys`, ascending; zero beyond."""

    keys: np.ndarray
    values: np.ndarray

    def indices(self):
        """Return the node indices (blocks, 64, 3)."""
        return nodes_of(corners_of(self.keys))

    def at(self, mesh, x):
        """Return the density (n,) [-] at points x (n, 3) [m] in the mesh, linear between nodes."""
        density = np.append(self.values.ravel(), 0.0)
        g = x * [mesh.ix, mesh.iy, mesh.iz]
        g = np.clip(g, -4.0, np.array([mesh.nx, mesh.ny, mesh.nz]) + 4.0)
        first = np.floor(g).astype(np.int64)
        value = np.zeros(len(x))
        for corner in np.ndindex(2, 2, 2):
            node = first + corner
            weight = np.where(corner, g - first, 1.0 - (g - first)).prod(axis=1)
            keys = keys_of(node // SIDE)
            block = np.minimum(np.searchsorted(self.keys, keys), max(len(self.keys) - 1, 0))
            at = block * NODES + inner(CUBE, *(node % SIDE).T)
            known = self.keys[block] == keys if len(self.keys) else np.zeros(len(x), bool)
            value += weight * density[np.where(known, at, -1)]
        return value


NOTHING = Density(np.empty(0, np.int64), np.empty((0, NODES)))


class AddVolume(NamedTuple):
    """Add S V to the tiles. Arrays: V."""


@visit.register(AddVolume)
def add_volume(work, here, a, p):
    n, wx, wy, wz = locate(here, p)
    C0 = pack(a[0][p], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    deposit_value(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0)
    return 0


class Volume(NamedTuple):
    """Write the sums of what `AddVolume` added. Arrays: (nodes,)."""


@at_node.register(Volume)
def volume(work, node, a):
    a[0][node.number] = lane(load(node.sums, node.at), 0)


def nodal_density(solver) -> Density:
    """Return the density at the nodes, of the particles where they are."""
    solver.arrange()
    grid, mesh = solver.grid, solver.grid.mesh
    out = np.zeros(len(grid.active) * NODES)
    for number, s in enumerate(solver.sets):
        volumes = solver.population.size[s.row].prod(axis=1)
        # the tiles keep nothing from one step to the next
        solver.over_particles(AddVolume(), s, (volumes,), (grid.tiles,), fresh=number == 0)
    solver.over_nodes(Task(Volume(), (grid.tiles,), grid.scratch, (out,)))
    return Density(grid.active, out.reshape(-1, NODES) / (mesh.hx * mesh.hy * mesh.hz))
