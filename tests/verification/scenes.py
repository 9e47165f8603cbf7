"""Short cases for the tests: one material, cubic cells, and whatever a test adds."""

import mpmgeo

RUBBER = {"type": "elastic", "id": 1, "density": 1000.0, "young": 1e6, "poisson": 0.25}


def scene(cells, cell, bodies, **keys):
    """Return a case of `bodies` in a mesh of `cells` (3,) cubes of edge `cell` [m]."""
    mesh = {"cells_number": cells, "cells_dimension": 3 * [cell]}
    for key in ("origin", "boundary_conditions"):
        if key in keys:
            mesh[key] = keys.pop(key)
    bodies = [{"material_id": 1} | body for body in bodies]
    return {"mesh": mesh, "materials": [RUBBER], "body": bodies, "n_threads": 1} | keys


def cuboid(low, high, **keys):
    return {"type": "cuboid", "point_p1": list(low), "point_p2": list(high)} | keys


def sphere(center, diameter, **keys):
    return {"type": "sphere", "center": list(center), "diameter": diameter} | keys


def simulate(case):
    """Return the simulation of a case given as a dict."""
    return mpmgeo.Simulation(mpmgeo.load_case(case))


def initial_position(simulation):
    """Return where the particles were at the start (n, 3) [m]."""
    return simulation.field("position") - simulation.field("displacement")
