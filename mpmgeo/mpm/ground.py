"""Distances to a surface where particles are: tiles of nodes under the blocks near it.

Distances belong to the lattice of the mesh, fixed to the ground. If the ground has moved by u,
a particle at x asks at x − u: its block's tile begins `shift` nodes beside the block, and is one
node longer than the tile of the grid, so that a part of a cell has room.

Distances of a block of nodes are computed when first needed, and kept.
"""

from math import floor

import numpy as np
from numba import prange

from mpmgeo.boundaries.distance import FAR, fill
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, axpy, lane, load, pack4, splat
from mpmgeo.state.grid import CHUNKS, NODES, SIDE, corners_of, cut, keys_of


@blockwise
def assemble(near, begin, at, reach, known, S, level):
    """Write the tiles of the blocks `near`.

    `begin` (blocks, 3): first node of a tile, `at` (blocks, reach³): rows of `known` that it needs.
    """
    row = SIDE + S
    for c in prange(CHUNKS):
        for s in range(c * len(near) // CHUNKS, (c + 1) * len(near) // CHUNKS):
            b = near[s]
            o0, o1, o2 = begin[b, 0] % SIDE, begin[b, 1] % SIDE, begin[b, 2] % SIDE
            for i in range(row):
                for j in range(row):
                    for k in range(row):
                        I, J, K = i + o0, j + o1, k + o2
                        block = at[b, (I // SIDE * reach + J // SIDE) * reach + K // SIDE]
                        inner = (I % SIDE * SIDE + J % SIDE) * SIDE + K % SIDE
                        level[((s * row + i) * row + j) * row + k] = known[block, inner]


@inlined
def level_at(level, n0, row, wx, wy, wz):
    """Return Σ S d and Σ ∂S/∂x d, Σ ∂S/∂y d, Σ ∂S/∂z d over the nodes from n0 on; per cell.

    Eight nodes along z at once; `level` is as much longer than its tiles.
    """
    S = len(wx) // 2
    d = gx = gy = gz = 0.0
    for k0 in range(0, S, LANES):
        D = X = Y = splat(0.0)
        for i in range(S):
            a = b = splat(0.0)
            for j in range(S):
                r = load(level, n0 + (i * row + j) * row + k0)
                a, b = axpy(wy[j], r, a), axpy(wy[S + j], r, b)
            D, X, Y = axpy(wx[i], a, D), axpy(wx[S + i], a, X), axpy(wx[i], b, Y)
        for k in range(k0, min(S, k0 + LANES)):
            d += wz[k] * lane(D, k - k0)
            gz += wz[S + k] * lane(D, k - k0)
            gx += wz[k] * lane(X, k - k0)
            gy += wz[k] * lane(Y, k - k0)
    return d, gx, gy, gz


@inlined
def tile_origin(mesh, corner, b, shift):
    """Return the position of the first node of the tile of distances of block b."""
    return pack4(
        (corner[b, 0] * SIDE + shift[0]) * mesh.hx,
        (corner[b, 1] * SIDE + shift[1]) * mesh.hy,
        (corner[b, 2] * SIDE + shift[2]) * mesh.hz,
        0.0,
    )


class NearGround:
    """Which blocks of a grid are near the ground, and the distances under them.

    near (k,): owner blocks; chunk: bounds of their chunks; level: their tiles; active
    (a,): blocks of nodes under their tiles; around (k, ·), below (a, ·): as the grid's above and
    below, but with places in `active` and `near`.
    """

    def __init__(self, ground, mesh, width, reach):
        self.ground, self.mesh, self.width, self.reach = ground, mesh, width, reach
        cell = np.array([mesh.hx, mesh.hy, mesh.hz])
        self.cell = cell
        self.band = reach + 0.5 * width * float(np.linalg.norm(cell))
        self.shift = (0, 0, 0)
        self._owners = None  # keys of the grid's owner blocks for which this was arranged
        self._keys = np.empty(0, np.int64)  # blocks whose distances are known, ascending
        self._known = np.empty((0, NODES))

    def is_old(self, grid, offset):
        """Tell whether the grid or the ground have changed since this was arranged."""
        return grid.keys is not self._owners or self._shift(offset) != self.shift

    def _shift(self, offset):
        return tuple(floor(-u / h) for u, h in zip(offset, self.cell, strict=True))

    def arrange(self, grid, offset, serial):
        """Follow the blocks of the grid, and the ground that has moved by `offset` (3,) [m]."""
        if not self.is_old(grid, offset):
            return
        shift = self._shift(offset)
        self._owners, self.shift = grid.keys, shift
        begin = grid.corner * SIDE + np.array(shift)
        reach = (SIDE + self.width + SIDE - 2) // SIDE + 1
        steps = np.stack(np.meshgrid(*3 * [np.arange(reach)], indexing="ij"), -1).reshape(-1, 3)
        corner = begin[:, None] // SIDE + steps
        at = self._find(corner, serial)
        is_near = np.abs(self._known).min(axis=1, initial=FAR) <= self.band
        near = np.flatnonzero(is_near[at].any(axis=1)) if len(at) else np.empty(0, np.int64)
        row, S = SIDE + self.width, self.width
        level = np.empty(len(near) * row**3)
        run = assemble.serial if serial else assemble
        run(near, begin, at, reach, self._known, S, level)
        self._keep_low(grid, near, level.reshape(len(near), row**3))

    def _keep_low(self, grid, near, level):
        """Keep the blocks in which a particle can be within reach of the ground."""
        low = level.min(axis=1, initial=FAR) <= self.reach
        self.near = near[low]
        self.level = np.append(level[low], np.zeros(LANES))
        self.chunk = cut(np.arange(len(self.near) + 1))
        self.active = np.unique(grid.above[self.near])
        self.nodes_chunk = cut(np.arange(len(self.active) + 1))
        self.around = np.searchsorted(self.active, grid.above[self.near])
        place = np.full(len(grid.keys) + 1, -1)
        place[self.near] = np.arange(len(self.near))
        self.below = place[grid.below[self.active]]

    def _find(self, corner, serial):
        """Return the rows of the known distances of blocks (n, m, 3), computing what is missing."""
        keys = keys_of(corner)
        fresh = np.setdiff1d(keys, self._keys)
        if len(fresh):
            values = np.empty((len(fresh), NODES))
            run = fill.serial if serial else fill
            run(self.ground, self.mesh, self.band, corners_of(fresh), values)
            order = np.argsort(np.concatenate([self._keys, fresh]), kind="stable")
            self._keys = np.concatenate([self._keys, fresh])[order]
            self._known = np.concatenate([self._known, values])[order]
        return np.searchsorted(self._keys, keys)
