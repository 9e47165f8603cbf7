"""Means over the particles of a cell, weighted by volume.

A work adds the volume of its particles, and the volume times a value, to the record of their cell,
which is that of the cell's lowest node; `Average` divides the sums, and others read the mean.
"""

from typing import NamedTuple

from mpmgeo.mpm.core.loops import at_node
from mpmgeo.mpm.core.stencils import in_block
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, lane, load, load_row, pack4, truncate
from mpmgeo.state.layout import node_under, place


@inlined
def cell_of(here, p):
    """Return the place in its tile, along x, y, z, of the lowest node of particle p's cell."""
    x, y, z = here.rows
    last = pack4(max(x - 2.0, 0.0), max(y - 2.0, 0.0), max(z - 2.0, 0.0), 0.0)
    g = in_block(here.mesh, here.origin, load_row(here.x, p))
    g = min(max(truncate(g), 0.0), last)
    return int(lane(g, 0)), int(lane(g, 1)), int(lane(g, 2))


@inlined
def add_to_cell(here, p, volume, value):
    """Add a volume [m³] and the volume times a value to the sums of particle p's cell."""
    I, J, K = cell_of(here, p)
    tiles, at = here.tiles[0], here.n0 + place(here.rows, I, J, K) * LANES
    tiles[at] += volume
    tiles[at + 1] += volume * value


@inlined
def mean_of_cell(here, p, above, nodes, place_in_record):
    """Return the mean of particle p's cell, from a lane of the record where `Average` put it.

    `above`: the blocks under the tiles; `nodes`: their records.
    """
    I, J, K = cell_of(here, p)
    return nodes[node_under(above, here.b, here.rows, I, J, K) * LANES + place_in_record]


class Average(NamedTuple):
    """Give every cell the mean of what was added to the tiles, in a lane of its record.

    Arrays: nodes.
    """

    lane: int


@at_node.register(Average)
def average(work, node, a):
    r = load(node.sums, node.at)
    if lane(r, 0) != 0.0:
        a[0][node.number * LANES + work.lane] = lane(r, 1) / lane(r, 0)
