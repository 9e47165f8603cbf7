"""The two loops of the method: over the particles of blocks, and over the nodes of blocks.

What is done with one particle or node is chosen by the type of a *work*, a NamedTuple of numbers;
the arrays that it needs are a tuple beside it. A block's particles have the first node of their
stencils in the block, so all their nodes lie in the block's *tile*, the block and a halo on the
upper sides. A loop over particles may read a copy of the nodes under the tile and may fill the
tile. No two threads ever write the same place, and every sum has one order.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import touches
from mpmgeo.mpm.core.stencils import block_bounds, block_origin, block_walls, rows
from mpmgeo.mpm.core.tile import copy_tile, sum_tiles
from mpmgeo.numerics.chunks import CHUNKS, blockwise
from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES
from mpmgeo.state.grid import mesh_of
from mpmgeo.state.layout import NODES, SIDE, axes, nodes, volume


class Here(NamedTuple):
    """What a work may know about the block whose particles are visited."""

    shape: object
    mesh: object
    half: object  # half-sizes of the particles in cells
    x: np.ndarray  # their positions [m]
    c: int  # number of the chunk
    b: int  # number of the block
    corner: tuple
    rows: tuple  # nodes along the edges of its tile
    origin: object  # position of its first node
    low: object  # bounds of its particles, in cells
    high: object
    walls: object  # where the shape ends, in cells from the block; None if it does not
    source: np.ndarray  # copy of the nodes under the tile
    tiles: tuple  # tiles to fill, those of one or more fields
    n0: int  # where the block's tile begins in each


class Node(NamedTuple):
    """What a work may know about a node."""

    mesh: object
    number: int
    block: int
    i: int
    j: int
    k: int
    bounded: bool  # whether it may lie on a plane
    sums: np.ndarray  # where the sums of the tiles over it are
    at: int


@generic
def visit(work, here, a, p):
    """Do the work with particle p; `a`: the arrays of the work. Return 1 if it left its block."""


@generic
def is_idle(work, a, b, begin, end):
    """Tell whether there is nothing to do with the particles `begin` … `end` of block b."""


@generic
def at_node(work, node, a):
    """Do the work at a node; `a`: the arrays of the work."""


@generic
def is_needless(work, a, b, bounded):
    """Tell whether there is nothing to do at the nodes of block b."""


@is_idle.register(tuple)
def _never_idle(work, a, b, begin, end):
    return False


@is_needless.register(tuple)
def _never_needless(work, a, b, bounded):
    return False


@inlined
def _fetch(nodes, b, row, tile):
    """Copy the nodes under a tile, if nodes are read."""
    if nodes is not None:
        copy_tile(nodes[0], nodes[1], b, row, tile)


@blockwise
def over_particles(c, work, shape, frame, place, half, x, nodes, scratch, tiles, fresh, a):
    """Visit the particles of blocks; return how many left theirs.

    `frame`: numbers of the mesh and its walls; `place`: bounds of the chunks of blocks, first
    particle and end of each, corners; `nodes`: the records to read, and which blocks of them lie
    under each tile, or None; `scratch`: room for a copy of them; `tiles`: those of one or more
    fields, emptied before if they are to be `fresh`.
    """
    mesh = mesh_of(frame)
    chunk, begin, end, corner = place
    row = rows(shape)
    size = volume(row) * LANES
    tile = scratch[c * size : (c + 1) * size]
    gone = 0
    for b in range(chunk[c], chunk[c + 1]):
        n0 = b * size
        if fresh:
            for f in range(len(tiles)):
                tiles[f][n0 : n0 + size] = 0.0
        if begin[b] == end[b] or is_idle(work, a, b, begin[b], end[b]):
            continue
        _fetch(nodes, b, row, tile)
        at = (corner[b, 0], corner[b, 1], corner[b, 2])
        low, high = block_bounds(shape, mesh, at)
        origin = block_origin(mesh, at)
        walls = block_walls(shape, frame, at)
        here = Here(shape, mesh, half, x, c, b, at, row, origin, low, high, walls, tile, tiles, n0)
        for p in range(begin[b], end[b]):
            gone += visit(work, here, a, p)
    return gone


@inlined
def is_bounded(mesh, row, I, J, K):
    """Tell whether a block of corner (I, J, K) may have nodes on a plane."""
    x = row[0] > 1 and touches(I, mesh.nx, SIDE)
    y = row[1] > 1 and touches(J, mesh.ny, SIDE)
    return x or y or (row[2] > 1 and touches(K, mesh.nz, SIDE))


@inlined
def _sum_all(tiles, below, b, row, scratch, first):
    if tiles is not None:
        for f in range(len(tiles)):
            sum_tiles(tiles[f], below, b, row, scratch, first + f * NODES * LANES)


@blockwise
def over_nodes(c, work, shape, frame, place, tiles, scratch, a):
    """Visit the nodes of blocks, the tiles over them summed before, in a fixed order.

    `frame`: numbers of the mesh; `place`: bounds of the chunks of blocks, corners, the tiles over
    each block; `tiles`: those of one or more fields, whose sums stand one after the other in the
    scratch memory, or None.
    """
    mesh = mesh_of(frame)
    chunk, corner, below = place
    row = rows(shape)
    first = c * (len(scratch) // CHUNKS)
    for b in range(chunk[c], chunk[c + 1]):
        I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
        bounded = is_bounded(mesh, row, I, J, K)
        if is_needless(work, a, b, bounded):
            continue
        _sum_all(tiles, below, b, row, scratch, first)
        count = nodes(row)
        for n in range(count):
            i, j, k = axes(row, n)
            i, j, k = I * SIDE + i, J * SIDE + j, K * SIDE + k
            at = first + n * LANES
            at_node(work, Node(mesh, b * count + n, b, i, j, k, bounded, scratch, at), a)
