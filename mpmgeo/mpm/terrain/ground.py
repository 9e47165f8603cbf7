"""Distances to a surface where particles are: tiles of nodes under the blocks near it.

Distances belong to the lattice of the mesh, fixed to the ground. If the ground has moved by u,
a particle at x asks at x − u: its block's tile begins `shift` nodes beside the block, and is one
node longer than the tile of the grid, so that a part of a cell has room.

Distances of a block of nodes are computed when first needed, and kept.
"""

from math import floor

import numpy as np

from mpmgeo.boundaries.distance import FAR, fill
from mpmgeo.numerics.chunks import CHUNKS, blockwise
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, axpy, lane, load, pack4, splat
from mpmgeo.state.field import Field, Lanes
from mpmgeo.state.grid import corners_of, cut, keys_of
from mpmgeo.state.layout import NODES, SIDE, blocks_along, node_under, place, volume

CONTACT = Lanes(
    tile={"mass": (0, 1), "impulse": (1, 3)},  # of what touches, on what touches
    node={},
)


@blockwise
def assemble(c, near, begin, at, known, S, level):
    """Write the tiles of the blocks `near`.

    `begin` (blocks, 3): first node of a tile, `at` (blocks, reach³): rows of `known` that it needs.
    """
    row = SIDE + S
    wide = row + SIDE - 1
    rows, under = (row, row, row), (wide, wide, wide)  # of the tile and of all blocks under it
    for s in range(c * len(near) // CHUNKS, (c + 1) * len(near) // CHUNKS):
        b = near[s]
        o0, o1, o2 = begin[b, 0] % SIDE, begin[b, 1] % SIDE, begin[b, 2] % SIDE
        for i in range(row):
            for j in range(row):
                for k in range(row):
                    node = node_under(at, b, under, i + o0, j + o1, k + o2)
                    level[s * volume(rows) + place(rows, i, j, k)] = known[node]


@inlined
def level_at(level, n0, rows, wx, wy, wz):
    """Return Σ S d and Σ ∂S/∂x d, Σ ∂S/∂y d, Σ ∂S/∂z d over the nodes from n0 on; per cell.

    Eight nodes along z at once; `level` is as much longer than its tiles.
    """
    I, J, K = len(wx) // 2, len(wy) // 2, len(wz) // 2
    d = gx = gy = gz = 0.0
    for k0 in range(0, K, LANES):
        D = X = Y = splat(0.0)
        for i in range(I):
            a = b = splat(0.0)
            for j in range(J):
                r = load(level, n0 + place(rows, i, j, k0))
                a, b = axpy(wy[j], r, a), axpy(wy[J + j], r, b)
            D, X, Y = axpy(wx[i], a, D), axpy(wx[I + i], a, X), axpy(wx[i], b, Y)
        for k in range(k0, min(K, k0 + LANES)):
            d += wz[k] * lane(D, k - k0)
            gz += wz[K + k] * lane(D, k - k0)
            gx += wz[k] * lane(X, k - k0)
            gy += wz[k] * lane(Y, k - k0)
    return d, gx, gy, gz


@inlined
def tile_origin(mesh, corner, shift):
    """Return the position of the first node of the tile of distances of a block."""
    return pack4(
        (corner[0] * SIDE + shift[0]) * mesh.hx,
        (corner[1] * SIDE + shift[1]) * mesh.hy,
        (corner[2] * SIDE + shift[2]) * mesh.hz,
        0.0,
    )


class NearGround:
    """Which blocks of a grid are near the ground, and the distances under them.

    near (k,): owner blocks; chunk: bounds of their chunks; level: their tiles of distances; active
    (a,): blocks of nodes under their tiles; below (a, ·): tiles over each of these; touched (k,):
    whether anything touches in a block; field: that of contact.
    """

    def __init__(self, ground, mesh, width, reach):
        self.ground, self.mesh, self.width, self.reach = ground, mesh, width, reach
        cell = np.array([mesh.hx, mesh.hy, mesh.hz])
        self.cell = cell
        self.band = reach + 0.5 * width * float(np.linalg.norm(cell))
        self.field = Field(CONTACT, has_nodes=False)
        self.shift = (0, 0, 0)
        self._owners = None  # keys of the grid's owner blocks for which this was arranged
        self._keys = np.empty(0, np.int64)  # blocks whose distances are known, ascending
        self._known = np.empty((0, NODES))

    def is_old(self, grid, offset):
        """Tell whether the grid or the ground have changed since this was arranged."""
        return grid.keys is not self._owners or self._shift(offset) != self.shift

    def _shift(self, offset):
        return tuple(floor(-u / h) for u, h in zip(offset, self.cell, strict=True))

    def arrange(self, grid, offset, crew):
        """Follow the blocks of the grid, and the ground that has moved by `offset` (3,) [m]."""
        if not self.is_old(grid, offset):
            return
        shift = self._shift(offset)
        self._owners, self.shift = grid.keys, shift
        begin = grid.corner * SIDE + np.array(shift)
        reach = blocks_along(2 * SIDE + self.width - 1)
        steps = np.stack(np.meshgrid(*3 * [np.arange(reach)], indexing="ij"), -1).reshape(-1, 3)
        corner = begin[:, None] // SIDE + steps
        at = self._find(corner, crew)
        is_near = np.abs(self._known).min(axis=1, initial=FAR) <= self.band
        near = np.flatnonzero(is_near[at].any(axis=1)) if len(at) else np.empty(0, np.int64)
        row, S = SIDE + self.width, self.width
        level = np.empty(len(near) * row**3)
        assemble(crew, near, begin, at, self._known.ravel(), S, level)
        self._keep_low(grid, near, level.reshape(len(near), row**3))

    def _keep_low(self, grid, near, level):
        """Keep the blocks in which a particle can be within reach of the ground."""
        low = level.min(axis=1, initial=FAR) <= self.reach
        self.near = near[low]
        self.level = np.append(level[low], np.zeros(LANES))
        self.chunk = cut(np.arange(len(self.near) + 1))
        self.active = np.unique(grid.above[self.near])
        self.corner = grid.corner[self.near]
        self.above = grid.above[self.near]
        self.nodes_chunk = cut(np.arange(len(self.active) + 1))
        self.nodes_corner = grid.active_corner[self.active]
        number = np.full(len(grid.keys) + 1, -1)
        number[self.near] = np.arange(len(self.near))
        self.below = self._below = number[grid.below[self.active]]
        self.touched = np.zeros(len(self.near), np.int64)
        self.field.fit(len(self.near), grid.rows, len(self.active))

    def gather_touched(self):
        """Let `below` show the tiles of blocks in which anything touches alone; return it."""
        touched = np.append(self.touched, 0)
        self.below = np.where(touched[self._below], self._below, -1)
        return self.below

    def place(self, s):
        """Return where a set's particles of the blocks near the ground are, for loops."""
        return self.chunk, s.start[self.near], s.start[self.near + 1], self.corner

    def _find(self, corner, crew):
        """Return the rows of the known distances of blocks (n, m, 3), computing what is missing."""
        keys = keys_of(corner)
        fresh = np.setdiff1d(keys, self._keys)
        if len(fresh):
            values = np.empty((len(fresh), NODES))
            fill(crew, self.ground, self.mesh, self.band, corners_of(fresh), values)
            order = np.argsort(np.concatenate([self._keys, fresh]), kind="stable")
            self._keys = np.concatenate([self._keys, fresh])[order]
            self._known = np.concatenate([self._known, values])[order]
        return np.searchsorted(self._keys, keys)
