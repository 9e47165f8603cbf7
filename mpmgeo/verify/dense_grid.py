"""The dense grid of the plain twins: all nodes of the mesh and around it, and what holds them."""

from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import FIXED, SLIDING


class Box(NamedTuple):
    """The mesh, and how many rows of nodes the dense grid has around it."""

    mesh: tuple
    cell: tuple
    cells: tuple
    ghosts: int


def free_components(box, planes):
    """Return 0 for nodal components (nx, ny, nz, 3) that a plane holds, 1 for the others."""
    free = np.ones((*(n + 1 + 2 * box.ghosts for n in box.cells), 3))
    kinds = ((planes.x0, planes.xn), (planes.y0, planes.yn), (planes.z0, planes.zn))
    for axis, (lower, upper) in enumerate(kinds):
        nodes = np.moveaxis(free, axis, 0)
        first, last = nodes[: box.ghosts + 1], nodes[box.ghosts + box.cells[axis] :]
        for slab, kind in ((first, lower), (last, upper)):
            if kind == FIXED:
                slab[:] = 0.0
            elif kind == SLIDING:
                slab[..., axis] = 0.0
    return free
