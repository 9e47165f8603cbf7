"""Tiles: weights and slopes applied to the records of a particle's nodes, read from them."""

from numba.extending import overload

from mpmgeo.mpm.core import plane
from mpmgeo.mpm.core.stencils import is_across, of_one_node
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import LANES, add, axpy, load, pack4, quarter, scale, splat, store
from mpmgeo.state.layout import block_of, blocks_along, inner, nodes, place, side, volume


def deposit(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    """Add S C0 + ∂S/∂x C1 + ∂S/∂y C2 + ∂S/∂z C3 to the nodes whose records begin at n0."""


@overload(deposit, jit_options=INLINED)
def _compiled_deposit(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    return _chosen(wx, wy, wz, _deposit_yz, _deposit_xz, _deposit_xy, _deposit)


def _chosen(wx, wy, wz, across_x, across_y, across_z, else_):
    """Return what is for the axes along which something changes."""
    if is_across(wx):
        return across_x
    if is_across(wy):
        return across_y
    return across_z if is_across(wz) else else_


def _deposit_yz(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    plane.deposit(tiles, n0, row[2] * LANES, LANES, wy, wz, C0, C2, C3)


def _deposit_xz(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    plane.deposit(tiles, n0, row[2] * LANES, LANES, wx, wz, C0, C1, C3)


def _deposit_xy(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    plane.deposit(tiles, n0, row[1] * LANES, LANES, wx, wy, C0, C1, C2)


def _deposit(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    # one axis after the other, so that every factor is a weight or slope of one axis: eighteen
    # broadcasts for S = 3, which stay in registers
    I, J, K = len(wx) // 2, len(wy) // 2, len(wz) // 2
    for i in range(I):
        X = axpy(wx[I + i], C1, scale(wx[i], C0))
        Y = scale(wx[i], C2)
        Z = scale(wx[i], C3)
        for j in range(J):
            A = axpy(wy[J + j], Y, scale(wy[j], X))
            B = scale(wy[j], Z)
            n = n0 + place(row, i, j, 0) * LANES
            for k in range(K):
                at = n + k * LANES
                store(tiles, at, axpy(wz[K + k], B, axpy(wz[k], A, load(tiles, at))))


@inlined
def deposit_value(tiles, n0, row, wx, wy, wz, C0):
    """Add S C0 to the nodes whose records begin at n0."""
    wx, wy, wz = of_one_node(wx), of_one_node(wy), of_one_node(wz)
    for i in range(len(wx) // 2):
        X = scale(wx[i], C0)
        for j in range(len(wy) // 2):
            A = scale(wy[j], X)
            n = n0 + place(row, i, j, 0) * LANES
            for k in range(len(wz) // 2):
                at = n + k * LANES
                store(tiles, at, axpy(wz[k], A, load(tiles, at)))


@inlined
def copy_tile(records, above, b, row, tile):
    """Copy the node records under tile b out of the blocks that hold them."""
    I, J, K = side(row[0]), side(row[1]), side(row[2])
    for di in range(blocks_along(row[0])):
        for dj in range(blocks_along(row[1])):
            for dk in range(blocks_along(row[2])):
                block = above[b, block_of(row, di, dj, dk)] * nodes(row)
                i0, j0, k0 = I * di, J * dj, K * dk
                for i in range(min(I, row[0] - i0)):
                    for j in range(min(J, row[1] - j0)):
                        source = (block + inner(row, i, j, 0)) * LANES
                        at = place(row, i + i0, j + j0, k0) * LANES
                        for k in range(min(K, row[2] - k0)):
                            store(tile, at + k * LANES, load(records, source + k * LANES))


@inlined
def sum_tiles(tiles, below, a, row, out, first):
    """Sum the tiles over active block a, in fixed order, into the records of `out` from `first`."""
    I, J, K = side(row[0]), side(row[1]), side(row[2])
    for n in range(nodes(row)):
        store(out, first + n * LANES, splat(0.0))
    size = volume(row)
    for di in range(blocks_along(row[0])):
        for dj in range(blocks_along(row[1])):
            for dk in range(blocks_along(row[2])):
                t = below[a, block_of(row, di, dj, dk)]
                if t < 0:
                    continue
                i0, j0, k0 = I * di, J * dj, K * dk
                for i in range(min(I, row[0] - i0)):
                    for j in range(min(J, row[1] - j0)):
                        n = first + inner(row, i, j, 0) * LANES
                        s = (t * size + place(row, i + i0, j + j0, k0)) * LANES
                        for k in range(min(K, row[2] - k0)):
                            at = n + k * LANES
                            store(out, at, add(load(out, at), load(tiles, s + k * LANES)))


def collect(tile, n0, row, wx, wy, wz):
    """Return Σ S r, and Σ ∂S/∂x r, Σ ∂S/∂y r, Σ ∂S/∂z r of four lanes of the records r."""


@overload(collect, jit_options=INLINED)
def _compiled_collect(tile, n0, row, wx, wy, wz):
    return _chosen(wx, wy, wz, _collect_yz, _collect_xz, _collect_xy, _collect)


def _collect_yz(tile, n0, row, wx, wy, wz):
    value, sy, sz = plane.collect(tile, n0, row[2] * LANES, LANES, wy, wz)
    return value, pack4(0.0, 0.0, 0.0, 0.0), sy, sz


def _collect_xz(tile, n0, row, wx, wy, wz):
    value, sx, sz = plane.collect(tile, n0, row[2] * LANES, LANES, wx, wz)
    return value, sx, pack4(0.0, 0.0, 0.0, 0.0), sz


def _collect_xy(tile, n0, row, wx, wy, wz):
    value, sx, sy = plane.collect(tile, n0, row[1] * LANES, LANES, wx, wy)
    return value, sx, sy, pack4(0.0, 0.0, 0.0, 0.0)


def _collect(tile, n0, row, wx, wy, wz):
    I, J, K = len(wx) // 2, len(wy) // 2, len(wz) // 2
    value = splat(0.0)
    sx = sy = sz = pack4(0.0, 0.0, 0.0, 0.0)
    for i in range(I):
        a = splat(0.0)
        b = c = pack4(0.0, 0.0, 0.0, 0.0)
        for j in range(J):
            n = n0 + place(row, i, j, 0) * LANES
            record = load(tile, n)
            r, q = scale(wz[0], record), scale(wz[K], quarter(record, 0))
            for k in range(1, K):
                record = load(tile, n + k * LANES)
                r, q = axpy(wz[k], record, r), axpy(wz[K + k], quarter(record, 0), q)
            a, b, c = axpy(wy[j], r, a), axpy(wy[J + j], quarter(r, 0), b), axpy(wy[j], q, c)
        value, sx = axpy(wx[i], a, value), axpy(wx[I + i], quarter(a, 0), sx)
        sy, sz = axpy(wx[i], b, sy), axpy(wx[i], c, sz)
    return value, sx, sy, sz


@inlined
def collect_diagonal(tile, n0, row, wx, wy, wz):
    """Return Σ ∂S/∂x r, Σ ∂S/∂y r, Σ ∂S/∂z r of the first, second, third lane of the records r.

    They are the lanes of one vector, which has one product for each node.
    """
    wx, wy, wz = of_one_node(wx), of_one_node(wy), of_one_node(wz)
    I, J, K = len(wx) // 2, len(wy) // 2, len(wz) // 2
    value = pack4(0.0, 0.0, 0.0, 0.0)
    for i in range(I):
        a = pack4(0.0, 0.0, 0.0, 0.0)
        for j in range(J):
            n = n0 + place(row, i, j, 0) * LANES
            b = pack4(0.0, 0.0, 0.0, 0.0)
            for k in range(K):
                b = b + pack4(wz[k], wz[k], wz[K + k], 0.0) * quarter(load(tile, n + k * LANES), 0)
            a = a + pack4(wy[j], wy[J + j], wy[j], 0.0) * b
        value = value + pack4(wx[I + i], wx[i], wx[i], 0.0) * a
    return value


@inlined
def collect_value(tile, n0, row, wx, wy, wz):
    """Return Σ S r over the node records r from n0 on."""
    wx, wy, wz = of_one_node(wx), of_one_node(wy), of_one_node(wz)
    value = splat(0.0)
    for i in range(len(wx) // 2):
        a = splat(0.0)
        for j in range(len(wy) // 2):
            n = n0 + place(row, i, j, 0) * LANES
            r = scale(wz[0], load(tile, n))
            for k in range(1, len(wz) // 2):
                r = axpy(wz[k], load(tile, n + k * LANES), r)
            a = axpy(wy[j], r, a)
        value = axpy(wx[i], a, value)
    return value
