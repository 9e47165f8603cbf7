"""Keep particles sorted by block, moving only those that must move.

When particles change blocks, the blocks' ranges shift a little. A particle whose place still lies
in its block's new range stays; the others, in order, fill the places that are free. The order
depends on nothing but the particles, so results are the same for any number of threads.

A particle near a wall follows nodes that the wall does not hold, too, and may pass it by a little.
It is put back before it is counted as outside the mesh.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.chunks import CHUNKS, blockwise
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.state.grid import KEY_BITS, KEY_SHIFT, cut

INSET = 1e-9  # cells: how far from a wall that it passed a particle is put back
FEW = 20_000  # particles up to which moving them costs less than waking threads
OUTSIDE = -1
UNKNOWN = -2  # UNKNOWN − key: the block with this key is not in the table


class Walls(NamedTuple):
    """Which planes of the mesh particles do not pass."""

    x0: bool = False
    y0: bool = False
    z0: bool = False
    xn: bool = False
    yn: bool = False
    zn: bool = False


OPEN = Walls()


@inlined
def _between(x, cell, cells, lower, upper):
    """Return a coordinate, or a place just within the wall that it passed."""
    if lower and x < 0.0:
        return INSET * cell
    if upper and x > cells * cell:
        return (cells - INSET) * cell
    return x


@inlined
def _corner(x, inverse, cells, reach):
    """Return the block corner along an axis, −KEY_SHIFT outside the mesh or for NaN."""
    g = x * inverse
    if not (g >= 0.0 and g <= cells):
        return -KEY_SHIFT
    return int(np.floor(g - reach)) >> 2


@inlined
def _index(keys, key):
    """Return the place of `key` in the sorted table, or UNKNOWN − key."""
    low, high = 0, len(keys)
    while low < high:
        middle = (low + high) >> 1
        if keys[middle] < key:
            low = middle + 1
        else:
            high = middle
    return low if low < len(keys) and keys[low] == key else UNKNOWN - key


@inlined
def _corners(mesh, reach, x, p):
    """Return the block corner of a particle's first node; see `_corner`."""
    i = _corner(x[p, 0], mesh.ix, mesh.nx, reach[0])
    j = _corner(x[p, 1], mesh.iy, mesh.ny, reach[1])
    k = _corner(x[p, 2], mesh.iz, mesh.nz, reach[2])
    return i, j, k


@blockwise
def locate(c, mesh, walls, reach, chunk, start, keys, x, target):
    """Write the block of each particle: its place in `keys`, OUTSIDE, or UNKNOWN − key.

    Particles that passed one of the `walls` are put back.
    """
    for b in range(chunk[c], chunk[c + 1]):
        for p in range(start[b], start[b + 1]):
            i, j, k = _corners(mesh, reach, x, p)
            if min(i, j, k) == -KEY_SHIFT:
                w = walls
                x[p, 0] = _between(x[p, 0], mesh.hx, mesh.nx, w.x0, w.xn)
                x[p, 1] = _between(x[p, 1], mesh.hy, mesh.ny, w.y0, w.yn)
                x[p, 2] = _between(x[p, 2], mesh.hz, mesh.nz, w.z0, w.zn)
                i, j, k = _corners(mesh, reach, x, p)
            if min(i, j, k) == -KEY_SHIFT:
                target[p] = OUTSIDE
                continue
            i, j, k = i + KEY_SHIFT, j + KEY_SHIFT, k + KEY_SHIFT
            key = (i << 2 * KEY_BITS) | (j << KEY_BITS) | k
            if b < len(keys) and keys[b] == key:
                target[p] = b
            else:
                target[p] = _index(keys, key)


@compiled
def count(target, blocks):
    """Return how many particles each block gets, and at the end how many are outside."""
    counts = np.zeros(blocks + 1, np.int64)
    for t in target:
        counts[t if t >= 0 else blocks] += 1
    return counts


