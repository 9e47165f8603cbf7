"""Transfers of the pore fluid between particles and nodes, beside those of the solid.

The particles move with the solid and carry the fluid in their pores: its mass, velocity and
pressure. Tiles and chunks are those of `transfer`. Two records of a tile belong to the fluid:

    flow:  m, m v (3), ∫ p ∇S dV (3), V           pores:  pore volume, drag (3), force (3), spare

Record of a node: flux q (3), a (3), mean pressure of the cell above, porosity. q is the
velocity of fluid and solid together as a volume, v_s + n (v_f − v_s); its divergence presses the
fluid.
"""

from numba import prange

from mpmgeo.mpm.tile import (
    block_origin,
    collect,
    copy_tile,
    deposit,
    deposit_value,
    in_block,
    locate,
)
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import (
    LANES,
    axpy,
    lane,
    load_row,
    pack,
    quarter,
    scale,
    store_row,
    truncate,
    with_velocity,
)
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE

LEAST = 0.01  # porosity below which the pores count as no smaller: they cannot close


@inlined
def _cell(mesh, origin, row, x, i):
    """Return the place in its tile, along x, y, z, of the lowest node of particle i's cell."""
    g = min(max(truncate(in_block(mesh, origin, load_row(x, i))), 0.0), row - 2.0)
    return int(lane(g, 0)), int(lane(g, 1)), int(lane(g, 2))


@blockwise
def sum_cells(shape, mesh, first, chunk, start, corner, x, V, p, free, tiles):
    """Sum volume and volume times pressure of the particles of each cell; `first` empties the sums.

    Particles that keep their pressure do not count. The record of a cell is that of its lowest
    node.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        for b in range(chunk[c], chunk[c + 1]):
            if first:
                tiles[b * size : (b + 1) * size] = 0.0
            origin = block_origin(mesh, corner, b)
            for i in range(start[b], start[b + 1]):
                I, J, K = _cell(mesh, origin, row, x, i)
                at = b * size + ((I * row + J) * row + K) * LANES
                volume = V[i] if free is None else V[i] * free[i]
                tiles[at] += volume
                tiles[at + 1] += volume * p[i]


@blockwise
def share(shape, mesh, chunk, start, corner, above, nodes, x, p, free):
    """Give the particles the mean pressure of their cell, which `average` put into the nodes."""
    row = SIDE + width(shape) - 1
    reach = (row + SIDE - 1) // SIDE
    for c in prange(len(chunk) - 1):
        for b in range(chunk[c], chunk[c + 1]):
            origin = block_origin(mesh, corner, b)
            for i in range(start[b], start[b + 1]):
                if free is not None and free[i] == 0.0:
                    continue
                I, J, K = _cell(mesh, origin, row, x, i)
                block = above[b, (I // SIDE * reach + J // SIDE) * reach + K // SIDE]
                n = block * NODES + (I % SIDE * SIDE + J % SIDE) * SIDE + K % SIDE
                p[i] = nodes[n * LANES + 6]


@blockwise
def scatter(
    shape, mesh, fluid, first, chunk, start, corner, half, x, m, v, V, p, force, flow, pores,
):  # fmt: skip
    """Add mass, momentum, pressure force, drag of the fluid to the tiles; `first` empties them.

    `m`, `v`, `p`: mass, velocity, pressure of the fluid; `force`: on the fluid against the solid,
    None without.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        one = pack(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        volume = pack(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        X = pack(0.0, 0.0, 0.0, 0.0, mesh.ix, 0.0, 0.0, 0.0)
        Y = pack(0.0, 0.0, 0.0, 0.0, 0.0, mesh.iy, 0.0, 0.0)
        Z = pack(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, mesh.iz, 0.0)
        for b in range(chunk[c], chunk[c + 1]):
            if first:
                flow[b * size : (b + 1) * size] = 0.0
                pores[b * size : (b + 1) * size] = 0.0
            origin = block_origin(mesh, corner, b)
            for i in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, i)
                C0 = axpy(m[i], with_velocity(one, load_row(v, i)), scale(V[i], volume))
                q = V[i] * p[i]
                C1, C2, C3 = scale(q, X), scale(q, Y), scale(q, Z)
                deposit(flow, b * size + n, row, wx, wy, wz, C0, C1, C2, C3)
                d = m[i] * m[i] / V[i]
                fx = fy = fz = 0.0
                if force is not None:
                    fx, fy, fz = force[i, 0], force[i, 1], force[i, 2]
                C0 = pack(m[i] / fluid.ρ, d * fluid.dx, d * fluid.dy, d * fluid.dz, fx, fy, fz, 0.0)
                deposit_value(pores, b * size + n, row, wx, wy, wz, C0)


@inlined
def _divergence(mesh, sx, sy, sz):
    """Return the divergence [1/s] of a velocity, from the slopes per cell of node records."""
    return mesh.ix * lane(sx, 0) + mesh.iy * lane(sy, 1) + mesh.iz * lane(sz, 2)


@inlined
def _compress(fluid, solid, V, p, free, i, strain):
    """Change the pressure of particle i by the volume strain of its solid and fluid together.

    `solid`: mass of the solid; `free` None, or 0 for particles that keep their pressure.
    """
    n = max(1.0 - solid[i] / (fluid.ρs * V[i]), LEAST)
    change = fluid.K / n * strain
    if free is not None:
        change *= free[i]
    p[i] -= change


@blockwise
def gather(
    shape, mesh, fluid, chunk, start, corner, above, nodes, scratch, half, x, v, solid, V, p, free,
    dt, h,
):  # fmt: skip
    """Change velocities by h times the acceleration, or not with `v` None, and the pressures."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for b in range(chunk[c], chunk[c + 1]):
            if start[b] == start[b + 1]:
                continue
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            for i in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, i)
                value, sx, sy, sz = collect(tile, n, row, wx, wy, wz)
                if v is not None:
                    store_row(v, i, axpy(h, quarter(value, 3), load_row(v, i)))
                strain = dt * _divergence(mesh, sx, sy, sz)
                _compress(fluid, solid, V, p, free, i, strain)
