"""Tiles: where a particle's records lie, weights and slopes applied to them, read from them."""

from numba.extending import overload

from mpmgeo.numerics import lanewise  # noqa: F401  teaches kernels the arithmetic of vectors
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import (
    LANES,
    add,
    along,
    axpy,
    lane,
    load,
    load_row,
    pack4,
    quarter,
    scale,
    splat,
    store,
    truncate,
)
from mpmgeo.shapes.shape import across, cut_of, cuts, stencil, widths
from mpmgeo.state.grid import walls_of
from mpmgeo.state.layout import SIDE, block_of, blocks_along, edge, inner, place, side, volume
from mpmgeo.state.layout import nodes as nodes_of


@inlined
def rows(shape):
    """Return the numbers of nodes along the edges of a shape's tile."""
    x, y, z = widths(shape)
    return edge(x), edge(y), edge(z)


def half_size(half, p):
    """Return the half-sizes of particle p in cells: `half` is one triple for all, or a row each."""
    return half if isinstance(half, tuple) else tuple(half[p])


@overload(half_size, jit_options=INLINED)
def _half_size(half, p):
    # the fourth lane is no axis; it must not divide by zero
    if hasattr(half, "ndim"):
        return lambda half, p: max(load_row(half, p), pack4(0.0, 0.0, 0.0, 0.5))
    return lambda half, p: pack4(half[0], half[1], half[2], 0.5)


@inlined
def block_origin(mesh, corner):
    """Return the position of the first node of a block."""
    return pack4(
        corner[0] * SIDE * mesh.hx,
        corner[1] * SIDE * mesh.hy,
        corner[2] * SIDE * mesh.hz,
        0.0,
    )


@inlined
def block_bounds(shape, mesh, corner):
    """Return the bounds, in cells from a block, of its particles that are in the mesh."""
    x, y, z = widths(shape)
    x, y, z = 0.5 * (x - 2), 0.5 * (y - 2), 0.5 * (z - 2)
    i, j, k = corner[0] * SIDE, corner[1] * SIDE, corner[2] * SIDE
    low = pack4(max(x, -1.0 * i), max(y, -1.0 * j), max(z, -1.0 * k), 0.0)
    x, y, z = (
        min(x + SIDE, 1.0 * (mesh.nx - i)),
        min(y + SIDE, 1.0 * (mesh.ny - j)),
        min(z + SIDE, 1.0 * (mesh.nz - k)),
    )
    return low, pack4(x, y, z, 0.0)


def block_walls(shape, frame, corner):
    """Return the walls for `cut_of`, in cells from a block; None for shapes that do not end."""


@overload(block_walls, jit_options=INLINED)
def _block_walls(shape, frame, corner):
    if not cuts(shape):
        return lambda shape, frame, corner: None

    def walls(shape, frame, corner):
        low, high = walls_of(frame)
        i, j, k = corner[0] * SIDE, corner[1] * SIDE, corner[2] * SIDE
        return (
            pack4(low[0] - i, low[1] - j, low[2] - k, 0.0),
            pack4(high[0] - i, high[1] - j, high[2] - k, 0.0),
        )

    return walls


@inlined
def in_block(mesh, origin, X):
    """Return a position from the first node of a block at `origin`, in cells."""
    return (X - origin) * pack4(mesh.ix, mesh.iy, mesh.iz, 0.0)


@inlined
def stencils(shape, half, walls, g, last, p):
    """Return the first node of particle p at g, in cells, at most `last`, and its stencils.

    `walls`: where shapes end, in cells, or None.
    """
    first, w = _stencil(shape, half, walls, g, last, p)
    return first, of_axis(shape, w, 0), of_axis(shape, w, 1), of_axis(shape, w, 2)


@inlined
def _stencil(shape, half, walls, g, last, p):
    x, y, z = widths(shape)
    S = pack4(1.0 * x, 1.0 * y, 1.0 * z, 1.0)
    first = min(max(truncate(g - 0.5 * (S - 2.0)), 0.0), last)
    s = g - first - 0.5 * (S - 1.0)
    return first, stencil(shape, s, half_size(half, p), cut_of(shape, walls, first))


def of_axis(shape, w, axis):
    """Return the weights and slopes of an axis: of a stencil, or those of the one node across."""


@overload(of_axis, jit_options=INLINED, prefer_literal=True)
def _of_axis(shape, w, axis):
    if across(shape) == axis.literal_value:
        return lambda shape, w, axis: (1.0, 0.0)
    return lambda shape, w, axis: along(w, axis)


@inlined
def find(here, p):
    """Return where the records of particle p begin in its tile, and its stencil of all axes.

    Sorting puts the first node in 0…3; the clamp keeps round-off, and NaN, from reaching beyond the
    tile.
    """
    g = in_block(here.mesh, here.origin, load_row(here.x, p))
    first, w = _stencil(here.shape, here.half, here.walls, g, SIDE - 1.0, p)
    # whole numbers below a million: the product in doubles is exact, and there already
    row = here.rows
    n = (lane(first, 0) * row[1] + lane(first, 1)) * row[2] + lane(first, 2)
    return int(n) * LANES, w


@inlined
def locate(here, p):
    """Return where the records of particle p begin in its tile, and its stencils along x, y, z."""
    n, w = find(here, p)
    shape = here.shape
    return n, of_axis(shape, w, 0), of_axis(shape, w, 1), of_axis(shape, w, 2)


@inlined
def deposit(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    """Add S C0 + ∂S/∂x C1 + ∂S/∂y C2 + ∂S/∂z C3 to the nodes whose records begin at n0.

    One axis after the other, so that every factor is a weight or slope of one axis: eighteen
    broadcasts for S = 3, which stay in registers.
    """
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
    for i in range(len(wx) // 2):
        X = scale(wx[i], C0)
        for j in range(len(wy) // 2):
            A = scale(wy[j], X)
            n = n0 + place(row, i, j, 0) * LANES
            for k in range(len(wz) // 2):
                at = n + k * LANES
                store(tiles, at, axpy(wz[k], A, load(tiles, at)))


@inlined
def copy_tile(nodes, above, b, row, tile):
    """Copy the node records under tile b out of the blocks that hold them."""
    I, J, K = side(row[0]), side(row[1]), side(row[2])
    for di in range(blocks_along(row[0])):
        for dj in range(blocks_along(row[1])):
            for dk in range(blocks_along(row[2])):
                block = above[b, block_of(row, di, dj, dk)] * nodes_of(row)
                i0, j0, k0 = I * di, J * dj, K * dk
                for i in range(min(I, row[0] - i0)):
                    for j in range(min(J, row[1] - j0)):
                        source = (block + inner(row, i, j, 0)) * LANES
                        at = place(row, i + i0, j + j0, k0) * LANES
                        for k in range(min(K, row[2] - k0)):
                            store(tile, at + k * LANES, load(nodes, source + k * LANES))


@inlined
def sum_tiles(tiles, below, a, row, out, first):
    """Sum the tiles over active block a, in fixed order, into the records of `out` from `first`."""
    I, J, K = side(row[0]), side(row[1]), side(row[2])
    for n in range(nodes_of(row)):
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


@inlined
def collect(tile, n0, row, wx, wy, wz):
    """Return Σ S r, and Σ ∂S/∂x r, Σ ∂S/∂y r, Σ ∂S/∂z r of four lanes of the records r."""
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