@compiled
def assign(target, start, places, origin):
    """List the places whose particle must move, and which of them each one's new particle is in.

    The particle in `places[origin[i]]` goes to `places[i]`. Returns how many move.
    """
    blocks = len(start) - 2
    free = np.empty(blocks + 1, np.int64)
    moves = 0
    for b in range(blocks + 1):
        free[b] = moves
        for p in range(start[b], start[b + 1]):
            t = target[p]
            if (t if t >= 0 else blocks) != b:
                places[moves] = p
                moves += 1
    for i in range(moves):
        t = target[places[i]]
        b = t if t >= 0 else blocks
        origin[free[b]] = i
        free[b] += 1
    return moves


@compiled
def permute(a, places, origin, rows):
    """Move row `places[origin[i]]` of a to row `places[i]`, by way of `rows`."""
    for i in range(len(origin)):
        for column in range(a.shape[1]):
            rows[i, column] = a[places[origin[i]], column]
    for i in range(len(origin)):
        for column in range(a.shape[1]):
            a[places[i], column] = rows[i, column]


@blockwise
def take(c, a, places, origin, rows):
    """Copy row `places[origin[i]]` of a to row i of `rows`."""
    for i in range(c * len(origin) // CHUNKS, (c + 1) * len(origin) // CHUNKS):
        for column in range(a.shape[1]):
            rows[i, column] = a[places[origin[i]], column]


@blockwise
def put(c, a, places, rows):
    """Copy row i of `rows` to row `places[i]` of a."""
    for i in range(c * len(places) // CHUNKS, (c + 1) * len(places) // CHUNKS):
        for column in range(a.shape[1]):
            a[places[i], column] = rows[i, column]


def _rows(a):
    """Return an array of any eight-byte type as rows of doubles, so that one kernel serves all."""
    return a.reshape(len(a), -1).view(np.float64)


def _add_blocks(grid, sets, targets):
    """Put the missing blocks in the table, drop the empty ones, renumber the targets."""
    missing = [UNKNOWN - t[t <= UNKNOWN] for t in targets]
    used = np.zeros(len(grid.keys), bool)
    for t in targets:
        used[t[t >= 0]] = True
    old = grid.keys
    keys = np.unique(np.concatenate([old[used], *missing]))
    renumber = np.searchsorted(keys, old)
    for t, new in zip(targets, missing, strict=True):
        unknown = t <= UNKNOWN
        inside = t >= 0
        t[inside] = renumber[t[inside]]
        t[unknown] = np.searchsorted(keys, new)
    grid.cover(keys)


def sort(grid, sets, crew, walls=OPEN):
    """Sort all particle sets by block after some particle left its block.

    `walls`: planes through which no particle leaves the mesh.

    Returns for each set how many particles left the mesh just now; they stand directly behind
    `start[-1]` from then on. The grid's blocks are renewed when particles reached new ones.
    """
    reach = tuple(0.5 * (width - 2) for width in grid.widths)
    targets = []
    for s in sets:
        target = np.empty(s.active, np.int64)
        locate(crew, grid.seen, walls, reach, s.chunk, s.start, grid.keys, s.x, target)
        targets.append(target)
    if any(len(t) and t.min() <= UNKNOWN for t in targets):
        _add_blocks(grid, sets, targets)
    left = []
    for s, target in zip(sets, targets, strict=True):
        counts = count(target, len(grid.keys))
        start = np.concatenate([[0], np.cumsum(counts)])
        places, origin = np.empty((2, len(target)), np.int64)
        moves = assign(target, start, places, origin)
        places, origin = places[:moves], origin[:moves]
        if moves:
            rows = np.empty(moves * 6)
            for a in map(_rows, s.arrays().values()):
                width = a.shape[1]
                if moves * width > rows.size:
                    rows = np.empty(moves * width)
                moved = rows[: moves * width].reshape(moves, width)
                if moves <= FEW:
                    permute(a, places, origin, moved)
                else:
                    take(crew, a, places, origin, moved)
                    put(crew, a, places, moved)
        s.start = start[:-1]
        s.chunk = cut(s.start)
        s.lie_in(grid)
        left.append(int(counts[-1]))
    return left
