"""Where a particle stands among the nodes of its tile, and how it shares in them."""

from numba.core import types
from numba.extending import overload

from mpmgeo.numerics import lanewise  # noqa: F401  teaches kernels the arithmetic of vectors
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import LANES, along, lane, load_row, pack4, truncate
from mpmgeo.shapes.shape import across, cut_of, cuts, stencil, widths
from mpmgeo.state.grid import walls_of
from mpmgeo.state.layout import SIDE, edge


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
    """Return the weights and slopes of a stencil along an axis, None where nothing changes."""


@overload(of_axis, jit_options=INLINED, prefer_literal=True)
def _of_axis(shape, w, axis):
    if across(shape) == axis.literal_value:
        return lambda shape, w, axis: None
    return lambda shape, w, axis: along(w, axis)


def is_across(w):
    """Tell whether numba's type of the weights of an axis says that nothing changes along it."""
    return isinstance(w, types.NoneType)


def of_one_node(w):
    """Return weights and slopes of an axis, those of the one node where nothing changes."""


@overload(of_one_node, jit_options=INLINED)
def _of_one_node(w):
    return (lambda w: (1.0, 0.0)) if is_across(w) else (lambda w: w)


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
