"""The dense grid of the plain twins: all nodes of the mesh and around it, and what holds them."""

from math import inf
from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import FIXED, FREE, SLIDING


class Box(NamedTuple):
    """The mesh, and how many rows of nodes the dense grid has around it.

    `lower`, `upper`: where walls cut shapes, in cells.
    """

    mesh: tuple
    cell: tuple
    cells: tuple
    ghosts: int
    lower: tuple
    upper: tuple

    @classmethod
    def of(cls, mesh, planes, ghosts):
        """Return the grid of a mesh with planes."""
        kinds, cells = planes[:6], mesh[6:]
        lower = tuple(-inf if kind == FREE else 0.0 for kind in kinds[:3])
        upper = tuple(
            inf if kind == FREE else float(n) for kind, n in zip(kinds[3:], cells, strict=True)
        )
        return cls(mesh, mesh[:3], cells, ghosts, lower, upper)


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
