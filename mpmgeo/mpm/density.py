"""How full of particles the space is: at a node the share Σ S V₀ of its volume, V₀ at the start."""

import numpy as np

from mpmgeo.mpm.tile import block_origin, locate
from mpmgeo.numerics.jit import compiled
from mpmgeo.numerics.simd import LANES
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE, keys_of


@compiled
def add_volume(shape, mesh, start, corner, above, half, x, volume, out):
    """Add Σ S V to the nodes (blocks · 64,) of the grid."""
    S = width(shape)
    row = SIDE + S - 1
    reach = (row + SIDE - 1) // SIDE
    for b in range(len(start) - 1):
        origin = block_origin(mesh, corner, b)
        for p in range(start[b], start[b + 1]):
            at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
            n = at // LANES
            for i in range(S):
                for j in range(S):
                    for k in range(S):
                        I, J, K = n // (row * row) + i, n // row % row + j, n % row + k
                        block = above[b, (I // SIDE * reach + J // SIDE) * reach + K // SIDE]
                        inner = (I % SIDE * SIDE + J % SIDE) * SIDE + K % SIDE
                        out[block * NODES + inner] += volume[p] * wx[i] * wy[j] * wz[k]


def nodal_density(solver):
    """Return the density (blocks, 64) [-] at the nodes of the grid's active blocks."""
    solver.arrange()
    grid, mesh = solver.grid, solver.grid.mesh
    out = np.zeros(len(grid.active) * NODES)
    for s in solver.sets:
        volume = solver.population.size[s.row].prod(axis=1)
        arguments = (s.start, grid.corner, grid.above, s.half, s.x, volume, out)
        add_volume(solver.shape, mesh, *arguments)
    return out.reshape(-1, NODES) / (mesh.hx * mesh.hy * mesh.hz)


def density_at(solver, x):
    """Return the density (n,) [-] at points x (n, 3) [m], linear between the nodes."""
    grid, mesh = solver.grid, solver.grid.mesh
    density = np.append(nodal_density(solver).ravel(), 0.0)
    g = x * [mesh.ix, mesh.iy, mesh.iz]
    g = np.clip(g, -4.0, np.array([mesh.nx, mesh.ny, mesh.nz]) + 4.0)
    first = np.floor(g).astype(np.int64)
    value = np.zeros(len(x))
    for corner in np.ndindex(2, 2, 2):
        node = first + corner
        weight = np.where(corner, g - first, 1.0 - (g - first)).prod(axis=1)
        keys = keys_of(node // SIDE)
        block = np.minimum(np.searchsorted(grid.active, keys), max(len(grid.active) - 1, 0))
        i, j, k = (node % SIDE).T
        at = block * NODES + (i * SIDE + j) * SIDE + k
        known = grid.active[block] == keys if len(grid.active) else np.zeros(len(x), bool)
        value += weight * density[np.where(known, at, -1)]
    return value
