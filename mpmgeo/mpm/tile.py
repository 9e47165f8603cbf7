"""One particle and the tile of its block: find its nodes, add to them, read from them."""

from numba.extending import overload

from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, axpy, load, scale, splat, store
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import SIDE


def half_size(half, p):
    """Return the half-sizes of particle p in cells: `half` is one triple for all, or a row each."""
    return half if isinstance(half, tuple) else tuple(half[p])


@overload(half_size, jit_options={"forceinline": True})
def _half_size(half, p):
    if hasattr(half, "ndim"):
        return lambda half, p: (half[p, 0], half[p, 1], half[p, 2])
    return lambda half, p: half


@inlined
def _first(g, reach):
    """Return the first node of a particle, g its position in the block in cells.

    Sorting puts it in 0…3; the clamp keeps round-off, and NaN, from reaching beyond the tile.
    """
    return min(max(int(g - reach), 0), SIDE - 1)


@inlined
def _in_block(mesh, corner, b, x, p):
    """Return the position of particle p from the first node of block b, in cells."""
    gx = (x[p, 0] - (mesh.ox + corner[b, 0] * SIDE * mesh.hx)) * mesh.ix
    gy = (x[p, 1] - (mesh.oy + corner[b, 1] * SIDE * mesh.hy)) * mesh.iy
    gz = (x[p, 2] - (mesh.oz + corner[b, 2] * SIDE * mesh.hz)) * mesh.iz
    return gx, gy, gz


@inlined
def locate(shape, mesh, corner, b, half, x, p):
    """Return where the records of particle p begin in its tile, and its stencils along x, y, z."""
    S = width(shape)
    row = SIDE + S - 1
    gx, gy, gz = _in_block(mesh, corner, b, x, p)
    reach, middle = 0.5 * (S - 2), 0.5 * (S - 1)
    i, j, k = _first(gx, reach), _first(gy, reach), _first(gz, reach)
    lx, ly, lz = half_size(half, p)
    wx = stencil(shape, gx - i - middle, lx)
    wy = stencil(shape, gy - j - middle, ly)
    wz = stencil(shape, gz - k - middle, lz)
    return ((i * row + j) * row + k) * LANES, wx, wy, wz


@inlined
def _within(g, reach, corner, cells):
    low, high = max(reach, -1.0 * corner * SIDE), min(reach + SIDE, 1.0 * (cells - corner * SIDE))
    return g >= low and g <= high


@inlined
def inside(shape, mesh, corner, b, x, p):
    """Tell whether particle p is still in the mesh and the first of its nodes still in block b."""
    reach = 0.5 * (width(shape) - 2)
    gx, gy, gz = _in_block(mesh, corner, b, x, p)
    return (
        _within(gx, reach, corner[b, 0], mesh.nx)
        and _within(gy, reach, corner[b, 1], mesh.ny)
        and _within(gz, reach, corner[b, 2], mesh.nz)
    )


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
    """Return Σ S r, Σ ∂S/∂x r, Σ ∂S/∂y r and Σ ∂S/∂z r over the node records r from n0 on."""
    S = len(wx) // 2
    value, sx, sy, sz = splat(0.0), splat(0.0), splat(0.0), splat(0.0)
    for i in range(S):
        a, b, c = splat(0.0), splat(0.0), splat(0.0)
        for j in range(S):
            n = n0 + (i * row + j) * row * LANES
            record = load(tile, n)
            r, q = scale(wz[0], record), scale(wz[S], record)
            for k in range(1, S):
                record = load(tile, n + k * LANES)
                r, q = axpy(wz[k], record, r), axpy(wz[S + k], record, q)
            a, b, c = axpy(wy[j], r, a), axpy(wy[S + j], r, b), axpy(wy[j], q, c)
        value, sx = axpy(wx[i], a, value), axpy(wx[S + i], a, sx)
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
