"""A field of nodes: records of eight doubles in blocks, and tiles that particles fill.

What the eight lanes of a record mean belongs to the field; kernels know it, others ask by name.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.simd import LANES, aligned
from mpmgeo.state.layout import nodes, volume


class Lanes(NamedTuple):
    """Names of the quantities in a record, each with its first lane and how many it takes."""

    tile: dict[str, tuple[int, int]]
    node: dict[str, tuple[int, int]]


class Field:
    """Tiles and nodes of a quantity that particles and grid exchange; see `Lanes` for their lanes.

    `has_nodes`: whether what the tiles hold is summed to records that are kept.
    """

    def __init__(self, lanes: Lanes, has_nodes: bool = True):
        self.lanes = lanes
        self.has_nodes = has_nodes
        self.tiles = self.nodes = aligned(0)
        self.blocks = self.count = 0

    def fit(self, tiles: int, rows: tuple[int, int, int], blocks: int):
        """Make room for so many tiles with `rows` of nodes, and for the nodes of so many blocks."""
        self.tiles = room(self.tiles, tiles * volume(rows))
        self.blocks, self.count = blocks, nodes(rows)
        if self.has_nodes:
            self.nodes = room(self.nodes, blocks * self.count)

    def records(self) -> np.ndarray:
        """Return the records of the nodes, shape (blocks, nodes of a block, 8)."""
        shape = self.blocks, self.count, LANES
        return self.nodes[: self.blocks * self.count * LANES].reshape(shape)

    def at_nodes(self, name: str) -> np.ndarray:
        """Return a quantity of the nodes, (nodes of all blocks,) or with k columns."""
        first, count = self.lanes.node[name]
        values = self.records().reshape(-1, LANES)[:, first : first + count]
        return values[:, 0] if count == 1 else values

    def in_tiles(self, name: str) -> np.ndarray:
        """Return a quantity of all nodes of all tiles, one tile after the other."""
        first, count = self.lanes.tile[name]
        values = self.tiles.reshape(-1, LANES)[:, first : first + count]
        return values[:, 0] if count == 1 else values


def room(buffer, count):
    """Return a buffer for `count` records: the old one if it fits and is not far too large."""
    if count * LANES <= buffer.size <= 2 * count * LANES:
        return buffer
    return aligned((count + count // 16) * LANES)
