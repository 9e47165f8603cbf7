"""One particle and the tile of its block: find its nodes, add to them, read from them."""

from numba.extending import overload

from mpmgeo.numerics import lanewise  # noqa: F401  teaches kernels the arithmetic of vectors
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import (
    LANES,
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
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import SIDE


def half_size(half, p):
    """Return the half-sizes of particle p in cells: `half` is one triple for all, or a row each."""
    return half if isinstance(half, tuple) else tuple(half[p])


@overload(half_size, jit_options={"forceinline": True})
def _half_size(half, p):
    # the fourth lane is no axis; it must not divide by zero
    if hasattr(half, "ndim"):
        return lambda half, p: pack4(half[p, 0], half[p, 1], half[p, 2], 0.5)
    return lambda half, p: pack4(half[0], half[1], half[2], 0.5)


@inlined
def block_origin(mesh, corner, b):
    """Return the position of the first node of block b."""
    return pack4(
        corner[b, 0] * SIDE * mesh.hx,
        corner[b, 1] * SIDE * mesh.hy,
        corner[b, 2] * SIDE * mesh.hz,
        0.0,
    )


@inlined
def block_bounds(shape, mesh, corner, b):
    """Return the bounds, in cells from block b, of its particles that are in the mesh."""
    reach = 0.5 * (width(shape) - 2)
    i, j, k = corner[b, 0] * SIDE, corner[b, 1] * SIDE, corner[b, 2] * SIDE
    low = pack4(max(reach, -1.0 * i), max(reach, -1.0 * j), max(reach, -1.0 * k), 0.0)
    x, y, z = (
        min(reach + SIDE, 1.0 * (mesh.nx - i)),
        min(reach + SIDE, 1.0 * (mesh.ny - j)),
        min(reach + SIDE, 1.0 * (mesh.nz - k)),
    )
    return low, pack4(x, y, z, 0.0)


@inlined
def in_block(mesh, origin, X):
    """Return a position from the first node of a block at `origin`, in cells."""
    return (X - origin) * pack4(mesh.ix, mesh.iy, mesh.iz, 0.0)


@inlined
def locate(shape, mesh, origin, half, x, p):
    """Return where the records of particle p begin in its tile, and its stencils along x, y, z.

    Sorting puts the first node in 0…3; the clamp keeps round-off, and NaN, from reaching beyond the
    tile.
    """
    S = width(shape)
    row = SIDE + S - 1
    g = in_block(mesh, origin, load_row(x, p))
    first = min(max(truncate(g - 0.5 * (S - 2)), 0.0), SIDE - 1.0)
    w = stencil(shape, g - first - 0.5 * (S - 1), half_size(half, p))
    n = (lane(first, 0) * row + lane(first, 1)) * row + lane(first, 2)
    return int(n) * LANES, along(w, 0), along(w, 1), along(w, 2)


@inlined
def deposit(tiles, n0, row, wx, wy, wz, C0, C1, C2, C3):
    """Add S C0 + ∂S/∂x C1 + ∂S/∂y C2 + ∂S/∂z C3 to the nodes whose records begin at n0.

    One axis after the other, so that every factor is a weight or slope of one axis: eighteen
    broadcasts for S = 3, which stay in registers.
    """
    S = len(wx) // 2
    for i in range(S):
        X = axpy(wx[S + i], C1, scale(wx[i], C0))
        Y = scale(wx[i], C2)
        Z = scale(wx[i], C3)
        for j in range(S):
            A = axpy(wy[S + j], Y, scale(wy[j], X))
            B = scale(wy[j], Z)
            n = n0 + (i * row + j) * row * LANES
            for k in range(S):
                at = n + k * LANES
                store(tiles, at, axpy(wz[S + k], B, axpy(wz[k], A, load(tiles, at))))


@inlined
def deposit_value(tiles, n0, row, wx, wy, wz, C0):
    """Add S C0 to the nodes whose records begin at n0."""
    S = len(wx) // 2
    for i in range(S):
        X = scale(wx[i], C0)
        for j in range(S):
            A = scale(wy[j], X)
            n = n0 + (i * row + j) * row * LANES
            for k in range(S):
                at = n + k * LANES
                store(tiles, at, axpy(wz[k], A, load(tiles, at)))


@inlined
def copy_tile(nodes, above, b, row, tile):
    """Copy the node records under tile b out of the blocks that hold them."""
    reach = (row + SIDE - 1) // SIDE
    for di in range(reach):
        for dj in range(reach):
            for dk in range(reach):
                block = above[b, (di * reach + dj) * reach + dk] * SIDE**3
                i0, j0, k0 = SIDE * di, SIDE * dj, SIDE * dk
                for i in range(min(SIDE, row - i0)):
                    for j in range(min(SIDE, row - j0)):
                        source = (block + (i * SIDE + j) * SIDE) * LANES
                        at = (((i + i0) * row + j + j0) * row + k0) * LANES
                        for k in range(min(SIDE, row - k0)):
                            store(tile, at + k * LANES, load(nodes, source + k * LANES))


@inlined
def collect(tile, n0, row, wx, wy, wz):
    """Return Σ S r, and Σ ∂S/∂x r, Σ ∂S/∂y r, Σ ∂S/∂z r of four lanes of the records r."""
    S = len(wx) // 2
    value = splat(0.0)
    sx = sy = sz = pack4(0.0, 0.0, 0.0, 0.0)
    for i in range(S):
        a = splat(0.0)
        b = c = pack4(0.0, 0.0, 0.0, 0.0)
        for j in range(S):
            n = n0 + (i * row + j) * row * LANES
            record = load(tile, n)
            r, q = scale(wz[0], record), scale(wz[S], quarter(record, 0))
            for k in range(1, S):
                record = load(tile, n + k * LANES)
                r, q = axpy(wz[k], record, r), axpy(wz[S + k], quarter(record, 0), q)
            a, b, c = axpy(wy[j], r, a), axpy(wy[S + j], quarter(r, 0), b), axpy(wy[j], q, c)
        value, sx = axpy(wx[i], a, value), axpy(wx[S + i], quarter(a, 0), sx)
        sy, sz = axpy(wx[i], b, sy), axpy(wx[i], c, sz)
    return value, sx, sy, sz


@inlined
def collect_value(tile, n0, row, wx, wy, wz):
    """Return Σ S r over the node records r from n0 on."""
    S = len(wx) // 2
    value = splat(0.0)
    for i in range(S):
        a = splat(0.0)
        for j in range(S):
            n = n0 + (i * row + j) * row * LANES
            r = scale(wz[0], load(tile, n))
            for k in range(1, S):
                r = axpy(wz[k], load(tile, n + k * LANES), r)
            a = axpy(wy[j], r, a)
        value = axpy(wx[i], a, value)
    return value
