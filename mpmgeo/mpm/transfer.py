"""Transfers between particles and nodes: scatter (P2G), gather (G2P) and both in one pass.

A block's particles have the first node of their stencils in the block, so all their nodes lie in
the block's *tile*: the block and a halo on the upper sides, (4 + S − 1)³ nodes. Scatter fills the
tiles, each from its own particles alone; gather reads from a copy of the nodes under the tile. No
two threads ever write the same place, and every sum has one order.

Record of a tile: m, m v (3), f (3), m of tools. Record of a node: v (3), a (3), m, spare.

Loops run over chunks of blocks; a chunk has a scratch tile of its own.
"""

from numba import prange

from mpmgeo.mpm.point import (
    advance,
    internal_force,
    momentum_and_weight,
    spin_increment,
    strain_increment,
)
from mpmgeo.mpm.tile import (
    block_bounds,
    block_origin,
    collect,
    collect_value,
    copy_tile,
    deposit,
    deposit_value,
    in_block,
    locate,
)
from mpmgeo.numerics.jit import blockwise
from mpmgeo.numerics.simd import (
    LANES,
    add,
    axpy,
    load_row,
    pack,
    quarter,
    splat,
    store_row,
    within,
)
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import SIDE


@blockwise
def scatter(
    shape,
    mesh,
    first,
    chunk,
    start,
    corner,
    half,
    x,
    v,
    m,
    V,
    stress,
    pressure,
    gravity,
    force,
    tool,
    tiles,
):
    """Add mass, momentum and force to the tiles; `first` empties them before.

    `stress` None leaves out the internal force, `pressure` None that of a pore fluid, `force` None
    a load beside gravity. `tool`: 1 if the velocity of the particles is prescribed, else 0.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        weight = pack(1.0, 0.0, 0.0, 0.0, gravity[0], gravity[1], gravity[2], tool)
        for b in range(chunk[c], chunk[c + 1]):
            if first:
                tiles[b * size : (b + 1) * size] = 0.0
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                C0 = momentum_and_weight(m, v, weight, p)
                if force is not None:
                    f = pack(0.0, 0.0, 0.0, 0.0, force[p, 0], force[p, 1], force[p, 2], 0.0)
                    C0 = add(C0, f)
                if stress is None:
                    deposit_value(tiles, b * size + n, row, wx, wy, wz, C0)
                else:
                    C1, C2, C3 = internal_force(mesh, V, stress, pressure, p)
                    deposit(tiles, b * size + n, row, wx, wy, wz, C0, C1, C2, C3)


@blockwise
def gather(
    shape,
    mesh,
    law,
    rotation,
    chunk,
    start,
    corner,
    above,
    nodes,
    scratch,
    half,
    x,
    v,
    V,
    stress,
    state,
    total,
    dt,
    h,
):
    """Move the particles with the nodes and update their stress; return how many left their block.

    Velocities change by h times the acceleration. With `v` None they stay, and positions follow the
    velocity that `update_velocity` kept. With `law` None volume and stress stay.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    gone = 0
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for b in range(chunk[c], chunk[c + 1]):
            if start[b] == start[b + 1]:
                continue
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            low, high = block_bounds(shape, mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                value, sx, sy, sz = collect(tile, n, row, wx, wy, wz)
                if v is not None:
                    X = axpy(dt, quarter(value, 0), load_row(x, p))
                    store_row(v, p, axpy(h, quarter(value, 3), load_row(v, p)))
                else:
                    X = axpy(dt, quarter(value, 3), load_row(x, p))
                store_row(x, p, X)
                if not within(in_block(mesh, origin, X), low, high):
                    gone += 1
                if law is not None:
                    strain = strain_increment(mesh, sx, sy, sz, dt)
                    spin = spin_increment(mesh, sx, sy, sz, dt)
                    advance(law, rotation, strain, spin, V, stress, state, total, p, dt)
    return gone


@blockwise
def remap(shape, mesh, first, chunk, start, corner, above, nodes, scratch, half, x, v, m, h, tiles):
    """Change velocities by h times the acceleration and put the new momentum into the tiles."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        momentum = pack(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        for b in range(chunk[c], chunk[c + 1]):
            if first:
                tiles[b * size : (b + 1) * size] = 0.0
            if start[b] == start[b + 1]:
                continue
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                n, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                value = collect_value(tile, n, row, wx, wy, wz)
                store_row(v, p, axpy(h, quarter(value, 3), load_row(v, p)))
                C0 = momentum_and_weight(m, v, momentum, p)
                deposit_value(tiles, b * size + n, row, wx, wy, wz, C0)


@blockwise
def strain_and_force(
    shape,
    mesh,
    law,
    rotation,
    chunk,
    start,
    corner,
    above,
    nodes,
    scratch,
    half,
    x,
    V,
    stress,
    pressure,
    state,
    total,
    dt,
    tiles,
):
    """Update stress with the nodal velocity, add the internal force of the new one to the tiles."""
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
                strain = strain_increment(mesh, sx, sy, sz, dt)
                spin = spin_increment(mesh, sx, sy, sz, dt)
                advance(law, rotation, strain, spin, V, stress, state, total, p, dt)
                C1, C2, C3 = internal_force(mesh, V, stress, pressure, p)
                deposit(tiles, b * size + n, row, wx, wy, wz, splat(0.0), C1, C2, C3)
