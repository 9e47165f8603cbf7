"""Where records lie: in blocks of 4³ nodes, and in tiles, a block and its halo on the upper sides.

`rows` are the nodes along the three edges of a tile: 4 + S − 1 for a stencil of S nodes.
"""

from mpmgeo.numerics.jit import inlined

SIDE = 4
NODES = SIDE**3


@inlined
def volume(rows):
    """Return how many nodes a tile has."""
    return rows[0] * rows[1] * rows[2]


@inlined
def place(rows, i, j, k):
    """Return the number of a node in its tile."""
    return (i * rows[1] + j) * rows[2] + k


@inlined
def inner(i, j, k):
    """Return the number of a node in its block."""
    return (i * SIDE + j) * SIDE + k


@inlined
def axes(n):
    """Return where along x, y, z node n of a block lies."""
    return n // (SIDE * SIDE), n // SIDE % SIDE, n % SIDE


@inlined
def blocks_along(row):
    """Return over how many blocks so many nodes reach from the first of a block on."""
    return (row + SIDE - 1) // SIDE


@inlined
def block_of(rows, di, dj, dk):
    """Return the column, in a table of the blocks under tiles, of the one so far up."""
    return (di * blocks_along(rows[1]) + dj) * blocks_along(rows[2]) + dk


@inlined
def node_under(blocks, b, rows, i, j, k):
    """Return the number, among all nodes, of the one at i, j, k in tile b.

    `blocks` (tiles, ·): the blocks of nodes under each tile.
    """
    block = blocks[b, block_of(rows, i // SIDE, j // SIDE, k // SIDE)]
    return block * NODES + inner(i % SIDE, j % SIDE, k % SIDE)
