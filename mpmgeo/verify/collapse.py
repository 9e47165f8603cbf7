"""A column of dry grains beside a wall collapses, without damping: grains keep their volume.

Without dilation, soil that flows neither gains nor loses volume, however it was torn in between:
what opens in flight has closed when the heap is at rest, and the heap is as large as the column.
"""

import numpy as np

WIDTH = 0.1
CELL = 0.005
DENSITY = 2650.0
FINE = 10  # places along a cell at which the area under a surface is counted


def column(aspect_ratio: float, **keys) -> dict:
    """Return the case of a column 0.1 m wide in plane strain, two particles along a cell."""
    height = aspect_ratio * WIDTH
    far = WIDTH * (2.0 + 4.0 * aspect_ratio ** (2 / 3))
    sides = dict.fromkeys(["plane_X0", "plane_Y0", "plane_Yn"], "sliding")
    return {
        "time": 1.2,
        "critical_time_step_multiplier": 0.5,
        "stress_scheme_update": "MUSL",
        "gravity": [0, 0, -9.81],
        "mesh": {
            "cells_number": [round(far / CELL), 1, round(height / CELL) + 6],
            "cells_dimension": 3 * [CELL],
            "boundary_conditions": sides | {"plane_Z0": "fixed", "plane_Zn": "free"},
        },
        "materials": [
            {
                "type": "mohr-coulomb",
                "id": 1,
                "density": DENSITY,
                "young": 840e3,
                "poisson": 0.3,
                "friction": 30.0,
                "cohesion": 0.0,
                "dilation": 0.0,
            }
        ],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0, 0, 0],
                "point_p2": [WIDTH, CELL, height],
                "particles_per_direction": [2, 1, 2],
                "material_id": 1,
            }
        ],
    } | keys


def area(simulation) -> float:
    """Return the area [m²] under the surface, up to which the density of the nodes is one half.

    The density is taken as linear between the nodes.
    """
    nodes, mesh = simulation.nodes(), simulation.case.mesh
    x, _, z = mesh.cells_number
    i, k = np.rint((nodes.position / mesh.cells_dimension)[:, [0, 2]].T).astype(int)
    inside = (i >= 0) & (i <= x) & (k >= 0) & (k <= z)
    density = np.zeros((x + 1, z + 1))
    np.add.at(density, (i[inside], k[inside]), nodes.mass[inside] / (DENSITY * CELL**3))
    density[0] *= 2  # a node at the wall, or on the floor, has half a cell
    density[:, 0] *= 2
    dense = _weights(x).T @ density @ _weights(z) >= 0.5
    under = np.maximum.accumulate(dense[:, ::-1], axis=1)
    return np.count_nonzero(under) * (CELL / FINE) ** 2


def _weights(cells):
    """Return the linear weights (cells + 1, fine) of the nodes of an axis at places between."""
    at = (np.arange(cells * FINE) + 0.5) / FINE
    return np.maximum(1 - np.abs(at - np.arange(cells + 1)[:, None]), 0.0)
