"""Loops over particles or nodes for one quantity alone, which the solver computes in passing."""

from numba import prange

from mpmgeo.materials.law import update_stress
from mpmgeo.mpm.grid_update import sum_tiles
from mpmgeo.mpm.point import spin_increment, strain_increment
from mpmgeo.mpm.tile import block_origin, collect, copy_tile, locate
from mpmgeo.numerics.jit import blockwise
from mpmgeo.numerics.simd import LANES
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE


@blockwise
def sum_weights(shape, mesh, chunk, start, corner, half, x, out):
    """Sum the S³ weights of every particle."""
    S = width(shape)
    for c in prange(len(chunk) - 1):
        for b in range(chunk[c], chunk[c + 1]):
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                _, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                total = 0.0
                for i in range(S):
                    for j in range(S):
                        for k in range(S):
                            total += wx[i] * wy[j] * wz[k]
                out[p] = total


@blockwise
def stretch(shape, mesh, chunk, start, m, trace, V, density):
    """Change the volumes by a volume strain and return the densities."""
    for c in prange(len(chunk) - 1):
        for p in range(start[chunk[c]], start[chunk[c + 1]]):
            V[p] *= 1.0 + trace
            density[p] = m[p] / V[p]


@blockwise
def strain_all(shape, mesh, law, chunk, start, strain, stress):
    """Update the stress of every particle for the same strain increment."""
    for c in prange(len(chunk) - 1):
        for p in range(start[chunk[c]], start[chunk[c + 1]]):
            s = stress[p]
            new = update_stress(law, (s[0], s[1], s[2], s[3], s[4], s[5]), strain, (), 1.0)
            for a in range(6):
                s[a] = new[a]


@blockwise
def sum_nodes(shape, mesh, chunk, below, tiles, nodes):
    """Sum the tiles into the nodes."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, nodes, b * NODES * LANES)


@blockwise
def strains(shape, mesh, chunk, start, corner, above, nodes, scratch, half, x, dt, out):
    """Gather the strain increment of every particle."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for b in range(chunk[c], chunk[c + 1]):
            if start[b] == start[b + 1]:
                continue
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                _, sx, sy, sz = collect(tile, n, row, wx, wy, wz)
                new = strain_increment(mesh, sx, sy, sz, dt)
                for a in range(6):
                    out[p, a] = new[a]


@blockwise
def spins(shape, mesh, chunk, start, corner, above, nodes, scratch, half, x, dt, out):
    """Gather the spin increment of every particle."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for b in range(chunk[c], chunk[c + 1]):
            if start[b] == start[b + 1]:
                continue
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                _, sx, sy, sz = collect(tile, n, row, wx, wy, wz)
                new = spin_increment(mesh, sx, sy, sz, dt)
                for a in range(3):
                    out[p, a] = new[a]
