"""Where records lie: in blocks of 4³ nodes, and in tiles, a block and its halo on the upper sides.

`rows` are the nodes along the three edges of a tile: 4 + S − 1 for a stencil of S nodes. Along an
axis across which nothing changes the stencil has one node, and so have block and tile.
"""

from mpmgeo.numerics.jit import inlined

SIDE = 4
NODES = SIDE**3
"""Nodes of a block at most."""
CUBE = (SIDE, SIDE, SIDE)
"""A block as a tile."""


@inlined
def edge(width):
    """Return how many nodes a tile has along an axis, for a stencil of `width` nodes."""
    return SIDE + width - 1 if width > 1 else 1


@inlined
def side(row):
    """Return how many nodes a block has along an axis in which its tile has `row`."""
    return SIDE if row > 1 else 1


@inlined
def nodes(rows):
    """Return how many nodes a block has."""
    return side(rows[0]) * side(rows[1]) * side(rows[2])


@inlined
def volume(rows):
    """Return how many nodes a tile has."""
    return rows[0] * rows[1] * rows[2]


@inlined
def place(rows, i, j, k):
    """Return the number of a node in its tile."""
    return (i * rows[1] + j) * rows[2] + k


@inlined
def inner(rows, i, j, k):
    """Return the number of a node in its block."""
    return (i * side(rows[1]) + j) * side(rows[2]) + k


@inlined
def axes(rows, n):
    """Return where along x, y, z node n of a block lies."""
    J, K = side(rows[1]), side(rows[2])
    return n // (J * K), n // K % J, n % K


@inlined
def blocks_along(row):
    """Return over how many blocks so many nodes reach from the first of a block on."""
    return (row + side(row) - 1) // side(row)


@inlined
def block_of(rows, di, dj, dk):
    """Return the column, in a table of the blocks under tiles, of the one so far up."""
    return (di * blocks_along(rows[1]) + dj) * blocks_along(rows[2]) + dk


@inlined
def node_under(blocks, b, rows, i, j, k):
    """Return the number, among all nodes, of the one at i, j, k in tile b.

    `blocks` (tiles, ·): the blocks of nodes under each tile.
    """
    I, J, K = side(rows[0]), side(rows[1]), side(rows[2])
    block = blocks[b, block_of(rows, i // I, j // J, k // K)]
    return block * nodes(rows) + inner(rows, i % I, j % J, k % K)
