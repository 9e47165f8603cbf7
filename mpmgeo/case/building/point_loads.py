"""Forces on single nodes."""

import numpy as np

from mpmgeo.mpm.point_loads import PointLoads
from mpmgeo.naming import GHOSTS


def point_loads(case):
    """Return the point loads on the nodes nearest to their points, if the case has any."""
    loads = case.nodal_point_load
    if not loads:
        return None
    origin, cell = np.array(case.mesh.origin), np.array(case.mesh.cells_dimension)
    nodes = [load.node(origin, cell) - GHOSTS for load in loads]
    return PointLoads(nodes, [load.force for load in loads])
