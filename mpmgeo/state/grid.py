"""The background grid: blocks of 4³ nodes, of which only those exist that particles reach.

Coordinates are those of the mesh: node index I is at I·cell. Ghost layers have negative indices and
need no storage of their own. A block is named by its *corner* c = I >> 2 per axis and by the key of
that corner, sortable and unique. *Owner* blocks hold particles and own a tile; *active* blocks hold
nodes under a tile.

    above[b, o]   active block that lies o blocks up from owner b   (o = 0 is the owner itself)
    below[a, o]   owner whose tile covers active block a from o blocks down, or −1
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.chunks import CHUNKS
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, aligned
from mpmgeo.state.checked import array_from, demand
from mpmgeo.state.field import Field, Lanes
from mpmgeo.state.layout import SIDE, blocks_along, edge, nodes, side, volume

SOLID = Lanes(
    tile={"mass": (0, 1), "momentum": (1, 3), "force": (4, 3), "mass of tools": (7, 1)},
    node={"velocity": (0, 3), "acceleration": (3, 3), "mass": (6, 1), "part that touches": (7, 1)},
)

NO_WALLS = (*3 * (-np.inf,), *3 * (np.inf,))
KEY_BITS = 21
KEY_SHIFT = 1 << (KEY_BITS - 1)


class Mesh(NamedTuple):
    """Symbols of the mesh for kernels: cell sizes [m], their inverses, cell counts."""

    hx: float
    hy: float
    hz: float
    ix: float
    iy: float
    iz: float
    nx: int
    ny: int
    nz: int

    @classmethod
    def of(cls, cell, cells):
        """Return the symbols of a mesh of `cells` cells of size `cell` [m]."""
        inverse = [1.0 / h for h in cell]
        return cls(*map(float, cell), *inverse, *map(int, cells))


@inlined
def mesh_of(frame):
    """Return the symbols of the mesh whose numbers an array begins with, in their order.

    A call from Python passes an array in a tenth of the time of a NamedTuple of nine numbers.
    """
    h, i, n = frame[:3], frame[3:6], frame[6:9]
    return Mesh(h[0], h[1], h[2], i[0], i[1], i[2], int(n[0]), int(n[1]), int(n[2]))


@inlined
def walls_of(frame):
    """Return where shapes end below and above, in cells, infinitely far away where they do not."""
    return frame[9:12], frame[12:15]


def keys_of(corner):
    """Return the keys (n,) of block corners (n, 3)."""
    c = np.asarray(corner, np.int64) + KEY_SHIFT
    return (c[..., 0] << 2 * KEY_BITS) | (c[..., 1] << KEY_BITS) | c[..., 2]


def corners_of(keys):
    """Return the corners (n, 3) of block keys (n,)."""
    mask = (1 << KEY_BITS) - 1
    parts = [keys >> 2 * KEY_BITS, keys >> KEY_BITS & mask, keys & mask]
    return np.stack(parts, axis=-1) - KEY_SHIFT


def nodes_of(corner, sides=3 * (SIDE,)):
    """Return the node indices (n, nodes of a block, 3) of blocks of a corner (n, 3)."""
    return corner[:, None] * SIDE + steps(sides)


def steps(counts):
    """Return all steps (n, 3) of less than so many along each axis, those along z first."""
    return np.array(list(np.ndindex(*counts)))


def _find(table, keys):
    """Return the position of each key in the sorted table, −1 where it is not there."""
    at = np.minimum(np.searchsorted(table, keys), len(table) - 1)
    return np.where(table[at] == keys, at, -1)


class Grid:
    """Blocks and the field of the solid for a shape's widths; `cover` puts them at the particles.

    `widths`: nodes that the shape reaches along each axis. `seen`: the mesh as kernels see it.
    """

    def __init__(self, mesh: Mesh, widths: tuple[int, int, int], seen: Mesh | None = None):
        self.mesh = mesh
        self.seen = mesh if seen is None else seen
        self.frame = np.array((*self.seen, *NO_WALLS))  # for `mesh_of` and `walls_of`
        self.widths = widths
        self.rows = tuple(map(edge, widths))  # nodes along a tile's edges
        self.sides = tuple(map(side, self.rows))  # nodes along a block's edges
        self.record = volume(self.rows) * LANES
        self.reach = tuple(map(blocks_along, self.rows))  # blocks along axes a tile lies over
        self._steps = steps(self.reach)
        self.keys = self.active = np.empty(0, np.int64)
        self.solid = Field(SOLID)
        self.solid.fit(0, self.rows, 0)
        self.scratch = aligned(CHUNKS * self.record)  # a tile for each chunk of a loop
        self.cover(self.keys)

    def cover(self, keys):
        """Make the sorted `keys` the owner blocks and find the active blocks around them."""
        old, records = self.active, self.records().copy()
        self.keys = keys
        self.corner = corners_of(keys)
        reached = keys_of(self.corner[:, None] + self._steps)
        self.active = np.unique(reached)
        self.active_corner = corners_of(self.active)
        self.above = np.searchsorted(self.active, reached)
        if len(keys):
            self.below = _find(keys, keys_of(self.active_corner[:, None] - self._steps))
        else:
            self.below = np.empty((0, len(self._steps)), np.int64)
        self.solid.fit(len(keys), self.rows, len(self.active))
        self.nodes[:] = 0.0
        _, now, before = np.intersect1d(self.active, old, return_indices=True)
        self.records()[now] = records[before]  # the last velocities, which damping may ask for
        self.chunk = cut(np.arange(len(self.active) + 1))

    def end_at(self, walls):
        """Let shapes that end at walls end at those planes, for which `walls` (6,) are true."""
        planes = (0, 0, 0, self.mesh.nx, self.mesh.ny, self.mesh.nz)
        self.frame[9:] = np.where(walls, planes, NO_WALLS)

    @property
    def tiles(self):
        """Return the tiles of the solid."""
        return self.solid.tiles

    @property
    def nodes(self):
        """Return the nodes of the solid."""
        return self.solid.nodes

    def records(self):
        """Return the node records of the active blocks, shape (blocks, nodes of a block, 8)."""
        return self.solid.records()

    def indices(self):
        """Return the node indices of the active blocks, shape (blocks, nodes of a block, 3)."""
        return nodes_of(self.active_corner, self.sides)

    def held(self):
        """Return what a run that goes on needs of the grid, by name."""
        return {"keys": self.keys, "records": self.records()}

    def take(self, state):
        """Go on with what `held` once returned; ValueError for blocks that cannot be."""
        keys = array_from(state, "keys", self.keys.dtype, (None,))
        shape = self.blocks_under(keys), nodes(self.rows), LANES
        records = array_from(state, "records", np.float64, shape)
        self.cover(keys.copy())
        np.copyto(self.records(), records)

    def blocks_under(self, keys):
        """Return how many blocks lie under the tiles of owners; ValueError if these cannot be."""
        demand((keys[1:] > keys[:-1]).all(), "keys are not in order")
        corner = corners_of(keys)
        last = np.array([self.mesh.nx, self.mesh.ny, self.mesh.nz]) // SIDE
        inside = ((corner >= -np.array(self.reach)) & (corner <= last)).all()
        demand(inside and (keys >= 0).all(), "keys name blocks outside the mesh")
        return len(np.unique(keys_of(corner[:, None] + self._steps)))

    def nbytes(self):
        """Return the memory of all arrays [bytes]."""
        arrays = (self.tiles, self.nodes, self.scratch, self.above, self.below, self.corner)
        return sum(a.nbytes for a in (*arrays, self.active_corner, self.keys, self.active))


def cut(start):
    """Cut blocks into CHUNKS pieces of equal work; `start` (blocks + 1,) is the work before each.

    Returns the first block of each piece and, last, the number of blocks.
    """
    share = np.linspace(0, start[-1], CHUNKS + 1)
    bounds = np.searchsorted(start, share)
    bounds[0], bounds[-1] = 0, len(start) - 1
    return bounds
